//! Pixels as a display's bus takes them.

use bytemuck::{Pod, Zeroable};
use embedded_graphics_core::pixelcolor::{
    IntoStorage, PixelColor, Rgb565, Rgb888,
    raw::{RawData, RawU16},
};
use fixed::types::U16F16;

use super::{StoredColor, WordFill};
use crate::{
    color::{Alpha, Channels, Composite, Dither, FullColor, Mean},
    numbers::IS_NARROW,
    texture::{Mix, Spread},
};

/// RGB565 with its more significant byte first, the order in which SPI displays take it: a DMA
/// channel can send a band of these as it lies in memory.
///
/// Shaders compute their colours before they draw pixels, so a pixel costs the same in this order
/// as in any other. The type is plain data and is filled by words: runs of one colour cost less
/// than with [`Rgb565`].
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// use rasterizer::output::Rgb565Be;
///
/// let pixels = [Rgb565::RED, Rgb565::BLUE].map(Rgb565Be::from);
/// assert_eq!(Rgb565Be::as_bytes(&pixels), [0xF8, 0x00, 0x00, 0x1F]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Pod, Zeroable)]
#[repr(transparent)]
pub struct Rgb565Be(u16);

impl Rgb565Be {
    /// No light at all, with no bit set: memory in a static that starts with it takes no flash.
    pub const BLACK: Self = Self(0);

    /// A colour of 5 bits of red, 6 of green and 5 of blue. More significant bits are ignored.
    ///
    /// ```
    /// use embedded_graphics_core::pixelcolor::Rgb565;
    /// use rasterizer::output::Rgb565Be;
    ///
    /// const ORANGE: Rgb565Be = Rgb565Be::new(31, 40, 3);
    /// assert_eq!(ORANGE, Rgb565::new(31, 40, 3).into());
    /// assert_eq!(Rgb565Be::new(32 + 1, 64 + 2, 255), Rgb565Be::new(1, 2, 31));
    /// ```
    #[must_use]
    pub const fn new(red: u8, green: u8, blue: u8) -> Self {
        let (red, green, blue) = (red as u16 & 31, green as u16 & 63, blue as u16 & 31);
        Self((red << 11 | green << 5 | blue).to_be())
    }

    /// Returns the bytes of pixels, two for each, without a copy.
    #[must_use]
    pub const fn as_bytes(pixels: &[Self]) -> &[u8] {
        bytemuck::must_cast_slice(pixels)
    }
}

impl PixelColor for Rgb565Be {
    type Raw = RawU16;
}

impl StoredColor for Rgb565Be {
    type Fill = WordFill<Self>;
}

/// How the channels of a stored word are spread: its bytes stay in their order.
const SPREAD: Spread =
    if cfg!(target_endian = "big") { Spread::OF_565 } else { Spread::OF_SWAPPED_565 };

/// As [`Rgb565`].
impl Mix for Rgb565Be {
    const FRACTION_BITS: u32 = Rgb565::FRACTION_BITS;
    const LIGHT_BITS: u32 = Rgb565::LIGHT_BITS;

    #[inline(always)]
    fn mixed(colors: [Self; 4], fractions: [u32; 2]) -> Self {
        // Cores that turn an operand within its instruction save the bytes' change of place.
        if IS_NARROW {
            Rgb565::mixed(colors.map(Rgb565::from), fractions).into()
        } else {
            Self(SPREAD.mixed(colors.map(|color| color.0), fractions))
        }
    }

    #[inline(always)]
    fn lit(self, level: u32) -> Self {
        Self(SPREAD.lit(self.0, level))
    }
}

/// As [`Rgb565`].
impl Mean for Rgb565Be {
    type Sum = u32;

    const NOTHING: u32 = Rgb565::NOTHING;

    #[inline(always)]
    fn added_to(self, sum: u32) -> u32 {
        Rgb565::from(self).added_to(sum)
    }

    #[inline(always)]
    fn of_sum(sum: u32, bits: u32) -> Self {
        Rgb565::of_sum(sum, bits).into()
    }
}

/// As [`Rgb565`].
impl Composite for Rgb565Be {
    #[inline(always)]
    fn over(self, stored: Self, alpha: Alpha) -> Self {
        Rgb565::from(self).over(stored.into(), alpha).into()
    }

    #[inline(always)]
    fn add(self, stored: Self, alpha: Alpha) -> Self {
        Rgb565::from(self).add(stored.into(), alpha).into()
    }

    #[inline(always)]
    fn multiply(self, stored: Self, alpha: Alpha) -> Self {
        Rgb565::from(self).multiply(stored.into(), alpha).into()
    }

    #[inline(always)]
    fn screen(self, stored: Self, alpha: Alpha) -> Self {
        Rgb565::from(self).screen(stored.into(), alpha).into()
    }
}

/// As [`Rgb565`].
impl Channels for Rgb565Be {
    type Varyings = [u16; 3];

    #[inline(always)]
    fn varyings(rgb: [u32; 3]) -> [u16; 3] {
        Rgb565::varyings(rgb)
    }

    #[inline(always)]
    fn of(sample: [U16F16; 3]) -> Self {
        Rgb565::of(sample).into()
    }
}

/// As [`Rgb565`].
impl Dither for Rgb565Be {
    #[inline(always)]
    fn dithered<const SIZE: usize>(color: impl FullColor, column: i32, row: i32) -> Self {
        Rgb565::dithered::<SIZE>(color, column, row).into()
    }
}

impl From<Rgb565> for Rgb565Be {
    fn from(color: Rgb565) -> Self {
        Self(color.into_storage().to_be())
    }
}

impl From<Rgb565Be> for Rgb565 {
    fn from(color: Rgb565Be) -> Self {
        RawU16::new(u16::from_be(color.0)).into()
    }
}

impl From<Rgb888> for Rgb565Be {
    fn from(color: Rgb888) -> Self {
        Rgb565::from(color).into()
    }
}

/// As it lies in memory.
impl From<RawU16> for Rgb565Be {
    fn from(raw: RawU16) -> Self {
        Self(raw.into_inner())
    }
}

/// As it lies in memory.
impl From<Rgb565Be> for RawU16 {
    fn from(color: Rgb565Be) -> Self {
        Self::new(color.0)
    }
}
