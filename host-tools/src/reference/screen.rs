//! The arithmetic route: triangles that are already on the screen.

use super::coverage::{Region, for_each_covered};
use super::interpolate::{linear, linear_each, linear_slope_each, weight_slopes};
use super::picture::{Canvas, Picture};
use super::sample::Sample;

/// A corner of a triangle on the screen, with `N` varyings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenVertex<const N: usize> {
    /// Pixels from the left.
    pub x: f64,
    /// Pixels from the top.
    pub y: f64,
    /// Depth in any unit; larger is nearer.
    pub depth: f64,
    /// What is interpolated for the shading, in any unit.
    pub varyings: [f64; N],
}

/// A triangle that is projected, clipped, culled and snapped to a sub-pixel grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenTriangle<const N: usize> {
    /// The corners, in either winding.
    pub vertices: [ScreenVertex<N>; 3],
    /// The caller's number for it, which its samples and fragments carry. The pieces of a clipped
    /// triangle share one: its index in the mesh.
    pub number: usize,
}

/// Draws triangles, in their order, into a picture of `size` (width, height) pixels. `shade`
/// returns the colour of a sample, of any type, or `None` to discard it.
///
/// **Coverage is exact** for corners at multiples of 1/256 pixel (hence also 1/16) within ±4,096
/// pixels, and pictures up to 4,096 pixels wide and high: no operation of the half-plane test is
/// rounded. A correct rasterizer covers the same pixels for the same corners. A triangle without
/// area draws nothing.
///
/// Depth and varyings are linear in screen space, in the unit of the vertices. They are rounded:
/// by some 2^-50 of the largest vertex value.
#[must_use]
pub fn draw_screen<const N: usize, C: Copy>(
    triangles: &[ScreenTriangle<N>],
    size: (usize, usize),
    shade: impl Fn(Sample<N>) -> Option<C>,
) -> Picture<C> {
    draw(triangles, size, &shade)
}

/// [`draw_screen`], compiled once for all its closures.
fn draw<const N: usize, C: Copy>(
    triangles: &[ScreenTriangle<N>],
    size: (usize, usize),
    shade: &dyn Fn(Sample<N>) -> Option<C>,
) -> Picture<C> {
    let region = Region::whole(size);
    let mut canvas = Canvas::new(size);
    for &ScreenTriangle { vertices, number } in triangles {
        let depths = vertices.map(|vertex| vertex.depth);
        let varyings = vertices.map(|vertex| vertex.varyings);
        let corners = vertices.map(|vertex| [vertex.x, vertex.y]);
        let [per_column, per_row] =
            weight_slopes(corners).map(|slopes| linear_slope_each(slopes, varyings));
        for_each_covered(corners, &region, &mut |pixel, weights, span| {
            let sample = Sample {
                pixel,
                span: [span.start, span.end - 1],
                triangle: number,
                depth: linear(weights, depths),
                varyings: linear_each(weights, varyings),
                per_column,
                per_row,
            };
            canvas.shade(sample, shade);
        });
    }
    canvas.into_picture()
}

#[cfg(test)]
mod tests {
    use super::super::picture::Fragment;
    use super::super::random::Random;
    use super::*;

    const SIZE: (usize, usize) = (48, 32);
    const ORANGE: [f64; 3] = [200.0, 100.0, 50.0];

    /// A triangle with a light level.
    fn triangle(
        corners: [[f64; 2]; 3],
        depth: impl Fn(f64, f64) -> f64,
        level: f64,
    ) -> ScreenTriangle<1> {
        let vertices =
            corners.map(|[x, y]| ScreenVertex { x, y, depth: depth(x, y), varyings: [level] });
        ScreenTriangle { vertices, number: 0 }
    }

    /// Triangles numbered in their order.
    fn numbered<const N: usize>(triangles: &[ScreenTriangle<N>]) -> Vec<ScreenTriangle<N>> {
        (0..).zip(triangles).map(|(number, t)| ScreenTriangle { number, ..*t }).collect()
    }

