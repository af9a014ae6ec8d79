//! 1 / w and the numbers over w as functions of the pixel, and their quotients.
//!
//! # Formats
//!
//! The corners' q = near / w share a block exponent: they are shifted so that the largest has its
//! most significant bit at 2^29. The numbers u are counted from the first corner's, d = u - u0,
//! which takes off what all corners have in common, whole repeats of a texture for example. With
//! d < 2^k, the numerators are
//!
//! ```text
//!   s = d q / 2^(k + 1)        |s| < q / 2 <= 2^29
//! ```
//!
//! Planes of q and of each s have 18 binary digits behind the point. At a pixel
//!
//! ```text
//!   u = u0 + 2^(k + 1) s / q
//! ```
//!
//! # Error
//!
//! Let r be the ratio of the corners' largest q to their least. A rounding error of q at a corner
//! only shifts the weights: it moves u by U times its relative error, at most U r 2^-30. Planes are
//! off by a unit for their rounding at the corner and half a unit for that at the pixel, and by n /
//! 2^18 over n pixels: with numerators of half the size, by U r 2^-27 together. The reciprocal adds
//! U 2^-27, and the product's lost bits U 2^-27.
//!
//! That is with gradients that are divided exactly. By the reciprocal ([`QuickGradients`]) they are
//! within 2^-26 of the largest gradient of a triangle of this extent e and area, which is e / area
//! of the range: over e pixels u is off by U r 2^-25 e^2 / area, and e^2 / area is at most 64. A
//! pixel changes u by U / e or more, so that this is less than 1/256 of one for the 128 pixels of a
//! quick triangle in 8 bits, and for 2,048 in 4 bits.

use crate::{
    attribute::{Components, Field, InverseW, Plane, QuickGradients, TriangleSetup},
    numbers::{Reciprocal, Subpixel, leading_zeros, mul_high},
};

/// A linear number in Q32.32, with 18 binary digits behind the point, and its change.
type Wide = Plane<u64>;

/// 1 / w and numerators as functions of the pixel.
#[derive(Clone, Copy, Debug)]
pub struct Quotient<V: Components> {
    pub(super) q: Wide,
    pub(super) numerators: V::Each<Wide>,
    pub(super) block: Block<V>,
    to_first: [i32; 2],
    pitch: i32,
}

/// What is constant over a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block<V: Components> {
    /// The numbers of the first corner.
    pub(super) base: V::Each<i32>,
    /// 30 - k.
    pub(super) down: u32,
    /// The leading zeros of the largest q.
    pub(super) zeros: u32,
}

/// 1 / w and numerators at a pixel: Q32.32.
#[derive(Clone, Copy, Debug)]
pub(super) struct AtPixel<V: Components> {
    pub(super) q: u64,
    pub(super) numerators: V::Each<u64>,
}

/// The corners of a triangle in a block's numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners<V: Components> {
    /// near / w: the largest from 2^29 to 2^30, so that rounding cannot reach 2^31.
    pub(super) q: [u32; 3],
    /// From the first corner's numbers to the others'.
    pub(super) differences: [V::Each<i32>; 2],
    base: V::Each<i32>,
    zeros: u32,
}

impl<V: Components> Corners<V> {
    #[inline(always)]
    pub(super) fn new([a, b, c]: [(V, InverseW); 3]) -> Self {
        let q = [a.1.to_bits(), b.1.to_bits(), c.1.to_bits()];
        let zeros = leading_zeros(q[0] | q[1] | q[2]);
        let base = a.0.components();
        let from_base = |v: V| {
            let mut difference = v.components();
            for (to, from) in difference.as_mut().iter_mut().zip(base.as_ref()) {
                *to -= from;
            }
            difference
        };
        Self {
            q: [(q[0] << zeros) >> 2, (q[1] << zeros) >> 2, (q[2] << zeros) >> 2],
            differences: [from_base(b.0), from_base(c.0)],
            base,
            zeros,
        }
    }

    /// The bits of all differences together: at least each of them, and the absolute value of each
    /// less 1.
    #[inline(always)]
    fn magnitudes(&self) -> u32 {
        let [one, other] = &self.differences;
        let all = one.as_ref().iter().chain(other.as_ref());
        all.fold(0, |bits, d| bits | (d ^ (d >> 31)) as u32)
    }

    /// The least k for which all differences are below 2^k, from 1 to 30.
    #[inline(always)]
    pub(super) fn bits(&self) -> u32 {
        32 - leading_zeros(self.magnitudes() | 1)
    }

