//! Flips slivers out of a triangulation.
//!
//! A corner in the middle of a straight side, written in decimals, lies beside that side by the
//! rounding of its coordinates. Ear clipping may cut it off as a sliver, whose normal is noise.
//! Dropping the sliver would leave the corner out, so that the neighbouring polygon has a vertex in
//! the middle of a side: a crack once positions are rounded. So the sliver and the triangle beyond
//! its longest side swap the diagonal of their quadrangle; both are then of a good shape.

use std::collections::HashMap;

use super::ears::Point;

/// A triangle is a sliver if its height is less than this part of its longest side. Files of six
/// decimals round by less, on sides from a twentieth of a unit.
const FLAT: f64 = 1e-5;

/// Twice the area, divided by the square of the longest side. That is the height over that side.
fn shape(points: &[Point], triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|i| points[i as usize]);
    let sides = [[a, b], [b, c], [c, a]].map(|[p, q]| [q[0] - p[0], q[1] - p[1]]);
    let longest = sides.iter().fold(0.0, |m: f64, s| m.max(s[0] * s[0] + s[1] * s[1]));
    let area = sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0];
    if longest == 0.0 { 0.0 } else { area / longest }
}

/// Turns a triangle so that its longest side runs from its third corner to its first.
fn longest_last(points: &[Point], triangle: [u32; 3]) -> [u32; 3] {
    let square = |from: u32, to: u32| {
        let [p, q] = [from, to].map(|i| points[i as usize]);
        (q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2)
    };
    let [a, b, c] = triangle;
    let turned = [[a, b, c], [b, c, a], [c, a, b]];
    let longest = |t: &&[u32; 3]| square(t[2], t[0]);
    *turned.iter().max_by(|s, t| longest(s).total_cmp(&longest(t))).unwrap_or(&triangle)
}

/// Flips what slivers can be flipped in the triangulation of a polygon. Its sides stay as they are.
///
/// Each flip improves the worse of two triangles. There are at most eight per triangle.
pub(super) fn flip(points: &[Point], triangles: &mut [[u32; 3]]) {
    let is_sliver = |triangle: [u32; 3]| shape(points, triangle) < FLAT;
    let mut slivers: Vec<usize> =
        (0..triangles.len()).filter(|&i| is_sliver(triangles[i])).collect();
    if slivers.is_empty() || triangles.len() == 1 {
        return;
    }
    let sides = |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)];
    let mut owners: HashMap<(u32, u32), usize> = HashMap::with_capacity(3 * triangles.len());
    for (index, &triangle) in triangles.iter().enumerate() {
        owners.extend(sides(triangle).map(|side| (side, index)));
    }
    let mut flips_left = 8 * triangles.len();
    while let Some(sliver) = slivers.pop() {
        let [a, b, c] = longest_last(points, triangles[sliver]);
        let Some(&other) = owners.get(&(a, c)) else { continue };
        if flips_left == 0 || !is_sliver(triangles[sliver]) {
            continue;
        }
        let Some(&d) = triangles[other].iter().find(|&&corner| corner != a && corner != c) else {
            continue;
        };
        let (one, two) = ([a, b, d], [b, c, d]);
        let worst = |one, two| shape(points, one).min(shape(points, two));
        if worst(one, two) <= worst(triangles[sliver], triangles[other]) {
            continue;
        }
        flips_left -= 1;
        owners.remove(&(a, c));
        owners.remove(&(c, a));
        for (index, triangle) in [(sliver, one), (other, two)] {
            triangles[index] = triangle;
            owners.extend(sides(triangle).map(|side| (side, index)));
        }
        slivers.extend([sliver, other]);
        slivers.extend([(b, a), (c, b), (d, c), (a, d)].iter().filter_map(|side| owners.get(side)));
    }
}
