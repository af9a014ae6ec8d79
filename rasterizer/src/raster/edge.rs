//! The boundary that an edge draws through the rows.
//!
//! The edge function of an edge from (x0, y0) down to (x1, y1), with dx = x1 - x0 and
//! dy = y1 - y0 > 0,
//!
//! ```text
//!   E(x, y) = (x - x0) dy - (y - y0) dx
//! ```
//!
//! is 0 on the edge and positive to its right (Pineda, *A Parallel Algorithm for Polygon
//! Rasterization*, SIGGRAPH 1988). In each row the boundary is the first pixel whose centre has
//! E >= 0. Seen from the right, that pixel is the first one inside: a left edge covers the centres
//! on it. Seen from the left, it is the first one outside: a right edge does not. Together with
//! rows that run from the first centre at or below the upper end to the last one above the lower
//! end, that is the top-left rule, and the same boundary serves both triangles of a shared edge.
//!
//! E at the boundary pixel stays between 0 and dy (2^S times that, but all its values there share
//! their S lowest bits, which are dropped): stepping down a row takes dx off, stepping a pixel to
//! the right adds dy. With dx = q dy + r, the boundary moves by q pixels and E by -r, and by one
//! more pixel where that makes E negative. Nothing is ever rounded, and no value needs more than 32
//! bits at any sub-pixel precision.

use super::Layout;
use crate::numbers::{IS_NARROW, Subpixel, divide, divide_small};

/// An edge on its way down the rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The address of the boundary in the current row, modulo 2^32: one that is not drawn can lie
    /// beyond any address.
    pub(super) boundary: i32,
    /// The edge function at the boundary's centre, without its S lowest bits: from 0 to dy - 1.
    function: i32,
    /// The least change of the boundary's address from a row to the next: ⌊dx / dy⌋ plus the pitch.
    stride: i32,
    /// What that change takes off the edge function: dx mod dy.
    remainder: i32,
    dy: i32,
}

impl Edge {
    /// The boundary of the edge from `top` down to `bottom` in `row`, whose centre lies at or below
    /// `top`.
    ///
    /// Coordinates are sub-pixels, the edge's extents below 2^(11 + S).
    #[inline(always)]
    pub(super) const fn new<S: Subpixel>(
        top: [i32; 2],
        bottom: [i32; 2],
        row: i32,
        layout: &Layout,
    ) -> Self {
        if IS_NARROW {
            Self::called::<S>(top, bottom, row, layout)
        } else {
            Self::inlined::<S>(top, bottom, row, layout)
        }
    }

    /// Calls [`inlined`](Self::inlined).
    // codegen: not inlined on narrow cores, which often have the smallest flash: 150 to 400 bytes
    // less for 1 to 2.7 % more of a frame's instructions.
    #[inline(never)]
    const fn called<S: Subpixel>(
        top: [i32; 2],
        bottom: [i32; 2],
        row: i32,
        layout: &Layout,
    ) -> Self {
        Self::inlined::<S>(top, bottom, row, layout)
    }

    #[inline(always)]
    const fn inlined<S: Subpixel>(
        top: [i32; 2],
        bottom: [i32; 2],
        row: i32,
        layout: &Layout,
    ) -> Self {
        let half = 1 << (S::BITS - 1);
        let (dx, dy) = (bottom[0] - top[0], bottom[1] - top[1]);
        let (columns, remainder) = floor_divide(dx, dy);
        // The row's centre below the upper end, and the edge's x there from the first column's
        // centre, in sub-pixels, but for the last `rest` / dy of it.
        let below = (row << S::BITS) + half - top[1];
        let mut x = top[0] - half + below * columns;
        let mut rest = below.wrapping_mul(remainder);
        if below >> S::BITS != 0 {
            let whole = scaled::<S>(below, remainder, dy);
            x += whole;
            rest = rest.wrapping_sub(whole.wrapping_mul(dy));
        }
        // The first centre from x on lies -x mod 2^S beyond it: the edge function is below 2^S dy
        // there, and `rest` takes at most as much off.
        let column = (x + 2 * half - 1) >> S::BITS;
        let function = ((-x & (2 * half - 1)) * dy - rest) >> S::BITS;
        let (column, function) = carried(column, function, dy);
        Self {
            boundary: layout.row_address(row).wrapping_add(column),
            function,
            stride: columns.wrapping_add(layout.pitch),
            remainder,
            dy,
        }
    }

    /// Steps to the next row.
    #[inline(always)]
    pub(super) const fn step(&mut self) {
        // codegen: computed in registers and stored once.
        let (boundary, function) = carried(
            self.boundary.wrapping_add(self.stride),
            self.function - self.remainder,
            self.dy,
        );
        (self.boundary, self.function) = (boundary, function);
    }
}

/// A boundary and its edge function, one pixel further where that is negative.
#[inline(always)]
const fn carried(boundary: i32, function: i32, dy: i32) -> (i32, i32) {
    if !IS_NARROW {
        // codegen: operands that are shifted on the way take two instructions less than a
        // condition.
        let is_negative = function >> 31;
        (boundary.wrapping_sub(is_negative), function + (dy & is_negative))
    } else if function < 0 {
        (boundary.wrapping_add(1), function + dy)
    } else {
        (boundary, function)
    }
}

