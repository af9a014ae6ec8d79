//! How often outlines enclose each pixel centre, and which centres lie close to an edge. Both take
//! time in proportion to the rows and pixels that edges touch.

/// The winding number of directed edges about each pixel centre of a picture: how often they run
/// round it counter-clockwise, as the viewer sees it.
///
/// It is the sum over the edges that a ray to the left crosses: +1 for an edge that runs down, -1
/// for one that runs up (after Shimrat, "Algorithm 112: Position of point relative to polygon",
/// CACM 5(8), 1962, who counts them without a sign).
#[derive(Clone, Debug)]
pub struct Winding {
    width: usize,
    height: usize,
    /// By how much the number of a pixel differs from the one to its left; each row has one entry
    /// more than pixels.
    steps: Vec<i32>,
}

impl Winding {
    /// No edges, in a picture of `size` (width, height) pixels.
    #[must_use]
    pub fn new((width, height): (usize, usize)) -> Self {
        Self { width, height, steps: vec![0; (width + 1) * height] }
    }

    /// Adds the edge from `from` to `to` several times; a negative number is that of edges in the
    /// other direction. Edges that are not finite are left out.
    pub fn add(&mut self, from: [f64; 2], to: [f64; 2], times: i32) {
        if ![from, to].as_flattened().iter().all(|c| c.is_finite()) {
            return;
        }
        // Always computed from the upper end, so that both directions cross a row at one place.
        let (upper, lower, times) =
            if from[1] <= to[1] { (from, to, times) } else { (to, from, -times) };
        let slope = (lower[0] - upper[0]) / (lower[1] - upper[1]);
        for row in first_center(upper[1])..first_center(lower[1]).min(self.height) {
            let x = upper[0] + (row as f64 + 0.5 - upper[1]) * slope;
            self.steps[row * (self.width + 1) + first_center(x).min(self.width)] += times;
        }
    }

    /// The numbers of all pixels, row by row.
    #[must_use]
    pub fn numbers(&self) -> Vec<i32> {
        let mut numbers = Vec::with_capacity(self.width * self.height);
        for row in self.steps.chunks_exact(self.width + 1) {
            numbers.extend(row[..self.width].iter().scan(0, |number, step| {
                *number += step;
                Some(*number)
            }));
        }
        numbers
    }
}

/// The first pixel whose centre lies at or after a coordinate; `as` turns a negative one into 0.
fn first_center(coordinate: f64) -> usize {
    (coordinate - 0.5).ceil() as usize
}

/// A set of pixels of a picture.
#[derive(Clone, Debug)]
pub struct Pixels {
    width: usize,
    height: usize,
    marks: Vec<bool>,
}

impl Pixels {
    /// None, in a picture of `size` (width, height) pixels.
    #[must_use]
    pub fn none((width, height): (usize, usize)) -> Self {
        Self { width, height, marks: vec![false; width * height] }
    }

    /// Adds those whose centre is at most `reach` away in x and in y from a point of the segment
    /// from `a` to `b`. All pixels, if one of the numbers is not finite.
    pub fn add_close_to(&mut self, a: [f64; 2], b: [f64; 2], reach: f64) {
        if ![a[0], a[1], b[0], b[1], reach].iter().all(|c| c.is_finite()) {
            self.add_all();
            return;
        }
        let (upper, lower) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let slope = (lower[0] - upper[0]) / (lower[1] - upper[1]);
        // The part of the segment between two rows' worth of heights. A level one, or one so flat
        // that the slope overflows, is taken whole.
        let x_at = |y: f64| {
            let x = upper[0] + (y - upper[1]) * slope;
            let (low, high) = (upper[0].min(lower[0]), upper[0].max(lower[0]));
            if x.is_finite() { x.clamp(low, high) } else { low }
        };
        for row in first_center(upper[1] - reach)..last_center(lower[1] + reach, self.height) {
            let y = row as f64 + 0.5;
            let (from, to) = (x_at((y - reach).max(upper[1])), x_at((y + reach).min(lower[1])));
            let (mut low, mut high) = (from.min(to), from.max(to));
            if !slope.is_finite() {
                (low, high) = (upper[0].min(lower[0]), upper[0].max(lower[0]));
            }
            let columns = first_center(low - reach)..last_center(high + reach, self.width);
            if !columns.is_empty() {
                self.marks[row * self.width..][columns].fill(true);
            }
        }
    }

