//! A material as a shader sees it.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::{Finish, Material, Tables};

/// A material of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshMaterial<'a> {
    tables: &'a Tables<'a>,
    index: usize,
    color: Rgb888,
}

impl<'a> MeshMaterial<'a> {
    /// A material of these tables and its place in theirs.
    #[inline(always)]
    pub(crate) const fn new(tables: &'a Tables<'a>, (index, material): (usize, &Material)) -> Self {
        Self { tables, index, color: material.rgb() }
    }

    /// Its place in the table, from 0.
    #[must_use]
    pub const fn index(&self) -> usize {
        self.index
    }

    /// Its colour.
    #[inline(always)]
    #[must_use]
    pub const fn rgb(&self) -> Rgb888 {
        self.color
    }

    /// The same material in another colour.
    #[must_use]
    pub const fn recolored(self, color: Rgb888) -> Self {
        Self { color, ..self }
    }

    /// Its highlights, its own light and its opacity: [`Finish::MATTE`] if the mesh has none.
    #[inline(always)]
    #[must_use]
    pub fn finish(&self) -> Finish {
        self.tables.finishes.get(self.index).copied().unwrap_or_default()
    }
}
