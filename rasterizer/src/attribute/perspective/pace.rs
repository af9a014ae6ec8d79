//! How many pixels lie between two divisions.
//!
//! Between two exact points a step apart, at which 1 / w is q0 and q1 = r q0, the straight line
//! between their values u0 and u1 is off by up to
//!
//! ```text
//!   e = |u1 - u0| |sqrt(r) - 1| / (sqrt(r) + 1)  <=  |u1 - u0| |q1 - q0| / (4 min(q0, q1))
//! ```
//!
//! from the quotient. Along a row u = s / q has the slope W / q^2 with the constant
//! W = s' q - s q', so a step of n pixels is off by at most
//!
//! ```text
//!   e <= n^2 |W| |q'| / (4 qmin^3)
//! ```
//!
//! with the least q of the span. Solved for n it gives the length of a step without a trial. Over a
//! whole triangle, affine interpolation is off by at most U (qmax - qmin) / (4 qmin): the same
//! chord, between the two extremes of u and q.

use core::fmt::Debug;

use super::{
    quick::QUICK_RANGE,
    quotient::{Corners, Quotient, least_unit_bits},
};
use crate::{
    attribute::Components,
    numbers::{leading_zeros, mul_high, normalised},
};

/// The length of steps: [`Every`] or [`Adaptive`].
#[expect(private_bounds, reason = "it is sealed")]
pub trait Pace: Copy + Debug + Rule {}

impl<const N: usize> Pace for Every<N> {}
impl<const TOLERANCE: u32> Pace for Adaptive<TOLERANCE> {}

/// What determines the length of steps.
pub(super) trait Rule {
    /// Whether straight lines from corner to corner are within the tolerance.
    fn is_affine<V: Components>(corners: &Corners<V>) -> bool;

    /// Whether 16 bits are enough for a division.
    fn is_quick<V: Components>(corners: &Corners<V>) -> bool;

    /// The law of a triangle.
    fn law<V: Components>(corners: &Corners<V>, quotient: &Quotient<V>) -> Law<V>;

    /// The binary logarithm of a step's length in 64ths, where q is 1, this many rows below the
    /// anchor.
    fn level<V: Components>(law: &Law<V>, rows: i32) -> i32;

    /// The pixels of the longest step, 1 to 64.
    fn longest<V: Components>() -> usize;

    /// The pixels of a step whose length has this binary logarithm in 64ths.
    #[inline(always)]
    fn pixels<V: Components>(level: i32) -> usize {
        (power_of_2(level) as usize).clamp(1, Self::longest::<V>())
    }
}

/// At every `N`-th pixel of a span and at its last one; straight between them. `N` is 2 to 64.
///
/// The straight line is off by up to e = |du| |√r - 1| / (√r + 1), where du is the change of the
/// number over a step and r the ratio of 1 / w at its ends. For a wall that recedes to twice its
/// distance over 320 pixels, with 64 texels to a unit of depth, that is 0.07 texels with `N` = 16;
/// for one that recedes to ten times its distance, 18 texels: [`Adaptive`] keeps a bound there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Every<const N: usize>;

impl<const N: usize> Rule for Every<N> {
    #[inline(always)]
    fn is_affine<V: Components>(_: &Corners<V>) -> bool {
        false
    }

    #[inline(always)]
    fn is_quick<V: Components>(_: &Corners<V>) -> bool {
        false
    }

    #[inline(always)]
    fn law<V: Components>(_: &Corners<V>, _: &Quotient<V>) -> Law<V> {
        Law { w: V::each([0; 2]), level: 0 }
    }

    #[inline(always)]
    fn level<V: Components>(_: &Law<V>, _: i32) -> i32 {
        0
    }

    #[inline(always)]
    fn longest<V: Components>() -> usize {
        const { assert!(N >= 2 && N <= LONGEST, "N is 2 to 64") }
        N
    }

    #[inline(always)]
    fn pixels<V: Components>(_: i32) -> usize {
        Self::longest::<V>()
    }
}

/// The pixels of the longest step.
const LONGEST: usize = 64;

/// As often as a tolerance needs it: what is stepped between two divisions is within `TOLERANCE`
/// sixteenths of a texel, or of a varying's unit. Steps have 1 to 64 pixels, chosen for each span;
/// a triangle that stays within the tolerance without any division gets none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Adaptive<const TOLERANCE: u32 = 8>;

impl<const TOLERANCE: u32> Adaptive<TOLERANCE> {
    const LIMIT: u32 = {
        assert!(TOLERANCE >= 1 && TOLERANCE <= 1 << 14, "the tolerance is 1 to 16,384 sixteenths");
        TOLERANCE
    };
}

/// What is found out once a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Law<V: Components> {
    /// W of each number in the row of the first corner, and its change from row to row.
    w: V::Each<[i32; 2]>,
    /// In 32nds of the binary logarithm of n^2 W / qmin^3.
    level: i32,
}

impl<const TOLERANCE: u32> Rule for Adaptive<TOLERANCE> {
    #[inline(always)]
    fn is_affine<V: Components>(corners: &Corners<V>) -> bool {
        let [a, b, c] = corners.q;
        let (most, least) = (a.max(b).max(c), a.min(b).min(c));
        // Rounded up, and to 16 bits. A sixteenth is left for the planes and for rounding.
        let spread = ((most - least) >> 15) + 1;
        let limit = 4 * u64::from(Self::LIMIT - 1) * u64::from(least >> 15);
        let limit = limit.min(u32::MAX.into()) as u32;
        let is_within = |sixteenths: u32| sixteenths >> 16 == 0 && sixteenths * spread <= limit;
        // codegen: for most small triangles the bound is enough, and takes half the instructions.
        (is_within(corners.sixteenths_at_most())
            || corners.sixteenths().as_ref().iter().all(|&range| is_within(range)))
            && (!V::READS_INVERSE_W || spread <= least >> 19)
    }

