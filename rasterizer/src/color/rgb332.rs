//! A colour in a byte.

use bytemuck::{Pod, Zeroable};
use embedded_graphics_core::pixelcolor::{
    PixelColor, Rgb888, RgbColor,
    raw::{RawData as _, RawU8},
};

use super::dither::divided_by_255;

/// Three bits of red, three of green and two of blue, from the most significant bit on: for
/// displays and frame buffers with a byte a pixel.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
/// use rasterizer::color::Rgb332;
///
/// let orange = Rgb332::from(Rgb888::new(255, 140, 0));
/// assert_eq!(orange, Rgb332::new(7, 4, 0));
/// assert_eq!(Rgb332::as_bytes(&[orange, Rgb332::BLUE]), [0b111_100_00, 0b000_000_11]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Pod, Zeroable)]
#[repr(transparent)]
pub struct Rgb332(u8);

impl Rgb332 {
    /// A colour of 3 bits of red, 3 of green and 2 of blue. More significant bits are ignored.
    #[must_use]
    pub const fn new(red: u8, green: u8, blue: u8) -> Self {
        Self((red & 7) << 5 | (green & 7) << 2 | blue & 3)
    }

    /// Returns the bytes of pixels, one for each, without a copy.
    #[must_use]
    pub const fn as_bytes(pixels: &[Self]) -> &[u8] {
        bytemuck::must_cast_slice(pixels)
    }
}

impl PixelColor for Rgb332 {
    type Raw = RawU8;
}

impl RgbColor for Rgb332 {
    const MAX_R: u8 = 7;
    const MAX_G: u8 = 7;
    const MAX_B: u8 = 3;

    const BLACK: Self = Self::new(0, 0, 0);
    const RED: Self = Self::new(7, 0, 0);
    const GREEN: Self = Self::new(0, 7, 0);
    const BLUE: Self = Self::new(0, 0, 3);
    const YELLOW: Self = Self::new(7, 7, 0);
    const MAGENTA: Self = Self::new(7, 0, 3);
    const CYAN: Self = Self::new(0, 7, 3);
    const WHITE: Self = Self::new(7, 7, 3);

    #[inline(always)]
    fn r(&self) -> u8 {
        self.0 >> 5
    }

    #[inline(always)]
    fn g(&self) -> u8 {
        self.0 >> 2 & 7
    }

    #[inline(always)]
    fn b(&self) -> u8 {
        self.0 & 3
    }
}

/// Each channel is rounded to the nearest.
impl From<Rgb888> for Rgb332 {
    #[inline(always)]
    fn from(color: Rgb888) -> Self {
        let channel = |value: u8, most: u32| divided_by_255(u32::from(value) * most + 127) as u8;
        Self::new(channel(color.r(), 7), channel(color.g(), 7), channel(color.b(), 3))
    }
}

/// Each channel is rounded to the nearest: black and white stay black and white.
impl From<Rgb332> for Rgb888 {
    #[inline(always)]
    fn from(color: Rgb332) -> Self {
        // 255 / 7 in Q8, rounded up, is 9,326: 2 / 7 of 1/256 above it, and no seventh of 255 lies
        // nearer than 1/14 to the middle of two whole numbers. 255 / 3 is a whole number.
        let of_seven = |value: u8| ((u32::from(value) * 9_326 + 128) >> 8) as u8;
        Self::new(of_seven(color.r()), of_seven(color.g()), color.b() * 85)
    }
}

impl From<RawU8> for Rgb332 {
    fn from(raw: RawU8) -> Self {
        Self(raw.into_inner())
    }
}

impl From<Rgb332> for RawU8 {
    fn from(color: Rgb332) -> Self {
        Self::new(color.0)
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::IntoStorage;

    use super::*;

    #[test]
    fn channels_are_rounded_to_the_nearest() {
        let nearest = |value: u8, most: f64| (f64::from(value) / 255.0 * most).round() as u8;
        for value in 0..=255u8 {
            let color = Rgb332::from(Rgb888::new(value, 255 - value, value));
            assert_eq!(color.r(), nearest(value, 7.0), "{value}");
            assert_eq!(color.g(), nearest(255 - value, 7.0), "{value}");
            assert_eq!(color.b(), nearest(value, 3.0), "{value}");
        }
        for bits in 0..=255u8 {
            let color = Rgb332::from(RawU8::new(bits));
            let wide = Rgb888::from(color);
            let full = |value: u8, most: f64| (f64::from(value) * 255.0 / most).round() as u8;
            let wanted = [full(bits >> 5, 7.0), full(bits >> 2 & 7, 7.0), full(bits & 3, 3.0)];
            assert_eq!([wide.r(), wide.g(), wide.b()], wanted, "{bits:08b}");
            assert_eq!(Rgb332::from(wide), color);
            assert_eq!(color.into_storage(), bits);
        }
    }

    #[test]
    fn each_named_color_is_that_of_24_bits() {
        let all = [
            (Rgb332::BLACK, Rgb888::BLACK),
            (Rgb332::RED, Rgb888::RED),
            (Rgb332::GREEN, Rgb888::GREEN),
            (Rgb332::BLUE, Rgb888::BLUE),
            (Rgb332::YELLOW, Rgb888::YELLOW),
            (Rgb332::MAGENTA, Rgb888::MAGENTA),
            (Rgb332::CYAN, Rgb888::CYAN),
            (Rgb332::WHITE, Rgb888::WHITE),
        ];
        for (color, wide) in all {
            assert_eq!((Rgb888::from(color), Rgb332::from(wide)), (wide, color));
        }
    }
}
