//! A rectangle of the display in the caller's memory: the whole of it, or a band of rows.

use core::{convert::Infallible, marker::PhantomData, ops::Range};

use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point, Size},
    pixelcolor::PixelColor,
    primitives::{PointsIter as _, Rectangle},
};

use super::{
    DepthBuffer, Fill, Readable, StoredColor, StoredDepth, Target, fill::fill_all, pixels,
};
use crate::{
    attribute::NoDepth,
    raster::{FragmentOf, Layout, Primitive, Window},
    shade::Outcome,
};

/// Colour and depth of a rectangle of the display, row by row, in memory that the caller owns.
///
/// A frame that is only a band of rows gets the same pixels there as one of the whole display.
///
/// It is a [`DrawTarget`] too, in the display's coordinates and clipped to its rectangle: text,
/// primitives and images of embedded-graphics go under the objects or over them. They leave the
/// depth as it is.
///
/// `R` says whether its rows lie one after the other ([`Packed`]) or in a larger buffer
/// ([`Strided`]).
#[derive(Debug)]
pub struct Frame<'a, C, B, R = Packed> {
    color: &'a mut [C],
    depth: B,
    area: Rectangle,
    /// An address is an index of the buffers.
    layout: Layout,
    rows: PhantomData<R>,
}

/// How the rows of a frame lie in memory: [`Packed`] or [`Strided`].
pub trait Rows: private::Sealed {
    /// Whether there is no gap between two rows.
    const ARE_PACKED: bool;
}

/// One after the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Packed;

/// With gaps between them, in a larger buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Strided;

impl Rows for Packed {
    const ARE_PACKED: bool = true;
}

impl Rows for Strided {
    const ARE_PACKED: bool = false;
}

mod private {
    pub trait Sealed {}
    impl Sealed for super::Packed {}
    impl Sealed for super::Strided {}
}

/// Memory of the wrong size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameError {
    /// The colour buffer must have a pixel for each of the rectangle's.
    ColorLength {
        /// The number of pixels that it must have.
        needed: usize,
    },
    /// The memory of packed pixels must hold all of the rectangle's.
    PackedLength {
        /// The number of bytes that it must have.
        needed: usize,
    },
    /// The depth buffer must have a cell for each of the rectangle's pixels.
    DepthLength {
        /// The number of cells that it must have.
        needed: usize,
    },
    /// The stride must be the rectangle's width or more.
    Stride {
        /// The rectangle's width in pixels.
        needed: usize,
    },
}

impl core::fmt::Display for FrameError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::ColorLength { needed } => {
                write!(f, "the colour buffer must have {needed} pixels")
            }
            Self::PackedLength { needed } => {
                write!(f, "the memory of packed pixels must have {needed} bytes")
            }
            Self::DepthLength { needed } => write!(f, "the depth buffer must have {needed} cells"),
            Self::Stride { needed } => write!(f, "the stride must be {needed} pixels or more"),
        }
    }
}

impl core::error::Error for FrameError {}

impl<'a, C: Copy, D: StoredDepth> Frame<'a, C, &'a mut [D]> {
    /// A frame with a depth buffer, of `u16` for example, for the rectangle `area` of the display.
    ///
    /// # Errors
    ///
    /// If a slice does not have as many elements as the rectangle has pixels.
    pub fn new(
        color: &'a mut [C],
        depth: &'a mut [D],
        area: Rectangle,
    ) -> Result<Self, FrameError> {
        Self::packed(color, depth, area)
    }
}

impl<'a, C: Copy, D: StoredDepth> Frame<'a, C, &'a mut [D], Strided> {
    /// A frame in a larger buffer, such as a display controller's: its rows begin `stride` pixels
    /// apart, in `color` and in `depth`. Both begin with the frame's first pixel.
    ///
    /// # Errors
    ///
    /// If the stride is less than the rectangle's width, or a slice ends before the last pixel.
    pub fn with_stride(
        color: &'a mut [C],
        depth: &'a mut [D],
        area: Rectangle,
        stride: u32,
    ) -> Result<Self, FrameError> {
        Self::strided(color, depth, area, stride)
    }
}

impl<'a, C: Copy> Frame<'a, C, NoDepth> {
    /// A frame without a depth buffer for the rectangle `area` of the display: what is drawn last
    /// is seen.
    ///
    /// # Errors
    ///
    /// If the slice does not have as many elements as the rectangle has pixels.
    pub fn without_depth(color: &'a mut [C], area: Rectangle) -> Result<Self, FrameError> {
        Self::packed(color, NoDepth, area)
    }
}

