//! Rotations as quaternions, and the way between two of them.

use core::ops::Mul;

use fixed::types::I2F30;

use super::{Rotation, Scalar, Turn, Vec3, angle, mul_q30, unit};

/// A rotation as a quaternion w + x i + y j + z k of length one, in Q2.30.
///
/// It is made of an axis and an angle, takes 16 bytes, and has a way to another one
/// ([`slerp`](Self::slerp)). A [`Pose`](crate::geometry::Pose) takes it as a [`Rotation`]. The
/// length is one within 2<sup>-27</sup>: each function restores it.
///
/// ```
/// use rasterizer::numbers::{Quaternion, Rotation, Scalar, Turn, Vec3};
///
/// let Some(lid) = Quaternion::about(Vec3::X, Turn::degrees(110)) else { panic!() };
/// let half_open = Quaternion::IDENTITY.slerp(lid, const { Scalar::lit("0.5") });
/// let exact = Rotation::about_x(Turn::degrees(55));
/// let apart = Rotation::from(half_open) * Vec3::Z - exact * Vec3::Z;
/// assert!(apart.length() < Scalar::lit("0.0001"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Quaternion {
    /// w, x, y and z.
    parts: [I2F30; 4],
}

impl Default for Quaternion {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Quaternion {
    /// No rotation.
    pub const IDENTITY: Self = Self::from_bits([1 << 30, 0, 0, 0]);

    const fn from_bits([w, x, y, z]: [i32; 4]) -> Self {
        let bits = I2F30::from_bits;
        Self { parts: [bits(w), bits(x), bits(y), bits(z)] }
    }

    fn to_bits(self) -> [i32; 4] {
        self.parts.map(I2F30::to_bits)
    }

    /// From w, x, y and z of any length over zero, or `None`.
    #[must_use]
    pub fn new(parts: [I2F30; 4]) -> Option<Self> {
        unit(parts.map(|c| i64::from(c.to_bits()))).map(Self::from_bits)
    }

    /// About an axis of any length: an angle below half a turn is counter-clockwise for a viewer
    /// towards whom the axis points. `None` for an axis of no length.
    ///
    /// The direction of what it turns is within 2<sup>-26</sup> radians of exact.
    #[must_use]
    pub fn about(axis: Vec3, angle: Turn) -> Option<Self> {
        let axis = unit(axis.to_bits().map(i64::from))?;
        let half = angle.half();
        let (sin, cos) = (half.sin().to_bits(), half.cos().to_bits());
        let [x, y, z] = axis.map(|c| mul_q30(c, sin));
        unit([cos, x, y, z].map(i64::from)).map(Self::from_bits)
    }

    /// w, x, y and z.
    #[must_use]
    pub const fn parts(self) -> [I2F30; 4] {
        self.parts
    }

    /// The axis of length one, and the angle about it: at most half a turn. About x for none.
    ///
    /// The angle is within 2<sup>-25</sup> radians; so is the axis, divided by the angle's half.
    #[must_use]
    pub fn axis_angle(self) -> (Vec3, Turn) {
        let [w, x, y, z] = self.to_bits();
        let axis = [x, y, z].map(|c| if w < 0 { -i64::from(c) } else { c.into() });
        let Some(direction) = unit(axis) else { return (Vec3::X, Turn::ZERO) };
        let sum: i64 = axis.iter().zip(direction).map(|(&a, b)| a * i64::from(b)).sum();
        let half = angle([i64::from(w).abs(), sum >> 30]);
        (Vec3::from_bits(direction.map(|c| (c + (1 << 13)) >> 14)), half + half)
    }

    /// The inverse rotation.
    #[must_use]
    pub fn inverse(self) -> Self {
        let [w, x, y, z] = self.to_bits();
        Self::from_bits([w, -x, -y, -z])
    }

    /// The rotation a part `t` of the way to another one, about one axis with equal speed: this one
    /// for 0, the other one for 1, and beyond them outside that range. It takes the shorter way; if
    /// both are half a turn apart, either.
    ///
    /// The direction of what it turns is within 2<sup>-25</sup> radians of exact (and times |t|, if
    /// that is over 1): the angle between both is computed within 2<sup>-27</sup>, and both are
    /// combined by the sine and the cosine of its part, the second of them made orthogonal to the
    /// first. So nearly equal rotations need no case of their own.
    #[must_use]
    pub fn slerp(self, other: Self, t: Scalar) -> Self {
        let (from, to) = (self.to_bits().map(i64::from), other.to_bits().map(i64::from));
        let product: i64 = from.iter().zip(to).map(|(a, b)| a * b).sum();
        let to = if product < 0 { to.map(|c| -c) } else { to };
        let cos = (product.abs() + (1 << 29)) >> 30;
        // In Q60: the part of `to` that is orthogonal to `from`.
        let across: [i64; 4] = core::array::from_fn(|i| (to[i] << 30) - from[i] * cos);
        let Some(direction) = unit(across) else { return self };
        let sin: i64 = across.iter().zip(direction).map(|(&a, b)| (a >> 30) * i64::from(b)).sum();
        // A quarter of a turn at most.
        let whole = i64::from(angle([cos, sin >> 30]).to_bits());
        let part = Turn::from_bits(((whole * i64::from(t.to_bits()) + (1 << 15)) >> 16) as u32);
        let (sin, cos) = (i64::from(part.sin().to_bits()), i64::from(part.cos().to_bits()));
        let sum = core::array::from_fn(|i| from[i] * cos + i64::from(direction[i]) * sin);
        unit(sum).map_or(self, Self::from_bits)
    }
}

/// The product applies the right rotation first, then the left one.
impl Mul for Quaternion {
    type Output = Self;

