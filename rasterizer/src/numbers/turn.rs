//! Angles in turns, sine and cosine.

use core::ops::{Add, Neg, Sub};

use fixed::types::I2F30;

use super::mul_q30;

/// An angle in turns: Q0.32, so that it wraps round. 2<sup>32</sup> steps make a whole turn.
///
/// ```
/// use rasterizer::numbers::Turn;
///
/// assert_eq!(Turn::degrees(90), Turn::QUARTER);
/// assert_eq!(Turn::fraction(3, 4) + Turn::QUARTER, Turn::ZERO);
/// ```
///
/// The name `Angle` is left to `embedded_graphics::geometry::Angle`, which holds an `f32`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Turn(u32);

impl Turn {
    /// No turn.
    pub const ZERO: Self = Self(0);
    /// A quarter of a turn, 90 degrees.
    pub const QUARTER: Self = Self(1 << 30);

    /// `numerator / denominator` of a turn, rounded down.
    ///
    /// # Panics
    ///
    /// Panics if the denominator is 0.
    #[must_use]
    pub const fn fraction(numerator: u32, denominator: u32) -> Self {
        Self((((numerator as u64) << 32) / denominator as u64) as u32)
    }

    /// Whole degrees.
    #[must_use]
    pub const fn degrees(degrees: u32) -> Self {
        Self::fraction(degrees % 360, 360)
    }

    /// From steps of 2<sup>-32</sup> turn.
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// In steps of 2<sup>-32</sup> turn.
    #[must_use]
    pub const fn to_bits(self) -> u32 {
        self.0
    }

    /// Half the angle.
    #[must_use]
    pub const fn half(self) -> Self {
        Self(self.0 / 2)
    }

    /// The sine in Q30, within 2<sup>-28</sup>.
    #[must_use]
    pub const fn sin(self) -> I2F30 {
        I2F30::from_bits(sine(self.0))
    }

    /// The cosine in Q30, within 2<sup>-28</sup>.
    #[must_use]
    pub const fn cos(self) -> I2F30 {
        I2F30::from_bits(sine(self.0.wrapping_add(1 << 30)))
    }
}

impl Add for Turn {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl Sub for Turn {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl Neg for Turn {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

/// sin(x pi/2) = x P(x^2) on [-1, 1] in Q30: the polynomial that meets the sine in the Chebyshev
/// nodes of degree 12, within 2.7e-11 (2^-35) of it before rounding.
const SINE: [i32; 6] = [1_686_629_713, -693_598_666, 85_569_282, -5_026_892, 172_072, -3_685];

/// The sine of `turns` / 2^32 of a turn, in Q30.
#[inline(never)]
const fn sine(turns: u32) -> i32 {
    // Half turns in Q31 are quarter turns in Q30. They are folded at the quarters, where the sine
    // is symmetric.
    let half_turns = turns as i32;
    let x = if half_turns > 1 << 30 || half_turns < -(1 << 30) {
        (1u32 << 31).wrapping_sub(turns) as i32
    } else {
        half_turns
    };
    let square = mul_q30(x, x);
    let mut sum = SINE[5];
    let mut term = 5;
    while term > 0 {
        term -= 1;
        sum = mul_q30(sum, square) + SINE[term];
    }
    let sine = mul_q30(sum, x);
    if sine > 1 << 30 {
        1 << 30
    } else if sine < -(1 << 30) {
        -(1 << 30)
    } else {
        sine
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of 4,099 visit a million angles and every remainder of folding and rounding.
    #[test]
    fn sine_and_cosine_are_within_their_bound() {
        for bits in (0..=u32::MAX).step_by(4099) {
            let angle = Turn(bits);
            let radians = f64::from(bits) / 2f64.powi(32) * core::f64::consts::TAU;
            assert!(
                (angle.sin().to_num::<f64>() - radians.sin()).abs() < 2f64.powi(-28),
                "sin {bits}"
            );
            assert!(
                (angle.cos().to_num::<f64>() - radians.cos()).abs() < 2f64.powi(-28),
                "cos {bits}"
            );
        }
    }

    #[test]
    fn quarters_are_exact() {
        let [zero, one] = [I2F30::ZERO, I2F30::ONE];
        let quarters = [(0, zero, one), (1, one, zero), (2, zero, -one), (3, -one, zero)];
        for (quarter, sin, cos) in quarters {
            let angle = Turn::fraction(quarter, 4);
            assert_eq!((angle.sin(), angle.cos()), (sin, cos), "{quarter} quarters");
        }
    }

    #[test]
    fn wraps() {
        assert_eq!(Turn::fraction(7, 8) + Turn::QUARTER, Turn::fraction(1, 8));
        assert_eq!(Turn::fraction(1, 8) - Turn::QUARTER, Turn::fraction(7, 8));
        assert_eq!(-Turn::QUARTER, Turn::fraction(3, 4));
    }
}