impl<'a, C: Copy> Frame<'a, C, NoDepth, Strided> {
    /// A frame without a depth buffer in a larger buffer: its rows begin `stride` pixels apart, the
    /// first one where `color` does.
    ///
    /// # Errors
    ///
    /// If the stride is less than the rectangle's width, or the slice ends before the last pixel.
    pub fn without_depth_with_stride(
        color: &'a mut [C],
        area: Rectangle,
        stride: u32,
    ) -> Result<Self, FrameError> {
        Self::strided(color, NoDepth, area, stride)
    }
}

impl<'a, C: Copy, B: DepthBuffer> Frame<'a, C, B> {
    /// A frame in memory of just its size.
    fn packed(color: &'a mut [C], depth: B, area: Rectangle) -> Result<Self, FrameError> {
        let Size { width, height } = area.size;
        let needed = width as usize * height as usize;
        if color.len() != needed {
            return Err(FrameError::ColorLength { needed });
        }
        if !depth.is_of(needed) {
            return Err(FrameError::DepthLength { needed });
        }
        Ok(Self::part(color, depth, area))
    }

    /// A frame in memory of just its size, which has been checked.
    #[inline(always)]
    pub(super) const fn part(color: &'a mut [C], depth: B, area: Rectangle) -> Self {
        Self::in_rows(color, depth, area, area.size.width)
    }
}

impl<'a, C: Copy, B: DepthBuffer> Frame<'a, C, B, Strided> {
    fn strided(
        color: &'a mut [C],
        depth: B,
        area: Rectangle,
        stride: u32,
    ) -> Result<Self, FrameError> {
        let Size { width, height } = area.size;
        if stride < width {
            return Err(FrameError::Stride { needed: width as usize });
        }
        let needed = match height.checked_sub(1) {
            Some(rows) => rows as usize * stride as usize + width as usize,
            None => 0,
        };
        if color.len() < needed {
            return Err(FrameError::ColorLength { needed });
        }
        if !depth.holds(needed) {
            return Err(FrameError::DepthLength { needed });
        }
        let color = color.get_mut(..needed).unwrap_or_default();
        Ok(Self::in_rows(color, depth, area, stride))
    }
}

impl<'a, C: Copy, B: DepthBuffer, R: Rows> Frame<'a, C, B, R> {
    #[inline(always)]
    const fn in_rows(color: &'a mut [C], depth: B, area: Rectangle, stride: u32) -> Self {
        let (corner, pitch) = (area.top_left, stride as i32);
        let origin = corner.y.wrapping_mul(pitch).wrapping_add(corner.x);
        Self { color, depth, area, layout: Layout { pitch, origin }, rows: PhantomData }
    }

    /// Sets the depth of all pixels to the far end, and leaves their colours, for a background that
    /// is drawn already.
    pub fn clear_depth(&mut self) {
        if R::ARE_PACKED {
            self.depth.clear();
        } else {
            for row in self.rows() {
                self.depth.clear_part(row);
            }
        }
    }

    /// The rectangle of the display that it stands for.
    #[must_use]
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The pixels, row by row, [`stride`](Self::stride) apart.
    #[must_use]
    pub const fn pixels(&self) -> &[C] {
        self.color
    }

    /// The pixels, row by row, [`stride`](Self::stride) apart.
    #[must_use]
    pub const fn pixels_mut(&mut self) -> &mut [C] {
        self.color
    }

    /// The pixels from the beginning of a row to the beginning of the next: the rectangle's width,
    /// unless the frame lies in a larger buffer.
    #[must_use]
    pub const fn stride(&self) -> usize {
        self.layout.pitch as usize
    }

    /// The addresses of the rows from the top.
    fn rows(&self) -> impl Iterator<Item = Range<usize>> + use<C, B, R> {
        let Size { width, height } = self.area.size;
        let (width, stride) = (width as usize, self.stride());
        (0..height as usize).map(move |row| row * stride..row * stride + width)
    }
}

