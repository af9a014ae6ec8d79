//! Where the viewer is and what it sees.
//!
//! A [`Camera`] looks along the -z axis of its own space, with y up and x to the right. It carries
//! a projection ([`Perspective`] or [`Orthographic`]) and a viewport: the rectangle of the display
//! that shows the picture, in pixels from the display's top-left corner.

mod control;
mod projection;

pub use control::{FirstPerson, Orbit};
use embedded_graphics_core::primitives::Rectangle;
pub use projection::{Distance, Orthographic, Perspective};

use crate::numbers::{Rotation, Turn, Vec3, cross, unit};

/// The largest width and height of a viewport, in pixels.
///
/// Vertices on the screen are within 1,024 pixels of the viewport's middle: the guard band.
pub const MAX_VIEWPORT: u32 = 2048;

/// The largest distance of a viewport from the display's origin along x or y, in pixels.
pub const MAX_VIEWPORT_OFFSET: i32 = 16_384;

/// What is wrong with a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CameraError {
    /// The field of view is 0, or half a turn or more.
    FieldOfView,
    /// The focal length or the height of the view is 0.
    Magnification,
    /// The near plane is not in front of the camera, or the far plane is not behind the near plane.
    DepthRange,
    /// The viewport is empty, or wider or higher than [`MAX_VIEWPORT`].
    ViewportSize,
    /// The viewport is farther than [`MAX_VIEWPORT_OFFSET`] from the display's origin.
    ViewportOffset,
    /// The camera is at the point that it looks at, or looks along its up direction.
    Direction,
}

impl core::fmt::Display for CameraError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::FieldOfView => "the field of view must be over 0 and under half a turn",
            Self::Magnification => "the focal length, or the height of the view, must be over 0",
            Self::DepthRange => "the near plane must be over 0 and the far plane beyond it",
            Self::ViewportSize => "the viewport must be 1 to 2048 pixels wide and high",
            Self::ViewportOffset => {
                "the viewport must lie within 16384 pixels of the display's origin"
            }
            Self::Direction => {
                "the camera must look at a point other than its own, not along its up direction"
            }
        })
    }
}

impl core::error::Error for CameraError {}

/// A camera: place, direction, projection and viewport.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Camera<P = Perspective> {
    eye: Vec3,
    /// The directions right, down and forward in world space, in Q30.
    axes: [[i32; 3]; 3],
    projection: P,
    viewport: Rectangle,
}

