//! Polygons in space: their plane, and triangles that fill them.
//!
//! Ears are cut off by the definition (Meisters, "Polygons have ears", American Mathematical
//! Monthly 82(6), 1975): a corner is an ear if it is convex and no other corner lies in its
//! triangle. Each cut takes one triangle from the polygon, and together they have its outline. If
//! all of them have the polygon's winding, they cover what the outline encloses, and nothing twice.

use super::camera::{cross, dot, subtract};

/// A polygon's mean plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Twice the area, along the normal, which points toward a viewer who sees the corners
    /// counter-clockwise (Newell's sum; Sutherland et al., "A characterization of ten
    /// hidden-surface algorithms", Computing Surveys 6(1), 1974).
    pub area: [f64; 3],
    /// The mean of the corners, which lies in the plane.
    pub middle: [f64; 3],
    /// How far the farthest corner lies off the plane.
    pub deviation: f64,
}

impl Plane {
    /// The mean plane of a ring of corners, at least one.
    #[must_use]
    pub fn of(ring: &[[f64; 3]]) -> Self {
        let relative = |i: usize| subtract(ring[i % ring.len()], ring[0]);
        let mut area = [0.0; 3];
        let mut sum = [0.0; 3];
        for i in 0..ring.len() {
            let product = cross(relative(i), relative(i + 1));
            area = [0, 1, 2].map(|axis| area[axis] + product[axis]);
            sum = [0, 1, 2].map(|axis| sum[axis] + relative(i)[axis]);
        }
        let count = ring.len() as f64;
        let middle = [0, 1, 2].map(|axis| ring[0][axis] + sum[axis] / count);
        let plane = Self { area, middle, deviation: 0.0 };
        let deviation = plane.normal().map_or(0.0, |normal| {
            ring.iter().map(|&p| dot(normal, subtract(p, middle)).abs()).fold(0.0, f64::max)
        });
        // Three points lie in their plane.
        Self { deviation: if ring.len() > 3 { deviation } else { 0.0 }, ..plane }
    }

    /// The unit normal; `None` of a polygon without area.
    #[must_use]
    pub fn normal(&self) -> Option<[f64; 3]> {
        let length = dot(self.area, self.area).sqrt();
        (length > 0.0).then(|| self.area.map(|c| c / length))
    }
}

/// Three indices into the ring for each triangle of a polygon, in the polygon's winding; two fewer
/// than it has corners. `None` if the polygon crosses itself, seen along its normal.
///
/// Corners on a straight side stay corners of triangles; a polygon without area gets triangles
/// without area.
#[must_use]
pub fn triangulate(ring: &[[f64; 3]], plane: &Plane) -> Option<Vec<[usize; 3]>> {
    let fan = || (2..ring.len()).map(|i| [0, i - 1, i]).collect();
    if ring.len() <= 3 {
        return Some(fan());
    }
    let Some(normal) = plane.normal() else { return Some(fan()) };
    let flat = flatten(ring, plane.middle, normal);
    let reach = flat.as_flattened().iter().fold(0f64, |m, c| m.max(c.abs()));
    // Coordinates up to `reach`, each rounded a few times, make an error of some 10 roundings in an
    // area; and a polygon whose area is no more than that has none.
    let noise = 1e-14 * reach * reach;
    let doubled = dot(plane.area, plane.area).sqrt();
    if doubled <= noise * ring.len() as f64 {
        return Some(fan());
    }
    cut_ears(&flat, noise)
}

/// The corners in the plane, seen from the front.
fn flatten(ring: &[[f64; 3]], middle: [f64; 3], normal: [f64; 3]) -> Vec<[f64; 2]> {
    let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let right = cross(axis, normal);
    let length = dot(right, right).sqrt();
    let right = right.map(|c| c / length);
    let up = cross(normal, right);
    let place = |&p: &[f64; 3]| [right, up].map(|axis| dot(axis, subtract(p, middle)));
    ring.iter().map(place).collect()
}

