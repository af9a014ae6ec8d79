//! Parts of a mesh that planes keep apart, without cutting a triangle: exactly, on the quantised
//! positions.

use rasterizer::mesh::{Mesh, Parts, SeparatingPlane};

use super::convex::{self, Corners, cross, difference, dot};
use crate::model::Model;

/// The most triangles of a set whose planes are tried: each is tried with all triangles.
const MOST_PLANES: usize = 4_096;

/// The most pairs of bodies between which a plane is sought.
const MOST_PAIRS: usize = 1_024;

/// Parts of a mesh, and the planes between them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Partition {
    /// The triangles of each part, by their places in the tables.
    parts: Vec<Vec<usize>>,
    /// The planes in the order of [`Parts::new`].
    pub(super) planes: Vec<Plane>,
    /// Whether no triangle hides another one of its part.
    pub(super) is_convex: bool,
}

/// A plane through three points, and the parts in front of it and behind it: [`SeparatingPlane`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Plane {
    pub(super) points: Corners,
    pub(super) parts: [u8; 3],
}

impl Partition {
    /// The parts of a model; `None` if no plane divides it.
    ///
    /// A set of triangles is divided by the plane with the fewest of them on its larger side, and
    /// so are both sides, until no triangle of a part can hide another one, no plane is found, or
    /// there are as many parts as [`Parts`] may have.
    pub(super) fn of(model: &Model) -> Option<Self> {
        let triangles = convex::triangles(model);
        let mut found = Self { is_convex: true, ..Self::default() };
        let mesh = (&triangles[..], bounds(triangles.as_flattened()));
        found.divide(mesh, (0..triangles.len()).collect(), Parts::MOST);
        (found.parts.len() > 1).then_some(found)
    }

    /// Adds the parts of a set of a mesh's triangles, up to a number of them.
    fn divide(&mut self, mesh: (&[Corners], Bounds), set: Vec<usize>, most: usize) {
        let (triangles, bounds) = mesh;
        let corners: Vec<Corners> = set.iter().map(|&number| triangles[number]).collect();
        let is_convex = convex::is_below_all(&corners);
        let found = if is_convex || most < 2 { None } else { best_plane(&corners, bounds) };
        let Some((points, is_behind)) = found else {
            self.is_convex &= is_convex;
            self.parts.push(set);
            return;
        };
        let side = |wanted: bool| {
            let pairs = set.iter().zip(&is_behind);
            pairs.filter(|&(_, &behind)| behind == wanted).map(|(&number, _)| number).collect()
        };
        let [front, behind]: [Vec<usize>; 2] = [side(false), side(true)];
        let for_front = (most * front.len() / set.len()).clamp(1, most - 1);
        // Its place is before those of its sides, whose numbers of parts are not known yet.
        let (place, first) = (self.planes.len(), self.parts.len());
        self.planes.push(Plane { points, parts: [0; 3] });
        self.divide(mesh, front, for_front);
        let middle = self.parts.len();
        self.divide(mesh, behind, most - (middle - first));
        self.planes[place].parts = [first, middle, self.parts.len()].map(|part| part as u8);
    }

    /// How many parts there are.
    pub(super) const fn count(&self) -> usize {
        self.parts.len()
    }

    /// The part of each triangle.
    pub(super) fn part_of_triangles(&self) -> Vec<u8> {
        let mut parts = vec![0; self.parts.iter().map(Vec::len).sum()];
        for (part, triangles) in self.parts.iter().enumerate() {
            triangles.iter().for_each(|&number| parts[number] = part as u8);
        }
        parts
    }

    /// The ends of the parts, where triangles stand in the order of their parts.
    pub(super) fn ends(&self) -> Vec<u32> {
        let sum = |sum: &mut u32, part: &Vec<usize>| {
            *sum += part.len() as u32;
            Some(*sum)
        };
        self.parts.iter().scan(0, sum).collect()
    }

