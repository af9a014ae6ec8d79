//! Divisions along a span, in 32 bits.
//!
//! A span has a block exponent too: the larger q of its ends has its most significant bit at 2^30.
//! Its first pixel is exact to half a unit, and a step from pixel to pixel is rounded to a unit:
//! over n pixels n / 2 units. With r for the ratio of the largest to the least q of the span, that
//! moves u by U r n 2^-31: less than n^2 2^-23 of a pixel, as u changes by up to U r / n there.

use super::{
    Quotient,
    quotient::{AtPixel, Block},
};
use crate::{
    attribute::Components,
    numbers::{Reciprocal, leading_zeros, mul_high},
};

/// 1 / w and numerators at a pixel, or their change, in units of a span.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaled<V: Components> {
    pub(super) q: u32,
    numerators: V::Each<i32>,
}

impl<V: Components> Scaled<V> {
    /// From Q32.32, shifted up and rounded.
    #[inline(always)]
    fn new(at: &AtPixel<V>, up: u32) -> Self {
        let scaled = |value: u64| {
            let rounded = value.wrapping_add((1 << 31) >> up);
            ((rounded >> 32) as u32) << up | (rounded as u32 >> 1) >> (31 - up)
        };
        let mut numerators = V::ZEROS;
        for (to, from) in numerators.as_mut().iter_mut().zip(at.numerators.as_ref()) {
            *to = scaled(*from) as i32;
        }
        Self { q: scaled(at.q), numerators }
    }

    #[inline(always)]
    pub(super) fn plus(mut self, step: &Self) -> Self {
        self.q = self.q.wrapping_add(step.q);
        for (value, step) in self.numerators.as_mut().iter_mut().zip(step.numerators.as_ref()) {
            *value = value.wrapping_add(*step);
        }
        self
    }

    #[inline(always)]
    pub(super) fn times(mut self, count: usize) -> Self {
        self.q = self.q.wrapping_mul(count as u32);
        for step in self.numerators.as_mut() {
            *step = step.wrapping_mul(count as i32);
        }
        self
    }
}

/// How numerators of a span are divided.
#[derive(Clone, Copy, Debug)]
pub(super) struct Division<V: Components> {
    block: Block<V>,
    /// By how many bits its units are finer than the block's.
    pub(super) up: u32,
    /// Whether 16 bits are enough.
    is_quick: bool,
}

impl<V: Components> Quotient<V> {
    /// The first pixel of a span, the step from each to the next, and their division.
    #[inline(always)]
    pub(super) fn along_span(
        &self,
        at: [i32; 2],
        pixels: usize,
    ) -> (Scaled<V>, Scaled<V>, Division<V>) {
        let (at, step) = (self.at(at), self.along_row());
        let [first, change] = [at.q, step.q].map(|q| (q >> 32) as u32);
        let last = first.wrapping_add(change.wrapping_mul(pixels as u32 - 1));
        // No q reaches 2^31; a last one that is rounded to be negative is near 0.
        let largest = if last >> 31 == 0 { first.max(last) } else { first };
        let up = (leading_zeros(largest | 1)).max(1) - 1;
        let division = Division { block: self.block, up, is_quick: false };
        (Scaled::new(&at, up), Scaled::new(&step, up), division)
    }
}

/// The least q that can be divided in 16 bits.
const LEAST_QUICK: u32 = 1 << 29;

/// 2^22 / x in the middle of each 256 of x from 2^14 to 2^16, rounded.
const SEED: [u8; 192] = {
    let mut seed = [0; 192];
    let mut interval = 0;
    while interval < 192 {
        let middle = (64 + interval as u32) * 256 + 128;
        seed[interval] = (((1 << 22) + middle / 2) / middle) as u8;
        interval += 1;
    }
    seed
};

impl<V: Components> Division<V> {
    /// The same, in 16 bits where they are enough and q is large enough at both ends of the span.
    #[inline(always)]
    pub(super) fn quick_if(self, is_enough: bool, [first, last]: [u32; 2]) -> Self {
        // Neither reaches 2^31.
        let is_quick = is_enough && (first.min(last) >= LEAST_QUICK) && (first | last) >> 31 == 0;
        Self { is_quick, ..self }
    }

    /// The numbers at a pixel, modulo 2^32.
    #[inline(always)]
    pub(super) fn numbers(&self, at: &Scaled<V>) -> V::Each<i32> {
        let mut numbers = self.block.base;
        let each = numbers.as_mut().iter_mut().zip(at.numerators.as_ref());
        if self.is_quick {
            // s / q = s' r / 2^30 with the upper 16 bits of both and r = 2^30 / q'. One Newton step
            // from 2^-6.6 gives r within 2^-13.2.
            let q = (at.q + (1 << 14)) >> 15;
            let r0 = u32::from(SEED[((q >> 8) as usize).wrapping_sub(64).min(191)]) << 8;
            let error = ((1u32 << 30).wrapping_sub(q * r0) as i32) >> 10;
            let r = r0 as i32 + ((r0 as i32 * error) >> 20);
            for (number, numerator) in each {
                let quotient = ((numerator + (1 << 14)) >> 15) * r;
                *number = number.wrapping_add((quotient << 1) >> self.block.down);
            }
        } else {
            let reciprocal = Reciprocal::of(at.q.max(1));
            let up = reciprocal.leading_zeros.wrapping_sub(1) & 31;
            for (number, numerator) in each {
                // s / q = (s << (z - 1)) m 2^-61, with z >= 1 and |s| < q / 2: the upper half of
                // the product has 29 bits behind the point, and is below 2^28.
                let quotient = mul_high(numerator << up, reciprocal.mantissa);
                *number = number.wrapping_add((quotient << 2) >> self.block.down);
            }
        }
        numbers
    }

    /// near / w from q, or its change.
    #[inline(always)]
    pub(super) const fn inverse_w(&self, q: u32) -> u32 {
        self.block.inverse_w((q as i32 >> self.up) as u32)
    }
}
