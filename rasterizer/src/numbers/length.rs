//! One over the length of a vector, by a table alone: for what only scales a pixel's light.

use super::{leading_zeros, not_negative};

/// A vector and one over its length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scaled {
    /// The vector, shifted up if its length is below 2^14. A zero vector stays zero.
    pub(crate) vector: [i32; 3],
    /// 2^30 / its length: below 2^16, within 2^-14.4.
    pub(crate) scale: u32,
}

impl Scaled {
    /// Of a vector of a length of up to 2^15.1.
    #[inline(always)]
    pub(crate) fn of(v: [i32; 3]) -> Self {
        let (mut vector, mut square) = (v, square(v));
        if square >> 28 == 0 {
            // codegen: only the shift is computed elsewhere: the vector stays in registers.
            let half = bits_short(square);
            vector = v.map(|c| c << half);
            square = square.max(1) << (2 * half);
        }
        Self { vector, scale: inverse_length(square) }
    }

    /// Its scalar product with a vector of a length of up to 2^15, or 0 if that is negative, times
    /// 2^-14: below 2^17. For a vector in Q15, this times the scale is the cosine in Q31.
    #[inline(always)]
    pub(crate) const fn along(&self, [x, y, z]: &[i32; 3]) -> u32 {
        let [a, b, c] = self.vector;
        // Below 2^30.2.
        not_negative::<17>((a * *x + b * *y + c * *z) >> 14)
    }
}

/// By how many bits a vector is shifted up to a length from 2^14 to 2^15.
#[cold]
#[inline(never)]
fn bits_short(square: u32) -> u32 {
    (leading_zeros(square.max(1)) - 2) >> 1
}

#[inline(always)]
const fn square([x, y, z]: [i32; 3]) -> u32 {
    (x * x + y * y + z * z) as u32
}

/// The bits of a square that are the index of an interval.
const STEP_BITS: u32 = 22;

/// The intervals of squares from 2^28 to 2^30.3. Those below 2^28 are never read: the first entries
/// are for squares from 2^30 on.
const INTERVALS: usize = 256;

/// For each interval 2^30 / √square at its start, in the upper 16 bits, and by how much that falls
/// until its end, in the lower.
///
/// A line between both ends is too high, by (h / x)^2 3 / 32 of itself for an interval of length h
/// at x: 2^-15.4 at most, in the first. So half of that is taken off in the middle, and 2^-16.4 is
/// left. And 2^-16 is added for what shifts cut off of a product and of the result.
const TABLE: [u32; INTERVALS] = {
    const fn inverse_root(square: u64) -> u64 {
        // In Q10: 2^40 / √square = √(2^80 / square).
        ((1u128 << 80) / square as u128).isqrt() as u64
    }
    let mut table = [0; INTERVALS];
    let mut interval = 64;
    while interval < INTERVALS as u64 + 64 {
        let start = interval << STEP_BITS;
        let [from, middle, to] = [
            inverse_root(start),
            inverse_root(start + (1 << (STEP_BITS - 1))),
            inverse_root(start + (1 << STEP_BITS)),
        ];
        let off = ((from + to) / 2 - middle) / 2;
        let higher = middle >> 16;
        let value = (from - off + higher + (1 << 9)) >> 10;
        let value = if value > 0xFFFF { 0xFFFF } else { value };
        table[interval as usize % INTERVALS] =
            (value << 16 | ((from - to + (1 << 9)) >> 10)) as u32;
        interval += 1;
    }
    table
};

/// 2^30 / √square for 2^28 <= square < 2^30.3.
#[inline(always)]
pub(super) const fn inverse_length(square: u32) -> u32 {
    let entry = TABLE[(square >> STEP_BITS) as usize & (INTERVALS - 1)];
    // 16 bits of the way times 16 bits of the fall.
    let way = (square >> (STEP_BITS - 16)) & 0xFFFF;
    (entry - (entry & 0xFFFF) * way) >> 16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn inverse_lengths_keep_their_bound() {
        for square in (1u32 << 28..5 << 28).step_by(61) {
            let exact = 2f64.powi(30) / f64::from(square).sqrt();
            let error = f64::from(inverse_length(square)) / exact - 1.0;
            assert!(error.abs() < 2f64.powf(-14.4), "{square}: 2^{}", error.abs().log2());
        }
    }

    /// The bound of a highlight's cosine: 2^-13, of which the rounding of the vector in Q15 is a
    /// part.
    #[test]
    fn cosines_of_vectors_of_any_length_keep_their_bound() {
        let mut random = Random::new(71);
        let mut vector = |length: f64| {
            let v = [(); 3].map(|()| (random.bits() >> 33) as f64 / 2f64.powi(30) - 1.0);
            let norm = v.iter().map(|c| c * c).sum::<f64>().sqrt();
            v.map(|c| c / norm * length)
        };
        for step in 0..400_000u32 {
            // From the longest down to one that has ten bits.
            let long = vector(32_785.0 * 2f64.powf(-f64::from(step % 1_000) / 200.0));
            let v = long.map(|c| c as i32);
            let norm = v.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>().sqrt();
            // Half of the directions are close to the vector, where the cosine is near 1.
            let near = if step % 2 == 0 { 0.0 } else { 2.0 };
            let other = vector(1.0);
            let sum: [f64; 3] = core::array::from_fn(|i| other[i] + near * f64::from(v[i]) / norm);
            let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
            let direction = sum.map(|c| c / length);
            let scaled = Scaled::of(v);
            let q15 = direction.map(|c| (c * 32_768.0).round() as i32);
            let got = f64::from((scaled.along(&q15) * scaled.scale) >> 16) / 32_768.0;
            let exact = (0..3).map(|i| direction[i] * f64::from(v[i]) / norm).sum::<f64>().max(0.0);
            assert!((got - exact).abs() < 2f64.powi(-13), "{v:?} {q15:?}: {got} {exact}");
        }
        let zero = Scaled::of([0; 3]);
        assert_eq!(zero.along(&[1 << 15, 0, 0]), 0);
    }
}
