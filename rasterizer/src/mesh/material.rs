//! A material as a shader sees it.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::{Material, Tables};

/// A material of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshMaterial<'a> {
    tables: &'a Tables<'a>,
    index: usize,
}

impl<'a> MeshMaterial<'a> {
    pub(crate) const fn new(tables: &'a Tables<'a>, index: usize) -> Self {
        Self { tables, index }
    }

    /// Its place in the table, from 0.
    #[must_use]
    pub const fn index(&self) -> usize {
        self.index
    }

    /// Its colour; black if there is no such material.
    #[must_use]
    pub fn rgb(&self) -> Rgb888 {
        self.tables.materials.get(self.index).map_or(Rgb888::new(0, 0, 0), Material::rgb)
    }
}
