//! Differences, in numbers.

use std::time::Duration;

use super::{DepthFormat, FixedPicture};
use crate::reference::{Camera, Picture};

/// How a fixed-point picture differs from a reference.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Comparison {
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
    /// The peak signal-to-noise ratio over the whole picture; nothing if the pictures are equal.
    pub psnr_db: Option<f64>,
    /// The largest distance in x or y, in pixels, by which a vertex lies off its exact place.
    pub vertex_error_max_px: f64,
    /// How long the fixed-point core took on this machine, in milliseconds.
    pub fixed_ms: f64,
    /// How long the reference took on this machine, in milliseconds.
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

/// How far the arithmetic may be off. These follow from the number formats, whatever the model.
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
    /// None, 1 and 1.
    pub const ARITHMETIC: Self =
        Self { coverage_mismatches: 0, depth_max_ulp: 1.0, color_max_error: 1.0 };
}

impl Outcome {
    /// Whether the arithmetic keeps its bounds.
    #[must_use]
    pub fn is_within(&self, bounds: &Bounds) -> bool {
        let found = &self.arithmetic;
        found.coverage_mismatches <= bounds.coverage_mismatches
            && found.depth_max_ulp <= bounds.depth_max_ulp
            && found.color_max_error <= bounds.color_max_error
    }

    /// Numbers that are larger for the worse of two frames: whether a bound is exceeded, then
    /// coverage, colour and depth, of the arithmetic first.
    #[must_use]
    pub fn badness(&self) -> [f64; 7] {
        let exceeds = f64::from(u8::from(!self.is_within(&Bounds::ARITHMETIC)));
        let of =
            |c: &Comparison| [c.coverage_mismatches as f64, c.color_max_error, c.depth_max_ulp];
        let ([a, b, c], [d, e, f]) = (of(&self.arithmetic), of(&self.end_to_end));
        [exceeds, a, b, c, d, e, f]
    }
}

/// A reference to compare with.
pub(super) struct Judge<'a> {
    /// Its picture.
    pub(super) picture: &'a Picture,
    /// How many units of the stored format its depth of 1 stands for.
    pub(super) depth_unit: f64,
    /// How far off the fixed-point vertices are from its own.
    pub(super) vertex_error_max_px: f64,
    /// How long it took.
    pub(super) time: Duration,
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

/// Compares the pixel (x, y) with a reference whose depth of 1 stands for `unit` units of the
/// stored format.
///
/// Where several layers lie within one unit of depth of the nearest, the stored format cannot tell
/// them apart, and either is right: the pixel is held against the one whose colour it comes closest
/// to.
pub(super) fn difference(
    fixed: &FixedPicture,
    [x, y]: [usize; 2],
    depth: DepthFormat,
    reference: &Picture,
    unit: f64,
) -> Difference {
    let pixel = fixed.pixels[y * reference.width() + x];
    let is_covered = pixel.depth != 0;
    let Some(nearest) = reference.nearest(x, y) else {
        return if is_covered { Difference::OnlyFixed } else { Difference::Background };
    };
    if !is_covered {
        return Difference::OnlyReference { color: nearest.color };
    }
    let (color_error, depth_error, color) = reference
        .fragments(x, y)
        .iter()
        .filter(|fragment| (nearest.depth - fragment.depth) * unit <= 1.0)
        .map(|fragment| {
            // Both as the formats store them.
            let stored = (fragment.depth * unit).round().clamp(1.0, depth.max());
            let channel = |i: usize| (f64::from(pixel.color[i]) - fragment.color[i].round()).abs();
            let color_error = channel(0).max(channel(1)).max(channel(2));
            (color_error, (f64::from(pixel.depth) - stored).abs(), fragment.color)
        })
        .min_by(|a, b| (a.0, a.1).partial_cmp(&(b.0, b.1)).unwrap_or(std::cmp::Ordering::Equal))
        .unwrap_or((0.0, 0.0, nearest.color));
    Difference::Both { color_error, depth_error, color }
}

/// Compares a picture with a reference.
pub(super) fn compare(
    fixed: &FixedPicture,
    fixed_time: Duration,
    depth: DepthFormat,
    judge: &Judge<'_>,
) -> Comparison {
    let [width, height] = fixed.size.map(|c| c as usize);
    let (mut pixels, mut coverage_mismatches, mut both) = (0, 0, 0);
    let (mut depth_max, mut depth_squares, mut color_max, mut color_squares) =
        (0f64, 0f64, 0f64, 0f64);
    for y in 0..height {
        for x in 0..width {
            let pixel = fixed.pixels[y * width + x];
            pixels += usize::from(pixel.depth != 0);
            match difference(fixed, [x, y], depth, judge.picture, judge.depth_unit) {
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
                    color_max = color_max.max(color_error);
                    depth_max = depth_max.max(depth_error);
                    depth_squares += depth_error * depth_error;
                    color_squares += squares(pixel.color, color);
                }
            }
        }
    }
    let mean_square = color_squares / (3 * width * height) as f64;
    Comparison {
        pixels,
        coverage_mismatches,
        depth_max_ulp: depth_max,
        depth_rms_ulp: (depth_squares / f64::from(both.max(1))).sqrt(),
        color_max_error: color_max,
        psnr_db: (mean_square > 0.0).then(|| 10.0 * (255.0 * 255.0 / mean_square).log10()),
        vertex_error_max_px: judge.vertex_error_max_px,
        fixed_ms: fixed_time.as_secs_f64() * 1e3,
        reference_ms: judge.time.as_secs_f64() * 1e3,
    }
}

fn squares(color: [u8; 3], reference: [f64; 3]) -> f64 {
    let square = |i: usize| (f64::from(color[i]) - reference[i].round()).powi(2);
    square(0) + square(1) + square(2)
}

/// The largest distance in x or y between where vertices were placed and where the camera sees the
/// points.
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
