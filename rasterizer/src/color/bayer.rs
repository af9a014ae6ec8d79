//! Thresholds in the order of Bayer's matrices.

use super::linear::first_value_of;

/// The thresholds of ordered dithering in a square of `SIZE` pixels, 4 or 8, that is repeated over
/// the display (Bayer, *An optimum method for two-level rendition of continuous-tone pictures*,
/// 1973).
///
/// The matrix of two pixels is M = ((0, 2), (3, 1)), rows from the top. That of twice the size has
/// 4 times the smaller one in each quarter, plus the number of M for the quarter. With the number m
/// of a pixel in a matrix of n numbers, its threshold is t = (m + 1/2) / n, and a value that lies
/// between two steps of a format, a fraction f above the lower one, becomes the upper one where
/// f + t is 1 or more. Of the n pixels, those are n f, rounded to a whole number: over a square of
/// the matrix, the mean of an even colour is right within 1 / (2 n) of a step: 1/128 with 8 x 8
/// pixels, 1/32 with 4 x 4.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bayer<const SIZE: usize>;

impl<const SIZE: usize> Bayer<SIZE> {
    /// How many numbers the matrix has.
    const COUNT: u32 = {
        assert!(SIZE == 4 || SIZE == 8, "a matrix has 4 x 4 or 8 x 8 numbers");
        (SIZE * SIZE) as u32
    };

    /// Column and row of the least threshold, and of the greatest: what gives the same step at both
    /// is even.
    pub(crate) const EXTREMES: [[i32; 2]; 2] = [[0, 0], [0, SIZE as i32 - 1]];

    /// 255 t, cut off to a whole number.
    const STORED: &'static [[u8; SIZE]; SIZE] = &{
        let (mut table, mut i) = ([[0; SIZE]; SIZE], 0);
        while i < SIZE * SIZE {
            let (x, y) = (i % SIZE, i / SIZE);
            table[y][x] = (255 * (2 * Self::rank(x, y) + 1) / (2 * Self::COUNT)) as u8;
            i += 1;
        }
        table
    };

    /// The least values whose linear light is 1 - t or more.
    const LINEAR_OF_2: &'static [[u8; SIZE]; SIZE] = &Self::linear(0, 255);

    /// The same between 0 and 85, 85 and 170, and 170 and 255: the four steps of two bits.
    const LINEAR_OF_4: &'static [[[u8; SIZE]; SIZE]; 3] =
        &[Self::linear(0, 85), Self::linear(85, 170), Self::linear(170, 255)];

    /// The least values whose linear light is at least the share 1 - t of the way between that of
    /// two others.
    const fn linear(dark: usize, bright: usize) -> [[u8; SIZE]; SIZE] {
        let (mut table, mut i) = ([[0; SIZE]; SIZE], 0);
        while i < SIZE * SIZE {
            let (x, y) = (i % SIZE, i / SIZE);
            let t = (2 * Self::rank(x, y) + 1) as f64 / (2 * Self::COUNT) as f64;
            table[y][x] = first_value_of(1.0 - t, dark, bright);
            i += 1;
        }
        table
    }

    /// The number in the matrix. The lowest bits of column and row choose the quarter of the
    /// smallest matrix, whose numbers count most.
    const fn rank(x: usize, y: usize) -> u32 {
        let (mut rank, mut bit) = (0, 1);
        while bit < SIZE {
            let (x, y) = (x & bit != 0, y & bit != 0);
            rank = 4 * rank + 2 * (x != y) as u32 + y as u32;
            bit *= 2;
        }
        rank
    }

    /// The threshold of a pixel times 255, cut off to a whole number: for a
    /// [`Dither`](super::Dither) of your own. The step of a value from 0 to 255 among `most` + 1
    /// equal ones is (`most` value + threshold) / 255, cut off.
    #[inline(always)]
    #[must_use]
    pub const fn threshold(column: i32, row: i32) -> u8 {
        let [x, y] = Self::within(column, row);
        Self::STORED[y][x]
    }

    /// Whether a gray from 0 to 255 makes a pixel white of black and white, by its linear light.
    #[inline(always)]
    pub(super) const fn is_white(gray: u8, column: i32, row: i32) -> bool {
        let [x, y] = Self::within(column, row);
        gray >= Self::LINEAR_OF_2[y][x]
    }

    /// The step of four, 0 to 3, that a gray from 0 to 255 becomes by its linear light.
    #[inline(always)]
    pub(super) fn of_four(gray: u8, column: i32, row: i32) -> u8 {
        let [x, y] = Self::within(column, row);
        // 0 to 84, 85 to 169, 170 to 255: the steps lie at multiples of 85.
        let lower = (3 * u32::from(gray) + 2) >> 8;
        let threshold = Self::LINEAR_OF_4.get(lower as usize).map_or(0, |table| table[y][x]);
        lower as u8 + u8::from(gray >= threshold)
    }

    /// The place in the square.
    #[inline(always)]
    const fn within(column: i32, row: i32) -> [usize; 2] {
        let _: u32 = Self::COUNT;
        [column as usize & (SIZE - 1), row as usize & (SIZE - 1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matrices_are_bayer_s() {
        let four = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];
        for (y, row) in four.iter().enumerate() {
            for (x, &rank) in row.iter().enumerate() {
                assert_eq!(Bayer::<4>::rank(x, y), rank, "({x}, {y})");
                // The definition, from the smaller matrix.
                for (quarter, [dx, dy]) in [[0, 0], [4, 4], [4, 0], [0, 4]].into_iter().enumerate()
                {
                    let wanted = 4 * rank + quarter as u32;
                    assert_eq!(Bayer::<8>::rank(x + dx, y + dy), wanted, "({x}, {y})");
                }
            }
        }
    }

    #[test]
    fn the_extremes_are_found_where_they_are() {
        fn check<const SIZE: usize>() {
            let ranks =
                Bayer::<SIZE>::EXTREMES.map(|[x, y]| Bayer::<SIZE>::rank(x as usize, y as usize));
            assert_eq!(ranks, [0, Bayer::<SIZE>::COUNT - 1]);
        }
        check::<4>();
        check::<8>();
    }

    #[test]
    fn thresholds_repeat_over_all_of_the_plane() {
        for (column, row) in [(0, 0), (3, 5), (-1, -8), (i32::MIN, i32::MAX), (-100, 77)] {
            let near = |at: i32| at.rem_euclid(8) as usize;
            let rank = Bayer::<8>::rank(near(column), near(row));
            let wanted = (255.0 * (f64::from(rank) + 0.5) / 64.0).floor();
            assert_eq!(f64::from(Bayer::<8>::threshold(column, row)), wanted);
        }
    }

    #[test]
    fn four_steps_lie_at_multiples_of_85() {
        for column in 0..8 {
            for row in 0..8 {
                for step in 0..=3 {
                    assert_eq!(Bayer::<8>::of_four(85 * step, column, row), step);
                }
                assert!(!Bayer::<4>::is_white(0, column, row));
                assert!(Bayer::<4>::is_white(255, column, row));
            }
        }
    }
}
