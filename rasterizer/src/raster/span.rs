//! A run of covered pixels in one row, and who takes it.

use embedded_graphics_core::primitives::Rectangle;

use super::Interpolate;

/// A half-open rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Window {
    /// The first column.
    pub left: i32,
    /// The first row.
    pub top: i32,
    /// The column after the last.
    pub right: i32,
    /// The row after the last.
    pub bottom: i32,
}

impl Window {
    /// The pixels of a rectangle.
    #[must_use]
    pub const fn new(rectangle: &Rectangle) -> Self {
        let (corner, size) = (rectangle.top_left, rectangle.size);
        Self {
            left: corner.x,
            top: corner.y,
            right: corner.x.saturating_add_unsigned(size.width),
            bottom: corner.y.saturating_add_unsigned(size.height),
        }
    }

    /// Whether there is no pixel in it.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// The pixels in both.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }
}

/// Where the pixels of a window lie in a row of addresses: at `row * pitch + column - origin`,
/// which is never negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Layout {
    /// The addresses from a row to the next.
    pub pitch: i32,
    /// What the addresses of the display's first pixel lie before address 0.
    pub origin: i32,
}

impl Layout {
    /// The address of a row's column 0.
    #[inline(always)]
    pub(super) const fn row_address(&self, row: i32) -> i32 {
        row.wrapping_mul(self.pitch).wrapping_sub(self.origin)
    }
}

/// Covered pixels of one row, with the attributes at the first one's centre and their change from
/// pixel to pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span<D: Interpolate, V: Interpolate> {
    /// The row, from the display's upper edge.
    pub row: i32,
    /// The first pixel's address.
    pub start: usize,
    /// The address after the last pixel's; always beyond `start`.
    pub end: usize,
    /// The depth at the first pixel.
    pub depth: D::Accumulator,
    /// The change of depth from a pixel to the one on its right.
    pub depth_step: D::Accumulator,
    /// The varyings at the first pixel.
    pub varyings: V::Accumulator,
    /// The change of the varyings from a pixel to the one on its right.
    pub varyings_step: V::Accumulator,
}
