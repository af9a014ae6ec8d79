//! Points and directions in world units.

use core::ops::{Add, Mul, Neg, Sub};

use fixed::types::I16F16;

/// A coordinate in world units: Q16.16, from -32,768 to just under 32,768 in steps of 1/65,536.
pub type Scalar = I16F16;

/// A point or a direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Vec3 {
    /// To the right.
    pub x: Scalar,
    /// Upwards.
    pub y: Scalar,
    /// Towards the viewer.
    pub z: Scalar,
}

impl Vec3 {
    /// The origin.
    pub const ZERO: Self = Self::from_bits([0; 3]);
    /// One unit along x.
    pub const X: Self = Self::from_bits([1 << 16, 0, 0]);
    /// One unit along y: up.
    pub const Y: Self = Self::from_bits([0, 1 << 16, 0]);
    /// One unit along z.
    pub const Z: Self = Self::from_bits([0, 0, 1 << 16]);

    /// From its coordinates.
    #[must_use]
    pub const fn new(x: Scalar, y: Scalar, z: Scalar) -> Self {
        Self { x, y, z }
    }

    /// From decimal text, at compile time: `const EYE: Vec3 = Vec3::lit("0", "1.5", "-4");`
    ///
    /// Call it in a constant or in a block `const { .. }`, where the compiler reads the text.
    /// Elsewhere the firmware may have to read it, with 3.6 KB of code. The same goes for `lit` of
    /// [`Scalar`], [`Distance`](crate::camera::Distance) and [`Level`](crate::shade::Level).
    ///
    /// # Panics
    ///
    /// Panics if a text is not a number or is out of range. In a constant that is a compile error.
    #[must_use]
    pub const fn lit(x: &str, y: &str, z: &str) -> Self {
        Self::new(Scalar::lit(x), Scalar::lit(y), Scalar::lit(z))
    }

    /// From coordinates in 65,536ths of a unit.
    #[must_use]
    pub const fn from_bits([x, y, z]: [i32; 3]) -> Self {
        Self::new(Scalar::from_bits(x), Scalar::from_bits(y), Scalar::from_bits(z))
    }

    /// The coordinates in 65,536ths of a unit.
    #[must_use]
    pub const fn to_bits(self) -> [i32; 3] {
        [self.x.to_bits(), self.y.to_bits(), self.z.to_bits()]
    }
}

/// Saturates at the ends of the range.
impl Add for Vec3 {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(
            self.x.saturating_add(other.x),
            self.y.saturating_add(other.y),
            self.z.saturating_add(other.z),
        )
    }
}

/// Saturates at the ends of the range.
impl Sub for Vec3 {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(
            self.x.saturating_sub(other.x),
            self.y.saturating_sub(other.y),
            self.z.saturating_sub(other.z),
        )
    }
}

/// Saturates at the ends of the range.
impl Neg for Vec3 {
    type Output = Self;

    fn neg(self) -> Self {
        Self::ZERO - self
    }
}

/// Saturates at the ends of the range.
impl Mul<Scalar> for Vec3 {
    type Output = Self;

    fn mul(self, factor: Scalar) -> Self {
        Self::new(
            self.x.saturating_mul(factor),
            self.y.saturating_mul(factor),
            self.z.saturating_mul(factor),
        )
    }
}
