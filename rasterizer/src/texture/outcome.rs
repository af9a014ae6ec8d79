//! A colour, or none: of a texel, and of a pixel.

/// A colour, or an `Option` of one: `None` discards the pixel, which keeps its colour and its
/// depth.
pub trait Outcome<C> {
    /// Whether a pixel can be discarded.
    const DISCARDS: bool;

    /// Returns the colour, or `None` to discard the pixel.
    fn color(self) -> Option<C>;
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