impl<C: PixelColor, B: DepthBuffer, R: Rows> Frame<'_, C, B, R> {
    /// Sends the pixels to the display: in one run, or row by row if the frame lies in a larger
    /// buffer.
    ///
    /// # Errors
    ///
    /// Returns the display's error.
    pub fn present<T: DrawTarget<Color = C>>(&self, display: &mut T) -> Result<(), T::Error> {
        if R::ARE_PACKED {
            return display.fill_contiguous(&self.area, self.color.iter().copied());
        }
        let Rectangle { top_left, size } = self.area;
        for (y, row) in (top_left.y..).zip(self.rows()) {
            let area = Rectangle::new(Point::new(top_left.x, y), Size::new(size.width, 1));
            let pixels = self.color.get(row).unwrap_or_default();
            display.fill_contiguous(&area, pixels.iter().copied())?;
        }
        Ok(())
    }
}

impl<C: StoredColor, B: DepthBuffer, R: Rows> Frame<'_, C, B, R> {
    /// Sets all pixels to one colour and their depth to the far end.
    pub fn clear(&mut self, color: C) {
        self.clear_color(color);
        self.clear_depth();
    }

    /// Sets all pixels to one colour, and leaves their depth.
    pub fn clear_color(&mut self, color: C) {
        let fill = C::Fill::new(color);
        if R::ARE_PACKED {
            fill_all(fill, self.color);
        } else {
            for row in self.rows() {
                fill.run(self.color.get_mut(row).unwrap_or_default());
            }
        }
    }

    /// Draws a primitive's spans in one colour, untested.
    #[inline(never)]
    fn fill_runs<Q: Primitive<Depth = B::Format>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        color: C,
    ) -> Result<(), Infallible> {
        let fill = C::Fill::new(color);
        primitive.for_each_span(window, self.layout, |span| {
            if let Some(pixels) = self.color.get_mut(span.start..span.end) {
                fill.run(pixels);
            }
            Ok(())
        })
    }
}

impl<C: StoredColor, B: DepthBuffer, R: Rows> Target for Frame<'_, C, B, R> {
    type Color = C;
    type Depth = B::Format;
    type Error = Infallible;

    fn window(&self) -> Window {
        Window::or_none(&self.area)
    }

    #[inline(always)]
    fn shade<Q: Primitive<Depth = Self::Depth>, O: Outcome<C>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        self.blend(primitive, window, move |_, fragment| pixel(fragment))
    }

    #[inline(always)]
    fn fill<Q: Primitive<Depth = Self::Depth>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        color: C,
    ) -> Result<(), Infallible> {
        if B::IS_STORED {
            self.shade(primitive, window, move |_| color)
        } else {
            self.fill_runs(primitive, window, color)
        }
    }
}

impl<C: StoredColor, B: DepthBuffer, R: Rows> Readable for Frame<'_, C, B, R> {
    #[inline(never)]
    fn blend<Q: Primitive<Depth = Self::Depth>, O: Outcome<C>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(C, FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        let Self { color, depth, layout, .. } = self;
        depth.with(|cells| pixels::draw(color, cells, primitive, window, *layout, pixel))
    }
}

impl<C, B, R> Dimensions for Frame<'_, C, B, R> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: StoredColor + PixelColor, B: DepthBuffer, R: Rows> DrawTarget for Frame<'_, C, B, R> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let Window { left, top, right, bottom } = self.window();
        for Pixel(Point { x, y }, color) in pixels {
            if (left..right).contains(&x) && (top..bottom).contains(&y) {
                let address = self.layout.row_address(y).wrapping_add(x);
                if let Some(pixel) = self.color.get_mut(address as usize) {
                    *pixel = color;
                }
            }
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), Infallible> {
        let Window { left, top, right, bottom } = Window::new(area).intersection(&self.window());
        if left < right {
            let fill = C::Fill::new(color);
            for row in top..bottom {
                let address = self.layout.row_address(row);
                let run = address.wrapping_add(left) as usize..address.wrapping_add(right) as usize;
                fill.run(self.color.get_mut(run).unwrap_or_default());
            }
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let all = Window::new(area);
        let inside = all.intersection(&self.window());
        let mut colors = colors.into_iter();
        if inside != all {
            return self
                .draw_iter(area.points().zip(colors).map(|(place, color)| Pixel(place, color)));
        }
        for row in inside.top..inside.bottom {
            let address = self.layout.row_address(row);
            let run = address.wrapping_add(inside.left) as usize
                ..address.wrapping_add(inside.right) as usize;
            for pixel in self.color.get_mut(run).unwrap_or_default() {
                let Some(color) = colors.next() else { return Ok(()) };
                *pixel = color;
            }
        }
        Ok(())
    }

    /// Sets all pixels to one colour, and leaves their depth.
    fn clear(&mut self, color: C) -> Result<(), Infallible> {
        self.clear_color(color);
        Ok(())
    }
}