    /// Calls `draw` with the parts of a mesh whose triangles stand in that order; with `None` if
    /// they do not.
    pub(super) fn with_parts<R>(
        &self,
        mesh: &Mesh<'_>,
        draw: impl FnOnce(Option<&Parts<'_>>) -> R,
    ) -> R {
        let plane = |plane: &Plane| SeparatingPlane::new(plane.points, plane.parts);
        let (ends, planes) = (self.ends(), self.planes.iter().map(plane).collect::<Vec<_>>());
        draw(Parts::new(mesh, &ends, &planes).ok().as_ref())
    }
}

/// The least and the greatest coordinates of a mesh, within which [`Parts`] wants planes' points.
type Bounds = [[i16; 3]; 2];

/// The plane that divides triangles most evenly, and for each triangle whether it lies behind it.
fn best_plane(triangles: &[Corners], bounds: Bounds) -> Option<(Corners, Vec<bool>)> {
    let larger_side = |(_, is_behind): &(Corners, Vec<bool>)| {
        let behind = is_behind.iter().filter(|&&behind| behind).count();
        behind.max(is_behind.len() - behind)
    };
    let candidates = between_bodies(triangles, bounds).into_iter().chain(planes_of(triangles));
    let dividing = candidates.filter_map(|points| Some((points, sides(triangles, points)?)));
    dividing.min_by_key(larger_side)
}

/// For each triangle whether it lies behind a plane; `None` if one lies across it, or all on one
/// side. Of the triangles in the plane those that face to its front bound what is behind.
fn sides(triangles: &[Corners], points: Corners) -> Option<Vec<bool>> {
    let normal = cross(points);
    let side = |&triangle: &Corners| {
        let heights = triangle.map(|corner| dot(normal, difference(corner, points[0])));
        let is_above = heights.iter().any(|&height| height > 0);
        let is_below = heights.iter().any(|&height| height < 0);
        let faces_front = || dot(normal, reduced(cross(triangle))) > 0;
        (!(is_above && is_below)).then(|| is_below || !is_above && faces_front())
    };
    let is_behind: Vec<bool> = triangles.iter().map(side).collect::<Option<_>>()?;
    let behind = is_behind.iter().filter(|&&behind| behind).count();
    (behind > 0 && behind < triangles.len()).then_some(is_behind)
}

/// A normal of the same direction, or nearly, below 2^20: products with others fit 64 bits.
fn reduced(normal: [i64; 3]) -> [i64; 3] {
    let bits = normal.iter().map(|c| 64 - c.unsigned_abs().leading_zeros()).max().unwrap_or(0);
    normal.map(|c| c >> bits.saturating_sub(20))
}

/// The planes of triangles.
fn planes_of(triangles: &[Corners]) -> impl Iterator<Item = Corners> {
    let step = triangles.len().div_ceil(MOST_PLANES).max(1);
    triangles.iter().copied().step_by(step).filter(|&triangle| cross(triangle) != [0; 3])
}

/// Planes between bodies that do not touch: at right angles to the axes, and to the shortest way
/// between two of them.
fn between_bodies(triangles: &[Corners], bounds: Bounds) -> Vec<Corners> {
    let bodies = bodies(triangles);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let pairs =
        bodies.iter().enumerate().flat_map(|(i, a)| bodies[..i].iter().map(move |b| (a, b)));
    let ways = pairs.take(MOST_PAIRS).filter_map(|(a, b)| way_between(a, b));
    let gaps = |way: [f64; 3]| gaps_along(&bodies, way).into_iter().map(move |at| (way, at));
    let planes = axes.into_iter().chain(ways).flat_map(gaps);
    planes.filter_map(|(way, at)| plane_within(bounds, way, at)).collect()
}

/// The points of triangles that are joined by common points.
fn bodies(triangles: &[Corners]) -> Vec<Vec<[i16; 3]>> {
    let mut points: Vec<[i16; 3]> = triangles.as_flattened().to_vec();
    points.sort_unstable();
    points.dedup();
    let place = |point: &[i16; 3]| points.binary_search(point).unwrap_or(0);
    // A tree for each body: each point leads to another one, or to itself at the root.
    let mut roots: Vec<usize> = (0..points.len()).collect();
    let root_of = |roots: &mut Vec<usize>, mut point: usize| {
        while roots[point] != point {
            roots[point] = roots[roots[point]];
            point = roots[point];
        }
        point
    };
    for corners in triangles {
        let [a, b, c] = corners.each_ref().map(|corner| root_of(&mut roots, place(corner)));
        roots[b] = a;
        let c = root_of(&mut roots, c);
        let a = root_of(&mut roots, a);
        roots[c] = a;
    }
    let mut bodies: Vec<Vec<[i16; 3]>> = vec![Vec::new(); points.len()];
    for (place, &point) in points.iter().enumerate() {
        let root = root_of(&mut roots, place);
        bodies[root].push(point);
    }
    bodies.retain(|body| !body.is_empty());
    bodies
}

/// How far a point lies along a way.
fn along(way: [f64; 3], point: [i16; 3]) -> f64 {
    (0..3).map(|i| way[i] * f64::from(point[i])).sum()
}

/// A way from one body to another along which they are apart, if they are: nearly the shortest one
/// (Gilbert, *An iterative procedure for computing the minimum of a quadratic form on a convex
/// set*, 1966).
fn way_between(a: &[[i16; 3]], b: &[[i16; 3]]) -> Option<[f64; 3]> {
    /// It nears the shortest way by a part of the rest in each step.
    const STEPS: usize = 2_000;
    /// The part of the shortest way that is enough.
    const ENOUGH: f64 = 0.9;
    let minus = |b: [i16; 3], a: [i16; 3]| difference(b, a).map(|c| c as f64);
    let product = |u: [f64; 3], v: [f64; 3]| (0..3).map(|i| u[i] * v[i]).sum::<f64>();
    let mut way = minus(*b.first()?, *a.first()?);
    let mut best: Option<(f64, [f64; 3])> = None;
    for _ in 0..STEPS {
        let nearest = |points: &[[i16; 3]], way: [f64; 3]| {
            points.iter().copied().min_by(|&p, &q| along(way, p).total_cmp(&along(way, q)))
        };
        let support = minus(nearest(b, way)?, nearest(a, way.map(|c| -c))?);
        let (square, gap) = (product(way, way), product(way, support));
        if gap > 0.0 {
            let gap = gap / square.sqrt();
            if best.is_none_or(|(most, _)| gap > most) {
                best = Some((gap, way));
            }
            if gap > ENOUGH * square.sqrt() {
                break;
            }
        }
        // The point of the line from the way to the support that is nearest to 0.
        let to: [f64; 3] = std::array::from_fn(|i| support[i] - way[i]);
        let part = (-product(way, to) / product(to, to)).clamp(0.0, 1.0);
        if !part.is_finite() {
            break;
        }
        way = std::array::from_fn(|i| way[i] + part * to[i]);
    }
    best.map(|(_, way)| way)
}

/// The middles of the gaps between bodies along a way.
fn gaps_along(bodies: &[Vec<[i16; 3]>], way: [f64; 3]) -> Vec<f64> {
    let span = |body: &Vec<[i16; 3]>| {
        body.iter()
            .map(|&point| along(way, point))
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
    };
    let mut spans: Vec<[f64; 2]> = bodies.iter().map(span).collect();
    spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut end = f64::INFINITY;
    let mut gaps = Vec::new();
    for [low, high] in spans {
        if low >= end {
            gaps.push(f64::midpoint(low, end));
        }
        end = if end.is_finite() { end.max(high) } else { high };
    }
    gaps
}

fn bounds(points: &[[i16; 3]]) -> Bounds {
    points.iter().fold([[i16::MAX; 3], [i16::MIN; 3]], |[low, high], point| {
        [
            std::array::from_fn(|i| low[i].min(point[i])),
            std::array::from_fn(|i| high[i].max(point[i])),
        ]
    })
}

/// Three points near the plane at right angles to a way, at this place along it: of those in which
/// it meets the edges of the bounds, those of the largest triangle.
fn plane_within([low, high]: Bounds, way: [f64; 3], at: f64) -> Option<Corners> {
    let mut met = Vec::new();
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        for [x, y] in [[low[i], low[j]], [low[i], high[j]], [high[i], low[j]], [high[i], high[j]]] {
            let across = way[i] * f64::from(x) + way[j] * f64::from(y);
            let along = ((at - across) / way[k]).round();
            if (f64::from(low[k])..=f64::from(high[k])).contains(&along) {
                let mut point = [0; 3];
                (point[i], point[j], point[k]) = (x, y, along as i16);
                met.push(point);
            }
        }
    }
    let area =
        |&triangle: &Corners| -> f64 { cross(triangle).iter().map(|&c| (c as f64).powi(2)).sum() };
    let pairs = (0..met.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    let all =
        pairs.flat_map(|[a, b]| met[..a].iter().map(|&c| [met[a], met[b], c]).collect::<Vec<_>>());
    all.max_by(|a, b| area(a).total_cmp(&area(b)))
}

#[cfg(test)]
mod tests {
    use std::{f64::consts::TAU, fmt::Write as _};

