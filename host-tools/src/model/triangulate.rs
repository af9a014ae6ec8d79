//! Polygons into triangles.

use super::{
    ears::{EarClipper, Point},
    polygons::{Corner, Face, Polygons},
    slivers,
    smoothing::Smoothing,
    vector::{Vector, add, cross, largest, length, sub},
};

/// A triangle, counter-clockwise when seen from its front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Triangle {
    /// Its corners.
    pub corners: [Corner; 3],
    /// Its material.
    pub material: usize,
    /// Its smoothing group.
    pub smoothing: Smoothing,
}

/// Cuts all polygons into triangles, also concave ones, and drops what has no area. Also returns
/// how many triangles that is.
///
/// Each side of a polygon is a side of one triangle. So no corner is lost, and neighbours that
/// share a side share its vertices.
///
/// `shapes` are the positions of the polygons, scaled so that no coordinate exceeds 2, in each of
/// the files of an animation. A polygon is cut as in the first of them in which it has an area.
pub(super) fn triangulate(
    polygons: &Polygons,
    shapes: &[impl AsRef<[Vector]>],
) -> (Vec<Triangle>, usize) {
    let mut cutters: Vec<Cutter<'_>> =
        shapes.iter().map(|positions| Cutter::new(positions.as_ref())).collect();
    let mut triangles = Vec::new();
    let mut whole = 0;
    let mut start = 0;
    for &Face { arity, material, smoothing } in &polygons.faces {
        let corners = &polygons.corners[start..start + arity];
        start += arity;
        whole += arity - 2;
        let to_triangle = |corners| Triangle { corners, material, smoothing };
        if let &[a, b, c] = corners {
            let area = |cutter: &Cutter<'_>| {
                has_area([a, b, c].map(|c| cutter.positions[c.position as usize]))
            };
            if cutters.iter().any(area) {
                triangles.push(to_triangle([a, b, c]));
            }
        } else {
            let before = triangles.len();
            for cutter in &mut cutters {
                let cut = cutter.cut(corners);
                triangles.extend(cut.map(|t| to_triangle(t.map(|i| corners[i as usize]))));
                if triangles.len() > before {
                    break;
                }
            }
        }
    }
    let dropped = whole - triangles.len();
    (triangles, dropped)
}

/// Cuts polygons of more than three corners. Keeps its memory from one to the next.
struct Cutter<'a> {
    positions: &'a [Vector],
    clipper: EarClipper,
    loops: Loops,
    /// Whether a triangle of this polygon has the position.
    is_used: Vec<bool>,
    triangles: Vec<[u32; 3]>,
}

impl<'a> Cutter<'a> {
    fn new(positions: &'a [Vector]) -> Self {
        Self {
            positions,
            clipper: EarClipper::default(),
            loops: Loops::new(positions.len()),
            is_used: vec![false; positions.len()],
            triangles: Vec::new(),
        }
    }

    /// The triangles of a polygon as numbers of its corners; none if all of it has no area.
    fn cut(&mut self, corners: &[Corner]) -> impl Iterator<Item = [u32; 3]> + use<'_, 'a> {
        let names: Vec<u32> = corners.iter().map(|corner| corner.position).collect();
        let ring: Vec<Vector> = names.iter().map(|&name| self.positions[name as usize]).collect();
        let flat = flattened(&ring);
        // A corner where the one before it is adds nothing.
        let n = ring.len();
        let distinct =
            (0..n as u32).filter(|&i| ring[i as usize] != ring[(i as usize + n - 1) % n]);
        let distinct: Vec<u32> = distinct.collect();
        self.triangles.clear();
        for numbers in self.loops.split(&distinct, &flat, &names) {
            let points: Vec<Point> = numbers.iter().map(|&i| flat[i as usize]).collect();
            let first = self.triangles.len();
            self.clipper.clip(&points, &mut self.triangles);
            slivers::flip(&points, &mut self.triangles[first..]);
            for triangle in &mut self.triangles[first..] {
                *triangle = triangle.map(|i| numbers[i as usize]);
            }
        }
        self.drop_without_area(&ring, &names);
        self.triangles.drain(..)
    }

    /// Drops all triangles if none has an area. Otherwise one without area stays if it joins three
    /// different positions, or has one that no other triangle has.
    fn drop_without_area(&mut self, ring: &[Vector], names: &[u32]) {
        let has_area = |t: &[u32; 3]| has_area(t.map(|i| ring[i as usize]));
        if self.triangles.iter().all(has_area) {
            return;
        }
        if !self.triangles.iter().any(has_area) {
            self.triangles.clear();
            return;
        }
        let joins_three = |&[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|i| names[i as usize]);
            a != b && b != c && c != a
        };
        for triangle in self.triangles.iter().filter(|t| joins_three(t)) {
            triangle.iter().for_each(|&i| self.is_used[names[i as usize] as usize] = true);
        }
        let is_used = &mut self.is_used;
        self.triangles.retain(|triangle| {
            let adds = triangle
                .map(|i| !std::mem::replace(&mut is_used[names[i as usize] as usize], true))
                .contains(&true);
            adds || joins_three(triangle)
        });
        names.iter().for_each(|&name| is_used[name as usize] = false);
    }
}

