//! Clipping of triangles that reach beyond the near plane, the far plane or the guard band.
//!
//! Sutherland and Hodgman's reentrant clipping (CACM 17(1), 1974) in clip space, where the planes
//! are linear for either sign of w. A new vertex is computed from the inside towards the outside,
//! so that two triangles that share an edge get the same one, and is then moved exactly onto the
//! plane.

use core::ops::{Add, Sub};

use heapless::Vec;

use super::{
    Projection,
    lens::Lens,
    transform::{ClipVertex, Transform},
};
use crate::{
    attribute::{Varyings, lerp},
    numbers::{Coordinate, Divisor, codegen::keep_rolled, mul_q60, mul_wide_q30},
};

/// A triangle has three corners, and each of the six planes adds one at most.
pub(crate) const MAX_CORNERS: usize = 9;

#[derive(Clone, Copy, Debug)]
enum ClipPlane {
    Near,
    Far,
    Left,
    Right,
    Top,
    Bottom,
}

/// The near plane comes first: all w beyond it are positive.
const PLANES: [ClipPlane; 6] = [
    ClipPlane::Near,
    ClipPlane::Far,
    ClipPlane::Left,
    ClipPlane::Right,
    ClipPlane::Top,
    ClipPlane::Bottom,
];

impl ClipPlane {
    /// The distance of a place from the plane, negative outside, in units of the place.
    #[inline(always)]
    fn difference<T: Add<Output = T> + Sub<Output = T>>(
        self,
        [x, y, z]: [T; 3],
        w: T,
        [near, far]: [T; 2],
    ) -> T {
        match self {
            Self::Near => z - near,
            Self::Far => far - z,
            Self::Left => w + x,
            Self::Right => w - x,
            Self::Top => w + y,
            Self::Bottom => w - y,
        }
    }

    /// The distance of a vertex by its whole units, which tell on which side it is. No coordinate
    /// reaches 2^30.
    #[inline(never)]
    fn distance<P: Projection, C: Coordinate, V>(
        self,
        vertex: &ClipVertex<C, V>,
        transform: &Transform<P>,
    ) -> i32 {
        let place = [vertex.x, vertex.y, vertex.z].map(C::units);
        self.difference(place, transform.lens.w(place[2]), [transform.near, transform.far])
    }

    /// The distance in the digits that a coordinate keeps.
    fn exact_distance<P: Projection, C: Coordinate, V>(
        self,
        vertex: &ClipVertex<C, V>,
        transform: &Transform<P>,
    ) -> i64 {
        let place = [vertex.x, vertex.y, vertex.z].map(C::to_bits);
        let depths = [transform.near, transform.far].map(|units| C::new(units, 0).to_bits());
        self.difference(place, transform.lens.w(vertex.z).to_bits(), depths)
    }

    /// The intersection with an edge of which one end lies inside, by the signed distances of both.
    #[inline(always)]
    fn cut<P: Projection, C: Coordinate, V: Varyings>(
        self,
        [from, to]: [&ClipVertex<C, V>; 2],
        [from_distance, to_distance]: [i32; 2],
        transform: &Transform<P>,
    ) -> ClipVertex<C, V> {
        let (inside, outside) = if to_distance < 0 { (from, to) } else { (to, from) };
        let mut vertex = if C::HAS_FRACTION {
            exact_crossing(self, inside, outside, transform)
        } else {
            let (most, least) = (from_distance.max(to_distance), from_distance.min(to_distance));
            crossing(inside, outside, most, least)
        };
        self.put_onto(&mut vertex, transform);
        vertex
    }

    /// Moves a new vertex, which is rounded, exactly onto the plane.
    fn put_onto<P: Projection, C: Coordinate, V>(
        self,
        vertex: &mut ClipVertex<C, V>,
        transform: &Transform<P>,
    ) {
        let w = transform.lens.w(vertex.z).to_bits();
        match self {
            Self::Near => vertex.z = C::new(transform.near, 0),
            Self::Far => vertex.z = C::new(transform.far, 0),
            Self::Left => vertex.x = C::from_bits(-w),
            Self::Right => vertex.x = C::from_bits(w),
            Self::Top => vertex.y = C::from_bits(-w),
            Self::Bottom => vertex.y = C::from_bits(w),
        }
    }
}

