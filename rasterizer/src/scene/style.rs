//! How lines and points of an object are drawn.

use fixed::types::U0F32;

use crate::{
    attribute::{DepthFormat, Interpolate},
    geometry::ScreenVertex,
    mesh::{Material, MeshMaterial, Tables},
    numbers::Subpixel,
};

/// What lines and points share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// The width of lines and the size of points, in pixels.
    pub(super) pixels: u8,
    /// By how much depth they are moved towards the viewer.
    pub(super) nearer: U0F32,
    /// The place of their material in the mesh's table.
    pub(super) material: usize,
}

impl Style {
    pub(super) const PLAIN: Self = Self { pixels: 1, nearer: U0F32::ZERO, material: 0 };

    /// The material and its place; a black one if the mesh has none there.
    pub(super) fn material<'a>(&self, tables: &Tables<'a>) -> (usize, &'a Material) {
        const BLACK: &Material = &Material::new([0; 3], 0);
        (self.material, tables.materials.get(self.material).unwrap_or(BLACK))
    }

    /// The same as a blending mode takes it.
    pub(super) fn mesh_material<'a>(&self, tables: &'a Tables<'a>) -> MeshMaterial<'a> {
        MeshMaterial::new(tables, self.material(tables))
    }

    /// A vertex in its new depth.
    pub(super) fn moved<S: Subpixel, D: DepthFormat, V: Interpolate>(
        &self,
        vertex: ScreenVertex<S, D, V>,
    ) -> ScreenVertex<S, D, V> {
        if self.nearer == U0F32::ZERO {
            return vertex;
        }
        let depth = vertex.depth.to_fraction().saturating_add(self.nearer);
        ScreenVertex::new(vertex.x, vertex.y, D::from_fraction(depth.to_bits()), vertex.varyings)
    }
}
