//! Texels of which there are as many as turn out at run time.

use super::{
    Counts, LitTexels, Mix, SHADES, StoredTexels, Texels, TextureError,
    colors::at,
    indexed::Packing,
    masked::is_half,
    shaded::{level_of_shade, shade_of_varying, varying_of_shade},
    texels::{
        level_of_varying, lit_after_filtering, lit_by_palettes, places_in_a_palette,
        varying_of_level, with_alpha,
    },
};

/// Texels like [`Colors`](super::Colors), as a slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColorSlice<'a, C> {
    /// What an index past the end gives.
    first: C,
    texels: &'a [C],
}

impl<'a, C: Copy> ColorSlice<'a, C> {
    /// These texels.
    ///
    /// # Errors
    ///
    /// Returns [`TextureError::Count`] if there are none.
    pub const fn new(texels: &'a [C]) -> Result<Self, TextureError> {
        match texels.first() {
            Some(&first) => Ok(Self { first, texels }),
            None => Err(TextureError::Count),
        }
    }
}

impl<C: Copy> Texels for ColorSlice<'_, C> {
    type Color = C;
    type Texel = C;

    fn counts(&self) -> Counts {
        Counts::exactly(self.texels.len())
    }

    #[inline(always)]
    fn texel(&self, index: usize) -> C {
        *self.texels.get(index).unwrap_or(&self.first)
    }
}

impl<C: Copy + PartialEq> StoredTexels for ColorSlice<'_, C> {
    type Stored = C;

    #[inline(always)]
    fn stored(&self, index: usize) -> C {
        self.texel(index)
    }
}

/// A byte of a slice; 0 past its end.
#[inline(always)]
fn byte(bytes: &[u8], index: usize) -> u8 {
    bytes.get(index).copied().unwrap_or_default()
}

/// Texels like [`Indexed`](super::Indexed), with a slice of bytes. The palette has an array for
/// them: `COLORS` is 2<sup>`BITS`</sup>.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndexedSlice<'a, C, const BITS: usize, const COLORS: usize> {
    bytes: &'a [u8],
    palette: &'a [C; COLORS],
}

impl<'a, C, const BITS: usize, const COLORS: usize> IndexedSlice<'a, C, BITS, COLORS> {
    /// These places in this palette.
    #[must_use]
    pub const fn new(bytes: &'a [u8], palette: &'a [C; COLORS]) -> Self {
        const { Packing::<BITS>::check_palette(COLORS) }
        Self { bytes, palette }
    }
}

impl<C, const BITS: usize, const COLORS: usize> IndexedSlice<'_, C, BITS, COLORS> {
    #[inline(always)]
    fn byte(&self, index: usize) -> u8 {
        byte(self.bytes, index)
    }

    #[inline(always)]
    const fn palette(&self) -> &[C; COLORS] {
        self.palette
    }
}

places_in_a_palette!(
    [] IndexedSlice<'_, C, BITS, COLORS>,
    |texels| Counts::in_bytes(texels.bytes.len(), BITS)
);

lit_after_filtering!([C: Mix] ColorSlice<'_, C>);
lit_after_filtering!([C: Mix, const BITS: usize, const COLORS: usize] IndexedSlice<'_, C, BITS, COLORS>);

/// Texels like [`Shaded`](super::Shaded), with a slice of bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadedSlice<'a, C, const BITS: usize, const COLORS: usize> {
    bytes: &'a [u8],
    palettes: &'a [[C; COLORS]; SHADES],
}

impl<'a, C, const BITS: usize, const COLORS: usize> ShadedSlice<'a, C, BITS, COLORS> {
    /// These places in these palettes, from dark to bright.
    #[must_use]
    pub const fn new(bytes: &'a [u8], palettes: &'a [[C; COLORS]; SHADES]) -> Self {
        const { Packing::<BITS>::check_palette(COLORS) }
        Self { bytes, palettes }
    }
}

impl<C, const BITS: usize, const COLORS: usize> ShadedSlice<'_, C, BITS, COLORS> {
    #[inline(always)]
    fn byte(&self, index: usize) -> u8 {
        byte(self.bytes, index)
    }

    #[inline(always)]
    const fn palette(&self) -> &[C; COLORS] {
        &self.palettes[SHADES - 1]
    }
}

places_in_a_palette!(
    [] ShadedSlice<'_, C, BITS, COLORS>,
    |texels| Counts::in_bytes(texels.bytes.len(), BITS)
);

lit_by_palettes!([] ShadedSlice<'_, C, BITS, COLORS>);

/// Texels with an alpha plane like [`Masked`](super::Masked), as a slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaskedSlice<'a, F, const BITS: usize> {
    texels: F,
    alpha: &'a [u8],
}

impl<'a, F: Texels<Texel = <F as Texels>::Color>, const BITS: usize> MaskedSlice<'a, F, BITS> {
    /// These texels without those of an alpha below half.
    #[must_use]
    pub const fn new(texels: F, alpha: &'a [u8]) -> Self {
        const { assert!(Packing::<BITS>::PART_BITS <= 3) }
        Self { texels, alpha }
    }
}

impl<F, const BITS: usize> MaskedSlice<'_, F, BITS> {
    #[inline(always)]
    fn is_opaque(&self, index: usize) -> bool {
        is_half::<BITS>(byte(self.alpha, index >> Packing::<BITS>::PART_BITS), index)
    }
}

with_alpha!(
    Option, [Copy, const BITS: usize] MaskedSlice<'_, F, BITS>,
    |masked| masked.texels.counts().and(Counts::in_bytes(masked.alpha.len(), BITS))
);