    fn mul(self, first: Self) -> Self {
        let [w, x, y, z] = self.to_bits().map(i64::from);
        let [a, b, c, d] = first.to_bits().map(i64::from);
        let product = [
            w * a - x * b - y * c - z * d,
            w * b + x * a + y * d - z * c,
            w * c - x * d + y * a + z * b,
            w * d + x * c - y * b + z * a,
        ];
        unit(product).map_or(self, Self::from_bits)
    }
}

/// Within 2<sup>-28</sup> in each entry, besides what the quaternion is off by. Its rows are
/// orthonormal within 2<sup>-26</sup>.
impl From<Quaternion> for Rotation {
    fn from(quaternion: Quaternion) -> Self {
        let [w, x, y, z] = quaternion.to_bits().map(i64::from);
        let twice = |a: i64| ((a + (1 << 28)) >> 29) as i32;
        let whole = |a: i64| ((a + (1 << 29)) >> 30).clamp(-(1 << 30), 1 << 30) as i32;
        Self::from_row_bits([
            [whole(w * w + x * x - y * y - z * z), twice(x * y - w * z), twice(x * z + w * y)],
            [twice(x * y + w * z), whole(w * w - x * x + y * y - z * z), twice(y * z - w * x)],
            [twice(x * z - w * y), twice(y * z + w * x), whole(w * w - x * x - y * y + z * z)],
        ])
        .orthonormalized()
    }
}

/// Within 2<sup>-28</sup> in each part, besides what the rows are off by.
///
/// Four times the largest part, times each of the parts, are sums of entries (Shepperd, Journal of
/// Guidance and Control 1, 1978): the largest is a half at least, so that none of them loses bits.
impl From<Rotation> for Quaternion {
    fn from(rotation: Rotation) -> Self {
        const ONE: i64 = 1 << 30;
        let [a, b, c] = rotation.to_bits().map(|row| row.map(i64::from));
        // Four squares of w, x, y and z.
        let squares = [
            ONE + a[0] + b[1] + c[2],
            ONE + a[0] - b[1] - c[2],
            ONE - a[0] + b[1] - c[2],
            ONE - a[0] - b[1] + c[2],
        ];
        let [w, x, y, z] = squares;
        let (wx, wy, wz) = (c[1] - b[2], a[2] - c[0], b[0] - a[1]);
        let (xy, xz, yz) = (a[1] + b[0], a[2] + c[0], b[2] + c[1]);
        let largest = w.max(x).max(y).max(z);
        let parts = if largest == w {
            [w, wx, wy, wz]
        } else if largest == x {
            [wx, x, xy, xz]
        } else if largest == y {
            [wy, xy, y, yz]
        } else {
            [wz, xz, yz, z]
        };
        unit(parts).map_or(Self::IDENTITY, Self::from_bits)
    }
}

impl Rotation {
    /// About an axis of any length, like [`Quaternion::about`]; `None` for an axis of no length.
    #[must_use]
    pub fn about(axis: Vec3, angle: Turn) -> Option<Self> {
        Quaternion::about(axis, angle).map(Self::from)
    }