impl<P> Camera<P> {
    /// A camera at `eye` that looks at `target`, turned so that `up` points upwards in the picture.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::Direction`] if `target` is `eye` or if `up` is along the direction to
    /// it (however near to that it comes, the picture is upright), and
    /// [`CameraError::ViewportSize`] or [`CameraError::ViewportOffset`] for a bad viewport.
    pub fn look_at(
        eye: Vec3,
        target: Vec3,
        up: Vec3,
        projection: P,
        viewport: Rectangle,
    ) -> Result<Self, CameraError> {
        let [e, t, up] = [eye, target, up].map(|v| v.to_bits().map(i64::from));
        let way: [i64; 3] = core::array::from_fn(|i| t[i] - e[i]);
        let forward = unit(way).ok_or(CameraError::Direction)?;
        // The cross product of the exact vectors: that of unit vectors, rounded to Q30, would turn
        // the picture where they are nearly parallel. It has up to 66 bits. Of a large one the
        // lowest do not matter.
        let product = |v: [i64; 3]| -> [i64; 3] {
            core::array::from_fn(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                v[j] * up[k] - v[k] * up[j]
            })
        };
        let (upper, lower) = (product(way.map(|c| c >> 3)), product(way.map(|c| c & 7)));
        let is_large = upper.iter().any(|c| c.unsigned_abs() >> 59 != 0);
        let right = unit(if is_large {
            upper
        } else {
            core::array::from_fn(|i| (upper[i] << 3) + lower[i])
        });
        let right = right.ok_or(CameraError::Direction)?;
        Self::new(eye, [right, cross(forward, right), forward], projection, viewport)
    }

    /// A camera at `eye` that looks at `target` with its axis to the right exactly level, in every
    /// direction: straight up and straight down that axis is x, so that -z is at the upper side of
    /// what lies below, as on a map.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::Direction`] if `target` is `eye`, and [`CameraError::ViewportSize`]
    /// or [`CameraError::ViewportOffset`] for a bad viewport.
    pub fn level(
        eye: Vec3,
        target: Vec3,
        projection: P,
        viewport: Rectangle,
    ) -> Result<Self, CameraError> {
        let axes = level_axes(eye, target, [1, 0])?;
        Self::new(eye, axes, projection, viewport)
    }

    /// The same camera turned to a target, with its axis to the right exactly level. If the target
    /// is straight above it or below, that axis is as it was: a camera that follows what passes
    /// overhead does not turn round there.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::Direction`] if `target` is the camera's own place.
    pub fn aimed_at(self, target: Vec3) -> Result<Self, CameraError> {
        let [right, _, _] = self.axes;
        let axes = level_axes(self.eye, target, [right[0], right[2]])?;
        Ok(Self { axes, ..self })
    }

    /// A camera at `eye` that looks along -z with y up, turned by `rotation`.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::ViewportSize`] or [`CameraError::ViewportOffset`].
    pub fn at(
        eye: Vec3,
        rotation: Rotation,
        projection: P,
        viewport: Rectangle,
    ) -> Result<Self, CameraError> {
        // The rotated axes are its columns.
        let [x, y, z] = rotation.to_bits();
        let axes = [[x[0], y[0], z[0]], [-x[1], -y[1], -z[1]], [-x[2], -y[2], -z[2]]];
        Self::new(eye, axes, projection, viewport)
    }

    /// A camera that circles `target` at a distance: `yaw` about the y axis from +z towards +x,
    /// `pitch` upwards.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::ViewportSize`] or [`CameraError::ViewportOffset`].
    pub fn orbit(
        target: Vec3,
        distance: Distance,
        yaw: Turn,
        pitch: Turn,
        projection: P,
        viewport: Rectangle,
    ) -> Result<Self, CameraError> {
        let rotation = Rotation::about_y(yaw) * Rotation::about_x(-pitch);
        let back = Vec3::from_bits([0, 0, i32::try_from(distance.to_bits()).unwrap_or(i32::MAX)]);
        Self::at(target + rotation * back, rotation, projection, viewport)
    }

    fn new(
        eye: Vec3,
        axes: [[i32; 3]; 3],
        projection: P,
        viewport: Rectangle,
    ) -> Result<Self, CameraError> {
        let (size, corner) = (viewport.size, viewport.top_left);
        if !(1..=MAX_VIEWPORT).contains(&size.width) || !(1..=MAX_VIEWPORT).contains(&size.height) {
            return Err(CameraError::ViewportSize);
        }
        let offsets = -MAX_VIEWPORT_OFFSET..=MAX_VIEWPORT_OFFSET;
        if !offsets.contains(&corner.x) || !offsets.contains(&corner.y) {
            return Err(CameraError::ViewportOffset);
        }
        Ok(Self { eye, axes, projection, viewport })
    }

    /// The camera's position.
    #[must_use]
    pub const fn eye(&self) -> Vec3 {
        self.eye
    }

    /// Its projection.
    #[must_use]
    pub const fn projection(&self) -> &P {
        &self.projection
    }

    /// The rectangle of the display that it fills.
    #[must_use]
    pub const fn viewport(&self) -> Rectangle {
        self.viewport
    }

    /// Right, down and forward in world space, in Q30.
    pub(crate) const fn axes(&self) -> &[[i32; 3]; 3] {
        &self.axes
    }
}