    /// The range of each number, in sixteenths of a unit, rounded up.
    #[inline(always)]
    pub(super) fn sixteenths(&self) -> V::Each<u32> {
        let mut ranges = V::UNIT_BITS;
        let [one, other] = &self.differences;
        for ((range, &d1), &d2) in ranges.as_mut().iter_mut().zip(one.as_ref()).zip(other.as_ref())
        {
            let distance = d1.max(d2).max(0) - d1.min(d2).min(0);
            *range = (distance as u32 >> (*range - 4)) + 1;
        }
        ranges
    }

    /// A bound of the ranges: at least each of them. A range is at most twice the largest
    /// difference.
    #[inline(always)]
    pub(super) fn sixteenths_at_most(&self) -> u32 {
        (self.magnitudes() >> (least_unit_bits::<V>() - 5)) + 2
    }

    /// The numerators of one number at all corners.
    #[inline(always)]
    pub(super) fn numerators(&self, index: usize, bits: u32) -> [i32; 3] {
        let [_, b, c] = self.q;
        let of = |corner: usize, q: u32| {
            let d = self.differences[corner].as_ref()[index];
            mul_high(d << (31 - bits), q as i32)
        };
        [0, of(0, b), of(1, c)]
    }
}

/// The least digits that a unit of a number has.
#[inline(always)]
pub(super) fn least_unit_bits<V: Components>() -> u32 {
    let mut least = u32::MAX;
    for &bits in V::UNIT_BITS.as_ref() {
        least = least.min(bits);
    }
    least
}

impl<V: Components> Quotient<V> {
    #[inline(always)]
    pub(super) fn new<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: &Corners<V>,
        bits: u32,
    ) -> Self {
        let zero = Plane { anchor: 0, per_column: 0, per_row: 0 };
        let mut numerators = V::each(zero);
        for (index, plane) in numerators.as_mut().iter_mut().enumerate() {
            *plane = signed(setup, quick, corners.numerators(index, bits));
        }
        Self {
            q: setup.wide_plane(quick, corners.q),
            numerators,
            block: Block { base: corners.base, down: 30 - bits, zeros: corners.zeros },
            to_first: [0; 2],
            pitch: 0,
        }
    }

    /// The changes of q along a row and down the rows, in whole units.
    #[inline(always)]
    pub(super) const fn q_slopes(&self) -> [i32; 2] {
        slopes(&self.q)
    }

    /// The same of the numerators.
    #[inline(always)]
    pub(super) fn numerator_slopes(&self) -> V::Each<[i32; 2]> {
        let mut all = V::each([0; 2]);
        for (to, plane) in all.as_mut().iter_mut().zip(self.numerators.as_ref()) {
            *to = slopes(plane);
        }
        all
    }

    /// From the anchor's row to another.
    #[inline(always)]
    pub(super) const fn rows(&self, row: i32) -> i32 {
        row.wrapping_add(self.to_first[1])
    }
}

#[inline(always)]
const fn slopes(plane: &Wide) -> [i32; 2] {
    [upper(plane.per_column), upper(plane.per_row)]
}

/// The plane of a number with a sign, of magnitude below 2^31.
#[inline(always)]
fn signed<S: Subpixel>(
    setup: &TriangleSetup<S>,
    quick: Option<QuickGradients>,
    corners: [i32; 3],
) -> Wide {
    let mut plane = setup.wide_plane(quick, corners.map(|s| s as u32 ^ 1 << 31));
    plane.anchor ^= 1 << 63;
    plane
}

impl<V: Components> Field for Quotient<V> {
    #[inline(always)]
    fn over_addresses(self, to_first: [i32; 2], pitch: i32) -> Self {
        Self { to_first, pitch, ..self }
    }
}

impl<V: Components> Quotient<V> {
    /// 1 / w and the numerators at the pixel at an address of a row.
    #[inline(always)]
    pub(super) fn at(&self, [address, row]: [i32; 2]) -> AtPixel<V> {
        let [column, _] = self.to_first;
        let columns = address.wrapping_add(column).wrapping_sub(row.wrapping_mul(self.pitch));
        let rows = self.rows(row);
        let mut numerators = V::WIDE_ZEROS;
        for (value, plane) in numerators.as_mut().iter_mut().zip(self.numerators.as_ref()) {
            *value = at(plane, columns, rows);
        }
        AtPixel { q: at(&self.q, columns, rows), numerators }
    }

