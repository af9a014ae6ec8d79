//! Attributes as planes over the screen.
//!
//! With the differences (dx1, dy1, da1) and (dx2, dy2, da2) from one corner to the others and the
//! doubled area A = dx1 dy2 - dx2 dy1, an attribute a changes along a row and down the rows by
//!
//! ```text
//!   da/dx = (da1 dy2 - da2 dy1) / A        da/dy = (da2 dx1 - da1 dx2) / A
//! ```
//!
//! A numerator is twice the area of the triangle with a in place of x or y, so it is bounded by the
//! range of a times the triangle's height or width. Numerators are exact, and the quotients are
//! computed with one reciprocal per triangle.
//!
//! # Error
//!
//! An attribute of 16 bits is stepped with 16 more bits behind the point. Over a triangle that
//! spans n pixels in x and y together its value at a centre is within 1/4 + 3/2 n / 2^16 + 2^S /
//! 2^16 units of the exact plane, before it is rounded to the nearest: the reciprocal's 27 bits are
//! enough for that unless a triangle is thin and steep, and then the gradient is divided exactly.
//! An attribute of 32 bits is stepped with 18 more bits, always divided exactly: n / 2^18 units.
//!
//! Gradients of slivers can be far larger than 32 bits. Steps wrap modulo 2^32, and at a covered
//! centre the value is between those of the corners again, so that it is right: it is sampled there
//! and nowhere else.

use core::marker::PhantomData;

use super::Step;
use crate::numbers::{Divisor, Reciprocal, Subpixel, leading_zeros, mul_high, mul_wide};

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
    /// Returns the value at the centre of the pixel that lies `columns` and `rows` from the anchor.
    #[inline(always)]
    pub fn at(&self, columns: i32, rows: i32) -> T {
        let row = self.anchor.wrapping_add(self.per_row.wrapping_mul(rows));
        row.wrapping_add(self.per_column.wrapping_mul(columns))
    }
}

/// A value as a function of the pixel over a triangle.
///
/// It is set up about an anchor, a pixel of the triangle, and then counts in addresses and rows.
pub trait Field: Copy + core::fmt::Debug {
    /// Returns the same function of addresses and rows. `to_first` is the way from the anchor to
    /// the pixel at address 0 of row 0, in columns and rows, and a row has `pitch` addresses.
    #[must_use]
    fn over_addresses(self, to_first: [i32; 2], pitch: i32) -> Self;

    /// The same in place, for functions that are large.
    #[inline(always)]
    fn count_addresses(&mut self, to_first: [i32; 2], pitch: i32) {
        *self = self.over_addresses(to_first, pitch);
    }
}

impl<T: Step> Field for Plane<T> {
    #[inline(always)]
    fn over_addresses(self, [columns, rows]: [i32; 2], pitch: i32) -> Self {
        Self {
            anchor: self.at(columns, rows),
            per_column: self.per_column,
            per_row: self.per_row.wrapping_add(self.per_column.wrapping_mul(pitch.wrapping_neg())),
        }
    }
}

impl<A: Field, B: Field> Field for (A, B) {
    #[inline(always)]
    fn over_addresses(self, to_first: [i32; 2], pitch: i32) -> Self {
        (self.0.over_addresses(to_first, pitch), self.1.over_addresses(to_first, pitch))
    }

    #[inline(always)]
    fn count_addresses(&mut self, to_first: [i32; 2], pitch: i32) {
        self.0.count_addresses(to_first, pitch);
        self.1.count_addresses(to_first, pitch);
    }
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
    /// The reciprocal before it is shifted to the right, and by how many bits: negative for a shift
    /// to the left.
    mantissa: i32,
    right: i32,
}

