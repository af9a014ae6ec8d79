//! Polygons into triangles.

use earcut::Earcut;

use super::{
    polygons::{Corner, Face, Polygons},
    smoothing::Smoothing,
    vector::{Vector, add, cross, largest, length, sub},
};

/// A triangle, counter-clockwise when seen from its front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Triangle {
    /// Its corners.
    pub corners: [Corner; 3],
    /// Its material.
    pub material: usize,
    /// Its smoothing group.
    pub smoothing: Smoothing,
}

/// Cuts all polygons into triangles by ear clipping, which also works for concave ones, and drops
/// triangles without area. Also returns how many it drops.
///
/// `positions` are those of the polygons, scaled so that no coordinate exceeds 2.
pub(super) fn triangulate(polygons: &Polygons, positions: &[Vector]) -> (Vec<Triangle>, usize) {
    let mut earcut = Earcut::new();
    let mut ears: Vec<u32> = Vec::new();
    let mut triangles = Vec::new();
    let mut whole = 0;
    let mut start = 0;
    for &Face { arity, material, smoothing } in &polygons.faces {
        let corners = &polygons.corners[start..start + arity];
        start += arity;
        whole += arity - 2;
        let ring: Vec<Vector> = corners.iter().map(|c| positions[c.position as usize]).collect();
        ears.clear();
        if ring.len() > 3 {
            let flat = flattened(&ring);
            earcut.earcut_slice(&flat, &[], &mut ears);
            turn_counter_clockwise(&flat, &mut ears);
        }
        if ears.is_empty() {
            // A triangle, or a polygon whose area cancels out, such as a figure of eight.
            ears.extend((2..ring.len() as u32).flat_map(|i| [0, i - 1, i]));
        }
        for ear in ears.chunks_exact(3) {
            let corners = [0, 1, 2].map(|i| corners[ear[i] as usize]);
            if has_area(corners.map(|c| positions[c.position as usize])) {
                triangles.push(Triangle { corners, material, smoothing });
            }
        }
    }
    let dropped = whole - triangles.len();
    (triangles, dropped)
}

/// Projects the polygon along the axis nearest to its normal, counter-clockwise. Dropping a
/// coordinate, rather than turning the plane, keeps the other two exact.
fn flattened(ring: &[Vector]) -> Vec<[f64; 2]> {
    let n = newell_normal(ring).map(f64::abs);
    let axis = if n[0] > n[1] && n[0] > n[2] {
        0
    } else if n[1] > n[2] {
        1
    } else {
        2
    };
    let (u, v) = if newell_normal(ring)[axis] < 0.0 {
        ((axis + 2) % 3, (axis + 1) % 3)
    } else {
        ((axis + 1) % 3, (axis + 2) % 3)
    };
    ring.iter().map(|p| [p[u], p[v]]).collect()
}

/// The polygon's area times twice its normal. Works from any corner, convex or not (Newell's
/// method; Sutherland et al., "A characterization of ten hidden-surface algorithms", 1974).
fn newell_normal(ring: &[Vector]) -> Vector {
    let relative = |i: usize| sub(ring[i % ring.len()], ring[0]);
    (1..ring.len()).fold([0.0; 3], |sum, i| add(sum, cross(relative(i), relative(i + 1))))
}

