//! One triangle, row by row.

use super::{Layout, Primitive, Span, Window, edge::Edge};
use crate::{
    attribute::{DepthFormat, Field as _, Interpolate, QuickGradients, TriangleSetup},
    geometry::ScreenVertex,
    numbers::{IS_NARROW, Subpixel, codegen},
};

/// Twice the area of a triangle on the screen in square sub-pixels: negative if its corners run
/// counter-clockwise, as y runs downwards. Exact.
#[inline(always)]
pub(crate) fn signed_area<S: Subpixel, D, V>([a, b, c]: [&ScreenVertex<S, D, V>; 3]) -> i64 {
    let (dx1, dy1) = (b.x - a.x, b.y - a.y);
    let (dx2, dy2) = (c.x - a.x, c.y - a.y);
    let half = 1 << 15;
    if S::BITS <= 4
        || (IS_NARROW
            && ((dx1 + half) | (dy1 + half) | (dx2 + half) | (dy2 + half)) as u32 >> 16 == 0)
    {
        // At most the area of the guard band's square in sixteenths, 2^30, where the products may
        // wrap; or the difference of products of 16 bits.
        i64::from(dx1.wrapping_mul(dy2).wrapping_sub(dx2.wrapping_mul(dy1)))
    } else {
        i64::from(dx1) * i64::from(dy2) - i64::from(dx2) * i64::from(dy1)
    }
}

/// The first row or column whose centre is at or beyond a coordinate in sub-pixels.
#[inline(always)]
pub(crate) const fn first_center<S: Subpixel>(coordinate: i32) -> i32 {
    (coordinate + (1 << (S::BITS - 1)) - 1) >> S::BITS
}

/// A triangle on the screen.
#[derive(Clone, Copy, Debug)]
pub struct Triangle<'v, S, D, V> {
    corners: [&'v ScreenVertex<S, D, V>; 3],
    area: i64,
}

impl<'v, S: Subpixel, D: DepthFormat, V: Interpolate> Triangle<'v, S, D, V> {
    /// From its corners. Returns `None` if one of them is not on the screen.
    #[must_use]
    pub fn new(corners: [&'v ScreenVertex<S, D, V>; 3]) -> Option<Self> {
        let is_on_screen = corners.iter().all(|corner| corner.is_on_screen());
        is_on_screen.then(|| Self::with_area(corners, signed_area(corners)))
    }

    /// From its corners, which are all on the screen, and their [`signed_area`].
    #[inline(always)]
    pub(crate) const fn with_area(corners: [&'v ScreenVertex<S, D, V>; 3], area: i64) -> Self {
        Self { corners, area }
    }

    #[inline(always)]
    pub(super) const fn corners(&self) -> [&'v ScreenVertex<S, D, V>; 3] {
        self.corners
    }

    #[inline(always)]
    pub(super) const fn area(&self) -> i64 {
        self.area
    }

    /// Its varyings as a function of the display's columns and rows.
    pub(super) fn varyings_field(&self) -> V::Field {
        self.fields(Layout { pitch: 0, origin: 0 }).1
    }

    /// Depth and varyings as functions of addresses.
    pub(super) fn fields(&self, layout: Layout) -> (D::Field, V::Field) {
        let sorted = self.sorted();
        let (setup, quick) = (sorted.setup(), sorted.quick());
        let to_first = sorted.to_first(layout.origin);
        (
            D::plane(&setup, quick, sorted.depths()).over_addresses(to_first, layout.pitch),
            V::plane(&setup, quick, sorted.varyings()).over_addresses(to_first, layout.pitch),
        )
    }

    /// Its corners from top to bottom.
    #[inline(always)]
    const fn sorted(&self) -> Sorted<'v, S, D, V> {
        let [mut top, mut middle, mut bottom] = self.corners;
        let mut middle_is_right = self.area >= 0;
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
        Sorted { top, middle, bottom, middle_is_right, area: self.area }
    }
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate> Primitive for Triangle<'_, S, D, V> {
    type Depth = D;
    type Varyings = V;

    /// A triangle without area covers no pixel.
    #[inline(always)]
    fn for_each_span<E>(
        &self,
        window: &Window,
        layout: Layout,
        mut visit: impl FnMut(&Span<'_, D, V>) -> Result<(), E>,
    ) -> Result<(), E> {
        let sorted = self.sorted();
        let Some(extent) = sorted.extent(window) else { return Ok(()) };
        let to_first = sorted.to_first(layout.origin);
        let quick = sorted.quick();
        // codegen: values that are used once a row stay in memory.
        let (mut depth, mut varyings);
        if quick.is_some() {
            let setup = sorted.setup();
            depth = D::plane(&setup, quick, sorted.depths()).over_addresses(to_first, layout.pitch);
            codegen::in_memory(&mut depth);
            varyings = V::plane(&setup, quick, sorted.varyings());
            varyings.count_addresses(to_first, layout.pitch);
        } else {
            let Sorted { top, middle, bottom, middle_is_right, area } = sorted;
            (depth, varyings) =
                exact_planes(top, middle, bottom, middle_is_right, area, to_first, layout.pitch);
        }
        codegen::in_memory(&mut varyings);
        sorted.for_each_row(&extent, window, layout, |row, start, end| {
            visit(&Span {
                row,
                start: start as usize,
                end: end as usize,
                depth: depth.at(start, row),
                depth_step: depth.per_column,
                varyings: &varyings,
            })
        })
    }
}

/// A triangle's corners from top to bottom.
#[derive(Clone, Copy, Debug)]
struct Sorted<'v, S, D, V> {
    top: &'v ScreenVertex<S, D, V>,
    middle: &'v ScreenVertex<S, D, V>,
    bottom: &'v ScreenVertex<S, D, V>,
    /// On which side of the long edge the middle corner lies.
    middle_is_right: bool,
    /// The doubled area of the corners in the triangle's order.
    area: i64,
}

/// The part of a triangle that may cover pixels of a window.
#[derive(Clone, Copy, Debug)]
struct Extent {
    first_row: i32,
    end_row: i32,
    /// Whether it reaches beyond the window's left or right side.
    is_cut: bool,
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate> Sorted<'_, S, D, V> {
    /// Returns `None` if no centre lies between the corners and in the window.
    #[inline(always)]
    fn extent(&self, window: &Window) -> Option<Extent> {
        let Self { top, bottom, .. } = self;
        let first_row = first_center::<S>(top.y).max(window.top);
        let end_row = first_center::<S>(bottom.y).min(window.bottom);
        let (left, right) = self.sides();
        let (first_column, end_column) = (first_center::<S>(left), first_center::<S>(right));
        if self.area == 0 || first_row >= end_row || first_column >= end_column {
            return None;
        }
        let is_cut = ((first_column - window.left) | (window.right - end_column)) < 0;
        Some(Extent { first_row, end_row, is_cut })
    }

