//! Cameras that are moved by angles and steps, and stay level.
//!
//! Both keep their angles and make the camera's axes of them anew. So nothing adds up: after a
//! million steps the axis to the right is still exactly level, and a whole turn ends where it
//! began.

use embedded_graphics_core::primitives::Rectangle;

use super::{Camera, CameraError, Distance};
use crate::numbers::{Rotation, Scalar, Turn, Vec3};

/// An angle upwards (or, as a negative one, downwards) changed by another one: at most a quarter of
/// a turn.
fn pitched(pitch: Turn, by: Turn) -> Turn {
    let signed = |angle: Turn| i64::from(angle.to_bits().cast_signed());
    const QUARTER: i64 = 1 << 30;
    let sum = (signed(pitch) + signed(by)).clamp(-QUARTER, QUARTER);
    Turn::from_bits(sum as u32)
}

/// A camera that circles a point.
///
/// ```
/// # use rasterizer::{camera::{CameraError, Orbit}, prelude::*};
/// # use embedded_graphics_core::primitives::Rectangle;
/// # fn camera(drag: [u32; 2], lens: Perspective, screen: Rectangle)
/// # -> Result<Camera, CameraError> {
/// let mut orbit = Orbit::new(Vec3::ZERO, const { Distance::lit("4") });
/// // A finger that moves by a pixel turns it by half a degree.
/// let [right, down] = drag;
/// orbit.turn(-Turn::fraction(right, 720), Turn::fraction(down, 720));
/// orbit.camera(lens, screen)
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Orbit {
    /// What it looks at.
    pub target: Vec3,
    /// How far from there it is.
    pub distance: Distance,
    yaw: Turn,
    pitch: Turn,
}

impl Orbit {
    /// In front of the target, on the side of +z.
    #[must_use]
    pub const fn new(target: Vec3, distance: Distance) -> Self {
        Self { target, distance, yaw: Turn::ZERO, pitch: Turn::ZERO }
    }

    /// Turns it about the target: to its right by `yaw`, upwards by `pitch`, which ends straight
    /// above and straight below. Negative angles turn it back.
    pub fn turn(&mut self, yaw: Turn, pitch: Turn) {
        self.yaw = self.yaw + yaw;
        self.pitch = pitched(self.pitch, pitch);
    }

    /// Its angle about the y axis, from +z towards +x.
    #[must_use]
    pub const fn yaw(&self) -> Turn {
        self.yaw
    }

    /// Its angle upwards: up to a quarter of a turn, or down to minus that.
    #[must_use]
    pub const fn pitch(&self) -> Turn {
        self.pitch
    }

    /// The camera there.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::ViewportSize`] or [`CameraError::ViewportOffset`].
    pub fn camera<P>(&self, projection: P, viewport: Rectangle) -> Result<Camera<P>, CameraError> {
        Camera::orbit(self.target, self.distance, self.yaw, self.pitch, projection, viewport)
    }
}

/// A camera that walks and looks round.
///
/// ```
/// # use rasterizer::{camera::FirstPerson, prelude::*};
/// let mut walker = FirstPerson::new(const { Vec3::lit("0", "1.7", "5") });
/// walker.look(Turn::QUARTER, -Turn::degrees(10));
/// walker.step(Scalar::ONE, Scalar::ZERO, Scalar::ZERO);
/// assert_eq!(walker.eye, const { Vec3::lit("-1", "1.7", "5") });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FirstPerson {
    /// Where it is.
    pub eye: Vec3,
    yaw: Turn,
    pitch: Turn,
}

impl FirstPerson {
    /// At a place, looking level along -z.
    #[must_use]
    pub const fn new(eye: Vec3) -> Self {
        Self { eye, yaw: Turn::ZERO, pitch: Turn::ZERO }
    }

    /// Turns its head: to the left by `yaw`, upwards by `pitch`, which ends straight up and
    /// straight down. Negative angles turn it to the right and downwards.
    pub fn look(&mut self, yaw: Turn, pitch: Turn) {
        self.yaw = self.yaw + yaw;
        self.pitch = pitched(self.pitch, pitch);
    }

    /// Moves it, in units: level in the direction that it looks in, level to the right, and
    /// upwards. However far up it looks, it walks as far.
    ///
    /// Each coordinate is rounded by up to 2<sup>-16</sup> units, and saturates.
    pub fn step(&mut self, ahead: Scalar, right: Scalar, up: Scalar) {
        let way = Vec3::new(right, up, Scalar::ZERO - ahead);
        self.eye = self.eye + Rotation::about_y(self.yaw) * way;
    }

    /// Moves it along the direction that it looks in, up and down too.
    ///
    /// Each coordinate is rounded by up to 2<sup>-16</sup> units, and saturates.
    pub fn fly(&mut self, ahead: Scalar) {
        let way = Vec3::new(Scalar::ZERO, Scalar::ZERO, Scalar::ZERO - ahead);
        self.eye = self.eye + self.rotation() * way;
    }

    /// Its angle about the y axis, from -z towards -x.
    #[must_use]
    pub const fn yaw(&self) -> Turn {
        self.yaw
    }

    /// Its angle upwards: up to a quarter of a turn, or down to minus that.
    #[must_use]
    pub const fn pitch(&self) -> Turn {
        self.pitch
    }

