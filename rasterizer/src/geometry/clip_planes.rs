//! Clipping by planes of the user's own, before the near plane, the far plane and the guard band.
//!
//! The distance of a vertex from a plane is a linear function of its position in the mesh, of which
//! no digit is lost: it tells on which side of the plane the vertex lies, and where an edge meets
//! it. A new vertex depends on its edge alone: it is computed from the end with the lesser
//! coordinates, so that the triangles that share an edge, and what is left of one on both sides of
//! a plane, get the same one.

use heapless::Vec;

use super::{
    Plane,
    clip::{MAX_CORNERS, quotient},
    placement::{Axis, Grid},
    row::Row,
    shape::Posed,
    transform::ClipVertex,
};
use crate::{
    attribute::Varyings,
    mesh::Mesh,
    numbers::{Coordinate, Float, mul_q60},
};

/// Cuts an object at planes of your own, besides the near plane, the far plane and the guard band:
/// kept is what lies on the positive side of all of them, or on them. For a view into a model, what
/// is above water, a portal.
///
/// ```
/// # use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{geometry::{ClipPlanes, Plane}, mesh::Mesh, prelude::*, scene::Modes};
/// /// What is above a water level of 0.25.
/// const ABOVE: Plane = Plane::new(Vec3::Y, Scalar::lit("-0.25"));
///
/// # type Boat<'a> = Object<'a, Flat<Rgb565>, Modes<CullBack, ClipPlanes<1>>>;
/// # fn boat<'a>(mesh: &'a Mesh<'a>, sun: Light) -> Boat<'a> {
/// Object::new(mesh, Flat::new(sun)).clipped(ClipPlanes::in_world([ABOVE]))
/// # }
/// ```
///
/// Up to six planes. Triangles and lines are cut where they meet them, with all that is
/// interpolated over them, as at the near plane; what is left of an open body shows its inside
/// ([`CullNone`](super::CullNone)).
///
/// A vertex of the mesh is on the side of a plane that its position in the mesh's tables, the pose
/// and the plane tell, unless it is nearer to the plane than a 1,000th of a quantum of the tables
/// and a 2<sup>26</sup>th of its distance from the mesh's origin. A new vertex lies on its edge, as
/// exactly as those of [`ClipAll`](super::ClipAll): within an eighth of a sub-pixel with
/// [`S4`](crate::numbers::S4) and less with [`S8`](crate::numbers::S8), before it is snapped.
/// Triangles that share an edge share the new vertex on it. So do the two parts of an object on
/// both sides of a plane ([`Plane::flipped`]): together they cover the pixels that the triangles
/// cover if they are divided there, each once. Only triangles in the plane are part of both.
///
/// Each vertex takes three products for each plane, and triangles that meet none take nothing more.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClipPlanes<const N: usize> {
    planes: [Plane; N],
    is_in_world: bool,
    /// For an object in its pose.
    distances: [PlaneDistance; N],
}

impl<const N: usize> ClipPlanes<N> {
    /// Of the world: they stay where they are when the object moves.
    #[must_use]
    pub const fn in_world(planes: [Plane; N]) -> Self {
        Self::new(planes, true)
    }

    /// Of the object: in its model's units, they move with it. A matrix of its own
    /// ([`Object::shaped`](crate::scene::Object::shaped)) changes them with it: they cut the model
    /// where they cut it without the matrix.
    #[must_use]
    pub const fn in_object(planes: [Plane; N]) -> Self {
        Self::new(planes, false)
    }

    const fn new(planes: [Plane; N], is_in_world: bool) -> Self {
        const { assert!(N <= MAX_CORNERS - 3, "an object has up to six clip planes") }
        Self { planes, is_in_world, distances: [PlaneDistance::NONE; N] }
    }

    /// The same for an object in its pose.
    #[inline(never)]
    pub(super) fn placed(mut self, posed: impl Posed, mesh: &Mesh<'_>) -> Self {
        let posed = if self.is_in_world { posed } else { posed.identity() };
        for (distance, plane) in self.distances.iter_mut().zip(&self.planes) {
            *distance = PlaneDistance::new(plane, posed, mesh);
        }
        self
    }

    /// Whether a position of the mesh is kept.
    #[inline(always)]
    pub(super) fn keeps(&self, position: [i16; 3]) -> bool {
        self.distances.iter().all(|distance| distance.of(position) >= 0)
    }

