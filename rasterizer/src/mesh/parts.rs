//! The parts of a mesh, and planes that lie between them: from where the viewer stands follows
//! which parts hide which.

use super::{BoundingBox, Mesh};
use crate::numbers::codegen::{self, keep_rolled};

/// A plane with some consecutive parts of a mesh in front of it, and those that follow behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SeparatingPlane {
    /// Three points of the plane.
    points: [[i16; 3]; 3],
    /// The first part in front, the first part behind, and the end of those behind.
    ends: [u8; 3],
}

impl SeparatingPlane {
    /// The plane through three points, in quanta of the mesh, that run counter-clockwise as seen
    /// from in front of it. Parts `first..middle` lie in front of it, parts `middle..end` behind
    /// it; both may touch it.
    ///
    /// The points must lie in the [box](Mesh::bounds) of the mesh.
    ///
    /// The farther the points are from each other, the better. With h the least height of their
    /// triangle, d the distance of the mesh's farthest point from the viewer, and the focal length
    /// f in pixels, but 1,024 at most, the side on which the viewer stands is known if it is more
    /// than 2<sup>-21</sup> d² / h (1,024 / f)² from the plane. In a parallel projection, the sine
    /// of the angle between the view and the plane must be more than 2<sup>-21</sup> g / h, where g
    /// is the mesh's size or 1,024 pixels, whichever is more. Nearer to it, the plane is seen from
    /// its edge, and parts that do not touch it do not overlap.
    #[must_use]
    pub const fn new(points: [[i16; 3]; 3], [first, middle, end]: [u8; 3]) -> Self {
        Self { points, ends: [first, middle, end] }
    }

    /// Its three points.
    pub(crate) const fn points(&self) -> &[[i16; 3]; 3] {
        &self.points
    }
}

/// [`Parts::MOST`].
const MOST: usize = 32;

/// A mesh in parts that planes keep apart: where no triangle of a part hides another one of it, all
/// of the mesh is drawn right without depth and without sorting, from wherever it is seen
/// ([`Projected::in_parts`](crate::scene::Projected::in_parts)).
///
/// The planes are a tree (Fuchs, Kedem and Naylor, *On visible surface generation by a priori tree
/// structures*, 1980): one has all parts on its two sides, and each side of more than one part is
/// divided by another plane in the same way. No triangle is cut.
///
/// ```
/// use rasterizer::mesh::{Material, Mesh, Parts, Positions, SeparatingPlane, Tables, Triangles};
///
/// /// Two sails of one triangle each, one behind the other.
/// static SAILS: Mesh<'static> = Mesh::new_const(Tables {
///     positions: Positions::I16(&[
///         [0, 0, 9], [6, 0, 9], [0, 9, 9], [0, 0, -9], [6, 0, -9], [0, 9, -9],
///     ]),
///     triangles: Triangles::U8(&[[0, 1, 2], [3, 4, 5]]),
///     materials: &[Material::new([255, 240, 200], 2)],
///     ..Tables::EMPTY
/// });
/// const BETWEEN: SeparatingPlane =
///     SeparatingPlane::new([[0, 0, 0], [6, 0, 0], [0, 9, 0]], [0, 1, 2]);
/// static PARTS: Parts<'static> = Parts::new_const(&SAILS, &[1, 2], &[BETWEEN]);
/// assert_eq!(PARTS.count(), 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Parts<'a> {
    ends: &'a [u32],
    planes: &'a [SeparatingPlane],
}

impl<'a> Parts<'a> {
    /// The most parts that a mesh may have.
    pub const MOST: usize = MOST;