    /// The least and the greatest x of its corners.
    #[inline(always)]
    fn sides(&self) -> (i32, i32) {
        let Self { top, middle, bottom, .. } = self;
        (top.x.min(middle.x).min(bottom.x), top.x.max(middle.x).max(bottom.x))
    }

    /// From the anchor, the pixel that holds the top corner, to the pixel at address 0 of the
    /// display's first row.
    #[inline(always)]
    const fn to_first(self, origin: i32) -> [i32; 2] {
        [origin.wrapping_sub(self.top.x >> S::BITS), -(self.top.y >> S::BITS)]
    }

    #[inline(always)]
    fn quick(&self) -> Option<QuickGradients> {
        let (left, right) = self.sides();
        // No fewer bits than width and height.
        let size = ((right - left) | (self.bottom.y - self.top.y)) as u32;
        QuickGradients::new::<S>(self.area, self.middle_is_right, size)
    }

    #[inline(always)]
    fn setup(&self) -> TriangleSetup<S> {
        let corners = [place(self.top), place(self.middle), place(self.bottom)];
        TriangleSetup::new(corners, self.middle_is_right, self.area)
    }

    #[inline(always)]
    const fn depths(&self) -> [D; 3] {
        [self.top.depth, self.middle.depth, self.bottom.depth]
    }

    #[inline(always)]
    const fn varyings(&self) -> [V; 3] {
        [self.top.varyings, self.middle.varyings, self.bottom.varyings]
    }

    /// Visits the rows that have covered pixels, with the address of the first one and that after
    /// the last.
    #[inline(always)]
    fn for_each_row<E>(
        &self,
        extent: &Extent,
        window: &Window,
        layout: Layout,
        mut visit: impl FnMut(i32, i32, i32) -> Result<(), E>,
    ) -> Result<(), E> {
        let Self { top, middle, bottom, middle_is_right, .. } = *self;
        let mut row = extent.first_row;
        // The long edge stays; the short one on the other side gives way to the next at the middle
        // corner's row.
        let mut long = Edge::new::<S>(place(top), place(bottom), row, &layout);
        codegen::in_memory(&mut long);
        let (mut upper, mut lower) = (top, middle);
        let mut end_row = first_center::<S>(middle.y).min(extent.end_row);
        if row >= end_row {
            (upper, lower, end_row) = (middle, bottom, extent.end_row);
        }
        loop {
            let mut short = Edge::new::<S>(place(upper), place(lower), row, &layout);
            let (left, right) = codegen::unknown(if middle_is_right {
                (&mut long, &mut short)
            } else {
                (&mut short, &mut long)
            });
            while row < end_row {
                let (mut start, mut end) = (left.boundary, right.boundary);
                if extent.is_cut {
                    let address = layout.row_address(row);
                    start = start.max(address.wrapping_add(window.left));
                    end = end.min(address.wrapping_add(window.right)).max(start);
                }
                // No address is negative. Compared as unsigned numbers they tell a target that
                // `start` is the lesser.
                if (start as usize) < end as usize {
                    visit(row, start, end)?;
                }
                left.step();
                right.step();
                row += 1;
            }
            if end_row == extent.end_row {
                return Ok(());
            }
            (upper, lower, end_row) = (middle, bottom, extent.end_row);
        }
    }
}

/// The place of a vertex in sub-pixels.
#[inline(always)]
const fn place<S, D, V>(vertex: &ScreenVertex<S, D, V>) -> [i32; 2] {
    [vertex.x, vertex.y]
}

/// Depth and varyings as functions of addresses, by exact divisions.
// codegen: the corners come one by one, because an array of them is put into memory before it is
// known whether it is needed.
#[cold]
#[inline(never)]
fn exact_planes<S: Subpixel, D: DepthFormat, V: Interpolate>(
    top: &ScreenVertex<S, D, V>,
    middle: &ScreenVertex<S, D, V>,
    bottom: &ScreenVertex<S, D, V>,
    middle_is_right: bool,
    area: i64,
    to_first: [i32; 2],
    pitch: i32,
) -> (D::Field, V::Field) {
    let sorted = Sorted { top, middle, bottom, middle_is_right, area };
    let setup = sorted.setup();
    (
        D::plane(&setup, None, sorted.depths()).over_addresses(to_first, pitch),
        V::plane(&setup, None, sorted.varyings()).over_addresses(to_first, pitch),
    )
}

#[cfg(test)]
mod tests {
    use std::{vec, vec::Vec};

