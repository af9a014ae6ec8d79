//! Texels that are places in a palette.

use super::{
    Counts, LitTexels, Mix, StoredTexels, Table, Texels,
    colors::at,
    texels::{level_of_varying, lit_after_filtering, places_in_a_palette, varying_of_level},
};

/// The parts of a byte that texels of `BITS` bits are.
///
/// The leftmost texel is in the least significant bits. Rows follow each other without padding.
pub(super) struct Packing<const BITS: usize>;

impl<const BITS: usize> Packing<BITS> {
    /// Binary digits of a texel's number that tell its part of the byte.
    pub(super) const PART_BITS: u32 = {
        assert!(
            BITS == 1 || BITS == 2 || BITS == 4 || BITS == 8,
            "texels in bytes have 1, 2, 4 or 8 bits"
        );
        (8 / BITS as u32).trailing_zeros()
    };

    /// Panics, in a constant, if a palette has not one colour for each place.
    pub(super) const fn check_palette(colors: usize) {
        assert!(
            Self::PART_BITS <= 3 && colors == 1 << BITS,
            "the palette has as many colours as its places have"
        );
    }

    /// The part of its byte that a texel is.
    #[inline(always)]
    pub(super) const fn unpack(byte: u8, index: usize) -> u8 {
        let part = index & ((1 << Self::PART_BITS) - 1);
        (byte >> (part * BITS)) & (u8::MAX >> (8 - BITS))
    }

    /// A part as a number of eight bits, of which 255 is the largest part.
    #[inline(always)]
    pub(super) const fn widened(part: u8) -> u8 {
        part * (u8::MAX / (u8::MAX >> (8 - BITS)))
    }
}

/// Texels of `BITS` bits, 8, 4, 2 or 1, that are places in a palette of `COLORS` =
/// 2<sup>`BITS`</sup> colours, in `BYTES` bytes: the leftmost texel in the least significant bits,
/// rows one after the other without padding.
///
/// With a palette of greys it is an image of 8, 4, 2 or 1 bits of grey.
///
/// ```
/// use embedded_graphics_core::pixelcolor::Gray8;
/// use rasterizer::texture::{Indexed, Texels};
///
/// const DARK_AND_BRIGHT: [Gray8; 2] = [Gray8::new(0), Gray8::new(200)];
/// let texels: Indexed<'_, Gray8, 1, 1, 2> = Indexed::new(&[0b0000_0110], &DARK_AND_BRIGHT);
/// assert_eq!([0, 1, 2, 3].map(|i| texels.texel(i)), [0, 200, 200, 0].map(Gray8::new));
/// ```
///
/// A palette of another size does not compile, nor do texels of other sizes:
///
/// ```compile_fail,E0080
/// # use embedded_graphics_core::pixelcolor::Gray8;
/// # use rasterizer::texture::Indexed;
/// let texels: Indexed<'_, Gray8, 2, 1, 3> = Indexed::new(&[0], &[Gray8::new(0); 3]);
/// ```
///
/// ```compile_fail,E0080
/// # use embedded_graphics_core::pixelcolor::Gray8;
/// # use rasterizer::texture::Indexed;
/// let texels: Indexed<'_, Gray8, 3, 1, 8> = Indexed::new(&[0], &[Gray8::new(0); 8]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Indexed<'a, C, const BITS: usize, const BYTES: usize, const COLORS: usize> {
    bytes: &'a [u8; BYTES],
    palette: &'a [C; COLORS],
}

impl<'a, C, const BITS: usize, const BYTES: usize, const COLORS: usize>
    Indexed<'a, C, BITS, BYTES, COLORS>
{
    /// These places in this palette.
    #[must_use]
    pub const fn new(bytes: &'a [u8; BYTES], palette: &'a [C; COLORS]) -> Self {
        const {
            Packing::<BITS>::check_palette(COLORS);
            assert!(BYTES > 0, "a texture has texels");
        }
        Self { bytes, palette }
    }
}

impl<C, const BITS: usize, const BYTES: usize, const COLORS: usize>
    Indexed<'_, C, BITS, BYTES, COLORS>
{
    #[inline(always)]
    const fn byte(&self, index: usize) -> u8 {
        *at(self.bytes, index)
    }

    #[inline(always)]
    const fn palette(&self) -> &[C; COLORS] {
        self.palette
    }
}

places_in_a_palette!(
    [, const BYTES: usize] Indexed<'_, C, BITS, BYTES, COLORS>,
    |_| Self::COUNTS
);

impl<C: Copy, const BITS: usize, const BYTES: usize, const COLORS: usize> Table
    for Indexed<'_, C, BITS, BYTES, COLORS>
{
    const COUNTS: Counts = Counts::in_bytes(BYTES, BITS);
}

lit_after_filtering!(
    [C: Mix, const BITS: usize, const BYTES: usize, const COLORS: usize]
    Indexed<'_, C, BITS, BYTES, COLORS>
);

#[cfg(test)]
mod tests {
    use super::*;

    const PALETTE: [u16; 256] = {
        let mut palette = [0; 256];
        let mut place = 0;
        while place < 256 {
            palette[place] = 1000 + place as u16;
            place += 1;
        }
        palette
    };

    fn first<const BITS: usize, const COLORS: usize>() -> [u16; 16] {
        let palette = PALETTE.first_chunk::<COLORS>().unwrap();
        let texels: Indexed<'_, _, BITS, 2, COLORS> =
            Indexed::new(&[0b1110_0100, 0b0001_1011], palette);
        core::array::from_fn(|index| texels.texel(index) - 1000)
    }

    #[test]
    fn the_leftmost_texel_is_in_the_lowest_bits() {
        assert_eq!(first::<1, 2>(), [0, 0, 1, 0, 0, 1, 1, 1, 1, 1, 0, 1, 1, 0, 0, 0]);
        assert_eq!(first::<2, 4>()[..8], [0, 1, 2, 3, 3, 2, 1, 0]);
        assert_eq!(first::<4, 16>()[..4], [4, 14, 11, 1]);
        assert_eq!(first::<8, 256>()[..2], [0b1110_0100, 0b0001_1011]);
    }
}
