//! What a display of few colours shows: rounding to steps, and ordered dithering.

/// The steps of a display's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Steps {
    /// Of one gray: how many there are.
    Gray(u32),
    /// Of red, green and blue.
    Rgb([u32; 3]),
}

/// A display that rounds colours to its steps, by the place of a pixel or everywhere alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Display {
    /// Its steps, from black to white in equal distances of stored values.
    pub steps: Steps,
    /// The rows of the matrix of thresholds, a power of two; `None` rounds to the nearest step.
    pub dither: Option<u32>,
}

/// Whether means of light are kept instead of means of stored values: with up to four grays.
const fn is_in_light(steps: Steps) -> bool {
    matches!(steps, Steps::Gray(2..=4))
}

impl Display {
    /// Returns what a pixel shows for a colour from 0 to 255.
    ///
    /// A gray is 77/256 of red, 150/256 of green and 29/256 of blue: ITU-R BT.601 to eight bits.
    #[must_use]
    pub fn shown(&self, color: [f64; 3], [column, row]: [usize; 2]) -> [f64; 3] {
        let threshold = self.dither.map(|size| threshold(size, [column, row]));
        match self.steps {
            Steps::Gray(count) => [self.step(luma(color), count, threshold); 3],
            Steps::Rgb(counts) => [0, 1, 2].map(|i| self.step(color[i], counts[i], threshold)),
        }
    }

    /// A value as one of `count` steps, both from 0 to 255.
    ///
    /// A value that lies a fraction f of the way from a step to the next becomes the next one where
    /// f and the threshold sum to 1 or more. Without thresholds, that is where f is 1/2 or more.
    fn step(&self, value: f64, count: u32, threshold: Option<f64>) -> f64 {
        let last = f64::from(count - 1);
        let lower = (value * last / 255.0).floor().clamp(0.0, last);
        let [below, above] = [lower, (lower + 1.0).min(last)].map(|step| step * 255.0 / last);
        let of = |value: f64| {
            if threshold.is_some() && is_in_light(self.steps) { light(value) } else { value }
        };
        let height = of(above) - of(below);
        let fraction = if height > 0.0 { (of(value) - of(below)) / height } else { 0.0 };
        if fraction + threshold.unwrap_or(0.5) >= 1.0 { above } else { below }
    }

    /// Returns what means are kept of, from 0 to 1: of a gray's light or stored value, or of stored
    /// values of red, green and blue.
    #[must_use]
    pub fn measured(&self, color: [f64; 3]) -> [f64; 3] {
        match self.steps {
            Steps::Gray(_) if is_in_light(self.steps) => [light(luma(color)); 3],
            Steps::Gray(_) => [luma(color) / 255.0; 3],
            Steps::Rgb(_) => color.map(|channel| channel / 255.0),
        }
    }
}

/// How bright a colour is, from 0 to 255.
#[must_use]
pub fn luma([red, green, blue]: [f64; 3]) -> f64 {
    (77.0 * red + 150.0 * green + 29.0 * blue) / 256.0
}

/// The light of a stored value from 0 to 255, as a part of that of white: the curve of sRGB
/// (IEC 61966-2-1).
fn light(value: f64) -> f64 {
    let value = value / 255.0;
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// The threshold of a pixel: its number in the matrix and a half, of all numbers (Bayer, "An
/// optimum method for two-level rendition of continuous-tone pictures", ICC 1973).
fn threshold(size: u32, place: [usize; 2]) -> f64 {
    let [x, y] = place.map(|c| c as u32 % size);
    (f64::from(number(size, x, y)) + 0.5) / f64::from(size * size)
}

/// The number in the matrix of `size` rows. The matrix of one number is 0. That of twice the size
/// consists of four of the smaller one, times 4, plus 0 and 2, and below them 3 and 1.
fn number(size: u32, x: u32, y: u32) -> u32 {
    if size == 1 {
        return 0;
    }
    let half = size / 2;
    let quarter = [[0, 2], [3, 1]][(y / half) as usize][(x / half) as usize];
    4 * number(half, x % half, y % half) + quarter
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE_BIT: Display = Display { steps: Steps::Gray(2), dither: Some(8) };

    #[test]
    fn the_matrix_of_four_rows_is_bayer_s() {
        let rows = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];
        for (y, row) in (0..).zip(rows) {
            for (x, wanted) in (0..).zip(row) {
                assert_eq!(number(4, x, y), wanted, "({x}, {y})");
            }
        }
        let mut all: Vec<_> = (0..64).map(|i| number(8, i % 8, i / 8)).collect();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..64));
    }

    /// A value of 188 has half the light of white, one of 128 a fifth.
    #[test]
    fn one_bit_shows_light() {
        for (value, pixels) in [(0.0, 0), (128.0, 14), (187.516, 32), (255.0, 64)] {
            let places = (0..64).map(|i| [i % 8, i / 8]);
            let lit = places.filter(|&place| ONE_BIT.shown([value; 3], place)[0] == 255.0).count();
            assert_eq!(lit, pixels, "{value}");
        }
    }

    #[test]
    fn steps_are_the_nearest_without_thresholds() {
        let display = |steps| Display { steps, dither: None };
        let shown = |steps, color| display(steps).shown(color, [3, 5]);
        assert_eq!(shown(Steps::Gray(2), [127.4; 3]), [0.0; 3]);
        assert_eq!(shown(Steps::Gray(2), [127.6; 3]), [255.0; 3]);
        assert_eq!(shown(Steps::Gray(4), [130.0; 3]), [170.0; 3]);
        let steps = Steps::Rgb([8, 8, 4]);
        assert_eq!(shown(steps, [54.0, 55.0, 42.0]), [1.0, 2.0, 0.0].map(|c| c * 255.0 / 7.0));
        assert_eq!(shown(steps, [255.0, 0.0, 255.0]), [255.0, 0.0, 255.0]);
    }

    #[test]
    fn green_is_the_brightest_channel() {
        assert_eq!(luma([255.0; 3]), 255.0);
        assert!(luma([0.0, 255.0, 0.0]) > luma([255.0, 0.0, 255.0]));
    }
}
