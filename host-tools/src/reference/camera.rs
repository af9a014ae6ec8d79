//! The camera: from world space to view space to the screen.

use std::ops::Range;

/// The rectangle of the screen that the camera's picture fills, in pixels from the top left corner,
/// y down.
///
/// The view axis meets the screen in its middle. Nothing is drawn to a pixel whose centre lies
/// outside `x..x + width` or `y..y + height`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Left side, in pixels.
    pub x: f64,
    /// Top side, in pixels.
    pub y: f64,
    /// Width in pixels, above 0.
    pub width: f64,
    /// Height in pixels, above 0.
    pub height: f64,
}

impl Viewport {
    /// The middle of the rectangle, in pixels.
    #[must_use]
    pub const fn center(&self) -> [f64; 2] {
        [self.x + self.width / 2.0, self.y + self.height / 2.0]
    }

    /// The columns and the rows of a picture of `size` (width, height) pixels whose centres lie in
    /// the rectangle, its left and top side included.
    #[must_use]
    pub fn pixels(&self, (width, height): (usize, usize)) -> [Range<usize>; 2] {
        // The first centre n + 0.5 at or after a side is that of n = ceil(side - 0.5); `as` turns a
        // negative one into 0.
        let first = |side: f64| (side - 0.5).ceil() as usize;
        let columns = first(self.x)..first(self.x + self.width).min(width);
        let rows = first(self.y)..first(self.y + self.height).min(height);
        [columns, rows]
    }
}

/// How view space is projected; pixels are square, so one scale serves x and y.
///
/// `near` and `far` are distances along the view axis in world units, with `near < far`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// All rays meet in the eye.
    Perspective {
        /// Distance from the eye to the screen, measured in pixels: a point one unit off the axis,
        /// one unit away, lands this many pixels off the middle.
        focal_length_px: f64,
        /// Distance of the near plane, above 0.
        near: f64,
        /// Distance of the far plane.
        far: f64,
    },
    /// All rays are parallel to the view axis.
    Orthographic {
        /// Pixels that one world unit covers.
        pixels_per_unit: f64,
        /// Distance of the near plane, of either sign.
        near: f64,
        /// Distance of the far plane.
        far: f64,
    },
}

impl Projection {
    /// The focal length in pixels of a viewport `height` pixels high that shows the vertical angle
    /// `fov_y`, in radians within 0..π: `height / 2` over `tan(fov_y / 2)`.
    #[must_use]
    pub fn focal_length_px(fov_y: f64, height: f64) -> f64 {
        height / 2.0 / (fov_y / 2.0).tan()
    }

    /// The distances of the near and the far plane along the view axis.
    #[must_use]
    pub const fn depth_range(&self) -> [f64; 2] {
        match *self {
            Self::Perspective { near, far, .. } | Self::Orthographic { near, far, .. } => {
                [near, far]
            }
        }
    }
}

/// A projected point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenPoint {
    /// Pixels from the left.
    pub x: f64,
    /// Pixels from the top.
    pub y: f64,
    /// 1 at the near plane and falling with the distance z: `near / z` in perspective, so `near /
    /// far` at the far plane; `(far - z) / (far - near)`, so 0 at the far plane, in an
    /// orthographic projection. Both are linear in screen space.
    pub depth: f64,
    /// The reciprocal of the homogeneous w, which is the distance z in perspective and 1 in an
    /// orthographic projection.
    pub inverse_w: f64,
}

/// A camera at `eye` that looks at `target`, with `up` to the top of the picture.
///
/// `eye` and `target` must differ and `up` must not be parallel to the line between them; otherwise
/// the axes of view space are not defined, all coordinates become NaN, and nothing is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position in world space.
    pub eye: [f64; 3],
    /// A point on the view axis in front of the camera, in world space.
    pub target: [f64; 3],
    /// A direction that appears upright in the picture; any length above 0.
    pub up: [f64; 3],
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Where on the screen the picture lies.
    pub viewport: Viewport,
}

