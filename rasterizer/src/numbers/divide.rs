//! Exact division of 64-bit numbers, without a 64-bit division routine.
//!
//! Clipping, slivers and 32-bit depth use it. It is called rather than inlined, because its 64-bit
//! arithmetic would be in several places of every scene.

use super::{instructions::IS_NARROW, reciprocal::Reciprocal};

/// A positive divisor.
///
/// Cores with a long multiply divide by the reciprocal: each step estimates a digit of 26 bits from
/// the reciprocal of the divisor's upper 32 bits and keeps the exact remainder, as in long
/// division. Other cores divide bit by bit, which takes two or three times as long and 430 bytes
/// less.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Divisor {
    value: u64,
    /// 0 on cores that do not read it, like the mantissa.
    leading_zeros: u32,
    /// Not above 2^62 / (the upper 32 bits of the normalised value).
    mantissa: u32,
}

impl Divisor {
    /// A divisor; 0 counts as 1.
    #[inline(always)]
    pub(crate) const fn new(value: u64) -> Self {
        if IS_NARROW {
            Self { value: if value == 0 { 1 } else { value }, leading_zeros: 0, mantissa: 0 }
        } else {
            Self::with_reciprocal(value)
        }
    }

    #[inline(never)]
    const fn with_reciprocal(value: u64) -> Self {
        let value = if value == 0 { 1 } else { value };
        let leading_zeros = value.leading_zeros();
        let upper = ((value << leading_zeros) >> 32) as u32;
        let mantissa = Reciprocal::of(upper).mantissa as u32;
        Self {
            value,
            leading_zeros,
            // Lowered by its own error of 2^-27 and by 2^-31 for the bits below `upper`.
            mantissa: mantissa - (mantissa >> 26),
        }
    }

    /// ⌊`dividend` / divisor⌋ and the remainder, for a dividend below 2<sup>62</sup> in magnitude.
    #[inline(never)]
    pub(crate) const fn divide(&self, dividend: i64) -> (i64, i64) {
        let (quotient, rest) = if IS_NARROW {
            self.by_bits(dividend.unsigned_abs())
        } else {
            self.by_digits(dividend.unsigned_abs())
        };
        let (quotient, rest) = (quotient as i64, rest as i64);
        if dividend >= 0 {
            (quotient, rest)
        } else if rest == 0 {
            (-quotient, 0)
        } else {
            (-quotient - 1, self.value as i64 - rest)
        }
    }

    #[inline(always)]
    const fn by_digits(&self, dividend: u64) -> (u64, u64) {
        let (mut rest, mut quotient) = (dividend, 0);
        while rest >= self.value {
            let zeros = rest.leading_zeros();
            let upper = (rest << zeros) >> 32;
            // rest / value = upper 2^(32 - zeros) / (value's upper 2^(32 - leading_zeros)), and
            // zeros <= leading_zeros.
            let digit = (upper * self.mantissa as u64) >> (62 + zeros - self.leading_zeros);
            let digit = if digit == 0 { 1 } else { digit };
            quotient += digit;
            rest -= digit * self.value;
        }
        (quotient, rest)
    }

    #[inline(always)]
    const fn by_bits(&self, dividend: u64) -> (u64, u64) {
        let (mut divisor, mut bit) = (self.value, 1);
        while divisor <= dividend >> 1 {
            divisor <<= 1;
            bit <<= 1;
        }
        let (mut rest, mut quotient) = (dividend, 0);
        while bit != 0 {
            let (less, is_below) = rest.overflowing_sub(divisor);
            if !is_below {
                (rest, quotient) = (less, quotient | bit);
            }
            divisor >>= 1;
            bit >>= 1;
        }
        (quotient, rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn equals_division() {
        let mut random = Random::new(88_172_645);
        let check = |n: i64, d: u64| {
            let want = (n.div_euclid(d as i64), n.rem_euclid(d as i64));
            assert_eq!(Divisor::new(d).divide(n), want, "{n} / {d}");
            // With the reciprocal that a narrow core's divisor lacks.
            let (n, d) = (n.unsigned_abs(), Divisor::with_reciprocal(d));
            assert_eq!(d.by_bits(n), d.by_digits(n), "{n} / {d:?}");
        };
        let limit = (1i64 << 62) - 1;
        for d in [1, 2, 3, 0xFFFF_FFFF, 1 << 32, (1 << 32) + 1, (1 << 62) - 1, 1 << 62] {
            for n in [0, 1, -1, 2, -2, limit, -limit, 1 << 61, d as i64 / 2] {
                check(n, d);
            }
        }
        for _ in 0..1_000_000 {
            let (a, b, s) = (random.bits(), random.bits(), random.bits());
            let n = (a >> 2 >> (s % 62)) as i64;
            let d = (b >> 2 >> (s / 62 % 62)).max(1);
            check(n, d);
            check(-n, d);
        }
    }
}
