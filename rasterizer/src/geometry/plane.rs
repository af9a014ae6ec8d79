//! Planes in space.

use crate::numbers::{Scalar, Vec3};

/// The plane of all points p with `normal` · p + `offset` = 0, and the side that its normal points
/// to: where that sum is positive.
///
/// The normal has any length but 0. Both are taken as they are, in Q16.16: a normal of some
/// thousands of units has a finer direction than one of length 1, with the offset in proportion. A
/// plane farther than 65,536 units from the origin counts as one at that distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plane {
    /// At a right angle to it.
    pub normal: Vec3,
    /// The distance of the origin from it, in lengths of the normal: positive if the normal points
    /// from the plane to the origin's side.
    pub offset: Scalar,
}

impl Plane {
    /// By its normal and the distance of the origin from it.
    #[must_use]
    pub const fn new(normal: Vec3, offset: Scalar) -> Self {
        Self { normal, offset }
    }

    /// The same plane with its other side.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self { normal: -self.normal, offset: Scalar::ZERO.saturating_sub(self.offset) }
    }

    /// The normal in Q30 with its longest coordinate from a quarter to a half, and the offset in
    /// Q46 with it. If the first coordinate that is not 0 is negative, they are those of the
    /// flipped plane, and the result is true: so a plane and the flipped one have the same numbers.
    pub(super) fn normalised(&self) -> ([i32; 3], i64, bool) {
        let normal = self.normal.to_bits().map(i64::from);
        let is_flipped = normal.iter().find(|&&c| c != 0).is_some_and(|&c| c < 0);
        let sign = if is_flipped { -1 } else { 1 };
        let largest = normal.iter().fold(0, |all, c| all | c.unsigned_abs()) as u32;
        // From 2^28 to 2^29 - 1; at most a shift down by 3.
        let shift = if largest == 0 { 0 } else { largest.leading_zeros() as i32 - 3 };
        let shifted = |c: i64| if shift < 0 { c >> -shift } else { c << shift };
        // A coordinate of the normal in Q16.16, shifted, is one in Q30 of 2^(shift - 14) times it.
        let limit = 1 << (46 - shift.max(0));
        let offset = (sign * i64::from(self.offset.to_bits())).clamp(-limit, limit);
        (normal.map(|c| shifted(sign * c) as i32), shifted(offset << 16), is_flipped)
    }
}
