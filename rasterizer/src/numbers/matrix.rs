//! General 3 x 3 matrices.

use core::ops::Mul;

use super::{Rotation, Scalar, Vec3};

/// A linear map: a 3 x 3 matrix in Q16.16 that multiplies column vectors from the left.
///
/// It stretches along the axes, mirrors, shears, or does any of these one after the other. An
/// object takes it by [`Object::shaped`](crate::scene::Object::shaped).
///
/// ```
/// use rasterizer::numbers::{Matrix, Scalar, Vec3};
///
/// const FLAT: Matrix = Matrix::scaling(Scalar::ONE, Scalar::lit("0.25"), Scalar::ONE);
/// const MIRROR: Matrix = Matrix::scaling(Scalar::NEG_ONE, Scalar::ONE, Scalar::ONE);
/// assert_eq!((MIRROR * FLAT).apply(Vec3::lit("1", "2", "3")), Vec3::lit("-1", "0.5", "3"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Matrix {
    rows: [[Scalar; 3]; 3],
}

impl Default for Matrix {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Matrix {
    /// Leaves all vectors as they are.
    pub const IDENTITY: Self = Self::scaling(Scalar::ONE, Scalar::ONE, Scalar::ONE);

    /// From its rows. Its columns are where the vectors of length one along the axes go.
    #[must_use]
    pub const fn from_rows(rows: [[Scalar; 3]; 3]) -> Self {
        Self { rows }
    }

    /// Stretches along the axes. A negative factor mirrors, one of zero flattens.
    #[must_use]
    pub const fn scaling(x: Scalar, y: Scalar, z: Scalar) -> Self {
        const ZERO: Scalar = Scalar::ZERO;
        Self { rows: [[x, ZERO, ZERO], [ZERO, y, ZERO], [ZERO, ZERO, z]] }
    }

    /// The rows.
    #[must_use]
    pub const fn rows(&self) -> &[[Scalar; 3]; 3] {
        &self.rows
    }

    /// The entries in 65,536ths.
    pub(crate) const fn to_bits(self) -> [[i32; 3]; 3] {
        let (mut bits, mut entry) = ([[0; 3]; 3], 0);
        while entry < 9 {
            bits[entry / 3][entry % 3] = self.rows[entry / 3][entry % 3].to_bits();
            entry += 1;
        }
        bits
    }

    /// The vector that it makes of another. It is rounded, within a 2<sup>-16.9</sup>, and
    /// saturates at the ends of the range.
    #[must_use]
    pub fn apply(&self, v: Vec3) -> Vec3 {
        let v = v.to_bits();
        Vec3::from_bits(self.to_bits().map(|row| product(row, v)))
    }
}

/// The scalar product of vectors in Q16.16.
fn product(a: [i32; 3], b: [i32; 3]) -> i32 {
    // A quarter of each product, so that the sum of three fits.
    let sum: i64 = (0..3).map(|i| (i64::from(a[i]) * i64::from(b[i])) >> 2).sum();
    ((sum + (1 << 13)) >> 14).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// Rounded to 65,536ths.
impl From<Rotation> for Matrix {
    fn from(rotation: Rotation) -> Self {
        Self {
            rows: rotation.rows().map(|row| row.map(|c| Scalar::from_bits(rounded(c.to_bits())))),
        }
    }
}

/// From Q30 to Q16.
const fn rounded(c: i32) -> i32 {
    (c + (1 << 13)) >> 14
}

/// The product applies the right matrix first, then the left one. Its entries are rounded, within
/// 2<sup>-16.9</sup>, and saturate.
impl Mul for Matrix {
    type Output = Self;

    fn mul(self, first: Self) -> Self {
        let (a, b) = (self.to_bits(), first.to_bits());
        let column = |j: usize| b.map(|row| row[j]);
        let entry = |i: usize, j: usize| Scalar::from_bits(product(a[i], column(j)));
        Self { rows: core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j))) }
    }
}

/// The vector that it makes of another, like [`Matrix::apply`].
impl Mul<Vec3> for Matrix {
    type Output = Vec3;

    fn mul(self, v: Vec3) -> Vec3 {
        self.apply(v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{numbers::Turn, random::Random};

    fn f64s(matrix: &Matrix) -> [[f64; 3]; 3] {
        matrix.rows().map(|row| row.map(Scalar::to_num))
    }

    #[test]
    fn products_are_those_of_f64() {
        let mut random = Random::new(31);
        let mut saturated = 0;
        for round in 0..20_000 {
            let mut entry = || Scalar::from_bits((random.bits() as i32) << 1 >> (round % 30));
            let mut matrix = || Matrix::from_rows([(); 3].map(|()| [(); 3].map(|()| entry())));
            let (a, b) = (matrix(), matrix());
            let (got, [p, q]) = (f64s(&(a * b)), [a, b].map(|m| f64s(&m)));
            let v = Vec3::from_bits([entry(), entry(), entry()].map(Scalar::to_bits));
            let vector = [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
            let applied = a * v;
            let applied = [applied.x, applied.y, applied.z].map(|c| c.to_num::<f64>());
            let check = |got: f64, want: f64| {
                let want = want.clamp(-32_768.0, 32_768.0 - 2f64.powi(-16));
                assert!((got - want).abs() < 2f64.powf(-16.9), "{got} {want}");
                usize::from(want.abs() > 32_767.9)
            };
            for i in 0..3 {
                for j in 0..3 {
                    saturated += check(got[i][j], (0..3).map(|k| p[i][k] * q[k][j]).sum());
                }
                saturated += check(applied[i], (0..3).map(|k| p[i][k] * vector[k]).sum());
            }
        }
        assert!((1000..100_000).contains(&saturated), "{saturated}");
    }

    #[test]
    fn matrices_of_rotations_turn_as_they_do() {
        let rotation = Rotation::about_y(Turn::degrees(50)) * Rotation::about_x(Turn::degrees(20));
        let v = Vec3::lit("3", "-4", "5");
        let (got, want) = (Matrix::from(rotation) * v, rotation * v);
        for (got, want) in got.to_bits().into_iter().zip(want.to_bits()) {
            // Three entries, each half a step off, times a coordinate.
            assert!((got - want).abs() <= 7, "{got} {want}");
        }
    }
}