    use super::*;
    use crate::{model::Options, reference::random::Random};

    fn model(obj: &str) -> Model {
        Model::from_bytes("m.obj".as_ref(), obj.as_bytes(), &Options::default()).unwrap()
    }

    /// A box about a point, turned by a rotation given as its rows.
    fn block(obj: &mut String, at: [f64; 3], half: [f64; 3], rows: [[f64; 3]; 3]) {
        let first = obj.lines().filter(|line| line.starts_with('v')).count() + 1;
        for corner in 0..8 {
            let own: [f64; 3] =
                std::array::from_fn(|i| if corner >> i & 1 == 0 { -half[i] } else { half[i] });
            let [x, y, z] =
                [0, 1, 2].map(|row| at[row] + (0..3).map(|i| rows[row][i] * own[i]).sum::<f64>());
            let _ = writeln!(obj, "v {x} {y} {z}");
        }
        for face in ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"] {
            let corners: Vec<String> = face
                .split(' ')
                .map(|c| (c.parse::<usize>().unwrap() - 1 + first).to_string())
                .collect();
            let _ = writeln!(obj, "f {}", corners.join(" "));
        }
    }

    const UPRIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// The numbers of parts and their triangles, after a check of all sides by the core's own
    /// constructor.
    fn parts(obj: &str) -> Option<(Vec<usize>, bool)> {
        let model = model(obj);
        let found = Partition::of(&model)?;
        let order: Vec<usize> = found.parts.concat();
        let ordered = model.reordered(&order);
        found.with_parts(&ordered.mesh(), |parts| {
            assert_eq!(parts.map(Parts::count), Some(found.count()), "{found:?}");
        });
        Some((found.parts.iter().map(Vec::len).collect(), found.is_convex))
    }

