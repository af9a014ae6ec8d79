//! Triangles, drawn span by span.

use core::array;

use super::{
    Vertex,
    paint::{Paint, Run},
};
use crate::stage::SIZE;

/// A triangle from its upper to its lower corner, with what changes over it.
pub(super) struct Triangle<const N: usize> {
    corners: [Vertex<N>; 3],
    planes: [Plane; N],
}

/// A value that changes linearly over the screen.
#[derive(Clone, Copy)]
struct Plane {
    /// At a corner.
    at: [f32; 2],
    value: f32,
    /// From one pixel to the next.
    per_x: f32,
    per_y: f32,
}

impl Plane {
    fn value(&self, x: f32, y: f32) -> f32 {
        self.value + self.per_x * (x - self.at[0]) + self.per_y * (y - self.at[1])
    }
}

impl<const N: usize> Triangle<N> {
    /// `None` for one that is seen from behind, or that is behind the camera in part: nothing is
    /// clipped.
    pub(super) fn of([a, b, c]: [Vertex<N>; 3]) -> Option<Self> {
        let (ab, ac) = ([b.x - a.x, b.y - a.y], [c.x - a.x, c.y - a.y]);
        let area = ab[0] * ac[1] - ab[1] * ac[0];
        let is_ahead = [a, b, c].iter().all(|corner| corner.nearness() > 0.0);
        // Corners run anticlockwise, and y downwards.
        if !(is_ahead && area < 0.0) {
            return None;
        }
        let per_area = 1.0 / area;
        let planes = array::from_fn(|i| {
            let value = a.values[i];
            let (to_b, to_c) = (b.values[i] - value, c.values[i] - value);
            Plane {
                at: [a.x, a.y],
                value,
                per_x: (to_b * ac[1] - to_c * ab[1]) * per_area,
                per_y: (to_c * ab[0] - to_b * ac[0]) * per_area,
            }
        });
        let mut corners = [a, b, c];
        for (upper, lower) in [(0, 1), (1, 2), (0, 1)] {
            if corners[lower].y < corners[upper].y {
                corners.swap(upper, lower);
            }
        }
        Some(Self { corners, planes })
    }

    pub(super) fn draw<P: Paint<N>>(&self, color: &mut [P::Color], depth: &mut [f32], paint: &P) {
        let [top, middle, bottom] = &self.corners;
        let long = Edge::between(top, bottom);
        let is_left = long.x(middle.y) < middle.x;
        for (upper, lower) in [(top, middle), (middle, bottom)] {
            let short = Edge::between(upper, lower);
            let [from, to] = [upper.y, lower.y].map(|y| first(y, SIZE.height));
            for row in from..to {
                let y = row as f32 + 0.5;
                let (a, b) = (long.x(y), short.x(y));
                let ends = if is_left { [a, b] } else { [b, a] };
                let [left, right] = ends.map(|x| first(x, SIZE.width));
                if left < right {
                    let first = row * SIZE.width as usize;
                    let pixels = first + left..first + right;
                    let x = left as f32 + 0.5;
                    let run = Run {
                        values: self.planes.map(|plane| plane.value(x, y)),
                        steps: self.planes.map(|plane| plane.per_x),
                    };
                    span(run, &mut color[pixels.clone()], &mut depth[pixels], paint);
                }
            }
        }
    }
}

/// Draws the pixels of a row, from the values at the first one.
fn span<P: Paint<N>, const N: usize>(
    run: Run<N>,
    mut color: &mut [P::Color],
    mut depth: &mut [f32],
    paint: &P,
) {
    for (pixels, Run { mut values, steps }) in P::pieces(run, color.len()) {
        let pieces = (color.split_off_mut(..pixels), depth.split_off_mut(..pixels));
        let (Some(color), Some(depth)) = pieces else { return };
        for (color, depth) in color.iter_mut().zip(depth) {
            let nearness = values[0];
            if nearness > *depth
                && let Some(seen) = paint.color(values)
            {
                *depth = nearness;
                *color = seen;
            }
            for (value, step) in values.iter_mut().zip(steps) {
                *value += step;
            }
        }
    }
}

/// An edge that is not level. Both triangles beside it compute the same places.
struct Edge {
    upper: [f32; 2],
    slope: f32,
}