/// Twice the area of a triangle, positive if it is counter-clockwise.
fn doubled_area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Cuts ears off until three corners are left. `noise` is the area of rounding.
fn cut_ears(points: &[[f64; 2]], noise: f64) -> Option<Vec<[usize; 3]>> {
    let count = points.len();
    let mut next: Vec<usize> = (1..count).chain([0]).collect();
    let mut previous: Vec<usize> = (count - 1..count).chain(0..count - 1).collect();
    let area = |[a, b, c]: [usize; 3]| doubled_area(points[a], points[b], points[c]);
    // Only these can lie in the triangle of an ear. A corner that is convex stays so.
    let is_hollow = |corner| area(corner) <= noise;
    let mut hollow: Vec<bool> = (0..count).map(|i| is_hollow([previous[i], i, next[i]])).collect();
    let mut from_left: Vec<usize> = (0..count).filter(|&i| hollow[i]).collect();
    from_left.sort_by(|&a, &b| points[a][0].total_cmp(&points[b][0]));
    let mut triangles = Vec::with_capacity(count - 2);
    let (mut corner, mut left, mut failures) = (0, count, 0);
    while left > 2 {
        let ear = [previous[corner], corner, next[corner]];
        let is_convex = area(ear) > noise;
        // Where no ear is left, a corner on a straight side goes: its triangle has no area.
        let is_straight = failures >= left && area(ear).abs() <= noise;
        if (is_convex && is_empty(points, ear, &from_left, &hollow)) || is_straight {
            triangles.push(ear);
            let [before, _, after] = ear;
            (next[before], previous[after]) = (after, before);
            hollow[corner] = false;
            for i in [before, after] {
                hollow[i] = hollow[i] && is_hollow([previous[i], i, next[i]]);
            }
            left -= 1;
            failures = 0;
            corner = after;
        } else {
            failures += 1;
            corner = next[corner];
        }
        if failures > 2 * left {
            return None;
        }
    }
    Some(triangles)
}

