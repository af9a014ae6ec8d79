//! The formats of textures: what a program or a build script may choose.

use embedded_graphics_core::pixelcolor::{Gray8, Rgb565, Rgb888};
use rasterizer::color::Rgb332;

/// How pictures become textures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TextureOptions {
    /// Width and height, 1 to 1,024, powers of two where a texture repeats; `None` for those of the
    /// largest picture, rounded to powers of two and halved until no side is over 256.
    pub size: Option<[usize; 2]>,
    /// How texels are stored.
    pub format: TexelFormat,
    /// The colours of the palette, or of the texels if there is none.
    pub color: ColorFormat,
    /// Whether there are mip levels: the texture in half the size (rounded down), a quarter and so
    /// on.
    pub mipmaps: bool,
    /// How transparency is stored where a picture has any; `None` for a key if any of its texels is
    /// more transparent than opaque.
    pub alpha: Option<AlphaFormat>,
}

/// How texels are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TexelFormat {
    /// Each texel is a colour.
    Direct,
    /// 8 bits a texel, in a palette of 256 colours.
    #[default]
    Indexed8,
    /// 4 bits a texel, 16 colours.
    Indexed4,
    /// 2 bits a texel, 4 colours.
    Indexed2,
    /// 1 bit a texel, 2 colours.
    Indexed1,
    /// 8 bits a texel, 256 greys.
    Gray8,
    /// 4 bits a texel, 16 greys.
    Gray4,
}

impl TexelFormat {
    /// All of them, by name.
    pub const NAMES: [(&'static str, Self); 7] = [
        ("direct", Self::Direct),
        ("indexed8", Self::Indexed8),
        ("indexed4", Self::Indexed4),
        ("indexed2", Self::Indexed2),
        ("indexed1", Self::Indexed1),
        ("gray8", Self::Gray8),
        ("gray4", Self::Gray4),
    ];

    /// The bits of a place in the palette; `None` without a palette.
    #[must_use]
    pub const fn bits(self) -> Option<usize> {
        match self {
            Self::Direct => None,
            Self::Indexed8 | Self::Gray8 => Some(8),
            Self::Indexed4 | Self::Gray4 => Some(4),
            Self::Indexed2 => Some(2),
            Self::Indexed1 => Some(1),
        }
    }

    pub(super) const fn is_gray(self) -> bool {
        matches!(self, Self::Gray8 | Self::Gray4)
    }
}

/// The colour type of the target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ColorFormat {
    /// `Rgb565`.
    #[default]
    Rgb565,
    /// `Rgb565Be`: RGB565 in the byte order of SPI displays.
    Rgb565Be,
    /// `Rgb888`.
    Rgb888,
    /// `Gray8`.
    Gray8,
    /// `Rgb332`: a byte of 3 bits of red, 3 of green and 2 of blue.
    Rgb332,
}