    /// Their change along a row.
    #[inline(always)]
    pub(super) fn along_row(&self) -> AtPixel<V> {
        let mut numerators = V::WIDE_ZEROS;
        for (step, plane) in numerators.as_mut().iter_mut().zip(self.numerators.as_ref()) {
            *step = plane.per_column;
        }
        AtPixel { q: self.q.per_column, numerators }
    }
}

/// The value at the pixel that lies up to 2^12 columns and rows from the anchor.
///
/// The digits before and those behind the point are multiplied by themselves, in products of 32
/// bits: there are 18 behind it, and all three terms together are below 2^31.
#[inline(always)]
const fn at(plane: &Wide, columns: i32, rows: i32) -> u64 {
    joined(
        upper(plane.anchor)
            .wrapping_add(upper(plane.per_column).wrapping_mul(columns))
            .wrapping_add(upper(plane.per_row).wrapping_mul(rows)),
        lower(plane.anchor) + lower(plane.per_column) * columns + lower(plane.per_row) * rows,
    )
}

/// The digits before the point.
#[inline(always)]
pub(super) const fn upper(value: u64) -> i32 {
    (value >> 32) as i32
}

/// The 18 digits behind the point.
#[inline(always)]
const fn lower(value: u64) -> i32 {
    (value as u32 >> 14) as i32
}

#[inline(always)]
const fn joined(upper: i32, lower: i32) -> u64 {
    ((upper as i64) << 32).wrapping_add((lower as i64) << 14) as u64
}

impl<V: Components> AtPixel<V> {
    pub(super) const ZERO: Self = Self { q: 0, numerators: V::WIDE_ZEROS };

    /// The value some pixels on.
    #[inline(always)]
    pub(super) fn plus(mut self, step: &Self) -> Self {
        self.q = self.q.wrapping_add(step.q);
        for (value, step) in self.numerators.as_mut().iter_mut().zip(step.numerators.as_ref()) {
            *value = value.wrapping_add(*step);
        }
        self
    }

    /// Some steps together, up to 2^12.
    #[inline(always)]
    pub(super) fn times(mut self, count: i32) -> Self {
        let times = |step: u64| joined(upper(step).wrapping_mul(count), lower(step) * count);
        self.q = times(self.q);
        for step in self.numerators.as_mut() {
            *step = times(*step);
        }
        self
    }

    /// The digits of q before the point, at least 1: far away, rounding may make it 0 or less.
    #[inline(always)]
    pub(super) fn q(&self) -> u32 {
        upper(self.q).max(1).cast_unsigned()
    }

    /// The numbers at the pixel, modulo 2^32.
    #[inline(always)]
    pub(super) fn divided(&self, block: &Block<V>) -> V::Each<i32> {
        let reciprocal = Reciprocal::of(self.q());
        let mut numbers = block.base;
        for (number, numerator) in numbers.as_mut().iter_mut().zip(self.numerators.as_ref()) {
            // s / q = (s << (z - 1)) m 2^-61, with z >= 1 and |s| < q / 2: the upper half of the
            // product has 29 bits behind the point, and is below 2^28.
            let numerator = upper(*numerator) << (reciprocal.leading_zeros - 1);
            let quotient = mul_high(numerator, reciprocal.mantissa);
            *number = number.wrapping_add((quotient << 2) >> block.down);
        }
        numbers
    }
}

impl<V: Components> Block<V> {
    pub(super) const ZERO: Self = Self { base: V::ZEROS, down: 0, zeros: 0 };

    /// near / w from q.
    #[inline(always)]
    pub(super) const fn inverse_w(&self, q: u32) -> u32 {
        (q << 2) >> self.zeros
    }

    /// A change of near / w from that of q.
    #[inline(always)]
    pub(super) const fn step_of_inverse_w(&self, change: i32) -> u32 {
        ((change << 2) >> self.zeros) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// It is the range itself, rounded up, where the first corner lies in the middle of the others.
    #[test]
    fn no_range_is_above_its_bound() {
        let mut random = Random::new(5);
        let mut close = 0;
        for _ in 0..100_000 {
            let bits = random.bits();
            let digits = (bits >> 60) as u32;
            let number = |shift: u64| ((bits >> shift) as u16 >> digits) as i16;
            let corners =
                Corners::new([0, 16, 32].map(|shift| {
                    ([number(shift), -number(shift + 5)], InverseW::from_bits(1 << 31))
                }));
            let bound = corners.sixteenths_at_most();
            for range in corners.sixteenths() {
                assert!(range <= bound, "{range} {bound}");
                close += u32::from(range + 1 >= bound);
            }
        }
        assert!(close > 10, "{close}");
    }
}
