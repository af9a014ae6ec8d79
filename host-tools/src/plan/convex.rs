//! Whether a mesh is convex: exactly, from its quantised positions.

use std::collections::HashMap;

use crate::model::Model;

/// The shape of a mesh: whether its triangles can hide each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// No front face hides another, from wherever it is seen.
    Convex,
    /// It has edges that bend inwards.
    Hollow {
        /// How many.
        edges: usize,
    },
    /// It is not a closed surface.
    Open {
        /// Edges of one triangle, or of more than two, or that two triangles run along in the same
        /// direction.
        edges: usize,
    },
    /// All its edges bend outwards or are flat, but it has several parts, or winds around itself.
    Several,
}

/// Decides it.
///
/// A closed, connected surface whose every edge bends outwards or is flat bounds a convex body, if
/// it winds around its inside once (Mehlhorn et al., *Checking geometric programs or verification
/// of geometric structures*, 1996). Positions are 16-bit integers, so the volume of a tetrahedron
/// of four of them, whose sign tells how an edge bends, is below 2^51 and exact in `i64`. That it
/// winds once is tested by the vertices: all lie below the plane of each triangle, or on it.
#[must_use]
pub fn shape(model: &Model) -> Shape {
    let triangles = by_position(model);
    let mut opposite: HashMap<[[i16; 3]; 2], [i16; 3]> = HashMap::new();
    let mut open = 0;
    for [a, b, c] in &triangles {
        for (edge, corner) in [([*a, *b], c), ([*b, *c], a), ([*c, *a], b)] {
            open += usize::from(opposite.insert(edge, *corner).is_some());
        }
    }
    let mut hollow = 0;
    for &[a, b, c] in &triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            match opposite.get(&[to, from]) {
                None => open += 1,
                // Each edge once.
                Some(&corner) => {
                    hollow += usize::from(from < to && volume([a, b, c], corner) > 0);
                }
            }
        }
    }
    if open > 0 {
        Shape::Open { edges: open }
    } else if hollow > 0 {
        Shape::Hollow { edges: hollow }
    } else if is_below_all(&triangles) {
        Shape::Convex
    } else {
        Shape::Several
    }
}

/// The positions of a triangle's corners in quanta.
pub(super) type Corners = [[i16; 3]; 3];

/// The triangles of a model's tables.
pub(super) fn triangles(model: &Model) -> Vec<Corners> {
    let table = model.triangles.as_triangles();
    let corners = (0..model.report.triangles).filter_map(|number| table.get(number));
    corners.map(|corners| corners.map(|corner| model.positions[corner])).collect()
}

/// The triangles as positions, without those of no area: hard edges and seams divide vertices, not
/// places.
fn by_position(model: &Model) -> Vec<Corners> {
    let mut triangles = triangles(model);
    triangles.retain(|&triangle| cross(triangle) != [0; 3]);
    triangles
}

/// Whether no vertex lies above the plane of a triangle: then no triangle hides another one, closed
/// or not, from wherever it is seen, as what hides a triangle lies in front of its plane. Planes of
/// a convex body are few, or its vertices are: a sphere of 65,536 vertices takes a few seconds.
pub(super) fn is_below_all(triangles: &[Corners]) -> bool {
    let mut vertices: Vec<_> = triangles.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    triangles.iter().all(|&triangle| {
        let (normal, origin) = (cross(triangle), triangle[0]);
        vertices.iter().all(|&vertex| dot(normal, difference(vertex, origin)) <= 0)
    })
}

/// Six times the volume of the tetrahedron over a triangle: above 0 if the point lies in front.
fn volume(triangle: Corners, point: [i16; 3]) -> i64 {
    dot(cross(triangle), difference(point, triangle[0]))
}

pub(super) fn difference(a: [i16; 3], b: [i16; 3]) -> [i64; 3] {
    [0, 1, 2].map(|i| i64::from(a[i]) - i64::from(b[i]))
}

pub(super) fn cross([a, b, c]: Corners) -> [i64; 3] {
    let (u, v) = (difference(b, a), difference(c, a));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

pub(super) fn dot(a: [i64; 3], b: [i64; 3]) -> i64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{model::Options, plan::tests::CUBE};

    fn shape_of(obj: &str) -> Shape {
        let model = Model::from_bytes("m.obj".as_ref(), obj.as_bytes(), &Options::default());
        shape(&model.unwrap())
    }

    /// The cube again, scaled and moved.
    fn second(scale: f64, by: f64) -> String {
        let mut text = String::new();
        for line in CUBE.lines() {
            let words: Vec<&str> = line.split(' ').collect();
            let moved: Vec<String> = words[1..]
                .iter()
                .map(|word| match words[0] {
                    "v" => (word.parse::<f64>().unwrap() * scale + by).to_string(),
                    _ => (word.parse::<u32>().unwrap() + 8).to_string(),
                })
                .collect();
            text += &format!("{} {}\n", words[0], moved.join(" "));
        }
        text
    }

    #[test]
    fn a_cube_is_convex() {
        // Its flat edges, the diagonals of its faces, do not bend.
        assert_eq!(shape_of(CUBE), Shape::Convex);
    }

    #[test]
    fn a_cube_without_a_face_is_open() {
        let open = CUBE.replace("f 1 2 4 3\n", "");
        assert_eq!(shape_of(&open), Shape::Open { edges: 4 });
    }

    #[test]
    fn a_dent_bends_edges_inwards() {
        // A pyramid into the face at z = 1 in its place: four edges from the corners to its tip.
        let dent =
            CUBE.replace("f 2 6 8 4\n", "v 0.5 0.5 0.6\nf 2 6 9\nf 6 8 9\nf 8 4 9\nf 4 2 9\n");
        assert_eq!(shape_of(&dent), Shape::Hollow { edges: 4 });
        // By a quantum: a 32,767th of the half diagonal of 0.866.
        let flat = dent.replace("0.6", "0.99996");
        assert_eq!(shape_of(&flat), Shape::Hollow { edges: 4 });
        assert_eq!(shape_of(&dent.replace("0.6", "1.4")), Shape::Convex);
    }

    #[test]
    fn two_cubes_are_not_one_convex_body() {
        let with = |other: String| shape_of(&(CUBE.to_owned() + &other));
        assert_eq!(with(second(1.0, 3.0)), Shape::Several);
        // Also one within the other.
        assert_eq!(with(second(0.4, 0.3)), Shape::Several);
    }

    #[test]
    fn seams_and_hard_edges_do_not_open_a_mesh() {
        // Each face has normals of its own, so that no vertex is shared.
        let faceted = format!("s off\n{CUBE}");
        assert_eq!(shape_of(&faceted), Shape::Convex);
    }
}
