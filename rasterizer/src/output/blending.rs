//! How a shader's colour and the stored one become the new one.

use super::{Readable, Target};
use crate::{
    mesh::MeshMaterial,
    raster::{FragmentOf, Primitive, Window},
    shade::{CodeSize, Outcome},
};

/// How the pixels of an object are put onto a target: [`Replace`], or where the target's pixels can
/// be read [`Over`](super::Over), [`Add`](super::Add), [`Multiply`](super::Multiply),
/// [`Screen`](super::Screen), or [`Blend`] by a function. [`KeepDepth`](super::KeepDepth) is any of
/// them that leaves the stored depth.
pub trait Blending<T: Target>: Copy {
    /// Returns it for the triangles of a material.
    #[inline(always)]
    #[must_use]
    fn of_material(self, _: &MeshMaterial<'_>) -> Self {
        self
    }

    /// Draws a primitive's pixels in a part of the target's window.
    ///
    /// # Errors
    ///
    /// Returns the target's error.
    fn shade<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        self,
        target: &mut T,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error>;

    /// Draws a primitive's pixels in a part of the target's window, all of one colour. By
    /// [`shade`](Self::shade), unless there is a shorter way.
    ///
    /// # Errors
    ///
    /// Returns the target's error.
    #[inline(always)]
    fn fill<Q: Primitive<Depth = T::Depth>>(
        self,
        target: &mut T,
        primitive: &Q,
        window: &Window,
        color: T::Color,
    ) -> Result<(), T::Error> {
        self.shade(target, primitive, window, move |_| color)
    }
}

/// The new colour replaces the stored one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Replace;

impl<T: Target> Blending<T> for Replace {
    #[inline(always)]
    fn shade<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        self,
        target: &mut T,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        target.shade(primitive, window, pixel)
    }

    #[inline(always)]
    fn fill<Q: Primitive<Depth = T::Depth>>(
        self,
        target: &mut T,
        primitive: &Q,
        window: &Window,
        color: T::Color,
    ) -> Result<(), T::Error> {
        target.fill(primitive, window, color)
    }
}

/// A function of the stored colour and the new one: `Blend(|stored, new| ...)`.
///
/// Each pixel is blended when it is drawn, so that the order of triangles matters: see-through
/// objects are drawn after those behind them. Depth is stored as with [`Replace`], and an alpha is
/// tested as there.
///
/// ```
/// use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{mesh::Mesh, output::Blend, prelude::*};
/// use embedded_graphics_core::pixelcolor::RgbColor as _;
///
/// /// The average of two colours, channel by channel.
/// fn average(stored: Rgb565, new: Rgb565) -> Rgb565 {
///     let channel = |a: u8, b: u8| ((u16::from(a) + u16::from(b)) / 2) as u8;
///     Rgb565::new(
///         channel(stored.r(), new.r()),
///         channel(stored.g(), new.g()),
///         channel(stored.b(), new.b()),
///     )
/// }
///
/// # fn glass<'a>(mesh: &'a Mesh<'a>, flat: Flat<Rgb565>) {
/// let glass = Object::new(mesh, flat).blended(Blend(average));
/// # let _ = glass;
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Blend<F>(pub F);

impl<T: Readable, F: Fn(T::Color, T::Color) -> T::Color + Copy> Blending<T> for Blend<F> {
    #[inline(always)]
    fn shade<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        self,
        target: &mut T,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        target.blend(primitive, window, move |stored, fragment| Blended {
            stored,
            new: pixel(fragment),
            by: self.0,
        })
    }
}

/// An outcome that is blended with the stored colour, unless it is discarded.
struct Blended<C, O, F> {
    stored: C,
    new: O,
    by: F,
}

impl<C, O: Outcome<C>, F: Fn(C, C) -> C> Outcome<C> for Blended<C, O, F> {
    const DISCARDS: bool = O::DISCARDS;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;
    const CODE: CodeSize = O::CODE.max(CodeSize::Medium);

    #[inline(always)]
    fn color(self) -> Option<C> {
        self.new.color().map(|new| (self.by)(self.stored, new))
    }
}
