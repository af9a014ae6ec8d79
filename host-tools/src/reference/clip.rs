//! Clipping of polygons against the near and the far plane, in view space before the projection,
//! and against planes of the user's, in world space before that.
//!
//! Clip coordinates are linear in view coordinates, so clipping here is homogeneous clipping: the
//! rest has w > 0 and can be divided. The four sides of the screen need no clipping: f64 holds the
//! coordinates of any triangle, and the loop over pixels is confined to the picture.

/// A corner of a polygon on its way from view space to the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ViewVertex<const N: usize> {
    /// Position in view space; visible points have a negative z.
    pub position: [f64; 3],
    /// Linear along straight lines in view space.
    pub varyings: [f64; N],
}

/// The part of a convex polygon between the distances `near` and `far` along the view axis, in the
/// same winding. It has fewer than three vertices if no area is left, and at most two more than
/// the polygon.
///
/// Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974: one plane after the
/// other.
pub(super) fn clip<const N: usize>(
    polygon: &[ViewVertex<N>],
    [near, far]: [f64; 2],
) -> Vec<ViewVertex<N>> {
    let beyond_near = clip_at(polygon, -near, -1.0);
    clip_at(&beyond_near, -far, 1.0)
}

/// A side of a plane, with the plane itself: the points p with `normal` . p + `offset` >= 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Points to the side, in any length.
    pub normal: [f64; 3],
    /// For the origin.
    pub offset: f64,
}

impl HalfSpace {
    /// How far inside a point lies, in lengths of the normal; negative outside.
    #[must_use]
    pub fn depth(&self, point: [f64; 3]) -> f64 {
        self.offset + (0..3).map(|i| self.normal[i] * point[i]).sum::<f64>()
    }

    /// The half space whose plane lies farther outside, by a number of lengths of the normal.
    #[must_use]
    pub fn widened(self, by: f64) -> Self {
        Self { offset: self.offset + by, ..self }
    }

    /// The other side of the plane.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self { normal: self.normal.map(|c| -c), offset: -self.offset }
    }
}

/// The part of a convex polygon, whose positions are in world space, inside all half spaces, in the
/// same winding.
pub(super) fn clip_by<const N: usize>(
    polygon: &[ViewVertex<N>],
    sides: &[HalfSpace],
) -> Vec<ViewVertex<N>> {
    sides.iter().fold(polygon.to_vec(), |polygon, side| {
        clip_where(&polygon, |vertex| side.depth(vertex.position), |_| {})
    })
}

/// The part of a segment inside all half spaces: how far along it starts and ends, from 0 to 1; or
/// `None` if nothing is inside. A plane belongs to its half space.
///
/// Liang and Barsky, "A new concept and method for line clipping", ACM Transactions on Graphics
/// 3(1), 1984: each plane moves the start or the end, and what is left lies between them.
#[must_use]
pub fn part_inside(
    [from, to]: [[f64; 3]; 2],
    sides: impl IntoIterator<Item = HalfSpace>,
) -> Option<[f64; 2]> {
    let [mut start, mut end] = [0f64, 1.0];
    for side in sides {
        let [a, b] = [side.depth(from), side.depth(to)];
        match [a, b].map(|depth| depth < 0.0) {
            [false, false] => {}
            [true, true] => return None,
            [true, false] => start = start.max(a / (a - b)),
            [false, true] => end = end.min(a / (a - b)),
        }
    }
    (start <= end).then_some([start, end])
}

/// The part of a ring of corners inside all half spaces, in the same winding. Parts of one that is
/// not convex are joined by lines along the planes, there and back. Rings that share an edge share
/// the new corners on it, bit for bit.
#[must_use]
pub fn clip_ring(ring: &[[f64; 3]], sides: &[HalfSpace]) -> Vec<[f64; 3]> {
    let vertex = |&position: &[f64; 3]| ViewVertex { position, varyings: [] };
    let ring: Vec<_> = ring.iter().map(vertex).collect();
    clip_by(&ring, sides).iter().map(|vertex| vertex.position).collect()
}

