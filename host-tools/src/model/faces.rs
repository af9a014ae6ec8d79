//! The faces of the OBJ file before anything is cut, merged or rounded: what a picture of the
//! tables is judged by.

use std::ops::Range;

use super::{
    fit::Fitted,
    polygons::{self, Corner, Polygons},
    texture_coordinates::turned,
    vector::Vector,
};

/// All faces of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faces {
    /// The positions that faces use, each once, in model units and not rounded.
    pub positions: Vec<[f64; 3]>,
    /// The corners of the faces, one face after the other: indices into `positions`.
    pub corners: Vec<u32>,
    /// The texture coordinates of the corners, v running down; none if the file has none.
    pub texture_coordinates: Vec<[f64; 2]>,
    /// The colours of the corners from 0 to 255: those of vertices, or of the materials of vertices
    /// without; none if no vertex has one.
    pub vertex_colors: Vec<[f64; 3]>,
    /// The faces in the order of the file.
    pub faces: Vec<Face>,
    /// Which of `positions` each vertex of the tables has.
    pub vertices: Vec<u32>,
}

/// A face of the file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Face {
    /// Where its corners are in [`Faces::corners`], counter-clockwise as seen from its front.
    pub corners: Range<usize>,
    /// The colour of its material.
    pub color: [u8; 3],
    /// The number of its material in the tables; 0 if no triangle has it.
    pub material: usize,
    /// Its line in the file, from 1.
    pub line: usize,
}

impl Faces {
    /// The faces of `polygons`, whose corners are `corners`, and whose positions of a common size
    /// are `shape`. `ranks` has the number of each material in the tables, `lines` the line of each
    /// face, `vertices` the position of each vertex of the tables. It has no texture coordinates
    /// and no colours of vertices.
    pub(super) fn new(
        polygons: &Polygons,
        ranks: &[Option<usize>],
        corners: Vec<u32>,
        shape: &[Vector],
        fitted: &Fitted,
        lines: &[usize],
        vertices: &[u32],
    ) -> Self {
        let mut start = 0;
        let faces = (polygons.faces.iter().zip(lines))
            .map(|(&polygons::Face { arity, material, .. }, &line)| {
                let range = start..start + arity;
                start = range.end;
                let (color, number) = (polygons.colors[material], ranks[material].unwrap_or(0));
                Face { corners: range, color, material: number, line }
            })
            .collect();
        let positions = places(polygons, shape, fitted);
        let vertices = vertices.to_vec();
        Self { positions, corners, faces, vertices, ..Self::default() }
    }

    /// The positions of a face's corners.
    #[must_use]
    pub fn ring(&self, face: &Face) -> Vec<[f64; 3]> {
        self.corners[face.corners.clone()].iter().map(|&i| self.positions[i as usize]).collect()
    }
}

/// The positions of a file in model units, not rounded; `shape` has them in a common size.
pub(super) fn places(polygons: &Polygons, shape: &[Vector], fitted: &Fitted) -> Vec<Vector> {
    let both = polygons.positions.iter().zip(shape);
    both.map(|(&original, &shape)| fitted.place(original, shape)).collect()
}

/// The texture coordinates of corners, v running down; none if the number of those that have any in
/// the file, `textured`, is 0.
pub(super) fn texture_coordinates(corners: &[Corner], textured: usize) -> Vec<[f64; 2]> {
    let of = |corner: &Corner| turned(corner.texture);
    if textured == 0 { Vec::new() } else { corners.iter().map(of).collect() }
}

/// The colours of corners, which name them by `colors`; none if no vertex has one.
pub(super) fn vertex_colors(polygons: &Polygons, colors: &[u32]) -> Vec<[f64; 3]> {
    if polygons.vertex_colors.is_empty() {
        return Vec::new();
    }
    let materials =
        (polygons.faces.iter()).flat_map(|face| std::iter::repeat_n(face.material, face.arity));
    colors.iter().zip(materials).map(|(&color, material)| polygons.color(color, material)).collect()
}
