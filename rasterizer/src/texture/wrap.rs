//! What lies beyond the borders of a texture.
//!
//! A coordinate is in Q8.24 repeats: 1 is one side of the texture. Everything rounds downwards, so
//! that negative coordinates follow the same rule as positive ones.

/// The bits of a coordinate behind the point.
pub(super) const FRACTION_BITS: u32 = 24;

/// A whole repeat.
const ONE: i32 = 1 << FRACTION_BITS;

/// The longest side of a texture, in texels.
pub const MAX_SIDE: usize = 1024;

/// A side of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// In texels, 1 to [`MAX_SIDE`].
    length: u16,
    /// The bits of the largest texel's number: the least that 2<sup>bits</sup> is not below the
    /// length.
    bits: u16,
}

impl Side {
    /// Of this many texels: at least 1 and at most [`MAX_SIDE`].
    #[must_use]
    pub const fn new(length: usize) -> Self {
        let length = if length > MAX_SIDE { MAX_SIDE as u16 } else { length as u16 };
        let length = if length == 0 { 1 } else { length };
        Self { length, bits: (16 - (length - 1).leading_zeros()) as u16 }
    }

    /// Its length in texels.
    #[inline(always)]
    #[must_use]
    pub const fn length(self) -> usize {
        self.length as usize
    }

    #[inline(always)]
    pub(super) const fn bits(self) -> u32 {
        self.bits as u32
    }

    /// The largest number of a texel. For powers of two it is also the mask of all numbers.
    #[inline(always)]
    const fn last(self) -> i32 {
        self.length as i32 - 1
    }
}

/// Two neighbouring texels along an axis, between whose centres a coordinate lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The numbers of both along the axis, from 0.
    pub texels: [usize; 2],
    /// The way from the first centre to the second, in units of 2<sup>-`bits`</sup>, below 1.
    pub fraction: u32,
}

/// How a texture goes on beyond its borders along one axis: [`Repeat`], [`Mirror`] or [`Clamp`].
///
/// Coordinates are in Q8.24 repeats.
pub trait Wrap: Copy + core::fmt::Debug + sealed::Sealed {
    /// Whether sides may be of any length. Otherwise they are powers of two.
    const ANY_LENGTH: bool;

    /// Whether only the fraction of a coordinate matters.
    const IS_PERIODIC: bool;

    /// Returns the texel that the coordinate lies on, below the side's length: texel i covers i /
    /// length <= coordinate < (i + 1) / length.
    fn texel(coordinate: i32, side: Side) -> usize;

    /// Returns the texels between whose centres the coordinate lies, with `bits` binary digits of
    /// the fraction, 1 to 8, rounded to the nearest: the first centre is at (i + 1/2) / length.
    fn pair(coordinate: i32, side: Side, bits: u32) -> Pair;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Repeat {}
    impl Sealed for super::Mirror {}
    impl Sealed for super::Clamp {}
}

/// The texture is repeated. Its side is a power of two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Repeat;

/// The texture is repeated, every other time in reverse. Its side is a power of two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Mirror;

/// The texels on the border go on for ever. The side can be of any length.
///
/// If it is not a power of two and over 256 texels, the border between two texels is within 1/4096
/// texel of its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Clamp;

/// The number of the first of two neighbouring texels along a side of a power of two, and the
/// fraction; the number is negative or too large beyond the borders.
#[inline(always)]
const fn unwrapped_pair(coordinate: i32, side: Side, bits: u32) -> (i32, u32) {
    let texel = FRACTION_BITS - side.bits();
    // Half a texel back, to count from centres, and half a unit of the fraction on, to round it.
    let moved = coordinate.wrapping_sub(1 << (texel - 1)).wrapping_add(1 << (texel - 1 - bits));
    (moved >> texel, (moved >> (texel - bits)) as u32 & ((1 << bits) - 1))
}

impl Wrap for Repeat {
    const ANY_LENGTH: bool = false;
    const IS_PERIODIC: bool = true;