/// Returns the part of a line that lies inside all planes, in its direction. It has the same new
/// ends as an edge of a triangle.
pub(crate) fn clip_line<P: Projection, C: Coordinate, V: Varyings>(
    [mut from, mut to]: [ClipVertex<C, V>; 2],
    transform: &Transform<P>,
) -> Option<[ClipVertex<C, V>; 2]> {
    for plane in PLANES {
        let distances = [plane.distance(&from, transform), plane.distance(&to, transform)];
        let cut = || plane.cut([&from, &to], distances, transform);
        match distances.map(|distance| distance < 0) {
            [false, false] => {}
            [true, true] => return None,
            [true, false] => from = cut(),
            [false, true] => to = cut(),
        }
    }
    Some([from, to])
}

/// Visits the corners of the part of a triangle that lies inside all planes: a convex polygon, in
/// the triangle's order, or none.
#[inline(always)]
pub(crate) fn clip<P: Projection, C: Coordinate, V: Varyings>(
    triangle: impl IntoIterator<Item = ClipVertex<C, V>>,
    transform: &Transform<P>,
    visit: impl FnMut(ClipVertex<C, V>),
) {
    let mut polygon: Vec<ClipVertex<C, V>, MAX_CORNERS> = Vec::new();
    for corner in triangle {
        keep_rolled();
        // Three corners fit nine places; the result of a push is an error only where they don't.
        let _ = polygon.push(corner);
    }
    for plane in PLANES {
        let mut cut: Vec<ClipVertex<C, V>, MAX_CORNERS> = Vec::new();
        let Some(mut from) = polygon.last() else {
            break;
        };
        let mut from_distance = plane.distance(from, transform);
        for to in &polygon {
            let to_distance = plane.distance(to, transform);
            if (from_distance < 0) != (to_distance < 0) {
                let distances = [from_distance, to_distance];
                let _ = cut.push(plane.cut([from, to], distances, transform));
            }
            if to_distance >= 0 {
                let _ = cut.push(*to);
            }
            (from, from_distance) = (to, to_distance);
        }
        polygon = cut;
    }
    polygon.iter().copied().for_each(visit);
}

/// The intersection of an edge with a plane, by the signed distances of both ends from it.
#[inline(never)]
fn crossing<C: Coordinate, V: Varyings>(
    inside: &ClipVertex<C, V>,
    outside: &ClipVertex<C, V>,
    inside_distance: i32,
    outside_distance: i32,
) -> ClipVertex<C, V> {
    // Distances are below 2^31: the shifted dividend is below 2^61, and t at most 2^30.
    let length = inside_distance.abs_diff(outside_distance);
    let (t, _) = Divisor::new(length.into()).divide(i64::from(inside_distance) << 30);
    let t = t as u32;
    let between = |a: C, b: C| C::from_bits(lerp(a.to_bits(), b.to_bits(), t));
    ClipVertex {
        x: between(inside.x, outside.x),
        y: between(inside.y, outside.y),
        z: between(inside.z, outside.z),
        varyings: inside.varyings.lerp(outside.varyings, t),
    }
}

/// The same for coordinates with a fraction, at a place on the edge that is known to a 2^57th.
#[cold]
#[inline(never)]
fn exact_crossing<P: Projection, C: Coordinate, V: Varyings>(
    plane: ClipPlane,
    inside: &ClipVertex<C, V>,
    outside: &ClipVertex<C, V>,
    transform: &Transform<P>,
) -> ClipVertex<C, V> {
    // Whole units told on which side they are; a fraction may tell otherwise.
    let distance = plane.exact_distance(inside, transform).max(0);
    let length = distance.saturating_sub(plane.exact_distance(outside, transform).min(-1));
    let t = quotient(distance, length);
    let between = |a: C, b: C| C::from_bits(a.to_bits() + mul_q60(b.to_bits() - a.to_bits(), t));
    ClipVertex {
        x: between(inside.x, outside.x),
        y: between(inside.y, outside.y),
        z: between(inside.z, outside.z),
        varyings: inside.varyings.lerp(outside.varyings, (t >> 30) as u32),
    }
}

