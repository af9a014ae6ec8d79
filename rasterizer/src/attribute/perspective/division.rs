//! Divisions along a span.
//!
//! A span has a block exponent too: the larger q of its ends has its most significant bit at 2^30.

use super::quotient::{AtPixel, Block, upper};
use crate::{attribute::Components, numbers::leading_zeros};

/// How numerators of a span are divided.
#[derive(Clone, Copy, Debug)]
pub(super) struct Division<V: Components> {
    block: Block<V>,
    /// By how many bits its units are finer than the block's.
    pub(super) up: u32,
    /// Whether 16 bits are enough.
    is_quick: bool,
}

impl<V: Components> Division<V> {
    /// Of a span between two pixels.
    #[inline(always)]
    pub(super) fn between(first: &AtPixel<V>, last: &AtPixel<V>, block: Block<V>) -> Self {
        // Below 2^31, so that it has a leading zero.
        let largest = first.q().max(last.q());
        Self { block, up: leading_zeros(largest) - 1, is_quick: false }
    }

    /// In units of the span, modulo 2^64.
    #[inline(always)]
    pub(super) fn scaled(&self, mut at: AtPixel<V>) -> AtPixel<V> {
        let up = self.up;
        let scaled = |value: u64| {
            let (upper, lower) = ((value >> 32) as u32, value as u32);
            u64::from(upper << up | lower >> 1 >> (31 - up)) << 32 | u64::from(lower << up)
        };
        at.q = scaled(at.q);
        for value in at.numerators.as_mut() {
            *value = scaled(*value);
        }
        at
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
        Self { is_quick: is_enough && first.min(last) >= LEAST_QUICK, ..self }
    }

    /// The numbers at a pixel, modulo 2^32.
    #[inline(always)]
    pub(super) fn numbers(&self, at: &AtPixel<V>) -> V::Each<i32> {
        if !self.is_quick {
            return at.divided(&self.block);
        }
        // s / q = s' r / 2^30 with the upper 16 bits of both and r = 2^30 / q'. One Newton step
        // from 2^-6.6 gives r within 2^-13.2.
        let q = (at.q() + (1 << 14)) >> 15;
        let r0 = u32::from(SEED[((q >> 8) as usize).wrapping_sub(64).min(191)]) << 8;
        let error = ((1u32 << 30).wrapping_sub(q * r0) as i32) >> 10;
        let r = r0 as i32 + ((r0 as i32 * error) >> 20);
        let mut numbers = self.block.base;
        for (number, numerator) in numbers.as_mut().iter_mut().zip(at.numerators.as_ref()) {
            let quotient = ((upper(*numerator) + (1 << 14)) >> 15) * r;
            *number = number.wrapping_add((quotient << 1) >> self.block.down);
        }
        numbers
    }

    /// near / w from q.
    #[inline(always)]
    pub(super) const fn inverse_w(&self, q: u32) -> u32 {
        self.block.inverse_w(q >> self.up)
    }

    /// A change of near / w from that of q.
    #[inline(always)]
    pub(super) const fn step_of_inverse_w(&self, change: i32) -> u32 {
        ((change >> self.up << 2) >> self.block.zeros) as u32
    }
}
