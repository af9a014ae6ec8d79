//! Depth as a floating-point number of 16 bits.
//!
//! # On the way to a pixel
//!
//! The values of a triangle's corners are scaled by one power of two, so that the largest of them
//! uses all bits of an integer (block floating point), and are interpolated as integers are. At a
//! pixel the leading zeros of the value tell the exponent. Depth is linear on the screen, so that
//! half the pixels or more have none, and three quarters or more have one at most. Where there is
//! no instruction that counts them, these two octaves come first, with constant shifts.
//!
//! * If the corners' exponents differ by 4 at most, all their bits fit 16 bits. They are stepped
//!   like an attribute of 16 bits, within 1/4 + 3/2 n / 2^16 units of it over n pixels, plus half a
//!   unit ([`plane`](super::plane)). A unit is 1/16 of a step of the format in the octave of the
//!   largest, and a whole step four octaves below it.
//! * Otherwise, and in slivers, gradients are divided exactly, and the value is stepped with 32
//!   bits in all: half a last bit for each of n columns and rows from the anchor, and another half.
//!   A step of the format is over 2^-12 of a value, so this is below a step for depths that the
//!   nearest corner's is at most 2^20 / (n + 1) times: 1,869 for a triangle that fills 320 x 240
//!   pixels, 256 for the largest of the guard band.
//!
//! No value may reach 0, from where it would wrap to the nearest depth of all. So a corner of less
//! than n + 2 last bits, over 2^31 / (n + 2) times farther away than the nearest, is drawn at that
//! many; the factors above are then a third. For the same reason a vertex has at least one exponent
//! below it.

use bytemuck::{Pod, Zeroable};
use fixed::types::U0F32;

use super::{DepthFormat, Interpolate, Piece, Plane, QuickGradients, Step, TriangleSetup, Whole};
use crate::numbers::{HAS_LEADING_ZEROS, IS_NARROW, Subpixel, few_leading_zeros, normalised};

/// Depth as a floating-point number of 16 bits, with the same relative resolution at every
/// distance: for scenes that reach far, in half the memory of `u32`.
///
/// It has no sign, 5 bits of exponent and 11 of mantissa, from the most significant bit. Exponent e
/// and mantissa m stand for (1 + m / 2<sup>11</sup>) 2<sup>e - 32</sup>, or m / 2<sup>42</sup> if e
/// is 0, as with IEEE 754's subnormal numbers. So depths compare like their bits, as integers.
/// Vertices are rounded to the nearest, from 2<sup>-30</sup> to 1, which is stored as 1 -
/// 2<sup>-12</sup>; pixels are truncated.
///
/// # Resolution
///
/// Two neighbouring depths differ by at most 2<sup>-11</sup> of their value, near / w, and so do
/// their distances: at w a step is at most w / 2,048. Two planes parallel to the screen are told
/// apart if they are that far from each other. Planes of any slope are if it is three times as far:
/// one step for the vertices of both, one for their pixels, and one between them. So far apart two
/// planes parallel to the screen have to be, by the format alone:
///
/// | near | up to w | `u16` | `FloatDepth` | `u32` |
/// |---|---|---|---|---|
/// | 10 | 1,000 | 1.5 | 0.49 | 0.000024 |
/// | 1 | 5,000 | 390 | 2.4 | 0.006 |
/// | 0.1 | 1,000 | 135 | 0.49 | 0.0024 |
/// | 0.1 | 5,000 | never | 2.4 | 0.06 |
///
/// A unit of `u16` is w<sup>2</sup> / (2<sup>16</sup> near), so `u16` is the finer one up to 32
/// times the near plane's distance. A vertex gets its depth with 32 bits behind the point: beyond
/// 2<sup>20</sup> times that distance there are fewer than a step needs.
///
/// A triangle whose nearest point is over a thousand times nearer than its farthest, such as a
/// floor up to the horizon, loses up to n / 2<sup>32</sup> of its *nearest* depth over n pixels.
/// Cut it into several to keep the resolution at its far end.
///
/// Near / w, reversed so that 0 is far away, in a floating-point format: the loss of the one makes
/// up for that of the other (Lapidous and Jiao, *Optimal Depth Buffer for Low-Cost Graphics
/// Hardware*, 1999).
///
/// ```
/// use rasterizer::attribute::{DepthFormat, FloatDepth};
///
/// let at = |w: u32| FloatDepth::from_fraction(u32::MAX / w);
/// // Two planes, ten thousand near distances away:
/// assert!(at(10_000).is_nearer(at(10_010)));
/// assert_eq!(u16::from_fraction(u32::MAX / 10_000), u16::from_fraction(u32::MAX / 10_010));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Pod, Zeroable)]
#[repr(transparent)]
pub struct FloatDepth(u16);

