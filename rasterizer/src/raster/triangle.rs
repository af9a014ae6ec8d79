//! One triangle, row by row.

use super::{Interpolate, Span, SpanSink, Window, edge::Edge, gradient::TriangleSetup};
use crate::geometry::{DepthFormat, ScreenVertex, Subpixel, Varyings};

/// Twice the area of a triangle on the screen in square sub-pixels: negative if its corners run counter-clockwise, as y
/// runs downwards. Exact.
#[inline(always)]
#[must_use]
pub fn signed_area<S: Subpixel, D, V>([a, b, c]: [&ScreenVertex<S, D, V>; 3]) -> i64 {
    let (dx1, dy1) = (b.x - a.x, b.y - a.y);
    let (dx2, dy2) = (c.x - a.x, c.y - a.y);
    if S::BITS <= 4 {
        // At most the area of the guard band's square, 2^30; the products may wrap.
        i64::from(dx1.wrapping_mul(dy2).wrapping_sub(dx2.wrapping_mul(dy1)))
    } else {
        i64::from(dx1) * i64::from(dy2) - i64::from(dx2) * i64::from(dy1)
    }
}

/// Draws the pixels of a triangle that lie in `window`.
///
/// `area` is its [`signed_area`]; a triangle without any draws nothing. All its corners are on the screen.
///
/// # Errors
///
/// What the sink says, at once.
#[inline(always)]
pub fn draw_triangle<S, D, V, K>(
    corners: [&ScreenVertex<S, D, V>; 3],
    area: i64,
    window: &Window,
    sink: &mut K,
) -> Result<(), K::Error>
where
    S: Subpixel,
    D: DepthFormat + Interpolate,
    V: Varyings + Interpolate,
    K: SpanSink<D, V>,
{
    // From top to bottom, and on which side of the long edge the middle corner lies.
    let [mut top, mut middle, mut bottom] = corners;
    let mut middle_is_right = area > 0;
    if middle.y < top.y {
        (top, middle) = (middle, top);
        middle_is_right = !middle_is_right;
    }
    if bottom.y < middle.y {
        (middle, bottom) = (bottom, middle);
        middle_is_right = !middle_is_right;
        if middle.y < top.y {
            (top, middle) = (middle, top);
            middle_is_right = !middle_is_right;
        }
    }

    // The first row or column whose centre is at or beyond a coordinate.
    let first_center = |c: i32| (c + (1 << (S::BITS - 1)) - 1) >> S::BITS;
    let first_row = first_center(top.y).max(window.top);
    let middle_row = first_center(middle.y);
    let end_row = first_center(bottom.y).min(window.bottom);
    let left = top.x.min(middle.x).min(bottom.x);
    let right = top.x.max(middle.x).max(bottom.x);
    let first_column = first_center(left).max(window.left);
    let end_column = first_center(right).min(window.right);
    if area == 0 || first_row >= end_row || first_column >= end_column {
        return Ok(());
    }

    let at = |vertex: &ScreenVertex<S, D, V>| [vertex.x, vertex.y];
    // Clockwise from the top, which makes the doubled area positive where y runs downwards.
    let (second, third) = if middle_is_right {
        (middle, bottom)
    } else {
        (bottom, middle)
    };
    let setup = TriangleSetup::<S>::new(
        [at(top), at(second), at(third)],
        area.abs(),
        right - left,
        bottom.y - top.y,
    );
    let depth = D::plane(&setup, [top.depth, second.depth, third.depth]);
    let varyings = V::plane(&setup, [top.varyings, second.varyings, third.varyings]);
    let anchor = at(top).map(|c| c >> S::BITS);
    let mut span = Span {
        row: first_row,
        start: 0,
        end: 0,
        depth: depth.anchor,
        depth_step: depth.per_column,
        varyings: varyings.anchor,
        varyings_step: varyings.per_column,
    };

    // The long edge stays; the short one on the other side gives way to the next at the middle corner's row.
    let long = Edge::new(at(top), at(bottom), first_row, S::BITS);
    let (mut left, mut right) = (long, long);
    let mut row = first_row;
    let (mut upper, mut lower, mut half_end) = (top, middle, middle_row.min(end_row));
    if row >= half_end {
        (upper, lower, half_end) = (middle, bottom, end_row);
    }
    loop {
        let short = Edge::new(at(upper), at(lower), row, S::BITS);
        if middle_is_right {
            right = short;
        } else {
            left = short;
        }
        while row < half_end {
            let start = left.boundary.max(window.left);
            let end = right.boundary.min(window.right);
            if start < end {
                let (columns, rows) = (start - anchor[0], row - anchor[1]);
                (span.row, span.start, span.end) = (row, start, end);
                span.depth = depth.at(columns, rows);
                span.varyings = varyings.at(columns, rows);
                sink.span(&span)?;
            }
            left.step();
            right.step();
            row += 1;
        }
        if row == end_row {
            return Ok(());
        }
        (upper, lower, half_end) = (middle, bottom, end_row);
    }
}

