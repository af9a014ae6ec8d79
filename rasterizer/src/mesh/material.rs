//! A material as a shader sees it.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::{Finish, Material, Tables};

/// A material of a mesh. Each method reads its table when it is called.
#[derive(Clone, Copy, Debug)]
pub struct MeshMaterial<'a> {
    tables: &'a Tables<'a>,
    index: usize,
    /// In place of the table's.
    color: Option<Rgb888>,
}

impl<'a> MeshMaterial<'a> {
    #[inline(always)]
    pub(crate) const fn new(tables: &'a Tables<'a>, index: usize) -> Self {
        Self { tables, index, color: None }
    }

    /// Its place in the table, from 0.
    #[must_use]
    pub const fn index(&self) -> usize {
        self.index
    }

    /// Its colour.
    #[inline(always)]
    #[must_use]
    pub fn rgb(&self) -> Rgb888 {
        let of_table =
            || self.tables.materials.get(self.index).map(Material::rgb).unwrap_or_default();
        self.color.unwrap_or_else(of_table)
    }

    /// The same material in another colour.
    #[must_use]
    pub const fn recolored(self, color: Rgb888) -> Self {
        Self { color: Some(color), ..self }
    }

    /// Its highlights, its own light and its opacity: [`Finish::MATTE`] if the mesh has none.
    #[inline(always)]
    #[must_use]
    pub fn finish(&self) -> Finish {
        self.tables.finishes.get(self.index).copied().unwrap_or_default()
    }
}