    #[inline(always)]
    fn is_quick<V: Components>(corners: &Corners<V>) -> bool {
        // An eighth of the tolerance is left for it.
        corners.sixteenths().as_ref().iter().all(|&range| range <= QUICK_RANGE * Self::LIMIT)
    }

    #[inline(always)]
    fn law<V: Components>(corners: &Corners<V>, quotient: &Quotient<V>) -> Law<V> {
        let [along, down] = quotient.q_slopes();
        let mut magnitude = along.unsigned_abs();
        let numerators = quotient.numerator_slopes();
        for [along, _] in numerators.as_ref() {
            magnitude |= along.unsigned_abs();
        }
        // Slopes along a row, shifted up to 30 bits.
        let up = leading_zeros(magnitude | 1).saturating_sub(2);
        // Errors of the other numbers count for less.
        let least_bits = least_unit_bits::<V>();
        let mut w = V::each([0; 2]);
        let unit_bits = V::UNIT_BITS;
        for ((w, [s_along, s_down]), bits) in
            w.as_mut().iter_mut().zip(numerators.as_ref()).zip(unit_bits.as_ref())
        {
            // At the first corner s is 0.
            let s_along = s_along << up;
            let (at_corner, by_row) =
                (mul_high(corners.q[0] as i32, s_along), mul_high(down, s_along));
            let change = by_row.wrapping_sub(mul_high(*s_down, along << up));
            *w = [at_corner, change].map(|w| w >> (bits - least_bits));
        }
        // Of the tolerance, an eighth is left for rounded steps and an eighth for divisions in 16
        // bits: 2^-0.42. The numerators are in units of 2^(k + 1) = 2^(31 - down).
        let tolerance = log2_below(Self::LIMIT) - 14;
        let units = 32 * (least_bits as i32 - 4 - (31 - quotient.block.down as i32));
        let slope = log2_above(along.unsigned_abs() + 1);
        let level = 64 + tolerance + units - slope - 32 * (32 - up as i32);
        Law { w, level }
    }

    #[inline(always)]
    fn level<V: Components>(law: &Law<V>, rows: i32) -> i32 {
        let mut widest = 0;
        for &[w, change] in law.w.as_ref() {
            // The corner lies within half a row of the anchor.
            let here = w.wrapping_add(change.wrapping_mul(rows)).unsigned_abs();
            widest = widest.max(here.wrapping_add(change.unsigned_abs() / 2));
        }
        // Products and slopes are off by 3 together, their changes by 3 a row.
        law.level - log2_above(widest.saturating_add(3 + 3 * rows.unsigned_abs()))
    }

    /// Rounding a step by half a digit adds up to an eighth of the tolerance at most.
    #[inline(always)]
    fn longest<V: Components>() -> usize {
        const {
            let log2 = Self::LIMIT.ilog2() as i32 + V::STEP_DIGITS as i32 - 6;
            if log2 < 0 {
                1
            } else if log2 > 6 {
                LONGEST
            } else {
                1 << log2
            }
        }
    }
}

/// 2^(n / 64) in Q8, rounded down, without its whole part.
const POWERS: [u8; 64] = {
    // 2^(1 / 64) in Q30, rounded down.
    const ROOT: u64 = 1_085_434_106;
    let mut powers = [0; 64];
    let (mut power, mut n) = (1u64 << 30, 0);
    while n < 64 {
        powers[n] = (power >> 22) as u8;
        power = (power * ROOT) >> 30;
        n += 1;
    }
    powers
};

/// The whole part of 2^(level / 64), up to 2^10.
#[inline(always)]
pub(super) fn power_of_2(level: i32) -> u32 {
    let level = level.clamp(0, 10 * 64) as u32;
    ((256 + u32::from(POWERS[(level & 63) as usize])) << (level >> 6)) >> 8
}

/// 32 log2(1 + n / 32), rounded down.
const LOGARITHMS: [u8; 32] = [
    0, 1, 2, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 25, 26,
    27, 28, 28, 29, 30, 31,
];

/// The binary logarithm of a positive number in 32nds, not above it.
#[inline(always)]
pub(super) const fn log2_below(value: u32) -> i32 {
    let (mantissa, zeros) = normalised(value);
    32 * (31 - zeros as i32) + LOGARITHMS[(mantissa >> 26 & 31) as usize] as i32
}

/// The same, not below it: a step of the mantissa is up to 1.43, and rounding up to 1.
#[inline(always)]
const fn log2_above(value: u32) -> i32 {
    log2_below(value) + 3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_are_bounds() {
        for value in (1..1 << 20).chain((0..1 << 20).map(|n| u32::MAX - n * 4095)) {
            let exact = 32.0 * f64::from(value).log2();
            assert!(f64::from(log2_below(value)) <= exact, "{value}");
            assert!(f64::from(log2_above(value)) >= exact, "{value}");
        }
    }

    #[test]
    fn powers_are_within_a_256th_below() {
        for level in 0..=640 {
            let exact = (f64::from(level) / 64.0).exp2();
            let got = power_of_2(level);
            assert!(f64::from(got) <= exact && f64::from(got) > exact * 255.0 / 256.0 - 1.0);
        }
        assert_eq!((power_of_2(-9), power_of_2(9999)), (1, 1024));
    }
}
