//! Which pixels a line owns: the diamond-exit rule.
//!
//! Vulkan specification, "Bresenham Line Segment Rasterization", which is that of OpenGL (4.6 core
//! profile, section 14.5.1): a pixel with its centre at c has the open diamond of the points p with
//! |p.x - c.x| + |p.y - c.y| < 1/2. A segment owns the pixels whose diamonds it meets, but for the
//! one that its end lies in. So lines that continue each other share no pixel at the joint, unless
//! they turn back into it.
//!
//! Where an end lies on the border of a diamond, both ends are moved by (-e, -e^2) for an e that is
//! smaller than any number. Numbers here are polynomials in e with integers before the powers, so
//! that every comparison is exact.
//!
//! A line of several pixels in width is a line of one, moved by (w - 1) / 2 against its minor axis,
//! of whose pixels each is repeated w times along that axis.

/// A polynomial in a positive number that is smaller than any other: the coefficients from the
/// constant up, of which the first that differ tell the greater one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Infinitesimal([i64; 5]);

impl Infinitesimal {
    const ZERO: Self = Self([0; 5]);

    fn combined(&self, other: &Self, by: impl Fn(i64, i64) -> i64) -> Self {
        Self(std::array::from_fn(|i| by(self.0[i], other.0[i])))
    }

    fn plus(&self, other: &Self) -> Self {
        self.combined(other, |a, b| a + b)
    }

    fn minus(&self, other: &Self) -> Self {
        self.combined(other, |a, b| a - b)
    }

    /// The product of two of at most the second degree.
    fn times(&self, other: &Self) -> Self {
        let mut product = [0; 5];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate().filter(|(j, _)| i + j < 5) {
                product[i + j] += a * b;
            }
        }
        Self(product)
    }
}

/// A line on the screen from its start to its end, in sub-pixels, of which a pixel has
/// 2^`subpixel_bits`.
///
/// No coordinate is over 2^26 from 0, so that products of three differences fit 64 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    /// Start and end.
    pub ends: [[i64; 2]; 2],
    /// At least 1.
    pub subpixel_bits: u32,
    /// In pixels, at least 1.
    pub width: u32,
}

impl Line {
    /// The axis along which it is longer: 0 for x, 1 for y. With both alike it is x.
    #[must_use]
    pub fn major(&self) -> usize {
        let [from, to] = self.ends;
        usize::from(to[0].abs_diff(from[0]) < to[1].abs_diff(from[1]))
    }

    /// Whether it owns the pixel of a column and a row.
    #[must_use]
    pub fn owns(&self, pixel: [i64; 2]) -> bool {
        let minor = 1 - self.major();
        let half = 1i64 << (self.subpixel_bits - 1);
        let moved = self.ends.map(|mut end| {
            end[minor] -= (i64::from(self.width) - 1) * half;
            end
        });
        (0..i64::from(self.width)).any(|repeat| {
            let mut first = pixel;
            first[minor] -= repeat;
            exits(moved, first, self.subpixel_bits)
        })
    }

    /// How far along the line the centre of a pixel lies by its coordinate on the major axis: 0 at
    /// the start, 1 at the end. A centre before the start has the start's values.
    #[must_use]
    pub fn part(&self, pixel: [i64; 2]) -> f64 {
        let (axis, [from, to]) = (self.major(), self.ends);
        let half = 1i64 << (self.subpixel_bits - 1);
        let center = (pixel[axis] << self.subpixel_bits) + half;
        ((center - from[axis]) as f64 / (to[axis] - from[axis]) as f64).clamp(0.0, 1.0)
    }
}

