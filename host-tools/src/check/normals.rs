//! The normals of pixels against the exact ones.

use super::object::FixedPicture;
use crate::reference::{DepthFormat, Picture};

/// How far the normals that the core shades with are off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct NormalErrors {
    /// The largest angle in degrees: of the normals of pixels, and of those that the core makes of
    /// the tables' for a model that is not as it was modelled.
    pub normal_max_error_degrees: f64,
    /// How large it may be.
    pub normal_bound_degrees: f64,
    /// The pixel where it is; `None` if it is of a vertex or a triangle.
    pub normal_worst: Option<[usize; 2]>,
}

/// An interpolated normal turns least where it is long. The bound is for one that is at least half
/// as long as the normals of the corners, which is so where these are less than 120 degrees apart.
/// A shorter one, of a model whose normals nearly cancel, has no direction to speak of, and is not
/// judged.
const BOUND_DEGREES: f64 = 0.5;

/// The length of the shortest normal that is judged: half of 2,032, that of a corner.
const SHORTEST: f64 = 1016.0;

impl NormalErrors {
    /// Whether the bound is kept.
    #[must_use]
    pub fn are_within(&self) -> bool {
        self.normal_max_error_degrees <= self.normal_bound_degrees
    }

    /// Compares what the core has at each pixel, row by row, with the exact normals.
    pub(super) fn of(
        seen: &[Option<[f64; 3]>],
        fixed: &FixedPicture,
        depth: DepthFormat,
        exact: &Picture,
    ) -> Self {
        let mut errors = Self { normal_bound_degrees: BOUND_DEGREES, ..Self::default() };
        for (index, (seen, pixel)) in seen.iter().zip(&fixed.pixels).enumerate() {
            let place = [index % exact.width(), index / exact.width()];
            let Some(seen) = seen else { continue };
            // Of surfaces that the depth buffer cannot tell apart, any may be seen.
            let angles = exact.fragments(place[0], place[1]).iter().filter_map(|fragment| {
                let is_seen = (depth.units(fragment.depth) - f64::from(pixel.depth)).abs() <= 1.0;
                let exact: [f64; 3] = fragment.color;
                (is_seen && length(exact) >= SHORTEST).then(|| degrees(*seen, exact))
            });
            if let Some(angle) = angles.reduce(f64::min)
                && angle > errors.normal_max_error_degrees
            {
                errors.normal_max_error_degrees = angle;
                errors.normal_worst = Some(place);
            }
        }
        errors
    }
}

impl NormalErrors {
    /// Compares normals that the core makes of those of tables with the exact ones.
    pub(super) fn of_tables(
        pairs: impl Iterator<Item = ([f64; 3], [f64; 3])>,
        normal_bound_degrees: f64,
    ) -> Self {
        let angles = pairs.filter(|(_, exact)| length(*exact) > 0.0).map(|(a, b)| degrees(a, b));
        Self {
            normal_max_error_degrees: angles.fold(0.0, f64::max),
            normal_bound_degrees,
            normal_worst: None,
        }
    }

    /// The worse of these and others.
    pub(super) fn or_worse(self, other: Self) -> Self {
        let part = |errors: &Self| errors.normal_max_error_degrees / errors.normal_bound_degrees;
        if part(&other) > part(&self) { other } else { self }
    }
}

/// The core's normal if it is that of the surface with the exact one, or else the exact one.
pub(super) fn seen_or(seen: Option<[f64; 3]>, exact: [f64; 3]) -> [f64; 3] {
    seen.filter(|&seen| degrees(seen, exact) <= BOUND_DEGREES).unwrap_or(exact)
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The angle between two vectors.
fn degrees(a: [f64; 3], b: [f64; 3]) -> f64 {
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    length(cross).atan2(dot(a, b)).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_in_degrees_at_any_length() {
        assert!((degrees([2.0, 0.0, 0.0], [0.0, 7.0, 0.0]) - 90.0).abs() < 1e-12);
        assert!((degrees([1.0, 0.0, 0.0], [900.0, 9.0, 0.0]) - 0.572_938_7).abs() < 1e-6);
        let exact = [0.0, 0.0, 2032.0];
        assert_eq!(seen_or(Some([10.0, 0.0, 2032.0]), exact), [10.0, 0.0, 2032.0]);
        assert_eq!(seen_or(Some([20.0, 0.0, 2032.0]), exact), exact);
        assert_eq!(seen_or(None, exact), exact);
    }
}