impl Camera {
    /// The orthonormal axes of view space in world coordinates: to the right, up, and backward (out
    /// of the picture).
    #[must_use]
    pub fn axes(&self) -> [[f64; 3]; 3] {
        let backward = normalize(subtract(self.eye, self.target));
        let right = normalize(cross(self.up, backward));
        [right, cross(backward, right), backward]
    }

    /// A world-space point in view space: rotated and moved, never scaled or mirrored. The distance
    /// along the view axis is `-z`.
    #[must_use]
    pub fn to_view(&self, world: [f64; 3]) -> [f64; 3] {
        let from_eye = subtract(world, self.eye);
        self.axes().map(|axis| dot(axis, from_eye))
    }

    /// A direction of the world in view space.
    #[must_use]
    pub fn turn_to_view(&self, direction: [f64; 3]) -> [f64; 3] {
        self.axes().map(|axis| dot(axis, direction))
    }

    /// A view-space point on the screen. In perspective the point must lie in front of the eye (`z
    /// < 0`).
    #[must_use]
    pub fn to_screen(&self, view: [f64; 3]) -> ScreenPoint {
        let [center_x, center_y] = self.viewport.center();
        let [right, up, backward] = view;
        let distance = -backward;
        match self.projection {
            Projection::Perspective { focal_length_px, near, .. } => ScreenPoint {
                x: center_x + focal_length_px * right / distance,
                y: center_y - focal_length_px * up / distance,
                depth: near / distance,
                inverse_w: 1.0 / distance,
            },
            Projection::Orthographic { pixels_per_unit, near, far } => ScreenPoint {
                x: center_x + pixels_per_unit * right,
                y: center_y - pixels_per_unit * up,
                depth: (far - distance) / (far - near),
                inverse_w: 1.0,
            },
        }
    }
}

