//! Where an object stands in the world.

use crate::{
    camera::Distance,
    numbers::{Rotation, Vec3},
};

/// Size, direction and place of an object: a point p of the model lies at `translation + rotation *
/// (scale * p)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pose {
    /// How the model is rotated.
    pub rotation: Rotation,
    /// Where the model's origin lies, in world units.
    pub translation: Vec3,
    /// World units for one model unit.
    pub scale: Distance,
}

impl Pose {
    /// As modelled, at the origin.
    pub const IDENTITY: Self =
        Self { rotation: Rotation::IDENTITY, translation: Vec3::ZERO, scale: Distance::ONE };

    /// At the origin, rotated.
    #[must_use]
    pub const fn rotated(rotation: Rotation) -> Self {
        Self { rotation, ..Self::IDENTITY }
    }

    /// The same pose elsewhere.
    #[must_use]
    pub const fn at(self, translation: Vec3) -> Self {
        Self { translation, ..self }
    }

    /// The same pose in another size.
    #[must_use]
    pub const fn scaled(self, scale: Distance) -> Self {
        Self { scale, ..self }
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// The object is too large or too far away for a parallel projection's number range: about
/// 2<sup>30</sup> guard bands. Precision degrades long before that: positions are accurate to
/// 2<sup>-27</sup> of the largest of the object's distance from the camera, the model's distance
/// from its own origin, and how far across the object lies in guard bands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PoseError;

impl core::fmt::Display for PoseError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("the object is too large or too far away: make its scale or its offset smaller")
    }
}

impl core::error::Error for PoseError {}