#[cfg(test)]
mod tests {
    use std::{vec, vec::Vec};

    use super::*;
    use crate::{
        geometry::{S4, S8},
        raster::Step,
    };

    struct Counter<D, V> {
        covered: Vec<(i32, i32, D, V)>,
    }

    impl<D: Interpolate, V: Interpolate> SpanSink<D, V> for Counter<D, V> {
        type Error = ();

        fn span(&mut self, span: &Span<D, V>) -> Result<(), ()> {
            let (mut depth, mut varyings) = (span.depth, span.varyings);
            for column in span.start..span.end {
                self.covered
                    .push((column, span.row, D::value(depth), V::value(varyings)));
                depth = depth.plus(span.depth_step);
                varyings = varyings.plus(span.varyings_step);
            }
            Ok(())
        }
    }

    const WINDOW: Window = Window {
        left: -20,
        top: -30,
        right: 300,
        bottom: 200,
    };

    /// Whether a centre is covered, by three edge functions and the top-left rule in 64 bits.
    fn is_covered([a, b, c]: [[i32; 2]; 3], area: i64, column: i32, row: i32, bits: u32) -> bool {
        let half = 1i64 << (bits - 1);
        let [x, y] = [column, row].map(|c| (i64::from(c) << bits) + half);
        let clockwise = if area > 0 { [a, b, c] } else { [a, c, b] };
        (0..3).all(|i| {
            let [x0, y0] = clockwise[i].map(i64::from);
            let [x1, y1] = clockwise[(i + 1) % 3].map(i64::from);
            let (dx, dy) = (x1 - x0, y1 - y0);
            let inside = dx * (y - y0) - dy * (x - x0);
            // Clockwise on the screen, left edges run upwards and top edges to the right.
            let is_top_left = dy < 0 || (dy == 0 && dx > 0);
            inside > 0 || (inside == 0 && is_top_left)
        })
    }

    /// Draws one triangle and compares coverage with the definition, depth and a varying with the exact plane.
    fn check<S: Subpixel>(corners: [[i32; 2]; 3], values: [u16; 3]) {
        let [a, b, c] = [0, 1, 2].map(|i| {
            let [x, y] = corners[i];
            ScreenVertex::<S, u32, [u16; 1]>::checked(x, y, u32::from(values[i]) << 16 | 0x1234, [values[i]]).unwrap()
        });
        let area = signed_area([&a, &b, &c]);
        let mut counter = Counter { covered: vec![] };
        draw_triangle([&a, &b, &c], area, &WINDOW, &mut counter).unwrap();
        let mut covered = counter.covered.iter();
        for row in WINDOW.top..WINDOW.bottom {
            for column in WINDOW.left..WINDOW.right {
                if area == 0 || !is_covered(corners, area, column, row, S::BITS) {
                    continue;
                }
                let &(x, y, depth, [value]) = covered.next().expect("a covered pixel is missing");
                assert_eq!((x, y), (column, row), "{corners:?}");
                // Barycentric coordinates from exact edge functions.
                let half = 1i128 << (S::BITS - 1);
                let [px, py] = [column, row].map(|c| (i128::from(c) << S::BITS) + half);
                let weight = |i: usize| {
                    let [x0, y0] = corners[(i + 1) % 3].map(i128::from);
                    let [x1, y1] = corners[(i + 2) % 3].map(i128::from);
                    (x1 - x0) * (py - y0) - (y1 - y0) * (px - x0)
                };
                let weights = [weight(0), weight(1), weight(2)];
                let plane = |values: [i128; 3]| {
                    let sum: i128 = (0..3).map(|i| weights[i] * values[i]).sum();
                    sum as f64 / area as f64
                };
                let exact = plane(values.map(i128::from));
                // Half a unit of rounding, 1/4 + 4,096 / 2^16 + 2^8 / 2^16 of error.
                assert!(
                    (f64::from(value) - exact).abs() < 0.82,
                    "{corners:?} {values:?}: {value} {exact}"
                );
                let exact = plane(values.map(|v| i128::from(v) << 16 | 0x1234));
                assert!(
                    (f64::from(depth) - exact).abs() < 0.52,
                    "{corners:?} {values:?}: {depth} {exact}"
                );
            }
        }
        assert_eq!(covered.next(), None, "{corners:?}: a pixel too many");
    }

