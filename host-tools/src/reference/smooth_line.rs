//! How much of a pixel an antialiased line covers: the area in it of a parallelogram, two of whose
//! sides run along the line, a width apart, and the others through its ends, along the axis in
//! which it is shorter.

/// An antialiased line on the screen, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothLine {
    /// Start and end.
    pub ends: [[f64; 2]; 2],
    /// The distance of the two sides from each other.
    pub width: f64,
}

impl SmoothLine {
    /// The axis along which it is longer: 0 for x, 1 for y. With both alike it is x.
    #[must_use]
    pub fn major(&self) -> usize {
        let [from, to] = self.ends;
        usize::from((to[0] - from[0]).abs() < (to[1] - from[1]).abs())
    }

    /// The corners of the parallelogram; all alike for a line of no length.
    #[must_use]
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let ([from, to], major) = (self.ends, self.major());
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let along = (to[major] - from[major]).abs();
        let half = if along == 0.0 { 0.0 } else { self.width * length / along / 2.0 };
        let moved = |mut end: [f64; 2], by: f64| {
            end[1 - major] += by;
            end
        };
        [moved(from, -half), moved(to, -half), moved(to, half), moved(from, half)]
    }

    /// The part of the pixel of a column and a row that it covers, from 0 to 1.
    #[must_use]
    pub fn coverage(&self, pixel: [i64; 2]) -> f64 {
        let mut polygon = self.corners().to_vec();
        for (axis, low) in pixel.into_iter().enumerate() {
            let low = low as f64;
            polygon = clipped(&polygon, |point| point[axis] - low);
            polygon = clipped(&polygon, |point| low + 1.0 - point[axis]);
        }
        let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
        sides.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs() / 2.0
    }

    /// How far along the line the centre of a pixel lies by its coordinate on the major axis: 0 at
    /// the start and before it, 1 at the end and after it.
    #[must_use]
    pub fn part(&self, pixel: [i64; 2]) -> f64 {
        let (axis, [from, to]) = (self.major(), self.ends);
        let center = pixel[axis] as f64 + 0.5;
        ((center - from[axis]) / (to[axis] - from[axis])).clamp(0.0, 1.0)
    }
}

/// The part of a polygon whose points have no negative `distance`, which is linear.
fn clipped(polygon: &[[f64; 2]], distance: impl Fn([f64; 2]) -> f64) -> Vec<[f64; 2]> {
    let mut kept = Vec::new();
    for (&a, &b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (from, to) = (distance(a), distance(b));
        if from >= 0.0 {
            kept.push(a);
        }
        if (from < 0.0) != (to < 0.0) {
            let part = from / (from - to);
            kept.push([0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis])));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_coverage(line: &SmoothLine, pixel: [i64; 2], expected: f64) {
        let got = line.coverage(pixel);
        assert!((got - expected).abs() < 1e-12, "{line:?} {pixel:?}: {got}, not {expected}");
    }

    #[test]
    fn a_line_along_an_axis_is_a_rectangle() {
        let line = SmoothLine { ends: [[0.25, 1.5], [3.5, 1.5]], width: 1.5 };
        for (pixel, expected) in [
            ([0, 1], 0.75),
            ([1, 1], 1.0),
            ([3, 1], 0.5),
            ([4, 1], 0.0),
            ([1, 0], 0.25),
            ([1, 2], 0.25),
            ([0, 0], 0.75 * 0.25),
            ([1, 3], 0.0),
        ] {
            assert_coverage(&line, pixel, expected);
            let turned = SmoothLine { ends: line.ends.map(|[x, y]| [y, x]), ..line };
            assert_coverage(&turned, [pixel[1], pixel[0]], expected);
        }
    }

    #[test]
    fn the_diagonal_of_pixels_has_triangles_beside_it() {
        // Half as high as a pixel: the corners of the pixels beside are isosceles triangles.
        let width = 0.5f64.sqrt();
        let line = SmoothLine { ends: [[0.0, 0.0], [8.0, 8.0]], width };
        assert_coverage(&line, [3, 3], 0.75);
        assert_coverage(&line, [3, 4], 0.125);
        assert_coverage(&line, [4, 3], 0.125);
        assert_coverage(&line, [3, 5], 0.0);
        assert_coverage(&SmoothLine { ends: [[2.0; 2]; 2], width }, [2, 2], 0.0);
    }

    #[test]
    fn values_follow_the_major_axis_and_stay_within_the_ends() {
        let line = SmoothLine { ends: [[0.75, 0.5], [2.75, 1.5]], width: 1.0 };
        assert_eq!([0, 1, 2, 5].map(|column| line.part([column, 0])), [0.0, 0.375, 0.875, 1.0]);
    }
}
