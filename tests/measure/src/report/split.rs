//! Errors by their cause, from three references: the file's numbers, those of the tables, and the
//! vertices that are rounded to sub-pixels.

use anyhow::{Context as _, Result};
use host_tools::{
    check::{self, Checker, DepthFormat, Shading, Subpixel, View},
    model::Model,
};
use serde::{Deserialize, Serialize};

use super::{choices::Correction, scenes::Scene};

/// The worst over all frames of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Geometry {
    /// How far a vertex is off the file's, in pixels.
    pub(super) off_file_px: f64,
    /// How far it is off that of the tables, whose positions have 16 bits.
    pub(super) off_tables_px: f64,
    /// Pixels that only the picture or only the file's faces cover.
    pub(super) coverage_off_file: usize,
    /// The same for the core's own vertices.
    pub(super) coverage_off_snapped: usize,
    /// Depth against the file's faces in units of the format, a root of the mean square.
    pub(super) depth_off_file: f64,
    /// Depth against the core's own vertices, the most.
    pub(super) depth_off_snapped: f64,
}

/// A format of vertices and depth with its errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Split {
    /// Bits of a pixel behind the point.
    pub(super) subpixel: u32,
    pub(super) depth: String,
    pub(super) geometry: Geometry,
}

/// A way to correct texture coordinates, with its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Texels {
    pub(super) correction: Correction,
    /// The most over all pixels, in texels.
    pub(super) most: f64,
}

/// The errors of each format.
///
/// # Errors
///
/// Returns an error if the core cannot draw the scene.
pub(super) fn geometry(scene: &Scene, model: &Model) -> Result<Vec<Split>> {
    let checker = Checker::new(model);
    let mut splits = Vec::new();
    for (subpixel, bits) in [(Subpixel::S4, 4), (Subpixel::S8, 8)] {
        for (name, depth) in DepthFormat::NAMES {
            let mut worst = Geometry::default();
            for frame in 0..scene.frames {
                let view = View { subpixel, depth, ..scene.view(frame) };
                let outcome = checker.check(&view).context("the scene")?.outcome;
                let (file, snapped) = (&outcome.end_to_end, &outcome.arithmetic);
                let place = |sum: &mut f64, found: f64| *sum = sum.max(found);
                place(&mut worst.off_file_px, file.vertices.vertex_error_max_px);
                place(&mut worst.off_tables_px, snapped.vertices.vertex_error_max_px);
                place(&mut worst.depth_off_file, file.deviation.depth_rms_ulp);
                place(&mut worst.depth_off_snapped, snapped.deviation.depth_max_ulp);
                let pixels = |sum: &mut usize, found: usize| *sum = (*sum).max(found);
                pixels(&mut worst.coverage_off_file, file.deviation.coverage_mismatches);
                pixels(&mut worst.coverage_off_snapped, snapped.deviation.coverage_mismatches);
            }
            splits.push(Split { subpixel: bits, depth: name.to_owned(), geometry: worst });
        }
    }
    Ok(splits)
}

/// The errors of texture coordinates by each correction that `check` knows.
///
/// # Errors
///
/// Returns an error if the core cannot draw the scene.
pub(super) fn texels(scene: &Scene, model: &Model) -> Result<Vec<Texels>> {
    let checker = Checker::new(model);
    let mut all = Vec::new();
    for (correction, perspective) in CORRECTIONS {
        let mut most = 0f64;
        for frame in 0..scene.frames {
            let view = View { perspective, shading: Shading::of(model), ..scene.view(frame) };
            let outcome = checker.check(&view).context("the scene")?.outcome;
            most = outcome.arithmetic.texels.map_or(most, |found| most.max(found.texel_max_error));
        }
        all.push(Texels { correction, most });
    }
    Ok(all)
}

/// The corrections as choices and for `check`. Affine coordinates are none: `check` judges them by
/// their own definition.
const CORRECTIONS: [(Correction, check::Correction); 6] = [
    (Correction::Every(32), check::Correction::Every32),
    (Correction::Every(16), check::Correction::Every16),
    (Correction::Every(8), check::Correction::Every8),
    (Correction::Every(4), check::Correction::Every4),
    (Correction::Adaptive(8), check::Correction::Adaptive),
    (Correction::EveryPixel, check::Correction::EveryPixel),
];
