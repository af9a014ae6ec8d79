//! Angles in turns, sine and cosine.

use core::ops::{Add, Neg, Sub};

use fixed::types::I2F30;

use super::{Float, Scalar, mul_q30, unit};

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

    /// The angle from the positive x axis to the point (x, y), counter-clockwise, within
    /// 2<sup>-27</sup> radians; zero for (0, 0).
    #[must_use]
    pub fn atan2(y: Scalar, x: Scalar) -> Self {
        angle([x, y].map(|c| i64::from(c.to_bits())))
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

/// The angle from the positive x axis to (x, y), counter-clockwise, for coordinates below
/// 2<sup>62</sup>: within 2<sup>-27</sup> radians, or zero for (0, 0).
///
/// The direction is within 2<sup>-28</sup> along each axis. The sum of the first terms of the
/// arcsine is 0.006 radians off at most; each step of Newton leaves a sixth of the third power of
/// that.
pub(crate) fn angle(v: [i64; 2]) -> Turn {
    let Some([x, y]) = unit(v) else { return Turn::ZERO };
    // From the nearest axis, by the smaller coordinate: a quarter turn is three of four quadrants.
    let quadrant: u32 = match (x.unsigned_abs() >= y.unsigned_abs(), x < 0, y < 0) {
        (true, false, _) => 0,
        (false, _, false) => 1,
        (true, true, _) => 2,
        (false, _, true) => 3,
    };
    let sine = [y, -x, -y, x][quadrant as usize];
    let square = mul_q30(sine, sine);
    // asin s = s + s^3 / 6 + 3 s^5 / 40, in radians.
    let series = (1 << 30) + mul_q30(square, (1 << 30) / 6 + mul_q30(square, 3 * ((1 << 30) / 40)));
    let mut angle = (quadrant << 30).wrapping_add(turns(mul_q30(sine, series)));
    for _ in 0..2 {
        let (sin, cos) = (self::sine(angle), self::sine(angle.wrapping_add(1 << 30)));
        angle = angle.wrapping_add(turns(mul_q30(y, cos) - mul_q30(x, sin)));
    }
    Turn(angle)
}

/// From radians in Q30 to steps of 2<sup>-32</sup> turn.
const fn turns(radians: i32) -> u32 {
    // 2 / pi in Q30.
    mul_q30(radians, 683_565_276).cast_unsigned()
}

/// The cotangent of half an angle over 0 and under half a turn, within 2<sup>-27</sup> of its
/// value, which the sine and the cosine of a small angle, rounded to Q30, do not have.
pub(crate) const fn cotangent_of_half(angle: Turn) -> Float {
    // In quarter turns, in Q31: both legs are as exact relative to their own size.
    let (opposite, adjacent) = (angle.0, (1 << 31) - angle.0);
    leg(adjacent).times(leg(opposite).reciprocal())
}

/// The sine of x quarter turns in Q31.
const fn leg(x: u32) -> Float {
    Float::new(x as i64, -31).times(Float::new(sine_over((x >> 1) as i32) as i64, -30))
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
    let sine = mul_q30(sine_over(x), x);
    if sine > 1 << 30 {
        1 << 30
    } else if sine < -(1 << 30) {
        -(1 << 30)
    } else {
        sine
    }
}

/// sin(x pi/2) / x for x from -1 to 1, in Q30.
const fn sine_over(x: i32) -> i32 {
    let square = mul_q30(x, x);
    let mut sum = SINE[5];
    let mut term = 5;
    while term > 0 {
        term -= 1;
        sum = mul_q30(sum, square) + SINE[term];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cotangents_are_as_exact_for_the_smallest_angles() {
        let near_ends = (0..31).flat_map(|bit| [1u32 << bit, (1 << 31) - (1 << bit)]);
        for bits in near_ends.chain((1..1 << 31).step_by(104_729)) {
            let half = f64::from(bits) / 2f64.powi(33) * core::f64::consts::TAU;
            // Near a quarter turn from the other side, where the tangent is exact in f64.
            let other = f64::from((1u32 << 31) - bits) / 2f64.powi(33) * core::f64::consts::TAU;
            let want = if bits < 1 << 30 { 1.0 / half.tan() } else { other.tan() };
            let got = cotangent_of_half(Turn(bits));
            let got = f64::from(got.mantissa) * 2f64.powi(got.exponent);
            assert!((got / want - 1.0).abs() < 2f64.powi(-27), "{bits}: {got} {want}");
        }
    }

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
    fn angles_of_points_are_within_their_bound() {
        let mut worst = 0f64;
        for bits in (0..=u32::MAX).step_by(40_009) {
            let radians = f64::from(bits) / 2f64.powi(32) * core::f64::consts::TAU;
            let length = 2f64.powi((bits % 45) as i32 + 16);
            let v = [(radians.cos() * length) as i64, (radians.sin() * length) as i64];
            let want = (v[1] as f64).atan2(v[0] as f64) / core::f64::consts::TAU;
            let got = f64::from(angle(v).0.cast_signed()) / 2f64.powi(32);
            let apart = (got - want - (got - want).round()) * core::f64::consts::TAU;
            worst = worst.max(apart.abs());
            assert!(apart.abs() < 2f64.powi(-27), "{v:?}: {got} {want}");
        }
        assert!(worst > 2f64.powi(-31), "{worst}");
        assert_eq!(Turn::atan2(Scalar::ZERO, Scalar::ZERO), Turn::ZERO);
        for (y, x, quarters) in [(0, 1, 0), (1, 0, 1), (0, -1, 2), (-1, 0, 3)] {
            let got = Turn::atan2(Scalar::from_num(y), Scalar::from_num(x));
            let off = (got - Turn::fraction(quarters, 4)).0.cast_signed();
            assert!(off.abs() <= 4, "{y} {x}: {got:?}");
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
