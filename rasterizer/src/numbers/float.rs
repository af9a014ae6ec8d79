//! Numbers of any magnitude with 31 bits of precision, for what is computed once per frame:
//! matrices and planes.
//!
//! No loop over vertices or pixels uses them, so their functions are called rather than inlined,
//! which saves 2 KB of flash. With them a scene may measure a thousandth of a unit or ten thousand
//! units, and the vertex loop still gets integers that use all their bits.

use fixed::types::U16F16;

use super::{divide, reciprocal::Reciprocal};

/// `mantissa * 2^exponent`, the mantissa's magnitude from 2<sup>30</sup> to 2<sup>31</sup> - 1, or
/// [`ZERO`](Self::ZERO).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Float {
    pub(crate) mantissa: i32,
    pub(crate) exponent: i32,
}

impl Float {
    /// Its exponent is less than any other's, so that it does not determine the unit of a sum.
    pub(crate) const ZERO: Self = Self { mantissa: 0, exponent: -100_000 };

    /// `value * 2^exponent`, rounded to 31 bits.
    #[inline(never)]
    pub(crate) const fn new(value: i64, exponent: i32) -> Self {
        if value == 0 {
            return Self::ZERO;
        }
        // A loop moves the top bit to the top: routines that count zeros and shift are more code.
        let mut magnitude = value.unsigned_abs();
        let mut exponent = exponent + 33;
        if magnitude >> 32 == 0 {
            magnitude <<= 32;
            exponent -= 32;
        }
        while magnitude >> 63 == 0 {
            magnitude <<= 1;
            exponent -= 1;
        }
        let upper = (magnitude >> 32) as u32;
        // All ones would be rounded up to 2^31.
        let rounded = (upper >> 1) + (upper & 1);
        let mantissa = if rounded >> 31 == 0 { rounded as i32 } else { i32::MAX };
        Self { mantissa: if value < 0 { -mantissa } else { mantissa }, exponent }
    }

    pub(crate) const fn from_unsigned(value: U16F16) -> Self {
        Self::new(value.to_bits() as i64, -16)
    }

    #[inline(never)]
    pub(crate) const fn times(self, other: Self) -> Self {
        Self::new(self.mantissa as i64 * other.mantissa as i64, self.exponent + other.exponent)
    }

    /// The sum, within 1.5 x 2<sup>-30</sup> of the larger magnitude: half a unit of it for the
    /// bits of the other that are below, and one where the sum has a bit more.
    pub(crate) fn plus(self, other: Self) -> Self {
        let unit = self.exponent.max(other.exponent);
        let sum = i64::from(self.in_units_of(unit)) + i64::from(other.in_units_of(unit));
        Self::new(sum, unit)
    }

    pub(crate) const fn negative(self) -> Self {
        Self { mantissa: -self.mantissa, ..self }
    }

    /// Whether it is less than another, as exactly as [`plus`](Self::plus) is.
    pub(crate) fn is_below(self, other: Self) -> bool {
        self.plus(other.negative()).mantissa < 0
    }

    /// The reciprocal of a positive number, within 2<sup>-29</sup>.
    #[inline(never)]
    pub(crate) const fn reciprocal(self) -> Self {
        let value = self.mantissa.unsigned_abs();
        let reciprocal = Reciprocal::of(value);
        Self::new(
            reciprocal.refined_mantissa(value) as i64,
            reciprocal.leading_zeros as i32 - 62 - self.exponent,
        )
    }

    /// The quotient with a positive number, within 2<sup>-14</sup>.
    // codegen: by a division of 32 bits, which triangles need too.
    pub(crate) const fn over(self, divisor: Self) -> Self {
        // A mantissa over the upper half of another: from 2^15 to 2^17.
        let quotient = divide(self.mantissa.unsigned_abs(), divisor.mantissa.unsigned_abs() >> 16);
        let quotient = if self.mantissa < 0 { -(quotient as i64) } else { quotient as i64 };
        Self::new(quotient, self.exponent - divisor.exponent - 16)
    }

    /// The least n for which the number's magnitude is below 2<sup>n</sup>; very small for 0.
    pub(crate) const fn magnitude(self) -> i32 {
        self.exponent + 31
    }

    /// In units of 2<sup>`exponent`</sup>, rounded, saturating at the ends of `i32`.
    #[inline(never)]
    pub(crate) const fn in_units_of(self, exponent: i32) -> i32 {
        let shift = self.exponent - exponent;
        if self.mantissa == 0 || shift < -31 {
            0
        } else if shift < 0 {
            let twice = self.mantissa >> (-shift - 1);
            (twice >> 1) + (twice & 1)
        } else if shift == 0 {
            self.mantissa
        } else if self.mantissa > 0 {
            i32::MAX
        } else {
            i32::MIN
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn f64_of(x: Float) -> f64 {
        f64::from(x.mantissa) * 2f64.powi(x.exponent)
    }

    #[test]
    fn keeps_31_bits() {
        for value in [
            1i64,
            -1,
            3,
            i64::MAX,
            i64::MIN + 1,
            0x7FFF_FFFF,
            0x7FFF_FFFF_8000_0000,
            -0x1_0000_0000,
        ] {
            let x = Float::new(value, -7);
            assert!(
                (30..=31).contains(&(32 - x.mantissa.unsigned_abs().leading_zeros())),
                "{value}"
            );
            let relative = f64_of(x) / (value as f64 / 128.0) - 1.0;
            assert!(relative.abs() <= 2f64.powi(-31), "{value}: {relative}");
        }
    }

    #[test]
    fn products_and_reciprocals() {
        let three = Float::new(3, 0);
        let tenth = Float::new(10, 0).reciprocal();
        assert!((f64_of(three.times(tenth)) - 0.3).abs() < 2f64.powi(-30));
        assert!(
            (f64_of(Float::new(7, 300).reciprocal()) * 7.0 * 2f64.powi(300) - 1.0).abs()
                < 2f64.powi(-29)
        );
    }

    #[test]
    fn sums_keep_what_the_larger_number_does() {
        let numbers = [0, 1, -1, 0x1234_5679, -0x7FFF_FFFF, 0x4000_0001, 0x1_0000_0001]
            .map(|value| [-40, -3, 0, 29].map(|e| Float::new(value, e)));
        for a in numbers.as_flattened() {
            for b in numbers.as_flattened() {
                let (x, y) = (f64_of(*a), f64_of(*b));
                let error = f64_of(a.plus(*b)) - (x + y);
                assert!(
                    error.abs() <= x.abs().max(y.abs()) * 1.5 * 2f64.powi(-30),
                    "{a:?} {b:?}: {error}"
                );
            }
        }
    }

    #[test]
    fn units_round_and_saturate() {
        let x = Float::new(-5, -1);
        assert_eq!(x.in_units_of(-1), -5);
        assert_eq!(x.in_units_of(0), -2);
        assert_eq!(x.in_units_of(3), 0);
        assert_eq!(x.in_units_of(-40), i32::MIN);
        assert_eq!(Float::new(1, 0).in_units_of(-40), i32::MAX);
        assert_eq!(Float::ZERO.in_units_of(-40), 0);
        assert_eq!(Float::ZERO.in_units_of(-200_000), 0);
        assert_eq!(Float::new(1, -100).in_units_of(0), 0);
        assert_eq!(x.magnitude(), 2);
    }
}
