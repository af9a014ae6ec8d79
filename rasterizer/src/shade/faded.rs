//! A shader whose pixels have an alpha that vertices give.

use fixed::types::U16F16;

use super::{CodeSize, Face, InnerPixel, OnScreen, Outcome, Sample, Shader, inner};
use crate::{
    color::Alpha,
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
};

/// Another shader, with an alpha that a function of the vertex gives, interpolated linearly on the
/// screen: a beam that fades along its way, water that is clear at the shore, an outline that
/// dissolves.
///
/// The alpha is for a blending mode such as [`Over`](crate::output::Over), and is multiplied by
/// that of the shader's own pixels. With [`Replace`](crate::output::Replace), pixels below half are
/// discarded. It takes a varying of 16 bits; over a triangle it is off by half a unit of 256.
///
/// ```
/// use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{mesh::Mesh, prelude::*};
/// use rasterizer::{color::Alpha, mesh::MeshVertex, output::Add, shade::Faded};
///
/// /// Bright at the lower end, y = -32,767 in the mesh's quanta, and gone at the upper.
/// fn along(vertex: &MeshVertex<'_>) -> Alpha {
///     let [_, y, _] = vertex.position();
///     Alpha::from_bits(((32_767 - i32::from(y)) >> 8) as u16)
/// }
///
/// # fn beam<'a>(mesh: &'a Mesh<'a>) {
/// let beam = Object::new(mesh, Faded::new(Unlit::<Rgb565>::new(), along));
/// let beam = beam.blended(Add(Alpha::OPAQUE));
/// # let _ = beam;
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Faded<Sh, F> {
    shader: Sh,
    alpha: F,
}

impl<Sh: Shader, F: Fn(&MeshVertex<'_>) -> Alpha + Clone> Faded<Sh, F> {
    /// A shader with this alpha.
    #[must_use]
    pub const fn new(shader: Sh, alpha: F) -> Self {
        Self { shader, alpha }
    }
}

/// The digits of a varying behind those of its alpha: 256 is 2^15.
const SPARE_BITS: u32 = 7;

impl<Sh: Shader, F: Fn(&MeshVertex<'_>) -> Alpha + Clone> Shader for Faded<Sh, F> {
    type Color = Sh::Color;
    type Varyings = (Sh::Varyings, [u16; 1]);
    type Surface = Sh::Surface;
    type Face = Face<Sh::Color, Sh::Face>;
    type Outcome = FadedPixel<Sh::Color, Sh::Outcome>;

    const CODE: CodeSize = Sh::CODE.max(CodeSize::Medium);

    const TABLES: RequiredTables = Sh::TABLES;

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self { shader: self.shader.for_object(view), alpha: self.alpha.clone() }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Sh::Surface {
        self.shader.surface(material)
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        let alpha = (self.alpha)(vertex).to_bits() << SPARE_BITS;
        (self.shader.vertex(vertex), [alpha])
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Sh::Surface,
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Sh::Color, Self::Face> {
        Face::Shaded(self.shader.face(surface, face, &gradients.part(|(own, _)| own)))
    }

    #[inline(always)]
    fn pixel(
        &self,
        surface: &Sh::Surface,
        face: &Self::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Self::Outcome {
        self.pixels(surface, *face)(fragment)
    }

    #[inline(always)]
    fn pixels(
        &self,
        surface: &Sh::Surface,
        face: Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Self::Outcome + Copy {
        let pixel = inner::pixels(&self.shader, surface, face);
        move |fragment| {
            let (varyings, [alpha]) = fragment.varyings;
            let Fragment { depth, column, row, .. } = fragment;
            let pixel = pixel(Fragment { varyings, depth, column, row });
            FadedPixel { pixel, alpha: at(alpha) }
        }
    }
}

/// The alpha of an interpolated varying, which is half a unit above its value.
#[inline(always)]
const fn at(varying: U16F16) -> Alpha {
    const DROP: u32 = 16 + SPARE_BITS;
    // What interpolation is off is far below half a unit.
    Alpha::of(((varying.to_bits() + (1 << (DROP - 1))) >> DROP) as u16)
}

/// A pixel of [`Faded`].
#[derive(Clone, Copy, Debug)]
pub struct FadedPixel<C, O> {
    pixel: InnerPixel<C, O>,
    alpha: Alpha,
}

impl<C, O: Outcome<C>> Outcome<C> for FadedPixel<C, O> {
    const DISCARDS: bool = true;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;
    const HAS_ALPHA: bool = true;

    #[inline(always)]
    fn color(self) -> Option<C> {
        self.layer().filter(|(_, alpha)| alpha.is_half()).map(|(color, _)| color)
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        let (color, alpha) = self.pixel.layer()?;
        let alpha = if O::HAS_ALPHA { alpha.scaled(self.alpha) } else { self.alpha };
        (alpha > Alpha::CLEAR).then_some((color, alpha))
    }
}
