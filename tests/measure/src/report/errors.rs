//! How far a picture is off the true one.

use host_tools::check::Truth;
use serde::{Deserialize, Serialize};

/// The error of a choice over all pixels of all frames that show the model, in the picture or in
/// truth. In steps of 8 bits of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Errors {
    /// The root of the mean square over pixels and channels.
    pub(super) rms: f64,
    /// The same over pixels that the model covers as a whole: no outline.
    pub(super) rms_inside: f64,
    /// Of the means of squares of 8 by 8 pixels that the model covers as a whole: what an eye sees
    /// of dithering from far enough away.
    pub(super) rms_squares: f64,
    /// What 99.9 % of the pixels' worst channels do not exceed.
    pub(super) p999: f64,
    /// The worst channel of all pixels.
    pub(super) max: f64,
}

/// A picture of a choice: red, green and blue of each pixel, row by row.
pub(super) type Picture = Vec<u8>;

impl Errors {
    /// Of frames against the true ones. Returns `None` if nothing is seen in any.
    pub(super) fn of<'a>(
        frames: impl IntoIterator<Item = (&'a Picture, &'a Truth)>,
    ) -> Option<Self> {
        let (mut all, mut inside) = (Mean::default(), Mean::default());
        let mut squares = Mean::default();
        let mut worst = Vec::new();
        for (picture, truth) in frames {
            let picture = picture.as_chunks::<3>().0;
            add_squares(picture, truth, &mut squares);
            let pixels = picture.iter().zip(&truth.colors).zip(&truth.coverage);
            for ((shown, exact), &coverage) in pixels {
                if coverage == 0.0 && *shown == [0; 3] {
                    continue;
                }
                let off = [0, 1, 2].map(|i| (f64::from(shown[i]) - exact[i]).abs());
                off.iter().for_each(|&off| all.add(off * off));
                if coverage == 1.0 {
                    off.iter().for_each(|&off| inside.add(off * off));
                }
                worst.push(off.into_iter().fold(0.0, f64::max));
            }
        }
        worst.sort_by(f64::total_cmp);
        let max = *worst.last()?;
        let place = (worst.len() * 999).div_ceil(1000).max(1) - 1;
        Some(Self {
            rms: all.mean().sqrt(),
            rms_inside: inside.mean().sqrt(),
            rms_squares: squares.mean().sqrt(),
            p999: worst[place],
            max,
        })
    }

    /// The peak signal-to-noise ratio in decibels; infinite without an error.
    pub(super) fn psnr_db(&self) -> f64 {
        20.0 * (255.0 / self.rms).log10()
    }
}

/// Adds the squared errors of the means of whole squares.
fn add_squares(picture: &[[u8; 3]], truth: &Truth, squares: &mut Mean) {
    const SIDE: usize = 8;
    let [width, height] = truth.size;
    for (top, left) in (0..height / SIDE).flat_map(|y| (0..width / SIDE).map(move |x| (y, x))) {
        let rows = (0..SIDE).map(|row| (top * SIDE + row) * width + left * SIDE);
        let places: Vec<_> = rows.flat_map(|first| first..first + SIDE).collect();
        if places.iter().any(|&place| truth.coverage[place] < 1.0) {
            continue;
        }
        let sums = places.iter().fold([0.0; 3], |sums: [f64; 3], &place| {
            let off = |i: usize| f64::from(picture[place][i]) - truth.colors[place][i];
            [0, 1, 2].map(|i| sums[i] + off(i))
        });
        for mean in sums.map(|sum| sum / places.len() as f64) {
            squares.add(mean * mean);
        }
    }
}

/// How a scene that moves changes otherwise than it does in exact pictures: the root of the mean
/// square of the difference of both changes, in steps of 8 bits, over the channels of all pixels
/// that show the model in any picture. Each frame is its pictures before and after, and the exact
/// ones.
///
/// The exact pictures are to have as many samples a pixel: what these miss of the model changes in
/// both, and does not count.
pub(super) fn shimmer<'a>(
    frames: impl IntoIterator<Item = ([&'a Picture; 2], [&'a Truth; 2])>,
) -> f64 {
    let mut all = Mean::default();
    for (shown, exact) in frames {
        let [before, after] = shown.map(|picture| picture.as_chunks::<3>().0);
        for (i, pixel) in before.iter().zip(after).enumerate() {
            let is_seen = exact.iter().any(|truth| truth.coverage[i] > 0.0);
            if !is_seen && pixel == (&[0; 3], &[0; 3]) {
                continue;
            }
            for channel in 0..3 {
                let [from, to] = [pixel.0, pixel.1].map(|color| f64::from(color[channel]));
                let [exact_from, exact_to] = exact.map(|truth| truth.colors[i][channel]);
                all.add(((to - from) - (exact_to - exact_from)).powi(2));
            }
        }
    }
    all.mean().sqrt()
}