/// Splits polygons that visit a position several times.
struct Loops {
    /// Where each position is on the path; `usize::MAX` for all of them between two polygons.
    place: Vec<usize>,
}

impl Loops {
    fn new(positions: usize) -> Self {
        Self { place: vec![usize::MAX; positions] }
    }

    /// Splits off each part of a polygon that runs from a position back to it counter-clockwise;
    /// returns the numbers of its corners. A part that runs clockwise is a hole: it stays together
    /// with what is round it, and so does a part with the cut to a hole in it.
    fn split(&mut self, corners: &[u32], points: &[Point], names: &[u32]) -> Vec<Vec<u32>> {
        let mut parts = Vec::new();
        // The corners so far, each with twice the area that the path to it sweeps about the first.
        let mut path: Vec<(u32, f64)> = Vec::with_capacity(corners.len());
        let relative = |i: u32| {
            let [origin, point] = [points[0], points[i as usize]];
            [point[0] - origin[0], point[1] - origin[1]]
        };
        let swept = |from: u32, to: u32| {
            let [a, b] = [relative(from), relative(to)];
            a[0] * b[1] - a[1] * b[0]
        };
        for (index, &corner) in corners.iter().enumerate() {
            let name = names[corner as usize] as usize;
            let area = path.last().map_or(0.0, |&(last, area)| area + swept(last, corner));
            let first = self.place[name];
            let before = |place: usize| {
                place.checked_sub(1).map_or(corners[corners.len() - 1], |i| path[i].0)
            };
            let is_split = first != usize::MAX && area > path[first].1 && {
                let after = corners[(index + 1) % corners.len()];
                let wedge =
                    [path[first + 1].0, corner, before(path.len())].map(|i| points[i as usize]);
                ![before(first), after].iter().any(|&i| is_in_wedge(points[i as usize], wedge))
            };
            if is_split {
                // The part closes where it began.
                let part: Vec<u32> = path[first..].iter().map(|&(i, _)| i).collect();
                path.truncate(first + 1);
                part[1..].iter().for_each(|&i| self.place[names[i as usize] as usize] = usize::MAX);
                parts.push(part);
                continue;
            }
            self.place[name] = path.len();
            path.push((corner, area));
        }
        names.iter().for_each(|&name| self.place[name as usize] = usize::MAX);
        if path.len() >= 3 {
            parts.push(path.into_iter().map(|(i, _)| i).collect());
        }
        parts
    }
}

/// Whether a point is seen from `apex` to the left of `right` and to the right of `left`.
fn is_in_wedge(point: Point, [right, apex, left]: [Point; 3]) -> bool {
    let is_left = |from: Point, to: Point| {
        let [a, b] = [from, to].map(|p| [p[0] - apex[0], p[1] - apex[1]]);
        a[0] * b[1] - a[1] * b[0] > 0.0
    };
    let (one, other) = (is_left(right, point), is_left(point, left));
    if is_left(right, left) { one && other } else { one || other }
}

/// Projects the polygon along the axis nearest to its normal, counter-clockwise. Dropping a
/// coordinate, rather than turning the plane, keeps the other two exact.
fn flattened(ring: &[Vector]) -> Vec<Point> {
    let n = newell_normal(ring).map(f64::abs);
    let axis = if n[0] > n[1] && n[0] > n[2] {
        0
    } else if n[1] > n[2] {
        1
    } else {
        2
    };
    let (u, v) = if newell_normal(ring)[axis] < 0.0 {
        ((axis + 2) % 3, (axis + 1) % 3)
    } else {
        ((axis + 1) % 3, (axis + 2) % 3)
    };
    ring.iter().map(|p| [p[u], p[v]]).collect()
}

/// The polygon's area times twice its normal. Works from any corner, convex or not (Newell's
/// method; Sutherland et al., "A characterization of ten hidden-surface algorithms", 1974).
pub(super) fn newell_normal(ring: &[Vector]) -> Vector {
    let relative = |i: usize| sub(ring[i % ring.len()], ring[0]);
    (1..ring.len()).fold([0.0; 3], |sum, i| add(sum, cross(relative(i), relative(i + 1))))
}

/// Whether a triangle has an area beyond the rounding of its coordinates.
///
/// A coordinate c has an error of up to c * epsilon / 2. So each coordinate of an edge has one of
/// c * epsilon, and the cross product of two edges one of about 4 c * epsilon times the longest
/// edge. Three points on a slanted line, written in decimals, have no more area than that: their
/// normal is noise.
pub(super) fn has_area([a, b, c]: [Vector; 3]) -> bool {
    // In units of the largest coordinate, no product leaves the range of f64.
    let coordinate = largest(a).max(largest(b)).max(largest(c));
    let [ab, bc, ca] = [sub(b, a), sub(c, b), sub(a, c)].map(|edge| edge.map(|x| x / coordinate));
    let longest = length(ab).max(length(bc)).max(length(ca));
    length(cross(ab, bc)) > 4.0 * f64::EPSILON * longest
}

