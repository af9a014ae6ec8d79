//! Quotients in 16 bits, for triangles that need no more.
//!
//! Where no corner is much farther away than the others, planes of 32 bits without digits behind
//! the point are enough, and products of 16 bits divide them. Units are half of a
//! [`quotient`](super::quotient)'s: the largest q of the corners has its most significant bit at
//! 2^30, and at every pixel q is at least 2^29.
//!
//! # Error
//!
//! In units of 2^(k + 1), of which the quotient is at most half:
//!
//! ```text
//!   planes       gradients are rounded to a unit, so n / 2 + 1 units of s and of q over n pixels
//!                in x and y together: 3/2 of that over 2^29, for n = 2^13      2^-16.4
//!   numerator    half a digit of 2^15, over 2^29                               2^-15
//!   q            half of that                                                  2^-16
//!   reciprocal   half of 2^-13.7                                               2^-14.7
//!   slope        the difference along a step, rounded to 15 digits             2^-16
//!                the part of it that a pixel has: U 2^-15                      2^-17
//! ```
//!
//! Together 2^-13.05, or U 2^-11.05, as 2^(k + 1) is at most four times the range U. The shift of a
//! chord adds an eighth of half of 2^-14 of the difference along it: U 2^-18.
//!
//! # Shift
//!
//! Along a step the chord is off to one side only, by 0 at the ends and by up to e, of which
//! [`pace`](super::pace) has a bound b:
//!
//! ```text
//!   e = |du dq| / (sqrt(q0) + sqrt(q1))^2  <=  |du dq| / (4 min(q0, q1)) = b
//! ```
//!
//! A chord that is moved to that side by h = |du dq| / (8 q1) is off by up to b / 2 to both: with x
//! = sqrt(max / min), h is b / 2 or b / (2 x^2), and e - h at most b (4 / (1 + x)^2 - 1 / (2 x^2)),
//! which is largest at x = 1. So steps are longer by the root of two.

use core::ops::RangeInclusive;

use super::{
    Pace,
    pace::{Law, power_of_2},
    quotient::{Block, Corners, Quotient},
    steps::{SteppedWalk, part},
};
use crate::attribute::{Components, Field, Piece, Plane};

/// The widest range of numbers, as a multiple of their tolerance: 2^11.04 / 8 is 263, for an error
/// of up to an eighth of it. It leaves as much as the reciprocal's error moves a shift.
pub(super) const QUICK_RANGE: u32 = 260;

/// 1 / w and numerators as functions of the pixel, half a digit of 2^15 above their values, and the
/// length of steps.
#[derive(Clone, Copy, Debug)]
pub struct QuickQuotient<V: Components> {
    q: Plane<u32>,
    numerators: V::Each<Plane<u32>>,
    base: V::Each<i32>,
    /// 29 - k.
    down: u32,
    /// The leading zeros of the largest q.
    zeros: u32,
    /// The pixels of a step where q is 2^31, at least [`LEAST_PACE`].
    pace: u32,
}

/// The pixels of a step where q is 2^31, so that there is at least one where q is 2^29.
const LEAST_PACE: u32 = 8;

/// The `down` of a block for which all shifts are from 0 to 31: by one less, and by up to 6 more
/// for the length of a step.
const SHIFTS: RangeInclusive<u32> = 1..=26;

/// By how many bits numbers of 32 bits are shifted to the right before they are divided.
const DROPPED: u32 = 15;

/// Half a digit of what is left of them.
const HALF: u32 = 1 << (DROPPED - 1);

impl<V: Components> QuickQuotient<V> {
    /// Returns `None` for a triangle that needs more than 16 bits. Its last row is this far below
    /// the anchor.
    #[inline(always)]
    pub(super) fn new<P: Pace>(
        corners: &Corners<V>,
        quotient: &Quotient<V>,
        law: &Law<V>,
        last_row: i32,
    ) -> Option<Self> {
        let [a, b, c] = corners.q;
        // Planes are off by up to 2^13 / 2 + 1 units, two of which are one of the corners'.
        let margin = 1 << 12;
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        let Block { base, down, zeros } = quotient.block;
        if least < (1 << 28) + margin
            || most > (1 << 30) - margin
            || !SHIFTS.contains(&down)
            || !P::is_quick(corners)
        {
            return None;
        }
        // W is linear in the row, so it is largest in the first or the last one. Of the corners'
        // units, q = 2^31 has 2^30.
        let level = P::level(law, 0).min(P::level(law, last_row));
        // Twice the bound of a chord: 32 more.
        let pace = power_of_2(level + 32 + 3 * 32 * 30);
        let mut numerators = V::each(Plane { anchor: 0, per_column: 0, per_row: 0 });
        for (to, plane) in numerators.as_mut().iter_mut().zip(quotient.numerators.as_ref()) {
            *to = rounded(plane);
        }
        let q = rounded(&quotient.q);
        (pace >= LEAST_PACE).then_some(Self { q, numerators, base, down: down - 1, zeros, pace })
    }
}