const MANTISSA_BITS: u32 = 11;

/// The bits by which the value of a mantissa with its leading one is shifted to fill a word.
const UP: u32 = 32 - 1 - MANTISSA_BITS;

/// The exponents of a triangle differ by at most this if no bit of a corner is lost in 16.
const QUICK_SPREAD: u32 = 16 - 1 - MANTISSA_BITS;

/// The least exponent of a corner, so that there is another below it.
const LEAST_EXPONENT: u32 = 2;

impl FloatDepth {
    /// Infinitely far away, with no bit set: what a buffer is cleared to.
    pub const FAR: Self = Self(0);

    /// From its exponent and its mantissa.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    /// Its exponent and its mantissa.
    #[must_use]
    pub const fn to_bits(self) -> u16 {
        self.0
    }

    #[inline(always)]
    const fn exponent(self) -> u32 {
        self.0 as u32 >> MANTISSA_BITS
    }

    /// The mantissa with its leading one as the most significant bit, for exponents over 0.
    #[inline(always)]
    const fn significand(self) -> u32 {
        (self.0 as u32) << UP | 1 << 31
    }
}

/// The bits: they order depths as depths are ordered.
impl From<FloatDepth> for u32 {
    fn from(depth: FloatDepth) -> Self {
        depth.0.into()
    }
}

impl DepthFormat for FloatDepth {
    #[inline(always)]
    fn from_fraction(q32: u32) -> Self {
        let (significand, zeros) = normalised(q32.max(1 << LEAST_EXPONENT));
        // From 2^11 to 2^12: the leading one adds 1 to the exponent, and so does what rounding
        // carries. Up to 2^16.
        let rounded = ((significand >> (UP - 1)) + 1) >> 1;
        let bits = ((30 - zeros) << MANTISSA_BITS) + rounded;
        Self((bits - (bits >> 16)) as u16)
    }

    #[inline(always)]
    fn to_fraction(self) -> U0F32 {
        let exponent = self.exponent();
        let bits = if exponent == 0 {
            u32::from(self.0) >> (MANTISSA_BITS - 1)
        } else {
            self.significand() >> (31 - exponent)
        };
        U0F32::from_bits(bits)
    }

    #[inline(always)]
    fn at(block: Block) -> Self {
        let Block { value, scale } = block;
        let bits = if HAS_LEADING_ZEROS {
            block.normalised(value.leading_zeros())
        } else if value.cast_signed() < 0 {
            scale.wrapping_add(value >> UP)
        } else if (value << 1).cast_signed() < 0 {
            block.normalised(1)
        } else if IS_NARROW {
            far(value, scale)
        } else {
            block.normalised(few_leading_zeros(value))
        };
        Self(bits as u16)
    }

    #[inline(always)]
    fn is_nearer(self, stored: Self) -> bool {
        self > stored
    }
}

/// A number in units that a whole triangle shares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// In 2^-32 of the power of two above the nearest corner.
    value: u32,
    /// What is added to a mantissa with its leading one in place of an exponent, if that one is the
    /// most significant bit of `value`.
    scale: u32,
}

impl Block {
    /// The bits of a depth whose value has this many leading zeros.
    #[inline(always)]
    const fn normalised(self, zeros: u32) -> u32 {
        let significand = self.value.unbounded_shl(zeros);
        self.scale.wrapping_add(significand >> UP).wrapping_sub(zeros << MANTISSA_BITS)
    }

    #[inline(always)]
    const fn plane(plane: Plane<u32>, scale: u32) -> Plane<Self> {
        Plane {
            anchor: Self { value: plane.anchor, scale },
            per_column: Self { value: plane.per_column, scale },
            per_row: Self { value: plane.per_row, scale },
        }
    }
}