    #[test]
    fn convex_bodies_that_do_not_touch_are_parts() {
        let mut obj = String::new();
        for corner in 0..8 {
            let at = [0, 1, 2].map(|i| f64::from(corner >> i & 1) * 3.0);
            block(&mut obj, at, [1.0; 3], UPRIGHT);
        }
        assert_eq!(parts(&obj), Some((vec![12; 8], true)));
    }

    #[test]
    fn one_convex_body_has_no_parts() {
        let mut obj = String::new();
        block(&mut obj, [0.0; 3], [1.0, 2.0, 3.0], UPRIGHT);
        assert_eq!(parts(&obj), None);
    }

    #[test]
    fn bodies_may_touch_and_stand_on_a_floor() {
        // Two cubes with a common face, on an open square that they touch.
        let mut obj = String::new();
        block(&mut obj, [-1.0, 1.0, 0.0], [1.0; 3], UPRIGHT);
        block(&mut obj, [1.0, 1.0, 0.0], [1.0; 3], UPRIGHT);
        obj += "v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nf 17 18 19 20\n";
        let (mut sizes, is_convex) = parts(&obj).unwrap();
        sizes.sort_unstable();
        // Together both cubes are a convex body in which faces within are hidden by others.
        assert_eq!((sizes, is_convex), (vec![2, 12, 12], true));
    }

    #[test]
    fn an_angle_is_divided_along_one_of_its_faces() {
        // Like a letter L: no triangle lies across the plane of either inner face.
        let outline = [[0, 0], [4, 0], [4, 2], [2, 2], [2, 4], [0, 4]];
        let mut obj = String::new();
        for z in [0, 2] {
            for [x, y] in outline {
                let _ = writeln!(obj, "v {x} {y} {z}");
            }
        }
        obj += "f 1 4 3 2\nf 1 6 5 4\nf 7 8 9 10\nf 7 10 11 12\n";
        for (a, b) in (1..=6).zip([2, 3, 4, 5, 6, 1]) {
            let _ = writeln!(obj, "f {a} {b} {} {}", b + 6, a + 6);
        }
        // The caps' diagonals from the inner corner to the outer one are crossed by both planes.
        assert_eq!(parts(&obj), None);
        let straight = obj
            .replace(
                "f 1 4 3 2\nf 1 6 5 4\n",
                "v 0 2 0\nv 0 2 2\nf 1 13 4 2\nf 2 4 3\nf 13 6 5 4\n",
            )
            .replace("f 7 8 9 10\nf 7 10 11 12\n", "f 7 8 10 14\nf 8 9 10\nf 14 10 11 12\n")
            .replace("f 6 1 7 12\n", "f 6 13 14 12\nf 13 1 7 14\n");
        let (sizes, is_convex) = parts(&straight).unwrap();
        assert!(is_convex && sizes.len() == 2, "{sizes:?}");
    }

