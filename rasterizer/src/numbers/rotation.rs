//! Rotations as orthonormal matrices.

use core::ops::Mul;

use fixed::types::I2F30;

use super::{Scalar, Turn, Vec3, codegen, root::unit};

/// A rotation: a matrix in Q30 that multiplies column vectors from the left.
///
/// Its rows are orthonormal within 2<sup>-26</sup>; those of [`from_rows`](Self::from_rows) within
/// 2<sup>-20</sup>. A product of two rotations is off by what both are, together, and by up to
/// 2<sup>-29</sup> more: by n 2<sup>-26</sup> and n 2<sup>-29</sup> after n factors.
/// [`compose`](Self::compose) keeps 2<sup>-26</sup>, however often an angle is added to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rotation {
    rows: [[I2F30; 3]; 3],
}

const ZERO: I2F30 = I2F30::ZERO;
const ONE: I2F30 = I2F30::ONE;

impl Default for Rotation {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Rotation {
    /// No rotation.
    pub const IDENTITY: Self =
        Self { rows: [[ONE, ZERO, ZERO], [ZERO, ONE, ZERO], [ZERO, ZERO, ONE]] };

    /// From the rows of its matrix. Returns `None` unless they are orthonormal within
    /// 2<sup>-20</sup> and right-handed: a mirror is not a rotation.
    #[must_use]
    pub const fn from_rows(rows: [[I2F30; 3]; 3]) -> Option<Self> {
        let mut i = 0;
        while i < 3 {
            let mut j = 0;
            while j <= i {
                let wanted = if i == j { 1 << 60 } else { 0 };
                // Three products below 2^62: a sum that does not fit is none of 1.
                let Some(sum) = dot(&rows[i], &rows[j]) else {
                    return None;
                };
                if (sum - wanted).unsigned_abs() > 1 << 40 {
                    return None;
                }
                j += 1;
            }
            i += 1;
        }
        // The third row is plus or minus the cross product of the others, and so is the largest of
        // its coordinates, which is over a half.
        let [x, y, z] = &rows;
        let mut axis = 0;
        while axis < 3 {
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            let cross = x[j].to_bits() as i64 * y[k].to_bits() as i64
                - x[k].to_bits() as i64 * y[j].to_bits() as i64;
            let third = z[axis].to_bits();
            if third.unsigned_abs() > 1 << 29 && (cross < 0) != (third < 0) {
                return None;
            }
            axis += 1;
        }
        Some(Self { rows })
    }

    /// The rows of its matrix.
    #[must_use]
    pub const fn rows(&self) -> &[[I2F30; 3]; 3] {
        &self.rows
    }

    /// The rows in steps of 2<sup>-30</sup>.
    pub(crate) fn to_bits(self) -> [[i32; 3]; 3] {
        self.rows.map(|row| row.map(I2F30::to_bits))
    }

    /// About the x axis: a positive angle takes y towards z.
    #[must_use]
    pub fn about_x(angle: Turn) -> Self {
        let (sin, cos) = (angle.sin(), angle.cos());
        Self { rows: [[ONE, ZERO, ZERO], [ZERO, cos, -sin], [ZERO, sin, cos]] }
    }

    /// About the y axis: a positive angle takes z towards x.
    #[must_use]
    pub fn about_y(angle: Turn) -> Self {
        let (sin, cos) = (angle.sin(), angle.cos());
        Self { rows: [[cos, ZERO, sin], [ZERO, ONE, ZERO], [-sin, ZERO, cos]] }
    }

    /// About the z axis: a positive angle takes x towards y.
    #[must_use]
    pub fn about_z(angle: Turn) -> Self {
        let (sin, cos) = (angle.sin(), angle.cos());
        Self { rows: [[cos, -sin, ZERO], [sin, cos, ZERO], [ZERO, ZERO, ONE]] }
    }

    /// The inverse rotation, which is the transpose.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self { rows: core::array::from_fn(|i| core::array::from_fn(|j| self.rows[j][i])) }
    }

    /// Rotates a vector. The result is rounded and saturates at the ends of the range.
    #[must_use]
    pub fn apply(&self, v: Vec3) -> Vec3 {
        Vec3::from_bits(self.to_bits().map(|row| {
            let sum = (v.along(&row) + (1 << 29)) >> 30;
            sum.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
        }))
    }

    /// A direction in Q30 turned by the inverse rotation, rounded.
    #[inline(never)]
    pub(crate) fn turn_back(&self, v: &[i32; 3]) -> [i32; 3] {
        let mut turned = [0; 3];
        for (column, turned) in turned.iter_mut().enumerate() {
            codegen::keep_rolled();
            *turned = ((self.along_column(column, v) + (1 << 29)) >> 30) as i32;
        }
        turned
    }

