//! The position and the size of a model.

use std::path::Path;

use rasterizer::numbers::Vec3;

use super::{
    Fit,
    error::ModelError,
    vector::{Vector, largest, length, sub},
};

/// The steps of Q16.16 in a unit.
const ONE: f64 = 65_536.0;

/// The smallest half-extent that [`Fit::Keep`] accepts: 64 steps of Q16.16. Rounding the offset to
/// a step lengthens it, and so the quantum, by at most half a step in 64, 0.8 %.
const SMALLEST: f64 = 64.0 / ONE;

/// Positions in the units that the tables describe, and the place of their origin.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fitted {
    /// The exact positions.
    pub positions: Vec<Vector>,
    /// The origin of the tables' positions.
    pub offset: Vec3,
    /// The middle and the radius of the shape, if it is fitted into the unit sphere.
    unit: Option<(Vector, f64)>,
}

impl Fitted {
    /// Where a point lies after the fit, from its original and its scaled position.
    pub(super) fn place(&self, original: Vector, shape: Vector) -> Vector {
        self.unit.map_or(original, |unit| in_unit_sphere(shape, unit))
    }
}

fn in_unit_sphere(shape: Vector, (center, radius): (Vector, f64)) -> Vector {
    sub(shape, center).map(|x| x / radius)
}

/// Scales a shape so that its largest coordinate lies from 1 to 2. The factor is a power of two, so
/// nothing is rounded, and no product of the results leaves the range of f64.
pub(super) fn to_common_size(positions: &[Vector]) -> Vec<Vector> {
    let m = positions.iter().fold(0.0, |m: f64, &p| m.max(largest(p)));
    if m == 0.0 {
        return positions.to_vec();
    }
    // Half of the exponent at a time: 2^1074, the factor for the smallest f64, is itself no f64.
    let exponent = -m.log2().floor() as i32;
    let (half, rest) = (exponent / 2, exponent - exponent / 2);
    let (half, rest) = (2_f64.powi(half), 2_f64.powi(rest));
    positions.iter().map(|p| p.map(|x| x * half * rest)).collect()
}

/// Whether all points coincide.
pub(super) fn has_no_size(positions: &[Vector]) -> bool {
    positions.iter().all(|p| *p == positions[0])
}

/// Applies a fit. `original` are the file's positions, `shape` those of [`to_common_size`]. The
/// positions of `frame`, of the same size as these, fill the unit sphere.
pub(super) fn fit(
    path: &Path,
    original: &[Vector],
    shape: &[Vector],
    frame: &[Vector],
    fit: Fit,
) -> Result<Fitted, ModelError> {
    match fit {
        Fit::Unit => {
            let center = center(frame);
            let radius = frame.iter().fold(0.0, |m: f64, &p| m.max(length(sub(p, center))));
            let unit = (center, radius);
            Ok(Fitted {
                positions: shape.iter().map(|&p| in_unit_sphere(p, unit)).collect(),
                offset: Vec3::ZERO,
                unit: Some(unit),
            })
        }
        Fit::Keep => {
            let in_range = |x: &f64| (-32_768.0..32_768.0 - 0.5 / ONE).contains(x);
            if let Some(&value) = original.as_flattened().iter().find(|&x| !in_range(x)) {
                return Err(ModelError::OutOfRange { path: path.into(), value });
            }
            let center = center(original);
            let half = original.iter().fold(0.0, |m: f64, &p| m.max(largest(sub(p, center))));
            if half < SMALLEST {
                return Err(ModelError::TooSmall { path: path.into(), size: 2.0 * half });
            }
            Ok(Fitted {
                positions: original.to_vec(),
                offset: Vec3::from_bits(center.map(|x| (x * ONE).round() as i32)),
                unit: None,
            })
        }
    }
}

/// The offset in units.
pub(super) fn offset_units(offset: Vec3) -> Vector {
    offset.to_bits().map(|bits| f64::from(bits) / ONE)
}

/// The diagonal of the bounding box.
pub(super) fn diagonal(positions: &[Vector]) -> f64 {
    let (min, max) = bounds(positions);
    length(sub(max, min))
}

fn center(positions: &[Vector]) -> Vector {
    let (min, max) = bounds(positions);
    [0, 1, 2].map(|i| min[i] / 2.0 + max[i] / 2.0)
}

fn bounds(positions: &[Vector]) -> (Vector, Vector) {
    positions.iter().fold(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]), |(min, max), p| {
        ([0, 1, 2].map(|i| min[i].min(p[i])), [0, 1, 2].map(|i| max[i].max(p[i])))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(positions: &[Vector]) -> Result<Fitted, ModelError> {
        let shape = to_common_size(positions);
        fit(Path::new("m.obj"), positions, &shape, &shape, Fit::Keep)
    }

    #[test]
    fn unit_fit_is_the_same_for_any_size() {
        let shape = [[3.0, 1.0, 0.0], [5.0, 2.0, 0.0], [3.0, 5.0, 0.0]];
        for size in [5e-324 * 8.0, 1e-300, 0.3, 1.0, 1e6, 3e307] {
            let original = shape.map(|p| p.map(|x| x * size));
            let common = to_common_size(&original);
            let m = common.iter().fold(0.0, |m: f64, &p| m.max(largest(p)));
            assert!((1.0..2.0).contains(&m), "{size}: {m}");
            let fitted = fit(Path::new("m.obj"), &original, &common, &common, Fit::Unit).unwrap();
            let radius = fitted.positions.iter().fold(0.0, |m: f64, &p| m.max(length(p)));
            assert!((radius - 1.0).abs() < 1e-15, "{size}: {radius}");
            let (min, max) = bounds(&fitted.positions);
            assert!(largest([0, 1, 2].map(|i| min[i] + max[i])) < 1e-14, "{size}");
        }
    }

    #[test]
    fn kept_models_lie_where_they_were() {
        let fitted = kept(&[[-0.1, 7.0, 100.0], [0.3, 7.5, 101.0]]).unwrap();
        assert_eq!(fitted.positions[0], [-0.1, 7.0, 100.0]);
        assert_eq!(fitted.offset, Vec3::lit("0.1", "7.25", "100.5"));
        assert_eq!(offset_units(fitted.offset)[1], 7.25);
    }

    #[test]
    fn too_large_a_model_is_an_error_with_its_remedy() {
        let error = kept(&[[0.0; 3], [0.0, 32_768.0, 0.0]]).unwrap_err().to_string();
        assert!(error.contains("coordinate 32768") && error.contains("unit fit"), "{error}");
        assert!(kept(&[[-32_768.0; 3], [0.0, 32_767.999, 0.0]]).is_ok());
        let error = kept(&[[5.0; 3], [5.0, 5.001, 5.0]]).unwrap_err().to_string();
        assert!(error.contains("0.001") && error.contains("unit fit"), "{error}");
        assert!(kept(&[[5.0; 3], [5.0, 5.002, 5.0]]).is_ok());
    }

    #[test]
    fn only_coinciding_points_have_no_size() {
        assert!(has_no_size(&[[5.0; 3]; 3]));
        assert!(!has_no_size(&[[5.0; 3], [5.0, 5.0, 5.000_000_1]]));
    }
}