    #[test]
    fn bodies_that_hold_each_other_stay_together() {
        // A ring of four bars round one that sticks through it: no plane is free of them.
        let mut obj = String::new();
        for (at, half) in [
            ([0.0, 2.0, 0.0], [3.0, 0.5, 0.5]),
            ([0.0, -2.0, 0.0], [3.0, 0.5, 0.5]),
            ([2.0, 0.0, 1.5], [0.5, 3.0, 0.5]),
            ([-2.0, 0.0, 1.5], [0.5, 3.0, 0.5]),
        ] {
            block(&mut obj, at, half, UPRIGHT);
        }
        assert_eq!(parts(&obj).map(|(sizes, _)| sizes), Some(vec![12; 4]));
        // Bars through a common middle.
        let mut obj = String::new();
        block(&mut obj, [0.0; 3], [3.0, 1.0, 1.0], UPRIGHT);
        block(&mut obj, [0.0; 3], [1.0, 3.0, 1.5], UPRIGHT);
        assert_eq!(parts(&obj), None);
    }

    /// Boxes in random poses, some of which are apart along the product of two edges alone.
    #[test]
    fn pairs_of_turned_boxes_are_apart_or_cross() {
        let mut random = Random(5);
        let (mut apart, mut together) = (0, 0);
        for _ in 0..200 {
            let mut obj = String::new();
            for at in [[0.0; 3], [0; 3].map(|_| random.real(-2.0, 2.0))] {
                let [a, b, c] = [0; 3].map(|_| random.real(0.0, TAU).sin_cos());
                let rows = [
                    [a.1 * b.1, a.1 * b.0 * c.0 - a.0 * c.1, a.1 * b.0 * c.1 + a.0 * c.0],
                    [a.0 * b.1, a.0 * b.0 * c.0 + a.1 * c.1, a.0 * b.0 * c.1 - a.1 * c.0],
                    [-b.0, b.1 * c.0, b.1 * c.1],
                ];
                block(&mut obj, at, [1.2, 0.8, 0.4], rows);
            }
            // By the separating axis theorem: one of the faces' normals or of the products of
            // edges has both on its sides.
            let triangles = convex::triangles(&model(&obj));
            let [first, second] = [&triangles[..12], &triangles[12..]];
            let edges = |set: &[Corners]| -> Vec<[i64; 3]> {
                set.iter().map(|&[a, b, _]| difference(b, a)).collect()
            };
            let normals = triangles.iter().map(|&triangle| reduced(cross(triangle)));
            let products = edges(first).into_iter().flat_map(|u| {
                edges(second).into_iter().map(move |v| {
                    reduced([
                        u[1] * v[2] - u[2] * v[1],
                        u[2] * v[0] - u[0] * v[2],
                        u[0] * v[1] - u[1] * v[0],
                    ])
                })
            });
            let gap = |axis: [i64; 3]| {
                let span = |set: &[Corners]| {
                    let along = |&p: &[i16; 3]| dot(axis, p.map(i64::from));
                    let all = set.as_flattened().iter().map(along);
                    [all.clone().min().unwrap(), all.max().unwrap()]
                };
                let ([a, b], [c, d]) = (span(first), span(second));
                let length = dot(axis, axis) as f64;
                (c - b).max(a - d) as f64 / length.sqrt()
            };
            let most = normals.chain(products).map(gap).fold(f64::NEG_INFINITY, f64::max);
            // Rounded to quanta, their faces bend, some of them inwards.
            let found = parts(&obj).map(|(sizes, _)| sizes);
            // In quanta: less than a few cannot be told apart by points of whole quanta.
            if most > 20.0 {
                apart += 1;
                assert_eq!(found, Some(vec![12; 2]), "{most}\n{obj}");
            } else if most < -20.0 {
                together += 1;
                assert_eq!(found, None, "{most}\n{obj}");
            }
        }
        assert!(apart > 40 && together > 40, "{apart} {together}");
    }
}