    /// How it is turned, from looking along -z with y up.
    #[must_use]
    pub fn rotation(&self) -> Rotation {
        Rotation::about_y(self.yaw) * Rotation::about_x(self.pitch)
    }

    /// The camera there.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::ViewportSize`] or [`CameraError::ViewportOffset`].
    pub fn camera<P>(&self, projection: P, viewport: Rectangle) -> Result<Camera<P>, CameraError> {
        Camera::at(self.eye, self.rotation(), projection, viewport)
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::geometry::{Point, Size};

    use super::*;
    use crate::{camera::Perspective, random::Random};

    const LENS: Perspective =
        match Perspective::new(Turn::degrees(90), Distance::lit("0.1"), Distance::lit("10")) {
            Ok(lens) => lens,
            Err(_) => panic!(),
        };

    const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(9, 9));

    /// Right is exactly level, the three are orthonormal, and up is not below.
    fn is_level(camera: &Camera) {
        let [right, down, forward] = *camera.axes();
        assert_eq!(right[1], 0, "{right:?}");
        assert!(down[1] <= 0, "{down:?}");
        let axes = [right, down, forward].map(|axis| axis.map(|c| f64::from(c) / 2f64.powi(30)));
        for (i, a) in axes.iter().enumerate() {
            for (j, b) in axes.iter().enumerate() {
                let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                let want = f64::from(u8::from(i == j));
                assert!((product - want).abs() < 2f64.powi(-26), "{axes:?}");
            }
        }
    }

    #[test]
    fn a_million_steps_leave_both_level() {
        let mut random = Random::new(71);
        let mut orbit = Orbit::new(Vec3::ZERO, Distance::lit("3"));
        let mut walker = FirstPerson::new(Vec3::ZERO);
        let (mut yaw, mut ends) = (0u32, 0);
        for step in 0..1_000_000u32 {
            let turn = random.bits() as u32 >> 4;
            let tilt = Turn::from_bits((random.bits() as i32 >> 5) as u32);
            yaw = yaw.wrapping_add(turn);
            orbit.turn(Turn::from_bits(turn), tilt);
            walker.look(Turn::from_bits(turn), tilt);
            walker.step(Scalar::from_bits(700), Scalar::from_bits(-300), Scalar::ZERO);
            ends += usize::from(orbit.pitch() == Turn::QUARTER || orbit.pitch() == -Turn::QUARTER);
            if step % 100 == 0 || ends < 9 {
                is_level(&orbit.camera(LENS, SCREEN).unwrap());
                is_level(&walker.camera(LENS, SCREEN).unwrap());
            }
        }
        assert_eq!((orbit.yaw(), walker.yaw()), (Turn::from_bits(yaw), Turn::from_bits(yaw)));
        assert_eq!(walker.eye.y, Scalar::ZERO);
        assert!(ends > 1000, "{ends}");
    }

    #[test]
    fn pitch_ends_straight_up_and_down() {
        let mut walker = FirstPerson::new(Vec3::ZERO);
        walker.look(Turn::degrees(30), Turn::degrees(80));
        walker.look(Turn::ZERO, Turn::degrees(80));
        assert_eq!(walker.pitch(), Turn::QUARTER);
        let camera = walker.camera(LENS, SCREEN).unwrap();
        assert_eq!(camera.axes()[2], [0, 1 << 30, 0]);
        is_level(&camera);
        walker.look(Turn::ZERO, -Turn::degrees(170));
        walker.look(Turn::ZERO, -Turn::degrees(170));
        assert_eq!(walker.pitch(), -Turn::QUARTER);
        // It still walks in the direction that it is turned to.
        walker.step(Scalar::lit("2"), Scalar::ZERO, Scalar::ONE);
        let (sin, cos) = 30f64.to_radians().sin_cos();
        let want = [-2.0 * sin, 1.0, -2.0 * cos];
        for (got, want) in walker.eye.to_bits().into_iter().zip(want) {
            assert!((f64::from(got) / 65_536.0 - want).abs() < 2f64.powi(-16), "{got} {want}");
        }
        walker.fly(Scalar::ONE);
        assert!((walker.eye.y.to_num::<f64>()).abs() < 2f64.powi(-15));
    }

    /// Both see what is before them: what they look at is in the direction forward.
    #[test]
    fn turning_to_the_right_moves_an_orbit_there() {
        let mut orbit = Orbit::new(Vec3::lit("1", "2", "3"), Distance::lit("5"));
        assert_eq!(orbit.camera(LENS, SCREEN).unwrap().eye(), Vec3::lit("1", "2", "8"));
        orbit.turn(Turn::QUARTER, Turn::ZERO);
        assert_eq!(orbit.camera(LENS, SCREEN).unwrap().eye(), Vec3::lit("6", "2", "3"));
        orbit.turn(Turn::ZERO, Turn::QUARTER);
        assert_eq!(orbit.camera(LENS, SCREEN).unwrap().eye(), Vec3::lit("1", "7", "3"));
        orbit.turn(-Turn::QUARTER, -Turn::QUARTER);
        assert_eq!(orbit.camera(LENS, SCREEN).unwrap().eye(), Vec3::lit("1", "2", "8"));
    }
}