    /// Whether all of some positions are outside one and the same plane.
    #[inline(never)]
    pub(super) fn excludes(&self, positions: impl Iterator<Item = [i16; 3]> + Clone) -> bool {
        let is_outside =
            |distance: &PlaneDistance| positions.clone().all(|position| distance.of(position) < 0);
        self.distances.iter().any(is_outside)
    }

    /// The part of a triangle that is kept: a convex polygon in the triangle's order, or none.
    #[inline(never)]
    pub(super) fn cut<C: Coordinate, V: Varyings>(
        &self,
        triangle: &[Corner<C, V>; 3],
        kept: &mut Vec<ClipVertex<C, V>, MAX_CORNERS>,
    ) {
        let mut polygon: Vec<Apart<C, V, N>, MAX_CORNERS> = Vec::new();
        for corner in triangle {
            // Three corners, and one for each plane, fit.
            let _ = polygon.push(self.apart(corner));
        }
        for plane in 0..N {
            let mut cut = Vec::new();
            let Some(mut from) = polygon.last() else { return };
            for to in &polygon {
                let (is_from_kept, is_to_kept) = (from.is_kept(plane), to.is_kept(plane));
                if is_from_kept != is_to_kept {
                    let _ = cut.push(from.crossing(to, plane));
                }
                if is_to_kept {
                    let _ = cut.push(*to);
                }
                from = to;
            }
            polygon = cut;
        }
        for corner in &polygon {
            let _ = kept.push(corner.vertex);
        }
    }

    /// The part of a line that is kept. It has the same new ends as an edge of a triangle.
    #[inline(never)]
    pub(super) fn cut_line<C: Coordinate, V: Varyings>(
        &self,
        ends: &[Corner<C, V>; 2],
    ) -> Option<[ClipVertex<C, V>; 2]> {
        let [mut from, mut to] = [self.apart(&ends[0]), self.apart(&ends[1])];
        for plane in 0..N {
            match [from.is_kept(plane), to.is_kept(plane)] {
                [true, true] => {}
                [false, false] => return None,
                [false, true] => from = from.crossing(&to, plane),
                [true, false] => to = from.crossing(&to, plane),
            }
        }
        Some([from.vertex, to.vertex])
    }

    fn apart<C: Coordinate, V: Varyings>(&self, corner: &Corner<C, V>) -> Apart<C, V, N> {
        let (position, vertex) = corner;
        Apart { vertex: *vertex, distances: self.distances.map(|distance| distance.of(*position)) }
    }
}

/// A vertex with its position in the mesh.
pub(crate) type Corner<C, V> = ([i16; 3], ClipVertex<C, V>);

/// A vertex with its distances from all planes.
#[derive(Clone, Copy, Debug)]
struct Apart<C, V, const N: usize> {
    vertex: ClipVertex<C, V>,
    distances: [i64; N],
}

impl<C: Coordinate, V: Varyings, const N: usize> Apart<C, V, N> {
    fn distance(&self, plane: usize) -> i64 {
        self.distances.get(plane).copied().unwrap_or_default()
    }

    fn is_kept(&self, plane: usize) -> bool {
        self.distance(plane) >= 0
    }

    /// The intersection of an edge with a plane, from which its ends lie apart. It is the same for
    /// either order of the ends, and either side of the plane.
    fn crossing(&self, other: &Self, plane: usize) -> Self {
        let place = |end: &Self| [end.vertex.x, end.vertex.y, end.vertex.z].map(C::to_bits);
        let (from, to) = if place(self) <= place(other) { (self, other) } else { (other, self) };
        // No distance reaches 2^62.
        let [a, b] = [from, to].map(|end| end.distance(plane).wrapping_abs());
        let t = quotient(a, a.wrapping_add(b).max(1));
        let between = |a: i64, b: i64| a.wrapping_add(mul_q60(b.wrapping_sub(a), t));
        let coordinate = |a: C, b: C| C::from_bits(between(a.to_bits(), b.to_bits()));
        let mut distances = [0; N];
        for (distance, (&a, &b)) in
            distances.iter_mut().zip(from.distances.iter().zip(&to.distances))
        {
            *distance = between(a, b);
        }
        Self {
            vertex: ClipVertex {
                x: coordinate(from.vertex.x, to.vertex.x),
                y: coordinate(from.vertex.y, to.vertex.y),
                z: coordinate(from.vertex.z, to.vertex.z),
                varyings: from.vertex.varyings.lerp(to.vertex.varyings, (t >> 30) as u32),
            },
            distances,
        }
    }
}

