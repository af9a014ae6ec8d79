//! Vectors of three f64.

pub(super) type Vector = [f64; 3];

pub(super) fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn scaled(a: Vector, factor: f64) -> Vector {
    a.map(|x| x * factor)
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The largest of the coordinates' magnitudes.
pub(super) fn largest(a: Vector) -> f64 {
    a.into_iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// The length. Scales by the largest coordinate first, so that no square leaves the range of f64.
pub(super) fn length(a: Vector) -> f64 {
    let m = largest(a);
    if m == 0.0 {
        return 0.0;
    }
    let b = a.map(|x| x / m);
    m * dot(b, b).sqrt()
}

/// The unit vector in the same direction; `None` if all coordinates are 0.
pub(super) fn normalized(a: Vector) -> Option<Vector> {
    let m = largest(a);
    if m == 0.0 {
        return None;
    }
    let b = a.map(|x| x / m);
    let l = dot(b, b).sqrt();
    Some(b.map(|x| x / l))
}

/// The angle between two vectors in radians. The arc tangent is exact for small angles; an arc
/// cosine is not.
pub(super) fn angle(a: Vector, b: Vector) -> f64 {
    length(cross(a, b)).atan2(dot(a, b))
}

/// A hash key that is equal for equal vectors; 0 and -0 are equal.
pub(super) fn key<const N: usize>(a: [f64; N]) -> [u64; N] {
    a.map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extreme_vectors_keep_their_direction() {
        for size in [1e-300, 1.0, 1e300] {
            assert_eq!(normalized([3.0 * size, 0.0, -4.0 * size]), Some([0.6, 0.0, -0.8]));
        }
        assert_eq!(normalized([0.0, -0.0, 0.0]), None);
    }

    #[test]
    fn small_angles_are_exact() {
        let tilt = 1e-12;
        assert!((angle([1.0, 0.0, 0.0], [1.0, tilt, 0.0]) - tilt).abs() < 1e-20);
        assert_eq!(key([0.0, -0.0]), [0, 0]);
    }
}
