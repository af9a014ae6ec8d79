//! Which triangle is seen at a pixel, and where in it.

mod deferred;

use core::marker::PhantomData;

pub use deferred::{Deferred, DeferredPixel};

use super::{Face, OnScreen, Sample, Shader};
use crate::{
    attribute::{Correction, EveryPixel, PerspectiveCorrect, Weights},
    mesh::{MeshFace, MeshMaterial, MeshVertex},
    output::{PixelFill, StoredColor},
    raster::{Fragment, Gradients},
};

/// What is seen at a pixel of a visibility buffer (Burns and Hunt, *The Visibility Buffer*, JCGT
/// 2(2), 2013): an object, one of its triangles, and a place in it. 8 bytes.
///
/// A [`Frame`](crate::output::Frame) of these is drawn by [`Visibility`], and cleared to
/// [`NONE`](Self::NONE).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VisiblePixel {
    /// The object in the upper 8 bits, the triangle in the others.
    id: u32,
    weights: [u16; 2],
}

/// The bits of a triangle's number.
const TRIANGLE_BITS: u32 = 24;

impl VisiblePixel {
    /// The background.
    pub const NONE: Self = Self { id: u32::MAX, weights: [0; 2] };

    /// The object's number; `None` for the background.
    #[must_use]
    pub const fn object(self) -> Option<u8> {
        if self.id == u32::MAX { None } else { Some((self.id >> TRIANGLE_BITS) as u8) }
    }

    /// The triangle's place in the mesh's table, clipped or not; that of a mesh of more than
    /// 2<sup>24</sup> triangles, modulo that number.
    #[must_use]
    pub const fn triangle(self) -> usize {
        (self.id & ((1 << TRIANGLE_BITS) - 1)) as usize
    }

    /// The barycentric coordinates in the mesh's triangle: how much of its three corners, in Q0.16,
    /// where 65,535 stands for 1. The first two are rounded to the nearest unit, the third is what
    /// they leave of 65,535.
    #[must_use]
    pub const fn weights(self) -> [u16; 3] {
        let [first, second] = self.weights;
        [first, second, u16::MAX.saturating_sub(first).saturating_sub(second)]
    }

    /// The number of a triangle of an object.
    const fn id(object: u8, triangle: usize) -> u32 {
        (object as u32) << TRIANGLE_BITS | (triangle as u32 & ((1 << TRIANGLE_BITS) - 1))
    }
}

impl StoredColor for VisiblePixel {
    type Fill = PixelFill<Self>;
}

/// Draws a visibility buffer: a [`Frame`](crate::output::Frame) of [`VisiblePixel`]s with depth.
///
/// What it is for: the triangle under a touch point, whose place in the mesh and on its surface are
/// known; a highlight of one object; shading each visible pixel once, after all triangles
/// ([`Deferred`]).
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
}

impl<M: Correction> Shader for Visibility<M> {
    type Color = VisiblePixel;
    type Varyings = PerspectiveCorrect<Weights, M>;
    type Surface = ();
    type Face = u32;
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
    ) -> Face<VisiblePixel, u32> {
        Face::Shaded(VisiblePixel::id(self.object, face.index()))
    }

    #[inline(always)]
    fn pixel(&self, (): &(), &id: &u32, fragment: Fragment<Sample<Self>>) -> VisiblePixel {
        VisiblePixel { id, weights: fragment.varyings.value.map(to_q16) }
    }
}

/// From Q0.32, where 2^32 - 1 stands for 1, to the nearest of Q0.16, where 65,535 does: times
/// 65,535 / 65,536.
#[inline(always)]
const fn to_q16(weight: u32) -> u16 {
    ((weight - (weight >> 16) + (1 << 15)) >> 16) as u16
}
