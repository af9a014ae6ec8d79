//! The seam between what covers pixels and where they are drawn.

use fixed::types::U0F32;

use super::{Layout, Window};
use crate::attribute::{DepthFormat, Interpolate};

/// A shape on the screen: it visits the spans of pixels that it covers.
///
/// The core has the [`Triangle`](super::Triangle), the [`Line`](super::Line) and the
/// [`Point`](super::Point). A target draws any primitive, so that a new one takes no change in a
/// target, nor a new target in a primitive.
pub trait Primitive {
    /// How its depth is kept.
    type Depth: DepthFormat;
    /// What is interpolated over it.
    type Varyings: Interpolate;

    /// Visits its pixels that lie in `window`, each once, with their addresses in `layout`.
    ///
    /// # Errors
    ///
    /// Returns the first error of `visit`, and visits no span after it.
    fn for_each_span<E>(
        &self,
        window: &Window,
        layout: Layout,
        visit: impl FnMut(&Span<'_, Self::Depth, Self::Varyings>) -> Result<(), E>,
    ) -> Result<(), E>;
}

/// Covered pixels of one row, with what is interpolated along them.
#[derive(Clone, Copy, Debug)]
pub struct Span<'f, D: DepthFormat, V: Interpolate> {
    /// The row, from the display's upper edge.
    pub row: i32,
    /// The first pixel's address.
    pub start: usize,
    /// The address after the last pixel's; always beyond `start`.
    pub end: usize,
    /// The depth at the first pixel.
    pub depth: D::Walk,
    /// The change of depth from a pixel to the one on its right.
    pub depth_step: D::Walk,
    /// The varyings as functions of addresses and rows.
    pub varyings: &'f V::Field,
}

/// A covered pixel, as a shader sees it. What a shader does not read costs nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fragment<V> {
    /// The interpolated varyings.
    pub varyings: V,
    /// The depth as it is stored: near / w, or 0 where no depth is kept.
    pub depth: U0F32,
    /// The column, from the display's left edge.
    pub column: i32,
    /// The row, from the display's upper edge.
    pub row: i32,
}

/// The fragments of a primitive.
pub type FragmentOf<Q> = Fragment<<<Q as Primitive>::Varyings as Interpolate>::Sample>;
