//! The fixed-point picture against the f64 one.
//!
//! Two comparisons are kept apart, because they ask different questions:
//!
//! * **arithmetic**: are the computations right? The reference gets the vertices as the core places
//!   them on the screen, quantised and snapped. Coverage must then be equal, a depth within
//!   one unit of its format, a colour within one of 256 steps: see [`Bounds`] and
//!   [`Outcome::is_within`].
//! * **end to end**: what does all rounding cost in the picture? The reference starts from the OBJ
//!   file's own numbers and rounds nothing. No bound holds for every model, so the reader judges.
//!
//! [`check`] compares a model in a view. [`judge`] compares any object of the core, with any
//! shader, against a definition of that shader.

mod compare;
mod depth;
mod fixed;
mod object;
mod shading;
mod view;

use std::time::{Duration, Instant};

pub use compare::{Bounds, Comparison, Deviation, Difference, Outcome};
pub use depth::{DefinedDepth, DepthFormat};
pub use object::{FixedPicture, Judged, Pixel, judge, screen_triangles};
pub use shading::Shading;
pub use view::{Projection, Subpixel, View, ViewError};

use crate::{model::Model, reference};

/// One frame drawn both ways, with the pictures.
#[derive(Clone, Debug)]
pub struct Checked {
    /// Both comparisons.
    pub outcome: Outcome,
    /// The fixed-point picture.
    pub fixed: FixedPicture,
    /// The reference on the core's own vertices.
    pub arithmetic: reference::Picture,
    /// The reference from the OBJ file's numbers.
    pub end_to_end: reference::Picture,
    /// How the fixed-point picture stores its depth.
    pub depth: DepthFormat,
}

impl Checked {
    /// How the pixel (x, y) of the fixed-point picture differs from the reference on the core's own
    /// vertices.
    ///
    /// # Panics
    ///
    /// Panics if the pixel lies outside the picture.
    #[must_use]
    pub fn arithmetic_difference(&self, x: usize, y: usize) -> Difference {
        compare::difference(&self.fixed, [x, y], self.depth.definition(), &self.arithmetic)
    }

    /// How the pixel differs from the reference from the OBJ file's numbers.
    ///
    /// # Panics
    ///
    /// Panics if the pixel lies outside the picture.
    #[must_use]
    pub fn end_to_end_difference(&self, x: usize, y: usize) -> Difference {
        compare::difference(&self.fixed, [x, y], self.depth.definition(), &self.end_to_end)
    }
}

/// Draws a model by the fixed-point core and by the reference, and compares.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw the model in
/// it.
pub fn check(model: &Model, view: &View) -> Result<Checked, ViewError> {
    let drawn = shading::draw(model, view)?;
    let (arithmetic, arithmetic_time) = timed(drawn.arithmetic);
    let (end_to_end, end_to_end_time) = timed(drawn.end_to_end);

    let (fixed, depth) = (drawn.picture, view.depth.definition());
    let comparison = |reference, points: &[[f64; 3]], camera, time| Comparison {
        deviation: compare::compare(&fixed, reference, depth),
        vertex_error_max_px: compare::vertex_error(&drawn.vertices, points, &camera),
        fixed_ms: milliseconds(drawn.time),
        reference_ms: milliseconds(time),
    };
    let rounded = view.rounded();
    let quantised = rounded.pose_points(&quantised_positions(model));
    let exact = view.pose_points(&model.exact.positions);
    let (rounded, unrounded) = (rounded.reference_camera(), view.reference_camera());
    let outcome = Outcome {
        arithmetic: comparison(&arithmetic, &quantised, rounded, arithmetic_time),
        end_to_end: comparison(&end_to_end, &exact, unrounded, end_to_end_time),
    };
    Ok(Checked { outcome, fixed, arithmetic, end_to_end, depth: view.depth })
}

/// Draws a model by the fixed-point core alone.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw the model in
/// it.
pub fn render(model: &Model, view: &View) -> Result<FixedPicture, ViewError> {
    Ok(shading::draw(model, view)?.picture)
}

/// The exact values of the positions in the tables.
fn quantised_positions(model: &Model) -> Vec<[f64; 3]> {
    let step = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent());
    let offset = model.offset.to_bits().map(|c| f64::from(c) / 65536.0);
    let place = |p: &[i16; 3]| [0, 1, 2].map(|i| offset[i] + step * f64::from(p[i]));
    model.positions.iter().map(place).collect()
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed())
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
