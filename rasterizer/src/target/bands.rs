//! A part of the display drawn and sent band by band, in memory for one band.

use core::{convert::Infallible, marker::PhantomData, mem};

use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{Point, Size},
    pixelcolor::PixelColor,
    primitives::Rectangle,
};

use super::{DepthBuffer, Frame, FrameError, StoredColor, StoredDepth};
use crate::{geometry::NoDepth, numbers::divide};

/// A rectangle of the display in bands of rows, which one after the other are cleared, drawn and
/// sent.
///
/// `M` is the memory of a band's pixels: anything that lends a slice of colours, such as `&mut
/// [C]`, `&'static mut [C; N]` or a box. The rectangle may be a part of the display: all of it the
/// first time, then what has changed, which
/// is what [`Projected::bounds`](crate::scene::Projected::bounds) of this frame and the last one
/// hold together.
#[derive(Debug)]
pub struct Bands<M, C, B> {
    areas: BandAreas,
    color: M,
    depth: B,
    pixel: PhantomData<C>,
}

impl<'d, M: AsMut<[C]>, C: PixelColor, D: StoredDepth> Bands<M, C, &'d mut [D]> {
    /// Bands of `area` with a depth buffer of `u16` or `u32`: each has as many rows as both buffers
    /// hold.
    ///
    /// # Errors
    ///
    /// If a buffer does not hold a row.
    pub fn new(area: Rectangle, mut color: M, depth: &'d mut [D]) -> Result<Self, FrameError> {
        let width = area.size.width as usize;
        let rows = whole_rows(color.as_mut().len(), &area)
            .ok_or(FrameError::ColorLength { needed: width })?;
        let rows = rows
            .min(whole_rows(depth.len(), &area).ok_or(FrameError::DepthLength { needed: width })?);
        // What is longer than a band would be cleared for nothing.
        let depth = depth.get_mut(..rows as usize * width).unwrap_or_default();
        Ok(Self::over(BandAreas::new(area, rows), color, depth))
    }
}

impl<M: AsMut<[C]>, C: PixelColor> Bands<M, C, NoDepth> {
    /// Bands of `area` without a depth buffer: each has as many rows as the buffer holds.
    ///
    /// # Errors
    ///
    /// If the buffer does not hold a row.
    pub fn without_depth(area: Rectangle, mut color: M) -> Result<Self, FrameError> {
        let needed = area.size.width as usize;
        let rows =
            whole_rows(color.as_mut().len(), &area).ok_or(FrameError::ColorLength { needed })?;
        Ok(Self::over(BandAreas::new(area, rows), color, NoDepth))
    }
}

/// How many of an area's rows so many pixels hold; nothing if there is not even one.
fn whole_rows(pixels: usize, area: &Rectangle) -> Option<u32> {
    let Size { width, height } = area.size;
    let rows = if width == 0 { height } else { divide(pixels as u32, width).min(height) };
    (rows > 0 || area.is_zero_sized()).then_some(rows)
}

impl<M: AsMut<[C]>, C: PixelColor, B: DepthBuffer + Default> Bands<M, C, B> {
    const fn over(areas: BandAreas, color: M, depth: B) -> Self {
        Self { areas, color, depth, pixel: PhantomData }
    }

    /// The rectangles of the bands, from the top.
    #[must_use]
    pub const fn areas(&self) -> BandAreas {
        self.areas
    }
}

impl<M: AsMut<[C]>, C: StoredColor, B: DepthBuffer + Default> Bands<M, C, B> {
    /// Draws all bands and sends each to the display before the next is drawn. `draw` gets each
    /// band as a frame in the background's colour; what can fail about an object has been done
    /// before, by `project` or `walk`.
    ///
    /// # Errors
    ///
    /// What the display says, at once.
    pub fn show<T: DrawTarget<Color = C>>(
        &mut self,
        display: &mut T,
        background: C,
        mut draw: impl FnMut(&mut Frame<'_, C, B>) -> Result<(), Infallible>,
    ) -> Result<(), T::Error> {
        for area in self.areas {
            let mut band = Frame::part(self.color.as_mut(), mem::take(&mut self.depth), area);
            band.clear(background);
            let Ok(()) = draw(&mut band);
            let presented = band.present(display);
            self.depth = band.into_depth();
            presented?;
        }
        Ok(())
    }

    /// Draws all bands while those that are finished are on their way.
    ///
    /// `send` gets the memory of a band that is finished, whose first pixels are the rectangle's.
    /// It starts the transfer and gives other memory in exchange, of which the transfer has
    /// ended: the next band is drawn there meanwhile. What it gave last comes back.
    ///
    /// # Errors
    ///
    /// What `send` says, at once; and if memory that it gave is too small for the next band.
    pub fn stream<E>(
        mut self,
        background: C,
        mut draw: impl FnMut(&mut Frame<'_, C, B>) -> Result<(), Infallible>,
        mut send: impl FnMut(M, Rectangle) -> Result<M, E>,
    ) -> Result<M, StreamError<E>> {
        for area in self.areas {
            let needed = area.size.width as usize * area.size.height as usize;
            let color = self.color.as_mut();
            if color.len() < needed {
                return Err(StreamError::Frame(FrameError::ColorLength { needed }));
            }
            let mut band = Frame::part(color, self.depth, area);
            band.clear(background);
            let Ok(()) = draw(&mut band);
            self.depth = band.into_depth();
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
            Point::new(top_left.x, top_left.y.saturating_add_unsigned(height)),
            Size::new(size.width, size.height - height),
        );
        Some(Rectangle::new(top_left, Size::new(size.width, height)))
    }
}