/// The part of a convex polygon on one side of the plane `z = plane`: towards +z for `side = 1`,
/// towards -z for -1. The plane itself belongs to the part that is kept. A new vertex gets the
/// plane's own z, not a rounded blend: with a near plane much closer than the rounding of the two
/// ends, a blend lies behind the eye.
fn clip_at<const N: usize>(polygon: &[ViewVertex<N>], plane: f64, side: f64) -> Vec<ViewVertex<N>> {
    let inside_by = |vertex: &ViewVertex<N>| side * (vertex.position[2] - plane);
    clip_where(polygon, inside_by, |vertex| vertex.position[2] = plane)
}

/// The part of a convex polygon where a linear function of the position is not negative. `settle`
/// moves a new vertex to where the function is 0.
fn clip_where<const N: usize>(
    polygon: &[ViewVertex<N>],
    inside_by: impl Fn(&ViewVertex<N>) -> f64,
    settle: impl Fn(&mut ViewVertex<N>),
) -> Vec<ViewVertex<N>> {
    let crossing = |inner: &ViewVertex<N>, outer: &ViewVertex<N>, t: f64| {
        let mut vertex = crossing(inner, outer, t);
        settle(&mut vertex);
        vertex
    };
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, from) in polygon.iter().enumerate() {
        let to = &polygon[(i + 1) % polygon.len()];
        let (from_by, to_by) = (inside_by(from), inside_by(to));
        if from_by >= 0.0 {
            kept.push(*from);
        }
        // Always computed from the inner to the outer end, so that two triangles that run along a
        // shared edge in opposite directions get the same new vertex, bit for bit, and stay
        // watertight.
        if from_by > 0.0 && to_by < 0.0 {
            kept.push(crossing(from, to, from_by / (from_by - to_by)));
        } else if from_by < 0.0 && to_by > 0.0 {
            kept.push(crossing(to, from, to_by / (to_by - from_by)));
        }
    }
    kept
}

