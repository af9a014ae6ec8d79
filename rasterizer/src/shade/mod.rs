//! What a covered pixel becomes.
//!
//! A [`Shader`] is resolved at compile time: the loop over a span's pixels is built for it alone.
//! It works in three steps, each as rarely as possible: a material becomes a *surface* once for its
//! run of triangles, a vertex gets its *varyings* once a frame, and a pixel its colour from the
//! surface and the interpolated varyings; or the whole *face* has one.
//!
//! Colours are worked out in the values that pictures store, without a gamma curve, as small
//! displays expect.

mod flat;
mod gouraud;
mod light;
mod lit;
mod ramp;

use embedded_graphics_core::pixelcolor::PixelColor;
pub use flat::{Flat, Unlit};
pub use gouraud::Gouraud;
pub use light::{Level, Light};
pub use ramp::Ramp;

use crate::{
    geometry::{Pose, Varyings},
    mesh::{Material, MeshFace, MeshVertex, RequiredTables},
    raster::Interpolate,
};

/// A way to colour a mesh.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// use fixed::types::U16F16;
/// use rasterizer::{
///     mesh::{Material, MeshVertex},
///     shade::Shader,
/// };
///
/// /// White stripes across the material's colour.
/// #[derive(Clone)]
/// struct Stripes;
///
/// impl Shader for Stripes {
///     type Color = Rgb565;
///     type Varyings = [u16; 1];
///     type Surface = Rgb565;
///     fn surface(&self, material: &Material) -> Rgb565 {
///         material.rgb().into()
///     }
///     fn vertex(&self, vertex: &MeshVertex) -> [u16; 1] {
///         [vertex.position()[1] as u16 ^ 0x8000]
///     }
///     fn pixel(&self, surface: &Rgb565, [height]: [U16F16; 1]) -> Rgb565 {
///         if height.to_bits() >> 29 & 1 == 0 { *surface } else { Rgb565::WHITE }
///     }
/// }
/// ```
pub trait Shader: Clone {
    /// The colour type of the target.
    type Color: PixelColor;
    /// What is interpolated from the vertices: an array of `u16`, empty if nothing is.
    type Varyings: Varyings + Interpolate;
    /// What a material becomes, worked out once for its run of triangles.
    type Surface;

    /// The tables of the mesh that it reads; drawing a mesh without them is an error.
    const TABLES: RequiredTables = RequiredTables::NONE;

    /// The shader for an object in this pose, with its directions in object space.
    #[must_use]
    fn in_object_space(&self, _pose: &Pose) -> Self {
        self.clone()
    }

    /// What a material becomes.
    fn surface(&self, material: &Material) -> Self::Surface;

    /// The varyings of a vertex.
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings;

    /// The colour of a whole triangle, if it has a single one; [`pixel`](Self::pixel) is then not
    /// asked.
    #[inline(always)]
    fn face(&self, _surface: &Self::Surface, _face: &MeshFace<'_>) -> Option<Self::Color> {
        None
    }

    /// The colour of a pixel. A varying of 16 bits arrives in Q16.16, half a unit above its
    /// interpolated value.
    fn pixel(
        &self,
        surface: &Self::Surface,
        varyings: <Self::Varyings as Interpolate>::Sample,
    ) -> Self::Color;
}