    #[inline(always)]
    fn texel(coordinate: i32, side: Side) -> usize {
        ((coordinate >> (FRACTION_BITS - side.bits())) & side.last()) as usize
    }

    #[inline(always)]
    fn pair(coordinate: i32, side: Side, bits: u32) -> Pair {
        let (first, fraction) = unwrapped_pair(coordinate, side, bits);
        let texel = |number: i32| (number & side.last()) as usize;
        Pair { texels: [texel(first), texel(first + 1)], fraction }
    }
}

impl Wrap for Mirror {
    const ANY_LENGTH: bool = false;
    const IS_PERIODIC: bool = false;

    #[inline(always)]
    fn texel(coordinate: i32, side: Side) -> usize {
        // All ones in an odd repeat, where it turns the fraction about.
        let turn = (coordinate << (31 - FRACTION_BITS)) >> 31;
        Repeat::texel(coordinate ^ turn, side)
    }

    #[inline(always)]
    fn pair(coordinate: i32, side: Side, bits: u32) -> Pair {
        let (first, fraction) = unwrapped_pair(coordinate, side, bits);
        let texel = |number: i32| {
            let turn = -((number >> side.bits()) & 1);
            ((number ^ turn) & side.last()) as usize
        };
        Pair { texels: [texel(first), texel(first + 1)], fraction }
    }
}

impl Wrap for Clamp {
    const ANY_LENGTH: bool = true;
    const IS_PERIODIC: bool = false;

    #[inline(always)]
    fn texel(coordinate: i32, side: Side) -> usize {
        // So few digits less that the product fits 32 bits.
        let drop = side.bits().saturating_sub(32 - FRACTION_BITS);
        let within = (coordinate.clamp(0, ONE - 1) >> drop) as u32;
        ((within * u32::from(side.length)) >> (FRACTION_BITS - drop)) as usize
    }

