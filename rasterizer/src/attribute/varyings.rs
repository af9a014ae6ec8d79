//! The numbers of a vertex in clip space.

use super::Interpolate;

/// near / w in Q0.32: 2<sup>32</sup> - 1 stands for 1, on the near plane, and for every vertex of a
/// parallel projection, where w is constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InverseW(u32);

impl InverseW {
    /// 1, within 2<sup>-32</sup>.
    pub const ONE: Self = Self(u32::MAX);

    /// Infinitely far away.
    pub const ZERO: Self = Self(0);

    /// From near / w in Q0.32.
    #[inline(always)]
    #[must_use]
    pub const fn from_bits(q32: u32) -> Self {
        Self(q32)
    }

    /// near / w in Q0.32.
    #[inline(always)]
    #[must_use]
    pub const fn to_bits(self) -> u32 {
        self.0
    }
}

/// What a shader gives a vertex: numbers that are linear in space.
///
/// `u16`, `i16` and `u32`, arrays of one of them, and tuples of any of these; `[u16; 0]` for none.
/// They are interpolated linearly on the screen.
pub trait Varyings: Copy {
    /// The values as a vertex on the screen stores them.
    type OnScreen: Interpolate;

    /// Returns the values at `t` / 2<sup>30</sup> of the way from these to the `other` ones,
    /// rounded; `t` is at most 2<sup>30</sup>. Clipping calls it for a new vertex on an edge.
    #[must_use]
    fn lerp(self, other: Self, t: u32) -> Self;

    /// Called once for each vertex that gets a place on the screen, where 1 / w is known.
    fn on_screen(self, inverse_w: InverseW) -> Self::OnScreen;

    /// Returns the values of a vertex as a corner, 0 to 2, of one of its triangles. Called for
    /// triangles that are clipped; [`Interpolate::at_corner`] is for others.
    #[inline(always)]
    #[must_use]
    fn at_corner(self, _corner: usize) -> Self {
        self
    }
}

/// Returns `a + (b - a) t / 2^30`, rounded to the nearest: never outside `a` and `b`.
pub(crate) const fn lerp(a: i64, b: i64, t: u32) -> i64 {
    a + (((b - a) * t as i64 + (1 << 29)) >> 30)
}

macro_rules! linear_on_the_screen {
    ($($integer:ty),*) => {
        $(impl Varyings for $integer {
            type OnScreen = Self;

            fn lerp(self, other: Self, t: u32) -> Self {
                lerp(i64::from(self), i64::from(other), t) as Self
            }

            #[inline(always)]
            fn on_screen(self, _: InverseW) -> Self {
                self
            }
        })*
    };
}

linear_on_the_screen!(u16, i16, u32);

impl<A, const N: usize> Varyings for [A; N]
where
    A: Varyings,
    [A::OnScreen; N]: Interpolate,
{
    type OnScreen = [A::OnScreen; N];

    fn lerp(self, other: Self, t: u32) -> Self {
        core::array::from_fn(|i| self[i].lerp(other[i], t))
    }

    #[inline(always)]
    fn on_screen(self, inverse_w: InverseW) -> Self::OnScreen {
        self.map(|a| a.on_screen(inverse_w))
    }

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        self.map(|a| a.at_corner(corner))
    }
}

impl<A: Varyings, B: Varyings> Varyings for (A, B) {
    type OnScreen = (A::OnScreen, B::OnScreen);

    fn lerp(self, other: Self, t: u32) -> Self {
        (self.0.lerp(other.0, t), self.1.lerp(other.1, t))
    }

    #[inline(always)]
    fn on_screen(self, inverse_w: InverseW) -> Self::OnScreen {
        (self.0.on_screen(inverse_w), self.1.on_screen(inverse_w))
    }

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        (self.0.at_corner(corner), self.1.at_corner(corner))
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
        assert_eq!((-7i16).lerp(9, 1 << 29), 1);
        assert_eq!(i16::MIN.lerp(i16::MAX, 1 << 30), i16::MAX);
        assert_eq!([0u16, 100].lerp([10, 0], 1 << 29), [5, 50]);
        assert_eq!(([0u16], 100i16).lerp(([10], -100), 1 << 29), ([5], 0));
    }
}
