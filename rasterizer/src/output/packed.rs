//! A rectangle of the display in bytes that hold several pixels each.

use core::{cell::Cell, convert::Infallible, marker::PhantomData};

use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point, Size},
    primitives::Rectangle,
};

use super::{
    BitOrder, DepthBuffer, FrameError, InPages, InRows, PackedColor, Readable, StoredDepth, Target,
    bits::{bytes_of, pixel_mask, with_bits},
    fill::fill_bytes,
    pixels,
};
use crate::{
    attribute::NoDepth,
    raster::{FragmentOf, Layout, Primitive, Window},
    shade::{CodeSize, Outcome},
};

/// Colour and depth of a rectangle of the display, in memory that the caller owns: 1, 2 or 4 bits
/// for each pixel's colour. A display of 128 x 64 pixels that are on or off takes 1,024 bytes.
///
/// `O` says how pixels lie in bytes: [`InRows`] as in embedded-graphics' `ImageRaw`, each row
/// beginning with a byte, or [`InPages`] as in the memory of most small OLED
/// displays. Bits of the last bytes that belong to no pixel are of no meaning.
///
/// As a [`Frame`](super::Frame), it is a [`DrawTarget`] in the display's coordinates, and a frame
/// that is only a band gets the same pixels there as one of the whole display. Its depth has a cell
/// for each pixel of the rectangle, as a frame's has: none of them for the bits that fill a row's
/// last byte.
///
/// A pixel takes more instructions than one of a byte or more, because its byte is read, changed
/// and stored again: on a Cortex-M0+ 16 more in pages and 26 to 33 more in rows, on an M4 15 and 18
/// to 22. Runs of one colour without depth are filled by words, where pixels lie in rows.
///
/// ```
/// use embedded_graphics_core::{pixelcolor::Gray2, prelude::*, primitives::Rectangle};
/// use rasterizer::output::PackedFrame;
///
/// // Five pixels of two bits take two bytes.
/// let area = Rectangle::new(Point::zero(), Size::new(5, 2));
/// let mut bytes = [0; PackedFrame::<Gray2>::bytes(Size::new(5, 2))];
/// let mut frame = PackedFrame::without_depth(&mut bytes, area)?;
/// frame.fill_solid(&Rectangle::new(Point::new(1, 0), Size::new(4, 1)), Gray2::new(2))?;
/// assert_eq!(bytes, [0b00_10_10_10, 0b10_00_00_00, 0, 0]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct PackedFrame<'a, C, B = NoDepth, O = InRows> {
    bytes: &'a mut [u8],
    depth: B,
    area: Rectangle,
    color: PhantomData<(C, O)>,
}

impl<C: PackedColor, O: BitOrder> PackedFrame<'_, C, NoDepth, O> {
    /// The length of the memory for a frame of this size.
    #[must_use]
    pub const fn bytes(size: Size) -> usize {
        bytes_of::<C, O>(size)
    }
}

impl<'a, C: PackedColor, D: StoredDepth> PackedFrame<'a, C, &'a mut [D]> {
    /// A frame with a depth buffer, of `u16` for example, for the rectangle `area` of the display,
    /// its pixels side by side in their bytes.
    ///
    /// # Errors
    ///
    /// If `bytes` does not have as many bytes as [`bytes`](PackedFrame::bytes) returns, or `depth`
    /// not as many cells as the rectangle has pixels.
    pub fn new(
        bytes: &'a mut [u8],
        depth: &'a mut [D],
        area: Rectangle,
    ) -> Result<Self, FrameError> {
        Self::of(bytes, depth, area)
    }
}

impl<'a, C: PackedColor> PackedFrame<'a, C> {
    /// A frame without a depth buffer for the rectangle `area` of the display, its pixels side by
    /// side in their bytes: what is drawn last is seen.
    ///
    /// # Errors
    ///
    /// If `bytes` does not have as many bytes as [`bytes`](PackedFrame::bytes) returns.
    pub fn without_depth(bytes: &'a mut [u8], area: Rectangle) -> Result<Self, FrameError> {
        Self::of(bytes, NoDepth, area)
    }
}

