//! Vertex normals.

use std::collections::HashMap;

use super::{
    cap::CapTree,
    triangulate::{Triangle, has_area},
    vector::{Vector, add, angle, cross, dot, normalized, scaled, sub},
};

/// Of more faces round a position the sums come from a tree.
const CROWD: usize = 64;

/// The unit normal of a triangle that is counter-clockwise seen from its front.
pub(super) fn face_normal([a, b, c]: [Vector; 3]) -> Vector {
    // The cross products at the three corners are equal except for rounding; this is the first's.
    normalized(cross(sub(b, a), sub(c, a))).unwrap_or([0.0, 0.0, 1.0])
}

/// Where the corners of a triangle are.
pub(super) fn places(triangle: &Triangle, positions: &[Vector]) -> [Vector; 3] {
    triangle.corners.map(|corner| positions[corner.position as usize])
}

/// The angle of a triangle at one of its corners, by which its normal is weighted there.
pub(super) fn opening(triangle: &Triangle, corner: usize, positions: &[Vector]) -> f64 {
    let places = places(triangle, positions);
    let [apex, one, other] = [0, 1, 2].map(|i| places[(corner + i) % 3]);
    angle(sub(one, apex), sub(other, apex))
}

/// The unit normal of a weighted sum; `None` if the normals of faces back to back cancel out, so
/// that rounding noise is what remains.
pub(super) fn mean(sum: Vector, weight: f64) -> Option<Vector> {
    if dot(sum, sum).sqrt() > 1e-9 * weight { normalized(sum) } else { None }
}

/// A unit normal for each corner of each triangle, by the crease angle.
///
/// A corner keeps the file's normal if there is one. Otherwise it gets the mean of the normals of
/// the faces round its position, each weighted by its angle there, so that the mean does not depend
/// on how a polygon is cut (Thürmer and Wüthrich, "Computing vertex normals from polygonal facets",
/// Journal of Graphics Tools 3(1), 1998). The mean includes only faces that are turned by no more
/// than `crease` radians from the corner's own, so that sharper edges stay hard. The time is
/// quadratic in the number of faces round one position, which is small except at the tip of a cone
/// of thousands of sides.
pub(super) fn corner_normals(
    triangles: &[Triangle],
    positions: &[Vector],
    crease: f64,
) -> Vec<[Vector; 3]> {
    let faces: Vec<Vector> = triangles.iter().map(|t| face_normal(places(t, positions))).collect();
    let has_area: Vec<bool> = triangles.iter().map(|t| has_area(places(t, positions))).collect();
    let mut around: Vec<Vec<(usize, f64)>> = vec![Vec::new(); positions.len()];
    for (face, triangle) in triangles.iter().enumerate() {
        // The normal of a triangle without area is noise.
        if !has_area[face] {
            continue;
        }
        for corner in 0..3 {
            let opening = opening(triangle, corner, positions);
            around[triangle.corners[corner].position as usize].push((face, opening));
        }
    }
    // An angle equal to the crease is within it, also if its cosine is rounded down.
    let least = crease.cos() - 1e-9;
    let crowded = (0..).zip(&around).filter(|(_, around)| around.len() > CROWD);
    let trees: HashMap<u32, CapTree> = crowded
        .map(|(position, around)| {
            let normals = around.iter().map(|&(face, opening)| (faces[face], opening));
            (position, CapTree::new(normals.collect()))
        })
        .collect();
    // Where all faces are within the crease of each other, their sum serves each of them.
    let shared: Vec<Option<Vector>> =
        around.iter().map(|around| shared_normal(around, &faces, crease)).collect();
    let sum_of = |face: usize, position: u32| {
        if let Some(tree) = trees.get(&position) {
            return tree.sum(faces[face], least);
        }
        sum(
            around[position as usize]
                .iter()
                .filter(|&&(other, _)| dot(faces[other], faces[face]) >= least),
            &faces,
        )
    };
    let smooth = |face: usize, position: u32| {
        let shared = shared[position as usize].filter(|_| has_area[face]);
        shared.unwrap_or_else(|| {
            let (sum, weight) = sum_of(face, position);
            mean(sum, weight).unwrap_or(faces[face])
        })
    };
    triangles
        .iter()
        .enumerate()
        .map(|(face, triangle)| {
            triangle
                .corners
                .map(|c| normalized(c.normal).unwrap_or_else(|| smooth(face, c.position)))
        })
        .collect()
}

/// The weighted sum of the normals of faces, and of their weights.
fn sum<'a>(around: impl Iterator<Item = &'a (usize, f64)>, faces: &[Vector]) -> (Vector, f64) {
    around.fold(([0.0; 3], 0.0), |(sum, weight), &(face, opening)| {
        (add(sum, scaled(faces[face], opening)), weight + opening)
    })
}

/// The mean of all faces round a position if none is turned by more than half the crease from it:
/// then each includes all others. `None` also where a tree sums them.
fn shared_normal(around: &[(usize, f64)], faces: &[Vector], crease: f64) -> Option<Vector> {
    if around.len() > CROWD {
        return None;
    }
    let (sum, weight) = sum(around.iter(), faces);
    let mean = mean(sum, weight)?;
    let least = (crease / 2.0).cos() + 1e-9;
    around.iter().all(|&(face, _)| dot(faces[face], mean) >= least).then_some(mean)
}