/// The bits of a depth two octaves or more below the nearest corner's.
// codegen: not inlined, because it needs registers that a loop over pixels has no other use for.
#[inline(never)]
const fn far(value: u32, scale: u32) -> u32 {
    Block { value, scale }.normalised(few_leading_zeros(value))
}

/// In the units of the first operand.
impl Step for Block {
    const ZERO: Self = Self { value: 0, scale: 0 };

    #[inline(always)]
    fn wrapping_add(self, change: Self) -> Self {
        Self { value: self.value.wrapping_add(change.value), ..self }
    }

    #[inline(always)]
    fn wrapping_mul(self, count: i32) -> Self {
        Self { value: self.value.wrapping_mul(count as u32), ..self }
    }
}

impl Interpolate for FloatDepth {
    const ZERO: Self = Self::FAR;

    type Field = Plane<Block>;
    type Walk = Block;
    type Rest = Whole<Block>;
    type Sample = Self;

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<Block> {
        let [a, b, c] = corners;
        let (nearest, farthest) = (a.max(b).max(c).exponent(), a.min(b).min(c).exponent());
        if let Some(quick) = quick
            && nearest - farthest <= QUICK_SPREAD
            && farthest >= LEAST_EXPONENT
        {
            let values = corners
                .map(|corner| (corner.significand() >> (16 + nearest - corner.exponent())) as u16);
            Block::plane(setup.quick_plane(quick, values), scale(nearest))
        } else {
            exact_plane(setup, corners, nearest)
        }
    }

    #[inline(always)]
    fn whole(field: &Plane<Block>, at: [i32; 2], pixels: usize) -> Option<Piece<Block>> {
        Some(field.piece(at, pixels))
    }

    #[inline(always)]
    fn walk(field: &Plane<Block>, at: [i32; 2], pixels: usize) -> (Piece<Block>, Whole<Block>) {
        (field.piece(at, pixels), core::iter::empty())
    }

    #[inline(always)]
    fn sample(value: Block) -> Self {
        Self::at(value)
    }
}

/// The leading one of a mantissa adds 1 to the exponent.
#[inline(always)]
const fn scale(exponent: u32) -> u32 {
    exponent.wrapping_sub(1) << MANTISSA_BITS
}

