//! Exact division of 64-bit numbers by one divisor, again and again, without a 64-bit division routine.
//!
//! Both steps are called rather than inlined, with 64-bit arithmetic at several places of every scene: they are for
//! clipping, slivers and 32-bit depth.

use super::reciprocal::Reciprocal;

/// A positive divisor with its reciprocal.
///
/// Each step takes off what the reciprocal of the divisor's upper 32 bits says and keeps the exact remainder, as in long
/// division with digits of 26 bits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Divisor {
    value: u64,
    leading_zeros: u32,
    /// Not above 2^62 / (the upper 32 bits of the normalised value).
    mantissa: u32,
}

impl Divisor {
    /// A divisor; 0 is taken as 1.
    #[inline(never)]
    pub(crate) const fn new(value: u64) -> Self {
        let value = if value == 0 { 1 } else { value };
        let leading_zeros = value.leading_zeros();
        let upper = ((value << leading_zeros) >> 32) as u32;
        let mantissa = Reciprocal::of(upper).mantissa as u32;
        Self {
            value,
            leading_zeros,
            // Less its own error of 2^-27 and the 2^-31 of the bits cut off below `upper`.
            mantissa: mantissa - (mantissa >> 26),
        }
    }

    /// ⌊`dividend` / divisor⌋ and the remainder, for a dividend below 2<sup>62</sup> in magnitude.
    #[inline(never)]
    pub(crate) const fn divide(self, dividend: i64) -> (i64, i64) {
        let mut rest = dividend.unsigned_abs();
        let mut quotient = 0;
        while rest >= self.value {
            let zeros = rest.leading_zeros();
            let upper = (rest << zeros) >> 32;
            // rest / value = upper 2^(32 - zeros) / (value's upper 2^(32 - leading_zeros)), and zeros <= leading_zeros.
            let digit = (upper * self.mantissa as u64) >> (62 + zeros - self.leading_zeros);
            let digit = if digit == 0 { 1 } else { digit };
            quotient += digit;
            rest -= digit * self.value;
        }
        let (quotient, rest) = (quotient as i64, rest as i64);
        if dividend >= 0 {
            (quotient, rest)
        } else if rest == 0 {
            (-quotient, 0)
        } else {
            (-quotient - 1, self.value as i64 - rest)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_division() {
        let mut random: u64 = 88_172_645_463_325_252;
        let mut next = || {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            random
        };
        let check = |n: i64, d: u64| {
            let want = (n.div_euclid(d as i64), n.rem_euclid(d as i64));
            assert_eq!(Divisor::new(d).divide(n), want, "{n} / {d}");
        };
        let limit = (1i64 << 62) - 1;
        for d in [1, 2, 3, 0xFFFF_FFFF, 1 << 32, (1 << 32) + 1, (1 << 62) - 1, 1 << 62] {
            for n in [0, 1, -1, 2, -2, limit, -limit, 1 << 61, d as i64 / 2] {
                check(n, d);
            }
        }
        for _ in 0..1_000_000 {
            let (a, b, s) = (next(), next(), next());
            let n = (a >> 2 >> (s % 62)) as i64;
            let d = (b >> 2 >> (s / 62 % 62)).max(1);
            check(n, d);
            check(-n, d);
        }
    }
}
