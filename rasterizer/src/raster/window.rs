//! Which pixels are drawn, and where they lie in memory.

use embedded_graphics_core::primitives::Rectangle;

/// How far the sides of a window may lie from the display's origin.
///
/// A primitive adds a side to an address, and compares it with a column, without overflow.
const REACH: i32 = 1 << 29;

/// A half-open rectangle of pixels, none of which lies farther than 2<sup>29</sup> from the
/// display's origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Window {
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) right: i32,
    pub(crate) bottom: i32,
}

impl Window {
    /// The pixels of a rectangle.
    #[must_use]
    pub const fn new(rectangle: &Rectangle) -> Self {
        let (corner, size) = (rectangle.top_left, rectangle.size);
        Self {
            left: within_reach(corner.x),
            top: within_reach(corner.y),
            right: within_reach(corner.x.saturating_add_unsigned(size.width)),
            bottom: within_reach(corner.y.saturating_add_unsigned(size.height)),
        }
    }

    /// The pixels of a rectangle whose sides are known to be within reach.
    #[inline(always)]
    pub(crate) const fn within_range(rectangle: &Rectangle) -> Self {
        let (corner, size) = (rectangle.top_left, rectangle.size);
        Self {
            left: corner.x,
            top: corner.y,
            right: corner.x.wrapping_add(size.width as i32),
            bottom: corner.y.wrapping_add(size.height as i32),
        }
    }

    /// The pixels of a rectangle, or none if one of its sides is out of reach: fewer instructions
    /// than [`new`](Self::new).
    #[inline(always)]
    pub(crate) const fn or_none(rectangle: &Rectangle) -> Self {
        let window = Self::within_range(rectangle);
        let Self { left, top, right, bottom } = window;
        let sides = left.wrapping_add(REACH)
            | top.wrapping_add(REACH)
            | right.wrapping_add(REACH)
            | bottom.wrapping_add(REACH);
        // From 0 to 2^30 - 1 each.
        if sides as u32 >> 30 == 0 { window } else { Self { left: 0, top: 0, right: 0, bottom: 0 } }
    }

    /// The first column.
    #[must_use]
    pub const fn left(&self) -> i32 {
        self.left
    }

    /// The first row.
    #[must_use]
    pub const fn top(&self) -> i32 {
        self.top
    }

    /// The column after the last.
    #[must_use]
    pub const fn right(&self) -> i32 {
        self.right
    }

    /// The row after the last.
    #[must_use]
    pub const fn bottom(&self) -> i32 {
        self.bottom
    }

    /// Whether it holds no pixel.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// The place of a pixel among those of the window, row by row; beyond all of them, or `None`,
    /// for one elsewhere.
    #[inline(always)]
    pub(crate) const fn index_of(&self, column: i32, row: i32) -> Option<usize> {
        let (x, y) = (column.wrapping_sub(self.left), row.wrapping_sub(self.top));
        let width = self.right.wrapping_sub(self.left);
        if x.cast_unsigned() < width.cast_unsigned() {
            Some(y.wrapping_mul(width).wrapping_add(x).cast_unsigned() as usize)
        } else {
            // It would be a place in another row.
            None
        }
    }

    /// Returns the pixels that are in both.
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

/// The nearest side that is within reach.
const fn within_reach(side: i32) -> i32 {
    if side < -REACH {
        -REACH
    } else if side > REACH {
        REACH
    } else {
        side
    }
}

/// Where pixels lie in a row of addresses: at `row * pitch + column - origin`. No pixel of a window
/// that is drawn has a negative address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Layout {
    /// The addresses from a row to the next.
    pub pitch: i32,
    /// How far the display's first pixel lies before address 0.
    pub origin: i32,
}

impl Layout {
    /// Returns the address of column 0 of a row.
    #[inline(always)]
    #[must_use]
    pub const fn row_address(&self, row: i32) -> i32 {
        row.wrapping_mul(self.pitch).wrapping_sub(self.origin)
    }
}
