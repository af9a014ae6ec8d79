//! One colour a triangle.

use core::marker::PhantomData;

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use fixed::types::U16F16;

use super::{
    Face, Light, Lighting, Shader,
    lighting::{Lit, face_level},
};
use crate::{
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
};

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

impl<C: Copy + From<Rgb888>> Shader for Unlit<C> {
    type Color = C;
    type Varyings = [u16; 0];
    type Surface = C;
    type Face = ();
    type Outcome = C;

    fn surface(&self, material: &MeshMaterial<'_>) -> C {
        C::from(material.rgb())
    }

    #[inline(always)]
    fn vertex(&self, _: &MeshVertex<'_>) -> [u16; 0] {
        []
    }

    #[inline(always)]
    fn face(&self, surface: &C, _: &MeshFace<'_>, _: &Gradients<'_, [u16; 0]>) -> Face<C, ()> {
        Face::Solid(*surface)
    }

    #[inline(always)]
    fn pixel(&self, surface: &C, (): &(), _: Fragment<[U16F16; 0]>) -> C {
        *surface
    }
}

/// The material's colour, lit by the normal of the triangle, and by a [`Lamp`](super::Lamp) at its
/// middle. Needs [`face_normals`](crate::mesh::Tables::face_normals).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Flat<C, L = Light>(Lit<C, L>);

impl<C, L> Flat<C, L> {
    /// Lit by `light`.
    #[must_use]
    pub const fn new(light: L) -> Self {
        Self(Lit::by(light))
    }

    /// Its light.
    #[must_use]
    pub const fn light(&self) -> &L {
        &self.0.light
    }
}

impl<C: Copy + From<Rgb888>, L: Lighting> Shader for Flat<C, L> {
    type Color = C;
    type Varyings = [u16; 0];
    type Surface = Rgb888;
    type Face = ();
    type Outcome = C;

    const TABLES: RequiredTables = RequiredTables { face_normals: true, ..RequiredTables::NONE };

    #[inline(always)]
    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self(self.0.for_object(view))
    }

    #[inline(always)]
    fn surface(&self, material: &MeshMaterial<'_>) -> Rgb888 {
        material.rgb()
    }

    #[inline(always)]
    fn vertex(&self, _: &MeshVertex<'_>) -> [u16; 0] {
        []
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Rgb888,
        face: &MeshFace<'_>,
        _: &Gradients<'_, [u16; 0]>,
    ) -> Face<C, ()> {
        Face::Solid(scaled_color(*surface, face_level(&self.0.light, face)))
    }

    #[inline(always)]
    fn pixel(&self, surface: &Rgb888, (): &(), _: Fragment<[U16F16; 0]>) -> C {
        C::from(*surface)
    }
}

/// A colour at a brightness in Q16, 0 to 65,536, each channel rounded to the nearest.
// codegen: not inlined, because the loop over triangles needs its registers.
#[inline(never)]
pub(super) fn scaled_color<C: From<Rgb888>>(color: Rgb888, level: u32) -> C {
    let channel = |full: u8| ((u32::from(full) * level + (1 << 15)) >> 16) as u8;
    C::from(Rgb888::new(channel(color.r()), channel(color.g()), channel(color.b())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_rounded_to_the_nearest() {
        for full in 0..=255u8 {
            for level in (0..=65_536u32).step_by(257).chain([1, 65_535, 65_536]) {
                let color: Rgb888 = scaled_color(Rgb888::new(full, 255 - full, 7), level);
                for (full, got) in [(full, color.r()), (255 - full, color.g()), (7, color.b())] {
                    let exact = f64::from(full) * f64::from(level) / 65_536.0;
                    assert!((f64::from(got) - exact).abs() <= 0.5, "{full} at {level}: {got}");
                }
            }
        }
    }
}
