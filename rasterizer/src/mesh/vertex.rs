//! Vertices and triangles of a mesh, as a shader sees them.

use super::Tables;

/// The optional tables of a mesh that a shader reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct RequiredTables {
    /// [`Tables::vertex_normals`].
    pub vertex_normals: bool,
    /// [`Tables::face_normals`].
    pub face_normals: bool,
    /// [`Tables::texture_coordinates`].
    pub texture_coordinates: bool,
}

impl RequiredTables {
    /// None of them.
    pub const NONE: Self =
        Self { vertex_normals: false, face_normals: false, texture_coordinates: false };
}

/// The tables of vertices as slices: a loop over vertices resolves their formats once, before it
/// begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VertexColumns<'a> {
    positions: &'a [[i16; 3]],
    normals: &'a [[i8; 3]],
    texture_coordinates: &'a [[u16; 2]],
    texture_fraction_bits: u8,
}

impl<'a> VertexColumns<'a> {
    #[inline(always)]
    pub(crate) const fn new(tables: &Tables<'a>) -> Self {
        Self {
            positions: tables.positions.as_slice(),
            normals: tables.vertex_normals.as_slice(),
            texture_coordinates: tables.texture_coordinates.as_slice(),
            texture_fraction_bits: tables.texture_coordinates.fraction_bits(),
        }
    }

    /// The first `count` vertices: the columns that are read get that length, so that the compiler
    /// sees that no index below `count` is past their end. `None` if one of them is shorter.
    #[inline(always)]
    pub(crate) fn first(self, count: usize, read: RequiredTables) -> Option<Self> {
        Some(Self {
            positions: self.positions.get(..count)?,
            normals: cut(self.normals, count, read.vertex_normals)?,
            texture_coordinates: cut(self.texture_coordinates, count, read.texture_coordinates)?,
            ..self
        })
    }
}

#[inline(always)]
fn cut<T>(column: &[T], count: usize, is_read: bool) -> Option<&[T]> {
    if is_read { column.get(..count) } else { Some(column) }
}

/// The tables of triangles as slices, in the same way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FaceColumns<'a> {
    normals: &'a [[i8; 3]],
}

impl<'a> FaceColumns<'a> {
    #[inline(always)]
    pub(crate) const fn new(tables: &Tables<'a>) -> Self {
        Self { normals: tables.face_normals.as_slice() }
    }
}

/// A vertex of a mesh. Each method reads its table when it is called.
#[derive(Clone, Copy, Debug)]
pub struct MeshVertex<'a> {
    columns: &'a VertexColumns<'a>,
    index: usize,
}

impl<'a> MeshVertex<'a> {
    #[inline(always)]
    pub(crate) const fn new(columns: &'a VertexColumns<'a>, index: usize) -> Self {
        Self { columns, index }
    }

    /// Its position in quanta of the mesh.
    #[inline(always)]
    #[must_use]
    pub fn position(&self) -> [i16; 3] {
        self.columns.positions.get(self.index).copied().unwrap_or_default()
    }

    /// Its normal in object space, 127 standing for 1; zero if the mesh has none.
    #[inline(always)]
    #[must_use]
    pub fn normal(&self) -> [i8; 3] {
        self.columns.normals.get(self.index).copied().unwrap_or_default()
    }

    /// Its texture coordinates u and v, in units of
    /// 2<sup>-[`texture_fraction_bits`](Self::texture_fraction_bits)</sup>; zero if the mesh has
    /// none.
    #[inline(always)]
    #[must_use]
    pub fn texture_coordinates(&self) -> [u16; 2] {
        self.columns.texture_coordinates.get(self.index).copied().unwrap_or_default()
    }

    /// How many bits of its texture coordinates are behind the binary point: 0 to 16, the same for
    /// all vertices of a mesh.
    #[inline(always)]
    #[must_use]
    pub const fn texture_fraction_bits(&self) -> u8 {
        self.columns.texture_fraction_bits
    }
}

/// A triangle of a mesh. Each method reads its table when it is called.
#[derive(Clone, Copy, Debug)]
pub struct MeshFace<'a> {
    columns: &'a FaceColumns<'a>,
    index: usize,
}

impl<'a> MeshFace<'a> {
    #[inline(always)]
    pub(crate) const fn new(columns: &'a FaceColumns<'a>, index: usize) -> Self {
        Self { columns, index }
    }

    /// Its place in the table, from 0.
    #[inline(always)]
    #[must_use]
    pub const fn index(&self) -> usize {
        self.index
    }

    /// Its normal in object space, 127 standing for 1; zero if the mesh has none.
    #[inline(always)]
    #[must_use]
    pub fn normal(&self) -> [i8; 3] {
        self.columns.normals.get(self.index).copied().unwrap_or_default()
    }
}
