//! Vectors in f64, in which the definitions of the tests are written.

/// Three coordinates.
pub type Vector = [f64; 3];

/// a - b.
#[must_use]
pub fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// The scalar product.
#[must_use]
pub fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// The vector product.
#[must_use]
pub const fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A vector of length one in the same direction.
#[must_use]
pub fn unit(v: Vector) -> Vector {
    v.map(|c| c / dot(v, v).sqrt())
}

/// The angle between two directions in radians, by its tangent, which is exact for small ones.
#[must_use]
pub fn angle(a: Vector, b: Vector) -> f64 {
    let across = cross(a, b);
    dot(across, across).sqrt().atan2(dot(a, b))
}
