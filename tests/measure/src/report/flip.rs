//! What an eye sees of an error, by FLIP (Andersson et al., *FLIP: A Difference Evaluator for
//! Alternating Images*, 2020): an optional feature, because it builds C++.

use host_tools::check::Truth;
use nv_flip::{FlipImageRgb8, FlipPool};

use super::errors::Picture;

/// The pixels in a degree of the viewer's eye, on a display of 320 pixels in 49 mm (2.4 inches)
/// from 40 cm away.
fn pixels_per_degree() -> f32 {
    nv_flip::pixels_per_degree(0.4, 320.0, 0.049)
}

/// The mean of FLIP's error over all pixels of all frames: 0 where no difference is seen, 1 between
/// black and white. Pixels without the model count, too.
pub(super) fn mean<'a>(frames: impl IntoIterator<Item = (&'a Picture, &'a Truth)>) -> f64 {
    let mut pool = FlipPool::new();
    for (shown, truth) in frames {
        let [width, height] = truth.size.map(|size| size as u32);
        let exact: Vec<u8> = truth.colors.iter().flatten().map(|c| c.round() as u8).collect();
        let [exact, shown] =
            [&exact, shown].map(|picture| FlipImageRgb8::with_data(width, height, picture));
        pool.update_with_image(&nv_flip::flip(exact, shown, pixels_per_degree()));
    }
    f64::from(pool.mean())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_equal_picture_has_no_error_and_a_larger_difference_a_larger_one() {
        const PIXELS: usize = 32 * 32;
        let truth =
            Truth { size: [32, 32], colors: vec![[100.0; 3]; PIXELS], coverage: vec![1.0; PIXELS] };
        let of = |level: u8| mean([(&vec![level; 3 * PIXELS], &truth)]);
        assert!(of(100) < 1e-6);
        assert!(of(100) < of(110) && of(110) < of(160));
    }
}
