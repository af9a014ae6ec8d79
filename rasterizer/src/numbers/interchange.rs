//! Numbers from code that computes in `f32`: sensor fusion, a filter, an animation.
//!
//! Such code uses `micromath` on a microcontroller. Its approximations (0.1 % and worse) do not get
//! into a rotation: a quaternion of any length becomes one whose rows are orthonormal to the last
//! bits.

use fixed::types::I2F30;
use micromath::{F32Ext, vector::F32x3};

use super::{Matrix, Quaternion, Rotation, Scalar, Turn, Vec3};

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

/// In 65,536ths, clamped to the range; `None` if it is not a number.
fn scalar(value: f32) -> Option<Scalar> {
    (!value.is_nan()).then(|| Scalar::saturating_from_num(value))
}

impl Vec3 {
    /// Rounds to 65,536ths and clamps to the range. Returns `None` if a coordinate is not a number.
    #[must_use]
    pub fn from_f32(v: F32x3) -> Option<Self> {
        Some(Self::new(scalar(v.x)?, scalar(v.y)?, scalar(v.z)?))
    }
}

impl Matrix {
    /// From its rows. Rounds to 65,536ths and clamps to the range. Returns `None` if an entry is
    /// not a number.
    #[must_use]
    pub fn from_f32(rows: [[f32; 3]; 3]) -> Option<Self> {
        let row = |[x, y, z]: [f32; 3]| Some([scalar(x)?, scalar(y)?, scalar(z)?]);
        let [x, y, z] = rows;
        Some(Self::from_rows([row(x)?, row(y)?, row(z)?]))
    }
}

impl Rotation {
    /// From the rows of its matrix, made orthonormal. Returns `None` unless they are orthonormal
    /// within 2<sup>-20</sup>, as a rotation rounded to `f32` is, and right-handed.
    #[must_use]
    pub fn from_f32(rows: [[f32; 3]; 3]) -> Option<Self> {
        // It saturates, and what is no number is 0: neither is orthonormal.
        let entry = |c: f32| I2F30::from_bits((c * 1_073_741_824.0) as i32);
        Self::from_rows(rows.map(|row| row.map(entry))).map(|rotation| rotation.orthonormalized())
    }

    /// The rotation of a quaternion of any length. Returns `None` if it is zero or not finite.
    #[must_use]
    pub fn from_quaternion(quaternion: micromath::Quaternion) -> Option<Self> {
        Quaternion::from_f32(quaternion).map(Self::from)
    }
}

impl Quaternion {
    /// From a quaternion of any length, exact to the 24 bits of an `f32`. Returns `None` if it is
    /// zero or not finite.
    #[must_use]
    pub fn from_f32(quaternion: micromath::Quaternion) -> Option<Self> {
        let parts = [quaternion.w(), quaternion.x(), quaternion.y(), quaternion.z()];
        let largest = parts.iter().fold(0.0f32, |a, b| a.max(b.abs()));
        if !(largest > 0.0 && largest.is_finite() && parts.iter().all(|c| c.is_finite())) {
            return None;
        }
        Self::new(parts.map(|c| I2F30::from_num(c / largest)))
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
            let r = Rotation::from_quaternion(micromath::Quaternion::new(half, 0.0, half, 0.0))
                .unwrap();
            let want = Rotation::about_y(Turn::QUARTER);
            for (got, want) in r.rows().iter().flatten().zip(want.rows().iter().flatten()) {
                // 2^-22: the inputs have 24 bits.
                assert!((*got - *want).abs() < I2F30::from_bits(1 << 8), "{got} {want}");
            }
        }
        assert_eq!(Rotation::from_quaternion(micromath::Quaternion::new(0.0, 0.0, 0.0, 0.0)), None);
        assert_eq!(
            Rotation::from_quaternion(micromath::Quaternion::new(f32::NAN, 0.0, 1.0, 0.0)),
            None
        );
        assert_eq!(
            Rotation::from_quaternion(micromath::Quaternion::new(f32::INFINITY, 0.0, 1.0, 0.0)),
            None
        );
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

    #[test]
    fn matrices_of_f32_are_rounded_and_rotations_refused_that_are_none() {
        let third = Scalar::from_bits(21_845);
        assert_eq!(Matrix::from_f32([[1.0 / 3.0; 3]; 3]), Some(Matrix::from_rows([[third; 3]; 3])));
        let most = Matrix::from_rows([[Scalar::MAX; 3]; 3]);
        assert_eq!(Matrix::from_f32([[f32::INFINITY; 3]; 3]), Some(most));
        assert_eq!(Matrix::from_f32([[0.0; 3], [0.0, f32::NAN, 0.0], [0.0; 3]]), None);
        for degrees in 0u32..360 {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let (sin, cos) = (sin as f32, cos as f32);
            let got = Rotation::from_f32([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]]);
            let (got, want) = (got.unwrap(), Rotation::about_y(Turn::degrees(degrees)));
            for (got, want) in got.rows().as_flattened().iter().zip(want.rows().as_flattened()) {
                // A sine is rounded to 2^-25, and the length of a row restored.
                assert!((*got - *want).to_num::<f64>().abs() < 2f64.powi(-23), "{degrees}");
            }
        }
        let mirror = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
        for rows in [mirror, [[2.0; 3]; 3], [[f32::NAN; 3]; 3]] {
            assert_eq!(Rotation::from_f32(rows), None);
        }
    }
}
