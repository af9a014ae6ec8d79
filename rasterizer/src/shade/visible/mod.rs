//! Which triangle is seen at a pixel, and where in it.

mod deferred;
mod pixel;

use core::marker::PhantomData;

pub use deferred::{Deferred, DeferredPixel};
pub use pixel::{Visible, VisiblePixel, VisibleTriangle};

use super::{Face, OnScreen, Sample, Shader};
use crate::{
    attribute::{Correction, EveryPixel, PerspectiveCorrect, Weights},
    mesh::{MeshFace, MeshMaterial, MeshVertex},
    raster::{Fragment, Gradients},
};

/// Draws a visibility buffer: a [`Frame`](crate::output::Frame) of [`VisiblePixel`]s with depth.
///
/// What it is for: the triangle under a touch point, whose place in the mesh and on its surface are
/// known; a highlight of one object; shading each visible pixel once, after all triangles
/// ([`Deferred`]), for which [`without_weights`](Self::without_weights) is enough.
///
/// Coordinates are linear in space, or by the mode `M`, such as
/// [`Affine`](crate::attribute::Affine), linear on the screen: in each part of a triangle that is
/// clipped. They are within half a unit of exact, and in space r 2<sup>-11</sup> +
/// w / near 2<sup>-16</sup> + 2<sup>-10</sup> more, where r is the ratio of the largest 1 / w of a
/// triangle's corners to the least, and w the largest; on the screen, 1/64 more. The third, which
/// is a difference, is within twice that.
///
/// ```
/// use embedded_graphics_core::{prelude::*, primitives::Rectangle};
/// # use rasterizer::{
/// #     mesh::{Material, Mesh, Positions, Tables, Triangles},
/// #     numbers::Vec3,
/// #     prelude::*,
/// # };
/// use rasterizer::shade::{Visibility, VisiblePixel};
///
/// # static SQUARE: Mesh<'static> = Mesh::new_const(Tables {
/// #     positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
/// #     triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
/// #     materials: &[Material::new([255, 160, 0], 2)],
/// #     ..Tables::EMPTY
/// # });
/// # let display = Rectangle::new(Point::zero(), Size::new(16, 16));
/// # let lens = Perspective::new(Turn::degrees(60), Distance::lit("0.1"), Distance::lit("9"))?;
/// # let camera = Camera::look_at(Vec3::lit("0", "0", "3"), Vec3::ZERO, Vec3::Y, lens, display)?;
/// # let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; 4];
/// let (mut seen, mut depth) = ([VisiblePixel::NONE; 16 * 16], [0u16; 16 * 16]);
/// let mut frame = Frame::new(&mut seen, &mut depth, display)?;
/// Object::new(&SQUARE, Visibility::of_object(7)).draw(&camera, &mut vertices, &mut frame)?;
///
/// // The square has two triangles, and the finger is on the lower right one.
/// let touched = frame.pixels()[9 * 16 + 9];
/// assert_eq!((touched.object(), touched.triangle()), (Some(7), 0));
/// // In its middle: a third of each corner, within a fifth of a pixel.
/// assert!(touched.weights().iter().all(|weight| weight.abs_diff(65_535 / 3) < 2_000));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Visibility<M = EveryPixel> {
    object: u8,
    mode: PhantomData<M>,
}

impl Visibility {
    /// The triangles of an object with this number, 0 to 254, with coordinates linear in space.
    #[must_use]
    pub const fn of_object(number: u8) -> Self {
        Self { object: number, mode: PhantomData }
    }
}

impl<M> Visibility<M> {
    /// Corrected in another way.
    #[must_use]
    pub const fn corrected<N: Correction>(self, _: N) -> Visibility<N> {
        Visibility { object: self.object, mode: PhantomData }
    }

    /// Without coordinates: draws [`VisibleTriangle`]s, of half the size, as fast as [`Unlit`]
    /// draws colours.
    ///
    /// [`Unlit`]: super::Unlit
    #[must_use]
    pub const fn without_weights(self) -> Visibility<NoWeights> {
        Visibility { object: self.object, mode: PhantomData }
    }
}

/// No coordinates: see [`Visibility::without_weights`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NoWeights;

impl Shader for Visibility<NoWeights> {
    type Color = VisibleTriangle;
    type Varyings = [u16; 0];
    type Surface = ();
    type Face = VisibleTriangle;
    type Outcome = VisibleTriangle;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    #[inline(always)]
    fn vertex(&self, _: &MeshVertex<'_>) -> [u16; 0] {
        []
    }

    #[inline(always)]
    fn face(
        &self,
        (): &(),
        face: &MeshFace<'_>,
        _: &Gradients<'_, [u16; 0]>,
    ) -> Face<VisibleTriangle, VisibleTriangle> {
        Face::Solid(VisibleTriangle::new(self.object, face.index()))
    }

    #[inline(always)]
    fn pixel(
        &self,
        (): &(),
        &seen: &VisibleTriangle,
        _: Fragment<Sample<Self>>,
    ) -> VisibleTriangle {
        seen
    }
}

impl<M: Correction> Shader for Visibility<M> {
    type Color = VisiblePixel;
    type Varyings = PerspectiveCorrect<Weights, M>;
    type Surface = ();
    type Face = VisibleTriangle;
    type Outcome = VisiblePixel;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    #[inline(always)]
    fn vertex(&self, _: &MeshVertex<'_>) -> Self::Varyings {
        PerspectiveCorrect::new(Weights::VERTEX)
    }

    #[inline(always)]
    fn face(
        &self,
        (): &(),
        face: &MeshFace<'_>,
        _: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<VisiblePixel, VisibleTriangle> {
        Face::Shaded(VisibleTriangle::new(self.object, face.index()))
    }

    #[inline(always)]
    fn pixel(
        &self,
        (): &(),
        &seen: &VisibleTriangle,
        fragment: Fragment<Sample<Self>>,
    ) -> VisiblePixel {
        VisiblePixel::new(seen, fragment.varyings.value.map(to_q16))
    }
}

/// From Q0.32, where 2^32 - 1 stands for 1, to the nearest of Q0.16, where 65,535 does: times
/// 65,535 / 65,536.
#[inline(always)]
const fn to_q16(weight: u32) -> u16 {
    ((weight - (weight >> 16) + (1 << 15)) >> 16) as u16
}