#[cfg(test)]
mod tests {
    use super::{
        super::{
            polygons::{Corner, NO_COLOR},
            smoothing::Smoothing,
        },
        *,
    };

    fn triangle(positions: [u32; 3], normal: Vector) -> Triangle {
        Triangle {
            corners: positions.map(|position| Corner {
                position,
                normal,
                texture: [0.0; 2],
                color: NO_COLOR,
            }),
            material: 0,
            smoothing: Smoothing::Unstated,
        }
    }

    /// Two squares that meet at a right angle, the first cut once more than the second.
    const POSITIONS: [Vector; 6] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 0.0, 1.0],
        [0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
    ];

    fn roof() -> Vec<Triangle> {
        [[0, 2, 1], [0, 3, 2], [0, 1, 5], [0, 5, 4]].map(|t| triangle(t, [0.0; 3])).to_vec()
    }

    #[test]
    fn creases_split_normals_and_angles_weight_them() {
        let hard = corner_normals(&roof(), &POSITIONS, 60_f64.to_radians());
        assert_eq!(hard[0], [[0.0, 1.0, 0.0]; 3]);
        assert_eq!(hard[3], [[0.0, 0.0, 1.0]; 3]);
        // At position 0 two triangles of 45 degrees on either side weigh as much as the single one
        // of 90 at position 1.
        let soft = corner_normals(&roof(), &POSITIONS, 90_f64.to_radians());
        let diagonal = [0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()];
        for normal in [soft[0][0], soft[0][2], soft[2][0], soft[2][1]] {
            assert!(angle(normal, diagonal) < 1e-12, "{normal:?}");
        }
        assert_eq!(soft[1][1], [0.0, 1.0, 0.0]);
    }

    #[test]
    fn given_normals_are_normalised_and_kept() {
        let given = triangle([0, 1, 2], [0.0, 3.0, -4.0]);
        assert_eq!(corner_normals(&[given], &POSITIONS, 1.0), [[[0.0, 0.6, -0.8]; 3]]);
    }

    /// Fans round one position from nearly flat to steep, each with a triangle without area.
    #[test]
    fn a_shared_mean_is_that_of_the_definition() {
        let (mut shared, mut split) = (0, 0);
        for (sides, crease) in [(3, 60.0), (7, 60.0), (12, 25.0), (40, 180.0), (5, 0.0)] {
            let crease = f64::to_radians(crease);
            for step in 0..60 {
                let height = |i: u32| f64::from(i * i * 7 % 11) / 11.0 * f64::from(step) / 20.0;
                let rim = (0..sides).map(|i| {
                    let (sin, cos) =
                        (f64::from(i) / f64::from(sides) * std::f64::consts::TAU).sin_cos();
                    [cos, height(i), sin]
                });
                let positions: Vec<Vector> = std::iter::once([0.0, 0.1, 0.0]).chain(rim).collect();
                let fan = (0..sides).map(|i| [0, (i + 1) % sides + 1, i + 1]);
                let corners = fan.chain([[0, 1, 1]]).map(|t| triangle(t, [0.0; 3]));
                let triangles: Vec<Triangle> = corners.collect();
                let faces: Vec<Vector> =
                    triangles.iter().map(|t| face_normal(places(t, &positions))).collect();
                let at_tip = |face: usize| {
                    let near = (0..sides as usize)
                        .filter(|&other| dot(faces[other], faces[face]) >= crease.cos() - 1e-9);
                    let near: Vec<(usize, f64)> = near
                        .map(|other| (other, opening(&triangles[other], 0, &positions)))
                        .collect();
                    let (sum, weight) = sum(near.iter(), &faces);
                    (near.len(), mean(sum, weight).unwrap_or(faces[face]))
                };
                let normals = corner_normals(&triangles, &positions, crease);
                for (face, normals) in normals.iter().enumerate() {
                    let (count, exact) = at_tip(face);
                    assert_eq!(normals[0], exact, "{sides} {step} {face}");
                    *(if count == sides as usize { &mut shared } else { &mut split }) += 1;
                }
            }
        }
        assert!(shared > 500 && split > 500, "{shared} {split}");
    }

    #[test]
    fn faces_back_to_back_keep_their_own_normals() {
        let sheet = [triangle([0, 1, 5], [0.0; 3]), triangle([0, 5, 1], [0.0; 3])];
        let normals = corner_normals(&sheet, &POSITIONS, std::f64::consts::PI);
        assert_eq!(normals[0], [[0.0, 0.0, 1.0]; 3]);
        assert_eq!(normals[1], [[0.0, 0.0, -1.0]; 3]);
        // The back in two parts: the sum is the noise of rounding.
        let positions = [[0.1, 0.2, 0.3], [0.7, 0.1, 0.5], [0.3, 0.9, 0.2], [0.5, 0.5, 0.35]];
        let sheet = [[0, 1, 2], [0, 2, 3], [0, 3, 1]].map(|t| triangle(t, [0.0; 3]));
        let normals = corner_normals(&sheet, &positions, std::f64::consts::PI);
        let front = face_normal([positions[0], positions[1], positions[2]]);
        assert!(angle(normals[0][0], front) < 1e-12, "{:?}", normals[0][0]);
        assert!(angle(normals[1][0], front) > 3.0, "{:?}", normals[1][0]);
    }
}