    fn random(state: &mut u64, limit: i32) -> i32 {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        (*state % (2 * limit as u64 + 1)) as i32 - limit
    }

    fn random_triangles<S: Subpixel>(count: usize, mut state: u64) {
        let unit = 1 << S::BITS;
        for extent in [2, unit, 5 * unit, 60 * unit, 400 * unit, 1000 * unit] {
            let room = (1000 * unit - extent).min(200 * unit);
            for _ in 0..count {
                let middle = [random(&mut state, room), random(&mut state, room)];
                let corners = [0; 3].map(|_| middle.map(|c| c + random(&mut state, extent)));
                let values = [0; 3].map(|_| (random(&mut state, 32_767) + 32_768) as u16);
                check::<S>(corners, values);
            }
        }
    }

    #[test]
    fn random_triangles_are_exact() {
        random_triangles::<S4>(60, 1);
        random_triangles::<S8>(60, 2);
    }

    /// The corners in all orders, on and off pixel centres, at both ends of the attributes' range.
    #[test]
    fn every_small_triangle_is_exact() {
        let places = [-8, 0, 3, 8, 16, 24];
        for bits in 0..6i32.pow(6) {
            let digit = |n: u32| places[(bits / 6i32.pow(n) % 6) as usize];
            if bits % 7 == 0 {
                let corners = [[digit(0), digit(1)], [digit(2), digit(3)], [digit(4), digit(5)]];
                check_small::<S4>(corners);
            }
        }
    }

    fn check_small<S: Subpixel>(corners: [[i32; 2]; 3]) {
        let vertices = corners.map(|[x, y]| ScreenVertex::<S, u16, [u16; 0]>::checked(x, y, 65_535, []).unwrap());
        let [a, b, c] = &vertices;
        let area = signed_area([a, b, c]);
        let mut counter = Counter { covered: vec![] };
        draw_triangle([a, b, c], area, &WINDOW, &mut counter).unwrap();
        let got: Vec<_> = counter.covered.iter().map(|&(x, y, depth, _)| (x, y, depth)).collect();
        let mut want = vec![];
        for row in -2..4 {
            for column in -2..4 {
                if area != 0 && is_covered(corners, area, column, row, S::BITS) {
                    want.push((column, row, 65_535));
                }
            }
        }
        assert_eq!(got, want, "{corners:?}");
    }

    /// The longest triangles that fit, and slivers whose doubled area is one unit.
    #[test]
    fn extremes_are_exact() {
        fn extremes<S: Subpixel>() {
            let (low, high) = (-1024 << S::BITS, (1024 << S::BITS) - 1);
            let half = 1 << (S::BITS - 1);
            for corners in [
                [[low, low], [high, low], [low, high]],
                [[high, high], [high, low], [low, high]],
                [[low, low], [high, high - 1], [high, high]],
                [[low, low], [high, high - 1], [high - 1, high - 1]],
                [[low, 0], [high, 1], [high, 0]],
                [[low, half], [0, half], [high, half + 1]],
                [[0, low], [1, high], [0, high]],
                [[half, low], [half, 0], [half + 1, high]],
                [[0, 0], [high, 1], [high - 1, 1]],
                [[0, 0], [1, high], [1, high - 1]],
                [[low, high], [high, low], [high, low + 1]],
            ] {
                for values in [
                    [0, 65_535, 0],
                    [65_535, 0, 65_535],
                    [0, 0, 65_535],
                    [65_535; 3],
                    [0; 3],
                    [1, 65_535, 32_768],
                ] {
                    check::<S>(corners, values);
                }
            }
        }
        extremes::<S4>();
        extremes::<S8>();
    }

    #[test]
    fn triangles_without_area_draw_nothing() {
        for corners in [
            [[5, 5]; 3],
            [[0, 0], [100, 100], [200, 200]],
            [[0, 7], [500, 7], [90, 7]],
            [[0, 0], [0, 0], [99, 7]],
        ] {
            check::<S4>(corners, [0, 9, 65_535]);
        }
    }
}