impl<'a, C: PackedColor, D: StoredDepth> PackedFrame<'a, C, &'a mut [D], InPages> {
    /// A frame with a depth buffer in pages: its pixels one above the other in their bytes.
    ///
    /// # Errors
    ///
    /// As [`new`](PackedFrame::new).
    pub fn in_pages(
        bytes: &'a mut [u8],
        depth: &'a mut [D],
        area: Rectangle,
    ) -> Result<Self, FrameError> {
        Self::of(bytes, depth, area)
    }
}

impl<'a, C: PackedColor> PackedFrame<'a, C, NoDepth, InPages> {
    /// A frame without a depth buffer in pages: its pixels one above the other in their bytes.
    ///
    /// # Errors
    ///
    /// As [`without_depth`](PackedFrame::without_depth).
    pub fn in_pages_without_depth(
        bytes: &'a mut [u8],
        area: Rectangle,
    ) -> Result<Self, FrameError> {
        Self::of(bytes, NoDepth, area)
    }
}

impl<'a, C: PackedColor, B: DepthBuffer, O: BitOrder> PackedFrame<'a, C, B, O> {
    fn of(bytes: &'a mut [u8], depth: B, area: Rectangle) -> Result<Self, FrameError> {
        let needed = bytes_of::<C, O>(area.size);
        if bytes.len() != needed {
            return Err(FrameError::PackedLength { needed });
        }
        let needed = area.size.width as usize * area.size.height as usize;
        if !depth.is_of(needed) {
            return Err(FrameError::DepthLength { needed });
        }
        Ok(Self::part(bytes, depth, area))
    }

    /// A frame in memory of just its size, which has been checked.
    #[inline(always)]
    pub(super) const fn part(bytes: &'a mut [u8], depth: B, area: Rectangle) -> Self {
        Self { bytes, depth, area, color: PhantomData }
    }

    /// Sets all pixels to one colour and their depth to the far end.
    pub fn clear(&mut self, color: C) {
        self.clear_color(color);
        self.clear_depth();
    }

    /// Sets all pixels to one colour, and leaves their depth.
    // codegen: not inlined, because it is done rarely.
    #[inline(never)]
    pub fn clear_color(&mut self, color: C) {
        fill_bytes(self.bytes, repeated(color));
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

    /// The bytes of the pixels: the data of an `ImageRaw`, or what a display's controller takes.
    #[must_use]
    pub const fn as_bytes(&self) -> &[u8] {
        self.bytes
    }

    /// The bytes of the pixels.
    #[must_use]
    pub const fn as_bytes_mut(&mut self) -> &mut [u8] {
        self.bytes
    }

    /// The colours of the pixels, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = C> {
        let Size { width, height } = self.area.size;
        let pixel = move |column: u32, row: u32| {
            let (byte, shift) = O::place::<C>(column, row, width);
            C::from_bits(self.bytes.get(byte).map_or(0, |byte| byte >> shift))
        };
        (0..height).flat_map(move |row| (0..width).map(move |column| pixel(column, row)))
    }

    /// Sends the pixels to the display in one run.
    ///
    /// # Errors
    ///
    /// Returns the display's error.
    pub fn present<T: DrawTarget<Color = C>>(&self, display: &mut T) -> Result<(), T::Error> {
        display.fill_contiguous(&self.area, self.pixels())
    }

    /// The addresses of depth cells.
    #[inline(always)]
    const fn layout(&self) -> Layout {
        let Rectangle { top_left, size } = self.area;
        let pitch = size.width as i32;
        Layout { pitch, origin: top_left.y.wrapping_mul(pitch).wrapping_add(top_left.x) }
    }

    /// Sets pixels of a row that lie within the rectangle.
    #[inline(always)]
    fn fill_row(&mut self, [start, end]: [i32; 2], row: i32, pattern: u8) {
        let Point { x, y } = self.area.top_left;
        let columns = [start, end].map(|column| column.wrapping_sub(x) as u32);
        let row = row.wrapping_sub(y) as u32;
        O::fill::<C>(self.bytes, columns, row, self.area.size.width, pattern);
    }

    /// Draws a primitive's spans in one colour, untested.
    #[inline(never)]
    fn fill_runs<Q: Primitive<Depth = B::Format>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        color: C,
    ) -> Result<(), Infallible> {
        let pattern = repeated(color);
        // All rows have the same addresses: the columns.
        let columns = Layout { pitch: 0, origin: self.area.top_left.x };
        let left = self.area.top_left.x;
        primitive.for_each_span(window, columns, |span| {
            let ends = [span.start, span.end].map(|end| left.wrapping_add(end as i32));
            self.fill_row(ends, span.row, pattern);
            Ok(())
        })
    }
}

