//! Differences, in numbers.

use super::FixedPicture;
use crate::reference::{Camera, DepthFormat, Picture};

/// How far a fixed-point picture is off a reference.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Deviation {
    /// Pixels that the fixed-point picture covers.
    pub pixels: usize,
    /// Pixels that only one of the pictures covers.
    pub coverage_mismatches: usize,
    /// The largest difference of depth in units of the stored format, over pixels that both cover.
    pub depth_max_ulp: f64,
    /// The root of the mean of its square.
    pub depth_rms_ulp: f64,
    /// The largest difference of a colour channel in 8-bit steps, over pixels that both cover.
    pub color_max_error: f64,
    /// The peak signal-to-noise ratio over the whole picture; `None` if the pictures are equal.
    pub psnr_db: Option<f64>,
}

/// The fixed-point picture and the fixed-point vertices against a reference.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Comparison {
    /// Of the pictures.
    #[cfg_attr(feature = "cli", serde(flatten))]
    pub deviation: Deviation,
    /// The largest distance in x or y, in pixels, by which a vertex lies off its exact place.
    pub vertex_error_max_px: f64,
    /// How long the fixed-point core takes on this machine, in milliseconds.
    pub fixed_ms: f64,
    /// How long the reference takes on this machine, in milliseconds.
    pub reference_ms: f64,
}

/// Both comparisons.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Outcome {
    /// Against the reference on the core's own vertices.
    pub arithmetic: Comparison,
    /// Against the reference from the OBJ file's own numbers.
    pub end_to_end: Comparison,
}

/// How far the arithmetic may be off. The bounds follow from the number formats and hold for every
/// model.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Bounds {
    /// Integer edge functions are exact.
    pub coverage_mismatches: usize,
    /// Rounding to the stored format takes half a unit on both sides.
    pub depth_max_ulp: f64,
    /// The level of 256 takes half a step, rounding to 8 bits on both sides the rest.
    pub color_max_error: f64,
}

impl Bounds {
    /// No pixel, 1 unit and 1 step.
    pub const ARITHMETIC: Self =
        Self { coverage_mismatches: 0, depth_max_ulp: 1.0, color_max_error: 1.0 };
}

impl Deviation {
    /// Whether it keeps the bounds.
    #[must_use]
    pub fn is_within(&self, bounds: &Bounds) -> bool {
        self.coverage_mismatches <= bounds.coverage_mismatches
            && self.depth_max_ulp <= bounds.depth_max_ulp
            && self.color_max_error <= bounds.color_max_error
    }
}

impl Outcome {
    /// Whether the arithmetic keeps its bounds.
    #[must_use]
    pub fn is_within(&self, bounds: &Bounds) -> bool {
        self.arithmetic.deviation.is_within(bounds)
    }

    /// Numbers by which frames compare: the worse frame has the larger. First whether a bound is
    /// exceeded, then coverage, colour and depth of the arithmetic, then the same end to end.
    #[must_use]
    pub fn badness(&self) -> [f64; 7] {
        let exceeds = f64::from(u8::from(!self.is_within(&Bounds::ARITHMETIC)));
        let of = |c: &Comparison| {
            let found = &c.deviation;
            [found.coverage_mismatches as f64, found.color_max_error, found.depth_max_ulp]
        };
        let ([a, b, c], [d, e, f]) = (of(&self.arithmetic), of(&self.end_to_end));
        [exceeds, a, b, c, d, e, f]
    }
}

/// How one pixel differs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Difference {
    /// Neither picture covers it.
    Background,
    /// Only the fixed-point picture covers it.
    OnlyFixed,
    /// Only the reference covers it.
    OnlyReference {
        /// The reference's colour.
        color: [f64; 3],
    },
    /// Both cover it.
    Both {
        /// The largest difference of a channel in 8-bit steps.
        color_error: f64,
        /// The difference of depth in units of the stored format.
        depth_error: f64,
        /// The reference's colour.
        color: [f64; 3],
    },
}

