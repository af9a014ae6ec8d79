//! Texels with a table of their colours in each light.

use super::{
    Counts, LitTexels, Mix, StoredTexels, Table, Texels,
    colors::at,
    indexed::Packing,
    texels::{lit_by_palettes, places_in_a_palette},
};

/// The rows of a table of lit palettes.
pub const SHADES: usize = 32;

/// Texels like [`Indexed`](super::Indexed), lit by a table: [`SHADES`] palettes from dark to
/// bright, row r for the brightness r / 31.
///
/// It is the least work a pixel for lit texels (15 KB of flash more with 256 colours), the colours
/// are as exact as the table, and can follow any course: coloured light, fog, a cartoon's steps.
/// Unlit texels have the colours of the last row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shaded<'a, C, const BITS: usize, const BYTES: usize, const COLORS: usize> {
    bytes: &'a [u8; BYTES],
    palettes: &'a [[C; COLORS]; SHADES],
}

impl<'a, C, const BITS: usize, const BYTES: usize, const COLORS: usize>
    Shaded<'a, C, BITS, BYTES, COLORS>
{
    /// These places in these palettes, from dark to bright.
    #[must_use]
    pub const fn new(bytes: &'a [u8; BYTES], palettes: &'a [[C; COLORS]; SHADES]) -> Self {
        const {
            Packing::<BITS>::check_palette(COLORS);
            assert!(BYTES > 0, "a texture has texels");
        }
        Self { bytes, palettes }
    }
}

impl<C, const BITS: usize, const BYTES: usize, const COLORS: usize>
    Shaded<'_, C, BITS, BYTES, COLORS>
{
    #[inline(always)]
    const fn byte(&self, index: usize) -> u8 {
        *at(self.bytes, index)
    }

    #[inline(always)]
    const fn palette(&self) -> &[C; COLORS] {
        &self.palettes[SHADES - 1]
    }
}

places_in_a_palette!(
    [, const BYTES: usize] Shaded<'_, C, BITS, BYTES, COLORS>,
    |_| Self::COUNTS
);

impl<C: Copy, const BITS: usize, const BYTES: usize, const COLORS: usize> Table
    for Shaded<'_, C, BITS, BYTES, COLORS>
{
    const COUNTS: Counts = Counts::in_bytes(BYTES, BITS);
}

lit_by_palettes!([, const BYTES: usize] Shaded<'_, C, BITS, BYTES, COLORS>);

/// 0 and 65,536 lie in the middle of the first and the last row: the row is the upper bits.
#[inline(always)]
pub(super) const fn varying_of_shade(level: u32) -> u16 {
    (level - level / SHADES as u32 + 65_536 / (2 * SHADES as u32)) as u16
}

/// The upper bits of an interpolated varying in Q16.16.
#[inline(always)]
pub(super) const fn shade_of_varying(varying: u32) -> usize {
    (varying >> (32 - SHADES.trailing_zeros())) as usize
}

/// The level of [`Mix::lit`] that a row stands for, r / 31 in units of 2^-bits, rounded: 1 / 31 is
/// 1057 / 2^15 within 2^-15 of itself.
#[inline(always)]
pub(super) const fn level_of_shade(shade: usize, bits: u32) -> u32 {
    (((shade as u32) << bits) * 1057 + (1 << 14)) >> 15
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::{Gray8, GrayColor as _};

    use super::*;

    #[test]
    fn rows_stand_for_levels() {
        for shade in 0..SHADES {
            for bits in 1..=8 {
                let exact = shade as f64 / 31.0 * f64::from(1 << bits);
                let level = level_of_shade(shade, bits);
                assert_eq!(f64::from(level), exact.round(), "{shade} of {bits} bits");
            }
        }
    }

    #[test]
    fn the_nearest_row_lights() {
        for level in 0..=65_536u32 {
            let varying = (u32::from(varying_of_shade(level)) << 16) + (1 << 15);
            let row = shade_of_varying(varying) as f64;
            let exact = f64::from(level) * 31.0 / 65_536.0;
            assert!((row - exact).abs() <= 0.502, "{level}: {row}");
        }
    }

    #[test]
    fn places_are_looked_up_in_the_lights_row() {
        let mut palettes = [[Gray8::new(0); 4]; SHADES];
        for (row, palette) in palettes.iter_mut().enumerate() {
            *palette = [0, 1, 2, 3].map(|place| Gray8::new(4 * row as u8 + place));
        }
        type Two<'a> = Shaded<'a, Gray8, 2, 1, 4>;
        let texels: Two<'_> = Shaded::new(&[0b00_01_10_11], &palettes);
        let lit = [0, 1, 2, 3].map(|index| texels.before_light(index, 7).luma());
        assert_eq!(lit, [31, 30, 29, 28]);
        assert_eq!(texels.texel(0).luma(), 4 * 31 + 3);
        assert_eq!(Two::after_light(Gray8::new(5), 0).luma(), 5);
        assert_eq!(Two::plain(Gray8::new(62), 15).luma(), 30);
    }
}