/// The point at the fraction `t` of the way from `inner` to `outer`.
fn crossing<const N: usize>(inner: &ViewVertex<N>, outer: &ViewVertex<N>, t: f64) -> ViewVertex<N> {
    let blend = |a: f64, b: f64| a + t * (b - a);
    ViewVertex {
        position: std::array::from_fn(|i| blend(inner.position[i], outer.position[i])),
        varyings: std::array::from_fn(|i| blend(inner.varyings[i], outer.varyings[i])),
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    fn vertex(x: f64, y: f64, z: f64, varying: f64) -> ViewVertex<2> {
        ViewVertex { position: [x, y, z], varyings: [varying, -2.0 * varying] }
    }

    /// A right triangle in the plane x = 3 with legs of 4 along -z (distances 1 to 5) and 4 along
    /// y; the first varying is the distance, the second -2 times that.
    fn triangle() -> [ViewVertex<2>; 3] {
        [vertex(3.0, 0.0, -1.0, 1.0), vertex(3.0, 0.0, -5.0, 5.0), vertex(3.0, 4.0, -1.0, 1.0)]
    }

    /// Area in the (z, y) plane, positive in the winding of `triangle`.
    fn area(polygon: &[ViewVertex<2>]) -> f64 {
        let next = polygon.iter().cycle().skip(1);
        let doubled: f64 = polygon
            .iter()
            .zip(next)
            .map(|(a, b)| a.position[1] * b.position[2] - b.position[1] * a.position[2])
            .sum();
        doubled / 2.0
    }

    #[test]
    fn a_polygon_between_the_planes_is_unchanged() {
        assert_eq!(clip(&triangle(), [0.5, 6.0]), triangle());
        assert_eq!(clip(&triangle(), [1.0, 5.0]), triangle(), "the planes themselves are inside");
    }

    #[test]
    fn a_segment_keeps_the_part_inside_all_half_spaces() {
        let segment = [[0.0, 0.0, -1.0], [8.0, 0.0, -5.0]];
        let side = |normal, offset| HalfSpace { normal, offset };
        // From a distance of 2 on, up to x = 6, above y = 0.
        let (beyond, left) = (side([0.0, 0.0, -1.0], -2.0), side([-1.0, 0.0, 0.0], 6.0));
        let above = side([0.0, 1.0, 0.0], 0.0);
        assert_eq!(part_inside(segment, []), Some([0.0, 1.0]));
        assert_eq!(part_inside(segment, [beyond, left, above]), Some([0.25, 0.75]));
        assert_eq!(part_inside(segment, [left.flipped(), beyond]), Some([0.75, 1.0]));
        assert_eq!(part_inside(segment, [above.widened(-1.0)]), None);
        // Each plane leaves a part, and both together leave none.
        assert_eq!(part_inside(segment, [beyond.flipped(), side([1.0, 0.0, 0.0], -3.0)]), None);
        // A point is a segment without a length.
        assert_eq!(part_inside([segment[1]; 2], [beyond]), Some([0.0, 1.0]));
        assert_eq!(part_inside([segment[1]; 2], [left]), None);
    }

    #[test]
    fn a_polygon_outside_vanishes() {
        assert!(clip(&triangle(), [5.5, 9.0]).is_empty());
        assert!(clip(&triangle(), [0.1, 0.5]).is_empty());
        assert!(clip::<2>(&[], [1.0, 2.0]).is_empty());
    }

    #[test]
    fn the_rest_has_the_area_of_the_closed_form() {
        // The triangle is 5 - d high at the distance d, so the part between two distances is a
        // trapezium.
        for [near, far] in [[2.0, 9.0], [0.5, 3.0], [2.0, 3.0], [1.25, 4.75]] {
            let (from, to) = (f64::max(near, 1.0), f64::min(far, 5.0));
            let expected = (to - from) * ((5.0 - from) + (5.0 - to)) / 2.0;
            for rotation in 0..3 {
                let mut polygon = triangle();
                polygon.rotate_left(rotation);
                let clipped = clip(&polygon, [near, far]);
                // Rounding: a dozen operations on numbers below 32.
                assert!(
                    (area(&clipped) - expected).abs() < 1e-13,
                    "{near} to {far}: {}",
                    area(&clipped)
                );
                for corner in clipped {
                    let distance = -corner.position[2];
                    assert!((corner.varyings[0] - distance).abs() < 1e-13);
                    assert!((corner.varyings[1] + 2.0 * distance).abs() < 1e-13);
                    assert_eq!(corner.position[0], 3.0);
                }
            }
        }
    }

    #[test]
    fn neighbours_share_the_new_vertices_bit_for_bit() {
        let mut random = Random(12);
        for _ in 0..100 {
            let mut corner = |z: f64| {
                vertex(random.real(-9.0, 9.0), random.real(-9.0, 9.0), z, random.real(0.0, 1.0))
            };
            // The edge ab crosses both planes; the triangles run along it in opposite directions.
            let (a, b, c, d) = (corner(-0.3), corner(-7.7), corner(-2.9), corner(-9.1));
            let one = clip(&[a, b, c], [1.1, 5.3]);
            let other = clip(&[b, a, d], [1.1, 5.3]);
            let shared: Vec<_> = one.iter().filter(|corner| other.contains(corner)).collect();
            assert_eq!(shared.len(), 2, "{one:?} {other:?}");
        }
    }

    #[test]
    fn a_vertex_on_a_plane_is_kept_once() {
        let (inside, on, outside) =
            (vertex(1.0, 0.0, -2.0, 0.0), vertex(0.0, 1.0, -1.0, 0.0), vertex(0.0, 0.0, 0.0, 0.0));
        let middle = vertex(0.5, 0.0, -1.0, 0.0);
        assert_eq!(clip(&[inside, on, outside], [1.0, 9.0]), [inside, on, middle]);
        assert_eq!(clip(&[on, inside, outside], [1.0, 9.0]), [on, inside, middle]);
        assert_eq!(clip(&[outside, on, outside], [1.0, 9.0]), [on]);
    }

    #[test]
    fn a_tiny_near_distance_leaves_no_point_behind_the_eye() {
        let polygon = [
            vertex(0.0, 0.0, -100.0, 0.0),
            vertex(1.0, 0.0, 300.0, 0.0),
            vertex(0.0, 1.0, -100.0, 0.0),
        ];
        let clipped = clip(&polygon, [1e-20, 1e3]);
        assert_eq!(clipped.len(), 4);
        assert!(clipped.iter().all(|corner| corner.position[2] <= -1e-20));
    }
}
