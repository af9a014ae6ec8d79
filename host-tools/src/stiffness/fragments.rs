//! The pixels of a triangle on the screen: what the core steps along its spans, and exact planes.

use std::convert::Infallible;

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{DepthFormat, Interpolate, Step as _},
    geometry::ScreenVertex,
    numbers::{S8, Subpixel},
    raster::{Layout, Primitive as _, Triangle, Window},
};

/// All of the guard band.
const WINDOW: Window =
    Window::new(&Rectangle::new(Point::new(-1024, -1024), Size::new(2048, 2048)));
const PITCH: i32 = 2048;
const LAYOUT: Layout = Layout { pitch: PITCH, origin: -1024 * PITCH - 1024 };

/// Visits the pixels that a triangle covers, by column and row, with its depth and its varyings
/// there as the core steps them.
pub(super) fn visit<S: Subpixel, D: DepthFormat, V: Interpolate>(
    corners: &[ScreenVertex<S, D, V>; 3],
    mut pixel: impl FnMut([i32; 2], D::Walk, V::Walk),
) {
    let triangle = Triangle::new(corners.each_ref()).expect("its corners are on the screen");
    let Ok(()) = triangle.for_each_span(&WINDOW, LAYOUT, |span| {
        let mut depth = span.depth;
        let mut column = span.start as i32 - LAYOUT.row_address(span.row);
        let start = [span.start as i32, span.row];
        let (first, rest) = V::walk(span.varyings, start, span.end - span.start);
        for piece in [first].into_iter().chain(rest) {
            let mut varyings = piece.first;
            for _ in 0..piece.pixels {
                pixel([column, span.row], depth, varyings);
                depth = depth.wrapping_add(span.depth_step);
                varyings = varyings.wrapping_add(piece.step);
                column += 1;
            }
        }
        Ok::<(), Infallible>(())
    });
}

/// The corners of a triangle, in sub-pixels, with depths and nothing else.
pub(super) fn corners<D: DepthFormat>(
    places: [[i32; 2]; 3],
    depths: [D; 3],
) -> [ScreenVertex<S8, D, [u16; 0]>; 3] {
    [0, 1, 2].map(|i| {
        let [x, y] = places[i];
        ScreenVertex::checked(x, y, depths[i], []).expect("it is in the guard band")
    })
}

/// A triangle whose corners are in sub-pixels, in exact integers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exact(pub(super) [[i32; 2]; 3]);

impl Exact {
    /// The weights of the corners at the centre of a pixel, times their sum.
    pub(super) fn weights<S: Subpixel>(&self, pixel: [i32; 2]) -> [i128; 3] {
        let [a, b, c] = self.0;
        let p = pixel.map(|c| (2 * c + 1) << (S::BITS - 1));
        let area = |a: [i32; 2], b: [i32; 2], c: [i32; 2]| {
            let [dx1, dy1, dx2, dy2] =
                [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]].map(i128::from);
            dx1 * dy2 - dx2 * dy1
        };
        [area(p, b, c), area(a, p, c), area(a, b, p)]
    }

    /// How much more a number with `bits` binary digits behind the point is at the centre of a
    /// pixel than the plane through the corners' numbers, in units.
    pub(super) fn error<S: Subpixel>(
        &self,
        numbers: [i64; 3],
        pixel: [i32; 2],
        number: i64,
        bits: u32,
    ) -> f64 {
        let weights = self.weights::<S>(pixel);
        let exact: i128 = (0..3).map(|i| weights[i] * i128::from(numbers[i])).sum();
        let whole: i128 = weights.iter().sum();
        // The numerator is exact, and the quotient is small.
        (i128::from(number) * whole - (exact << bits)) as f64 / (whole << bits) as f64
    }
}
