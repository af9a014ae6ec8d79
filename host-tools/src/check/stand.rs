//! Where the camera and the model stand, for both rasterizers.

use rasterizer::{
    camera::Distance,
    geometry::Pose,
    numbers::{Rotation, Scalar, Turn, Vec3},
};

use super::view::{View, ViewError, checked};

/// The steps of an angle in a full turn.
const ANGLE_STEPS: f64 = 4_294_967_296.0;
/// The step of a coordinate.
pub(super) const STEP: f64 = 1.0 / 65_536.0;
/// The largest coordinate of a place or a direction.
pub(super) const MOST: f64 = 32_000.0;

/// Where a camera stands, which point it looks at, and which direction points upwards in the
/// picture, all in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Where it stands.
    pub eye: [f64; 3],
    /// What is in the middle of the picture.
    pub target: [f64; 3],
    /// What points upwards, of any length; not the way from eye to target.
    pub up: [f64; 3],
}

impl Look {
    /// Rounded to the core's numbers.
    pub(super) fn rounded(self) -> Self {
        let round = |v: [f64; 3]| v.map(|c| (c / STEP).round() * STEP);
        Self { eye: round(self.eye), target: round(self.target), up: round(self.up) }
    }

    /// Eye, target and up of the core.
    pub(super) fn core(&self) -> Result<[Vec3; 3], ViewError> {
        Ok([
            vector("a coordinate of the eye", self.eye)?,
            vector("a coordinate of the target", self.target)?,
            vector("a coordinate of up", self.up)?,
        ])
    }
}

/// Where a model stands in the world: a point p lies at `at + turn * (scale * p)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where its origin lies.
    pub at: [f64; 3],
    /// How far it is turned about y, then x, then z, in degrees.
    pub turn_degrees: [f64; 3],
    /// World units for one model unit.
    pub scale: f64,
}

impl Default for Place {
    /// As modelled, at the origin.
    fn default() -> Self {
        Self { at: [0.0; 3], turn_degrees: [0.0; 3], scale: 1.0 }
    }
}

impl Place {
    /// Rounded to the core's numbers.
    pub(super) fn rounded(self) -> Self {
        let round = |c: f64| (c / STEP).round() * STEP;
        Self {
            at: self.at.map(round),
            turn_degrees: self.turn_degrees.map(rounded_degrees),
            scale: round(self.scale),
        }
    }

    /// The pose of the core.
    fn pose(&self) -> Result<Pose, ViewError> {
        let scale = checked("the scale of a model", self.scale, STEP, MOST)?;
        Ok(Pose::rotated(rotation(self.turn_degrees))
            .at(vector("a coordinate of a model's place", self.at)?)
            .scaled(Distance::from_num(scale)))
    }
}

/// A vector of the core.
fn vector(what: &'static str, vector: [f64; 3]) -> Result<Vec3, ViewError> {
    for coordinate in vector {
        checked(what, coordinate, -MOST, MOST)?;
    }
    let [x, y, z] = vector.map(|c| Scalar::from_bits((c / STEP).round() as i32));
    Ok(Vec3::new(x, y, z))
}

/// The core's rotation about y, then x, then z.
fn rotation([yaw, pitch, roll]: [f64; 3]) -> Rotation {
    Rotation::about_z(angle(roll)) * Rotation::about_x(angle(pitch)) * Rotation::about_y(angle(yaw))
}

/// A vector turned about y, then x, then z.
fn turned(degrees: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [(sy, cy), (sp, cp), (sr, cr)] = degrees.map(|degrees| degrees.to_radians().sin_cos());
    let [x, z] = [cy * x + sy * z, cy * z - sy * x];
    let [y, z] = [cp * y - sp * z, cp * z + sp * y];
    [cr * x - sr * y, cr * y + sr * x, z]
}

/// The nearest angle that the core has.
pub(crate) fn angle(degrees: f64) -> Turn {
    let steps = (degrees / 360.0).rem_euclid(1.0) * ANGLE_STEPS;
    // An angle that rounds up to a full turn wraps to 0.
    Turn::from_bits(steps.round() as u64 as u32)
}

/// An angle as the core has it.
pub(super) fn rounded_degrees(degrees: f64) -> f64 {
    f64::from(angle(degrees).to_bits()) / ANGLE_STEPS * 360.0
}

impl View {
    const fn turns(&self) -> [f64; 3] {
        [self.yaw_degrees, self.pitch_degrees, self.roll_degrees]
    }

    /// The pose of the model in the fixed-point core.
    pub(super) fn pose(&self) -> Result<Pose, ViewError> {
        let turn = Pose::rotated(rotation(self.turns()));
        Ok(if self.place == Place::default() { turn } else { turn.compose(self.place.pose()?) })
    }

    /// How the camera of the reference looks.
    pub(super) fn reference_look(&self) -> Look {
        let z = self.distance;
        let along_z = Look { eye: [0.0, 0.0, z], target: [0.0, 0.0, z - 1.0], up: [0.0, 1.0, 0.0] };
        self.look.unwrap_or(along_z)
    }

    /// Points of the model in world space, by the pose that the core is given.
    pub(super) fn core_pose_points(&self, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let (at, scale) = self.core_place();
        let turned = self.core_pose_directions(points).into_iter();
        turned.map(|p| [0, 1, 2].map(|i| at[i] + scale * p[i])).collect()
    }

    /// Directions of the model in world space, by the rotation that the core is given.
    pub(super) fn core_pose_directions(&self, directions: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let rows = self.core_pose().rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
        let turn = |p: &[f64; 3]| rows.map(|row| (0..3).map(|i| row[i] * p[i]).sum());
        directions.iter().map(turn).collect()
    }

    /// Points of the model in world space: rotated exactly, at the place and of the scale that the
    /// core rounds to.
    pub(super) fn pose_points(&self, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let (at, scale) = self.core_place();
        let turned = self.pose_directions(points).into_iter();
        turned.map(|p| [0, 1, 2].map(|i| at[i] + scale * p[i])).collect()
    }

    /// Directions of the model in world space.
    pub(super) fn pose_directions(&self, directions: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let turn = |&p: &[f64; 3]| turned(self.turns(), turned(self.place.turn_degrees, p));
        directions.iter().map(turn).collect()
    }

    /// The pose, of a view that the core does not refuse.
    fn core_pose(&self) -> Pose {
        self.pose().unwrap_or(Pose::IDENTITY)
    }

    /// Where the core puts the model's origin, and the scale that it rounds to.
    pub(super) fn core_place(&self) -> ([f64; 3], f64) {
        let pose = self.core_pose();
        (pose.translation.to_bits().map(|c| f64::from(c) * STEP), pose.scale.to_num())
    }
}
