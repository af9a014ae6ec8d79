//! A rectangle of the display in the caller's memory: the whole of it, or a band of rows.

use core::convert::Infallible;

use embedded_graphics_core::{
    draw_target::DrawTarget, geometry::Size, pixelcolor::PixelColor, primitives::Rectangle,
};

use super::{DepthBuffer, Fill, StoredColor, StoredDepth, Target, fill::fill_all};
use crate::{
    geometry::{NoDepth, Subpixel, Varyings},
    raster::{Interpolate, Layout, Triangle, Window},
};

/// Colour and depth of a rectangle of the display, row by row, in memory that the caller owns.
///
/// A frame that is only a band of rows gets the same pixels there as one of the whole display.
#[derive(Debug)]
pub struct Frame<'a, C, B> {
    color: &'a mut [C],
    depth: B,
    area: Rectangle,
    window: Window,
    /// An address is an index of the buffers.
    layout: Layout,
}

/// Memory of the wrong size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameError {
    /// The colour buffer must have a pixel for each of the rectangle's.
    ColorLength {
        /// How many pixels the rectangle has.
        needed: usize,
    },
    /// The depth buffer must have a cell for each of the rectangle's pixels.
    DepthLength {
        /// How many pixels the rectangle has.
        needed: usize,
    },
}

impl core::fmt::Display for FrameError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::ColorLength { needed } => {
                write!(f, "the colour buffer must have {needed} pixels")
            }
            Self::DepthLength { needed } => write!(f, "the depth buffer must have {needed} cells"),
        }
    }
}

impl core::error::Error for FrameError {}

impl<'a, C: PixelColor, D: StoredDepth> Frame<'a, C, &'a mut [D]> {
    /// A frame with a depth buffer of `u16` or `u32` for the rectangle `area` of the display.
    ///
    /// # Errors
    ///
    /// If a slice does not have as many elements as the rectangle has pixels.
    pub fn new(
        color: &'a mut [C],
        depth: &'a mut [D],
        area: Rectangle,
    ) -> Result<Self, FrameError> {
        Self::over(color, depth, area)
    }
}

impl<'a, C: PixelColor> Frame<'a, C, NoDepth> {
    /// A frame without a depth buffer for the rectangle `area` of the display: what is drawn last
    /// is seen.
    ///
    /// # Errors
    ///
    /// If the slice does not have as many elements as the rectangle has pixels.
    pub fn without_depth(color: &'a mut [C], area: Rectangle) -> Result<Self, FrameError> {
        Self::over(color, NoDepth, area)
    }
}

impl<'a, C: PixelColor, B: DepthBuffer> Frame<'a, C, B> {
    fn over(color: &'a mut [C], depth: B, area: Rectangle) -> Result<Self, FrameError> {
        let Size { width, height } = area.size;
        let needed = width as usize * height as usize;
        if color.len() != needed {
            return Err(FrameError::ColorLength { needed });
        }
        if !depth.holds(needed) {
            return Err(FrameError::DepthLength { needed });
        }
        Ok(Self::part(color, depth, area))
    }

    /// A frame in the first part of memory that may be larger.
    pub(super) fn part(color: &'a mut [C], depth: B, area: Rectangle) -> Self {
        let pixels = color.len().min(area.size.width as usize * area.size.height as usize);
        let (window, pitch) = (Window::new(&area), area.size.width as i32);
        Self {
            color: color.get_mut(..pixels).unwrap_or_default(),
            depth,
            area,
            window,
            layout: Layout {
                pitch,
                origin: window.top.wrapping_mul(pitch).wrapping_add(window.left),
            },
        }
    }

    /// Gives the memory of the depth back.
    pub(super) fn into_depth(self) -> B {
        self.depth
    }

    /// Sets the depth of all pixels to the far end, and leaves their colours, for a background that
    /// is drawn already.
    pub fn clear_depth(&mut self) {
        self.depth.clear();
    }

    /// The rectangle of the display that it stands for.
    #[must_use]
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The pixels, row by row.
    #[must_use]
    pub const fn pixels(&self) -> &[C] {
        self.color
    }

    /// Sends the pixels to the display in one run.
    ///
    /// # Errors
    ///
    /// What the display says.
    pub fn present<T: DrawTarget<Color = C>>(&self, display: &mut T) -> Result<(), T::Error> {
        display.fill_contiguous(&self.area, self.color.iter().copied())
    }
}

impl<C: StoredColor, B: DepthBuffer> Frame<'_, C, B> {
    /// Sets all pixels to one colour and their depth to the far end.
    pub fn clear(&mut self, color: C) {
        fill_all(C::Fill::new(color), self.color);
        self.clear_depth();
    }

    /// Draws the spans of a triangle in one colour, untested.
    #[inline(never)]
    fn fill_runs<S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        triangle: Triangle<'_, S, B::Format, V>,
        window: &Window,
        color: C,
    ) -> Result<(), Infallible> {
        let fill = C::Fill::new(color);
        triangle.for_each_span(window, self.layout, |span| {
            if let Some(pixels) = self.color.get_mut(span.start..span.end) {
                fill.run(pixels);
            }
            Ok(())
        })
    }
}

impl<C: StoredColor, B: DepthBuffer> Target for Frame<'_, C, B> {
    type Color = C;
    type Depth = B::Format;
    type Error = Infallible;

    fn window(&self) -> Window {
        self.window
    }

    #[inline(never)]
    fn shade<S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        triangle: Triangle<'_, S, Self::Depth, V>,
        window: &Window,
        pixel: impl FnMut(V::Sample) -> C,
    ) -> Result<(), Infallible> {
        self.depth.shade(self.color, triangle, window, self.layout, pixel)
    }

    #[inline(always)]
    fn fill<S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        triangle: Triangle<'_, S, Self::Depth, V>,
        window: &Window,
        color: C,
    ) -> Result<(), Infallible> {
        if B::IS_STORED {
            self.shade(triangle, window, |_| color)
        } else {
            self.fill_runs(triangle, window, color)
        }
    }
}