    /// Checks parts of a mesh. Part i has the triangles of the table up to `ends[i]`, from the end
    /// of the part before it.
    ///
    /// `planes` are one fewer than the parts: first that between all of them, then those between
    /// the parts in front of it, then those between the parts behind it, each side in the same
    /// order.
    ///
    /// # Errors
    ///
    /// Returns the first fault. A triangle on the wrong side of a plane is one.
    pub const fn new(
        mesh: &Mesh<'_>,
        ends: &'a [u32],
        planes: &'a [SeparatingPlane],
    ) -> Result<Self, PartsError> {
        if ends.is_empty() || ends.len() > Self::MOST {
            return Err(PartsError::Count);
        }
        let (mut part, mut first) = (0, 0);
        while part < ends.len() {
            if ends[part] <= first {
                return Err(PartsError::Ends);
            }
            first = ends[part];
            part += 1;
        }
        if first as usize != mesh.triangle_count() {
            return Err(PartsError::Ends);
        }
        match divided(planes, 0, [0, ends.len()]) {
            Ok(used) if used == planes.len() => {}
            Ok(plane) | Err(plane) => return Err(PartsError::Planes { plane }),
        }
        let mut plane = 0;
        while plane < planes.len() {
            if !is_within(mesh.bounds(), &planes[plane].points) {
                return Err(PartsError::Points { plane });
            }
            if let Err(triangle) = separated(mesh, ends, &planes[plane]) {
                return Err(PartsError::Side { plane, triangle });
            }
            plane += 1;
        }
        Ok(Self { ends, planes })
    }

    /// [`Parts::new`] for a `static` or a `const`, where a fault stops the compiler. For meshes of
    /// many thousand triangles the compiler warns that it takes long
    /// (`long_running_const_eval`).
    ///
    /// # Panics
    ///
    /// Panics if the parts are faulty. In a constant that is a compile error which names the
    /// fault.
    #[must_use]
    pub const fn new_const(
        mesh: &Mesh<'_>,
        ends: &'a [u32],
        planes: &'a [SeparatingPlane],
    ) -> Self {
        match Self::new(mesh, ends, planes) {
            Ok(parts) => parts,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// The number of parts.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.ends.len()
    }

    /// The triangles of a part; none of one that does not exist.
    pub(crate) fn triangles(&self, part: usize) -> core::ops::Range<usize> {
        let end = |part: usize| self.ends.get(part).map_or(0, |&end| end as usize);
        let first = part.checked_sub(1).map_or(0, end);
        first..end(part).max(first)
    }

    /// The parts from back to front, given on which side of a plane the viewer is.
    // codegen: not inlined and kept rolled, as it takes 700 bytes of 23 planes otherwise.
    #[inline(never)]
    pub(crate) fn back_to_front(
        &self,
        is_in_front: impl Fn(&SeparatingPlane) -> bool,
    ) -> [u8; MOST] {
        let (count, planes) = codegen::unknown((self.count(), self.planes));
        // A bit for each plane, the first one's lowest.
        let mut sides = 0_u32;
        for plane in planes.iter().rev() {
            keep_rolled();
            sides = sides << 1 | u32::from(is_in_front(plane));
        }
        let mut order = [0; MOST];
        for part in 0..count as u8 {
            keep_rolled();
            // How many parts are drawn before it: in a tree of planes all pairs are told apart.
            let (mut place, mut rest) = (0, sides);
            for plane in planes {
                keep_rolled();
                let [first, middle, end] = plane.ends;
                let (later, count) = if rest & 1 == 1 {
                    (first..middle, end - middle)
                } else {
                    (middle..end, middle - first)
                };
                if later.contains(&part) {
                    place += count;
                }
                rest >>= 1;
            }
            if let Some(slot) = order.get_mut(usize::from(place)) {
                *slot = part;
            }
        }
        order
    }
}

/// Checks that planes from `next` on divide parts `first..end`, and returns the place after them,
/// or that of the first which does not.
const fn divided(
    planes: &[SeparatingPlane],
    next: usize,
    [first, end]: [usize; 2],
) -> Result<usize, usize> {
    if end - first <= 1 {
        return Ok(next);
    }
    if next >= planes.len() {
        return Err(next);
    }
    let [own_first, middle, own_end] = planes[next].ends;
    let middle = middle as usize;
    let is_whole = own_first as usize == first && own_end as usize == end;
    if !is_whole || middle <= first || middle >= end {
        return Err(next);
    }
    match divided(planes, next + 1, [first, middle]) {
        Ok(next) => divided(planes, next, [middle, end]),
        Err(plane) => Err(plane),
    }
}

/// Whether points lie in a box: in clip space, numbers fit those in the box of the mesh.
const fn is_within(bounds: &BoundingBox, points: &[[i16; 3]; 3]) -> bool {
    let mut place = 0;
    while place < 9 {
        let (c, axis) = (points[place / 3][place % 3], place % 3);
        if c < bounds.min[axis] || c > bounds.max[axis] {
            return false;
        }
        place += 1;
    }
    true
}

/// Checks that triangles lie on their sides of a plane, or returns the first that does not. The
/// loops count because a `const fn` may not have `for`.
const fn separated(mesh: &Mesh<'_>, ends: &[u32], plane: &SeparatingPlane) -> Result<(), usize> {
    let [first, middle, end] = plane.ends;
    let [a, b, c] = plane.points;
    let (u, v) = (difference(b, a), difference(c, a));
    // Below 2^35 each, so that products with a difference of positions stay below 2^54.
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let mut triangle = if first == 0 { 0 } else { ends[first as usize - 1] as usize };
    if normal[0] == 0 && normal[1] == 0 && normal[2] == 0 {
        return Err(triangle);
    }
    let behind = ends[middle as usize - 1] as usize;
    while triangle < ends[end as usize - 1] as usize {
        let corners = mesh.tables.triangles.corners(triangle);
        let mut corner = 0;
        while corner < 3 {
            let to = difference(mesh.tables.positions.as_slice()[corners[corner]], a);
            let side = normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2];
            if triangle < behind && side < 0 || triangle >= behind && side > 0 {
                return Err(triangle);
            }
            corner += 1;
        }
        triangle += 1;
    }
    Ok(())
}

