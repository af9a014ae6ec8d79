//! Which pixels are drawn, and where they lie in memory.

use embedded_graphics_core::primitives::Rectangle;

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
    /// The pixels of a rectangle; none if it reaches beyond the range of `i32`.
    #[must_use]
    pub const fn new(rectangle: &Rectangle) -> Self {
        let (corner, size) = (rectangle.top_left, rectangle.size);
        Self {
            left: corner.x,
            top: corner.y,
            right: corner.x.wrapping_add_unsigned(size.width),
            bottom: corner.y.wrapping_add_unsigned(size.height),
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

/// Where pixels lie in a row of addresses: at `row * pitch + column - origin`. No pixel of a window
/// that is drawn has a negative address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Layout {
    /// The addresses from a row to the next.
    pub pitch: i32,
    /// The distance of the display's first pixel before address 0.
    pub origin: i32,
}

impl Layout {
    /// The address of a row's column 0.
    #[inline(always)]
    #[must_use]
    pub const fn row_address(&self, row: i32) -> i32 {
        row.wrapping_mul(self.pitch).wrapping_sub(self.origin)
    }
}
