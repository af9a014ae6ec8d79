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
    division::Division,
    quotient::{Corners, Quotient},
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

    /// The law of a triangle.
    fn of<V: Components>(corners: &Corners<V>, quotient: &Quotient<V>, bits: u32) -> Law;

    /// Whether 16 bits are enough for a division.
    fn may_be_quick(law: &Law) -> bool;

    /// The pixels of a step in a span between these values of q, 1 to 64.
    fn pixels<V: Components>(law: &Law, division: &Division<V>, ends: [u32; 2]) -> usize;
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
    fn of<V: Components>(_: &Corners<V>, _: &Quotient<V>, _: u32) -> Law {
        Law { eighths: 0, is_quick: false }
    }

    #[inline(always)]
    fn may_be_quick(_: &Law) -> bool {
        false
    }

    #[inline(always)]
    fn pixels<V: Components>(_: &Law, _: &Division<V>, _: [u32; 2]) -> usize {
        const { assert!(N >= 2 && N <= LONGEST, "N is 2 to 64") }
        N
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

    /// Whether a range of numbers, in sixteenths of a unit, is divided within a quarter of the
    /// tolerance in 16 bits. The quotient is off by 2^-15 for s, half of that for q, and half of
    /// 2^-13.2 for the reciprocal: 2^-13.5, in units of twice to four times the range, 2^-11.5 of
    /// it.
    const fn is_quick(range: u32) -> bool {
        range <= Self::LIMIT << 9
    }
}

/// What is found out once a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Law {
    /// In eighths of the binary logarithm of n^2 / qmin^3.
    eighths: i32,
    is_quick: bool,
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
        for sixteenths in corners.sixteenths().as_ref() {
            if sixteenths >> 16 != 0 || sixteenths * spread > limit {
                return false;
            }
        }
        !V::READS_INVERSE_W || spread <= least >> 19
    }

    #[inline(always)]
    fn of<V: Components>(corners: &Corners<V>, quotient: &Quotient<V>, bits: u32) -> Law {
        let mut eighths = i32::MAX;
        for (index, &unit_bits) in V::UNIT_BITS.as_ref().iter().enumerate() {
            // W at the corners, between which it is linear, by slopes shifted up to 31 bits.
            let [q_slope, slope] = quotient.slopes(index);
            let magnitude = (q_slope ^ (q_slope >> 31)) | (slope ^ (slope >> 31));
            let up = leading_zeros(magnitude as u32 | 1) - 1;
            let (q_up, s_up) = (q_slope << up, slope << up);
            let numerators = corners.numerators(index, bits);
            let mut widest = 0;
            for (&q, s) in corners.q.iter().zip(numerators) {
                let w = mul_high(q as i32, s_up).wrapping_sub(mul_high(s, q_up));
                widest = widest.max(w.unsigned_abs());
            }
            // One for each product and one for the slopes' lost digits.
            let w = log2_above(widest + 3) + 8 * (32 - up as i32);
            let q = log2_above(q_slope.unsigned_abs() + 1);
            // Of the tolerance, an eighth is left for rounded steps and a quarter for divisions in
            // 16 bits: 2^-0.68.
            let tolerance =
                log2_below(Self::LIMIT) - 6 + 8 * (unit_bits as i32 - 4 - bits as i32 - 1);
            eighths = eighths.min(16 + tolerance - w - q);
        }
        let mut is_quick = true;
        for &sixteenths in corners.sixteenths().as_ref() {
            is_quick &= Self::is_quick(sixteenths);
        }
        Law { eighths, is_quick }
    }

    #[inline(always)]
    fn may_be_quick(law: &Law) -> bool {
        law.is_quick
    }

    #[inline(always)]
    fn pixels<V: Components>(law: &Law, division: &Division<V>, [first, last]: [u32; 2]) -> usize {
        // Rounding a step by half a digit adds up to an eighth of the tolerance at most.
        let longest = const {
            let log2 = Self::LIMIT.ilog2() as i32 + V::STEP_DIGITS as i32 - 6;
            if log2 < 0 {
                1
            } else if log2 > 6 {
                LONGEST
            } else {
                1 << log2
            }
        };
        let q = log2_below(first.min(last).max(1)) - 8 * division.up as i32;
        // In sixteenths of the binary logarithm of n.
        let sixteenths = law.eighths + 3 * q;
        let length = LENGTHS.get((sixteenths.max(0) >> 1) as usize);
        length.map_or(LONGEST, |&length| usize::from(length)).min(longest)
    }
}

/// The whole part of 2^(n / 8).
const LENGTHS: [u8; 48] = {
    // 2^(n / 8) in Q20.
    const EIGHTHS: [u32; 8] =
        [1_048_576, 1_143_480, 1_246_974, 1_359_835, 1_482_910, 1_617_125, 1_763_488, 1_923_097];
    let mut lengths = [0; 48];
    let mut n = 0;
    while n < 48 {
        lengths[n] = (EIGHTHS[n % 8] << (n / 8) >> 20) as u8;
        n += 1;
    }
    lengths
};

/// The binary logarithm of a positive number in eighths, not above it: log2(1 + m) >= m.
#[inline(always)]
const fn log2_below(value: u32) -> i32 {
    let (mantissa, zeros) = normalised(value);
    8 * (31 - zeros as i32) + (mantissa >> 28 & 7) as i32
}

/// The same, not below it: log2(1 + m) < m + 0.0861.
#[inline(always)]
const fn log2_above(value: u32) -> i32 {
    // An eighth for the digits of the mantissa that are dropped, and another for the curve.
    log2_below(value) + 2
}
