//! A colour, or none: of a texel, and of a pixel.

use crate::color::Alpha;

/// How much code the colour of a pixel takes. It decides how many copies of it there are.
///
/// [`Small`](Self::Small) colours are drawn by up to eight pixels at a time, where that saves more
/// than it costs. Pixels whose depth cells are clear need no depth test, and are drawn by a loop of
/// their own, unless their colours are [`Large`](Self::Large).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CodeSize {
    /// A dozen instructions, as for the nearest texel.
    Small,
    /// Up to about a hundred, as for a mean of four texels.
    Medium,
    /// More than that, or not known: one copy or two.
    Large,
}

impl CodeSize {
    /// Of both together: at least that of the larger one.
    #[must_use]
    pub const fn max(self, other: Self) -> Self {
        if self as u8 > other as u8 { self } else { other }
    }
}

/// What a shader makes of a pixel: a colour, an `Option` of one, or a [`Layer`](super::Layer).
/// `None` discards the pixel, which keeps its colour and its depth.
pub trait Outcome<C>: Sized {
    /// Whether a pixel can be discarded.
    const DISCARDS: bool;

    /// Whether a pixel that is not discarded stores its depth.
    const WRITES_DEPTH: bool = true;

    /// Whether [`layer`](Self::layer) may be anything but opaque.
    const HAS_ALPHA: bool = false;

    /// How much code it takes.
    const CODE: CodeSize = CodeSize::Large;

    /// Returns the colour, or `None` to discard the pixel.
    fn color(self) -> Option<C>;

    /// Returns the colour with its alpha, for blending; or `None` to discard the pixel.
    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        self.color().map(|color| (color, Alpha::OPAQUE))
    }
}

impl<C> Outcome<C> for C {
    const DISCARDS: bool = false;

    #[inline(always)]
    fn color(self) -> Option<C> {
        Some(self)
    }
}

impl<C> Outcome<C> for Option<C> {
    const DISCARDS: bool = true;

    #[inline(always)]
    fn color(self) -> Self {
        self
    }
}

/// A colour, an `Option` of one, or a [`Layer`](super::Layer): `None` is transparent.
pub trait Texel<C>: Outcome<C> + Copy {
    /// Returns a texel of this colour.
    fn opaque(color: C) -> Self;

    /// Returns the texel with its colour changed by `change`, which is not called for a transparent
    /// one.
    #[must_use]
    fn recolored(self, change: impl FnOnce(C) -> C) -> Self;

    /// Mixes texels by a function of their colours. The texel with the number `nearest`, below `N`,
    /// decides whether the result is transparent, and gives its colour to those that are. Where
    /// texels have an alpha, `mix_alpha` mixes it in place of that decision.
    fn combined<const N: usize>(
        texels: [Self; N],
        nearest: usize,
        mix: impl FnOnce([C; N]) -> C,
        mix_alpha: impl FnOnce([Alpha; N]) -> Alpha,
    ) -> Self;
}

impl<C: Copy> Texel<C> for C {
    #[inline(always)]
    fn opaque(color: C) -> Self {
        color
    }

    #[inline(always)]
    fn recolored(self, change: impl FnOnce(C) -> C) -> Self {
        change(self)
    }

    #[inline(always)]
    fn combined<const N: usize>(
        texels: [Self; N],
        _: usize,
        mix: impl FnOnce([C; N]) -> C,
        _: impl FnOnce([Alpha; N]) -> Alpha,
    ) -> Self {
        mix(texels)
    }
}

impl<C: Copy> Texel<C> for Option<C> {
    #[inline(always)]
    fn opaque(color: C) -> Self {
        Some(color)
    }

    #[inline(always)]
    fn recolored(self, change: impl FnOnce(C) -> C) -> Self {
        self.map(change)
    }

    #[inline(always)]
    fn combined<const N: usize>(
        texels: [Self; N],
        nearest: usize,
        mix: impl FnOnce([C; N]) -> C,
        _: impl FnOnce([Alpha; N]) -> Alpha,
    ) -> Self {
        let nearest = texels.get(nearest).copied().flatten()?;
        Some(mix(texels.map(|texel| texel.unwrap_or(nearest))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_texel_decides_on_transparency() {
        let sum = |colors: [u32; 4]| colors.iter().sum();
        let none = |_| unreachable!();
        let texels = [Some(1), None, Some(100), None];
        assert_eq!(Texel::combined(texels, 0, sum, none), Some(1 + 1 + 100 + 1));
        assert_eq!(Texel::combined(texels, 1, sum, none), None);
        assert_eq!(Texel::combined(texels, 2, sum, none), Some(1 + 100 + 100 + 100));
        assert_eq!(Texel::combined([1, 2, 3, 4], 1, sum, none), 10);
    }

    #[test]
    fn only_opaque_texels_are_recolored() {
        assert_eq!(Texel::<u8>::recolored(Some(3u8), |c| c + 1), Some(4));
        assert_eq!(Texel::<u8>::recolored(None, |_: u8| unreachable!()), None);
        assert_eq!(Texel::<u8>::recolored(3u8, |c| c + 1), 4);
        assert_eq!(<Option<u8> as Texel<u8>>::opaque(3), Some(3));
    }
}
