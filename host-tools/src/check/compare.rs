//! Differences, in numbers.

use super::{Blended, DisplayOutcome, FixedPicture, NormalErrors, Places, Texels};
use crate::reference::{DepthFormat, Picture};

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
    /// Of the vertices.
    #[cfg_attr(feature = "cli", serde(flatten))]
    pub vertices: Vertices,
    /// Of the texture coordinates, on the core's own vertices; `None` without a texture.
    #[cfg_attr(feature = "cli", serde(flatten))]
    pub texels: Option<Texels>,
    /// Of the normals of pixels, on the core's own vertices; `None` without light at pixels.
    #[cfg_attr(feature = "cli", serde(flatten))]
    pub normals: Option<NormalErrors>,
    /// Of the blended layers, on the core's own vertices; `None` without blending.
    #[cfg_attr(feature = "cli", serde(flatten))]
    pub blend: Option<Blended>,
    /// How long the fixed-point core takes on this machine, in milliseconds.
    pub fixed_ms: f64,
    /// How long the reference takes on this machine, in milliseconds.
    pub reference_ms: f64,
}

/// How far vertices lie off their exact places.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Vertices {
    /// The largest distance in x or y, in pixels.
    pub vertex_error_max_px: f64,
    /// The vertex whose distance is the largest part of its bound; `None` if none is on the screen.
    pub vertex_worst: Option<VertexError>,
}

/// How far a vertex lies off its exact place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct VertexError {
    /// Its number in the tables.
    pub vertex: usize,
    /// The distance in x or y, in pixels.
    pub error_px: f64,
    /// How far it may be.
    pub bound_px: f64,
}

/// Both comparisons, and the pixels that are wrong by their place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Outcome {
    /// Against the reference on the core's own vertices.
    pub arithmetic: Comparison,
    /// Against the reference from the OBJ file's own faces.
    pub end_to_end: Comparison,
    /// Against the same, pixel by pixel, where vertices cannot be the cause.
    pub places: Places,
    /// What a display shows of it; `None` without one.
    #[cfg_attr(feature = "cli", serde(skip_serializing_if = "Option::is_none"))]
    pub display: Option<DisplayOutcome>,
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

impl Vertices {
    /// Whether each keeps its bound.
    #[must_use]
    pub fn are_within(&self) -> bool {
        self.out_of_bounds().is_none()
    }

    /// The vertex that exceeds its bound the most.
    #[must_use]
    pub fn out_of_bounds(&self) -> Option<VertexError> {
        self.vertex_worst.filter(|worst| worst.error_px > worst.bound_px)
    }
}

impl Comparison {
    /// Whether the picture keeps the bounds, and each vertex, each texture coordinate, each normal
    /// and each blended colour its own.
    #[must_use]
    pub fn is_within(&self, bounds: &Bounds) -> bool {
        self.deviation.is_within(bounds)
            && self.vertices.are_within()
            && self.texels.is_none_or(|texels| texels.are_within())
            && self.normals.is_none_or(|normals| normals.are_within())
            && self.blend.is_none_or(|blend| blend.is_within(bounds.color_max_error))
    }
}

impl Outcome {
    /// Whether the arithmetic keeps its bounds, each vertex and texture coordinate its own, no
    /// pixel is wrong by its place, and a display shows the right steps.
    #[must_use]
    pub fn is_within(&self, bounds: &Bounds) -> bool {
        self.arithmetic.is_within(bounds)
            && self.end_to_end.vertices.are_within()
            && self.places.wrong == 0
            && self.display.is_none_or(|display| display.is_within())
    }

    /// Whether one of the pictures covers a pixel.
    #[must_use]
    pub const fn shows_something(&self) -> bool {
        let [arithmetic, end_to_end] = [self.arithmetic.deviation, self.end_to_end.deviation];
        arithmetic.pixels + arithmetic.coverage_mismatches + end_to_end.coverage_mismatches > 0
    }

    /// Numbers by which frames compare: the worse frame has the larger. First whether a bound is
    /// exceeded and whether there is something to see, then pixels that are wrong by their place,
    /// then coverage, colour and depth of the arithmetic, then the same end to end.
    #[must_use]
    pub fn badness(&self) -> [f64; 9] {
        let exceeds = f64::from(u8::from(!self.is_within(&Bounds::ARITHMETIC)));
        let shows = f64::from(u8::from(self.shows_something()));
        let of = |c: &Comparison| {
            let found = &c.deviation;
            [found.coverage_mismatches as f64, found.color_max_error, found.depth_max_ulp]
        };
        let ([a, b, c], [d, e, f]) = (of(&self.arithmetic), of(&self.end_to_end));
        [exceeds, shows, self.places.wrong as f64, a, b, c, d, e, f]
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

/// Compares where the core places vertices with their exact places. `exact` returns the place on
/// the screen of a point in view space, and how far a vertex may lie off.
pub(super) fn vertices(
    placed: &[Option<[f64; 2]>],
    points: impl Iterator<Item = [f64; 3]>,
    exact: impl Fn([f64; 3]) -> ([f64; 2], f64),
) -> Vertices {
    let mut found = Vertices::default();
    for (vertex, (placed, point)) in placed.iter().zip(points).enumerate() {
        let Some([x, y]) = *placed else { continue };
        let ([exact_x, exact_y], bound_px) = exact(point);
        let error_px = (x - exact_x).abs().max((y - exact_y).abs());
        let error = VertexError { vertex, error_px, bound_px };
        found.vertex_error_max_px = found.vertex_error_max_px.max(error_px);
        // Of infinite bounds, a quotient would not tell.
        let is_worse = |worst: VertexError| error_px * worst.bound_px > worst.error_px * bound_px;
        if found.vertex_worst.is_none_or(is_worse) {
            found.vertex_worst = Some(error);
        }
    }
    found
}
