//! A material as a shader sees it.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::Material;

/// A material of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MeshMaterial<'a> {
    material: &'a Material,
    index: usize,
}

impl<'a> MeshMaterial<'a> {
    pub(crate) const fn new(material: &'a Material, index: usize) -> Self {
        Self { material, index }
    }

    /// Its place in the table, from 0.
    #[must_use]
    pub const fn index(&self) -> usize {
        self.index
    }

    /// Its colour.
    #[must_use]
    pub const fn rgb(&self) -> Rgb888 {
        self.material.rgb()
    }
}
