//! Lines between the vertices of a mesh.

use super::{Mesh, MeshError};

/// Two vertex indices per line: its start and its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Segments<'a> {
    /// For meshes of up to 256 vertices.
    U8(&'a [[u8; 2]]),
    /// For meshes of up to 65,536 vertices.
    U16(&'a [[u16; 2]]),
}

impl Segments<'_> {
    /// The number of lines.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::U8(segments) => segments.len(),
            Self::U16(segments) => segments.len(),
        }
    }

    /// Whether there is no line.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The vertex indices of line `index`, or `None` past the end.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<[usize; 2]> {
        match self {
            Self::U8(segments) => segments.get(index).map(|s| s.map(usize::from)),
            Self::U16(segments) => segments.get(index).map(|s| s.map(usize::from)),
        }
    }

    /// The greatest vertex index of line `index`, which exists.
    const fn last_vertex(&self, index: usize) -> usize {
        let [a, b] = match self {
            Self::U8(segments) => [segments[index][0] as usize, segments[index][1] as usize],
            Self::U16(segments) => [segments[index][0] as usize, segments[index][1] as usize],
        };
        if a > b { a } else { b }
    }
}

/// Lines between the vertices of a mesh, checked: the edges of a wireframe, for example.
///
/// ```
/// # use rasterizer::mesh::{Lines, Material, Mesh, Positions, Segments, Tables, Triangles};
/// static SQUARE: Mesh<'static> = Mesh::new_const(Tables {
///     positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
///     triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
///     materials: &[Material::new([255, 160, 0], 2)],
///     ..Tables::EMPTY
/// });
/// static OUTLINE: Lines<'static> =
///     Lines::new_const(&SQUARE, Segments::U8(&[[0, 1], [1, 2], [2, 3], [3, 0]]));
/// assert_eq!(OUTLINE.len(), 4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Lines<'a> {
    segments: Segments<'a>,
}

impl<'a> Lines<'a> {
    /// Checks that both ends of each line are vertices of `mesh`.
    ///
    /// # Errors
    ///
    /// Returns the first line that has an end elsewhere.
    pub const fn new(mesh: &Mesh<'_>, segments: Segments<'a>) -> Result<Self, MeshError> {
        let vertices = mesh.vertex_count();
        // A `const fn` may not have `for`.
        let mut line = 0;
        while line < segments.len() {
            if segments.last_vertex(line) >= vertices {
                return Err(MeshError::LineOutOfRange { line });
            }
            line += 1;
        }
        Ok(Self { segments })
    }

    /// [`Lines::new`] for a `static` or a `const`, where a fault stops the compiler.
    ///
    /// # Panics
    ///
    /// Panics if a line has an end that is no vertex. In a constant that is a compile error.
    #[must_use]
    pub const fn new_const(mesh: &Mesh<'_>, segments: Segments<'a>) -> Self {
        match Self::new(mesh, segments) {
            Ok(lines) => lines,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// The checked table.
    #[must_use]
    pub const fn segments(&self) -> Segments<'a> {
        self.segments
    }

    /// The number of lines.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.segments.len()
    }

    /// Whether there is no line.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Material, Positions, Tables, Triangles};

    const MESH: Mesh<'static> = Mesh::new_const(Tables {
        positions: Positions::I16(&[[0; 3], [1, 0, 0], [0, 1, 0]]),
        triangles: Triangles::U8(&[[0, 1, 2]]),
        materials: &[Material::new([0; 3], 1)],
        ..Tables::EMPTY
    });

    #[test]
    fn ends_are_vertices_of_the_mesh() {
        for segments in [Segments::U8(&[[0, 1], [2, 0]]), Segments::U16(&[[0, 1], [2, 0]])] {
            let lines = Lines::new(&MESH, segments).unwrap();
            assert_eq!((lines.len(), lines.is_empty()), (2, false));
            assert_eq!((segments.get(1), segments.get(2)), (Some([2, 0]), None));
        }
        let wrong = MeshError::LineOutOfRange { line: 1 };
        assert_eq!(Lines::new(&MESH, Segments::U8(&[[0, 1], [0, 3]])), Err(wrong));
        assert_eq!(Lines::new(&MESH, Segments::U16(&[[0, 1], [3, 0]])), Err(wrong));
        assert!(std::format!("{wrong}").ends_with("(line 1)"), "{wrong}");
    }
}