/// Compares the pixel (x, y) with a reference whose depth is from 0 to 1.
///
/// Layers within one unit of depth of the nearest are equal in the stored format, so each of them
/// is right: the pixel is compared with the one whose colour is closest.
pub(super) fn difference(
    fixed: &FixedPicture,
    [x, y]: [usize; 2],
    depth: DepthFormat,
    reference: &Picture,
) -> Difference {
    let pixel = fixed.pixels[y * reference.width() + x];
    let is_covered = pixel.depth != 0;
    let Some(nearest) = reference.nearest(x, y) else {
        return if is_covered { Difference::OnlyFixed } else { Difference::Background };
    };
    if !is_covered {
        return Difference::OnlyReference { color: nearest.color };
    }
    let front = depth.units(nearest.depth);
    let (color_error, depth_error, color) = reference
        .fragments(x, y)
        .iter()
        .map(|fragment| (depth.units(fragment.depth), fragment))
        .filter(|(units, _)| front - units <= 1.0)
        .map(|(units, fragment)| {
            // Both as the formats store them.
            let stored = depth.stored(units);
            let channel = |i: usize| (f64::from(pixel.color[i]) - fragment.color[i].round()).abs();
            let color_error = channel(0).max(channel(1)).max(channel(2));
            (color_error, (f64::from(pixel.depth) - stored).abs(), fragment.color)
        })
        .min_by(|a, b| (a.0, a.1).partial_cmp(&(b.0, b.1)).unwrap_or(std::cmp::Ordering::Equal))
        .unwrap_or((0.0, 0.0, nearest.color));
    Difference::Both { color_error, depth_error, color }
}

/// Compares a picture with a reference; see [`difference`].
pub(super) fn compare(fixed: &FixedPicture, reference: &Picture, depth: DepthFormat) -> Deviation {
    let [width, height] = fixed.size.map(|c| c as usize);
    let (mut pixels, mut coverage_mismatches, mut both) = (0, 0, 0);
    let (mut depth_max_ulp, mut color_max_error) = (0f64, 0f64);
    let (mut depth_squares, mut color_squares) = (0f64, 0f64);
    for y in 0..height {
        for x in 0..width {
            let pixel = fixed.pixels[y * width + x];
            pixels += usize::from(pixel.depth != 0);
            match difference(fixed, [x, y], depth, reference) {
                Difference::Background => {}
                Difference::OnlyFixed => {
                    coverage_mismatches += 1;
                    color_squares += squares(pixel.color, [0.0; 3]);
                }
                Difference::OnlyReference { color } => {
                    coverage_mismatches += 1;
                    color_squares += squares(pixel.color, color);
                }
                Difference::Both { color_error, depth_error, color } => {
                    both += 1;
                    color_max_error = color_max_error.max(color_error);
                    depth_max_ulp = depth_max_ulp.max(depth_error);
                    depth_squares += depth_error * depth_error;
                    color_squares += squares(pixel.color, color);
                }
            }
        }
    }
    let mean_square = color_squares / (3 * width * height) as f64;
    Deviation {
        pixels,
        coverage_mismatches,
        depth_max_ulp,
        depth_rms_ulp: (depth_squares / f64::from(both.max(1))).sqrt(),
        color_max_error,
        psnr_db: (mean_square > 0.0).then(|| 10.0 * (255.0 * 255.0 / mean_square).log10()),
    }
}

fn squares(color: [u8; 3], reference: [f64; 3]) -> f64 {
    let square = |i: usize| (f64::from(color[i]) - reference[i].round()).powi(2);
    square(0) + square(1) + square(2)
}

/// The largest distance in x or y between where the core places vertices and where the camera sees
/// their points.
pub(super) fn vertex_error(
    placed: &[Option<[f64; 2]>],
    points: &[[f64; 3]],
    camera: &Camera,
) -> f64 {
    let error = |(placed, point): (&Option<[f64; 2]>, &[f64; 3])| {
        placed.map_or(0.0, |[x, y]| {
            let exact = camera.to_screen(camera.to_view(*point));
            (x - exact.x).abs().max((y - exact.y).abs())
        })
    };
    placed.iter().zip(points).map(error).fold(0.0, f64::max)
}
