//! Rays through the pixel centres, which judge the reference in tests. They share no step with the
//! drawing.

use super::camera::{Camera, Projection};

type Vector = [f64; 3];

/// All points `origin + distance * direction`, where `distance` is measured along the view axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ray {
    pub origin: Vector,
    pub direction: Vector,
}

/// Where a ray meets the plane of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// Along the view axis.
    pub distance: f64,
    /// Barycentric, in space; none is negative inside the triangle.
    pub weights: [f64; 3],
    /// Positive if the ray meets the front, 0 if it grazes the plane.
    pub determinant: f64,
}

impl Ray {
    /// The ray of a pixel centre.
    pub(super) fn through(camera: &Camera, x: usize, y: usize) -> Self {
        let forward = unit(add(camera.target, camera.eye, -1.0));
        let right = unit(perpendicular(forward, camera.up));
        let up = perpendicular(right, forward);
        let viewport = camera.viewport;
        let right_by = x as f64 + 0.5 - viewport.x - viewport.width / 2.0;
        let up_by = viewport.y + viewport.height / 2.0 - y as f64 - 0.5;
        let aside = add(right.map(|component| component * right_by), up, up_by);
        match camera.projection {
            Projection::Perspective { focal_length_px, .. } => {
                Self { origin: camera.eye, direction: add(forward, aside, 1.0 / focal_length_px) }
            }
            Projection::Orthographic { pixels_per_unit, .. } => {
                Self { origin: add(camera.eye, aside, 1.0 / pixels_per_unit), direction: forward }
            }
        }
    }

    /// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", Journal of Graphics
    /// Tools 2(1), 1997.
    pub(super) fn hit(&self, [a, b, c]: [Vector; 3]) -> Hit {
        let (ab, ac, ao) = (add(b, a, -1.0), add(c, a, -1.0), add(self.origin, a, -1.0));
        let p = perpendicular(self.direction, ac);
        let determinant = product(ab, p);
        let q = perpendicular(ao, ab);
        let (u, v) = (product(ao, p) / determinant, product(self.direction, q) / determinant);
        Hit { distance: product(ac, q) / determinant, weights: [1.0 - u - v, u, v], determinant }
    }
}

/// `a + scale * b`.
pub(super) fn add(a: Vector, b: Vector, scale: f64) -> Vector {
    [0, 1, 2].map(|i| a[i] + scale * b[i])
}

/// The scalar product.
pub(super) fn product(a: Vector, b: Vector) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The vector product.
fn perpendicular(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

/// The vector of length 1 in the same direction.
pub(super) fn unit(a: Vector) -> Vector {
    a.map(|component| component / product(a, a).sqrt())
}
