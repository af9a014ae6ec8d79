//! A target whose pixels are drawn once each.

use core::{cell::Cell, marker::PhantomData};

use super::{FrameError, Readable, Target};
use crate::{
    color::Alpha,
    raster::{FragmentOf, Primitive, Window},
    shade::{CodeSize, Outcome},
};

/// Another target of which each pixel is drawn once: what comes later leaves it. So a shadow that
/// is blended does not become darker where triangles of it overlap, and a translucent object does
/// not show its own parts.
///
/// It keeps a bit for each pixel of the target, which is set when the pixel is drawn: not where it
/// fails the depth test or the shader discards it. [`Once::new`] clears the bits: make one for each
/// object, or for several that count as one.
///
/// ```
/// # use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{mesh::Mesh, prelude::*};
/// use core::cell::Cell;
/// use rasterizer::{color::Alpha, output::{KeepDepth, Once, Over}};
///
/// # fn draw(
/// #     mesh: &Mesh<'_>, flat: Flat<Rgb565>, camera: &Camera,
/// #     vertices: &mut [ScreenVertex<S4, u16, [u16; 0]>],
/// #     frame: &mut Frame<'_, Rgb565, &mut [u16]>,
/// # ) -> Result<(), Box<dyn core::error::Error>> {
/// // A bit for each of 240 x 240 pixels.
/// let bits = [const { Cell::new(0) }; Once::<()>::words(240 * 240)];
/// let ghost = Object::new(mesh, flat).blended(KeepDepth(Over(Alpha::lit("0.4"))));
/// ghost.draw(camera, vertices, &mut Once::new(frame, &bits)?)?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Once<'t, T> {
    target: &'t mut T,
    bits: &'t [Cell<u32>],
    window: Window,
}

impl Once<'_, ()> {
    /// The words that it takes for this many pixels.
    #[must_use]
    pub const fn words(pixels: usize) -> usize {
        pixels.div_ceil(32)
    }
}

impl<'t, T: Target> Once<'t, T> {
    /// With no pixel drawn. The bits are those of the target's window, such as a band's.
    ///
    /// # Errors
    ///
    /// Returns [`FrameError::PackedLength`] if there are too few.
    pub fn new(target: &'t mut T, bits: &'t [Cell<u32>]) -> Result<Self, FrameError> {
        let window = target.window();
        let Window { left, top, right, bottom } = window;
        let pixels = if window.is_empty() { 0 } else { (right - left) * (bottom - top) };
        let words = Once::words(pixels as usize);
        let bits = bits.get(..words).ok_or(FrameError::PackedLength { needed: words * 4 })?;
        for word in bits {
            word.set(0);
        }
        Ok(Self { target, bits, window })
    }
}

/// The bits of a window's pixels.
#[derive(Clone, Copy)]
struct Bits<'t> {
    bits: &'t [Cell<u32>],
    window: Window,
}

impl Bits<'_> {
    /// Sets a pixel's bit. Returns whether it is the first time.
    #[inline(always)]
    fn take(&self, column: i32, row: i32) -> bool {
        let Some(index) = self.window.index_of(column, row) else { return false };
        let Some(word) = self.bits.get(index / 32) else { return false };
        let bit = 1 << (index % 32);
        let before = word.get();
        word.set(before | bit);
        before & bit == 0
    }
}

impl<T: Target> Once<'_, T> {
    const fn parts(&mut self) -> (&mut T, Bits<'_>) {
        (self.target, Bits { bits: self.bits, window: self.window })
    }
}

impl<T: Target> Target for Once<'_, T> {
    type Color = T::Color;
    type Depth = T::Depth;
    type Error = T::Error;

    fn window(&self) -> Window {
        self.window
    }

    #[inline(always)]
    fn shade<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        let (target, bits) = self.parts();
        target.shade(primitive, window, move |fragment| {
            let (column, row) = (fragment.column, fragment.row);
            First { outcome: pixel(fragment), bits, column, row, color: PhantomData }
        })
    }
}

impl<T: Readable> Readable for Once<'_, T> {
    #[inline(always)]
    fn blend<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(T::Color, FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        let (target, bits) = self.parts();
        target.blend(primitive, window, move |stored, fragment| {
            let (column, row) = (fragment.column, fragment.row);
            First { outcome: pixel(stored, fragment), bits, column, row, color: PhantomData }
        })
    }
}

/// An outcome that counts if it is the pixel's first one that is not discarded.
struct First<'t, C, O> {
    outcome: O,
    bits: Bits<'t>,
    column: i32,
    row: i32,
    color: PhantomData<C>,
}

impl<C, O: Outcome<C>> Outcome<C> for First<'_, C, O> {
    const DISCARDS: bool = true;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;
    const HAS_ALPHA: bool = O::HAS_ALPHA;
    const CODE: CodeSize = O::CODE;

    #[inline(always)]
    fn color(self) -> Option<C> {
        let Self { outcome, bits, column, row, .. } = self;
        outcome.color().filter(|_| bits.take(column, row))
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        let Self { outcome, bits, column, row, .. } = self;
        outcome.layer().filter(|_| bits.take(column, row))
    }
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use embedded_graphics_core::{
        geometry::{Point, Size},
        pixelcolor::{Gray8, GrayColor as _},
        primitives::Rectangle,
    };

    use super::*;
    use crate::{
        geometry::ScreenVertex,
        numbers::S4,
        output::{Add, Blending as _, Frame, KeepDepth},
        raster::Triangle,
    };

    /// Two triangles that overlap add one step where either is, unless depth hides it, and the
    /// second one is seen where the first one is hidden.
    #[test]
    fn pixels_are_blended_once() {
        let area = Rectangle::new(Point::new(-2, 3), Size::new(7, 6));
        let (mut color, mut depth) = ([Gray8::new(0); 42], [0u16; 42]);
        // The left columns are nearer than the first triangle, the right ones than the second.
        for row in depth.as_chunks_mut::<7>().0 {
            (row[0], row[6]) = (150, 250);
        }
        let bits = [const { Cell::new(u32::MAX) }; Once::<()>::words(42)];
        let mut frame = Frame::new(&mut color, &mut depth, area).unwrap();
        assert!(Once::new(&mut frame, &bits[..1]).is_err());
        let mut once = Once::new(&mut frame, &bits).unwrap();
        let window = once.window();
        for depth in [100u16, 200] {
            let vertex = |x: i32, y: i32| ScreenVertex::<S4, u16, [u16; 0]>::new(x, y, depth, []);
            let corners = [vertex(-400, -400), vertex(900, -400), vertex(-400, 900)];
            let triangle = Triangle::new(corners.each_ref()).unwrap();
            let add = KeepDepth(Add(Alpha::OPAQUE));
            let Ok(()) = add.shade(&mut once, &triangle, &window, |_| Gray8::new(1));
        }
        for row in color.as_chunks::<7>().0 {
            assert_eq!(row.map(|color| color.luma()), [1, 1, 1, 1, 1, 1, 0]);
        }
    }
}