/// The root of the mean square difference of two true pictures where either shows the model.
pub(super) fn between(a: &Truth, b: &Truth) -> f64 {
    let mut all = Mean::default();
    for (i, (a_color, b_color)) in a.colors.iter().zip(&b.colors).enumerate() {
        if a.coverage[i] + b.coverage[i] > 0.0 {
            a_color.iter().zip(b_color).for_each(|(a, b)| all.add((a - b) * (a - b)));
        }
    }
    all.mean().sqrt()
}

#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    sum: f64,
    count: usize,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
    }

    /// 0 of no values.
    fn mean(&self) -> f64 {
        self.sum / self.count.max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_count_pixels_that_show_the_model_in_either_picture() {
        let truth = Truth {
            size: [4, 1],
            colors: vec![[0.0; 3], [10.0; 3], [100.0, 50.0, 0.0], [0.0; 3]],
            coverage: vec![0.0, 0.5, 1.0, 0.0],
        };
        let picture = vec![0, 0, 0, 10, 10, 13, 104, 50, 0, 0, 12, 0];
        let found = Errors::of([(&picture, &truth)]).unwrap();
        // Nine channels: 3, 4 and 12 off; the first pixel shows nothing in both.
        assert!((found.rms - (169.0f64 / 9.0).sqrt()).abs() < 1e-12);
        assert!((found.rms_inside - (16.0f64 / 3.0).sqrt()).abs() < 1e-12);
        assert_eq!((found.p999, found.max), (12.0, 12.0));
        assert!(
            Errors::of([(
                &vec![0; 3],
                &Truth { size: [1, 1], colors: vec![[0.0; 3]], coverage: vec![0.0] }
            )])
            .is_none()
        );
    }

    #[test]
    fn errors_of_squares_are_those_of_their_means() {
        // Two squares; the model covers the right one but for a corner.
        let mut coverage = vec![1.0; 128];
        coverage[15] = 0.5;
        let truth = Truth { size: [16, 8], colors: vec![[10.0; 3]; 128], coverage };
        // Errors of 4 and -2 in turn: a mean of 1.
        let picture: Vec<u8> = (0..384).map(|i| if i / 3 % 2 == 0 { 14 } else { 8 }).collect();
        let found = Errors::of([(&picture, &truth)]).unwrap();
        assert!((found.rms_squares - 1.0).abs() < 1e-12);
        assert!((found.rms - 10.0f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn shimmer_is_what_changes_otherwise_than_it_should() {
        let truth = |colors: [f64; 3]| Truth {
            size: [3, 1],
            colors: colors.map(|color| [color; 3]).into(),
            coverage: colors.map(|color| f64::from(color > 0.0)).into(),
        };
        let exact = [truth([50.0, 80.0, 0.0]), truth([60.0, 80.0, 0.0])];
        let of = |colors: [[u8; 3]; 2]| {
            let shown = colors.map(|colors| colors.map(|color| [color; 3]).concat());
            shimmer([(shown.each_ref(), exact.each_ref())])
        };
        // A constant error does not shimmer; the last pixel shows nothing in any picture.
        assert!(of([[70, 10, 0], [80, 10, 0]]).abs() < 1e-12);
        // 10 less than it should, and 4 more.
        assert!((of([[50, 80, 0], [50, 84, 0]]) - 58.0f64.sqrt()).abs() < 1e-12);
        // The first pixel is not drawn, and the exact one changes by 10: two pixels.
        assert!((of([[0, 80, 0], [0, 80, 0]]) - 50.0f64.sqrt()).abs() < 1e-12);
        // The last pixel is seen before only: three pixels, 0, 0 and 6 off.
        assert!((of([[50, 80, 6], [60, 80, 0]]) - 12.0f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn the_quantile_leaves_out_a_thousandth() {
        let truth =
            Truth { size: [2000, 1], colors: vec![[0.0; 3]; 2000], coverage: vec![1.0; 2000] };
        let mut picture = vec![1; 6000];
        picture[0] = 200;
        picture[3] = 100;
        picture[6] = 50;
        let found = Errors::of([(&picture, &truth)]).unwrap();
        assert_eq!((found.p999, found.max), (50.0, 200.0));
    }
}