/// The distance from a plane as a function of a position of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct PlaneDistance {
    row: Row,
    position_shift: u32,
    /// Whether the row is that of the flipped plane.
    is_flipped: bool,
}

impl PlaneDistance {
    /// Of an object without a pose.
    const NONE: Self = Self { row: Row::ZERO, position_shift: 0, is_flipped: false };

    fn new(plane: &Plane, posed: impl Posed, mesh: &Mesh<'_>) -> Self {
        let (normal, offset, is_flipped) = plane.normalised();
        // Three products below 2^60, and an offset below 2^62.
        let way = posed.pose().translation.along(&normal).wrapping_add(offset);
        let axis = Axis::along(&normal, way, Float::new(1, 0), posed, mesh.tables().offset);
        let grid = Grid::new(posed, mesh);
        // The least unit in which no position's distance reaches 2^30.
        let unit = axis.magnitude(&grid) - 30;
        Self {
            row: <Row>::new::<i64>(&axis, &grid, unit),
            position_shift: mesh.spare_bits() + <Row>::POSITION_SHIFT,
            is_flipped,
        }
    }

    #[inline(always)]
    fn of(&self, position: [i16; 3]) -> i64 {
        let shifted = |axis: usize| i32::from(position[axis]) << self.position_shift;
        let distance: i64 = self.row.apply([shifted(0), shifted(1), shifted(2)]);
        if self.is_flipped { distance.wrapping_neg() } else { distance }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        camera::Distance,
        geometry::Pose,
        mesh::{Material, Positions, Tables, Triangles},
        numbers::{Rotation, Scale, Turn, Vec3},
        random::Random,
    };

    /// The side of a position, against f64, where that knows it. Distances are compared in quanta.
    #[test]
    fn sides_are_those_of_the_tables() {
        let mut random = Random::new(5);
        let (mut near, mut worst) = (0, 0f64);
        for _ in 0..3000 {
            let mut bits = |down: u32| ((random.bits() as i32) << 1) >> down;
            let positions = [0; 40].map(|_| [0; 3].map(|_| bits(16) as i16));
            let offset = Vec3::from_bits([0; 3].map(|_| bits(14)));
            let tables = Tables {
                positions: Positions::I16(&positions),
                scale: Scale::new(3, -15),
                offset,
                triangles: Triangles::U8(&[[0; 3]]),
                materials: const { &[Material::new([0; 3], 1)] },
                ..Tables::EMPTY
            };
            let turn = Rotation::about_x(Turn::from_bits(bits(0) as u32))
                * Rotation::about_y(Turn::from_bits(bits(0) as u32));
            let translation = Vec3::from_bits([0; 3].map(|_| bits(12)));
            let pose = Pose::rotated(turn).at(translation).scaled(Distance::lit("1.5"));
            let normal = Vec3::from_bits([0; 3].map(|_| bits(10)));
            let numbers = |v: Vec3| v.to_bits().map(|c| f64::from(c) / 65_536.0);
            let (n, t, o) = (numbers(normal), numbers(translation), numbers(offset));
            let rows = turn.rows().map(|row| row.map(|c| c.to_num::<f64>()));
            let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
            let world = |p: [i16; 3]| {
                let model = [0, 1, 2].map(|i| 1.5 * (o[i] + f64::from(p[i]) * 3.0 / 32_768.0));
                [0, 1, 2].map(|i| dot(rows[i], model) + t[i])
            };
            // Through a position, up to a 65,536th of a unit over the normal's length.
            let through = dot(n, world(positions[0]));
            if through.abs() > 32_000.0 {
                continue;
            }
            let plane = Plane::new(normal, crate::numbers::Scalar::from_num(-through));
            let mesh = Mesh::new_const(tables);
            let distances =
                [plane, plane.flipped()].map(|plane| PlaneDistance::new(&plane, &pose, &mesh));
            let quantum = dot(n, n).sqrt() * 1.5 * 3.0 / 32_768.0;
            for position in positions {
                let [got, flipped] = distances.map(|distance| distance.of(position));
                assert_eq!(got, -flipped, "{plane:?}");
                let exact = (dot(n, world(position)) + plane.offset.to_num::<f64>()) / quantum;
                if (got >= 0) != (exact >= 0.0) {
                    worst = worst.max(exact.abs());
                }
                near += usize::from(exact.abs() < 0.1);
            }
        }
        assert!(near > 1000, "{near}");
        // Positions are up to 2^16 quanta from the origin, of which a 2^26th is a 1,000th.
        assert!(worst < 0.002, "{worst} quanta");
    }
}