    /// A direction in Q30 turned by the inverse rotation, in Q60: the product of a row vector and
    /// this matrix.
    #[inline(always)]
    pub(crate) fn turn_back_exactly(&self, v: &[i32; 3]) -> [i64; 3] {
        [self.along_column(0, v), self.along_column(1, v), self.along_column(2, v)]
    }

    /// The scalar product of a column with a vector in Q30.
    #[inline(always)]
    fn along_column(&self, column: usize, v: &[i32; 3]) -> i64 {
        let entry = |row: usize| self.rows[row].get(column).copied().unwrap_or_default().to_bits();
        scalar_product(entry(0), entry(1), entry(2), v)
    }

    /// The rotation that applies `first` and then this one, like the product, and orthonormal
    /// within 2<sup>-26</sup> even after a million compositions.
    ///
    /// Rounding turns the result by up to 2<sup>-29</sup> radians each time, in any direction: a
    /// million equal steps end 10<sup>-3</sup> radians off at most, and 2 x 10<sup>-4</sup> in
    /// tests. To come back to where it was, a motion computes its angle anew for each frame.
    #[must_use]
    pub fn compose(self, first: Self) -> Self {
        (self * first).orthonormalized()
    }

    /// From rows in Q30 that are orthonormal.
    pub(crate) fn from_row_bits(rows: [[i32; 3]; 3]) -> Self {
        Self { rows: rows.map(|row| row.map(I2F30::from_bits)) }
    }

    /// Makes the rows orthonormal again (Gram and Schmidt): the first row keeps its direction, and
    /// the second its plane with the first.
    #[must_use]
    pub fn orthonormalized(&self) -> Self {
        let [x, y, _] = self.rows.map(|row| row.map(|c| i64::from(c.to_bits())));
        let Some(x) = unit(x) else {
            return Self::IDENTITY;
        };
        let along = (0..3).map(|i| i64::from(x[i]) * y[i]).sum::<i64>() >> 30;
        let Some(y) = unit(core::array::from_fn(|i| y[i] - ((along * i64::from(x[i])) >> 30)))
        else {
            return Self::IDENTITY;
        };
        Self { rows: [x, y, cross(x, y)].map(|row| row.map(I2F30::from_bits)) }
    }
}

/// The scalar product in Q60, or `None` if it does not fit.
const fn dot(a: &[I2F30; 3], b: &[I2F30; 3]) -> Option<i64> {
    let (mut sum, mut axis) = (0i64, 0);
    while axis < 3 {
        match sum.checked_add(a[axis].to_bits() as i64 * b[axis].to_bits() as i64) {
            Some(next) => sum = next,
            None => return None,
        }
        axis += 1;
    }
    Some(sum)
}

/// The cross product of Q30 vectors of length one.
pub(crate) fn cross(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    core::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let difference = i64::from(a[j]) * i64::from(b[k]) - i64::from(a[k]) * i64::from(b[j]);
        ((difference + (1 << 29)) >> 30) as i32
    })
}

/// The product applies the right rotation first, then the left one.
impl Mul for Rotation {
    type Output = Self;

    fn mul(self, first: Self) -> Self {
        let mut rows = self.rows;
        for row in &mut rows {
            *row = first.turn_back(&row.map(I2F30::to_bits)).map(I2F30::from_bits);
        }
        Self { rows }
    }
}

/// Rotates a vector, like [`Rotation::apply`].
impl Mul<Vec3> for Rotation {
    type Output = Vec3;

    fn mul(self, v: Vec3) -> Vec3 {
        self.apply(v)
    }
}

/// The scalar product of (x, y, z) and `v`. It is not inlined: it makes matrices, once per frame.
#[inline(never)]
fn scalar_product(x: i32, y: i32, z: i32, v: &[i32; 3]) -> i64 {
    let product = |a: i32, b: i32| i64::from(a) * i64::from(b);
    product(x, v[0]) + product(y, v[1]) + product(z, v[2])
}

impl Vec3 {
    /// The scalar product with a direction in Q30, exact, in Q46.
    #[inline(always)]
    pub(crate) fn along(&self, direction: &[i32; 3]) -> i64 {
        let [x, y, z] = self.to_bits();
        scalar_product(x, y, z, direction)
    }

    /// The vector of length one in this direction, within 2<sup>-16</sup>, or `None` for the zero
    /// vector.
    #[must_use]
    pub fn normalized(self) -> Option<Self> {
        unit(self.to_bits().map(i64::from))
            .map(|u| Self::from_bits(u.map(|c| (c + (1 << 13)) >> 14)))
    }

