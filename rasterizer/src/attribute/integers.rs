//! Integers of 16 and 32 bits, linear on the screen.

use fixed::types::{I16F16, U16F16};

use super::{Interpolate, Piece, Plane, QuickGradients, TriangleSetup, Whole};
use crate::numbers::Subpixel;

/// Stepped in Q16.16.
impl Interpolate for u16 {
    const ZERO: Self = 0;

    type Field = Plane<u32>;
    type Walk = u32;
    type Rest = Whole<u32>;
    type Sample = U16F16;

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<u32> {
        match quick {
            Some(quick) => setup.quick_plane(quick, corners),
            None => setup.exact_plane(corners),
        }
    }

    #[inline(always)]
    fn whole(field: &Plane<u32>, at: [i32; 2], pixels: usize) -> Option<Piece<u32>> {
        Some(field.piece(at, pixels))
    }

    #[inline(always)]
    fn walk(field: &Plane<u32>, at: [i32; 2], pixels: usize) -> (Piece<u32>, Whole<u32>) {
        (field.piece(at, pixels), core::iter::empty())
    }

    /// Half a unit above the interpolated value, so that its integer part is rounded.
    #[inline(always)]
    fn sample(value: u32) -> U16F16 {
        U16F16::from_bits(value)
    }
}

/// Stepped in Q16.16 like `u16`, with 32,768 added.
impl Interpolate for i16 {
    const ZERO: Self = 0;

    type Field = Plane<u32>;
    type Walk = u32;
    type Rest = Whole<u32>;
    type Sample = I16F16;

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<u32> {
        u16::plane(setup, quick, corners.map(|value| value as u16 ^ 0x8000))
    }

    #[inline(always)]
    fn whole(field: &Plane<u32>, at: [i32; 2], pixels: usize) -> Option<Piece<u32>> {
        Some(field.piece(at, pixels))
    }

    #[inline(always)]
    fn walk(field: &Plane<u32>, at: [i32; 2], pixels: usize) -> (Piece<u32>, Whole<u32>) {
        (field.piece(at, pixels), core::iter::empty())
    }

    /// Half a unit above the interpolated value, so that its integer part is rounded.
    #[inline(always)]
    fn sample(value: u32) -> I16F16 {
        I16F16::from_bits((value ^ 0x8000_0000) as i32)
    }
}

/// Stepped in Q32.18.
impl Interpolate for u32 {
    const ZERO: Self = 0;

    type Field = Plane<u64>;
    type Walk = u64;
    type Rest = Whole<u64>;
    type Sample = Self;

    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        _: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<u64> {
        setup.exact_wide_plane(corners)
    }

    #[inline(always)]
    fn whole(field: &Plane<u64>, at: [i32; 2], pixels: usize) -> Option<Piece<u64>> {
        Some(field.piece(at, pixels))
    }

    #[inline(always)]
    fn walk(field: &Plane<u64>, at: [i32; 2], pixels: usize) -> (Piece<u64>, Whole<u64>) {
        (field.piece(at, pixels), core::iter::empty())
    }

    /// The interpolated value, rounded.
    #[inline(always)]
    fn sample(value: u64) -> Self {
        (value >> 18) as Self
    }
}