    use super::*;
    use crate::{
        attribute::{Plane, Step as _},
        numbers::{S4, S8},
        random::Random,
    };

    /// Columns and rows of covered pixels with their depth and varyings.
    type Covered<D, V> = Vec<(i32, i32, D, V)>;

    /// The pixels of a triangle, by spans whose addresses follow `layout`.
    fn cover<S, D, V>(corners: [&ScreenVertex<S, D, V>; 3], layout: Layout) -> Covered<D, V::Sample>
    where
        S: Subpixel,
        D: DepthFormat,
        V: Interpolate<Field = Plane<<V as Interpolate>::Walk>>,
    {
        let mut covered = vec![];
        let triangle = Triangle::new(corners).unwrap();
        let Ok(()) = triangle.for_each_span(&WINDOW, layout, |span| {
            let plane = span.varyings;
            let (mut depth, mut varyings) = (span.depth, plane.at(span.start as i32, span.row));
            for address in span.start..span.end {
                let column = address as i32 + layout.origin - span.row * layout.pitch;
                covered.push((column, span.row, D::at(depth), V::sample(varyings)));
                depth = depth.wrapping_add(span.depth_step);
                varyings = varyings.wrapping_add(plane.per_column);
            }
            Ok::<(), core::convert::Infallible>(())
        });
        covered
    }

    const LAYOUT: Layout = Layout { pitch: 0, origin: WINDOW.left };

    const WINDOW: Window = Window { left: -20, top: -30, right: 300, bottom: 200 };

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

    /// Draws one triangle and compares coverage with the definition, depth and a varying with the
    /// exact plane.
    fn check<S: Subpixel>(corners: [[i32; 2]; 3], values: [u16; 3]) {
        let [a, b, c] = [0, 1, 2].map(|i| {
            let [x, y] = corners[i];
            ScreenVertex::<S, u32, [u16; 1]>::checked(
                x,
                y,
                u32::from(values[i]) << 16 | 0x1234,
                [values[i]],
            )
            .unwrap()
        });
        let area = signed_area([&a, &b, &c]);
        let pixels = cover([&a, &b, &c], LAYOUT);
        // The rows of a frame of 320 columns whose first pixel is the window's.
        let (pitch, origin) = (320, WINDOW.top * 320 + WINDOW.left);
        assert_eq!(pixels, cover([&a, &b, &c], Layout { pitch, origin }), "{corners:?} in rows");
        let mut covered = pixels.iter();
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
                // Half a unit of rounding; of error, 0.35 units by the bound for 4,096 pixels, less
                // than 0.32 in all these.
                assert!(
                    (f64::from(value.to_num::<u16>()) - exact).abs() < 0.82,
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

    fn random_triangles<S: Subpixel>(count: usize, seed: u64) {
        let mut random = Random::new(seed);
        let mut within = |limit: i32| random.within(-limit, limit);
        let unit = 1 << S::BITS;
        for extent in [2, unit, 5 * unit, 60 * unit, 400 * unit, 1000 * unit] {
            let room = (1000 * unit - extent).min(200 * unit);
            for _ in 0..count {
                let middle = [within(room), within(room)];
                let corners = [0; 3].map(|_| middle.map(|c| c + within(extent)));
                let values = [0; 3].map(|_| (within(32_767) + 32_768) as u16);
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
        let vertices = corners
            .map(|[x, y]| ScreenVertex::<S, u16, [u16; 0]>::checked(x, y, 65_535, []).unwrap());
        let [a, b, c] = &vertices;
        let area = signed_area([a, b, c]);
        let got: Vec<_> =
            cover([a, b, c], LAYOUT).iter().map(|&(x, y, depth, _)| (x, y, depth)).collect();
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
