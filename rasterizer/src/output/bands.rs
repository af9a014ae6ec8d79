//! A part of the display drawn and sent band by band, in memory for one band.

use core::{convert::Infallible, marker::PhantomData, mem};

use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{Point, Size},
    pixelcolor::PixelColor,
    primitives::Rectangle,
};

use super::{
    BandPixels, DepthBuffer, FrameError, InPages, InRows, PackedColor, StoredDepth, Unpacked,
    depth::Lent,
};
use crate::{attribute::NoDepth, numbers::divide};

/// A rectangle of the display in bands of rows, which are drawn and sent one after the other.
///
/// `M` is a band's pixel memory: anything that lends a slice of colours, such as `&mut [C]`,
/// `&'static mut [C; N]` or a box. The rectangle can be the whole display at first, and afterwards
/// what changed: the union of [`Projected::bounds`](crate::scene::Projected::bounds) of this frame
/// and the last.
///
/// `P` says how pixels lie in it: a band is a [`Frame`](super::Frame), or, if several pixels share
/// a byte ([`packed`](Bands::packed), [`in_pages`](Bands::in_pages)), a
/// [`PackedFrame`](super::PackedFrame).
///
/// [`show`](Self::show) draws and sends all of it. A firmware that has other things to do between
/// two bands takes them one by one, and awaits each transfer in its own way:
///
/// ```
/// # use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
/// # use rasterizer::prelude::*;
/// # let screen = Rectangle::new(Point::zero(), Size::new(8, 5));
/// # let (mut color, mut depth) = ([Rgb565::BLACK; 8 * 2], [0u16; 8 * 2]);
/// # let mut sent = 0;
/// let mut bands = Bands::new(screen, &mut color, &mut depth)?;
/// for area in bands.areas() {
///     let mut band = bands.band(area)?;
///     band.clear_color(Rgb565::BLUE);
///     // Draw objects here.
///     let pixels = band.pixels();
///     // Send them, and `.await` the end of the transfer.
/// #   sent += pixels.len();
/// }
/// # assert_eq!(sent, 40);
/// # Ok::<(), rasterizer::output::FrameError>(())
/// ```
#[derive(Debug)]
pub struct Bands<M, C, B, P = Unpacked> {
    areas: BandAreas,
    color: M,
    depth: B,
    pixel: PhantomData<(C, P)>,
}

impl<'d, M: AsMut<[C]>, C: Copy + 'static, D: StoredDepth> Bands<M, C, &'d mut [D]> {
    /// Bands of `area` with a depth buffer, of `u16` for example: each has as many rows as both
    /// buffers hold.
    ///
    /// # Errors
    ///
    /// If a buffer does not hold a row.
    pub fn new(area: Rectangle, color: M, depth: &'d mut [D]) -> Result<Self, FrameError> {
        Self::with_depth(area, color, depth)
    }
}

impl<M: AsMut<[C]>, C: Copy + 'static> Bands<M, C, NoDepth> {
    /// Bands of `area` without a depth buffer: each has as many rows as the buffer holds.
    ///
    /// # Errors
    ///
    /// If the buffer does not hold a row.
    pub fn without_depth(area: Rectangle, color: M) -> Result<Self, FrameError> {
        Self::of(area, color, NoDepth, area.size.height)
    }
}

impl<'d, M: AsMut<[u8]>, C: PackedColor + 'static, D: StoredDepth>
    Bands<M, C, &'d mut [D], InRows>
{
    /// Bands of `area` in bytes of several pixels, which lie side by side, with a depth buffer:
    /// each has as many rows as both buffers hold.
    ///
    /// # Errors
    ///
    /// If a buffer does not hold a row.
    pub fn packed(area: Rectangle, bytes: M, depth: &'d mut [D]) -> Result<Self, FrameError> {
        Self::with_depth(area, bytes, depth)
    }
}

impl<M: AsMut<[u8]>, C: PackedColor + 'static> Bands<M, C, NoDepth, InRows> {
    /// Bands of `area` in bytes of several pixels, which lie side by side, without a depth buffer.
    ///
    /// # Errors
    ///
    /// If the buffer does not hold a row.
    pub fn packed_without_depth(area: Rectangle, bytes: M) -> Result<Self, FrameError> {
        Self::of(area, bytes, NoDepth, area.size.height)
    }
}

