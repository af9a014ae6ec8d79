//! Numbers that can be divided by 1 / w.

use core::fmt::Debug;

use super::{Interpolate, Plane};

/// A number, or several, that can be interpolated in perspective: integers of up to 30 bits, all of
/// which are divided by the same 1 / w.
///
/// As it is, it is linear on the screen; [`PerspectiveCorrect`](super::PerspectiveCorrect) makes it
/// linear in space.
pub trait Components: Interpolate + Debug {
    /// One `T` for each number.
    type Each<T: Copy + Debug>: Copy + Debug + AsRef<[T]> + AsMut<[T]>;

    /// How many binary digits a component has behind the point of what a tolerance counts in: a
    /// unit of a varying, a texel of a texture.
    const UNIT_BITS: Self::Each<u32>;

    /// The least number of binary digits that a unit has in what is stepped from pixel to pixel.
    const STEP_DIGITS: u32;

    /// Zero for each number.
    const ZEROS: Self::Each<i32>;
    /// Zero for each number, of 64 bits.
    const WIDE_ZEROS: Self::Each<u64>;

    /// Whether gradients are divided exactly for every triangle. By the reciprocal, those of small
    /// triangles are within 2<sup>-26</sup> of the largest one that a triangle of this extent and
    /// area can have.
    const HAS_EXACT_GRADIENTS: bool = false;

    /// Whether a shader reads the 1 / w of [`Corrected`](super::Corrected).
    const READS_INVERSE_W: bool = false;

    /// The same `T` for each number.
    fn each<T: Copy + Debug>(value: T) -> Self::Each<T>;

    /// The numbers as integers from -2<sup>29</sup> to 2<sup>29</sup>.
    fn components(self) -> Self::Each<i32>;

    /// What is stepped from pixel to pixel, from components modulo 2<sup>32</sup>.
    fn walk_from(components: Self::Each<i32>) -> Self::Walk;

    /// A step of it, from the change of each component from pixel to pixel.
    fn step_from(changes: Self::Each<i32>) -> Self::Walk;

    /// The plane of what is stepped, if all covered pixels lie within so few columns and rows of
    /// the anchor, together, that it is precise enough.
    #[doc(hidden)]
    #[inline(always)]
    fn short_plane(_: &Self::Field, _reach: u32) -> Option<Plane<Self::Walk>> {
        None
    }
}

/// The binary digits that a component has behind a number of 16 bits.
const NARROW: u32 = 13;

/// From a component to Q16.
#[inline(always)]
const fn to_q16(component: i32) -> u32 {
    (component << (16 - NARROW)) as u32
}

/// Half a unit above the value, so that its integer part is rounded.
const HALF: u32 = 1 << 15;

macro_rules! narrow {
    ($integer:ty, $zero:expr) => {
        impl Components for $integer {
            type Each<T: Copy + Debug> = [T; 1];

            const UNIT_BITS: [u32; 1] = [NARROW];
            const STEP_DIGITS: u32 = 16;
            const ZEROS: [i32; 1] = [0];
            const WIDE_ZEROS: [u64; 1] = [0];

            #[inline(always)]
            fn each<T: Copy + Debug>(value: T) -> [T; 1] {
                [value]
            }

            #[inline(always)]
            fn components(self) -> [i32; 1] {
                [i32::from(self) << NARROW]
            }

            #[inline(always)]
            fn walk_from([component]: [i32; 1]) -> u32 {
                to_q16(component).wrapping_add($zero + HALF)
            }

            #[inline(always)]
            fn step_from([change]: [i32; 1]) -> u32 {
                to_q16(change)
            }
        }

        impl<const N: usize> Components for [$integer; N] {
            type Each<T: Copy + Debug> = [T; N];

            const UNIT_BITS: [u32; N] = [NARROW; N];
            const STEP_DIGITS: u32 = 16;
            const ZEROS: [i32; N] = [0; N];
            const WIDE_ZEROS: [u64; N] = [0; N];

            #[inline(always)]
            fn each<T: Copy + Debug>(value: T) -> [T; N] {
                [value; N]
            }

            #[inline(always)]
            fn components(self) -> [i32; N] {
                self.map(|number| i32::from(number) << NARROW)
            }

            #[inline(always)]
            fn walk_from(components: [i32; N]) -> [u32; N] {
                components.map(|component| to_q16(component).wrapping_add($zero + HALF))
            }

            #[inline(always)]
            fn step_from(changes: [i32; N]) -> [u32; N] {
                changes.map(to_q16)
            }
        }
    };
}

narrow!(u16, 0);
narrow!(i16, 0x8000_0000);