const fn difference(a: [i16; 3], b: [i16; 3]) -> [i64; 3] {
    [a[0] as i64 - b[0] as i64, a[1] as i64 - b[1] as i64, a[2] as i64 - b[2] as i64]
}

/// What is wrong with [`Parts`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PartsError {
    /// There is no part, or there are more than [`Parts::MOST`].
    Count,
    /// A part has no triangle, or the last one does not end with the mesh's table.
    Ends,
    /// The planes are not one fewer than the parts in the order that [`Parts::new`] says.
    Planes {
        /// The first plane at fault, from 0.
        plane: usize,
    },
    /// A point of a plane lies outside the box of the mesh.
    Points {
        /// The plane's place, from 0.
        plane: usize,
    },
    /// A triangle does not lie on its side of a plane, or the plane's points lie on a line.
    Side {
        /// The plane's place, from 0.
        plane: usize,
        /// The triangle's place in the mesh's table, from 0.
        triangle: usize,
    },
}

impl PartsError {
    /// A line that says what is wrong and what to change.
    #[must_use]
    pub const fn message(self) -> &'static str {
        match self {
            Self::Count => "a mesh must have 1 to 32 parts",
            Self::Ends => "the ends of parts must rise, up to the number of triangles",
            Self::Planes { .. } => {
                "planes must divide all parts, then those in front, then those behind"
            }
            Self::Points { .. } => "the points of a plane must lie in the box of the mesh",
            Self::Side { .. } => "a triangle lies on the wrong side of a plane, or across it",
        }
    }
}

impl core::fmt::Display for PartsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.message())?;
        match self {
            Self::Planes { plane } | Self::Points { plane } => write!(f, " (plane {plane})"),
            Self::Side { plane, triangle } => write!(f, " (plane {plane}, triangle {triangle})"),
            Self::Count | Self::Ends => Ok(()),
        }
    }
}