/// Makes all ears counter-clockwise. The ear clipper gives them all one winding, which depends on
/// its version, so the sign of their total area decides.
fn turn_counter_clockwise(points: &[[f64; 2]], ears: &mut [u32]) {
    let area: f64 = ears
        .chunks_exact(3)
        .map(|ear| {
            let [a, b, c] = [0, 1, 2].map(|i| points[ear[i] as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        })
        .sum();
    if area < 0.0 {
        ears.chunks_exact_mut(3).for_each(|ear| ear.swap(1, 2));
    }
}

/// Whether a triangle has an area beyond the rounding of its coordinates.
///
/// A coordinate c has an error of up to c * epsilon / 2. So each coordinate of an edge has one of
/// c * epsilon, and the cross product of two edges one of about 4 c * epsilon times the longest
/// edge. Three points on a slanted line, written in decimals, have no more area than that: their
/// normal is noise.
pub(super) fn has_area([a, b, c]: [Vector; 3]) -> bool {
    // In units of the largest coordinate, no product leaves the range of f64.
    let coordinate = largest(a).max(largest(b)).max(largest(c));
    let [ab, bc, ca] = [sub(b, a), sub(c, b), sub(a, c)].map(|edge| edge.map(|x| x / coordinate));
    let longest = length(ab).max(length(bc)).max(length(ca));
    length(cross(ab, bc)) > 4.0 * f64::EPSILON * longest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(ring: &[Vector]) -> Polygons {
        Polygons {
            positions: ring.to_vec(),
            corners: (0..ring.len() as u32)
                .map(|position| Corner { position, normal: [0.0; 3], texture: [0.0; 2] })
                .collect(),
            faces: vec![Face { arity: ring.len(), material: 0, smoothing: Smoothing::Unstated }],
            colors: vec![[0; 3]],
        }
    }

    fn cut(ring: &[Vector]) -> (Vec<[Vector; 3]>, usize) {
        let polygons = polygon(ring);
        let (triangles, dropped) = triangulate(&polygons, &polygons.positions);
        let points =
            triangles.iter().map(|t| t.corners.map(|c| ring[c.position as usize])).collect();
        (points, dropped)
    }

    /// An L, concave at its first corner: a fan from any corner but the first and the fourth folds
    /// over.
    const L: [[f64; 2]; 6] =
        [[1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]];

    #[test]
    fn concave_polygons_keep_area_and_winding_on_any_plane() {
        let planes: [fn([f64; 2]) -> Vector; 6] = [
            |[x, y]| [x, y, 0.5],
            |[x, y]| [y, x, 0.5],
            |[x, y]| [0.5, x, y],
            |[x, y]| [y, 0.5, x],
            |[x, y]| [x, 0.5, y],
            |[x, y]| [x - y, x + y, 0.3 * x],
        ];
        for (number, plane) in planes.into_iter().enumerate() {
            for shift in 0..L.len() {
                let mut ring = L.map(plane);
                ring.rotate_left(shift);
                let whole = newell_normal(&ring);
                let (triangles, dropped) = cut(&ring);
                assert_eq!((triangles.len(), dropped), (4, 0), "plane {number}, start {shift}");
                let sum = triangles.iter().fold(0.0, |sum, t| {
                    let n = newell_normal(t);
                    assert!(
                        super::super::vector::dot(n, whole) > 0.0,
                        "plane {number}: a triangle is turned over"
                    );
                    sum + length(n)
                });
                assert!(
                    (sum - length(whole)).abs() < 1e-12,
                    "plane {number}, start {shift}: area {sum}"
                );
            }
        }
    }

    #[test]
    fn no_corner_is_lost_on_a_straight_edge() {
        let ring =
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        for shift in 0..ring.len() {
            let mut ring = ring;
            ring.rotate_left(shift);
            let (triangles, dropped) = cut(&ring);
            assert_eq!((triangles.len(), dropped), (3, 0), "start {shift}");
            assert!(ring.iter().all(|p| triangles.iter().any(|t| t.contains(p))), "start {shift}");
        }
    }

    #[test]
    fn triangles_without_area_are_dropped_and_counted() {
        assert_eq!(cut(&[[0.1; 3], [0.2; 3], [0.3; 3]]), (vec![], 1));
        // On one line in decimals, not in binary.
        assert_eq!(cut(&[[0.05, 0.15, 0.35], [0.1, 0.3, 0.7], [0.15, 0.45, 1.05]]), (vec![], 1));
        assert_eq!(cut(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0; 3]]), (vec![], 1));
        assert_eq!(cut(&[[0.1; 3], [0.2; 3], [0.3; 3], [0.7; 3]]), (vec![], 2));
        let (triangles, dropped) =
            cut(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!((triangles.len(), dropped), (1, 1));
        // A figure of eight on edge: its area cancels out, its halves stay.
        let eight = [[0.0; 3], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(cut(&eight).1, 0);
        // Thin, but thicker than the error of its coordinates.
        assert_eq!(cut(&[[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-12, 0.0]]).1, 0);
    }

    #[test]
    fn large_polygons_are_cut_whole() {
        // A star of 20,000 corners: every other corner is concave.
        let ring: Vec<Vector> = (0..20_000)
            .map(|i| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 20_000.0).sin_cos();
                let r = 1.0 - 0.3 * f64::from(i % 2);
                [r * cos, 0.1, -r * sin]
            })
            .collect();
        let (triangles, dropped) = cut(&ring);
        assert_eq!((triangles.len(), dropped), (19_998, 0));
        let sum: f64 = triangles.iter().map(|t| newell_normal(t)[1]).sum();
        assert!((sum - newell_normal(&ring)[1]).abs() < 1e-9 && sum > 0.0);
    }
}
