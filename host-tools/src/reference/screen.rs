//! The arithmetic route: triangles that are already on the screen.

use super::coverage::{Region, for_each_covered};
use super::interpolate::linear;
use super::picture::{Canvas, Fragment, Picture};

/// A corner of a triangle on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenVertex {
    /// Pixels from the left.
    pub x: f64,
    /// Pixels from the top.
    pub y: f64,
    /// Depth in any unit; larger is nearer.
    pub depth: f64,
    /// Light level, which multiplies the color.
    pub level: f64,
}

/// A triangle that is projected, clipped, culled and snapped to a sub-pixel grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenTriangle {
    /// The corners, in either winding. Flat shading has three equal levels.
    pub vertices: [ScreenVertex; 3],
    /// Red, green, blue at level 1, in 0..=255.
    pub color: [f64; 3],
}

/// Draws triangles, in their order, into a picture of `size` (width, height) pixels.
///
/// **Coverage is exact** for corners at multiples of 1/256 pixel (hence also 1/16) within ±4,096
/// pixels, and pictures up to 4,096 pixels wide and high: no operation of the half-plane test is
/// rounded. Against it, a rasterizer's coverage of the same corners may differ in no pixel. A
/// triangle without area draws nothing.
///
/// Depth and level are linear in screen space, so they come in whatever unit the caller gives the
/// vertices. They are rounded: by some 2^-50 of the largest vertex value.
///
/// # Panics
///
/// For more than 2^32 triangles.
#[must_use]
pub fn draw_screen(triangles: &[ScreenTriangle], size: (usize, usize)) -> Picture {
    let region = Region::whole(size);
    let mut canvas = Canvas::new(size);
    for (number, ScreenTriangle { vertices, color }) in triangles.iter().enumerate() {
        let triangle = u32::try_from(number).expect("no more than 2^32 triangles");
        let depths = vertices.map(|vertex| vertex.depth);
        let levels = vertices.map(|vertex| vertex.level);
        for_each_covered(vertices.map(|vertex| [vertex.x, vertex.y]), &region, |x, y, weights| {
            let depth = linear(weights, depths);
            let level = linear(weights, levels);
            let color = color.map(|channel| channel * level);
            canvas.add(x, y, Fragment { depth, color, triangle });
        });
    }
    canvas.into_picture()
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    const SIZE: (usize, usize) = (48, 32);

    fn triangle(
        corners: [[f64; 2]; 3],
        depth: impl Fn(f64, f64) -> f64,
        level: f64,
    ) -> ScreenTriangle {
        let vertices = corners.map(|[x, y]| ScreenVertex { x, y, depth: depth(x, y), level });
        ScreenTriangle { vertices, color: [200.0, 100.0, 50.0] }
    }

    #[test]
    fn depth_and_level_are_the_plane_through_the_vertices() {
        let mut random = Random(7);
        let mut fragments = 0;
        for _ in 0..200 {
            let [base, right, down] = [(); 3].map(|()| random.real(-1.0, 1.0));
            let plane = |x: f64, y: f64| base + right * x + down * y;
            let corners =
                [(); 3].map(|()| [(); 2].map(|()| random.snapped(-8.0, 56.0, 1.0 / 16.0)));
            let mut sloped = triangle(corners, plane, 0.0);
            for vertex in &mut sloped.vertices {
                vertex.level = 2.0 * vertex.depth;
            }
            let picture = draw_screen(&[sloped], SIZE);
            for y in 0..SIZE.1 {
                for x in 0..SIZE.0 {
                    for fragment in picture.fragments(x, y) {
                        fragments += 1;
                        let expected = plane(x as f64 + 0.5, y as f64 + 0.5);
                        // Values below 128, a dozen roundings of 2^-53 each: 2e-13; the color is
                        // 400 times that.
                        assert!((fragment.depth - expected).abs() < 2e-13);
                        assert!((fragment.color[0] - 400.0 * expected).abs() < 1e-10);
                        assert!((fragment.color[2] - 100.0 * expected).abs() < 1e-10);
                    }
                }
            }
        }
        assert!(fragments > 10_000, "{fragments}");
    }

    #[test]
    fn a_level_triangle_has_exactly_the_depth_and_color_of_its_vertices() {
        let picture =
            draw_screen(&[triangle([[0.0, 0.0], [40.0, 0.0], [0.0, 30.0]], |_, _| 0.1, 0.7)], SIZE);
        let color = [200.0 * 0.7, 100.0 * 0.7, 50.0 * 0.7];
        assert_eq!(picture.nearest(5, 5), Some(&Fragment { depth: 0.1, color, triangle: 0 }));
        assert_eq!(picture.fragments(7, 11), picture.fragments(5, 5));
    }

    #[test]
    fn layers_keep_the_drawing_order_and_the_triangle_number() {
        let corners = [[0.0, 0.0], [40.0, 0.0], [0.0, 30.0]];
        let depths = [0.5, 0.75, 0.75, 0.25];
        let triangles = depths.map(|depth| triangle(corners, |_, _| depth, 1.0));
        let picture = draw_screen(&triangles, SIZE);
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
        let [one, other] =
            [corners, turned].map(|corners| draw_screen(&[triangle(corners, depth, 1.0)], SIZE));
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
        assert_eq!(draw_screen(&[], SIZE).layers(0, 0), 0);
        let everywhere = triangle([[-9.0, -9.0], [99.0, -9.0], [-9.0, 99.0]], |_, _| 0.5, 1.0);
        assert_eq!(draw_screen(&[everywhere], (0, 7)).width(), 0);
        assert_eq!(draw_screen(&[everywhere], (1, 1)).layers(0, 0), 1);
    }
}
