//! Clipping of triangles that reach beyond the near plane, the far plane or the guard band.
//!
//! Sutherland and Hodgman's reentrant clipping (CACM 17(1), 1974) in clip space, where the planes are linear whatever the
//! sign of w. A new vertex is worked out from the inside towards the outside, so that two triangles that share an edge
//! get the identical one, and then put exactly onto the plane.

use heapless::Vec;

use super::{
    Projection, Varyings,
    attribute::lerp,
    projection::Lens,
    transform::{ClipVertex, Transform},
};
use crate::numbers::Divisor;

/// A triangle has three corners, and each of the six planes adds one at most.
pub(crate) const MAX_CORNERS: usize = 9;

#[derive(Clone, Copy, Debug)]
enum Plane {
    Near,
    Far,
    Left,
    Right,
    Top,
    Bottom,
}

/// The near plane comes first: behind it all w are positive.
const PLANES: [Plane; 6] = [
    Plane::Near,
    Plane::Far,
    Plane::Left,
    Plane::Right,
    Plane::Top,
    Plane::Bottom,
];

impl Plane {
    /// How far inside the plane a vertex lies, in some unit; negative outside.
    fn distance<P: Projection, V>(self, vertex: &ClipVertex<V>, transform: &Transform<P>) -> i64 {
        let [x, y, z] = [vertex.x, vertex.y, vertex.z].map(i64::from);
        let w = i64::from(transform.lens.w(vertex.z));
        match self {
            Self::Near => z - i64::from(transform.near),
            Self::Far => i64::from(transform.far) - z,
            Self::Left => w + x,
            Self::Right => w - x,
            Self::Top => w + y,
            Self::Bottom => w - y,
        }
    }

    /// Takes the rounding out of a new vertex.
    fn put_onto<P: Projection, V>(self, vertex: &mut ClipVertex<V>, transform: &Transform<P>) {
        let w = transform.lens.w(vertex.z);
        match self {
            Self::Near => vertex.z = transform.near,
            Self::Far => vertex.z = transform.far,
            Self::Left => vertex.x = -w,
            Self::Right => vertex.x = w,
            Self::Top => vertex.y = -w,
            Self::Bottom => vertex.y = w,
        }
    }
}

/// What is left of a triangle: a convex polygon, its corners in the triangle's order, or nothing.
pub(crate) fn clip<P: Projection, V: Varyings>(
    triangle: [ClipVertex<V>; 3],
    transform: &Transform<P>,
) -> Vec<ClipVertex<V>, MAX_CORNERS> {
    let mut polygon: Vec<ClipVertex<V>, MAX_CORNERS> = Vec::new();
    // Three corners fit nine places; the result of a push is an error only where they don't.
    let _ = polygon.extend_from_slice(&triangle);
    for plane in PLANES {
        let mut cut: Vec<ClipVertex<V>, MAX_CORNERS> = Vec::new();
        let Some(mut from) = polygon.last() else {
            break;
        };
        let mut from_distance = plane.distance(from, transform);
        for to in &polygon {
            let to_distance = plane.distance(to, transform);
            if (from_distance < 0) != (to_distance < 0) {
                let mut vertex = if to_distance < 0 {
                    crossing(from, to, from_distance, to_distance)
                } else {
                    crossing(to, from, to_distance, from_distance)
                };
                plane.put_onto(&mut vertex, transform);
                let _ = cut.push(vertex);
            }
            if to_distance >= 0 {
                let _ = cut.push(*to);
            }
            (from, from_distance) = (to, to_distance);
        }
        polygon = cut;
    }
    polygon
}

/// Where the edge from `inside` to `outside` meets the plane from which they are so far.
fn crossing<V: Varyings>(
    inside: &ClipVertex<V>,
    outside: &ClipVertex<V>,
    inside_distance: i64,
    outside_distance: i64,
) -> ClipVertex<V> {
    // Coordinates are below 2^30: distances below 2^31, the shifted dividend below 2^61, and t at most 2^30.
    let length = (inside_distance - outside_distance) as u64;
    let (t, _) = Divisor::new(length).divide(inside_distance << 30);
    let t = t as u32;
    let between = |a: i32, b: i32| lerp(i64::from(a), i64::from(b), t) as i32;
    ClipVertex {
        x: between(inside.x, outside.x),
        y: between(inside.y, outside.y),
        z: between(inside.z, outside.z),
        varyings: inside.varyings.lerp(outside.varyings, t),
    }
}