/// ⌊dx / dy⌋ and the rest, for dy > 0.
///
/// A negative dx has ⌊dx / dy⌋ = -⌊(-dx - 1) / dy⌋ - 1, and -n - 1 is n with all its bits inverted.
#[inline(always)]
const fn floor_divide(dx: i32, dy: i32) -> (i32, i32) {
    let is_left = dx >> 31;
    let quotient = divide_small((dx ^ is_left) as u32, dy as u32) as i32 ^ is_left;
    (quotient, dx - quotient * dy)
}

/// ⌊`below * remainder / dy`⌋, for factors up to dy, which in S4 is below 2^15 and in S8 below
/// 2^19.
#[cold]
#[inline(never)]
const fn scaled<S: Subpixel>(below: i32, remainder: i32, dy: i32) -> i32 {
    if S::BITS <= 4 || dy < 1 << 15 {
        return divide(below as u32 * remainder as u32, dy as u32) as i32;
    }
    // Long division, as the product would not fit, by 11 digits of `below` at a time: with
    // below = high 2^11 + low the rest of the first step is below dy, and rest 2^11 + low remainder
    // below 2^32.
    let (high, low) = (below as u32 >> 11, below as u32 & 0x7FF);
    let (remainder, dy) = (remainder as u32, dy as u32);
    let upper = high * remainder;
    let quotient = divide(upper, dy);
    let rest = ((upper - quotient * dy) << 11) + low * remainder;
    ((quotient << 11) + divide(rest, dy)) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        numbers::{S4, S8},
        random::Random,
    };

    /// The boundary by its definition.
    fn boundary(top: [i32; 2], bottom: [i32; 2], row: i32, bits: u32) -> i32 {
        let [x0, y0, x1, y1] = [top[0], top[1], bottom[0], bottom[1]].map(i64::from);
        let (dx, dy) = (x1 - x0, y1 - y0);
        let half = 1i64 << (bits - 1);
        let below = (i64::from(row) << bits) + half - y0;
        // The least column with (column 2^bits + half - x0) dy >= below dx.
        let least = (below * dx + (x0 - half) * dy + (dy << bits) - 1).div_euclid(dy << bits);
        least as i32
    }

    /// All rows have the same addresses: an address is a column.
    const COLUMNS: Layout = Layout { pitch: 0, origin: 0 };

    fn edge(top: [i32; 2], bottom: [i32; 2], row: i32, bits: u32) -> Edge {
        if bits == 4 {
            Edge::new::<S4>(top, bottom, row, &COLUMNS)
        } else {
            Edge::new::<S8>(top, bottom, row, &COLUMNS)
        }
    }

    fn check(top: [i32; 2], bottom: [i32; 2], bits: u32) {
        let half = 1 << (bits - 1);
        let rows = (top[1] + half - 1) >> bits..(bottom[1] + half - 1) >> bits;
        if rows.is_empty() {
            return;
        }
        let mut walking = edge(top, bottom, rows.start, bits);
        let stride = (rows.len() / 5).max(1);
        for (n, row) in rows.enumerate() {
            let want = boundary(top, bottom, row, bits);
            assert_eq!(walking.boundary, want, "{top:?} to {bottom:?}, row {row}, walked");
            assert!((0..walking.dy).contains(&walking.function));
            if n % stride == 0 {
                let jumped = edge(top, bottom, row, bits);
                assert_eq!(jumped.boundary, want, "{top:?} to {bottom:?}, row {row}, jumped");
                assert_eq!(jumped.function, walking.function);
            }
            walking.step();
        }
    }

    #[test]
    fn walked_and_jumped_boundaries_equal_the_definition() {
        let mut random = Random::new(1);
        let mut next = |limit: i32| random.within(-limit, limit);
        for bits in [4, 8] {
            let guard = 1 << (10 + bits);
            for extent in [3, 1 << bits, 20 << bits, guard] {
                for _ in 0..20_000 / (extent >> bits).max(10) {
                    let [x, y] = [next(guard - extent), next(guard - extent)];
                    let ends = [
                        [x + next(extent), y + next(extent)],
                        [x + next(extent), y + next(extent)],
                    ];
                    let [a, b] = ends;
                    if a[1] != b[1] {
                        check(
                            if a[1] < b[1] { a } else { b },
                            if a[1] < b[1] { b } else { a },
                            bits,
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn longest_and_flattest_edges() {
        for bits in [4, 8] {
            let guard = 1 << (10 + bits);
            let last = guard - 1;
            for [x0, y0, x1, y1] in [
                [-guard, -guard, last, last],
                [last, -guard, -guard, last],
                [-guard, 0, last, 1],
                [last, 0, -guard, 1],
                [-guard, -1, last, 1 << bits],
                [0, -guard, 1, last],
                [0, -guard, -1, last],
                [last, -guard, last, last],
                [-guard, 7, last, 2 << bits],
            ] {
                check([x0, y0], [x1, y1], bits);
            }
        }
    }
}