/// Whether a segment meets the diamond of a pixel and does not end in it.
fn exits([from, to]: [[i64; 2]; 2], pixel: [i64; 2], bits: u32) -> bool {
    let half = 1i64 << (bits - 1);
    // From the centre, with the ends moved.
    let place = |end: [i64; 2]| {
        [0, 1].map(|axis| {
            let mut c = [end[axis] - (pixel[axis] << bits) - half, 0, 0, 0, 0];
            c[axis + 1] = -1;
            Infinitesimal(c)
        })
    };
    let (from, to) = (place(from), place(to));
    // The distances from the diamond's four sides, positive within: 1/2 -+ x -+ y.
    let distances = |[x, y]: [Infinitesimal; 2]| {
        let size = Infinitesimal([half, 0, 0, 0, 0]);
        [
            size.minus(&x).minus(&y),
            size.minus(&x).plus(&y),
            size.plus(&x).minus(&y),
            size.plus(&x).plus(&y),
        ]
    };
    let (starts, ends) = (distances(from), distances(to));
    if ends.iter().all(|end| *end > Infinitesimal::ZERO) {
        return false;
    }
    // The part of the way on which all four are positive: it begins after all of `after` and ends
    // before all of `before`, as quotients with positive divisors.
    let (mut after, mut before) = (vec![], vec![]);
    for (start, end) in starts.iter().zip(&ends) {
        match (*start > Infinitesimal::ZERO, *end > Infinitesimal::ZERO) {
            (true, true) => {}
            (false, false) => return false,
            (true, false) => before.push((*start, start.minus(end))),
            (false, true) => after.push((Infinitesimal::ZERO.minus(start), end.minus(start))),
        }
    }
    after.iter().all(|(enter, length)| {
        before.iter().all(|(leave, whole)| enter.times(whole) < leave.times(length))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The owned pixels of a line in sixteenths, row by row.
    fn owned(from: [i64; 2], to: [i64; 2]) -> Vec<[i64; 2]> {
        let line = Line { ends: [from, to], subpixel_bits: 4, width: 1 };
        let pixels = (-4..12).flat_map(|row| (-4..12).map(move |column| [column, row]));
        pixels.filter(|pixel| line.owns(*pixel)).collect()
    }

    #[test]
    fn a_line_owns_the_diamonds_that_it_leaves() {
        // From centre to centre: without the last one, whichever way it runs.
        assert_eq!(owned([8, 8], [56, 8]), [[0, 0], [1, 0], [2, 0]]);
        assert_eq!(owned([56, 8], [8, 8]), [[1, 0], [2, 0], [3, 0]]);
        assert_eq!(owned([8, 8], [8, 40]), [[0, 0], [0, 1]]);
        // The diagonal.
        assert_eq!(owned([8, 8], [40, 40]), [[0, 0], [1, 1]]);
        // It begins beyond the centre but in the diamond, and ends before the next diamond.
        assert_eq!(owned([12, 8], [16, 4]), [[0, 0]]);
        // Within one diamond, in no diamond, and of no length.
        assert_eq!(owned([6, 8], [12, 8]), [[0i64; 2]; 0]);
        assert_eq!(owned([15, 1], [17, 1]), [[0i64; 2]; 0]);
        assert_eq!(owned([15, 8], [15, 8]), [[0i64; 2]; 0]);
    }

    /// Along the border between two rows both ends move up; along that between two columns, to the
    /// left.
    #[test]
    fn a_line_between_pixels_has_one_side() {
        assert_eq!(owned([8, 16], [40, 16]), [[0, 0], [1, 0]]);
        assert_eq!(owned([16, 8], [16, 40]), [[0, 0], [0, 1]]);
        // Along the borders of diamonds.
        assert_eq!(owned([8, 0], [40, 32]), [[0, 0], [1, 1]]);
        assert_eq!(owned([8, 48], [40, 16]), [[1, 1], [0, 2]]);
    }

    #[test]
    fn wide_lines_repeat_their_pixels() {
        let wide =
            |width, pixel| Line { ends: [[8, 40], [40, 40]], subpixel_bits: 4, width }.owns(pixel);
        for (width, rows) in [(1, 2..3), (2, 1..3), (3, 1..4), (4, 0..4)] {
            for row in -1..7 {
                for column in -1..4 {
                    let expected = rows.contains(&row) && (0..2).contains(&column);
                    assert_eq!(wide(width, [column, row]), expected, "{width} {column} {row}");
                }
            }
        }
    }

    #[test]
    fn values_follow_the_major_axis_and_stay_within_the_ends() {
        let line = Line { ends: [[12, 8], [44, 24]], subpixel_bits: 4, width: 1 };
        assert_eq!(line.part([0, 0]), 0.0);
        assert_eq!(line.part([1, 0]), 12.0 / 32.0);
        assert_eq!(line.part([1, 5]), 12.0 / 32.0);
        assert_eq!(line.part([4, 0]), 1.0);
    }
}
