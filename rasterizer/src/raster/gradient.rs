//! Attributes as planes over the screen.
//!
//! With the differences (dx1, dy1, da1) and (dx2, dy2, da2) from one corner to the others and the
//! doubled area A = dx1 dy2 - dx2 dy1, an attribute a changes along a row and down the rows by
//!
//! ```text
//!   da/dx = (da1 dy2 - da2 dy1) / A        da/dy = (da2 dx1 - da1 dx2) / A
//! ```
//!
//! The numerators are twice the area of the triangle that one sees with a in the place of x or y,
//! so that they are bounded by the range of a times the triangle's height or width. They are exact,
//! and the quotients are worked out with one reciprocal a triangle.
//!
//! # Error
//!
//! An attribute of 16 bits is stepped with 16 more bits behind the point. Over a triangle that
//! spans n pixels in x and y together its value at a centre is within 1/4 + 3/2 n / 2^16 + 2^S /
//! 2^16 units of the exact plane, before it is rounded to the nearest: the reciprocal's 27 bits are
//! enough for that unless a triangle is thin and steep, and then the gradient is divided exactly.
//! An attribute of 32 bits is stepped with 18 more bits, always divided exactly: n / 2^18 units.
//!
//! Gradients of slivers can be astronomical. Steps wrap modulo 2^32, and at a covered centre the
//! value is back between those of the corners, so that it comes out right: it is sampled there and
//! nowhere else.

use core::marker::PhantomData;

use fixed::types::U16F16;

use crate::{
    geometry::{NoDepth, Subpixel},
    numbers::{Divisor, Reciprocal, leading_zeros, mul_high},
};

/// A running value that is stepped from pixel to pixel, modulo its width.
pub trait Step: Copy {
    /// Nothing to add.
    const ZERO: Self;

    /// This and `change`.
    #[must_use]
    fn plus(self, change: Self) -> Self;

    /// `count` times this.
    #[must_use]
    fn times(self, count: i32) -> Self;
}

impl Step for u32 {
    const ZERO: Self = 0;

    #[inline(always)]
    fn plus(self, change: Self) -> Self {
        self.wrapping_add(change)
    }

    #[inline(always)]
    fn times(self, count: i32) -> Self {
        self.wrapping_mul(count as Self)
    }
}

impl Step for u64 {
    const ZERO: Self = 0;

    #[inline(always)]
    fn plus(self, change: Self) -> Self {
        self.wrapping_add(change)
    }

    #[inline(always)]
    fn times(self, count: i32) -> Self {
        self.wrapping_mul(i64::from(count) as Self)
    }
}

impl Step for () {
    const ZERO: Self = ();

    #[inline(always)]
    fn plus(self, (): Self) -> Self {}

    #[inline(always)]
    fn times(self, _: i32) -> Self {}
}

impl<T: Step, const N: usize> Step for [T; N] {
    const ZERO: Self = [T::ZERO; N];

    #[inline(always)]
    fn plus(self, change: Self) -> Self {
        core::array::from_fn(|i| self[i].plus(change[i]))
    }

    #[inline(always)]
    fn times(self, count: i32) -> Self {
        self.map(|a| a.times(count))
    }
}

/// A linear function of the pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plane<T> {
    /// The value at the centre of the anchor pixel.
    pub anchor: T,
    /// The change from a pixel to the one on its right.
    pub per_column: T,
    /// The change from a pixel to the one below it.
    pub per_row: T,
}

impl<T: Step> Plane<T> {
    /// The value at the centre of the pixel so many columns and rows from the anchor.
    #[inline(always)]
    pub fn at(&self, columns: i32, rows: i32) -> T {
        let row = self.anchor.plus(self.per_row.times(rows));
        row.plus(self.per_column.times(columns))
    }

    /// The same function of addresses and rows, where a row has `pitch` addresses and its first
    /// pixel the address 0.
    #[inline(always)]
    pub(super) fn over_addresses(&self, [columns, rows]: [i32; 2], pitch: i32) -> Self {
        Self {
            anchor: self.at(columns, rows),
            per_column: self.per_column,
            per_row: self.per_row.plus(self.per_column.times(-pitch)),
        }
    }
}

/// What can be interpolated over a triangle: an attribute, or an array of them.
pub trait Interpolate: Copy {
    /// The running value.
    type Accumulator: Step;
    /// What a shader sees of it.
    type Sample: Copy;

    /// The plane through the values at a triangle's corners; without `quick` its gradients are
    /// divided exactly.
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<Self::Accumulator>;

    /// The value as it is stored, rounded to the nearest.
    fn value(accumulator: Self::Accumulator) -> Self;

    /// The value as a shader sees it.
    fn sample(accumulator: Self::Accumulator) -> Self::Sample;
}

/// What the planes of all attributes of a triangle share.
#[derive(Clone, Copy, Debug)]
pub struct TriangleSetup<S> {
    /// From the first corner to the second and the third, in sub-pixels.
    dx: [i32; 2],
    dy: [i32; 2],
    /// Whether dx1 dy2 - dx2 dy1 is positive.
    is_positive: bool,
    /// The doubled area in square sub-pixels, of either sign.
    area: i64,
    /// From the first corner to the anchor's centre, in sub-pixels: at most half a pixel.
    to_anchor: [i32; 2],
    precision: PhantomData<S>,
}

