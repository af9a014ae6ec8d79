//! The faces of an OBJ file as the end-to-end reference draws and judges them: cut into triangles
//! independently of the tables, with the edges that faces share.

use std::collections::HashMap;

use super::view::View;
use crate::{
    model::{Face, Faces, Model},
    reference::{Mesh, Plane, triangulate},
};

/// What is the same in every view of a model.
#[derive(Debug, Default)]
pub(super) struct Surface {
    /// Each face's mean plane, in model units.
    pub(super) planes: Vec<Plane>,
    /// Whether a face doesn't cross itself. One that does has no single picture.
    pub(super) is_simple: Vec<bool>,
    /// Triangles, by three numbers of corners.
    pub(super) triangles: Vec<[usize; 3]>,
    /// Their normals, of length 1, which light them; zero for those without area.
    pub(super) normals: Vec<[f64; 3]>,
    /// The face of each triangle.
    pub(super) faces: Vec<usize>,
    /// The sides of all faces, each once.
    pub(super) edges: Vec<Edge>,
    /// The edge from each corner to the next of its face.
    pub(super) sides: Vec<Side>,
    /// The vertices of the tables that each corner has become; none, if no triangle has it.
    pub(super) vertices: Vec<Vec<usize>>,
}

/// A straight line between two positions that is a side of one face or of several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    /// Its ends, the lower number first.
    pub(super) ends: [usize; 2],
    /// The largest deviation from their planes of the faces that it belongs to.
    pub(super) deviation: f64,
}

/// An edge in the direction in which a face runs along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Side {
    /// Its number.
    pub(super) edge: usize,
    /// 1 from the lower end to the higher, -1 back, 0 for a side without length.
    pub(super) direction: i32,
}

impl Surface {
    /// Of a model whose faces run the way that its tables do, or the other one if `is_mirrored`.
    pub(super) fn of(model: &Model, is_mirrored: bool) -> Self {
        let exact = &model.exact.faces;
        let mut surface = Self { vertices: vertices(model, is_mirrored), ..Self::default() };
        let mut known = HashMap::new();
        for (number, face) in exact.faces.iter().enumerate() {
            let ring = exact.ring(face);
            let plane = Plane::of(&ring);
            let cut = triangulate(&ring, &plane);
            surface.is_simple.push(cut.is_some());
            let fan = || (2..ring.len()).map(|i| [0, i - 1, i]).collect();
            for triangle in cut.unwrap_or_else(fan) {
                surface.triangles.push(triangle.map(|corner| face.corners.start + corner));
                surface.faces.push(number);
            }
            for corner in face.corners.clone() {
                let [from, to] =
                    [corner, next(face, corner)].map(|corner| exact.corners[corner] as usize);
                let ends = [from.min(to), from.max(to)];
                let edge = *known.entry(ends).or_insert_with(|| {
                    surface.edges.push(Edge { ends, deviation: 0.0 });
                    surface.edges.len() - 1
                });
                let deviation = &mut surface.edges[edge].deviation;
                *deviation = deviation.max(plane.deviation);
                let direction = i32::from(from < to) - i32::from(from > to);
                surface.sides.push(Side { edge, direction });
            }
            surface.planes.push(plane);
        }
        let place = |corner: usize| exact.positions[exact.corners[corner] as usize];
        let normal =
            |triangle: &[usize; 3]| Plane::of(&triangle.map(place)).normal().unwrap_or_default();
        surface.normals = surface.triangles.iter().map(normal).collect();
        surface
    }
}

impl Surface {
    /// The triangles in world space, each corner a vertex.
    pub(super) fn mesh(&self, model: &Model, view: &View) -> Mesh {
        let faces = &model.exact.faces;
        let posed = view.pose_points(&faces.positions);
        let positions = faces.corners.iter().map(|&position| posed[position as usize]).collect();
        Mesh { positions, triangles: self.triangles.clone() }
    }

    /// The unit normals of all triangles that a face might be cut into; `None` if these can be any.
    pub(super) fn possible_normals(&self, faces: &Faces, face: usize) -> Option<Vec<[f64; 3]>> {
        /// Of a face with 8 corners there are 56.
        const MOST: usize = 8;
        let plane = &self.planes[face];
        let ring = faces.ring(&faces.faces[face]);
        let size = plane.area.iter().fold(0f64, |m, c| m.max(c.abs())).sqrt();
        if plane.deviation <= 1e-12 * size {
            return plane.normal().map(|normal| vec![normal]);
        }
        let mut normals = Vec::new();
        for c in 2..ring.len().min(MOST + 1) {
            for (a, b) in (1..c).flat_map(|b| (0..b).map(move |a| (a, b))) {
                let triangle = Plane::of(&[ring[a], ring[b], ring[c]]);
                let area = triangle.area.iter().fold(0f64, |m, c| m.max(c.abs()));
                // The direction of a thin one is that of the corners' last digits.
                if area <= 1e-9 * size * size {
                    return None;
                }
                normals.extend(triangle.normal());
            }
        }
        (ring.len() <= MOST).then_some(normals)
    }
}

/// The corner after `corner` round its face.
pub(super) const fn next(face: &Face, corner: usize) -> usize {
    if corner + 1 < face.corners.end { corner + 1 } else { face.corners.start }
}

/// The vertices of the tables that each corner has become. Several, if the triangles of a face have
/// different normals there.
fn vertices(model: &Model, is_mirrored: bool) -> Vec<Vec<usize>> {
    let exact = &model.exact.faces;
    // The faces at each position, and the corner of each there.
    let mut faces = vec![Vec::new(); exact.positions.len()];
    let mut corners = HashMap::new();
    for (number, face) in exact.faces.iter().enumerate() {
        for corner in face.corners.clone() {
            let position = exact.corners[corner];
            faces[position as usize].push(number);
            corners.insert((position, number), corner);
        }
    }
    let mut vertices = vec![Vec::new(); exact.corners.len()];
    for triangle in (0..).map_while(|i| model.triangles.as_triangles().get(i)) {
        let positions = triangle.map(|vertex| exact.vertices[vertex]);
        // Many faces may meet at one of its corners, but few at all three.
        let Some(rarest) = positions.iter().min_by_key(|p| faces[**p as usize].len()) else {
            continue;
        };
        for &face in &faces[*rarest as usize] {
            let found = positions.map(|position| corners.get(&(position, face)).copied());
            let [Some(a), Some(b), Some(c)] = found else { continue };
            // In the winding of the face, which may lie on another back to back.
            let is_in_order =
                |[a, b, c]: [usize; 3]| (a < b) != is_mirrored && (b < c) != is_mirrored;
            if [[a, b, c], [b, c, a], [c, a, b]].into_iter().any(is_in_order) {
                for (corner, vertex) in [a, b, c].into_iter().zip(triangle) {
                    if !vertices[corner].contains(&vertex) {
                        vertices[corner].push(vertex);
                    }
                }
            }
        }
    }
    vertices
}
