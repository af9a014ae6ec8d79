//! A display of few colours as one of eight bits a channel.

use core::marker::PhantomData;

use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point, Size},
    pixelcolor::PixelColor,
    primitives::Rectangle,
};

use crate::color::{Bayer, Dither, FullColor};

/// A display whose pixels are dithered when they are sent to it: it takes `S`, `Gray8` or `Rgb888`,
/// and gives the display's own colours to the driver, by a matrix of `SIZE` rows, 8 or 4. See
/// [`Dither`].
///
/// Frames, bands, text and images can be sent to it. What a frame of `S` blends is dithered
/// afterwards; with [`Dithered`](crate::shade::Dithered), a shader's colours are dithered when they
/// are drawn, and a frame takes the display's bits.
///
/// ```
/// use embedded_graphics_core::{
///     pixelcolor::{BinaryColor, Gray8},
///     prelude::*,
///     primitives::Rectangle,
/// };
/// use rasterizer::output::{Dithering, PackedFrame};
///
/// // Stands for the display of a driver.
/// let area = Rectangle::new(Point::zero(), Size::new(8, 4));
/// let mut bytes = [0; PackedFrame::<BinaryColor>::bytes(Size::new(8, 4))];
/// let mut display = PackedFrame::<BinaryColor>::without_depth(&mut bytes, area)?;
///
/// // 188 of 255 has half the light of white: every other pixel is on.
/// let mut gray = Dithering::<_, Gray8>::new(&mut display);
/// gray.clear(Gray8::new(188))?;
/// gray.fill_solid(&Rectangle::new(Point::zero(), Size::new(8, 2)), Gray8::WHITE)?;
/// assert_eq!(bytes, [0xFF, 0xFF, 0b0101_0101, 0b1010_1010]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Dithering<'d, T, S, const SIZE: usize = 8> {
    display: &'d mut T,
    from: PhantomData<S>,
}

impl<'d, T: DrawTarget<Color: Dither>, S: FullColor> Dithering<'d, T, S> {
    /// Dithers for this display by a matrix of 8 x 8 numbers.
    pub const fn new(display: &'d mut T) -> Self {
        Self::with_size(display)
    }
}

impl<'d, T: DrawTarget<Color: Dither>, S: FullColor, const SIZE: usize> Dithering<'d, T, S, SIZE> {
    /// Dithers for this display by a matrix of `SIZE` rows, 4 or 8.
    pub const fn with_size(display: &'d mut T) -> Self {
        Self { display, from: PhantomData }
    }
}

/// Colours of a rectangle, row by row, dithered.
struct Rows<I, const SIZE: usize> {
    colors: I,
    /// The place of the next one.
    column: i32,
    row: i32,
    left: i32,
    right: i32,
    bottom: i32,
}

impl<I, const SIZE: usize> Rows<I, SIZE> {
    const fn new(area: &Rectangle, colors: I) -> Self {
        let Rectangle { top_left: Point { x, y }, size: Size { width, height } } = *area;
        let (right, bottom) = (x.wrapping_add_unsigned(width), y.wrapping_add_unsigned(height));
        // A rectangle without columns has no row.
        let row = if width == 0 { bottom } else { y };
        Self { colors, column: x, row, left: x, right, bottom }
    }

    #[inline(always)]
    fn next<C: Dither, S: FullColor>(&mut self) -> Option<C>
    where
        I: Iterator<Item = S>,
    {
        if self.row == self.bottom {
            return None;
        }
        let color = C::dithered::<SIZE>(self.colors.next()?, self.column, self.row);
        self.column = self.column.wrapping_add(1);
        if self.column == self.right {
            self.column = self.left;
            self.row = self.row.wrapping_add(1);
        }
        Some(color)
    }
}

impl<T: Dimensions, S, const SIZE: usize> Dimensions for Dithering<'_, T, S, SIZE> {
    fn bounding_box(&self) -> Rectangle {
        self.display.bounding_box()
    }
}

impl<T: DrawTarget<Color: Dither>, S: FullColor + PixelColor, const SIZE: usize> DrawTarget
    for Dithering<'_, T, S, SIZE>
{
    type Color = S;
    type Error = T::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<S>>>(&mut self, pixels: I) -> Result<(), T::Error> {
        self.display.draw_iter(pixels.into_iter().map(|Pixel(point, color)| {
            Pixel(point, T::Color::dithered::<SIZE>(color, point.x, point.y))
        }))
    }

    fn fill_contiguous<I: IntoIterator<Item = S>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), T::Error> {
        let mut rows = Rows::<_, SIZE>::new(area, colors.into_iter());
        self.display.fill_contiguous(area, core::iter::from_fn(|| rows.next()))
    }

    /// In one colour if all thresholds give the same, as they do for black and white.
    fn fill_solid(&mut self, area: &Rectangle, color: S) -> Result<(), T::Error> {
        let at = |column, row| T::Color::dithered::<SIZE>(color, column, row);
        let [lowest, highest] = Bayer::<SIZE>::EXTREMES;
        let solid = at(lowest[0], lowest[1]);
        if solid == at(highest[0], highest[1]) {
            return self.display.fill_solid(area, solid);
        }
        self.fill_contiguous(area, core::iter::repeat(color))
    }
}