/// Gradients by the reciprocal of the area: `((numerator << up) * reciprocal / 2^32) << left`.
#[derive(Clone, Copy, Debug)]
pub struct QuickGradients {
    reciprocal: i32,
    up: u32,
    left: u32,
}

impl<S: Subpixel> TriangleSetup<S> {
    /// For corners from top to bottom, with the doubled area and whether it is positive if taken in
    /// this order.
    #[inline(always)]
    pub(super) fn new([a, b, c]: [[i32; 2]; 3], is_positive: bool, area: i64) -> Self {
        let half = 1 << (S::BITS - 1);
        let to_center = |c: i32| half - (c & (2 * half - 1));
        Self {
            dx: [b[0] - a[0], c[0] - a[0]],
            dy: [b[1] - a[1], c[1] - a[1]],
            is_positive,
            area,
            // The centre of the pixel that holds the first corner.
            to_anchor: [to_center(a[0]), to_center(a[1])],
            precision: PhantomData,
        }
    }

    /// Exactly, whatever the triangle: gradients in Q16, modulo 2^32, of an attribute of 16 bits.
    #[inline(never)]
    fn exact_plane(&self, [a, b, c]: [u16; 3]) -> Plane<u32> {
        let divisor = Divisor::new(self.area.unsigned_abs());
        let gradient = |[p, q]: [i32; 2], [r, s]: [i32; 2]| {
            let numerator = if S::BITS <= 4 {
                // Twice an area in a box of 2^16 - 1 by 2^15 - 1: products may wrap, their
                // difference does not.
                i64::from(p.wrapping_mul(q).wrapping_sub(r.wrapping_mul(s)))
            } else {
                i64::from(p) * i64::from(q) - i64::from(r) * i64::from(s)
            };
            let numerator = if self.is_positive { numerator } else { -numerator };
            divisor.divide(numerator << (16 + S::BITS)).0
        };
        let start = i32::from(a);
        let (d1, d2) = (i32::from(b) - start, i32::from(c) - start);
        let ([dx1, dx2], [dy1, dy2]) = (self.dx, self.dy);
        let (x, y) = (gradient([d1, dy2], [d2, dy1]), gradient([d2, dx1], [d1, dx2]));
        let [to_x, to_y] = self.to_anchor;
        // Half a pixel at most: the bits dropped first cost 2^S / 2^16 units.
        let part = |gradient: i64, to: i32| ((gradient >> S::BITS) as i32).wrapping_mul(to) as u32;
        Plane {
            anchor: middle_of(a).wrapping_add(part(x, to_x)).wrapping_add(part(y, to_y)),
            per_column: x as u32,
            per_row: y as u32,
        }
    }

    /// Exactly: gradients in Q18, modulo 2^64, of an attribute of 32 bits.
    fn exact_wide_plane(&self, [a, b, c]: [u32; 3]) -> Plane<u64> {
        let divisor = Divisor::new(self.area.unsigned_abs());
        // Numerators are below 2^51, so that 18 + S digits behind the point take two steps.
        let gradient = |numerator: i64| {
            let (upper, rest) = divisor.divide(numerator << 10);
            let (lower, _) = divisor.divide(rest << (8 + S::BITS));
            (upper << (8 + S::BITS)) + lower
        };
        let [x, y] = self.numerators([a, b, c].map(i64::from)).map(gradient);
        let anchor = self.anchor((i64::from(a) << 18) + (1 << 17), x, y);
        Plane { anchor: anchor as u64, per_column: x as u64, per_row: y as u64 }
    }

    fn numerators(&self, [a, b, c]: [i64; 3]) -> [i64; 2] {
        let [dx1, dx2] = self.dx.map(i64::from);
        let [dy1, dy2] = self.dy.map(i64::from);
        let (d1, d2) = (b - a, c - a);
        let numerators = [d1 * dy2 - d2 * dy1, d2 * dx1 - d1 * dx2];
        numerators.map(|n| if self.is_positive { n } else { -n })
    }

    /// The value at the anchor's centre, exact in all but its S uppermost bits.
    fn anchor(&self, corner: i64, x: i64, y: i64) -> i64 {
        let [to_x, to_y] = self.to_anchor.map(i64::from);
        corner + (x.wrapping_mul(to_x).wrapping_add(y.wrapping_mul(to_y)) >> S::BITS)
    }