    /// Adds those whose centre lies in a rectangle, or on its sides. All pixels, if one of the
    /// numbers is NaN.
    pub fn add_between(&mut self, [left, top]: [f64; 2], [right, bottom]: [f64; 2]) {
        if [left, top, right, bottom].iter().any(|c| c.is_nan()) {
            self.add_all();
        }
        let columns = first_center(left)..last_center(right, self.width);
        for row in first_center(top)..last_center(bottom, self.height) {
            if !columns.is_empty() {
                self.marks[row * self.width..][columns.clone()].fill(true);
            }
        }
    }

    /// Adds those that outlines in the same picture enclose.
    pub fn add_enclosed(&mut self, outlines: &Winding) {
        for (mark, number) in self.marks.iter_mut().zip(outlines.numbers()) {
            *mark |= number != 0;
        }
    }

    /// Adds all pixels.
    pub fn add_all(&mut self) {
        self.marks.fill(true);
    }

    /// Whether a pixel, `y * width + x`, is one of them.
    ///
    /// # Panics
    ///
    /// Panics if it lies outside the picture.
    #[must_use]
    pub fn contain(&self, pixel: usize) -> bool {
        self.marks[pixel]
    }
}

/// The first pixel, at most `end`, whose centre lies after a coordinate.
fn last_center(coordinate: f64, end: usize) -> usize {
    ((coordinate + 0.5).floor().max(0.0) as usize).min(end)
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    const SIZE: (usize, usize) = (32, 24);

    fn centers() -> impl Iterator<Item = [f64; 2]> {
        (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| [x as f64 + 0.5, y as f64 + 0.5]))
    }

    /// By the definition: the angle that the outline turns about the point, in full turns. With y
    /// down, a positive angle is clockwise.
    fn turns(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> i32 {
        let next = outline.iter().cycle().skip(1);
        let angle: f64 = outline
            .iter()
            .zip(next)
            .map(|(a, b)| {
                let [a, b] = [[a[0] - x, a[1] - y], [b[0] - x, b[1] - y]];
                (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
            })
            .sum();
        (-angle / std::f64::consts::TAU).round() as i32
    }

    #[test]
    fn the_number_is_that_of_the_turns() {
        let mut random = Random(31);
        let mut most = 0;
        for _ in 0..300 {
            // Reaching beyond all sides of the picture; crossing itself.
            let outline: Vec<[f64; 2]> =
                (0..7).map(|_| [random.real(-40.0, 70.0), random.real(-40.0, 60.0)]).collect();
            let mut winding = Winding::new(SIZE);
            let next = outline.iter().cycle().skip(1);
            for (number, (&from, &to)) in outline.iter().zip(next).enumerate() {
                // The same edge in either form.
                if number % 2 == 0 {
                    winding.add(from, to, 1);
                } else {
                    winding.add(to, from, -1);
                }
            }
            for (number, center) in winding.numbers().into_iter().zip(centers()) {
                assert_eq!(number, turns(&outline, center), "{center:?} in {outline:?}");
                most = most.max(number.abs());
            }
        }
        assert!(most >= 2, "no outline runs round a pixel twice");
    }

    #[test]
    fn a_counter_clockwise_triangle_has_1_and_a_missing_edge_counts_nothing() {
        let mut winding = Winding::new((4, 3));
        let [a, b, c] = [[1.0, -1.0], [1.0, 9.0], [9.0, -1.0]];
        winding.add(a, b, 1);
        winding.add(b, c, 1);
        winding.add(c, a, 1);
        assert_eq!(winding.numbers(), [0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1]);
        winding.add([f64::NAN, 0.0], [3.0, 3.0], 1);
        winding.add([2.0, f64::INFINITY], [3.0, 3.0], 1);
        assert_eq!(winding.numbers()[..4], [0, 1, 1, 1]);
    }

    /// Whether a segment meets the square of half-side `reach` about a point: Liang and Barsky, "A
    /// new concept and method for line clipping", ACM Transactions on Graphics 3(1), 1984.
    fn meets(a: [f64; 2], b: [f64; 2], center: [f64; 2], reach: f64) -> bool {
        let (mut from, mut to) = (0f64, 1f64);
        for axis in 0..2 {
            let (start, along) = (a[axis] - center[axis], b[axis] - a[axis]);
            for side in [1.0, -1.0] {
                // side * (start + t * along) <= reach
                let (slack, rate) = (reach - side * start, side * along);
                if rate > 0.0 {
                    to = to.min(slack / rate);
                } else if rate < 0.0 {
                    from = from.max(slack / rate);
                } else if slack < 0.0 {
                    return false;
                }
            }
        }
        from <= to
    }

    #[test]
    fn pixels_close_to_a_segment_are_those_whose_square_it_meets() {
        let mut random = Random(32);
        let mut marked = 0;
        for number in 0..2_000 {
            let mut point = || [random.real(-20.0, 50.0), random.real(-20.0, 40.0)];
            let (a, mut b) = (point(), point());
            match number % 4 {
                0 => b[0] = a[0],
                1 => b[1] = a[1],
                _ => {}
            }
            let reach = [0.0, 0.004, 0.3, 5.0][number / 4 % 4];
            let mut close = Pixels::none(SIZE);
            close.add_close_to(a, b, reach);
            for (pixel, center) in centers().enumerate() {
                // At a corner of the square either answer is right.
                let [surely, maybe] = [-1e-9, 1e-9].map(|more| meets(a, b, center, reach + more));
                let is_close = close.contain(pixel);
                assert!(!surely || is_close, "{center:?} misses {a:?} {b:?} {reach}");
                assert!(maybe || !is_close, "{center:?} is not close to {a:?} {b:?} {reach}");
                marked += usize::from(is_close);
            }
        }
        assert!(marked > 50_000, "{marked}");
    }

    #[test]
    fn a_rectangle_marks_the_centers_in_it() {
        let mut close = Pixels::none((4, 4));
        close.add_between([1.5, -7.0], [2.4, 1.5]);
        close.add_between([9.0, 0.0], [11.0, 4.0]);
        let marked: Vec<usize> = (0..16).filter(|&pixel| close.contain(pixel)).collect();
        assert_eq!(marked, [1, 5]);
        close.add_between([0.0, 0.0], [f64::NAN, 1.0]);
        assert!((0..16).all(|pixel| close.contain(pixel)));
    }

    #[test]
    fn numbers_that_are_not_finite_mark_all() {
        for (place, reach) in [(f64::NAN, 1.0), (f64::INFINITY, 1.0), (3.0, f64::INFINITY)] {
            let mut close = Pixels::none((3, 3));
            close.add_close_to([place, 2.0], [1.0, 2.0], reach);
            assert!((0..9).all(|pixel| close.contain(pixel)));
        }
        let mut close = Pixels::none((3, 3));
        close.add_close_to([-1e300, 1.0], [-1e300, 2.0], 1e300);
        close.add_close_to([1e300, 1.0], [1e300, 2.0], 1.0);
        close.add_close_to([1.0, -1e300], [2.0, -1e300], 1.0);
        assert!((0..9).all(|pixel| !close.contain(pixel) || pixel % 3 == 0));
    }
}