impl<S: Subpixel> TriangleSetup<S> {
    /// For corners from top to bottom, with the doubled area and whether it is positive for corners
    /// in this order.
    #[inline(always)]
    pub(crate) fn new([a, b, c]: [[i32; 2]; 3], is_positive: bool, area: i64) -> Self {
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

    /// The plane of an attribute of 16 bits for any triangle, divided exactly: Q16, modulo 2^32.
    #[inline(never)]
    pub(super) fn exact_plane(&self, [a, b, c]: [u16; 3]) -> Plane<u32> {
        let divisor = Divisor::new(self.area.unsigned_abs());
        let differences = [i32::from(b) - i32::from(a), i32::from(c) - i32::from(a)];
        let gradient = |n: i64| divisor.divide(self.signed(n) << (16 + S::BITS)).0;
        let [x, y] = if S::BITS <= 4 {
            self.gradients(differences, |products| gradient(wrapping_cross(products).into()))
        } else {
            self.gradients(differences, |products| gradient(wide_cross(products.map(i64::from))))
        };
        // Half a pixel at most: the bits dropped first cost 2^S / 2^16 units.
        let to_anchor = self.along_anchor([x, y].map(|gradient| (gradient >> S::BITS) as i32));
        Plane {
            anchor: middle_of(a).wrapping_add(to_anchor as u32),
            per_column: x as u32,
            per_row: y as u32,
        }
    }

    /// The plane of an attribute of 32 bits for any triangle, divided exactly: Q18, modulo 2^64.
    pub(super) fn exact_wide_plane(&self, [a, b, c]: [u32; 3]) -> Plane<u64> {
        let divisor = Divisor::new(self.area.unsigned_abs());
        let [start, b, c] = [a, b, c].map(i64::from);
        // Numerators are below 2^51, so that 18 + S digits behind the point take two steps.
        let gradient = |n: i64| {
            let (upper, rest) = divisor.divide(self.signed(n) << 10);
            let (lower, _) = divisor.divide(rest << (8 + S::BITS));
            (upper << (8 + S::BITS)) + lower
        };
        let differences = [b - start, c - start];
        let [x, y] = self.gradients(differences, |products| gradient(wide_cross(products)));
        // Exact in all but its S uppermost bits.
        let [to_x, to_y] = self.to_anchor.map(i64::from);
        let to_anchor = x.wrapping_mul(to_x).wrapping_add(y.wrapping_mul(to_y)) >> S::BITS;
        Plane {
            anchor: ((start << 18) + (1 << 17) + to_anchor) as u64,
            per_column: x as u64,
            per_row: y as u64,
        }
    }

    /// The plane of a number of 32 bits in Q32.32, with 18 digits behind the point, modulo 2^64.
    ///
    /// By the reciprocal it is for numbers that differ by less than 2^31, and each gradient is
    /// within 2^-26 of the largest one that a triangle of this extent and area can have.
    #[inline(always)]
    pub(super) fn wide_plane(
        &self,
        quick: Option<QuickGradients>,
        corners: [u32; 3],
    ) -> Plane<u64> {
        if let Some(quick) = quick {
            return self.quick_wide_plane(quick, corners);
        }
        let Plane { anchor, per_column, per_row } = self.exact_wide_plane(corners);
        Plane { anchor: anchor << 14, per_column: per_column << 14, per_row: per_row << 14 }
    }

    // codegen: not inlined, because three numbers or more of a triangle call it.
    #[inline(never)]
    fn quick_wide_plane(&self, quick: QuickGradients, [a, b, c]: [u32; 3]) -> Plane<u64> {
        let differences = [b.wrapping_sub(a) as i32, c.wrapping_sub(a) as i32];
        let QuickGradients { mantissa, up, right, .. } = quick;
        // p q - r s without its 16 - `up` lowest bits: less than 2^31, as p and r are less than
        // 2^31 and q and s have no more bits than the extent.
        let cross = |[p, q, r, s]: [i32; 4]| {
            let product = |a: i32, b: i32| {
                let (upper, lower) = ((a >> 16).wrapping_mul(b), (a & 0xFFFF).wrapping_mul(b));
                (upper << up).wrapping_add(lower >> (16 - up))
            };
            product(p, q).wrapping_sub(product(r, s))
        };
        // With 18 digits behind the point.
        let [x, y] = self.gradients(differences, |products| {
            let product = mul_wide(cross(products), mantissa);
            let right = 14 + right;
            if right >= 0 { product >> right } else { product << -right }
        });
        let [to_x, to_y] = self.to_anchor.map(i64::from);
        let to_anchor = x.wrapping_mul(to_x).wrapping_add(y.wrapping_mul(to_y)) >> S::BITS;
        // Half a unit, so that the digits before the point are rounded.
        let anchor = (i64::from(a) << 18) + (1 << 17) + to_anchor;
        let in_q32 = |value: i64| (value as u64) << 14;
        Plane { anchor: in_q32(anchor), per_column: in_q32(x), per_row: in_q32(y) }
    }

    /// The rows from the anchor to the last covered one, at most.
    pub(super) const fn last_row(&self) -> i32 {
        (self.dy[1] >> S::BITS) + 1
    }

    /// The columns and rows from the anchor to any covered pixel, together, at most.
    pub(crate) fn reach(&self) -> u32 {
        let [dx1, dx2] = self.dx;
        let columns = dx1.unsigned_abs().max(dx2.unsigned_abs());
        // From top to bottom.
        let rows = self.dy[1].unsigned_abs();
        ((columns + rows) >> S::BITS) + 2
    }

    /// The plane of an attribute of 16 bits by the reciprocal.
    #[inline(always)]
    pub(super) fn quick_plane(&self, quick: QuickGradients, [a, b, c]: [u16; 3]) -> Plane<u32> {
        let differences = [i32::from(b) - i32::from(a), i32::from(c) - i32::from(a)];
        let QuickGradients { reciprocal, up, left, .. } = quick;
        let gradient = |n: i32| mul_high(n << up, reciprocal);
        let [x, y] = self.gradients(differences, |products| gradient(wrapping_cross(products)));
        // Half a pixel at most: the bits dropped first cost 2^S / 2^16 units. Quotients are below
        // 2^30.
        let to_anchor = self.along_anchor([x >> S::BITS, y >> S::BITS]);
        Plane {
            anchor: middle_of(a).wrapping_add((to_anchor << left) as u32),
            per_column: (x << left) as u32,
            per_row: (y << left) as u32,
        }
    }

    /// da/dx and da/dy from da1 and da2: `gradient` gets the p, q, r, s of a numerator p q - r s.
    #[inline(always)]
    fn gradients<N: From<i32> + Copy, G>(
        &self,
        [d1, d2]: [N; 2],
        gradient: impl Fn([N; 4]) -> G,
    ) -> [G; 2] {
        let ([dx1, dx2], [dy1, dy2]) = (self.dx.map(N::from), self.dy.map(N::from));
        [gradient([d1, dy2, d2, dy1]), gradient([d2, dx1, d1, dx2])]
    }

    /// A numerator for the area's absolute value.
    #[inline(always)]
    const fn signed(&self, numerator: i64) -> i64 {
        if self.is_positive { numerator } else { -numerator }
    }

    /// The change from the first corner to the anchor, by the change a sub-pixel.
    #[inline(always)]
    const fn along_anchor(&self, [x, y]: [i32; 2]) -> i32 {
        let [to_x, to_y] = self.to_anchor;
        x.wrapping_mul(to_x).wrapping_add(y.wrapping_mul(to_y))
    }
}

/// Twice an area in a box of 2^16 - 1 by 2^15 - 1: the products may wrap, their difference does
/// not.
#[inline(always)]
const fn wrapping_cross([p, q, r, s]: [i32; 4]) -> i32 {
    p.wrapping_mul(q).wrapping_sub(r.wrapping_mul(s))
}

#[inline(always)]
const fn wide_cross([p, q, r, s]: [i64; 4]) -> i64 {
    p * q - r * s
}

/// An attribute of 16 bits and a half, in Q16.
#[inline(always)]
const fn middle_of(a: u16) -> u32 {
    ((a as u32) << 16) + (1 << 15)
}

impl QuickGradients {
    /// Returns `None` for triangles of over 2^15 sub-pixels, whose numerators need more than 32
    /// bits, and for triangles so thin and long that the lost bits of their gradients would add up.
    /// `extent` has no fewer bits than width and height.
    #[inline(always)]
    pub(crate) fn new<S: Subpixel>(area: i64, is_positive: bool, extent: u32) -> Option<Self> {
        if S::BITS > 4 && extent >> 15 != 0 {
            return None;
        }
        let reciprocal = Reciprocal::of((area as i32).unsigned_abs());
        let (zeros, area_zeros) = (leading_zeros(extent), reciprocal.leading_zeros);
        // A quotient is within 1 + 2^-27 2^30 = 9 of its last bits, which over n pixels, shifted
        // left by k, add up to less than 2^(4 + k) n / 2^16 units: a quarter of one for 2^k n <=
        // 2^10. Width and height are both below 2^(32 - zeros) sub-pixels, and n below twice as
        // many pixels.
        if 2 * zeros < 26 + area_zeros {
            return None;
        }
        // Numerators are below 2^16 times the extent, so that they can be shifted up by its leading
        // zeros less 17. Q16 a pixel: num 2^(16 + S) / area = ((num << up) r / 2^32) >> (14 + up -
        // S - area_zeros), which is shifted by 8 at most to the right, as an area is not larger
        // than width times height. There the reciprocal is shifted instead, once: its lost last bit
        // makes up to half a last bit of a gradient, as a shifted numerator is below 2^31.
        let up = zeros - 17;
        let right = 14 + up as i32 - S::BITS as i32 - area_zeros as i32;
        let mantissa = if is_positive { reciprocal.mantissa } else { -reciprocal.mantissa };
        Some(Self {
            reciprocal: mantissa >> right.max(0),
            up,
            left: (right.max(0) - right) as u32,
            mantissa,
            right,
        })
    }
}