/// The plane in 32 bits, with gradients divided exactly and rounded to the nearest.
#[inline(never)]
fn exact_plane<S: Subpixel>(
    setup: &TriangleSetup<S>,
    corners: [FloatDepth; 3],
    nearest: u32,
) -> Plane<Block> {
    // Twice what the steps may be off, so that a value is at most an octave below its corners.
    let least = setup.reach() + 2;
    // Only vertices that a user makes can be less.
    let nearest = nearest.max(LEAST_EXPONENT);
    let values = corners.map(|corner| {
        let corner = corner.max(FloatDepth((LEAST_EXPONENT << MANTISSA_BITS) as u16));
        (corner.significand() >> (nearest - corner.exponent())).max(least)
    });
    let wide = setup.exact_wide_plane(values);
    let rounded = |gradient: u64| (gradient.wrapping_add(1 << 17) >> 18) as u32;
    let plane = Plane {
        // Half a last bit above it.
        anchor: (wide.anchor >> 18) as u32,
        per_column: rounded(wide.per_column),
        per_row: rounded(wide.per_row),
    };
    Block::plane(plane, scale(nearest))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value of bits by the definition.
    fn value(bits: u32) -> f64 {
        let (exponent, mantissa) = (bits >> 11, f64::from(bits & 2047));
        if exponent == 0 {
            mantissa / 2f64.powi(42)
        } else {
            (1.0 + mantissa / 2048.0) * 2f64.powi(exponent as i32 - 32)
        }
    }

    #[test]
    fn all_depths_are_ordered_and_are_fractions_again() {
        let mut before = None;
        for bits in 0..=u16::MAX {
            let (depth, want) = (FloatDepth::from_bits(bits), value(bits.into()));
            let fraction = depth.to_fraction().to_bits();
            assert_eq!(fraction, (want * 2f64.powi(32)) as u32, "{bits:#06x}");
            assert!(before.is_none_or(|(lower, less)| depth.is_nearer(lower) && less < want));
            // From here on all bits of a mantissa are in the fraction.
            if bits >= 11 << 11 {
                assert_eq!(FloatDepth::from_fraction(fraction), depth);
            }
            before = Some((depth, want));
        }
    }

    #[test]
    fn vertices_are_rounded_to_the_nearest() {
        assert_eq!(FloatDepth::from_fraction(u32::MAX).to_bits(), u16::MAX);
        assert_eq!(FloatDepth::from_fraction(1 << 31).to_bits(), 31 << 11);
        for least in 0..=4 {
            assert_eq!(FloatDepth::from_fraction(least).to_bits(), 2 << 11);
        }
        // From here on the middle between two neighbours is a fraction.
        for bits in 12 << 11..u32::from(u16::MAX) {
            let middle = ((value(bits) + value(bits + 1)) / 2.0 * 2f64.powi(32)) as u32;
            let rounded = [middle - 1, middle].map(|q32| FloatDepth::from_fraction(q32).to_bits());
            assert_eq!(rounded.map(u32::from), [bits, bits + 1]);
        }
    }

    /// At every depth and just before it, in the units of every triangle that can have it.
    #[test]
    fn pixels_are_truncated() {
        for nearest in LEAST_EXPONENT..32 {
            let at = |value| u32::from(FloatDepth::at(Block { value, scale: scale(nearest) }));
            for bits in 1 << 11..(nearest + 1) << 11 {
                let exact = value(bits) * 2f64.powi(63 - nearest as i32);
                // The first value at or beyond this depth, and the last before.
                let first = exact.ceil() as u32;
                let [below, above] = [first - 1, first].map(at);
                assert!(below < bits && bits <= above, "{nearest} {bits:#06x}: {below} {above}");
                // No depth is left out where 12 bits are there to tell it.
                if first > 1 << 12 {
                    assert_eq!([below, above], [bits - 1, bits], "{nearest}");
                }
            }
        }
    }

    /// Whether two planes parallel to the screen, one further away by `apart` of the distance of
    /// the other, are told apart wherever that is `from` to `to` away.
    fn resolves<D: DepthFormat>(
        near: f64,
        [from, to]: [f64; 2],
        apart: impl Fn(f64) -> f64,
    ) -> bool {
        let depth = |w: f64| D::from_fraction((near / w * 2f64.powi(32)) as u32);
        (0..20_000)
            .map(|k| from + (to - from) * f64::from(k) / 20_000.0)
            .all(|w| depth(w).is_nearer(depth(w + apart(w))))
    }

    #[test]
    fn a_2048th_of_the_distance_is_told_apart_at_every_distance() {
        for near in [10.0, 1.0, 0.1] {
            let mut w = 8.0 * near;
            while w < 10_000.0 {
                let octave = [w, 2.0 * w];
                // A vertex has 32 bits behind the point.
                let bit = |w: f64| w * w / near / 2f64.powi(32);
                let resolves = |part| resolves::<FloatDepth>(near, octave, |w| w / part + bit(w));
                assert!(resolves(2045.0), "{near} {w}");
                assert!(!resolves(2070.0) || w > 3e3 * near, "{near} {w}");
                w *= 2.0;
            }
        }
    }

    /// The other columns of the table at [`FloatDepth`].
    #[test]
    fn planes_as_far_apart_as_stated_are_told_apart_by_the_other_formats() {
        for (near, w, coarse, fine) in [
            (10.0, 1000.0, Some(1.54), 0.000_024),
            (1.0, 5000.0, Some(389.0), 0.006),
            (0.1, 1000.0, Some(135.0), 0.0024),
            (0.1, 5000.0, None, 0.06),
        ] {
            let about = [0.85 * w, w];
            assert!(resolves::<u32>(near, about, |_| fine), "{near} {w}");
            assert!(!resolves::<u32>(near, about, |_| fine * 0.9), "{near} {w}");
            match coarse {
                Some(coarse) => {
                    assert!(resolves::<u16>(near, about, |_| coarse), "{near} {w}");
                    assert!(!resolves::<u16>(near, about, |_| coarse * 0.9), "{near} {w}");
                }
                None => assert!(!resolves::<u16>(near, about, |_| 1e9), "{near} {w}"),
            }
        }
    }
}