    /// The length, rounded down. It saturates at the end of the range.
    #[must_use]
    pub fn length(self) -> Scalar {
        let squares: u64 = self.to_bits().iter().map(|&c| u64::from(c.unsigned_abs()).pow(2)).sum();
        Scalar::from_bits(i32::try_from(squares.isqrt()).unwrap_or(i32::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest difference of R R^T from the identity.
    fn skew(r: &Rotation) -> f64 {
        let rows = r.rows().map(|row| row.map(|c| c.to_num::<f64>()));
        let mut worst = 0f64;
        for i in 0..3 {
            for j in 0..3 {
                let dot: f64 = (0..3).map(|k| rows[i][k] * rows[j][k]).sum();
                worst = worst.max((dot - f64::from(u8::from(i == j))).abs());
            }
        }
        worst
    }

    #[test]
    fn axes_turn_the_right_way() {
        assert_eq!(Rotation::about_x(Turn::QUARTER) * Vec3::Y, Vec3::Z);
        assert_eq!(Rotation::about_y(Turn::QUARTER) * Vec3::Z, Vec3::X);
        assert_eq!(Rotation::about_z(Turn::QUARTER) * Vec3::X, Vec3::Y);
    }

    /// A million steps about the y axis, the exact result of which is known.
    #[test]
    fn compositions_stay_orthonormal_and_drift_little() {
        for bits in [0x0012_3457, 0x1234_5679] {
            let step = Turn::from_bits(bits);
            let tilt = Rotation::about_x(Turn::degrees(33)) * Rotation::about_z(Turn::degrees(71));
            // The step about a tilted axis.
            let step_there = (tilt * Rotation::about_y(step)) * tilt.inverse();
            let mut r = Rotation::IDENTITY;
            for _ in 0..1_000_000 {
                r = step_there.compose(r);
            }
            assert!(skew(&r) < 2f64.powi(-26), "2^{}", skew(&r).log2());
            let angle = Turn::from_bits(bits.wrapping_mul(1_000_000));
            let exact = (tilt * Rotation::about_y(angle)) * tilt.inverse();
            let drift = r.rows.as_flattened().iter().zip(exact.rows.as_flattened());
            let drift = drift.map(|(a, b)| (*a - *b).to_num::<f64>().abs()).fold(0.0, f64::max);
            assert!(drift < 1e-3, "{drift}");
        }
    }

    #[test]
    fn rows_that_are_no_rotation_are_refused() {
        let rows =
            *(Rotation::about_x(Turn::degrees(33)) * Rotation::about_y(Turn::degrees(9))).rows();
        assert_eq!(Rotation::from_rows(rows), Some(Rotation { rows }));
        let [x, y, z] = rows;
        assert_eq!(Rotation::from_rows([y, x, z]), None);
        assert_eq!(Rotation::from_rows([x, y, z.map(|c| -c)]), None);
        assert_eq!(Rotation::from_rows([x, y, y]), None);
        assert_eq!(Rotation::from_rows([[I2F30::MIN; 3]; 3]), None);
        assert_eq!(Rotation::from_rows([[I2F30::MAX; 3]; 3]), None);
        assert_eq!(Rotation::from_rows([[ZERO; 3]; 3]), None);
        let mut near = rows;
        near[1][1] += I2F30::from_bits(1 << 12);
        assert_eq!(Rotation::from_rows(near), None);
    }

    #[test]
    fn stays_orthonormal() {
        for degrees in 0..360 {
            let r = Rotation::about_z(Turn::degrees(degrees))
                * Rotation::about_x(Turn::degrees(degrees * 7));
            assert!(skew(&r) < 2f64.powi(-26), "{degrees}: 2^{}", skew(&r).log2());
            let back = r * r.inverse();
            let near = |a: I2F30, b: I2F30| (a - b).abs() < I2F30::from_bits(16);
            assert!(
                (0..9)
                    .all(|i| near(back.rows[i / 3][i % 3], Rotation::IDENTITY.rows[i / 3][i % 3]))
            );
        }
    }

    #[test]
    fn lengths_and_directions() {
        assert_eq!(Vec3::lit("3", "-4", "0").length(), Scalar::lit("5"));
        assert_eq!(Vec3::from_bits([i32::MIN; 3]).length(), Scalar::MAX);
        assert_eq!(Vec3::lit("0", "-9", "0").normalized(), Some(-Vec3::Y));
        assert_eq!(Vec3::ZERO.normalized(), None);
    }
}