/// Whether no hollow corner lies in the triangle of an ear or on its sides. Those at its own
/// corners, as where a polygon touches itself, do not count. `from_left` are the corners that were
/// hollow at first, in the order of their x.
fn is_empty(points: &[[f64; 2]], ear: [usize; 3], from_left: &[usize], hollow: &[bool]) -> bool {
    let [a, b, c] = ear.map(|i| points[i]);
    let (left, right) = (a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0]));
    let first = from_left.partition_point(|&i| points[i][0] < left);
    let beside = from_left[first..].iter().take_while(|&&i| points[i][0] <= right);
    !beside.filter(|&&i| hollow[i]).any(|&i| {
        let p = points[i];
        ![a, b, c].contains(&p)
            && doubled_area(a, b, p) >= 0.0
            && doubled_area(b, c, p) >= 0.0
            && doubled_area(c, a, p) >= 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    fn cut(ring: &[[f64; 3]]) -> Option<Vec<[usize; 3]>> {
        triangulate(ring, &Plane::of(ring))
    }

    /// Checks that the triangles have the polygon's outline and its winding, from which follows
    /// that they cover what it encloses, once. Returns them.
    fn check(ring: &[[f64; 3]]) -> Vec<[usize; 3]> {
        let plane = Plane::of(ring);
        let triangles = cut(ring).unwrap_or_else(|| panic!("{ring:?}"));
        assert_eq!(triangles.len(), ring.len() - 2);
        let mut sides: Vec<[usize; 2]> =
            (0..ring.len()).map(|i| [i, (i + 1) % ring.len()]).collect();
        for &[a, b, c] in &triangles {
            sides.extend([[b, a], [c, b], [a, c]]);
            let area = Plane::of(&[ring[a], ring[b], ring[c]]).area;
            let noise = 1e-13 * ring.as_flattened().iter().fold(1f64, |m, x| m.max(x * x));
            assert!(dot(area, plane.normal().unwrap()) >= -noise, "{a} {b} {c} of {ring:?}");
        }
        // Each side of a triangle is one of the polygon, or of another triangle in the other
        // direction.
        while let Some([from, to]) = sides.pop() {
            let other = sides.iter().position(|&side| side == [to, from]);
            sides.swap_remove(other.unwrap_or_else(|| panic!("{from} to {to} of {ring:?}")));
        }
        triangles
    }

    /// The polygon on planes of all directions, with both windings.
    fn on_planes(flat: &[[f64; 2]]) -> Vec<Vec<[f64; 3]>> {
        let place = |plane, &[x, y]: &[f64; 2]| match plane {
            0 => [x, y, 0.5],
            1 => [y, x, 0.5],
            2 => [0.5, x, y],
            3 => [y, 0.5, x],
            _ => [x - y, x + y, 0.3 * x],
        };
        (0..5).map(|plane| flat.iter().map(|p| place(plane, p)).collect()).collect()
    }

    #[test]
    fn concave_polygons_are_filled_on_any_plane_from_any_corner() {
        // An L; a comb whose teeth touch one line; a square with a hole, along a bridge; straight
        // corners on slanted sides.
        let shapes: [&[[f64; 2]]; 4] = [
            &[[1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]],
            &[
                [0.0, 0.0],
                [5.0, 0.0],
                [5.0, 2.0],
                [4.0, 1.0],
                [3.0, 2.0],
                [2.0, 1.0],
                [1.0, 2.0],
                [0.0, 1.0],
            ],
            &[
                [0.0, 0.0],
                [4.0, 0.0],
                [4.0, 4.0],
                [0.0, 4.0],
                [0.0, 0.0],
                [1.0, 1.0],
                [1.0, 3.0],
                [3.0, 3.0],
                [3.0, 1.0],
                [1.0, 1.0],
            ],
            &[[0.0, 0.0], [0.3, 0.1], [0.6, 0.2], [0.9, 0.3], [0.5, 0.9], [0.1, 0.5]],
        ];
        for shape in shapes {
            for mut ring in on_planes(shape) {
                for _ in 0..ring.len() {
                    check(&ring);
                    ring.rotate_left(1);
                }
            }
        }
    }

    #[test]
    fn random_stars_are_filled_though_not_flat() {
        let mut random = Random(21);
        for corners in [4, 5, 7, 12, 100] {
            for _ in 0..200 {
                let ring: Vec<[f64; 3]> = (0..corners)
                    .map(|i| {
                        let angle = f64::from(i) * std::f64::consts::TAU / f64::from(corners);
                        let radius = random.real(0.3, 1.0);
                        let (sin, cos) = angle.sin_cos();
                        [radius * cos, radius * sin, random.real(-0.02, 0.02)]
                    })
                    .collect();
                let plane = Plane::of(&ring);
                assert!(plane.deviation > 0.0 && plane.deviation < 0.2, "{plane:?}");
                check(&ring);
            }
        }
    }

    #[test]
    fn a_polygon_that_crosses_itself_has_no_triangles() {
        let eight = [[0.0, 0.0], [2.0, 1.0], [2.0, 0.0], [0.0, 1.5]];
        let knot = [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [1.0, -1.0], [0.0, 2.0]];
        for ring in [on_planes(&eight), on_planes(&knot)].concat() {
            assert_eq!(cut(&ring), None, "{ring:?}");
        }
    }

    #[test]
    fn polygons_without_area_keep_their_outline() {
        let line = [[0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.3, 0.6, 0.9], [0.7, 1.4, 2.1]];
        assert_eq!(cut(&line), Some(vec![[0, 1, 2], [0, 2, 3]]));
        assert_eq!(cut(&[[1.0; 3]; 5]).map(|triangles| triangles.len()), Some(3));
        assert_eq!(Plane::of(&[[1.0; 3]; 4]).normal(), None);
    }

    #[test]
    fn the_mean_plane_has_its_normal_and_its_deviation() {
        // A square whose corners lie 0.1 above and below the plane z = 5 in turn.
        let ring = [[0.0, 0.0, 5.1], [2.0, 0.0, 4.9], [2.0, 2.0, 5.1], [0.0, 2.0, 4.9]];
        let plane = Plane::of(&ring);
        let close = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12);
        assert!(close(plane.area, [0.0, 0.0, 8.0]), "{plane:?}");
        assert!(close(plane.middle, [1.0, 1.0, 5.0]), "{plane:?}");
        assert!((plane.deviation - 0.1).abs() < 1e-12, "{plane:?}");
        assert_eq!(Plane::of(&ring[..3]).deviation, 0.0);
    }

    #[test]
    fn large_polygons_are_cut_soon() {
        // A circle whose corners are rounded by more than they bulge, so that half of them are
        // hollow; and a star, where every other corner is.
        let circle = |count: u32, radius: fn(u32) -> f64, digits: f64| -> Vec<[f64; 3]> {
            (0..count)
                .map(|i| {
                    let angle = f64::from(i) * std::f64::consts::TAU / f64::from(count);
                    let place = |c: f64| (c * radius(i) * digits).round() / digits;
                    [place(angle.cos()), place(angle.sin()), 0.0]
                })
                .collect()
        };
        let start = std::time::Instant::now();
        assert_eq!(cut(&circle(60_000, |_| 1.0, 1e8)).map(|t| t.len()), Some(59_998));
        let star = circle(10_000, |i| 1.0 - 0.3 * f64::from(i % 2), 1e15);
        assert_eq!(cut(&star).map(|t| t.len()), Some(9_998));
        assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
    }
}