    /// The plane of an attribute of 16 bits by the reciprocal.
    #[inline(always)]
    fn quick_plane(&self, quick: QuickGradients, [a, b, c]: [u16; 3]) -> Plane<u32> {
        let start = i32::from(a);
        let (d1, d2) = (i32::from(b) - start, i32::from(c) - start);
        let [dx1, dx2] = self.dx;
        let [dy1, dy2] = self.dy;
        // Products may wrap, their difference does not.
        let numerator =
            |p: i32, q: i32, r: i32, s: i32| p.wrapping_mul(q).wrapping_sub(r.wrapping_mul(s));
        let QuickGradients { reciprocal, up, left } = quick;
        let x = mul_high(numerator(d1, dy2, d2, dy1) << up, reciprocal);
        let y = mul_high(numerator(d2, dx1, d1, dx2) << up, reciprocal);
        // Half a pixel at most: the bits dropped first cost 2^S / 2^16 units. Quotients are below
        // 2^30.
        let [to_x, to_y] = self.to_anchor;
        let to_anchor = (x >> S::BITS) * to_x + (y >> S::BITS) * to_y;
        Plane {
            anchor: middle_of(a).wrapping_add((to_anchor << left) as u32),
            per_column: (x << left) as u32,
            per_row: (y << left) as u32,
        }
    }
}

/// An attribute of 16 bits and a half, in Q16.
#[inline(always)]
const fn middle_of(a: u16) -> u32 {
    ((a as u32) << 16) + (1 << 15)
}

impl QuickGradients {
    /// Nothing for triangles of over 2^15 sub-pixels, whose numerators need more than 32 bits, and
    /// for those so thin and long that the bits their gradients lack would add up. `extent` has
    /// no fewer bits than width and height.
    #[inline(always)]
    pub(super) fn new<S: Subpixel>(area: i64, is_positive: bool, extent: u32) -> Option<Self> {
        if S::BITS > 4 && extent >> 15 != 0 {
            return None;
        }
        let reciprocal = Reciprocal::of((area as i32).unsigned_abs());
        let (zeros, area_zeros) = (leading_zeros(extent), reciprocal.leading_zeros);
        // A quotient is within 1 + 2^-27 2^30 = 9 of its last bits, which over n pixels, shifted
        // left by k, add up to less than 2^(4 + k) n / 2^16 units: a quarter of one for 2^k
        // n <= 2^10. Width and height are both below 2^(32 - zeros) sub-pixels, and n below
        // twice as many pixels.
        if 2 * zeros < 26 + area_zeros {
            return None;
        }
        // Numerators are below 2^16 times the extent, so that they can be shifted up by its leading
        // zeros less 17. Q16 a pixel: num 2^(16 + S) / area = ((num << up) r / 2^32) >> (14
        // + up - S - area_zeros), which is shifted by 8 at most to the right, as an area is
        // not larger than width times height. There the reciprocal is shifted instead,
        // once: its lost last bit makes up to half a last bit of a gradient, as a shifted numerator
        // is below 2^31.
        let up = zeros - 17;
        let right = 14 + up as i32 - S::BITS as i32 - area_zeros as i32;
        let mantissa = if is_positive { reciprocal.mantissa } else { -reciprocal.mantissa };
        Some(Self { reciprocal: mantissa >> right.max(0), up, left: (right.max(0) - right) as u32 })
    }
}

/// Stepped in Q16.16.
impl Interpolate for u16 {
    type Accumulator = u32;
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
    fn value(accumulator: u32) -> Self {
        (accumulator >> 16) as Self
    }

    /// Half a unit above the interpolated value.
    #[inline(always)]
    fn sample(accumulator: u32) -> U16F16 {
        U16F16::from_bits(accumulator)
    }
}

/// Stepped in Q32.18.
impl Interpolate for u32 {
    type Accumulator = u64;
    type Sample = Self;

    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        _: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<u64> {
        setup.exact_wide_plane(corners)
    }

    #[inline(always)]
    fn value(accumulator: u64) -> Self {
        (accumulator >> 18) as Self
    }

    #[inline(always)]
    fn sample(accumulator: u64) -> Self {
        Self::value(accumulator)
    }
}

impl Interpolate for NoDepth {
    type Accumulator = ();
    type Sample = ();

    #[inline(always)]
    fn plane<S: Subpixel>(
        _: &TriangleSetup<S>,
        _: Option<QuickGradients>,
        _: [Self; 3],
    ) -> Plane<()> {
        Plane { anchor: (), per_column: (), per_row: () }
    }

    #[inline(always)]
    fn value((): ()) -> Self {
        Self
    }

    #[inline(always)]
    fn sample((): ()) {}
}

impl<A: Interpolate, const N: usize> Interpolate for [A; N] {
    type Accumulator = [A::Accumulator; N];
    type Sample = [A::Sample; N];

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        [a, b, c]: [Self; 3],
    ) -> Plane<Self::Accumulator> {
        let mut all = Plane::<Self::Accumulator> {
            anchor: Step::ZERO,
            per_column: Step::ZERO,
            per_row: Step::ZERO,
        };
        // Not `from_fn`, whose closure compilers call, with the set-up in memory for it.
        for i in 0..N {
            let plane = A::plane(setup, quick, [a[i], b[i], c[i]]);
            (all.anchor[i], all.per_column[i], all.per_row[i]) =
                (plane.anchor, plane.per_column, plane.per_row);
        }
        all
    }

    #[inline(always)]
    fn value(accumulator: Self::Accumulator) -> Self {
        accumulator.map(A::value)
    }

    #[inline(always)]
    fn sample(accumulator: Self::Accumulator) -> Self::Sample {
        accumulator.map(A::sample)
    }
}