/// A plane in whole units of half its size.
#[inline(always)]
fn rounded(plane: &Plane<u64>) -> Plane<u32> {
    // Half a unit of its own is added to its anchor already: one of these.
    let half = |value: u64| (value.wrapping_add(1 << 30) >> 31) as u32;
    Plane {
        anchor: ((plane.anchor >> 31) as u32).wrapping_add(HALF - 1),
        per_column: half(plane.per_column),
        per_row: half(plane.per_row),
    }
}

impl<V: Components> Field for QuickQuotient<V> {
    #[inline(always)]
    fn over_addresses(mut self, to_first: [i32; 2], pitch: i32) -> Self {
        self.q = self.q.over_addresses(to_first, pitch);
        for plane in self.numerators.as_mut() {
            *plane = plane.over_addresses(to_first, pitch);
        }
        self
    }
}

/// 2^22 / x in the middle of each 256 of x from 2^14 to 2^16, rounded.
const SEED: [u8; 256] = {
    let mut seed = [0; 256];
    let mut interval = 64;
    while interval < 256 {
        let middle = interval as u32 * 256 + 128;
        seed[interval] = (((1 << 22) + middle / 2) / middle) as u8;
        interval += 1;
    }
    seed
};

/// 2^30 / q for a q of 16 bits from 2^14 on, within 2^-13.7.
///
/// From a seed with the relative error e, up to 2^-6.6, a Newton step leads to one between -e^2 and
/// 0. It aims 2^-14.45 higher, at the middle.
#[inline(always)]
const fn reciprocal(q: u32) -> i32 {
    const HIGHER: u32 = 48_000;
    let seed = (SEED[(q >> 8 & 255) as usize] as u32) << 8;
    let error = ((1 << 30) + HIGHER).wrapping_sub(q * seed).cast_signed() >> 10;
    let seed = seed.cast_signed();
    seed + ((seed * error + (1 << 19)) >> 20)
}

/// The steps of a span that are left.
#[derive(Clone, Copy, Debug)]
pub struct QuickPieces<V: Components> {
    /// At the next pixel.
    q: u32,
    numerators: V::Each<u32>,
    /// From a pixel to the next.
    q_step: u32,
    numerator_steps: V::Each<u32>,
    base: V::Each<i32>,
    down: u32,
    zeros: u32,
    /// Their quotient: Q30 in units of 2^(k + 1).
    quotients: V::Each<i32>,
    /// The pixels of a step.
    length: usize,
}

impl<V: Components> QuickPieces<V> {
    /// From the first pixel of a span.
    #[inline(always)]
    pub(super) fn new<P: Pace>(
        field: &QuickQuotient<V>,
        [address, row]: [i32; 2],
        pixels: usize,
    ) -> Self {
        let q = field.q.at(address, row);
        let last = q.wrapping_add(field.q.per_column.wrapping_mul(pixels as u32 - 1));
        let length = (field.pace * u32::from(PACES[(q.min(last) >> 24 & 127) as usize])) >> 8;
        let (mut numerators, mut numerator_steps) = (V::each(0), V::each(0));
        let planes = field.numerators.as_ref().iter();
        for ((at, step), plane) in
            numerators.as_mut().iter_mut().zip(numerator_steps.as_mut()).zip(planes)
        {
            (*at, *step) = (plane.at(address, row), plane.per_column);
        }
        let quotients = divided::<V>(reciprocal(q >> DROPPED), &numerators);
        let length = (length as usize).min(P::longest::<V>());
        Self {
            q,
            numerators,
            q_step: field.q.per_column,
            numerator_steps,
            base: field.base,
            down: field.down,
            zeros: field.zeros,
            quotients,
            length,
        }
    }

    /// The next step, with this many pixels from its first one to the end of the span, at least 1.
    /// It leads to a division after `length` pixels or at the span's last pixel, where the triangle
    /// has a value.
    #[inline(always)]
    pub(super) fn piece(&mut self, left: usize) -> Piece<SteppedWalk<V>> {
        let pixels = self.length.min(left);
        let way = pixels - usize::from(pixels == left);
        let (q, from) = (self.q, self.quotients);
        let to = |at: u32, step: u32| at.wrapping_add(step.wrapping_mul(way as u32));
        self.q = to(q, self.q_step);
        for (at, step) in self.numerators.as_mut().iter_mut().zip(self.numerator_steps.as_ref()) {
            *at = to(*at, *step);
        }
        let reciprocal = reciprocal(self.q >> DROPPED);
        self.quotients = divided::<V>(reciprocal, &self.numerators);
        let change = self.q.wrapping_sub(q).cast_signed() >> DROPPED;
        // dq / q1, from -3 to 3/4, in Q14.
        let ratio = (change * (reciprocal >> 2) + (1 << 13)) >> 14;
        // A step of one pixel has no way: its changes are 0, and any part will do.
        let (part, log2) = part(way);
        let (mut first, mut step) = (self.base, self.quotients);
        for ((first, step), from) in first.as_mut().iter_mut().zip(step.as_mut()).zip(from.as_ref())
        {
            // Q15, up to 2^15.
            let difference = (*step - from + (1 << 14)) >> 15;
            // du dq / (8 q1) in Q30.
            let shift = (difference * ratio) >> 2;
            *first = first.wrapping_add((from + shift) >> self.down);
            *step = (difference * part) >> (self.down + log2);
        }
        let change = (change * part) >> log2;
        Piece {
            first: SteppedWalk::new(V::walk_from(first), (q << 1) >> self.zeros),
            step: SteppedWalk::new(V::step_from(step), ((change << 1) >> self.zeros) as u32),
            pixels,
        }
    }
}

