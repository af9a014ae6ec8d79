//! A display that keeps a checksum of what it is sent.

use core::convert::Infallible;

use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{OriginDimensions, Point, Size},
    pixelcolor::{IntoStorage, Rgb565},
    primitives::Rectangle,
};

/// The largest picture.
const SIZE: Size = Size::new(320, 240);

/// A display of 320 x 240 pixels that costs next to no code, and lets the compiler leave out none
/// of the rasterizer's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Display {
    checksum: u32,
}

impl Display {
    /// FNV-1a over the places and colours it was sent, by words; 0 before the first.
    #[must_use]
    pub const fn checksum(&self) -> u32 {
        self.checksum
    }

    /// Out of line, so that its code counts once.
    #[inline(never)]
    const fn take(&mut self, word: u32) {
        self.take_inline(word);
    }

    /// The same in line, as a driver takes a pixel.
    #[inline(always)]
    pub const fn take_inline(&mut self, word: u32) {
        self.checksum = (self.checksum ^ word).wrapping_mul(0x0100_0193);
    }

    /// Takes a place.
    pub const fn take_at(&mut self, place: Point) {
        self.go_to(place.x, place.y);
    }

    const fn go_to(&mut self, x: i32, y: i32) {
        self.take((y << 16 ^ x) as u32);
    }
}

impl OriginDimensions for Display {
    fn size(&self) -> Size {
        SIZE
    }
}

impl DrawTarget for Display {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(point, color) in pixels {
            self.go_to(point.x, point.y);
            self.take(color.into_storage().into());
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        self.go_to(area.top_left.x, area.top_left.y);
        for color in colors {
            self.take(color.into_storage().into());
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Rgb565) -> Result<(), Infallible> {
        self.go_to(area.top_left.x, area.top_left.y);
        for _ in 0..area.size.width * area.size.height {
            self.take(color.into_storage().into());
        }
        Ok(())
    }
}