/// `distance / length` in Q60, for a distance from 0 to a positive length: within 2^-57, and within
/// 2^-30 for a length below 2^33.
#[inline(always)]
pub(super) fn quotient(distance: i64, length: i64) -> i64 {
    let divide = |dividend: i64, divisor: i64| {
        Divisor::new(divisor.max(1).cast_unsigned()).divide(dividend).0
    };
    // The upper 30 bits of the quotient, from as many bits of both as let it fit.
    let drop = 33u32.saturating_sub(length.leading_zeros());
    let upper = divide((distance >> drop) << 30, length >> drop).min(1 << 30);
    // The others from what is left, at most 2^35. An edge of less than two units has none.
    let rest = distance - mul_wide_q30(length, upper as i32);
    let lower = if length >> 33 == 0 { 0 } else { divide(rest << 27, length >> 33) };
    ((upper << 30) + lower).clamp(0, 1 << 60)
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::{
        geometry::{Point, Size},
        primitives::Rectangle,
    };

    use super::*;
    use crate::{
        camera::{Camera, Distance, Perspective},
        geometry::{Pose, transform::CameraAxes},
        mesh::{Material, Mesh, Positions, Tables, Triangles},
        numbers::{Rotation, S4, S8, Scale, Subpixel, Vec3},
        random::Random,
    };

    fn transform<S: Subpixel>() -> Transform<Perspective> {
        let lens = Perspective::with_focal_length(
            Distance::lit("100"),
            Distance::ONE,
            Distance::lit("20"),
        )
        .unwrap();
        let viewport = Rectangle::new(Point::zero(), Size::new(64, 64));
        let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, viewport).unwrap();
        let tables = Tables {
            positions: Positions::I16(&[[i16::MIN; 3], [i16::MAX; 3]]),
            scale: Scale::new(1, -10),
            triangles: Triangles::U8(&[[0; 3]]),
            materials: const { &[Material::new([0; 3], 1)] },
            ..Tables::EMPTY
        };
        Transform::new::<S>(&camera, CameraAxes, &Pose::IDENTITY, &Mesh::new_const(tables))
    }

    fn vertex(transform: &Transform<Perspective>, position: [i16; 3]) -> ClipVertex<i32, [u16; 1]> {
        transform.object_to_clip(position, [position[0] as u16 ^ 0x8000])
    }

    fn polygon(
        triangle: [ClipVertex<i32, [u16; 1]>; 3],
        transform: &Transform<Perspective>,
    ) -> Vec<ClipVertex<i32, [u16; 1]>, MAX_CORNERS> {
        let mut polygon = Vec::new();
        clip(triangle, transform, |corner| polygon.push(corner).unwrap());
        polygon
    }

    fn is_inside(vertex: &ClipVertex<i32, [u16; 1]>, transform: &Transform<Perspective>) -> bool {
        PLANES.iter().all(|plane| plane.distance(vertex, transform) >= 0)
    }

    fn coordinate(random: &mut Random) -> i16 {
        random.bits() as i16
    }

    #[test]
    fn a_triangle_inside_is_left_alone_and_one_outside_vanishes() {
        let transform = transform::<S4>();
        let inside =
            [[-100, 0, -3000], [100, 0, -3000], [0, 90, -4000]].map(|p| vertex(&transform, p));
        assert_eq!(polygon(inside, &transform).as_slice(), inside);
        let behind =
            [[-100, 0, 3000], [100, 0, 3000], [0, 90, 4000]].map(|p| vertex(&transform, p));
        assert!(polygon(behind, &transform).is_empty());
    }

    #[test]
    fn corners_are_inside_all_planes_and_within_the_varyings_range() {
        let transform = transform::<S4>();
        let mut random = Random::new(99);
        let mut largest = 0;
        for _ in 0..20_000 {
            let triangle =
                [0; 3].map(|_| vertex(&transform, [0; 3].map(|_| coordinate(&mut random))));
            let polygon = polygon(triangle, &transform);
            largest = largest.max(polygon.len());
            let levels = triangle.map(|v| v.varyings[0]);
            for corner in &polygon {
                assert!(is_inside(corner, &transform), "{triangle:?}: {corner:?}");
                let range = *levels.iter().min().unwrap()..=*levels.iter().max().unwrap();
                assert!(range.contains(&corner.varyings[0]), "{triangle:?}: {corner:?}");
            }
        }
        assert!(largest >= 6, "no triangle met several planes");
    }

    /// Edges that cross one plane, against the exact crossing: within the 4 units that `ClipAll`
    /// documents. Its ends are known to a unit, and so is what is interpolated between them.
    #[test]
    fn cut_corners_are_where_the_edge_meets_the_plane() {
        let transform = transform::<S4>();
        let mut random = Random::new(17);
        let (mut cut, mut worst) = (0, 0f64);
        for _ in 0..50_000 {
            let [a, b] =
                [0; 2].map(|_| vertex(&transform, [0; 3].map(|_| coordinate(&mut random))));
            let crossed: Vec<_, 6> =
                PLANES.into_iter().filter(|plane| plane.distance(&b, &transform) < 0).collect();
            let [plane] = crossed.as_slice() else {
                continue;
            };
            if !is_inside(&a, &transform) {
                continue;
            }
            let ends = [plane.distance(&a, &transform), plane.distance(&b, &transform)];
            let t = f64::from(ends[0]) / (f64::from(ends[0]) - f64::from(ends[1]));
            let exact = |a: i32, b: i32| f64::from(a) + (f64::from(b) - f64::from(a)) * t;
            let exact = [exact(a.x, b.x), exact(a.y, b.y), exact(a.z, b.z)];
            for corner in polygon([a, b, b], &transform).iter().filter(|corner| **corner != a) {
                cut += 1;
                for (got, want) in [corner.x, corner.y, corner.z].into_iter().zip(exact) {
                    worst = worst.max((f64::from(got) - want).abs());
                }
            }
        }
        assert!(cut > 1000, "only {cut} edges were cut");
        assert!(worst <= 2.0, "{worst}");
    }

    /// With a fraction: within a 2^57th of the edge, against exact rationals.
    #[test]
    fn cut_corners_with_a_fraction_are_on_the_edge() {
        let transform = transform::<S8>();
        let mut random = Random::new(18);
        let mut cut = 0;
        for _ in 0..50_000 {
            let [a, b] = [0; 2].map(|_| {
                transform.object_to_clip::<i64, _>([0; 3].map(|_| coordinate(&mut random)), [7u16])
            });
            for plane in PLANES {
                if plane.distance(&a, &transform) < 0 || plane.distance(&b, &transform) >= 0 {
                    continue;
                }
                cut += 1;
                let [from, to] =
                    [a, b].map(|end| i128::from(plane.exact_distance(&end, &transform)));
                let corner = exact_crossing(plane, &a, &b, &transform);
                for (got, [a, b]) in
                    [(corner.x, [a.x, b.x]), (corner.y, [a.y, b.y]), (corner.z, [a.z, b.z])]
                {
                    let exact = (i128::from(a) * -to + i128::from(b) * from) / (from - to);
                    let bound = 4 + (i128::from(b) - i128::from(a)).abs() / (1 << 57);
                    assert!((i128::from(got) - exact).abs() <= bound, "{a} {b}: {got} {exact}");
                }
            }
        }
        assert!(cut > 10_000, "only {cut} edges were cut");
    }

    /// The corners on an edge are the same whichever triangle it belongs to and whichever way it
    /// runs.
    #[test]
    fn a_shared_edge_is_cut_alike() {
        let transform = transform::<S4>();
        let mut random = Random::new(7);
        let mut cut = 0;
        for _ in 0..20_000 {
            let [a, b, c, d] =
                [0; 4].map(|_| vertex(&transform, [0; 3].map(|_| coordinate(&mut random))));
            let left = polygon([a, b, c], &transform);
            let right = polygon([b, a, d], &transform);
            // The edge alone: as a degenerate triangle that runs there and back, and as a line.
            let edge = polygon([a, b, b], &transform);
            match clip_line([a, b], &transform) {
                Some(ends) => assert!(ends.iter().all(|end| edge.contains(end)), "{a:?} {b:?}"),
                None => assert!(edge.is_empty(), "{a:?} {b:?}"),
            }
            for corner in &edge {
                cut += usize::from(*corner != a && *corner != b);
                assert!(left.contains(corner), "{a:?} {b:?} {c:?}: {corner:?}");
                assert!(right.contains(corner), "{b:?} {a:?} {d:?}: {corner:?}");
            }
        }
        assert!(cut > 1000, "only {cut} edges were cut");
    }
}