    /// Orange, lit by the only varying.
    fn draw(triangles: &[ScreenTriangle<1>]) -> Picture {
        draw_screen(triangles, SIZE, lit)
    }

    #[expect(clippy::unnecessary_wraps, reason = "a shading closure may discard")]
    fn lit(Sample { varyings: [level], .. }: Sample<1>) -> Option<[f64; 3]> {
        Some(ORANGE.map(|channel| channel * level))
    }

    /// Random triangles whose depth and varyings are planes over the screen, each varying another:
    /// every sample lies on the planes.
    fn check_planes<const N: usize>(seed: u64) {
        let mut random = Random(seed);
        let mut fragments = 0;
        for _ in 0..200 {
            let mut plane = || {
                let [base, right, down] = [(); 3].map(|()| random.real(-1.0, 1.0));
                move |x: f64, y: f64| base + right * x + down * y
            };
            let depth = plane();
            let planes = [(); N].map(|()| plane());
            let corners =
                [(); 3].map(|()| [(); 2].map(|()| random.snapped(-8.0, 56.0, 1.0 / 16.0)));
            let vertices = corners.map(|[x, y]| ScreenVertex::<N> {
                x,
                y,
                depth: depth(x, y),
                varyings: std::array::from_fn(|i| planes[i](x, y)),
            });
            let picture = draw_screen(&[ScreenTriangle { vertices, number: 7 }], SIZE, |sample| {
                let [x, y] = sample.pixel.map(|c| c as f64 + 0.5);
                for (i, plane) in planes.iter().enumerate() {
                    // Values below 128, a dozen roundings of 2^-53 each: 2e-13.
                    assert!((sample.varyings[i] - plane(x, y)).abs() < 2e-13);
                    let [right, down] = [plane(x + 1.0, y), plane(x, y + 1.0)];
                    // Thin triangles multiply that by their length over their width, which is at
                    // least 1/16 of 1/16 over their length.
                    let slopes = [right, down].map(|value| value - plane(x, y));
                    assert!((sample.per_column[i] - slopes[0]).abs() < 1e-10);
                    assert!((sample.per_row[i] - slopes[1]).abs() < 1e-10);
                }
                assert!((sample.depth - depth(x, y)).abs() < 2e-13);
                assert_eq!(sample.triangle, 7);
                Some([x, y, sample.depth])
            });
            for y in 0..SIZE.1 {
                for x in 0..SIZE.0 {
                    for fragment in picture.fragments(x, y) {
                        fragments += 1;
                        let center = [x as f64 + 0.5, y as f64 + 0.5];
                        assert_eq!(fragment.color, [center[0], center[1], fragment.depth]);
                        assert!((fragment.depth - depth(center[0], center[1])).abs() < 2e-13);
                        assert_eq!(fragment.triangle, 7);
                    }
                }
            }
        }
        assert!(fragments > 10_000, "{fragments}");
    }

    #[test]
    fn depth_and_any_number_of_varyings_are_the_planes_through_the_vertices() {
        check_planes::<0>(7);
        check_planes::<1>(7);
        check_planes::<2>(13);
        check_planes::<3>(14);
    }

    #[test]
    fn a_level_triangle_has_exactly_the_depth_and_color_of_its_vertices() {
        let picture = draw(&[triangle([[0.0, 0.0], [40.0, 0.0], [0.0, 30.0]], |_, _| 0.1, 0.7)]);
        let color = ORANGE.map(|channel| channel * 0.7);
        assert_eq!(picture.nearest(5, 5), Some(&Fragment { depth: 0.1, color, triangle: 0 }));
        assert_eq!(picture.fragments(7, 11), picture.fragments(5, 5));
    }

