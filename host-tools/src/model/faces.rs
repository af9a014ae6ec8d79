//! The faces of the OBJ file before anything is cut, merged or rounded: what a picture of the
//! tables is judged by.

use std::ops::Range;

use super::{
    fit::Fitted,
    polygons::{self, Polygons},
    vector::Vector,
};

/// All faces of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faces {
    /// The positions that faces use, each once, in model units and not rounded.
    pub positions: Vec<[f64; 3]>,
    /// The corners of the faces, one face after the other: indices into `positions`.
    pub corners: Vec<u32>,
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
    /// Its line in the file, from 1.
    pub line: usize,
}

impl Faces {
    /// The faces of `polygons`, whose corners are `corners`, and whose positions of a common size
    /// are `shape`. `lines` has the line of each, `vertices` the position of each vertex of the tables.
    pub(super) fn new(
        polygons: &Polygons,
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
                Face { corners: range, color: polygons.colors[material], line }
            })
            .collect();
        let positions = (polygons.positions.iter().zip(shape))
            .map(|(&original, &shape)| fitted.place(original, shape))
            .collect();
        Self { positions, corners, faces, vertices: vertices.to_vec() }
    }

    /// The positions of a face's corners.
    #[must_use]
    pub fn ring(&self, face: &Face) -> Vec<[f64; 3]> {
        self.corners[face.corners.clone()].iter().map(|&i| self.positions[i as usize]).collect()
    }
}
