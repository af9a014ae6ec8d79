//! Texels of which some are transparent.

use super::{
    Counts, LitTexels, StoredTexels, Table, Texels, colors::at, indexed::Packing,
    texels::with_alpha,
};

/// Texels of which those with one stored value, the key, are transparent: a colour, or with a
/// palette a place in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keyed<F: StoredTexels> {
    texels: F,
    key: F::Stored,
}

impl<F: StoredTexels> Keyed<F> {
    /// These texels without those that have the key.
    #[must_use]
    pub const fn new(texels: F, key: F::Stored) -> Self {
        Self { texels, key }
    }

    #[inline(always)]
    fn is_opaque(&self, index: usize) -> bool {
        self.texels.stored(index) != self.key
    }
}

with_alpha!(Option, [StoredTexels] Keyed<F>, |keyed| keyed.texels.counts());

impl<F: StoredTexels + Table> Table for Keyed<F> {
    const COUNTS: Counts = F::COUNTS;
}

/// Texels with an alpha plane of `BITS` bits, 1, 4 or 8 (or 2), in `BYTES` bytes, packed like
/// [`Indexed`](super::Indexed): those below half are transparent, all others opaque.
///
/// A plane that does not go with the texels does not compile:
///
/// ```compile_fail,E0080
/// # use embedded_graphics_core::pixelcolor::Gray8;
/// # use rasterizer::texture::{Colors, Masked};
/// const GRAY: Gray8 = Gray8::new(7);
/// let texels: Masked<'_, _, 4, 3> = Masked::new(Colors::new(&[GRAY; 8]), &[0; 3]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Masked<'a, F, const BITS: usize, const BYTES: usize> {
    texels: F,
    alpha: &'a [u8; BYTES],
}

impl<'a, F: Table<Texel = <F as Texels>::Color>, const BITS: usize, const BYTES: usize>
    Masked<'a, F, BITS, BYTES>
{
    /// These texels without those of an alpha below half.
    #[must_use]
    pub const fn new(texels: F, alpha: &'a [u8; BYTES]) -> Self {
        const {
            assert!(BYTES > 0 && Packing::<BITS>::PART_BITS <= 3);
            assert!(!Self::COUNTS.is_empty(), "the alpha plane has as many texels as the colours");
        }
        Self { texels, alpha }
    }
}

impl<F, const BITS: usize, const BYTES: usize> Masked<'_, F, BITS, BYTES> {
    #[inline(always)]
    const fn is_opaque(&self, index: usize) -> bool {
        let byte = *at(self.alpha, index >> Packing::<BITS>::PART_BITS);
        is_half::<BITS>(byte, index)
    }
}

/// Whether the part of a byte has its most significant bit set: half, or more.
#[inline(always)]
pub(super) const fn is_half<const BITS: usize>(byte: u8, index: usize) -> bool {
    Packing::<BITS>::unpack(byte, index) >> (BITS - 1) != 0
}

with_alpha!(
    Option, [Copy, const BITS: usize, const BYTES: usize] Masked<'_, F, BITS, BYTES>,
    |masked| masked.texels.counts().and(Counts::in_bytes(BYTES, BITS))
);

impl<F: Table<Texel = <F as Texels>::Color>, const BITS: usize, const BYTES: usize> Table
    for Masked<'_, F, BITS, BYTES>
{
    const COUNTS: Counts = F::COUNTS.and(Counts::in_bytes(BYTES, BITS));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{Colors, Indexed};

    #[test]
    fn the_key_is_transparent() {
        let colors = Keyed::new(Colors::new(&[3, 9, 5]), 9);
        assert_eq!([0, 1, 2].map(|i| colors.texel(i)), [Some(3), None, Some(5)]);
        // The same colour at another place of the palette is opaque.
        let places: Indexed<'_, i32, 2, 1, 4> = Indexed::new(&[0b11_10_01_00], &[7, 7, 7, 8]);
        let keyed = Keyed::new(places, 1);
        assert_eq!([0, 1, 2, 3].map(|i| keyed.texel(i)), [Some(7), None, Some(7), Some(8)]);
    }

    #[test]
    fn less_than_half_is_transparent() {
        const COLORS: [i32; 4] = [1, 2, 3, 4];
        let bits: Masked<'_, _, 1, 1> = Masked::new(Colors::new(&COLORS), &[0b1010]);
        assert_eq!([0, 1, 2, 3].map(|i| bits.texel(i)), [None, Some(2), None, Some(4)]);
        let nibbles: Masked<'_, _, 4, 2> = Masked::new(Colors::new(&COLORS), &[0x87, 0x0F]);
        assert_eq!([0, 1, 2, 3].map(|i| nibbles.texel(i)), [None, Some(2), Some(3), None]);
        let bytes: Masked<'_, _, 8, 4> = Masked::new(Colors::new(&COLORS), &[127, 128, 255, 0]);
        assert_eq!([0, 1, 2, 3].map(|i| bytes.texel(i)), [None, Some(2), Some(3), None]);
    }
}