/// Numerators times the reciprocal of q: Q30.
#[inline(always)]
fn divided<V: Components>(reciprocal: i32, numerators: &V::Each<u32>) -> V::Each<i32> {
    let mut quotients = V::ZEROS;
    for (quotient, numerator) in quotients.as_mut().iter_mut().zip(numerators.as_ref()) {
        *quotient = (numerator.cast_signed() >> DROPPED) * reciprocal;
    }
    quotients
}

/// (n / 128)^(3/2) in Q8, rounded down: steps grow with the root of q^3.
const PACES: [u8; 128] = {
    let mut paces = [0; 128];
    let mut n = 0;
    while n < 128 {
        // n^3 2^16 / 2^21 is below 2^16.
        paces[n] = ((n * n * n) >> 5).isqrt() as u8;
        n += 1;
    }
    paces
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reciprocals_are_within_their_bound() {
        let worst = (1 << 14..1 << 16)
            .map(|q| (f64::from(reciprocal(q)) * f64::from(q) / 2f64.powi(30) - 1.0).abs())
            .fold(0.0, f64::max);
        assert!(worst < 2f64.powf(-13.7) && worst > 2f64.powf(-13.8), "2^{}", worst.log2());
    }

    #[test]
    fn shifted_chords_are_off_by_half_the_bound_to_both_sides() {
        for ratio in (25..=400).map(|percent| f64::from(percent) / 100.0) {
            // Of q at the end to q at the start, for du = 1 and q = 1 at the start.
            let change = (ratio - 1.0).abs();
            let off = change / (1.0 + ratio.sqrt()).powi(2);
            let half_bound = change / (4.0 * ratio.min(1.0)) / 2.0;
            let shift = change / (8.0 * ratio);
            assert!(shift <= half_bound * 1.000_001, "{ratio}");
            assert!((off - shift).abs() <= half_bound * 1.000_001, "{ratio}");
        }
    }

    /// A step towards twice and one towards half the distance: at the first pixel the number is
    /// moved to the side where the numbers between the ends lie.
    #[test]
    fn chords_are_moved_towards_the_curve() {
        for (q, q_step) in [(1 << 31, (1u32 << 30) / 15), (1 << 30, (1u32 << 30) / 15)] {
            let q_step = if q == 1 << 31 { q_step.wrapping_neg() } else { q_step };
            // s from 0: u = s / q grows from 0 to 1/4 of a unit.
            let last = q_step.wrapping_mul(15).wrapping_add(q);
            let numerators = [0u32];
            let mut pieces = QuickPieces::<u16> {
                q,
                numerators,
                q_step,
                numerator_steps: [last / 4 / 15],
                base: [0],
                down: 1,
                zeros: 0,
                quotients: divided::<u16>(reciprocal(q >> DROPPED), &numerators),
                length: 15,
            };
            let piece = pieces.piece(16);
            let (q, last) = (f64::from(q), f64::from(last));
            // Components of u16 have 13 digits, and are stepped with 16, half a unit above.
            let unit = 2f64.powi(29 + 3);
            let start = f64::from(piece.first.numbers.cast_signed() - (1 << 15)) / unit;
            let wanted = 0.25 * (last - q) / (8.0 * last);
            assert!((start - wanted).abs() < 2f64.powi(-13), "{q}: {start} for {wanted}");
            let step = f64::from(piece.step.numbers.cast_signed()) / unit;
            assert!((step * 15.0 - 0.25).abs() < 2f64.powi(-12), "{q}: {step}");
        }
    }

    #[test]
    fn paces_are_powers() {
        for (n, &pace) in PACES.iter().enumerate() {
            assert_eq!(u32::from(pace), ((n as f64 / 128.0).powf(1.5) * 256.0) as u32, "{n}");
        }
        // Where q is 2^29.
        assert_eq!((LEAST_PACE * u32::from(PACES[32])) >> 8, 1);
    }
}
