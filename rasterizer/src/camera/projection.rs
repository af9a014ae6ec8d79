//! Perspective and parallel projection.

use fixed::types::U16F16;

use super::CameraError;
use crate::numbers::{Float, Turn, cotangent_of_half};

/// A length or a factor that cannot be negative: Q16.16, up to just under 65,536.
pub type Distance = U16F16;

/// A pinhole camera: an object twice as far away looks half as large.
///
/// Make it in a constant or in a block `const { .. }`, where the compiler does its divisions: that
/// saves 250 bytes of flash.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Perspective {
    near: Distance,
    far: Distance,
    focal: Focal,
    per_near: Float,
    far_per_near: Float,
}

/// The size on the screen of an object as wide as it is far away.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Focal {
    /// In half heights of the viewport: the cotangent of half the vertical field of view.
    HalfHeights(Float),
    Pixels(Float),
}

impl Perspective {
    /// From the angle between the viewport's upper and lower edges, and the distances of the near
    /// and far planes.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::FieldOfView`] or [`CameraError::DepthRange`].
    pub const fn new(
        vertical_field_of_view: Turn,
        near: Distance,
        far: Distance,
    ) -> Result<Self, CameraError> {
        let steps = vertical_field_of_view.to_bits();
        if steps == 0 || steps >= 1 << 31 {
            return Err(CameraError::FieldOfView);
        }
        Self::checked(Focal::HalfHeights(cotangent_of_half(vertical_field_of_view)), near, far)
    }

    /// From the focal length in pixels: the size on the screen of one unit at a distance of one
    /// unit.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::Magnification`] or [`CameraError::DepthRange`].
    pub const fn with_focal_length(
        pixels: Distance,
        near: Distance,
        far: Distance,
    ) -> Result<Self, CameraError> {
        if pixels.to_bits() == 0 {
            return Err(CameraError::Magnification);
        }
        Self::checked(Focal::Pixels(Float::from_unsigned(pixels)), near, far)
    }

    const fn checked(focal: Focal, near: Distance, far: Distance) -> Result<Self, CameraError> {
        if !is_range(near, far) {
            return Err(CameraError::DepthRange);
        }
        // The divisions are here because a lens is often a constant.
        let per_near = Float::from_unsigned(near).reciprocal();
        Ok(Self {
            near,
            far,
            focal,
            per_near,
            far_per_near: Float::from_unsigned(far).times(per_near),
        })
    }

    /// The distance of the near plane, where depth is 1. Nothing nearer is drawn.
    #[must_use]
    pub const fn near(&self) -> Distance {
        self.near
    }

    /// The distance of the far plane. Nothing beyond it is drawn.
    #[must_use]
    pub const fn far(&self) -> Distance {
        self.far
    }

    /// The focal length in pixels.
    pub(crate) const fn focal_length(&self, viewport_height: u32) -> Float {
        match self.focal {
            Focal::HalfHeights(cotangent) => {
                cotangent.times(Float::new(viewport_height as i64, -1))
            }
            Focal::Pixels(pixels) => pixels,
        }
    }

    /// 1 / near.
    pub(crate) const fn per_near(&self) -> Float {
        self.per_near
    }

    /// far / near.
    pub(crate) const fn far_per_near(&self) -> Float {
        self.far_per_near
    }
}

/// A parallel projection: size does not depend on distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Orthographic {
    height: Distance,
    near: Distance,
    far: Distance,
}

impl Orthographic {
    /// From the height of the view in world units, and the distances of the near and far planes.
    ///
    /// # Errors
    ///
    /// Returns [`CameraError::Magnification`] or [`CameraError::DepthRange`].
    pub const fn new(height: Distance, near: Distance, far: Distance) -> Result<Self, CameraError> {
        if height.to_bits() == 0 {
            return Err(CameraError::Magnification);
        }
        if !is_range(near, far) {
            return Err(CameraError::DepthRange);
        }
        Ok(Self { height, near, far })
    }

    /// The distance of the near plane, where depth is 1. Nothing nearer is drawn.
    #[must_use]
    pub const fn near(&self) -> Distance {
        self.near
    }

    /// The distance of the far plane, where depth is 0. Nothing beyond it is drawn.
    #[must_use]
    pub const fn far(&self) -> Distance {
        self.far
    }

    /// The height of the view in world units.
    #[must_use]
    pub const fn height(&self) -> Distance {
        self.height
    }

    /// The length of one unit in pixels.
    pub(crate) const fn pixels_per_unit(&self, viewport_height: u32) -> Float {
        Float::new(viewport_height as i64, 0).times(Float::from_unsigned(self.height).reciprocal())
    }
}

const fn is_range(near: Distance, far: Distance) -> bool {
    near.to_bits() > 0 && far.to_bits() > near.to_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR: Distance = Distance::lit("0.1");
    const FAR: Distance = Distance::lit("100");

    fn pixels(lens: Perspective, height: u32) -> f64 {
        let focal = lens.focal_length(height);
        f64::from(focal.mantissa) * 2f64.powi(focal.exponent)
    }

    #[test]
    fn field_of_view_and_focal_length_agree() {
        for degrees in 1..180 {
            let lens = Perspective::new(Turn::degrees(degrees), NEAR, FAR).unwrap();
            let want = 120.0 / (f64::from(degrees).to_radians() / 2.0).tan();
            // The angle is a number of 2^-32 turns, 2^-24 of a degree, and the lens within 2^-26.
            assert!((pixels(lens, 240) / want - 1.0).abs() < 2f64.powi(-22), "{degrees} degrees");
        }
        let lens = Perspective::with_focal_length(Distance::lit("400"), NEAR, FAR).unwrap();
        assert_eq!(pixels(lens, 240), 400.0);
    }

    #[test]
    fn faults_are_named() {
        let field = |angle| Perspective::new(angle, NEAR, FAR).unwrap_err();
        assert_eq!(field(Turn::ZERO), CameraError::FieldOfView);
        assert_eq!(field(Turn::degrees(180)), CameraError::FieldOfView);
        assert_eq!(field(Turn::degrees(270)), CameraError::FieldOfView);
        let focal =
            |pixels, near, far| Perspective::with_focal_length(pixels, near, far).unwrap_err();
        assert_eq!(focal(Distance::ZERO, NEAR, FAR), CameraError::Magnification);
        assert_eq!(focal(FAR, Distance::ZERO, FAR), CameraError::DepthRange);
        assert_eq!(focal(FAR, NEAR, NEAR), CameraError::DepthRange);
        assert_eq!(Orthographic::new(Distance::ZERO, NEAR, FAR), Err(CameraError::Magnification));
        assert_eq!(Orthographic::new(FAR, FAR, NEAR), Err(CameraError::DepthRange));
    }
}
