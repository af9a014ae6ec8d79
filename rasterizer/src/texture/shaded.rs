//! Texels with a table of their colours in each light.

use super::{Counts, LitTexels, StoredTexels, Table, Texels, colors::at, indexed::Packing};

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
            assert!(Packing::<BITS>::PART_BITS <= 3);
            assert!(COLORS == 1 << BITS, "the palette has as many colours as its places have");
            assert!(BYTES > 0, "a texture has texels");
        }
        Self { bytes, palettes }
    }
}

impl<C: Copy, const BITS: usize, const BYTES: usize, const COLORS: usize> Texels
    for Shaded<'_, C, BITS, BYTES, COLORS>
{
    type Color = C;
    type Texel = C;

    fn counts(&self) -> Counts {
        Self::COUNTS
    }

    #[inline(always)]
    fn texel(&self, index: usize) -> C {
        self.before_light(index, SHADES - 1)
    }
}

impl<C: Copy, const BITS: usize, const BYTES: usize, const COLORS: usize> Table
    for Shaded<'_, C, BITS, BYTES, COLORS>
{
    const COUNTS: Counts = Counts::in_bytes(BYTES, BITS);
}

impl<C: Copy, const BITS: usize, const BYTES: usize, const COLORS: usize> StoredTexels
    for Shaded<'_, C, BITS, BYTES, COLORS>
{
    type Stored = u8;

    #[inline(always)]
    fn stored(&self, index: usize) -> u8 {
        let byte = *at(self.bytes, index >> Packing::<BITS>::PART_BITS);
        Packing::<BITS>::unpack(byte, index)
    }
}

impl<C: Copy, const BITS: usize, const BYTES: usize, const COLORS: usize> LitTexels
    for Shaded<'_, C, BITS, BYTES, COLORS>
{
    /// A row of the table.
    type Light = usize;

    #[inline(always)]
    fn varying(level: u32) -> u16 {
        varying_of_shade(level)
    }

    #[inline(always)]
    fn light(varying: u32) -> usize {
        shade_of_varying(varying)
    }

    #[inline(always)]
    fn before_light(&self, index: usize, shade: usize) -> C {
        *at(at(self.palettes, shade), self.stored(index).into())
    }

    #[inline(always)]
    fn after_light(color: C, _: usize) -> C {
        color
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

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
        let mut palettes = [[0; 4]; SHADES];
        for (row, palette) in palettes.iter_mut().enumerate() {
            *palette = [0, 1, 2, 3].map(|place| 100 * row + place);
        }
        let texels: Shaded<'_, usize, 2, 1, 4> = Shaded::new(&[0b00_01_10_11], &palettes);
        assert_eq!([0, 1, 2, 3].map(|i| texels.before_light(i, 7)), [703, 702, 701, 700]);
        assert_eq!(texels.texel(0), 3103);
        assert_eq!(Shaded::<'_, usize, 2, 1, 4>::after_light(5, 0), 5);
    }
}
