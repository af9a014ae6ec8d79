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

use super::quotient::{Corners, Quotient};
use crate::{
    attribute::Components,
    numbers::{leading_zeros, mul_high, normalised},
};

/// The length of steps: [`Every`] or [`Adaptive`].
#[expect(private_bounds, reason = "it is sealed")]
pub trait Pace: Copy + Debug + Law {}

impl<const N: u32> Pace for Every<N> {}
impl<const TOLERANCE: u32> Pace for Adaptive<TOLERANCE> {}

/// What determines the length of steps.
pub(super) trait Law {
    /// Whether straight lines from corner to corner are within the tolerance.
    fn is_affine<V: Components>(corners: &Corners<V>) -> bool;

    /// What a triangle adds to the law: in eighths of a binary logarithm.
    fn of<V: Components>(corners: &Corners<V>, quotient: &Quotient<V>, bits: u32) -> i32;

    /// The binary logarithm of a step's pixels in a span between these values of q.
    fn log2_pixels<V: Components>(law: i32, ends: [u32; 2]) -> u32;
}

/// At every `N`-th pixel of a span and at its last one; straight between them. `N` is a power of
/// two from 2 to 64.
///
/// The straight line is off by up to e = |du| |√r - 1| / (√r + 1), where du is the change of the
/// number over a step and r the ratio of 1 / w at its ends. For a wall that recedes to twice its
/// distance over 320 pixels, with 64 texels to a unit of depth, that is 0.07 texels with `N` = 16;
/// for one that recedes to ten times its distance, 18 texels: [`Adaptive`] keeps a bound there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Every<const N: u32>;

impl<const N: u32> Every<N> {
    const LOG2: u32 = {
        assert!(N.is_power_of_two() && N >= 2 && N <= 64, "N is a power of two from 2 to 64");
        N.trailing_zeros()
    };
}

impl<const N: u32> Law for Every<N> {
    #[inline(always)]
    fn is_affine<V: Components>(_: &Corners<V>) -> bool {
        false
    }

    #[inline(always)]
    fn of<V: Components>(_: &Corners<V>, _: &Quotient<V>, _: u32) -> i32 {
        0
    }

    #[inline(always)]
    fn log2_pixels<V: Components>(_: i32, _: [u32; 2]) -> u32 {
        Self::LOG2
    }
}

/// As often as a tolerance needs it: the straight line between two divisions is within `TOLERANCE`
/// sixteenths of a texel, or of a varying's unit. Steps have 1 to 64 pixels, chosen for each span;
/// a triangle that stays within the tolerance without any division gets none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Adaptive<const TOLERANCE: u32 = 8>;

/// The binary logarithm of the longest step.
const LONGEST: i32 = 6;

impl<const TOLERANCE: u32> Adaptive<TOLERANCE> {
    const LIMIT: u32 = {
        assert!(TOLERANCE >= 1 && TOLERANCE <= 1 << 16, "the tolerance is 1 to 65,536 sixteenths");
        TOLERANCE
    };
}

impl<const TOLERANCE: u32> Law for Adaptive<TOLERANCE> {
    #[inline(always)]
    fn is_affine<V: Components>(corners: &Corners<V>) -> bool {
        let [a, b, c] = corners.q;
        let (most, least) = (a.max(b).max(c), a.min(b).min(c));
        // Rounded up, and to 16 bits. A sixteenth is left for the planes and for rounding.
        let spread = ((most - least) >> 15) + 1;
        let limit = 4 * u64::from(Self::LIMIT - 1) * u64::from(least >> 15);
        let limit = limit.min(u32::MAX.into()) as u32;
        let [one, other] = &corners.differences;
        let unit_bits = V::UNIT_BITS;
        let each = one.as_ref().iter().zip(other.as_ref()).zip(unit_bits.as_ref());
        for ((&d1, &d2), &unit_bits) in each {
            let range = d1.max(d2).max(0) - d1.min(d2).min(0);
            let sixteenths = (range as u32 >> (unit_bits - 4)) + 1;
            if sixteenths >> 16 != 0 || sixteenths * spread > limit {
                return false;
            }
        }
        !V::READS_INVERSE_W || spread <= least >> 19
    }

    fn of<V: Components>(corners: &Corners<V>, quotient: &Quotient<V>, bits: u32) -> i32 {
        let mut law = i32::MAX;
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
            // Seven eighths of the tolerance.
            let tolerance =
                log2_below(Self::LIMIT) - 2 + 8 * (unit_bits as i32 - 4 - bits as i32 - 1);
            law = law.min(16 + tolerance - w - q);
        }
        law
    }

    #[inline(always)]
    fn log2_pixels<V: Components>(law: i32, [first, last]: [u32; 2]) -> u32 {
        // Rounding a step by half a digit adds up to an eighth of the tolerance at most.
        let longest = const {
            let log2 = Self::LIMIT.ilog2() as i32 + V::STEP_DIGITS as i32 - 6;
            if log2 < 0 {
                0
            } else if log2 > LONGEST {
                LONGEST
            } else {
                log2
            }
        };
        let twice = law + 3 * log2_below(first.min(last));
        (twice >> 4).max(0).min(longest) as u32
    }
}

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
