//! The triangles of a model.

use rasterizer::mesh::Triangles;

/// Vertex indices in the smallest type that holds them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Indices {
    /// For up to 256 vertices.
    U8(Vec<[u8; 3]>),
    /// For up to 65,536 vertices.
    U16(Vec<[u16; 3]>),
}

impl Indices {
    pub(super) fn new(triangles: &[[u32; 3]], vertices: usize) -> Self {
        if vertices <= 1 << 8 {
            Self::U8(triangles.iter().map(|t| t.map(|i| i as u8)).collect())
        } else {
            Self::U16(triangles.iter().map(|t| t.map(|i| i as u16)).collect())
        }
    }

    /// The bytes of an index.
    pub(super) const fn index_bytes(&self) -> usize {
        match self {
            Self::U8(_) => 1,
            Self::U16(_) => 2,
        }
    }

    /// Borrows them for a mesh.
    #[must_use]
    pub fn as_triangles(&self) -> Triangles<'_> {
        match self {
            Self::U8(triangles) => Triangles::U8(triangles),
            Self::U16(triangles) => Triangles::U16(triangles),
        }
    }
}
