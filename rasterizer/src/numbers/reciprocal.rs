//! The reciprocal of a positive integer, from a table and two Newton steps.
//!
//! A core without a divide instruction needs some 25 instructions for it. On a core with a divider
//! it takes no longer than the divider would for the same precision. All cores compute the same
//! bits.

use super::instructions::{mul_high_unsigned, normalised};

/// 1 / value as `mantissa * 2^(leading_zeros - 62)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Reciprocal {
    /// 2<sup>62</sup> / (value << `leading_zeros`), from 2<sup>30</sup> to 2<sup>31</sup> - 1.
    ///
    /// Its relative error is below 2<sup>-27</sup>.
    pub(crate) mantissa: i32,
    /// The leading zeros of the value as a `u32`.
    pub(crate) leading_zeros: u32,
}

/// The reciprocal in the middle of each of 128 intervals of [1, 2), in 256ths, less 256: within
/// 2^-7.4.
const SEED: [u8; 128] = {
    let mut seed = [0; 128];
    let mut interval = 0;
    while interval < 128 {
        // The middle of the interval is (2 i + 257) / 512 of the normalised value's range [1/2, 1).
        let middle = 2 * interval as u32 + 257;
        seed[interval] = ((256 * 512 + middle / 2) / middle - 256) as u8;
        interval += 1;
    }
    seed
};

impl Reciprocal {
    /// The largest error over all mantissas is 2<sup>-27.3</sup>.
    #[cfg(test)]
    pub(crate) const MAX_RELATIVE_ERROR: f64 = 1.0 / (1u64 << 27) as f64;

    /// The reciprocal of a positive number.
    #[inline(always)]
    pub(crate) const fn of(value: u32) -> Self {
        let (normalised, leading_zeros) = normalised(value);
        Self { mantissa: mantissa(normalised), leading_zeros }
    }

    /// The reciprocal of a number of an upper word, from 1 to 2<sup>31</sup> - 1, and a lower one.
    /// Leading zeros are the upper word's.
    #[inline(always)]
    pub(crate) const fn of_words(upper: u32, lower: u32) -> Self {
        let (normalised, leading_zeros) = normalised(upper);
        let rest = lower >> (32 - leading_zeros);
        Self { mantissa: mantissa(normalised | rest), leading_zeros }
    }

    /// The mantissa after one more Newton step in 64 bits: within 2<sup>-30</sup>, for what is
    /// computed once per frame.
    pub(crate) const fn refined_mantissa(self, value: u32) -> i32 {
        let normalised = (value << self.leading_zeros) as i64;
        let mantissa = self.mantissa as i64;
        // 1 - m r in Q62, below 2^-27 of it: 32 bits are enough for a correction of 27 bits.
        let error = (1i64 << 62) - normalised * mantissa;
        let refined = mantissa + ((mantissa * (error >> 30)) >> 32);
        if refined > i32::MAX as i64 { i32::MAX } else { refined as i32 }
    }
}

/// 2^62 / m for a normalised m, 2^31 <= m < 2^32.
#[inline(always)]
const fn mantissa(m: u32) -> i32 {
    // r0 = 1/m in Q8, 9 bits.
    let r0 = 256 + SEED[((m >> 24) & 127) as usize] as u32;
    // r1 = r0 (2 - m r0): Q8 x Q24 >> 17 = Q15. The second factor drops 3 bits so that the product
    // fits 32. Of m its upper 16 bits.
    let r1 = (r0 * (((1 << 25) - r0 * (m >> 16)) >> 3)) >> 14;
    // m r1 in Q31, near 1: from the exact 48-bit product without its lowest 16 bits.
    let product = mul_high_unsigned(m, r1 << 16);
    // 1 - m r1 in Q28, at most 2^-14.2: the product with r1 fits 32 bits.
    let error = ((1u32 << 31).wrapping_sub(product) as i32) >> 3;
    // r2 = r1 + r1 (1 - m r1): Q30, and Q15 x Q28 >> 13 = Q30.
    // A Newton step gives less than the reciprocal, so the largest, that of 2^31, is below 2^31.
    (r1 << 15) as i32 + ((r1 as i32 * error) >> 13)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every one of the 2^31 normalised mantissas.
    #[test]
    fn error_bound_holds_for_all_mantissas() {
        let worst = |from: u64, to: u64| {
            (from..to)
                .map(|m| (f64::from(mantissa(m as u32)) * m as f64 / 2f64.powi(62) - 1.0).abs())
                .fold(0.0, f64::max)
        };
        let worst = std::thread::scope(|scope| {
            let upper = scope.spawn(|| worst(3 << 30, 1 << 32));
            worst(1 << 31, 3 << 30).max(upper.join().unwrap())
        });
        assert!(worst < Reciprocal::MAX_RELATIVE_ERROR, "2^{}", worst.log2());
        assert!(
            worst > Reciprocal::MAX_RELATIVE_ERROR / 2.0,
            "the bound is loose: 2^{}",
            worst.log2()
        );
    }

    #[test]
    fn scales_with_the_value() {
        for value in [1u32, 2, 3, 5, 255, 256, 257, 65535, 65536, 1 << 31, u32::MAX] {
            let r = Reciprocal::of(value);
            let got = f64::from(r.mantissa) * 2f64.powi(r.leading_zeros as i32 - 62);
            let want = 1.0 / f64::from(value);
            assert!((got / want - 1.0).abs() < Reciprocal::MAX_RELATIVE_ERROR, "1/{value}");
        }
    }

    #[test]
    fn refinement_reaches_30_bits() {
        for k in 0..1_000_000u32 {
            let value = (1 << 31) + k * 2147 + (k & 1);
            let got = f64::from(Reciprocal::of(value).refined_mantissa(value)) * f64::from(value)
                / 2f64.powi(62);
            assert!(
                (got - 1.0).abs() < 2f64.powi(-29),
                "1/{value}: 2^{}",
                (got - 1.0).abs().log2()
            );
        }
    }
}
