//! How depth is stored.

use fixed::types::U0F32;

use super::{Interpolate, Piece, Plane, QuickGradients, TriangleSetup, Whole, clear::claim};
use crate::numbers::Subpixel;

/// How depth is stored: `u16`, [`FloatDepth`](super::FloatDepth), `u32`, or not at all.
///
/// Depth is near / w (in a parallel projection the remaining part of the way to the far plane): 1
/// on the near plane, larger is nearer, and a buffer is cleared to 0. It is linear in screen space.
pub trait DepthFormat: Interpolate<Field = Plane<<Self as Interpolate>::Walk>> {
    /// Whether [`claim`](Self::claim) finds clear cells: no pixel's depth is 0, which clears them.
    const HAS_CLEAR_CELLS: bool = false;

    /// The depth of a vertex from Q0.32. It is never 0, so that everything in front of the far
    /// plane wins against a cleared buffer.
    fn from_fraction(q32: u32) -> Self;

    /// Returns the depth as a fraction; 0 if none is stored.
    fn to_fraction(self) -> U0F32;

    /// The depth at a pixel, rounded to a unit.
    fn at(value: Self::Walk) -> Self;

    /// Whether this depth is nearer than `stored`; always true if none is stored.
    fn is_nearer(self, stored: Self) -> bool;

    /// Stores the depths of a run's first pixels up to the first cell that is not clear, and
    /// returns their number. They are all visible. `depth` is that of the first pixel, and `step`
    /// goes from each to the next.
    #[inline(always)]
    fn claim(_cells: &mut [Self], _depth: Self::Walk, _step: Self::Walk) -> usize {
        0
    }

    /// Whether the first cell is clear, so that [`claim`](Self::claim) would store a depth.
    #[inline(always)]
    #[must_use]
    fn starts_clear(_cells: &[Self]) -> bool {
        false
    }
}

/// Units of 1 / 65,536, rounded to the nearest; 1 is stored as 65,535.
impl DepthFormat for u16 {
    /// A vertex has a unit or more, and interpolation is off by less than half of one.
    const HAS_CLEAR_CELLS: bool = true;

    #[inline(always)]
    fn from_fraction(q32: u32) -> Self {
        // Up to 2^16.
        let rounded = ((q32 >> 15) + 1) >> 1;
        (rounded - (rounded >> 16)).max(1) as Self
    }

    #[inline(always)]
    fn to_fraction(self) -> U0F32 {
        U0F32::from_bits(u32::from(self) << 16)
    }

    #[inline(always)]
    fn at(value: u32) -> Self {
        (value >> 16) as Self
    }

    #[inline(always)]
    fn is_nearer(self, stored: Self) -> bool {
        self > stored
    }

    #[inline(always)]
    fn claim(cells: &mut [Self], depth: u32, step: u32) -> usize {
        claim(cells, depth, step)
    }

    #[inline(always)]
    fn starts_clear(cells: &[Self]) -> bool {
        cells.first() == Some(&0)
    }
}

/// Units of 2<sup>-32</sup>; 1 is stored as 2<sup>32</sup> - 1, and a vertex on the near plane as
/// 2<sup>32</sup> - 2. Interpolation is exact to one unit, a vertex is not: the reciprocal behind
/// its depth is within 2<sup>-27</sup> of it, and its distance w within 4 units of clip space, a
/// 2<sup>28</sup>th of the object's largest coordinate ([`PoseError`](crate::geometry::PoseError)).
/// So the last bits tell neighbouring pixels of one surface apart, not two surfaces.
///
/// In every format snapping moves a plane too, by up to 5/8 of a sub-pixel in x and in y. Two
/// planes tilted by an angle t are certain to be told apart only if they are farther from each
/// other than 1.8 tan t / (f 2<sup>S</sup>) of their distance, with the focal length f in pixels
/// and S sub-pixel bits.
impl DepthFormat for u32 {
    #[inline(always)]
    fn from_fraction(q32: u32) -> Self {
        q32.max(1)
    }

    #[inline(always)]
    fn to_fraction(self) -> U0F32 {
        U0F32::from_bits(self)
    }

    #[inline(always)]
    fn at(value: u64) -> Self {
        Self::sample(value)
    }

    #[inline(always)]
    fn is_nearer(self, stored: Self) -> bool {
        self > stored
    }
}

/// No depth: for a convex body whose back faces are culled, or triangles drawn from back to front.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct NoDepth;

impl DepthFormat for NoDepth {
    #[inline(always)]
    fn from_fraction(_: u32) -> Self {
        Self
    }

    #[inline(always)]
    fn to_fraction(self) -> U0F32 {
        U0F32::ZERO
    }

    #[inline(always)]
    fn at((): ()) -> Self {
        Self
    }

    #[inline(always)]
    fn is_nearer(self, _: Self) -> bool {
        true
    }
}

impl Interpolate for NoDepth {
    const ZERO: Self = Self;

    type Field = Plane<()>;
    type Walk = ();
    type Rest = Whole<()>;
    type Sample = ();

    #[inline(always)]
    fn plane<S: Subpixel>(
        _: &TriangleSetup<S>,
        _: Option<QuickGradients>,
        _: [Self; 3],
    ) -> Plane<()> {
        Plane { anchor: (), per_column: (), per_row: () }
    }

    #[inline(always)]
    fn whole(field: &Plane<()>, at: [i32; 2], pixels: usize) -> Option<Piece<()>> {
        Some(field.piece(at, pixels))
    }

    #[inline(always)]
    fn walk(field: &Plane<()>, at: [i32; 2], pixels: usize) -> (Piece<()>, Whole<()>) {
        (field.piece(at, pixels), core::iter::empty())
    }

    #[inline(always)]
    fn sample((): ()) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_is_never_zero_and_never_wraps() {
        assert_eq!(u16::from_fraction(0), 1);
        assert_eq!(u16::from_fraction(u32::MAX), 65_535);
        assert_eq!(u16::from_fraction(0x1234_7FFF), 0x1234);
        assert_eq!(u16::from_fraction(0x1234_8000), 0x1235);
        assert_eq!(u32::from_fraction(0), 1);
    }

    #[test]
    fn a_stored_depth_is_a_fraction_again() {
        assert_eq!(0x1234u16.to_fraction(), U0F32::from_bits(0x1234_0000));
        assert_eq!(0x1234_5678u32.to_fraction(), U0F32::from_bits(0x1234_5678));
        assert_eq!(NoDepth.to_fraction(), 0);
    }
}