#[cfg(test)]
mod tests {
    use super::{super::polygons::NO_COLOR, *};

    fn polygon(ring: &[Vector]) -> Polygons {
        Polygons {
            positions: ring.to_vec(),
            corners: (0..ring.len() as u32)
                .map(|position| Corner {
                    position,
                    normal: [0.0; 3],
                    texture: [0.0; 2],
                    color: NO_COLOR,
                })
                .collect(),
            faces: vec![Face { arity: ring.len(), material: 0, smoothing: Smoothing::Unstated }],
            colors: vec![[0; 3]],
            ..Polygons::default()
        }
    }

    fn cut(ring: &[Vector]) -> (Vec<[Vector; 3]>, usize) {
        let polygons = polygon(ring);
        let (triangles, dropped) = triangulate(&polygons, &[&polygons.positions]);
        let points =
            triangles.iter().map(|t| t.corners.map(|c| ring[c.position as usize])).collect();
        (points, dropped)
    }

    /// An L, concave at its first corner: a fan from any corner but the first and the fourth folds
    /// over.
    const L: [[f64; 2]; 6] =
        [[1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]];

    #[test]
    fn concave_polygons_keep_area_and_winding_on_any_plane() {
        let planes: [fn([f64; 2]) -> Vector; 6] = [
            |[x, y]| [x, y, 0.5],
            |[x, y]| [y, x, 0.5],
            |[x, y]| [0.5, x, y],
            |[x, y]| [y, 0.5, x],
            |[x, y]| [x, 0.5, y],
            |[x, y]| [x - y, x + y, 0.3 * x],
        ];
        for (number, plane) in planes.into_iter().enumerate() {
            for shift in 0..L.len() {
                let mut ring = L.map(plane);
                ring.rotate_left(shift);
                let whole = newell_normal(&ring);
                let (triangles, dropped) = cut(&ring);
                assert_eq!((triangles.len(), dropped), (4, 0), "plane {number}, start {shift}");
                let sum = triangles.iter().fold(0.0, |sum, t| {
                    let n = newell_normal(t);
                    assert!(
                        super::super::vector::dot(n, whole) > 0.0,
                        "plane {number}: a triangle is turned over"
                    );
                    sum + length(n)
                });
                assert!(
                    (sum - length(whole)).abs() < 1e-12,
                    "plane {number}, start {shift}: area {sum}"
                );
            }
        }
    }

    #[test]
    fn no_corner_is_lost_on_a_straight_edge() {
        let ring =
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        for shift in 0..ring.len() {
            let mut ring = ring;
            ring.rotate_left(shift);
            let (triangles, dropped) = cut(&ring);
            assert_eq!((triangles.len(), dropped), (3, 0), "start {shift}");
            assert!(ring.iter().all(|p| triangles.iter().any(|t| t.contains(p))), "start {shift}");
        }
    }

    #[test]
    fn triangles_without_area_are_dropped_and_counted() {
        assert_eq!(cut(&[[0.1; 3], [0.2; 3], [0.3; 3]]), (vec![], 1));
        // On one line in decimals, not in binary.
        assert_eq!(cut(&[[0.05, 0.15, 0.35], [0.1, 0.3, 0.7], [0.15, 0.45, 1.05]]), (vec![], 1));
        assert_eq!(cut(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0; 3]]), (vec![], 1));
        assert_eq!(cut(&[[0.1; 3], [0.2; 3], [0.3; 3], [0.7; 3]]), (vec![], 2));
        let (triangles, dropped) =
            cut(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!((triangles.len(), dropped), (1, 1));
        // A figure of eight on edge: its area cancels out, its halves stay.
        let eight = [[0.0; 3], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(cut(&eight).1, 0);
        // Thin, but thicker than the error of its coordinates.
        assert_eq!(cut(&[[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-12, 0.0]]).1, 0);
    }

    #[test]
    fn large_polygons_are_cut_whole() {
        // A star of 20,000 corners: every other corner is concave.
        let ring: Vec<Vector> = (0..20_000)
            .map(|i| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 20_000.0).sin_cos();
                let r = 1.0 - 0.3 * f64::from(i % 2);
                [r * cos, 0.1, -r * sin]
            })
            .collect();
        let (triangles, dropped) = cut(&ring);
        assert_eq!((triangles.len(), dropped), (19_998, 0));
        let sum: f64 = triangles.iter().map(|t| newell_normal(t)[1]).sum();
        assert!((sum - newell_normal(&ring)[1]).abs() < 1e-9 && sum > 0.0);
    }
}