    #[test]
    fn the_place_in_the_picture_and_the_triangle_can_decide_the_color() {
        let corners = [[0.0, 0.0], [40.0, 0.0], [0.0, 30.0]];
        let pair = numbered(&[0.5, 0.25].map(|depth| triangle(corners, |_, _| depth, 1.0)));
        let colors = [ORANGE, [1.0, 2.0, 3.0]];
        let picture = draw_screen(&pair, SIZE, |Sample { pixel: [x, y], triangle, .. }| {
            Some(if x % 2 == y % 2 { colors[triangle] } else { [0.0; 3] })
        });
        let seen = |x, y| picture.fragments(x, y).iter().map(|f| f.color).collect::<Vec<_>>();
        assert_eq!(seen(3, 5), colors);
        assert_eq!(seen(4, 5), [[0.0; 3]; 2]);
        assert_eq!(seen(4, 6), colors);
    }

    #[test]
    fn a_discarded_fragment_shows_what_is_behind() {
        let corners = [[0.0, 0.0], [40.0, 0.0], [0.0, 30.0]];
        let layers = numbered(&[0.75, 0.5].map(|depth| triangle(corners, |_, _| depth, 1.0)));
        // The front layer has holes in every other column.
        let picture = draw_screen(&layers, SIZE, |sample| {
            let is_hole = sample.triangle == 0 && sample.pixel[0] % 2 == 1;
            lit(sample).filter(|_| !is_hole)
        });
        for (x, layers, front) in [(4, 2, 0), (5, 1, 1), (6, 2, 0), (7, 1, 1)] {
            assert_eq!(picture.layers(x, 3), layers);
            assert_eq!(picture.nearest(x, 3).map(|fragment| fragment.triangle), Some(front));
        }
        let nothing = draw_screen(&layers, SIZE, |_| None);
        assert_eq!(nothing, draw(&[]));
    }

    #[test]
    fn layers_keep_the_drawing_order_and_the_triangle_number() {
        let corners = [[0.0, 0.0], [40.0, 0.0], [0.0, 30.0]];
        let depths = [0.5, 0.75, 0.75, 0.25];
        let picture = draw(&numbered(&depths.map(|depth| triangle(corners, |_, _| depth, 1.0))));
        let fragments = picture.fragments(3, 4);
        assert_eq!(
            fragments.iter().map(|fragment| fragment.triangle).collect::<Vec<_>>(),
            [0, 1, 2, 3]
        );
        assert_eq!(fragments.iter().map(|fragment| fragment.depth).collect::<Vec<_>>(), depths);
        assert_eq!(picture.nearest(3, 4).map(|fragment| fragment.triangle), Some(1));
        assert_eq!(picture.layers(47, 31), 0);
    }

    #[test]
    fn the_winding_changes_nothing() {
        let corners = [[3.5, 2.5], [44.0, 11.25], [17.5, 30.5]];
        let turned = [corners[0], corners[2], corners[1]];
        let depth = |x: f64, y: f64| 0.25 + x / 64.0 + y / 128.0;
        let [one, other] = [corners, turned].map(|corners| draw(&[triangle(corners, depth, 1.0)]));
        for y in 0..SIZE.1 {
            for x in 0..SIZE.0 {
                assert_eq!(one.layers(x, y), other.layers(x, y));
                for (a, b) in one.fragments(x, y).iter().zip(other.fragments(x, y)) {
                    assert!(
                        (a.depth - b.depth).abs() < 1e-15,
                        "two sums of the same three terms below 2"
                    );
                }
            }
        }
    }

    #[test]
    fn an_empty_list_and_a_picture_without_pixels_are_fine() {
        assert_eq!(draw(&[]).layers(0, 0), 0);
        let everywhere = triangle([[-9.0, -9.0], [99.0, -9.0], [-9.0, 99.0]], |_, _| 0.5, 1.0);
        assert_eq!(draw_screen(&[everywhere], (0, 7), lit).width(), 0);
        assert_eq!(draw_screen(&[everywhere], (1, 1), lit).layers(0, 0), 1);
    }
}
