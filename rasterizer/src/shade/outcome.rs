//! What a shader makes of a fragment.

/// A colour, or with `Option` of a colour maybe none: the pixel is then discarded, and keeps its
/// colour and its depth.
pub trait Outcome<C> {
    /// Whether there may be none.
    const DISCARDS: bool;

    /// The colour, or `None` to discard the pixel.
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