pub(super) const fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) const fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) const fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn normalize(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    a.map(|component| component / length)
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    const VIEWPORT: Viewport = Viewport { x: 10.0, y: 20.0, width: 320.0, height: 240.0 };
    const PERSPECTIVE: Projection =
        Projection::Perspective { focal_length_px: 200.0, near: 0.5, far: 50.0 };
    const ORTHOGRAPHIC: Projection =
        Projection::Orthographic { pixels_per_unit: 8.0, near: -2.0, far: 6.0 };

    fn camera(projection: Projection) -> Camera {
        Camera {
            eye: [1.0, 2.0, 3.0],
            target: [4.0, 0.0, -5.0],
            up: [0.1, 2.0, 0.3],
            projection,
            viewport: VIEWPORT,
        }
    }

    /// Rounding of a short chain of f64 operations on numbers below 1,000: a few times 1,000 *
    /// 2^-53.
    fn assert_close(actual: f64, expected: f64) {
        assert!((actual - expected).abs() < 1e-11, "{actual} instead of {expected}");
    }

    #[test]
    fn the_target_lies_on_the_view_axis_in_front_of_the_camera() {
        let [right, up, backward] = camera(PERSPECTIVE).to_view([4.0, 0.0, -5.0]);
        assert_close(right, 0.0);
        assert_close(up, 0.0);
        assert_close(backward, -77.0_f64.sqrt()); // 3^2 + 2^2 + 8^2
    }

    #[test]
    fn a_camera_on_the_z_axis_keeps_the_world_axes() {
        let camera = Camera {
            eye: [0.0, 0.0, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            ..camera(PERSPECTIVE)
        };
        assert_eq!(camera.to_view([2.0, 3.0, 1.0]), [2.0, 3.0, -4.0]);
        let point = camera.to_screen([2.0, 3.0, -4.0]);
        assert_eq!(
            point,
            ScreenPoint { x: 170.0 + 100.0, y: 140.0 - 150.0, depth: 0.125, inverse_w: 0.25 }
        );
    }

    #[test]
    fn the_axes_are_orthonormal_and_right_handed() {
        let mut random = Random(1);
        for _ in 0..1_000 {
            let mut vector = || [(); 3].map(|()| random.real(-3.0, 3.0));
            let camera =
                Camera { eye: vector(), target: vector(), up: vector(), ..camera(PERSPECTIVE) };
            let [right, up, backward] = camera.axes();
            for (a, b, product) in [(right, right, 1.0), (up, up, 1.0), (backward, backward, 1.0)] {
                assert_close(dot(a, b), product);
            }
            // Their determinant: +1 for a rotation, -1 for a mirror image.
            assert_close(dot(cross(right, up), backward), 1.0);
            assert!(dot(camera.up, up) > 0.0);
        }
    }

    #[test]
    fn right_is_right_and_up_is_up_on_the_screen() {
        for projection in [PERSPECTIVE, ORTHOGRAPHIC] {
            let camera = camera(projection);
            let [right, up, backward] = camera.axes();
            let at = |right_by: f64, up_by: f64| {
                let world = [0, 1, 2].map(|i| {
                    camera.eye[i] - 2.0 * backward[i] + right_by * right[i] + up_by * up[i]
                });
                camera.to_screen(camera.to_view(world))
            };
            let scale = if projection == PERSPECTIVE { 100.0 } else { 8.0 };
            assert_close(at(0.0, 0.0).x, 170.0);
            assert_close(at(0.0, 0.0).y, 140.0);
            assert_close(at(1.0, 0.0).x, 170.0 + scale);
            assert_close(at(0.0, 1.0).y, 140.0 - scale);
        }
    }

    #[test]
    fn depth_runs_from_one_at_the_near_plane() {
        let depth =
            |projection, distance: f64| camera(projection).to_screen([0.3, 0.4, -distance]).depth;
        assert_eq!(depth(PERSPECTIVE, 0.5), 1.0);
        assert_eq!(depth(PERSPECTIVE, 1.0), 0.5);
        assert_eq!(depth(PERSPECTIVE, 50.0), 0.01);
        assert_eq!(depth(ORTHOGRAPHIC, -2.0), 1.0);
        assert_eq!(depth(ORTHOGRAPHIC, 0.0), 0.75);
        assert_eq!(depth(ORTHOGRAPHIC, 6.0), 0.0);
    }

    #[test]
    fn the_field_of_view_fills_the_height() {
        let fov_y = 1.1_f64;
        let focal_length_px = Projection::focal_length_px(fov_y, VIEWPORT.height);
        let camera = camera(Projection::Perspective { focal_length_px, near: 0.5, far: 50.0 });
        let rise = (fov_y / 2.0).tan();
        assert_close(camera.to_screen([0.0, 7.0 * rise, -7.0]).y, VIEWPORT.y);
        assert_close(camera.to_screen([0.0, -7.0 * rise, -7.0]).y, VIEWPORT.y + VIEWPORT.height);
        assert_close(Projection::focal_length_px(std::f64::consts::FRAC_PI_2, 240.0), 120.0);
    }

    #[test]
    fn the_depth_range_is_that_of_the_projection() {
        assert_eq!(PERSPECTIVE.depth_range(), [0.5, 50.0]);
        assert_eq!(ORTHOGRAPHIC.depth_range(), [-2.0, 6.0]);
    }

    #[test]
    fn a_viewport_holds_the_pixels_whose_centers_it_holds() {
        for (x, y, width, height, columns, rows) in [
            (5.0, 3.0, 20.0, 10.0, 5..25, 3..13),
            (4.5, 2.75, 20.0, 10.0, 4..24, 3..13),
            (4.75, 2.5, 0.5, 1.0, 5..5, 2..3),
            (-10.0, -5.0, 20.0, 100.0, 0..10, 0..32),
        ] {
            let viewport = Viewport { x, y, width, height };
            assert_eq!(viewport.pixels((48, 32)), [columns, rows], "{viewport:?}");
        }
        let [columns, _] = Viewport { x: 100.0, y: 0.0, width: 20.0, height: 9.0 }.pixels((48, 32));
        assert!(columns.is_empty());
    }
}
