//! What a vertex carries besides its place: depth and varyings.

/// A number at a vertex that is interpolated over a triangle.
///
/// How it is stored decides how it is interpolated: 16 bits in 32-bit steps, 32 bits in 64-bit
/// steps.
pub trait Attribute: Copy + Default {
    /// The value for a vertex that has none yet.
    const ZERO: Self;

    /// The value at `t` / 2<sup>30</sup> of the way from this to `other`, rounded; `t` is at most
    /// 2<sup>30</sup>.
    #[must_use]
    fn lerp(self, other: Self, t: u32) -> Self;
}

/// 16 bits: a depth, a light level in Q0.16.
impl Attribute for u16 {
    const ZERO: Self = 0;

    fn lerp(self, other: Self, t: u32) -> Self {
        lerp(i64::from(self), i64::from(other), t) as Self
    }
}

/// 32 bits: a depth in Q0.32.
impl Attribute for u32 {
    const ZERO: Self = 0;

    fn lerp(self, other: Self, t: u32) -> Self {
        lerp(i64::from(self), i64::from(other), t) as Self
    }
}

/// Never outside a and b.
pub(super) const fn lerp(a: i64, b: i64, t: u32) -> i64 {
    a + (((b - a) * t as i64 + (1 << 29)) >> 30)
}

/// The attributes that a shader wants interpolated: an array of them, empty if it wants none.
pub trait Varyings: Copy {
    /// The values for a vertex that has none yet.
    const ZERO: Self;

    /// The values at `t` / 2<sup>30</sup> of the way from these to the `other` ones.
    #[must_use]
    fn lerp(self, other: Self, t: u32) -> Self;
}

impl<A: Attribute, const N: usize> Varyings for [A; N] {
    const ZERO: Self = [A::ZERO; N];

    fn lerp(self, other: Self, t: u32) -> Self {
        core::array::from_fn(|i| self[i].lerp(other[i], t))
    }
}

/// How depth is stored: `u16`, `u32`, or not at all.
///
/// Depth is near / w (in a parallel projection the remaining part of the way to the far plane): 1
/// on the near plane, larger is nearer, and a buffer is cleared to 0. It is linear in screen space.
pub trait DepthFormat: Attribute {
    /// The depth of a vertex from Q0.32. It is never 0, so that everything in front of the far
    /// plane wins against a cleared buffer.
    fn from_fraction(q32: u32) -> Self;
}

/// Units of 1 / 65,536, rounded to the nearest; 1 is stored as 65,535.
impl DepthFormat for u16 {
    #[inline(always)]
    fn from_fraction(q32: u32) -> Self {
        // Up to 2^16.
        let rounded = ((q32 >> 15) + 1) >> 1;
        (rounded - (rounded >> 16)).max(1) as Self
    }
}

/// Units of 2<sup>-32</sup>; 1 is stored as 2<sup>32</sup> - 1. The reciprocal behind a vertex's
/// depth is within 2<sup>-27</sup> of it, so that the last five bits tell neighbouring pixels of
/// one surface apart, not two surfaces.
impl DepthFormat for u32 {
    #[inline(always)]
    fn from_fraction(q32: u32) -> Self {
        q32.max(1)
    }
}

/// No depth: for a convex body whose back faces are culled, or triangles drawn from back to front.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct NoDepth;

impl Attribute for NoDepth {
    const ZERO: Self = Self;

    fn lerp(self, _: Self, _: u32) -> Self {
        Self
    }
}

impl DepthFormat for NoDepth {
    #[inline(always)]
    fn from_fraction(_: u32) -> Self {
        Self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_meets_both_ends_and_stays_between() {
        for (a, b) in [(0u16, 65_535), (65_535, 0), (7, 7), (1, 2)] {
            assert_eq!(a.lerp(b, 0), a);
            assert_eq!(a.lerp(b, 1 << 30), b);
            for t in (0..=1u32 << 30).step_by(104_729) {
                assert!((a.min(b)..=a.max(b)).contains(&a.lerp(b, t)));
            }
        }
        assert_eq!(0u32.lerp(u32::MAX, 1 << 29), 1 << 31);
        assert_eq!([0u16, 100].lerp([10, 0], 1 << 29), [5, 50]);
    }

    #[test]
    fn depth_is_never_zero_and_never_wraps() {
        assert_eq!(u16::from_fraction(0), 1);
        assert_eq!(u16::from_fraction(u32::MAX), 65_535);
        assert_eq!(u16::from_fraction(0x1234_7FFF), 0x1234);
        assert_eq!(u16::from_fraction(0x1234_8000), 0x1235);
        assert_eq!(u32::from_fraction(0), 1);
    }
}