impl<'d, M: AsMut<[u8]>, C: PackedColor + 'static, D: StoredDepth>
    Bands<M, C, &'d mut [D], InPages>
{
    /// Bands of `area` in pages, with a depth buffer. Each has as many rows as both buffers hold,
    /// down to a multiple of eight: bands begin with a page of the display if `area` does.
    ///
    /// # Errors
    ///
    /// If a buffer does not hold the eight rows of a page.
    pub fn in_pages(area: Rectangle, bytes: M, depth: &'d mut [D]) -> Result<Self, FrameError> {
        Self::with_depth(area, bytes, depth)
    }
}

impl<M: AsMut<[u8]>, C: PackedColor + 'static> Bands<M, C, NoDepth, InPages> {
    /// Bands of `area` in pages, without a depth buffer.
    ///
    /// # Errors
    ///
    /// If the buffer does not hold the eight rows of a page.
    pub fn in_pages_without_depth(area: Rectangle, bytes: M) -> Result<Self, FrameError> {
        Self::of(area, bytes, NoDepth, area.size.height)
    }
}

impl<'d, M: AsMut<[P::Unit]>, C, D: StoredDepth, P: BandPixels<C>> Bands<M, C, &'d mut [D], P> {
    pub(super) fn with_depth(
        area: Rectangle,
        color: M,
        depth: &'d mut [D],
    ) -> Result<Self, FrameError> {
        let Size { width, height } = area.size;
        let rows = if width == 0 { height } else { divide(depth.len() as u32, width) };
        Self::of(area, color, depth, rows)
    }
}

impl<M: AsMut<[P::Unit]>, C, B: DepthBuffer, P: BandPixels<C>> Bands<M, C, B, P> {
    /// Bands with a depth for `depth_rows` rows.
    fn of(area: Rectangle, mut color: M, depth: B, depth_rows: u32) -> Result<Self, FrameError> {
        let Size { width, height } = area.size;
        // All bands but the last have a multiple of `STEP` rows.
        let whole = |rows: u32| if rows < height { rows - rows % P::STEP } else { height };
        let least = Size::new(width, P::STEP.min(height));
        let is_too_short = |rows: u32| rows == 0 && !area.is_zero_sized();
        let held = color.as_mut().len();
        let rows = whole(if width == 0 { height } else { P::rows(held, width) });
        if is_too_short(rows) {
            return Err(P::too_short(P::units(least)));
        }
        let depth_rows = whole(depth_rows);
        if is_too_short(depth_rows) {
            let needed = least.width as usize * least.height as usize;
            return Err(FrameError::DepthLength { needed });
        }
        let areas = BandAreas::new(area, rows.min(depth_rows));
        Ok(Self { areas, color, depth, pixel: PhantomData })
    }

    /// The rectangles of the bands, from the top.
    #[must_use]
    pub const fn areas(&self) -> BandAreas {
        self.areas
    }

    /// A band as a frame: one of [`areas`](Self::areas), or another rectangle that its memory
    /// holds. Its depth is cleared; its colours are those of the band before.
    ///
    /// # Errors
    ///
    /// If the memory is too small.
    pub fn band(&mut self, area: Rectangle) -> Result<P::Frame<'_, Lent<'_, B>>, FrameError> {
        let needed = P::units(area.size);
        if self.color.as_mut().len() < needed {
            return Err(P::too_short(needed));
        }
        let needed = area.size.width as usize * area.size.height as usize;
        if !self.depth.holds(needed) {
            return Err(FrameError::DepthLength { needed });
        }
        Ok(self.part(area))
    }

    /// A band as a frame with a cleared depth, in memory that is large enough.
    #[inline(always)]
    fn part(&mut self, area: Rectangle) -> P::Frame<'_, Lent<'_, B>> {
        let pixels = area.size.width as usize * area.size.height as usize;
        let color = self.color.as_mut();
        let units = P::units(area.size).min(color.len());
        let color = color.get_mut(..units).unwrap_or_default();
        P::frame(color, self.depth.lend(pixels), area)
    }

