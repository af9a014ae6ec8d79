//! A colour with its alpha.

use super::{Outcome, Texel};
use crate::color::Alpha;

/// A colour that hides a part of what is behind it: of a texel, and of a pixel.
///
/// A blending mode ([`Over`](crate::output::Over) and others) puts it onto the stored colour by its
/// alpha, and discards it where that is 0. [`Replace`](crate::output::Replace) tests the alpha:
/// below half the pixel is discarded, as a texel of [`Masked`](super::Masked) is; from half on it
/// is opaque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Layer<C> {
    /// The colour, not multiplied by the alpha.
    pub color: C,
    /// How much it hides.
    pub alpha: Alpha,
}

impl<C> Layer<C> {
    /// A colour with an alpha.
    #[inline(always)]
    #[must_use]
    pub const fn new(color: C, alpha: Alpha) -> Self {
        Self { color, alpha }
    }
}

impl<C> Outcome<C> for Layer<C> {
    const DISCARDS: bool = true;
    const HAS_ALPHA: bool = true;

    #[inline(always)]
    fn color(self) -> Option<C> {
        self.alpha.is_half().then_some(self.color)
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        (self.alpha > Alpha::CLEAR).then_some((self.color, self.alpha))
    }
}

/// Colours are mixed as they are, those of invisible texels too: give these the colour of their
/// neighbours.
impl<C: Copy> Texel<C> for Layer<C> {
    #[inline(always)]
    fn opaque(color: C) -> Self {
        Self::new(color, Alpha::OPAQUE)
    }

    #[inline(always)]
    fn recolored(self, change: impl FnOnce(C) -> C) -> Self {
        Self::new(change(self.color), self.alpha)
    }

    #[inline(always)]
    fn combined<const N: usize>(
        texels: [Self; N],
        _: usize,
        mix: impl FnOnce([C; N]) -> C,
        mix_alpha: impl FnOnce([Alpha; N]) -> Alpha,
    ) -> Self {
        let colors = texels.map(|texel| texel.color);
        Self::new(mix(colors), mix_alpha(texels.map(|texel| texel.alpha)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_alpha_test_keeps_the_upper_half() {
        let layer = |bits| Layer::new(7u8, Alpha::from_bits(bits));
        let tested = [0, 1, 127, 128, 256].map(|bits| Outcome::<u8>::color(layer(bits)));
        assert_eq!(tested, [None, None, None, Some(7), Some(7)]);
        let blended = [0, 1].map(|bits| Outcome::<u8>::layer(layer(bits)));
        assert_eq!(blended, [None, Some((7, Alpha::from_bits(1)))]);
        assert_eq!(Texel::<u8>::recolored(layer(3), |color| color + 1).color, 8);
        assert_eq!(<Layer<u8> as Texel<u8>>::opaque(7), layer(256));
    }

    #[test]
    fn colors_and_alphas_are_mixed_apart() {
        let texels = [Layer::new(1u8, Alpha::CLEAR), Layer::new(9, Alpha::HALF)];
        let mixed = Texel::<u8>::combined(
            texels,
            0,
            |[a, b]| a + b,
            |[a, b]| Alpha::from_bits(a.to_bits() + b.to_bits() + 1),
        );
        assert_eq!(mixed, Layer::new(10, Alpha::from_bits(129)));
    }
}