impl core::error::Error for PartsError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Material, Positions, Tables, Triangles};

    /// Four triangles that face +x, at x = 0, 10, 20 and 30.
    static MESH: Mesh<'static> = Mesh::new_const(Tables {
        positions: Positions::I16(&[
            [0, 0, 0],
            [0, 9, 0],
            [0, 0, 9],
            [10, 0, 0],
            [10, 9, 0],
            [10, 0, 9],
            [20, 0, 0],
            [20, 9, 0],
            [20, 0, 9],
            [30, 0, 0],
            [30, 9, 0],
            [30, 0, 9],
        ]),
        triangles: Triangles::U8(&[[9, 10, 11], [6, 7, 8], [3, 4, 5], [0, 1, 2]]),
        materials: &[Material::new([255; 3], 4)],
        ..Tables::EMPTY
    });

    /// The plane at some x, seen from greater ones.
    const fn at(x: i16, ends: [u8; 3]) -> SeparatingPlane {
        SeparatingPlane::new([[x, 0, 0], [x, 9, 0], [x, 0, 9]], ends)
    }

    const PLANES: [SeparatingPlane; 3] = [at(15, [0, 2, 4]), at(20, [0, 1, 2]), at(10, [2, 3, 4])];
    static PARTS: Parts<'static> = Parts::new_const(&MESH, &[1, 2, 3, 4], &PLANES);

    #[test]
    fn parts_are_drawn_towards_the_viewer() {
        let from = |x: i16| PARTS.back_to_front(|plane| x > plane.points()[0][0]);
        for (x, want) in
            [(40, [3, 2, 1, 0]), (18, [3, 2, 0, 1]), (12, [0, 1, 3, 2]), (5, [0, 1, 2, 3])]
        {
            assert_eq!(from(x)[..4], want, "from {x}");
        }
        let ends: std::vec::Vec<_> = (0..5).map(|part| PARTS.triangles(part)).collect();
        assert_eq!(ends[..4], [0..1, 1..2, 2..3, 3..4]);
        assert!(ends[4].is_empty());
    }

    #[test]
    fn each_fault_is_named() {
        let fault = |ends: &[u32], planes: &[SeparatingPlane]| {
            Parts::new(&MESH, ends, planes).map(|_| ()).unwrap_err()
        };
        assert_eq!(Parts::new(&MESH, &[4], &[]).map(|parts| parts.count()), Ok(1));
        assert_eq!(fault(&[], &[]), PartsError::Count);
        assert_eq!(fault(&[1; 33], &[]), PartsError::Count);
        for wrong in [&[1, 1, 3, 4][..], &[0, 1, 2, 4], &[1, 2, 3, 5], &[1, 2, 3]] {
            assert_eq!(fault(wrong, &PLANES), PartsError::Ends, "{wrong:?}");
        }
        // Too few, too many, in another order, without parts on a side, of parts elsewhere.
        let [all, front, back] = PLANES;
        let of = |planes: &[SeparatingPlane]| fault(&[1, 2, 3, 4], planes);
        assert_eq!(of(&[]), PartsError::Planes { plane: 0 });
        assert_eq!(of(&[all, front]), PartsError::Planes { plane: 2 });
        assert_eq!(of(&[all, front, back, back]), PartsError::Planes { plane: 3 });
        assert_eq!(of(&[all, back, front]), PartsError::Planes { plane: 1 });
        assert_eq!(of(&[at(15, [0, 4, 4]), front, back]), PartsError::Planes { plane: 0 });
        assert_eq!(of(&[at(15, [0, 2, 3]), front, back]), PartsError::Planes { plane: 0 });
        // A plane may touch what it separates, on both sides.
        let sides = |x, want| {
            let planes = [at(x, [0, 2, 4]), front, back];
            assert_eq!(Parts::new(&MESH, &[1, 2, 3, 4], &planes).map(|_| ()), want, "{x}");
        };
        for x in 10..=20 {
            sides(x, Ok(()));
        }
        sides(21, Err(PartsError::Side { plane: 0, triangle: 1 }));
        sides(9, Err(PartsError::Side { plane: 0, triangle: 2 }));
        for outside in [[15, -1, 0], [15, 0, 10], [31, 0, 0]] {
            let plane = SeparatingPlane::new([[15, 0, 0], outside, [15, 0, 9]], all.ends);
            assert_eq!(of(&[plane, front, back]), PartsError::Points { plane: 0 });
        }
        let line = SeparatingPlane::new([[15, 0, 0], [15, 1, 0], [15, 2, 0]], [0, 2, 4]);
        let side = PartsError::Side { plane: 0, triangle: 0 };
        assert_eq!(of(&[line, front, back]), side);
        assert!(std::format!("{side}").ends_with("(plane 0, triangle 0)"));
    }
}
