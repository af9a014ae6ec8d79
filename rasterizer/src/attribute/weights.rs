//! Barycentric coordinates.

use core::fmt::Debug;

use super::{Components, Interpolate, InverseW, Piece, QuickGradients, TriangleSetup, Varyings};
use crate::numbers::Subpixel;

/// The barycentric coordinates of a place in its triangle: how much of the first and of the second
/// corner, in Q0.32, where 2<sup>32</sup> - 1 stands for 1. The rest is the third corner's.
///
/// A vertex has none of its own: [`Weights::VERTEX`] becomes those of a corner in each triangle.
/// They refer to the mesh's own triangle, clipped or not.
///
/// As a varying they are linear on the screen, within 2<sup>-22</sup>;
/// [`PerspectiveCorrect`](super::PerspectiveCorrect) makes them linear in space. Gradients are
/// divided exactly with [`EveryPixel`](super::EveryPixel), so that its bound holds without that of
/// 1/256 of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Weights([u32; 2]);

type Pair = [u32; 2];

impl Weights {
    /// What a shader gives each vertex.
    pub const VERTEX: Self = Self([0; 2]);

    /// Those of a corner, 0 to 2.
    const fn of_corner(corner: usize) -> Self {
        Self(match corner {
            0 => [u32::MAX, 0],
            1 => [0, u32::MAX],
            _ => [0, 0],
        })
    }
}

impl Varyings for Weights {
    type OnScreen = Self;

    fn lerp(self, other: Self, t: u32) -> Self {
        Self(self.0.lerp(other.0, t))
    }

    #[inline(always)]
    fn on_screen(self, _: InverseW) -> Self {
        self
    }

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        Self::of_corner(corner)
    }
}

impl Interpolate for Weights {
    const ZERO: Self = Self::VERTEX;
    const DIFFERS_BY_TRIANGLE: bool = true;

    type Field = <Pair as Interpolate>::Field;
    type Walk = <Pair as Interpolate>::Walk;
    type Rest = <Pair as Interpolate>::Rest;
    type Sample = Pair;

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Self::Field {
        Pair::plane(setup, quick, corners.map(|corner| corner.0))
    }

    #[inline(always)]
    fn whole(field: &Self::Field, at: [i32; 2], pixels: usize) -> Option<Piece<Self::Walk>> {
        Pair::whole(field, at, pixels)
    }

    #[inline(always)]
    fn walk(field: &Self::Field, at: [i32; 2], pixels: usize) -> (Piece<Self::Walk>, Self::Rest) {
        Pair::walk(field, at, pixels)
    }

    #[inline(always)]
    fn sample(value: Self::Walk) -> Pair {
        Pair::sample(value)
    }

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        Self::of_corner(corner)
    }
}

/// From Q0.32 to a component, which has 29 bits.
const COMPONENT: u32 = 3;
/// The component of 1.
const ONE: i32 = (1 << (32 - COMPONENT)) - 1;
/// The bits of `u32` that are stepped behind its own.
const STEPPED: u32 = 18;

/// A tolerance counts in units of Q0.16.
impl Components for Weights {
    type Each<T: Copy + Debug> = [T; 2];

    const UNIT_BITS: [u32; 2] = [16 - COMPONENT; 2];
    const STEP_DIGITS: u32 = 16;
    const ZEROS: [i32; 2] = [0; 2];
    const WIDE_ZEROS: [u64; 2] = [0; 2];
    const HAS_EXACT_GRADIENTS: bool = true;

    #[inline(always)]
    fn each<T: Copy + Debug>(value: T) -> [T; 2] {
        [value; 2]
    }

    #[inline(always)]
    fn components(self) -> [i32; 2] {
        self.0.map(|weight| (weight >> COMPONENT).cast_signed())
    }

    /// Within 0 and 1: what a division is off must not wrap.
    #[inline(always)]
    fn walk_from(components: [i32; 2]) -> [u64; 2] {
        components.map(|component| {
            u64::from(component.clamp(0, ONE).cast_unsigned()) << (STEPPED + COMPONENT)
        })
    }

    #[inline(always)]
    fn step_from(changes: [i32; 2]) -> [u64; 2] {
        changes.map(|change| (i64::from(change) << (STEPPED + COMPONENT)).cast_unsigned())
    }
}