/// The axes of a camera that looks at a target with a level axis to the right: that one, by its x
/// and z, if the direction is straight up or down.
fn level_axes(eye: Vec3, target: Vec3, right: [i32; 2]) -> Result<[[i32; 3]; 3], CameraError> {
    let (e, t) = (eye.to_bits(), target.to_bits());
    let way: [i64; 3] = core::array::from_fn(|i| i64::from(t[i]) - i64::from(e[i]));
    let forward = unit(way).ok_or(CameraError::Direction)?;
    let [x, z] = right.map(i64::from);
    // The cross product with y; of a camera on its side not even the last one is level.
    let right = unit([-way[2], 0, way[0]]).or(unit([x, 0, z])).unwrap_or([1 << 30, 0, 0]);
    Ok([right, cross(forward, right), forward])
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::geometry::{Point, Size};

    use super::*;

    const LENS: Perspective =
        match Perspective::new(Turn::degrees(90), Distance::lit("0.1"), Distance::lit("10")) {
            Ok(lens) => lens,
            Err(_) => panic!(),
        };

    fn screen(width: u32, height: u32) -> Rectangle {
        Rectangle::new(Point::zero(), Size::new(width, height))
    }

    #[test]
    fn three_ways_to_the_same_camera() {
        let at =
            Camera::at(Vec3::lit("0", "0", "5"), Rotation::IDENTITY, LENS, screen(10, 10)).unwrap();
        let look =
            Camera::look_at(Vec3::lit("0", "0", "5"), Vec3::ZERO, Vec3::Y, LENS, screen(10, 10))
                .unwrap();
        let orbit = Camera::orbit(
            Vec3::ZERO,
            Distance::lit("5"),
            Turn::ZERO,
            Turn::ZERO,
            LENS,
            screen(10, 10),
        );
        let orbit = orbit.unwrap();
        for camera in [look, orbit] {
            assert_eq!(camera.eye(), at.eye());
            for (got, want) in camera.axes().iter().flatten().zip(at.axes().iter().flatten()) {
                assert!((got - want).abs() <= 4, "{:?} {:?}", camera.axes(), at.axes());
            }
        }
    }

    #[test]
    fn orbit_goes_round_to_the_right_and_up() {
        let quarter = Turn::QUARTER;
        let lens = LENS;
        let side =
            Camera::orbit(Vec3::ZERO, Distance::lit("2"), quarter, Turn::ZERO, lens, screen(9, 9))
                .unwrap();
        assert_eq!(side.eye(), Vec3::lit("2", "0", "0"));
        let top =
            Camera::orbit(Vec3::ZERO, Distance::lit("2"), Turn::ZERO, quarter, lens, screen(9, 9))
                .unwrap();
        assert_eq!(top.eye(), Vec3::lit("0", "2", "0"));
    }

    /// The axes of a camera that looks nearly along its up direction, against f64.
    #[test]
    fn looking_nearly_upwards_does_not_turn_the_picture() {
        for (target, up) in [
            ([1, 1 << 20, 2], [0, 1 << 16, 0]),
            ([3, 1 << 16, 0], [0, 1 << 16, 0]),
            ([-7, -(1 << 30), 12], [0, 1, 0]),
            ([70_000, i32::MAX, -90_000], [5, i32::MAX, 5]),
            ([123, -456, 789], [1000, -3707, 6414]),
        ] {
            let vector = Vec3::from_bits;
            let camera =
                Camera::look_at(Vec3::ZERO, vector(target), vector(up), LENS, screen(9, 9))
                    .unwrap();
            let [t, u] = [target, up].map(|v| v.map(f64::from));
            let cross = |a: [f64; 3], b: [f64; 3]| {
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
            };
            let unit = |v: [f64; 3]| v.map(|c| c / v.iter().map(|c| c * c).sum::<f64>().sqrt());
            let (forward, right) = (unit(t), unit(cross(t, u)));
            let want = [right, cross(forward, right), forward];
            for (got, want) in camera.axes().as_flattened().iter().zip(want.as_flattened()) {
                // Unit vectors are within 2^-28, and their product within twice that.
                let error = f64::from(*got) / 2f64.powi(30) - want;
                assert!(error.abs() < 2f64.powi(-27), "{target:?} {up:?}: {error}");
            }
        }
    }

    /// Of targets all round, some of them straight above and below, and nearly so.
    #[test]
    fn level_cameras_survive_looking_straight_up() {
        let eye = Vec3::lit("1", "2", "3");
        let mut camera = Camera::level(eye, Vec3::lit("1", "2", "0"), LENS, screen(9, 9)).unwrap();
        let mut straight = 0;
        for step in 0..2000i32 {
            // Overhead along a line, from one side to the other.
            let x = step - 1000;
            let way = [x, if step % 2 == 0 { 70_000 } else { -70_000 }, 2 * x];
            let before = camera;
            camera = camera.aimed_at(eye + Vec3::from_bits(way)).unwrap();
            let [right, down, forward] = camera.axes.map(|axis| axis.map(f64::from));
            assert_eq!(right[1], 0.0);
            assert!(down[1] <= 0.0);
            let length = way.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>().sqrt();
            for (got, want) in forward.iter().zip(way) {
                assert!((got / 2f64.powi(30) - f64::from(want) / length).abs() < 2f64.powi(-27));
            }
            for (a, b) in [(right, down), (down, forward), (right, forward)] {
                let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                assert!(product.abs() < 2f64.powi(60 - 27), "{camera:?}");
            }
            if x == 0 {
                assert_eq!(camera.axes[0], before.axes[0]);
                straight += 1;
            }
        }
        assert_eq!(straight, 1);
        let up = |y| Camera::level(Vec3::ZERO, Vec3::lit("0", y, "0"), LENS, screen(9, 9)).unwrap();
        const ONE: i32 = 1 << 30;
        assert_eq!(up("-5").axes, [[ONE, 0, 0], [0, 0, ONE], [0, -ONE, 0]]);
        assert_eq!(up("5").axes, [[ONE, 0, 0], [0, 0, -ONE], [0, ONE, 0]]);
        assert_eq!(Camera::level(eye, eye, LENS, screen(9, 9)), Err(CameraError::Direction));
        assert_eq!(camera.aimed_at(eye), Err(CameraError::Direction));
    }

    #[test]
    fn faults_are_named() {
        let look =
            |eye, target, up| Camera::look_at(eye, target, up, LENS, screen(9, 9)).unwrap_err();
        assert_eq!(look(Vec3::X, Vec3::X, Vec3::Y), CameraError::Direction);
        assert_eq!(look(Vec3::X, Vec3::ZERO, Vec3::ZERO), CameraError::Direction);
        assert_eq!(look(Vec3::ZERO, Vec3::Y, Vec3::Y), CameraError::Direction);
        let view = |r| Camera::at(Vec3::ZERO, Rotation::IDENTITY, LENS, r).unwrap_err();
        assert_eq!(view(screen(0, 5)), CameraError::ViewportSize);
        assert_eq!(view(screen(5, 2049)), CameraError::ViewportSize);
        assert_eq!(
            view(Rectangle::new(Point::new(-16_385, 0), Size::new(5, 5))),
            CameraError::ViewportOffset
        );
    }
}
