//! The colours of covered pixels.
//!
//! A [`Shader`] is resolved at compile time: the loop over a span's pixels is compiled for it
//! alone. It works in steps, each as rarely as possible: it computes a *surface* once for a
//! material's run of triangles, *varyings* once per vertex, a *face* once per triangle, and a
//! colour for each pixel from surface, face and interpolated varyings. Or it gives the whole face
//! one colour.
//!
//! Colours are computed in the values that pictures store, without a gamma curve, as small displays
//! expect.

mod colored;
mod dithered;
mod faded;
mod finished;
mod flat;
mod fog;
mod glossy_gouraud;
mod gouraud;
mod inner;
mod lighting;
mod phong;
mod ramp;
mod recolored;
#[cfg(test)]
mod scenes;
mod shaded;
mod sprite;
mod textured;
mod visible;

pub use colored::{Colored, ColoredGouraud};
pub use dithered::{Dithered, DitheredPixel};
pub use faded::{Faded, FadedPixel};
pub use flat::{Flat, Unlit};
#[doc(hidden)]
pub use fog::SeenFog;
pub use fog::{AtPixels, AtVertices, Density, Fog, FogMode, Fogged};
pub use glossy_gouraud::GlossyGouraud;
pub use gouraud::Gouraud;
pub use inner::InnerPixel;
pub use lighting::{FarViewer, Lamp, Level, Light, Lighting, NearViewer, ViewedFrom};
pub use phong::{Phong, PhongCorrection};
pub use ramp::Ramp;
pub use recolored::Recolored;
pub(crate) use shaded::Shaded;
pub use sprite::{Frames, Sprite, Squares, TintedFrames};
pub use textured::{
    Covered, Matcap, Slot, Textured, TexturedFlat, TexturedGouraud, VertexCoordinates,
};
pub use visible::{
    Deferred, DeferredPixel, NoWeights, Visibility, Visible, VisiblePixel, VisibleTriangle,
};

pub use crate::texture::{CodeSize, Layer, Outcome};
use crate::{
    attribute::{Interpolate, Varyings},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
};

/// A way to colour a mesh.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// use fixed::types::I16F16;
/// use rasterizer::{
///     mesh::{MeshMaterial, MeshVertex},
///     raster::Fragment,
///     shade::Shader,
/// };
///
/// /// White stripes across the material's colour.
/// #[derive(Clone)]
/// struct Stripes;
///
/// impl Shader for Stripes {
///     type Color = Rgb565;
///     type Varyings = [i16; 1];
///     type Surface = Rgb565;
///     type Face = ();
///     type Outcome = Rgb565;
///
///     fn surface(&self, material: &MeshMaterial<'_>) -> Rgb565 {
///         material.rgb().into()
///     }
///
///     fn vertex(&self, vertex: &MeshVertex<'_>) -> [i16; 1] {
///         [vertex.position()[1]]
///     }
///
///     fn pixel(&self, surface: &Rgb565, (): &(), fragment: Fragment<[I16F16; 1]>) -> Rgb565 {
///         let [height] = fragment.varyings;
///         if height.to_bits() >> 29 & 1 == 0 { *surface } else { Rgb565::WHITE }
///     }
/// }
/// ```
pub trait Shader: Clone {
    /// The colour type of the target.
    type Color: Copy;
    /// What a vertex carries to the pixels: arrays and tuples of `u16`, `i16` and `u32`; `[u16; 0]`
    /// for nothing.
    type Varyings: Varyings;
    /// What is computed from a material, once for its run of triangles.
    type Surface;
    /// What is computed from a triangle before its pixels are drawn: `()` for most shaders.
    type Face: Default + Copy;
    /// The result for a pixel: the colour, an `Option` of it in a shader that discards pixels, or a
    /// [`Layer`] in one that gives each pixel an alpha.
    type Outcome: Outcome<Self::Color>;

    /// How much code [`pixel`](Self::pixel) takes: how many copies of it loops may have. It changes
    /// run time and flash, never the picture.
    const CODE: CodeSize = CodeSize::Large;

    /// The mesh tables that the shader reads. Drawing a mesh without one of them is an error.
    const TABLES: RequiredTables = RequiredTables::NONE;

    /// Returns the shader for an object as a camera sees it, with its directions in object space.
    /// Called once per projected object.
    #[inline(always)]
    #[must_use]
    fn for_object(&self, _view: &ObjectView<'_>) -> Self {
        self.clone()
    }

    /// Computes the surface of a material.
    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface;

    /// Computes the varyings of a vertex.
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings;

    /// Computes one colour for all of a triangle, or what its pixels are shaded with.
    #[inline(always)]
    fn face(
        &self,
        _surface: &Self::Surface,
        _face: &MeshFace<'_>,
        _gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Self::Color, Self::Face> {
        Face::Shaded(Self::Face::default())
    }

    /// Computes the colour of a pixel, or discards it. A varying of 16 bits arrives with 16 more
    /// behind the point, half a unit above its interpolated value, so that its integer part is
    /// rounded.
    fn pixel(
        &self,
        surface: &Self::Surface,
        face: &Self::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Self::Outcome;

    /// Returns [`pixel`](Self::pixel) for the pixels of one triangle. The loop over pixels keeps
    /// what it holds by value in registers: a shader that reads little of its surface at each pixel
    /// can take a copy of that here.
    #[inline(always)]
    fn pixels(
        &self,
        surface: &Self::Surface,
        face: Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Self::Outcome + Copy {
        move |fragment| self.pixel(surface, &face, fragment)
    }
}

/// The varyings of a shader's vertices on the screen.
pub type OnScreen<Sh> = <<Sh as Shader>::Varyings as Varyings>::OnScreen;

/// The varyings of a shader at a pixel.
pub type Sample<Sh> = <OnScreen<Sh> as Interpolate>::Sample;

/// What a shader makes of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Face<C, F> {
    /// One colour for all its pixels: [`Shader::pixel`] is not called.
    Solid(C),
    /// What its pixels are shaded with.
    Shaded(F),
}

impl<C, F: Default> Default for Face<C, F> {
    fn default() -> Self {
        Self::Shaded(F::default())
    }
}