impl ColorFormat {
    /// All of them, by name.
    pub const NAMES: [(&'static str, Self); 5] = [
        ("rgb565", Self::Rgb565),
        ("rgb565be", Self::Rgb565Be),
        ("rgb888", Self::Rgb888),
        ("gray8", Self::Gray8),
        ("rgb332", Self::Rgb332),
    ];

    /// The bytes of a colour in flash.
    #[must_use]
    pub const fn bytes(self) -> usize {
        match self {
            Self::Rgb565 | Self::Rgb565Be => size_of::<Rgb565>(),
            Self::Rgb888 => size_of::<Rgb888>(),
            Self::Gray8 => size_of::<Gray8>(),
            Self::Rgb332 => size_of::<Rgb332>(),
        }
    }

    /// The number of the colour nearest to one in steps of 8 bits: 0xRRGGBB, RGB565 with red in the
    /// most significant bits (for both byte orders), RGB332 in the same way, or the grey.
    pub(super) fn number(self, [red, green, blue]: [f64; 3]) -> u32 {
        let digits = |value: f64, most: f64| (value / 255.0 * most).round() as u32;
        match self {
            Self::Rgb565 | Self::Rgb565Be => {
                digits(red, 31.0) << 11 | digits(green, 63.0) << 5 | digits(blue, 31.0)
            }
            Self::Rgb888 => {
                digits(red, 255.0) << 16 | digits(green, 255.0) << 8 | digits(blue, 255.0)
            }
            Self::Rgb332 => digits(red, 7.0) << 5 | digits(green, 7.0) << 2 | digits(blue, 3.0),
            // The luma of ITU-R BT.601, of stored values.
            Self::Gray8 => digits(0.299 * red + 0.587 * green + 0.114 * blue, 255.0),
        }
    }

    /// A colour in steps of 8 bits from its number.
    #[must_use]
    pub fn rgb(self, number: u32) -> [f64; 3] {
        let part = |shift: u32, bits: u32| {
            let most = (1_u32 << bits) - 1;
            f64::from(number >> shift & most) / f64::from(most) * 255.0
        };
        match self {
            Self::Rgb565 | Self::Rgb565Be => [part(11, 5), part(5, 6), part(0, 5)],
            Self::Rgb888 => [part(16, 8), part(8, 8), part(0, 8)],
            Self::Gray8 => [part(0, 8); 3],
            Self::Rgb332 => [part(5, 3), part(2, 3), part(0, 2)],
        }
    }

    /// The colour that stands for transparency, and the one that takes its place elsewhere: magenta
    /// or black, and the next colour.
    pub(super) const fn key(self) -> [u32; 2] {
        match self {
            Self::Rgb565 | Self::Rgb565Be => [0xF81F, 0xF83F],
            Self::Rgb888 => [0xFF_00FF, 0xFF_01FF],
            Self::Gray8 => [0, 1],
            Self::Rgb332 => [0xE3, 0xE7],
        }
    }
}

/// How transparency is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AlphaFormat {
    /// One colour, or the palette's first place, is transparent.
    Key,
    /// A plane of 1 bit a texel.
    Bits1,
    /// A plane of 4 bits a texel.
    Bits4,
    /// A plane of 8 bits a texel.
    Bits8,
    /// A plane of 4 bits a texel, for blending: the texels are `Translucent`.
    Translucent4,
    /// A plane of 8 bits a texel, for blending.
    Translucent8,
}

impl AlphaFormat {
    /// All of them, by name.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("key", Self::Key),
        ("1", Self::Bits1),
        ("4", Self::Bits4),
        ("8", Self::Bits8),
        ("translucent4", Self::Translucent4),
        ("translucent8", Self::Translucent8),
    ];

    /// The bits of the plane; `None` without one.
    #[must_use]
    pub const fn bits(self) -> Option<usize> {
        match self {
            Self::Key => None,
            Self::Bits1 => Some(1),
            Self::Bits4 | Self::Translucent4 => Some(4),
            Self::Bits8 | Self::Translucent8 => Some(8),
        }
    }

    /// Whether texels are blended by their alpha, and not drawn or left out.
    #[must_use]
    pub const fn is_translucent(self) -> bool {
        matches!(self, Self::Translucent4 | Self::Translucent8)
    }
}

/// What lies beyond the borders of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureWrap {
    /// The texture again.
    Repeat,
    /// The texels of its border.
    Clamp,
}

/// The name of a choice.
pub(super) fn name<T: PartialEq>(names: &[(&'static str, T)], choice: &T) -> &'static str {
    names.iter().find(|(_, named)| named == choice).map_or("", |(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_rounded_to_the_nearest() {
        for (format, numbers) in [
            (ColorFormat::Rgb565, 0..=0xFFFF_u32),
            (ColorFormat::Rgb565Be, 0..=0xFFFF),
            (ColorFormat::Rgb888, 0x12_3400..=0x12_34FF),
            (ColorFormat::Gray8, 0..=255),
            (ColorFormat::Rgb332, 0..=255),
        ] {
            for number in numbers {
                assert_eq!(format.number(format.rgb(number)), number, "{format:?}");
            }
        }
        // 4 and 5 of 31 are 32.9 and 41.1, 8 and 9 of 63 are 32.4 and 36.4.
        assert_eq!(ColorFormat::Rgb565.number([37.0; 3]), 4 << 11 | 9 << 5 | 4);
        assert_eq!(ColorFormat::Gray8.number([255.0, 0.0, 0.0]), 76);
        // 1 of 7 is 36.4, and 0 and 1 of 3 are 0 and 85.
        assert_eq!(ColorFormat::Rgb332.number([37.0; 3]), 1 << 5 | 1 << 2);
    }

    #[test]
    fn colours_take_the_bytes_of_their_types() {
        assert_eq!(ColorFormat::NAMES.map(|(_, format)| format.bytes()), [2, 2, 4, 1, 1]);
        assert_eq!(name(&ColorFormat::NAMES, &ColorFormat::Rgb888), "rgb888");
    }
}
