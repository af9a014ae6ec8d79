//! Vertices of a mesh that are points.

use super::{Mesh, MeshError};

/// Vertex indices, one for each point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PointIndices<'a> {
    /// For meshes of up to 256 vertices.
    U8(&'a [u8]),
    /// For meshes of up to 65,536 vertices.
    U16(&'a [u16]),
}

impl PointIndices<'_> {
    /// The number of points.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::U8(indices) => indices.len(),
            Self::U16(indices) => indices.len(),
        }
    }

    /// Whether there is no point.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The vertex index of point `index`, or `None` past the end.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<usize> {
        match self {
            Self::U8(indices) => indices.get(index).copied().map(usize::from),
            Self::U16(indices) => indices.get(index).copied().map(usize::from),
        }
    }
}

/// Vertices of a mesh that are drawn as points, checked.
///
/// ```
/// # use rasterizer::mesh::{Mesh, PointIndices, Points, Positions, Tables};
/// static STARS: Mesh<'static> = Mesh::new_const(Tables {
///     positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
///     ..Tables::EMPTY
/// });
/// static POINTS: Points<'static> = Points::new_const(&STARS, PointIndices::U8(&[0, 1, 2, 3]));
/// assert_eq!(POINTS.len(), 4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Points<'a> {
    indices: PointIndices<'a>,
}

impl<'a> Points<'a> {
    /// Checks that each point is a vertex of `mesh`.
    ///
    /// # Errors
    ///
    /// Returns the first point that is no vertex.
    pub const fn new(mesh: &Mesh<'_>, indices: PointIndices<'a>) -> Result<Self, MeshError> {
        let vertices = mesh.vertex_count();
        // A `const fn` may not have `for`.
        let mut point = 0;
        while point < indices.len() {
            let vertex = match indices {
                PointIndices::U8(indices) => indices[point] as usize,
                PointIndices::U16(indices) => indices[point] as usize,
            };
            if vertex >= vertices {
                return Err(MeshError::PointOutOfRange { point });
            }
            point += 1;
        }
        Ok(Self { indices })
    }

    /// [`Points::new`] for a `static` or a `const`, where a fault stops the compiler.
    ///
    /// # Panics
    ///
    /// Panics if a point is no vertex. In a constant that is a compile error.
    #[must_use]
    pub const fn new_const(mesh: &Mesh<'_>, indices: PointIndices<'a>) -> Self {
        match Self::new(mesh, indices) {
            Ok(points) => points,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// The checked table.
    #[must_use]
    pub const fn indices(&self) -> PointIndices<'a> {
        self.indices
    }

    /// The number of points.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.indices.len()
    }

    /// Whether there is no point.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Positions, Tables};

    /// A mesh of points alone has no triangles.
    const MESH: Mesh<'static> = Mesh::new_const(Tables {
        positions: Positions::I16(&[[0; 3], [1, 0, 0], [0, 1, 0]]),
        ..Tables::EMPTY
    });

    #[test]
    fn points_are_vertices_of_the_mesh() {
        for indices in [PointIndices::U8(&[0, 2]), PointIndices::U16(&[0, 2])] {
            let points = Points::new(&MESH, indices).unwrap();
            assert_eq!((points.len(), points.is_empty()), (2, false));
            assert_eq!((indices.get(1), indices.get(2)), (Some(2), None));
        }
        let wrong = MeshError::PointOutOfRange { point: 1 };
        assert_eq!(Points::new(&MESH, PointIndices::U8(&[0, 3])), Err(wrong));
        assert_eq!(Points::new(&MESH, PointIndices::U16(&[2, 3])), Err(wrong));
        assert!(std::format!("{wrong}").ends_with("(point 1)"), "{wrong}");
    }
}