/// A byte of pixels of one colour.
#[inline(always)]
fn repeated<C: PackedColor>(color: C) -> u8 {
    // A byte has the bits of a pixel 0xFF / mask times: 255, 85 or 17 is 1 in each.
    color.to_bits() * const { 0xFF / pixel_mask::<C>() }
}

impl<C: PackedColor, B: DepthBuffer, O: BitOrder> Target for PackedFrame<'_, C, B, O> {
    type Color = C;
    type Depth = B::Format;
    type Error = Infallible;

    fn window(&self) -> Window {
        Window::or_none(&self.area)
    }

    #[inline(always)]
    fn shade<Q: Primitive<Depth = Self::Depth>, P: Outcome<C>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> P + Copy,
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

impl<C: PackedColor, B: DepthBuffer, O: BitOrder> Readable for PackedFrame<'_, C, B, O> {
    /// By the loop of all frames, over colours of no size: a pixel's function finds the pixel's
    /// byte by its place, and taking its outcome stores the bits.
    #[inline(never)]
    fn blend<Q: Primitive<Depth = Self::Depth>, P: Outcome<C>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(C, FragmentOf<Q>) -> P + Copy,
    ) -> Result<(), Infallible> {
        let layout = self.layout();
        let Rectangle { top_left: Point { x, y }, size: Size { width, .. } } = self.area;
        let bytes = Cell::from_mut(&mut *self.bytes).as_slice_of_cells();
        let pixel = move |(), fragment: FragmentOf<Q>| {
            let column = fragment.column.wrapping_sub(x) as u32;
            let row = fragment.row.wrapping_sub(y) as u32;
            let (byte, shift) = O::place::<C>(column, row, width);
            let byte = bytes.get(byte);
            let stored = C::from_bits(byte.map_or(0, |byte| byte.get() >> shift));
            Stored { byte, shift, outcome: pixel(stored, fragment), color: PhantomData }
        };
        let mut colors = [(); isize::MAX as usize];
        self.depth.with(|cells| pixels::draw(&mut colors, cells, primitive, window, layout, pixel))
    }
}

/// The outcome of a pixel, and where it is stored when it is taken.
struct Stored<'b, C, P> {
    byte: Option<&'b Cell<u8>>,
    shift: u32,
    outcome: P,
    color: PhantomData<C>,
}

impl<C: PackedColor, P: Outcome<C>> Outcome<()> for Stored<'_, C, P> {
    const DISCARDS: bool = P::DISCARDS;
    const WRITES_DEPTH: bool = P::WRITES_DEPTH;
    const CODE: CodeSize = P::CODE.max(CodeSize::Medium);

    #[inline(always)]
    fn color(self) -> Option<()> {
        let color = self.outcome.color()?;
        if let Some(byte) = self.byte {
            let mask = pixel_mask::<C>() << self.shift;
            byte.set(with_bits(byte.get(), mask, color.to_bits() << self.shift));
        }
        Some(())
    }
}

impl<C, B, O> Dimensions for PackedFrame<'_, C, B, O> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PackedColor, B: DepthBuffer, O: BitOrder> DrawTarget for PackedFrame<'_, C, B, O> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let Window { left, top, right, bottom } = self.window();
        let width = self.area.size.width;
        for Pixel(Point { x, y }, color) in pixels {
            if (left..right).contains(&x) && (top..bottom).contains(&y) {
                let (column, row) = (x.wrapping_sub(left) as u32, y.wrapping_sub(top) as u32);
                let (byte, shift) = O::place::<C>(column, row, width);
                if let Some(byte) = self.bytes.get_mut(byte) {
                    let mask = pixel_mask::<C>() << shift;
                    *byte = with_bits(*byte, mask, color.to_bits() << shift);
                }
            }
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), Infallible> {
        let Window { left, top, right, bottom } = Window::new(area).intersection(&self.window());
        if left < right {
            let pattern = repeated(color);
            for row in top..bottom {
                self.fill_row([left, right], row, pattern);
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