    /// Gives the bands other memory for their pixels, and returns what they had: with a finished
    /// band, whose transfer can start, if this is called after drawing it.
    pub const fn exchange(&mut self, memory: M) -> M {
        mem::replace(&mut self.color, memory)
    }

    /// The memory of the pixels.
    pub fn into_color(self) -> M {
        self.color
    }
}

impl<M: AsMut<[P::Unit]>, C: PixelColor, B: DepthBuffer, P: BandPixels<C>> Bands<M, C, B, P> {
    /// Draws all bands, and sends each to the display before the next is drawn.
    ///
    /// `background` gets each band first, to set all its colours: `|band| band.clear_color(..)`, or
    /// an image, a gradient, text. `draw` draws the objects; it cannot fail, because what can fail
    /// about an object has been done before, by `project` or `project_on_demand`.
    ///
    /// # Errors
    ///
    /// Returns the display's first error, and draws no band after it.
    pub fn show<T: DrawTarget<Color = C>>(
        &mut self,
        display: &mut T,
        mut background: impl FnMut(&mut P::Frame<'_, Lent<'_, B>>),
        mut draw: impl FnMut(&mut P::Frame<'_, Lent<'_, B>>) -> Result<(), Infallible>,
    ) -> Result<(), T::Error> {
        for area in self.areas {
            let mut band = self.part(area);
            background(&mut band);
            let Ok(()) = draw(&mut band);
            P::send(&band, display)?;
        }
        Ok(())
    }

    /// Draws all bands while those that are finished are being sent. `background` and `draw` are
    /// those of [`show`](Self::show).
    ///
    /// `send` receives the memory of a finished band, whose first pixels are those of the
    /// rectangle. It starts the transfer and returns other memory, whose transfer is complete; the
    /// next band is drawn into that. The memory that it returned last is the result.
    ///
    /// # Errors
    ///
    /// Returns the first error of `send`; and an error if memory that it returned is too small for
    /// the next band.
    pub fn stream<E>(
        mut self,
        mut background: impl FnMut(&mut P::Frame<'_, Lent<'_, B>>),
        mut draw: impl FnMut(&mut P::Frame<'_, Lent<'_, B>>) -> Result<(), Infallible>,
        mut send: impl FnMut(M, Rectangle) -> Result<M, E>,
    ) -> Result<M, StreamError<E>> {
        for area in self.areas {
            let mut band = self.band(area).map_err(StreamError::Frame)?;
            background(&mut band);
            let Ok(()) = draw(&mut band);
            drop(band);
            self.color = send(self.color, area).map_err(StreamError::Send)?;
        }
        Ok(self.color)
    }
}

/// Why a stream of bands ended; `E` is the transfer's error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StreamError<E> {
    /// The memory that the transfer gave is too small.
    Frame(FrameError),
    /// The transfer failed.
    Send(E),
}

impl<E: core::fmt::Display> core::fmt::Display for StreamError<E> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Frame(error) => error.fmt(f),
            Self::Send(error) => error.fmt(f),
        }
    }
}

impl<E: core::error::Error> core::error::Error for StreamError<E> {}

/// The rectangles of bands, from the top: of equal height, the last one what is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BandAreas {
    rest: Rectangle,
    rows: u32,
}

impl BandAreas {
    /// Of `rows` rows each, at least one.
    #[must_use]
    pub const fn new(area: Rectangle, rows: u32) -> Self {
        Self { rest: area, rows: if rows == 0 { 1 } else { rows } }
    }
}

impl Iterator for BandAreas {
    type Item = Rectangle;

    fn next(&mut self) -> Option<Rectangle> {
        if self.rest.is_zero_sized() {
            return None;
        }
        let Rectangle { top_left, size } = self.rest;
        let height = self.rows.min(size.height);
        self.rest = Rectangle::new(
            Point::new(top_left.x, top_left.y.wrapping_add_unsigned(height)),
            Size::new(size.width, size.height - height),
        );
        Some(Rectangle::new(top_left, Size::new(size.width, height)))
    }
}
