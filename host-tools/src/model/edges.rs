//! The edges of a model as lines: each once, by the faces of the file.

use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use super::{
    Faces,
    triangulate::newell_normal,
    vector::{Vector, angle},
};

/// An edge, and the faces that meet in it.
struct Edge {
    /// The vertices of the tables at its ends.
    vertices: [u32; 2],
    /// The normal of the first face, twice as long as its area.
    normal: Vector,
    faces: usize,
    /// Whether two of its faces meet at the least angle or more.
    is_sharp: bool,
}

/// The edges in which faces meet at an angle of `least_degrees` or more, and those of one face
/// alone, as pairs of vertices; all edges for an angle of 0. Diagonals along which a face is cut
/// into triangles are no edges.
///
/// Faces share an edge if its ends have the same positions, even with different normals and
/// texture coordinates there.
pub(super) fn edges(faces: &Faces, least_degrees: f64) -> Vec<[u32; 2]> {
    let mut vertex_at = vec![None; faces.positions.len()];
    for (vertex, &position) in faces.vertices.iter().enumerate() {
        vertex_at[position as usize].get_or_insert(vertex as u32);
    }
    let mut edges: Vec<Edge> = Vec::new();
    let mut known = FxHashMap::default();
    for face in &faces.faces {
        let ring = &faces.corners[face.corners.clone()];
        let normal = newell_normal(&faces.ring(face));
        for (&from, &to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            // A corner that no triangle has kept has no vertex.
            let ends = [vertex_at[from as usize], vertex_at[to as usize]];
            let [Some(a), Some(b)] = ends else { continue };
            if from == to {
                continue;
            }
            match known.entry([from.min(to), from.max(to)]) {
                Entry::Vacant(entry) => {
                    entry.insert(edges.len());
                    edges.push(Edge { vertices: [a, b], normal, faces: 1, is_sharp: false });
                }
                Entry::Occupied(entry) => {
                    let edge = &mut edges[*entry.get()];
                    edge.faces += 1;
                    edge.is_sharp |= angle(edge.normal, normal) >= least_degrees.to_radians();
                }
            }
        }
    }
    let kept = edges.iter().filter(|edge| edge.faces == 1 || edge.is_sharp);
    kept.map(|edge| edge.vertices).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::{Model, Options};

    fn edges(obj: &str, degrees: f64) -> Vec<[[i16; 3]; 2]> {
        let options = Options { edges_degrees: Some(degrees), ..Options::default() };
        let model = Model::from_bytes(Path::new("x.obj"), obj.as_bytes(), &options).unwrap();
        let place = |vertex: u32| model.positions[vertex as usize].map(i16::signum);
        let mut edges: Vec<_> = model
            .edges
            .iter()
            .map(|edge| {
                let mut e = edge.map(place);
                e.sort_unstable();
                e
            })
            .collect();
        edges.sort_unstable();
        edges
    }

    /// Eight corners, six faces, no normals of the file: vertices are split along all edges.
    const CUBE: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\n\
                        v -1 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

    #[test]
    fn a_cube_has_twelve_edges_of_90_degrees() {
        let all = edges(CUBE, 0.0);
        assert_eq!(all.len(), 12);
        assert!(all.windows(2).all(|pair| pair[0] != pair[1]), "{all:?}");
        // Each joins corners that differ in one coordinate: no diagonal.
        assert!(all.iter().all(|[a, b]| (0..3).filter(|&i| a[i] != b[i]).count() == 1), "{all:?}");
        assert_eq!(edges(CUBE, 89.9), all);
        assert!(edges(CUBE, 90.1).is_empty());
    }

    /// Of two squares in a plane, that which they share is left out, and borders are not.
    #[test]
    fn borders_are_edges_at_any_angle() {
        let obj = "v -1 0 0\nv 0 0 0\nv 1 0 0\nv -1 1 0\nv 0 1 0\nv 1 1 0\nf 1 2 5 4\nf 2 3 6 5\n";
        assert_eq!(edges(obj, 0.0).len(), 7);
        assert_eq!(edges(obj, 1.0).len(), 6);
        assert_eq!(edges(obj, 180.0).len(), 6);
    }
}
