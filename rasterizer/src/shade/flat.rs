//! One colour a triangle.

use core::marker::PhantomData;

use embedded_graphics_core::pixelcolor::{PixelColor, Rgb888};

use super::{Light, MeshFace, MeshVertex, Ramp, RequiredTables, Shader, lit::Lit};
use crate::{geometry::Pose, mesh::Material};

/// The material's colour, unlit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Unlit<C>(PhantomData<C>);

impl<C> Unlit<C> {
    /// The material's colour, unlit.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<C: PixelColor + From<Rgb888>> Shader for Unlit<C> {
    type Color = C;
    type Varyings = [u16; 0];
    type Surface = C;

    fn surface(&self, material: &Material) -> C {
        C::from(material.rgb())
    }

    #[inline(always)]
    fn vertex(&self, _: &MeshVertex<'_>) -> [u16; 0] {
        []
    }

    #[inline(always)]
    fn face(&self, surface: &C, _: &MeshFace<'_>) -> Option<C> {
        Some(*surface)
    }

    #[inline(always)]
    fn pixel(&self, surface: &C, []: [fixed::types::U16F16; 0]) -> C {
        *surface
    }
}

/// The material's colour, lit by the normal of the triangle. Needs [`face_normals`](crate::mesh::Tables::face_normals).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Flat<C, const LEVELS: usize = 64>(Lit<C, LEVELS>);

impl<C> Flat<C> {
    /// Lit by `light`, in 64 levels.
    #[must_use]
    pub const fn new(light: Light) -> Self {
        Self::with_levels(light)
    }
}

impl<C, const LEVELS: usize> Flat<C, LEVELS> {
    /// Lit by `light`, in `LEVELS` levels, a power of two.
    #[must_use]
    pub const fn with_levels(light: Light) -> Self {
        Self(Lit::by(light))
    }

    /// Its light.
    #[must_use]
    pub const fn light(&self) -> &Light {
        &self.0.light
    }
}

impl<C: PixelColor + From<Rgb888>, const LEVELS: usize> Shader for Flat<C, LEVELS> {
    type Color = C;
    type Varyings = [u16; 0];
    type Surface = Ramp<C, LEVELS>;

    const TABLES: RequiredTables = RequiredTables {
        face_normals: true,
        ..RequiredTables::NONE
    };

    fn in_object_space(&self, pose: &Pose) -> Self {
        Self(self.0.in_object_space(pose))
    }

    fn surface(&self, material: &Material) -> Self::Surface {
        Lit::ramp(material)
    }

    #[inline(always)]
    fn vertex(&self, _: &MeshVertex<'_>) -> [u16; 0] {
        []
    }

    #[inline(always)]
    fn face(&self, surface: &Self::Surface, face: &MeshFace<'_>) -> Option<C> {
        Some(surface.nearest(self.0.light.level(face.normal())))
    }

    #[inline(always)]
    fn pixel(&self, surface: &Self::Surface, []: [fixed::types::U16F16; 0]) -> C {
        surface.nearest(1 << 16)
    }
}
