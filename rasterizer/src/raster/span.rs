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

/// Covered pixels of one row, with the attributes at the first one's centre and their change from pixel to pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span<D: Interpolate, V: Interpolate> {
    /// The row, from the display's upper edge.
    pub row: i32,
    /// The first column, from the display's left edge.
    pub start: i32,
    /// The column after the last; always beyond `start`.
    pub end: i32,
    /// The depth at the first pixel.
    pub depth: D::Accumulator,
    /// The change of depth from a pixel to the one on its right.
    pub depth_step: D::Accumulator,
    /// The varyings at the first pixel.
    pub varyings: V::Accumulator,
    /// The change of the varyings from a pixel to the one on its right.
    pub varyings_step: V::Accumulator,
}

/// Takes the spans of a triangle, row by row from the top.
pub trait SpanSink<D: Interpolate, V: Interpolate> {
    /// What can go wrong with taking one.
    type Error;

    /// Takes a span.
    ///
    /// # Errors
    ///
    /// Whatever the sink's drawing ends in; the triangle is then left unfinished.
    fn span(&mut self, span: &Span<D, V>) -> Result<(), Self::Error>;
}
