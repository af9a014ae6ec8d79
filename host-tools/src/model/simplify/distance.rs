//! How far two surfaces lie apart.

use rstar::{AABB, PointDistance, RTree, RTreeObject};
use rustc_hash::FxHashSet;

use super::super::vector::{Vector, add, cross, dot, key, length, scaled, sub};

/// About how many points of each surface are measured.
const SAMPLES: f64 = 50_000.0;

/// The most rows of points on a triangle.
const MOST_ROWS: f64 = 128.0;

/// The distances from points of each of two surfaces to the other one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Distance {
    /// The longest.
    pub most: f64,
    /// The root of the mean of the squares, over the areas of both.
    pub root_mean_square: f64,
}

/// Measures the distances between two surfaces of triangles, both ways: from about
/// [`SAMPLES`] points of each, evenly spread over its area, and from its corners and the middles of
/// its edges, to the nearest point of the other. The longest is a lower bound of the Hausdorff
/// distance.
pub(super) fn between(one: &[[Vector; 3]], other: &[[Vector; 3]]) -> Distance {
    let ways = [one_way(one, other), one_way(other, one)];
    let sum = |part: fn(&OneWay) -> f64| ways.iter().map(part).sum::<f64>();
    Distance {
        most: ways.iter().map(|way| way.most).fold(0.0, f64::max),
        root_mean_square: (sum(|way| way.squares) / sum(|way| way.area)).sqrt(),
    }
}

/// The longest distance, and the squares of distances times the areas that they stand for.
struct OneWay {
    most: f64,
    squares: f64,
    area: f64,
}

fn one_way(from: &[[Vector; 3]], to: &[[Vector; 3]]) -> OneWay {
    let tree = RTree::bulk_load(to.iter().map(|&corners| Patch(corners)).collect());
    let square = |point: Vector| {
        tree.nearest_neighbor(point).map_or(f64::INFINITY, |patch| patch.distance_2(&point))
    };
    let area = |&[a, b, c]: &[Vector; 3]| length(cross(sub(b, a), sub(c, a))) / 2.0;
    let total: f64 = from.iter().map(area).sum();
    let mut measured = FxHashSet::default();
    let mut way = OneWay { most: 0.0, squares: 0.0, area: total };
    for triangle in from {
        let (area, [a, b, c]) = (area(triangle), *triangle);
        let rows = (SAMPLES * area / total).sqrt().ceil().clamp(1.0, MOST_ROWS);
        let place = |u: f64, v: f64| add(a, add(scaled(sub(b, a), u), scaled(sub(c, a), v)));
        let mut sum = 0.0;
        // The middles of equal triangles, rows^2 of them.
        for row in 0..rows as u32 {
            for column in 0..rows as u32 - row {
                let corner = [row, column].map(f64::from);
                let middle = |part: f64| corner.map(|c| (c + part) / rows);
                let [u, v] = middle(1.0 / 3.0);
                let upper = square(place(u, v));
                let [u, v] = middle(2.0 / 3.0);
                // The last one of a row has no neighbour.
                let is_inside = row + column + 1 < rows as u32;
                let lower = if is_inside { square(place(u, v)) } else { 0.0 };
                sum += upper + lower;
                way.most = way.most.max(upper).max(lower);
            }
        }
        way.squares += sum / (rows * rows) * area;
        let middles = [[a, b], [b, c], [c, a]].map(|[from, to]| scaled(add(from, to), 0.5));
        for place in triangle.iter().chain(&middles) {
            // Triangles share these.
            if measured.insert(key(*place)) {
                way.most = way.most.max(square(*place));
            }
        }
    }
    OneWay { most: way.most.sqrt(), ..way }
}

/// A triangle in a tree of boxes.
struct Patch([Vector; 3]);

impl RTreeObject for Patch {
    type Envelope = AABB<Vector>;

    fn envelope(&self) -> AABB<Vector> {
        AABB::from_points(&self.0)
    }
}

impl PointDistance for Patch {
    /// The square of the distance to the nearest point: a corner, a point of an edge, or one
    /// inside (Ericson, "Real-time collision detection", 2005, section 5.1.5).
    fn distance_2(&self, &point: &Vector) -> f64 {
        let [a, b, c] = self.0;
        let (ab, ac) = (sub(b, a), sub(c, a));
        let square = |nearest: Vector| {
            let between = sub(point, nearest);
            dot(between, between)
        };
        let normal = cross(ab, ac);
        let ap = sub(point, a);
        let double = dot(normal, normal);
        if double > 0.0 {
            let v = dot(cross(ap, ac), normal) / double;
            let w = dot(cross(ab, ap), normal) / double;
            if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
                let height = dot(ap, normal);
                return height * height / double;
            }
        }
        let edge = |from: Vector, to: Vector| {
            let along = sub(to, from);
            let whole = dot(along, along);
            let part = if whole > 0.0 { dot(sub(point, from), along) / whole } else { 0.0 };
            square(add(from, scaled(along, part.clamp(0.0, 1.0))))
        };
        edge(a, b).min(edge(b, c)).min(edge(c, a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of two triangles at a height, `side` long.
    fn square(side: f64, height: f64) -> [[Vector; 3]; 2] {
        let [a, b, c, d] =
            [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]].map(|[x, y]| [x, y, height]);
        [[a, b, c], [a, c, d]]
    }

    #[test]
    fn the_distance_of_a_point_is_that_of_the_nearest_part() {
        let patch = Patch([[0.0; 3], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]]);
        for (point, expected) in [
            ([1.0, 1.0, 2.0], 4.0),
            ([-3.0, -4.0, 0.0], 25.0),
            ([2.0, -2.0, 1.0], 5.0),
            ([6.0, 0.0, -1.0], 5.0),
            // The long edge is at a distance of 12 / 5 from the origin; this is as far beyond it.
            ([2.88, 3.84, 0.0], 5.76),
        ] {
            let found = patch.distance_2(&point);
            assert!((found - expected).abs() < 1e-12, "{point:?}: {found}");
        }
        // All of it is an edge.
        let line = Patch([[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
        assert_eq!(line.distance_2(&[3.0, 2.0, 0.0]), 5.0);
    }

    #[test]
    fn surfaces_are_measured_both_ways() {
        let lifted = between(&square(1.0, 0.0), &square(1.0, 0.25));
        let errors = [lifted.most - 0.25, lifted.root_mean_square - 0.25];
        assert!(errors.iter().all(|error| error.abs() < 1e-12), "{lifted:?}");
        // The corner (2, 2) is sqrt(2) from the smaller square, all of which lies in the larger.
        for pair in [[1.0, 2.0], [2.0, 1.0]] {
            let [one, other] = pair.map(|side| square(side, 0.0));
            let part = between(&one, &other);
            assert!((part.most - 2f64.sqrt()).abs() < 1e-12, "{part:?}");
            // Of the larger one, two unit squares have a mean square of 1/3, one of 2/3, over an
            // area of 5. Sampling is off by the square of a 150th.
            let expected = (4.0 / 3.0 / 5.0_f64).sqrt();
            assert!((part.root_mean_square - expected).abs() < 1e-4, "{part:?}");
        }
    }
}