    /// The rotation a part `t` of the way to another one, by [`Quaternion::slerp`].
    #[must_use]
    pub fn slerp(self, other: Self, t: Scalar) -> Self {
        Quaternion::from(self).slerp(other.into(), t).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    type Q = [f64; 4];

    fn f64s(q: Quaternion) -> Q {
        q.parts().map(|c| c.to_num::<f64>())
    }

    fn random_quaternion(random: &mut Random) -> Quaternion {
        loop {
            let parts = [(); 4].map(|()| I2F30::from_bits((random.bits() as i32) >> 1));
            if let Some(q) = Quaternion::new(parts) {
                return q;
            }
        }
    }

    fn dot(a: Q, b: Q) -> f64 {
        (0..4).map(|i| a[i] * b[i]).sum()
    }

    fn apart(a: Q, b: Q) -> f64 {
        // Both signs are the same rotation.
        let away = |sign: f64| (0..4).map(|i| (a[i] - sign * b[i]).powi(2)).sum::<f64>().sqrt();
        away(1.0).min(away(-1.0))
    }

    /// The matrix by Rodrigues' formula.
    fn rodrigues(axis: [f64; 3], angle: f64) -> [[f64; 3]; 3] {
        let length = axis.iter().map(|c| c * c).sum::<f64>().sqrt();
        let [x, y, z] = axis.map(|c| c / length);
        let (sin, cos) = angle.sin_cos();
        let one = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let across = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        let along = [x, y, z];
        core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                cos * one[i][j] + sin * across[i][j] + (1.0 - cos) * along[i] * along[j]
            })
        })
    }

    #[test]
    fn rotations_about_an_axis_are_those_of_rodrigues() {
        let mut random = Random::new(51);
        for round in 0..20_000 {
            let axis = [(); 3].map(|()| (random.bits() as i32) >> (round % 31));
            let turn = Turn::from_bits(random.bits() as u32);
            let Some(got) = Quaternion::about(Vec3::from_bits(axis), turn) else {
                assert_eq!(axis, [0; 3]);
                continue;
            };
            let radians = f64::from(turn.to_bits()) / 2f64.powi(32) * core::f64::consts::TAU;
            let want = rodrigues(axis.map(f64::from), radians);
            let rotation = Rotation::from(got);
            for (got, want) in rotation.rows().as_flattened().iter().zip(want.as_flattened()) {
                let error = got.to_num::<f64>() - want;
                assert!(
                    error.abs() < 2f64.powi(-26),
                    "{axis:?} {turn:?}: 2^{}",
                    error.abs().log2()
                );
            }
            // And back.
            let again = Quaternion::from(rotation);
            assert!(apart(f64s(again), f64s(got)) < 2f64.powi(-26), "{got:?} {again:?}");
            let (axis, angle) = got.axis_angle();
            let same = Quaternion::about(axis, angle).unwrap();
            // The axis is rounded to 2^-16.
            assert!(apart(f64s(same), f64s(got)) < 2f64.powi(-15), "{got:?} {same:?}");
            assert!(angle.to_bits() <= (1 << 31) + 64, "{angle:?}");
        }
        assert_eq!(Quaternion::about(Vec3::ZERO, Turn::QUARTER), None);
    }

    #[test]
    fn products_are_those_of_rotations() {
        let mut random = Random::new(52);
        for _ in 0..5000 {
            let [a, b] = [(); 2].map(|()| random_quaternion(&mut random));
            let (got, want) = (Rotation::from(a * b), Rotation::from(a) * Rotation::from(b));
            for (got, want) in got.rows().as_flattened().iter().zip(want.rows().as_flattened()) {
                assert!((*got - *want).to_num::<f64>().abs() < 2f64.powi(-25));
            }
            assert!(apart(f64s(a * a.inverse()), [1.0, 0.0, 0.0, 0.0]) < 2f64.powi(-26));
        }
    }

    /// By the definition with sines of the angle in f64, also of rotations that are nearly equal
    /// and nearly half a turn apart.
    #[test]
    fn the_way_between_two_rotations_has_equal_speed() {
        let mut random = Random::new(53);
        let mut worst = 0f64;
        for round in 0..40_000 {
            let a = random_quaternion(&mut random);
            let small = Turn::from_bits(random.bits() as u32 >> (round % 32));
            let axis = Vec3::from_bits([(); 3].map(|()| (random.bits() as i32) >> 1));
            let Some(step) = Quaternion::about(axis, small) else { continue };
            let b = if round % 3 == 0 { random_quaternion(&mut random) } else { step * a };
            let t = Scalar::from_bits(random.within(0, 1 << 16));
            let (p, q) = (f64s(a), f64s(b));
            let [p, q] = [p, q].map(|v| v.map(|c| c / dot(v, v).sqrt()));
            let q = if dot(p, q) < 0.0 { q.map(|c| -c) } else { q };
            // By the arctangent, as the arccosine loses the digits of small angles.
            let across = core::array::from_fn::<_, 4, _>(|i| q[i] - p[i] * dot(p, q));
            let angle = dot(across, across).sqrt().atan2(dot(p, q));
            if angle > core::f64::consts::FRAC_PI_2 - 1e-5 {
                // Half a turn apart: both ways are right.
                continue;
            }
            let t64 = t.to_num::<f64>();
            let want: Q = if angle < 1e-12 {
                p
            } else {
                core::array::from_fn(|i| {
                    (((1.0 - t64) * angle).sin() * p[i] + (t64 * angle).sin() * q[i]) / angle.sin()
                })
            };
            // What it turns is off by twice as much.
            let error = 2.0 * apart(f64s(a.slerp(b, t)), want);
            worst = worst.max(error);
            assert!(error < 2f64.powi(-25), "{a:?} {b:?} {t}: 2^{}", error.log2());
        }
        assert!(worst > 2f64.powi(-30), "{worst}");
    }

    #[test]
    fn ends_of_the_way_are_the_rotations() {
        let [a, b] = [20, 150].map(|d| Rotation::about_y(Turn::degrees(d)));
        for (t, want) in [("0", 20), ("1", 150), ("0.5", 85), ("2", 280), ("-1", 250)] {
            let got = a.slerp(b, Scalar::from_str(t).unwrap());
            let want = Rotation::about_y(Turn::degrees(want));
            for (got, want) in got.rows().as_flattened().iter().zip(want.rows().as_flattened()) {
                assert!((*got - *want).to_num::<f64>().abs() < 2f64.powi(-24), "{t}");
            }
        }
    }
}
