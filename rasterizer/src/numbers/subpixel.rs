//! How finely a place on the screen is resolved.

use super::Coordinate;

/// How finely a vertex's place on the screen is resolved.
///
/// The choice is between [`S4`], whose set-up needs no 64-bit arithmetic, and [`S8`], the precision
/// of Direct3D 11 (functional specification 3.2.4.1). What a pixel costs is the same.
pub trait Subpixel: Copy + Default + private::Sealed {
    /// The binary digits behind the point of a pixel coordinate.
    const BITS: u32;
    /// Its coordinates in clip space.
    #[doc(hidden)]
    type Coordinate: Coordinate;
}

mod private {
    pub trait Sealed {}
    impl Sealed for super::S4 {}
    impl Sealed for super::S8 {}
}

/// Sixteenths of a pixel: a vertex is off by at most 5/128 pixel in x and y. For cores without a
/// long multiply, and objects up to some hundred near distances wide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct S4;

/// 256ths of a pixel: a vertex is off by at most 5/2048 pixel in x and y. For objects up to some
/// hundred thousand near distances wide: a ground to the horizon, a room with the camera in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct S8;

impl Subpixel for S4 {
    const BITS: u32 = 4;
    type Coordinate = i32;
}

impl Subpixel for S8 {
    const BITS: u32 = 8;
    type Coordinate = i64;
}
