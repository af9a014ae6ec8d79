//! What a vertex carries to pixels that are lit: its normal, and its position if a light or the
//! viewer is near.

use core::fmt::Debug;

use fixed::types::I16F16;

use crate::attribute::{Components, Varyings};

/// Whether light depends on the position of a surface: [`Anywhere`] or [`Here`].
pub trait Place: Copy + Debug {
    /// This one if it is [`Here`], or else `P`.
    type Or<P: Place>: Place;

    /// Whether it is [`Here`].
    const IS_HERE: bool;

    /// The varyings of a vertex.
    type Vertex: Components<Sample = Self::Pixel> + Varyings<OnScreen = Self::Vertex>;
    /// What a pixel sees of them.
    type Pixel: Copy;

    /// From a normal of the length 2,032 and a position of [`POSITION_BITS`] bits.
    fn vertex(normal: [i16; 3], position: [i16; 3]) -> Self::Vertex;

    /// The normal of a pixel, of a length below 2^15, and its position in 16 bits; zero if it does
    /// not matter.
    fn pixel(pixel: Self::Pixel) -> [[i32; 3]; 2];
}

/// [`Here`] if one of two is.
pub(in crate::shade) type Ambit<A, B> = <A as Place>::Or<B>;

/// The bits of a position as a varying.
pub(in crate::shade) const POSITION_BITS: u32 = 14;

/// A normal of a table, 127 standing for 1, as a varying of length 2,032: its range over a triangle
/// stays below 2^12, where [`Adaptive`](crate::attribute::Adaptive) can do without divisions. One
/// that is far too long is halved, so that its square fits at each pixel.
#[inline(always)]
pub(in crate::shade) fn unit_varying(normal: [i8; 3]) -> [i16; 3] {
    let [x, y, z] = normal.map(i32::from);
    // The longest that rounding leaves is 127.87.
    let up = if x * x + y * y + z * z < 1 << 14 { 4 } else { 3 };
    normal.map(|c| i16::from(c) << up)
}

/// Light is the same at all positions.
#[derive(Clone, Copy, Debug)]
pub enum Anywhere {}

/// Light depends on the position.
#[derive(Clone, Copy, Debug)]
pub enum Here {}

/// To a length of 32,512. That a varying arrives half a unit above its value turns it by up to
/// 0.025 degrees; to take that off would cost three instructions a pixel.
#[inline(always)]
fn normal(varying: [I16F16; 3]) -> [i32; 3] {
    varying.map(|c| c.to_bits() >> 12)
}

impl Place for Anywhere {
    type Or<P: Place> = P;

    const IS_HERE: bool = false;

    type Vertex = [i16; 3];
    type Pixel = [I16F16; 3];

    #[inline(always)]
    fn vertex(normal: [i16; 3], _: [i16; 3]) -> [i16; 3] {
        normal
    }

    #[inline(always)]
    fn pixel(pixel: [I16F16; 3]) -> [[i32; 3]; 2] {
        [normal(pixel), [0; 3]]
    }
}

impl Place for Here {
    type Or<P: Place> = Self;

    const IS_HERE: bool = true;

    type Vertex = [i16; 6];
    type Pixel = [I16F16; 6];

    #[inline(always)]
    fn vertex([x, y, z]: [i16; 3], [u, v, w]: [i16; 3]) -> [i16; 6] {
        [x, y, z, u, v, w]
    }

    #[inline(always)]
    fn pixel([x, y, z, u, v, w]: [I16F16; 6]) -> [[i32; 3]; 2] {
        [normal([x, y, z]), [u, v, w].map(|c| c.to_bits() >> POSITION_BITS)]
    }
}
