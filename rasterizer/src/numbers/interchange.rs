//! Numbers from code that computes in `f32`: sensor fusion, a filter, an animation.
//!
//! Such code uses `micromath` on a microcontroller. Its approximations (0.1 % and worse) do not get
//! into a rotation: a quaternion of any length becomes one whose rows are orthonormal to the last
//! bits.

use fixed::types::I2F30;
use micromath::{F32Ext, Quaternion, vector::F32x3};

use super::{Rotation, Scalar, Turn, Vec3, root::inverse_square_root};

impl Turn {
    /// From radians, exact to the 24 bits of an `f32`. Infinities and NaN become [`Turn::ZERO`].
    #[must_use]
    pub fn from_radians(radians: f32) -> Self {
        let turns = radians * core::f32::consts::FRAC_1_PI * 0.5;
        // From 2^23 turns on an f32 has no fraction.
        if F32Ext::abs(turns) < 8_388_608.0 {
            let fraction = turns - F32Ext::floor(turns);
            Self::from_bits((fraction * 4_294_967_296.0) as u64 as u32)
        } else {
            Self::ZERO
        }
    }
}

impl Vec3 {
    /// Rounds to 65,536ths and clamps to the range. Returns `None` if a coordinate is not a number.
    #[must_use]
    pub fn from_f32(v: F32x3) -> Option<Self> {
        let scalar = |c: f32| (!c.is_nan()).then(|| Scalar::saturating_from_num(c));
        Some(Self::new(scalar(v.x)?, scalar(v.y)?, scalar(v.z)?))
    }
}

impl Rotation {
    /// The rotation of a quaternion of any length. Returns `None` if it is zero or not finite.
    #[must_use]
    pub fn from_quaternion(quaternion: Quaternion) -> Option<Self> {
        let parts = [quaternion.w(), quaternion.x(), quaternion.y(), quaternion.z()];
        let largest = parts.iter().fold(0.0f32, |a, b| a.max(b.abs()));
        if !(largest > 0.0 && largest.is_finite() && parts.iter().all(|c| c.is_finite())) {
            return None;
        }
        // Components in Q30 of the largest; their length lies between 1 and 2.
        let q = parts.map(|c| i64::from(I2F30::from_num(c / largest).to_bits()));
        let (mantissa, exponent) =
            inverse_square_root(q.iter().map(|c| (c * c) as u64 >> 2).sum::<u64>());
        // c / (2 sqrt(sum / 4)) in Q30
        let down = -(exponent + 29);
        let [w, x, y, z] = q.map(|c| (c * i64::from(mantissa) + (1 << (down - 1))) >> down);
        let twice = |a: i64, b: i64| (a * b) >> 29;
        let rows = [
            [
                (1 << 30) - twice(y, y) - twice(z, z),
                twice(x, y) - twice(w, z),
                twice(x, z) + twice(w, y),
            ],
            [
                twice(x, y) + twice(w, z),
                (1 << 30) - twice(x, x) - twice(z, z),
                twice(y, z) - twice(w, x),
            ],
            [
                twice(x, z) - twice(w, y),
                twice(y, z) + twice(w, x),
                (1 << 30) - twice(x, x) - twice(y, y),
            ],
        ];
        Some(Self::from_row_bits(rows.map(|row| row.map(|c| c as i32))).orthonormalized())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radians_become_turns() {
        let near = |a: Turn, b: Turn| (a - b).to_bits().cast_signed().abs() < 1 << 10;
        assert!(near(Turn::from_radians(core::f32::consts::FRAC_PI_2), Turn::QUARTER));
        assert!(near(Turn::from_radians(-core::f32::consts::FRAC_PI_2), -Turn::QUARTER));
        assert!(near(Turn::from_radians(core::f32::consts::TAU), Turn::ZERO));
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
            assert_eq!(Turn::from_radians(bad), Turn::ZERO);
        }
    }

    /// The length of a quaternion does not matter: lengths of 1, 1e-20 and 1e20 give the rotation
    /// about y by 90 degrees.
    #[test]
    fn quaternions_of_any_length_become_orthonormal() {
        for length in [1.0f32, 1e-20, 1e20] {
            let half = core::f32::consts::FRAC_1_SQRT_2 * length;
            let r = Rotation::from_quaternion(Quaternion::new(half, 0.0, half, 0.0)).unwrap();
            let want = Rotation::about_y(Turn::QUARTER);
            for (got, want) in r.rows().iter().flatten().zip(want.rows().iter().flatten()) {
                // 2^-22: the inputs have 24 bits.
                assert!((*got - *want).abs() < I2F30::from_bits(1 << 8), "{got} {want}");
            }
        }
        assert_eq!(Rotation::from_quaternion(Quaternion::new(0.0, 0.0, 0.0, 0.0)), None);
        assert_eq!(Rotation::from_quaternion(Quaternion::new(f32::NAN, 0.0, 1.0, 0.0)), None);
        assert_eq!(Rotation::from_quaternion(Quaternion::new(f32::INFINITY, 0.0, 1.0, 0.0)), None);
    }

    #[test]
    fn vectors_saturate() {
        let v = |x, y, z| Vec3::from_f32(F32x3 { x, y, z });
        assert_eq!(
            v(1.5, -0.25, 1e9),
            Some(Vec3::new(Scalar::lit("1.5"), Scalar::lit("-0.25"), Scalar::MAX))
        );
        assert_eq!(v(f32::NAN, 0.0, 0.0), None);
    }
}
