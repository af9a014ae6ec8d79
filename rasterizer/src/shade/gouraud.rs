//! Light computed at the vertices and interpolated between them.

use embedded_graphics_core::pixelcolor::Rgb888;
use fixed::types::U16F16;

use super::{
    CodeSize, Light, Lighting, Ramp, Shader,
    lighting::{Lit, vertex_level},
};
use crate::{
    geometry::ObjectView,
    mesh::{MeshMaterial, MeshVertex, RequiredTables},
    raster::Fragment,
};

/// The material's colour, lit at the vertices (Gouraud, *Continuous Shading of Curved Surfaces*,
/// 1971). Needs [`vertex_normals`](crate::mesh::Tables::vertex_normals).
///
/// The level is interpolated linearly on the screen, not in space: over a triangle whose corners'
/// distances from the camera differ by a factor r, it is off by at most (√r - 1) / (√r + 1) of the
/// difference between the corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Gouraud<C, const LEVELS: usize = 64, L = Light>(Lit<C, L>);

impl<C, L> Gouraud<C, 64, L> {
    /// Lit by `light`, in 64 levels.
    #[must_use]
    pub const fn new(light: L) -> Self {
        Self::with_levels(light)
    }
}

impl<C, const LEVELS: usize, L> Gouraud<C, LEVELS, L> {
    /// Lit by `light`, in `LEVELS` levels, a power of two.
    #[must_use]
    pub const fn with_levels(light: L) -> Self {
        Self(Lit::by(light))
    }
}

impl<C: Copy + From<Rgb888>, const LEVELS: usize, L: Lighting> Shader for Gouraud<C, LEVELS, L> {
    type Color = C;
    /// The place of the light level in the ramp.
    type Varyings = [u16; 1];
    type Surface = Ramp<C, LEVELS>;
    type Face = ();
    type Outcome = C;

    const CODE: CodeSize = CodeSize::Small;

    const TABLES: RequiredTables = RequiredTables { vertex_normals: true, ..RequiredTables::NONE };

    #[inline(always)]
    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self(self.0.for_object(view))
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        Ramp::between(Rgb888::new(0, 0, 0), material.rgb())
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 1] {
        [Ramp::<C, LEVELS>::varying(vertex_level(&self.0.light, vertex))]
    }

    #[inline(always)]
    fn pixel(&self, surface: &Self::Surface, (): &(), fragment: Fragment<[U16F16; 1]>) -> C {
        let [level] = fragment.varyings;
        surface.at(level)
    }
}