impl Edge {
    fn between<const N: usize>(upper: &Vertex<N>, lower: &Vertex<N>) -> Self {
        let slope = (lower.x - upper.x) / (lower.y - upper.y);
        Self { upper: [upper.x, upper.y], slope }
    }

    fn x(&self, y: f32) -> f32 {
        self.upper[0] + (y - self.upper[1]) * self.slope
    }
}

/// The first of `count` pixels whose middle is not before a place; `count` if there is none.
fn first(place: f32, count: u32) -> usize {
    let place = place - 0.5;
    let whole = place as i32;
    let next = whole + i32::from((whole as f32) < place);
    next.clamp(0, count as i32) as usize
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::{vec, vec::Vec};

    use super::*;
    use crate::stage::PIXELS;

    /// The column of a level, and 1.
    struct Column;

    impl Paint<2> for Column {
        type Color = u32;

        fn vertex(nearness: f32, level: f32, _: [f32; 2]) -> [f32; 2] {
            [nearness, level]
        }

        fn color(&self, [_, level]: [f32; 2]) -> Option<u32> {
            Some((level * 320.0) as u32 + 1)
        }
    }

    fn vertex(x: f32, y: f32, nearness: f32) -> Vertex<2> {
        Vertex { x, y, values: Column::vertex(nearness, x / 320.0, [0.0; 2]) }
    }

    /// The pixels after some triangles: 1 and the column that the level is of, or 0; and depth.
    fn drawn(triangles: &[[Vertex<2>; 3]]) -> (Vec<u32>, Vec<f32>) {
        let (mut color, mut depth) = (vec![0; PIXELS], vec![0.0; PIXELS]);
        for &corners in triangles {
            let triangle = Triangle::of(corners).unwrap();
            triangle.draw(&mut color, &mut depth, &Column);
        }
        (color, depth)
    }

    #[test]
    fn triangles_beside_each_other_draw_each_pixel_once() {
        // A fan around a corner that is in no pixel's middle, over the whole display. Each is drawn
        // into memory of its own, and all pixels are in one.
        let middle = vertex(133.3, 77.7, 1.0);
        let rim: [[f32; 2]; 7] = [
            [-9.0, -7.0],
            [-5.0, 111.0],
            [-30.0, 300.0],
            [150.5, 260.5],
            [400.0, 290.0],
            [330.0, 99.9],
            [350.0, -60.0],
        ];
        let mut count = vec![0; PIXELS];
        for (i, &[x, y]) in rim.iter().enumerate() {
            let [next_x, next_y] = rim[(i + 1) % rim.len()];
            let corners = [middle, vertex(x, y, 1.0), vertex(next_x, next_y, 1.0)];
            let (color, _) = drawn(&[corners]);
            let pixels = color.iter().zip(&mut count);
            pixels.for_each(|(color, count)| *count += u32::from(*color > 0));
            // The other way round it is seen from behind.
            assert!(Triangle::of([corners[0], corners[2], corners[1]]).is_none());
        }
        assert!(count.iter().all(|&count| count == 1));
    }

    #[test]
    fn a_middle_on_an_edge_is_to_the_right_of_it() {
        let places = [-9.0, 0.5, 0.75, 1.5, 7.5, 8.5, 900.0];
        assert_eq!(places.map(|place| first(place, 8)), [0, 0, 1, 1, 7, 8, 8]);
    }

    #[test]
    fn values_are_those_of_the_middles_of_pixels_and_the_nearest_is_seen() {
        let corners = |nearness: [f32; 3]| {
            [
                vertex(10.0, 20.0, nearness[0]),
                vertex(10.0, 120.0, nearness[1]),
                vertex(210.0, 20.0, nearness[2]),
            ]
        };
        let (near, far) = (corners([0.5, 0.25, 0.75]), corners([0.3; 3]));
        for order in [[near, far], [far, near]] {
            let (color, depth) = drawn(&order);
            let place = 50 * SIZE.width as usize + 60;
            // From (10, 20) to (60.5, 50.5) by the gradients 0.25 / 200 and -0.25 / 100.
            let exact = 0.5 + 50.5 * 0.00125 - 30.5 * 0.0025;
            assert!((depth[place] - exact).abs() < 1e-6);
            assert_eq!(color[place], 61);
            // There the far one is nearer: 0.5 + 5.5 * 0.00125 - 95.5 * 0.0025 is 0.268.
            assert!((depth[115 * SIZE.width as usize + 15] - 0.3).abs() < 1e-6);
        }
    }
}
