//! Which pixel centres a triangle covers: three half-planes and the top-left rule.
//!
//! Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988, gives the edge
//! function; the Direct3D 11.3 functional specification, section 3.4.2.1, the rule for centres on
//! an edge: they belong to the triangle if the edge is a left edge, or a top edge, which is
//! horizontal and above the rest.
//!
//! # Exactness
//!
//! Let the coordinates be multiples of 1/256 pixel of magnitude up to 4,096 pixels. A coordinate
//! difference is then a multiple of 1/256 below 2^13 + 1, which needs 22 bits; a product of two
//! needs 44 and the difference of two products 45, less than the 53 bits of an f64. So every
//! operation of an edge function is exact, and so is coverage: if another rasterizer differs on the
//! same coordinates, one of the two is wrong.
//!
//! Other coordinates are rounded, but two triangles on a shared edge still round in the same way:
//! see [`Edge`].

use std::ops::Range;

/// The pixels that may be drawn to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Region {
    pub columns: Range<usize>,
    pub rows: Range<usize>,
}

impl Region {
    /// A whole picture of `size` (width, height) pixels.
    pub(super) const fn whole((width, height): (usize, usize)) -> Self {
        Self { columns: 0..width, rows: 0..height }
    }
}

/// The edge function of one side of a triangle: twice the signed area spanned by the side and a
/// point.
///
/// The side is stored from its lexicographically smaller end to the larger one, in both directions
/// of the triangle along it, and `inside` has the sign. Two triangles on both sides of a shared
/// edge therefore compute the same number with opposite signs, rounded or not, and exactly one of
/// them covers each centre.
#[derive(Clone, Copy, Debug)]
struct Edge {
    start: [f64; 2],
    along: [f64; 2],
    /// 1 or -1, so that [`Edge::value`] is positive inside the triangle.
    inside: f64,
    /// A left or a top edge: centres exactly on it belong to the triangle.
    is_top_left: bool,
}

impl Edge {
    /// The side from `a` to `b` of a triangle whose screen area has the sign of `area`.
    fn new(a: [f64; 2], b: [f64; 2], area: f64) -> Self {
        let (start, end, direction) = if a <= b { (a, b, 1.0) } else { (b, a, -1.0) };
        let along = [end[0] - start[0], end[1] - start[1]];
        let inside = direction * area.signum();
        // With y down and the triangle on the positive side, a left edge runs upward and a top edge
        // to the right.
        let [right, down] = along.map(|component| component * inside);
        Self { start, along, inside, is_top_left: down < 0.0 || (down == 0.0 && right > 0.0) }
    }

    fn value(&self, [x, y]: [f64; 2]) -> f64 {
        self.inside * (self.along[0] * (y - self.start[1]) - self.along[1] * (x - self.start[0]))
    }

    const fn accepts(&self, value: f64) -> bool {
        value > 0.0 || (value == 0.0 && self.is_top_left)
    }
}

/// Twice the signed area of the triangle `abc` on the screen: positive when it is clockwise for the
/// viewer, as y points down; front faces have a negative area.
pub(super) fn doubled_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    Edge::new(a, b, 1.0).value(c)
}

/// What [`for_each_covered`] calls. Not a type parameter: there are hundreds of such closures, of
/// which each would have its own copy of the loop.
pub(super) type Visit<'a> = dyn FnMut([usize; 2], [f64; 3], &Range<usize>) + 'a;

/// Calls `visit(pixel, weights, span)` for every pixel (column, row) of the region whose centre the
/// triangle covers, row by row. The barycentric weights belong to the corners in their order and
/// sum to 1 up to rounding. The span has the covered columns of the row.
///
/// The winding does not matter. A triangle without area, or with a coordinate that is not finite,
/// covers nothing.
pub(super) fn for_each_covered(corners: [[f64; 2]; 3], region: &Region, visit: &mut Visit<'_>) {
    let area = doubled_area(corners);
    if area == 0.0 || !area.is_finite() {
        return;
    }
    let [a, b, c] = corners;
    // Each edge lies opposite the corner whose weight it yields.
    let edges = [Edge::new(b, c, area), Edge::new(c, a, area), Edge::new(a, b, area)];
    let covers =
        |values: &[f64; 3]| edges.iter().zip(values).all(|(edge, &value)| edge.accepts(value));

    let columns = pixels_between(corners.map(|corner| corner[0]), &region.columns);
    let mut span = Vec::new();
    for row in pixels_between(corners.map(|corner| corner[1]), &region.rows) {
        let y = row as f64 + 0.5;
        // Each operation of an edge function, and its rounding, is monotonic in x, so the covered
        // pixels of a row are neighbours: after the last of them the row is done.
        span.clear();
        span.extend(
            columns
                .clone()
                .map(|column| (column, edges.map(|edge| edge.value([column as f64 + 0.5, y]))))
                .skip_while(|(_, values)| !covers(values))
                .take_while(|(_, values)| covers(values)),
        );
        let Some(&(start, _)) = span.first() else { continue };
        let range = start..start + span.len();
        for &(column, values) in &span {
            // The area again, but with the roundings of the values, so that the weights sum to 1.
            // It is above 0, even on a corner: the three sides as vectors sum to 0, so not all of
            // them are left or top edges.
            let sum = values[0] + values[1] + values[2];
            visit([column, row], values.map(|value| value / sum), &range);
        }
    }
}

/// The pixels within `limits` whose extent overlaps that of the three coordinates. Truncation is
/// monotonic and a pixel's number is its truncated centre, so no centre is lost; `as` saturates, so
/// no coordinate is too large.
fn pixels_between(coordinates: [f64; 3], limits: &Range<usize>) -> Range<usize> {
    let low = coordinates.into_iter().fold(f64::INFINITY, f64::min);
    let high = coordinates.into_iter().fold(f64::NEG_INFINITY, f64::max);
    (low as usize).max(limits.start)..(high as usize).saturating_add(1).min(limits.end)
}

#[cfg(test)]
mod tests;
