//! From f64 to the integers of the tables.

use rasterizer::numbers::Scale;

use super::vector::{Vector, angle, cross, dot, sub};

/// The length of a quantum in model units.
pub(super) fn quantum(scale: Scale) -> f64 {
    f64::from(scale.mantissa()) * 2_f64.powi(scale.exponent())
}

/// Positions relative to `offset` as integers, the largest coordinate being 32,767.
///
/// The scale is rounded to 32 bits first, and the positions to multiples of the rounded scale. So
/// each coordinate is off by half a quantum at most, and the scale's own rounding costs nothing.
pub(super) fn positions(exact: &[Vector], offset: Vector) -> (Vec<[i16; 3]>, Scale) {
    let relative = exact.iter().map(|&p| sub(p, offset));
    let half_extent = relative.clone().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let scale = nearest_scale(half_extent / 32_767.0);
    let quantum = quantum(scale);
    (relative.map(|p| p.map(|x| (x / quantum).round() as i16)).collect(), scale)
}

/// The scale nearest to a positive number.
fn nearest_scale(value: f64) -> Scale {
    let exponent = value.log2().floor() as i32 - 31;
    let mantissa = (value / 2_f64.powi(exponent)).round();
    // A logarithm rounded the wrong way, or a mantissa rounded up to the next power of two, gives
    // 33 bits.
    if mantissa < f64::from(u32::MAX) {
        Scale::new(mantissa as u32, exponent)
    } else {
        Scale::new((mantissa / 2.0).round() as u32, exponent + 1)
    }
}

/// The position of quantised coordinates.
pub(super) fn position(quantised: [i16; 3], scale: Scale, offset: Vector) -> Vector {
    [0, 1, 2].map(|i| offset[i] + quantum(scale) * f64::from(quantised[i]))
}

/// A unit normal in 127ths.
///
/// Picks one of the eight integer triples round it: the one of the least angle whose length is off
/// by at most half the diagonal of a cube of side 1. Rounding each coordinate gives no better
/// bound, so a shader that takes the length for 1 loses nothing.
pub(super) fn normal(exact: Vector) -> [i8; 3] {
    let target = exact.map(|x| x * 127.0);
    let candidates = (0..8).map(|corner| {
        [0, 1, 2].map(|axis| {
            let up = corner >> axis & 1 == 1;
            if up { target[axis].ceil() } else { target[axis].floor() }
        })
    });
    // Squares of whole numbers from (127 - d)^2 to (127 + d)^2, where d is that half diagonal, the
    // root of 3/4: exact, and none is closer to an end than 0.2.
    let near = candidates.filter(|&c| {
        (15_910.0..=16_349.0).contains(&dot(c, c)) && c.iter().all(|x| x.abs() <= 127.0)
    });
    // The squared tangent of the angle, which takes no root and no arc tangent.
    let mut best: Option<(f64, Vector)> = None;
    for c in near {
        let across = cross(c, exact);
        let along = dot(c, exact);
        let tangent = dot(across, across) / (along * along);
        let is_better = best.is_none_or(|(least, other)| {
            if (tangent - least).abs() > 1e-9 * least {
                tangent < least
            } else {
                // Rounding decides between equal angles, in the same way in every version.
                angle(c, exact).total_cmp(&angle(other, exact)).is_lt()
            }
        });
        if is_better {
            best = Some((tangent, c));
        }
    }
    let best = best.map(|(_, c)| c);
    best.unwrap_or_else(|| target.map(f64::round)).map(|x| x as i8)
}

/// The angle between a quantised normal and the exact one, in radians.
pub(super) fn normal_error(quantised: [i8; 3], exact: Vector) -> f64 {
    angle(quantised.map(f64::from), exact)
}

#[cfg(test)]
mod tests {
    use super::{
        super::vector::{length, normalized},
        *,
    };

    /// Points from a Weyl sequence, spread evenly over (-1, 1)³.
    fn points() -> impl Iterator<Item = Vector> {
        (1..5_000).map(|i| {
            [0.754_877, 0.569_840, 0.430_159].map(|step| (f64::from(i) * step).fract() * 2.0 - 1.0)
        })
    }

    #[test]
    fn positions_are_within_half_a_quantum() {
        for size in [1e-3, 1.0, 12_345.6] {
            let exact: Vec<Vector> = points().map(|p| p.map(|x| x * size)).collect();
            let offset = [0.3 * size, -0.1 * size, 0.0];
            let (table, scale) = positions(&exact, offset);
            assert!(scale.mantissa() >= 1 << 31);
            let largest = table.as_flattened().iter().map(|x| x.unsigned_abs()).max();
            assert_eq!(largest, Some(32_767));
            for (&q, &p) in table.iter().zip(&exact) {
                let error = sub(position(q, scale, offset), p);
                // And the rounding of f64 itself.
                let limit = quantum(scale) * 0.5 + 1e-15 * size;
                assert!(error.iter().all(|e| e.abs() <= limit), "{q:?} for {p:?}");
            }
        }
    }

    #[test]
    fn scales_are_rounded_to_32_bits() {
        assert_eq!(nearest_scale(1.0), Scale::ONE);
        assert_eq!(nearest_scale(0.75), Scale::new(3, -2));
        assert_eq!(nearest_scale(1.0 - 1e-12), Scale::ONE);
        for value in [1e-9, 0.1, 3.3, 1e5] {
            let error = (quantum(nearest_scale(value)) / value - 1.0).abs();
            assert!(error <= 2_f64.powi(-32), "{value}: {error}");
        }
    }

    #[test]
    fn the_normal_is_the_triple_of_the_least_angle() {
        let ties =
            points().flat_map(|[a, b, _]| [[a, a, b], [b, a, -a], [a, 0.0, a], [0.0, b, 0.0]]);
        let mut seen = 0;
        for exact in points().chain(ties).filter_map(normalized) {
            let down = exact.map(|x| (x * 127.0).floor());
            let up = exact.map(|x| (x * 127.0).ceil());
            let corners = (0..8).map(|i| [0, 1, 2].map(|k| [down, up][i >> k & 1][k]));
            let near = corners.filter(|&c| {
                (length(c) - 127.0).abs() <= 0.75_f64.sqrt() && c.iter().all(|x| x.abs() <= 127.0)
            });
            let least = near.min_by(|&a, &b| angle(a, exact).total_cmp(&angle(b, exact))).unwrap();
            assert_eq!(normal(exact).map(f64::from), least.map(|x| x + 0.0), "{exact:?}");
            seen += 1;
        }
        assert!(seen > 1_000, "{seen}");
    }

    #[test]
    fn normals_are_no_worse_than_rounded_in_angle_nor_in_length() {
        assert_eq!(normal([0.0, -1.0, 0.0]), [0, -127, 0]);
        let (mut worst, mut worst_rounded) = (0.0_f64, 0.0_f64);
        for exact in points().filter_map(normalized) {
            let chosen = normal(exact);
            let rounded = exact.map(|x| (x * 127.0).round() as i8);
            assert!(normal_error(chosen, exact) <= normal_error(rounded, exact), "{exact:?}");
            assert!((length(chosen.map(f64::from)) - 127.0).abs() <= 0.75_f64.sqrt(), "{exact:?}");
            worst = worst.max(normal_error(chosen, exact));
            worst_rounded = worst_rounded.max(normal_error(rounded, exact));
        }
        // Rounding is off by up to half the diagonal of a unit cube at a distance of 127: 0.39
        // degrees.
        assert!(worst < 0.9 * worst_rounded && worst_rounded < 0.39_f64.to_radians());
    }
}
