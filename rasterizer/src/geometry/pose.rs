//! Where an object stands in the world.

use crate::{
    camera::Distance,
    numbers::{Rotation, Vec3},
};

/// Size, direction and place of an object: a point p of the model lies at `translation + rotation *
/// (scale * p)`.
///
/// A part that moves with another one has the pose [`compose`](Self::compose) makes of both:
///
/// ```
/// # use rasterizer::prelude::*;
/// # fn hand(shoulder: Pose, bend: Turn) -> Pose {
/// // The elbow is one unit along the upper arm; the forearm bends there.
/// let elbow = Pose::rotated(Rotation::about_x(bend)).at(Vec3::Y);
/// let forearm = shoulder.compose(elbow);
/// # forearm
/// # }
/// ```
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

    /// Where a point of the model lies. It is rounded, within 2<sup>-16</sup> for the scale 1 and
    /// within 2<sup>-15</sup> for others, and saturates at the ends of the range.
    #[must_use]
    pub fn apply(&self, point: Vec3) -> Vec3 {
        let scale = i64::from(self.scale.to_bits());
        // Below 2^63.
        let scaled = point.to_bits().map(|c| (i64::from(c) * scale + (1 << 15)) >> 16);
        let scaled = scaled.map(|c| c.clamp(i32::MIN.into(), i32::MAX.into()) as i32);
        self.translation + self.rotation * Vec3::from_bits(scaled)
    }

    /// The pose of a part that has the pose `first` in the space of what has this pose: a point
    /// lies where this pose takes what `first` makes of it.
    ///
    /// The rotation is [`Rotation::compose`]'s: orthonormal within 2<sup>-26</sup> however many
    /// parts follow each other, and turned by 2<sup>-29</sup> radians at most by rounding. The
    /// place is as exact as [`apply`](Self::apply); the scale is rounded to a 65,536th and
    /// saturates.
    #[must_use]
    pub fn compose(self, first: Self) -> Self {
        let [a, b] = [self.scale, first.scale].map(|scale| u64::from(scale.to_bits()));
        let scale = (a * b).saturating_add(1 << 15) >> 16;
        Self {
            rotation: self.rotation.compose(first.rotation),
            translation: self.apply(first.translation),
            scale: Distance::from_bits(u32::try_from(scale).unwrap_or(u32::MAX)),
        }
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// The object is too large, or comes too near, for the number range of [`S4`] or [`S8`].
///
/// A vertex is placed within 5/8 of a sub-pixel of where exact arithmetic on the tables, the pose
/// and the camera puts it: half for snapping, an eighth for arithmetic. (In the last sub-pixel of
/// the guard band, 1,024 pixels to the right of or below the viewport's middle, one more.) An
/// object for which 32-bit products cannot promise that is refused, unless nothing of it is in the
/// view (which [`ClipNone`](super::ClipNone) does not find out).
///
/// With f the focal length over 1,024 pixels, let h be the largest |coordinate| of the mesh's
/// positions, in world units; let m be the largest of |x| f, |y| f and |z| that a point within
/// 1.75 h of the mesh's origin has in the camera's axes, rounded up to a power of two; and let w be
/// the least z of such a point, or the near distance if that is larger. The limit is
///
/// * with [`S4`] m <= 1,024 w;
/// * with [`S8`] m <= 64 w, or else, with 3.5 h for 1.75 h in m, both m <= 64 d / k and m <=
///   2<sup>21</sup> near distances. Here d is 4 h or the distance of the mesh's box from the eye if
///   that is larger; k is 1 + 1.5 / f, or (w + s) / w if that is less, where s is the sum of the
///   largest |x| and |y| of the box.
///
/// In a parallel projection f is the length of a world unit in pixels over 1,024, w is 1, and the
/// conditions on m and w alone count: an object may be 1,024 or 64 times as wide as the guard band.
/// Further, the mesh's origin lies within 2<sup>16</sup> units of the pose's, and w is at least
/// 2<sup>-22</sup> units with S4 and 2<sup>-18</sup> with S8, or f times that if f is over 1.
///
/// An object that a matrix changes has these limits in another size: [`Shaped`](super::Shaped).
///
/// [`S4`]: crate::numbers::S4
/// [`S8`]: crate::numbers::S8
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PoseError;

impl core::fmt::Display for PoseError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(
            "the object is too large for how near it comes: move the near plane away, use S8, split \
             the mesh, or make its scale or its offset smaller",
        )
    }
}

impl core::error::Error for PoseError {}
