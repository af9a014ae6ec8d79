//! Coordinates of clip space, with and without a fraction.

use core::fmt::Debug;

/// A number of whole units, which decide on which side of a plane a point lies, and perhaps a
/// fraction, which says where.
pub trait Coordinate: Copy + Debug + PartialEq {
    /// Whether it keeps a fraction.
    const HAS_FRACTION: bool;

    /// From whole units, and 32 bits behind the point.
    fn new(units: i32, fraction: u32) -> Self;

    /// From units with the binary digits behind the point that it keeps: 32 or none.
    fn from_bits(bits: i64) -> Self;

    /// In units with the binary digits behind the point that it keeps.
    fn to_bits(self) -> i64;

    /// The whole units, rounded down.
    fn units(self) -> i32;

    /// The 32 bits behind the point.
    fn fraction(self) -> u32;

    /// The whole units after a shift up by 1 to 31 bits.
    #[inline(always)]
    #[must_use]
    fn shifted_units(self, shift: u32) -> i32 {
        self.units() << shift | (self.fraction() >> (32 - shift)).cast_signed()
    }
}

/// Whole units only.
impl Coordinate for i32 {
    const HAS_FRACTION: bool = false;

    #[inline(always)]
    fn new(units: i32, _: u32) -> Self {
        units
    }

    #[inline(always)]
    fn from_bits(bits: i64) -> Self {
        bits as Self
    }

    #[inline(always)]
    fn to_bits(self) -> i64 {
        self.into()
    }

    #[inline(always)]
    fn units(self) -> i32 {
        self
    }

    #[inline(always)]
    fn fraction(self) -> u32 {
        0
    }
}

/// Q32.32.
impl Coordinate for i64 {
    const HAS_FRACTION: bool = true;

    #[inline(always)]
    fn new(units: i32, fraction: u32) -> Self {
        Self::from(units) << 32 | Self::from(fraction)
    }

    #[inline(always)]
    fn from_bits(bits: i64) -> Self {
        bits
    }

    #[inline(always)]
    fn to_bits(self) -> i64 {
        self
    }

    #[inline(always)]
    fn units(self) -> i32 {
        (self >> 32) as i32
    }

    #[inline(always)]
    fn fraction(self) -> u32 {
        self as u32
    }
}
