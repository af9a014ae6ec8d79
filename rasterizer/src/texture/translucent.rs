//! Texels of which each has an alpha.

use super::{
    Counts, Layer, LitTexels, StoredTexels, Table, Texels, colors::at, indexed::Packing,
    texels::with_alpha,
};
use crate::color::Alpha;

/// Texels with an alpha plane of `BITS` bits, 4 or 8 (or 1 or 2), in `BYTES` bytes, packed like
/// [`Indexed`](super::Indexed): each gives a [`Layer`] for a blending mode such as
/// [`Over`](crate::output::Over).
///
/// The least value is invisible, the largest opaque, those between them equal steps. Filters mix
/// colours and alphas apart: give invisible texels the colour of their neighbours. Drawn with
/// [`Replace`](crate::output::Replace), texels from half on are opaque and others left out, as with
/// [`Masked`](super::Masked), which takes the same planes.
///
/// A plane that does not go with the texels does not compile:
///
/// ```compile_fail,E0080
/// # use embedded_graphics_core::pixelcolor::Gray8;
/// # use rasterizer::texture::{Colors, Translucent};
/// const GRAY: Gray8 = Gray8::new(7);
/// let texels: Translucent<'_, _, 4, 3> = Translucent::new(Colors::new(&[GRAY; 8]), &[0; 3]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Translucent<'a, F, const BITS: usize, const BYTES: usize> {
    texels: F,
    alpha: &'a [u8; BYTES],
}

impl<'a, F: Table<Texel = <F as Texels>::Color>, const BITS: usize, const BYTES: usize>
    Translucent<'a, F, BITS, BYTES>
{
    /// These texels with an alpha each.
    #[must_use]
    pub const fn new(texels: F, alpha: &'a [u8; BYTES]) -> Self {
        const {
            assert!(BYTES > 0 && Packing::<BITS>::PART_BITS <= 3);
            assert!(!Self::COUNTS.is_empty(), "the alpha plane has as many texels as the colours");
        }
        Self { texels, alpha }
    }
}

impl<F, const BITS: usize, const BYTES: usize> Translucent<'_, F, BITS, BYTES> {
    #[inline(always)]
    const fn alpha(&self, index: usize) -> Alpha {
        let byte = *at(self.alpha, index >> Packing::<BITS>::PART_BITS);
        Alpha::from_u8(Packing::<BITS>::widened(Packing::<BITS>::unpack(byte, index)))
    }
}

with_alpha!(
    Layer, [Texels, const BITS: usize, const BYTES: usize] Translucent<'_, F, BITS, BYTES>,
    |texels| texels.texels.counts().and(Counts::in_bytes(BYTES, BITS))
);

impl<F: Table<Texel = <F as Texels>::Color>, const BITS: usize, const BYTES: usize> Table
    for Translucent<'_, F, BITS, BYTES>
{
    const COUNTS: Counts = F::COUNTS.and(Counts::in_bytes(BYTES, BITS));
}

/// Texels with a palette whose colours have an alpha each, of 8 bits: no plane, and no more flash
/// than a byte for each colour.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// use rasterizer::texture::{Indexed, Texture, TranslucentPalette};
///
/// /// Clear, mist, and thick smoke.
/// static COLORS: [Rgb565; 4] = [Rgb565::WHITE; 4];
/// static ALPHAS: [u8; 4] = [0, 60, 120, 200];
/// static PLACES: [u8; 1] = [0b_10_01_11_00];
/// type Smoke = TranslucentPalette<'static, Indexed<'static, Rgb565, 2, 1, 4>, 4>;
/// static SMOKE: Texture<Smoke, 2, 2> =
///     Texture::new(TranslucentPalette::new(Indexed::new(&PLACES, &COLORS), &ALPHAS));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TranslucentPalette<'a, F, const COLORS: usize> {
    texels: F,
    alphas: &'a [u8; COLORS],
}

impl<'a, F: StoredTexels<Stored = u8>, const COLORS: usize> TranslucentPalette<'a, F, COLORS> {
    /// These texels with an alpha for each place in their palette; a place beyond the table has the
    /// first.
    #[must_use]
    pub const fn new(texels: F, alphas: &'a [u8; COLORS]) -> Self {
        const { assert!(COLORS > 0, "a palette has at least a colour") }
        Self { texels, alphas }
    }

    #[inline(always)]
    fn alpha(&self, index: usize) -> Alpha {
        Alpha::from_u8(*at(self.alphas, self.texels.stored(index).into()))
    }
}

with_alpha!(
    Layer, [StoredTexels<Stored = u8>, const COLORS: usize] TranslucentPalette<'_, F, COLORS>,
    |texels| texels.texels.counts()
);

impl<F: Table + StoredTexels<Stored = u8>, const COLORS: usize> Table
    for TranslucentPalette<'_, F, COLORS>
{
    const COUNTS: Counts = F::COUNTS;
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::Gray8;

    use super::*;
    use crate::texture::{Colors, Indexed};

    const GRAYS: [Gray8; 4] = [Gray8::new(1), Gray8::new(2), Gray8::new(3), Gray8::new(4)];

    #[test]
    fn planes_of_all_widths_reach_both_ends() {
        let layers = |texel: [u16; 4]| {
            core::array::from_fn(|i| Layer::new(GRAYS[i], Alpha::from_bits(texel[i])))
        };
        let colors = Colors::new(&GRAYS);
        let bytes: Translucent<'_, _, 8, 4> = Translucent::new(colors, &[0, 127, 128, 255]);
        assert_eq!([0, 1, 2, 3].map(|i| bytes.texel(i)), layers([0, 127, 129, 256]));
        // 15 is opaque: steps of 17 of 255.
        let nibbles: Translucent<'_, _, 4, 2> = Translucent::new(colors, &[0x70, 0xF8]);
        assert_eq!([0, 1, 2, 3].map(|i| nibbles.texel(i)), layers([0, 119, 137, 256]));
        let pairs: Translucent<'_, _, 2, 1> = Translucent::new(colors, &[0b11_10_01_00]);
        assert_eq!([0, 1, 2, 3].map(|i| pairs.texel(i)), layers([0, 85, 171, 256]));
        let bits: Translucent<'_, _, 1, 1> = Translucent::new(colors, &[0b1010]);
        assert_eq!([0, 1, 2, 3].map(|i| bits.texel(i)), layers([0, 256, 0, 256]));
    }

    #[test]
    fn a_place_in_the_palette_has_an_alpha() {
        let places: Indexed<'_, Gray8, 2, 1, 4> = Indexed::new(&[0b00_11_01_10], &GRAYS);
        let texels = TranslucentPalette::new(places, &[255, 0, 64, 128]);
        let alphas = [0, 1, 2, 3].map(|i| texels.texel(i).alpha.to_bits());
        assert_eq!(alphas, [64, 0, 129, 256]);
        let light = <Indexed<'_, Gray8, 2, 1, 4> as LitTexels>::light(0);
        let lit = texels.before_light(0, light);
        assert_eq!(lit, texels.texel(0), "the light of an indexed texel comes later");
    }
}