    #[inline(always)]
    fn pair(coordinate: i32, side: Side, bits: u32) -> Pair {
        // So few digits less that the product fits 31 bits.
        let drop = side.bits().saturating_sub(31 - FRACTION_BITS);
        let digits = FRACTION_BITS - drop;
        let within = (coordinate.clamp(0, ONE - 1) >> drop) * i32::from(side.length);
        // From centres, with the fraction rounded: at least -1/2.
        let moved = within - (1 << (digits - 1)) + (1 << (digits - 1 - bits));
        let first = moved >> digits;
        Pair {
            texels: [first.max(0) as usize, (first + 1).min(side.last()) as usize],
            fraction: (moved >> (digits - bits)) as u32 & ((1 << bits) - 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// The definition, on the exact coordinate.
    fn expected<X: Wrap>(number: i64, length: i64) -> usize {
        let number = if X::ANY_LENGTH {
            number.clamp(0, length - 1)
        } else if X::IS_PERIODIC {
            number.rem_euclid(length)
        } else {
            let number = number.rem_euclid(2 * length);
            number.min(2 * length - 1 - number)
        };
        number as usize
    }

    /// `coordinate` * `length`, rounded down, and what was cut off, in units of 2^-24.
    fn scaled(coordinate: i32, length: usize) -> (i64, i64) {
        let texels = i64::from(coordinate) * length as i64;
        (texels >> 24, texels & 0xFF_FFFF)
    }

    fn check<X: Wrap>(coordinate: i32, length: usize) {
        let side = Side::new(length);
        let case = std::format!("{coordinate} of {length}");
        // Within 1/4096 texel for sides that the product has no room for.
        let loss = if length > 256 && !length.is_power_of_two() { 1 << 12 } else { 0 };
        let (number, cut) = scaled(coordinate, length);
        let texel = X::texel(coordinate, side);
        let is_next = cut < loss && texel == expected::<X>(number - 1, length as i64);
        assert!(texel == expected::<X>(number, length as i64) || is_next, "{case}: {texel}");

        for bits in [4, 8] {
            let unit = 1 << (24 - bits);
            let pair = X::pair(coordinate, side, bits);
            // The centres of texels, with a rounded fraction.
            let clamped = if X::ANY_LENGTH { coordinate.clamp(0, ONE - 1) } else { coordinate };
            let texels = i64::from(clamped) * length as i64 - (1 << 23) + unit / 2;
            // Up to 1/2048 texel is lost in the product of long sides.
            let loss = if X::ANY_LENGTH && length > 128 { 1 << 13 } else { 0 };
            let is_right = [texels, texels - loss].into_iter().any(|texels| {
                let (first, fraction) = (texels >> 24, (texels & 0xFF_FFFF) / unit);
                let wanted = [first, first + 1].map(|number| expected::<X>(number, length as i64));
                pair == Pair { texels: wanted, fraction: fraction as u32 }
            });
            assert!(is_right, "{case}, {bits} bits: {pair:?}");
        }
    }

    #[test]
    fn texels_follow_the_definition() {
        let mut random = Random::new(7);
        for length in [1usize, 2, 3, 4, 5, 7, 8, 16, 48, 100, 128, 255, 256, 257, 640, 1000, 1024] {
            let texel = ONE / length as i32;
            let seams = [-64, -2, -1, 0, 1, 2, 63].into_iter().flat_map(|repeat| {
                let corner = repeat * ONE;
                [0, texel / 2, texel, 3 * texel / 2, -texel / 2, -texel, -3 * texel / 2]
                    .into_iter()
                    .flat_map(move |offset| (-2..=2).map(move |bit| corner + offset + bit))
            });
            let anywhere = (0..20_000).map(|_| (random.bits() as i32) >> 1);
            let narrow = seams.chain(anywhere).filter(|c| c.abs() <= 64 * ONE);
            for coordinate in narrow {
                check::<Clamp>(coordinate, length);
                if length.is_power_of_two() {
                    check::<Repeat>(coordinate, length);
                    check::<Mirror>(coordinate, length);
                }
            }
        }
    }

    /// By hand: four texels, seen from a texel before the border to a texel after the next one.
    #[test]
    fn borders_repeat_mirror_and_clamp() {
        let side = Side::new(4);
        let row = |texel: fn(i32, Side) -> usize| -> std::vec::Vec<usize> {
            (-6..10).map(|quarter| texel(quarter * (ONE / 4), side)).collect()
        };
        assert_eq!(row(Repeat::texel), [2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1]);
        assert_eq!(row(Mirror::texel), [2, 3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0, 1]);
        assert_eq!(row(Clamp::texel), [0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3, 3]);
    }

    /// The seam at 0: at -1/2 texel the last centre, at 0 half-way, at 1/2 texel the first centre.
    #[test]
    fn a_seam_is_met_in_its_middle() {
        let side = Side::new(8);
        let half = ONE / 16;
        let pair = |texels, fraction| Pair { texels, fraction };
        for (coordinate, repeat, mirror, clamp) in [
            (-half, pair([7, 0], 0), pair([0, 0], 0), pair([0, 0], 8)),
            (0, pair([7, 0], 8), pair([0, 0], 8), pair([0, 0], 8)),
            (half, pair([0, 1], 0), pair([0, 1], 0), pair([0, 1], 0)),
            (ONE, pair([7, 0], 8), pair([7, 7], 8), pair([7, 7], 8)),
        ] {
            assert_eq!(Repeat::pair(coordinate, side, 4), repeat, "{coordinate}");
            assert_eq!(Mirror::pair(coordinate, side, 4), mirror, "{coordinate}");
            assert_eq!(Clamp::pair(coordinate, side, 4), clamp, "{coordinate}");
        }
    }

    #[test]
    fn sides_know_their_bits() {
        for (length, bits) in [(1, 0), (2, 1), (3, 2), (4, 2), (5, 3), (1000, 10), (1024, 10)] {
            assert_eq!(Side::new(length).bits(), bits, "{length}");
            assert_eq!(Side::new(length).length(), length);
        }
        assert_eq!(Side::new(0), Side::new(1));
    }
}
