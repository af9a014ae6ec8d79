//! The fixed-point picture against the f64 one.
//!
//! Two comparisons are kept apart, because they ask different questions:
//!
//! * **arithmetic**: are the computations right? The reference gets the vertices as the core has
//!   placed them on the screen, quantised and snapped. Coverage must then be equal, a depth within
//!   one unit of its format, a colour within one of 256 steps: [`Bounds`] says so, and
//!   [`Outcome::is_within`] judges.
//! * **end to end**: what does all rounding cost in the picture? The reference starts from the OBJ
//!   file's own numbers and rounds nothing. There is no bound that holds for every model, so this
//!   is for the reader to judge.

mod compare;
mod fixed;
mod view;

use std::time::{Duration, Instant};

use compare::Judge;
pub use compare::{Bounds, Comparison, Difference, Outcome};
pub use fixed::{FixedPicture, Pixel};
pub use view::{DepthFormat, Projection, Shading, Subpixel, View, ViewError};

use crate::{model::Model, reference};

/// One frame drawn both ways, with the pictures.
#[derive(Clone, Debug)]
pub struct Checked {
    /// What was found.
    pub outcome: Outcome,
    /// The fixed-point picture.
    pub fixed: FixedPicture,
    /// The reference on the core's own vertices.
    pub arithmetic: reference::Picture,
    /// The reference from the OBJ file's numbers.
    pub end_to_end: reference::Picture,
    /// In which the fixed-point picture has its depth.
    pub depth: DepthFormat,
}

impl Checked {
    /// How the pixel (x, y) of the fixed-point picture differs from the reference on the core's own
    /// vertices.
    ///
    /// # Panics
    ///
    /// Outside the picture.
    #[must_use]
    pub fn arithmetic_difference(&self, x: usize, y: usize) -> Difference {
        compare::difference(&self.fixed, [x, y], self.depth, &self.arithmetic, 1.0)
    }

    /// How it differs from the reference from the OBJ file's numbers.
    ///
    /// # Panics
    ///
    /// Outside the picture.
    #[must_use]
    pub fn end_to_end_difference(&self, x: usize, y: usize) -> Difference {
        compare::difference(&self.fixed, [x, y], self.depth, &self.end_to_end, self.depth.max())
    }
}

/// Draws a model by the fixed-point core and by the reference, and compares.
///
/// # Errors
///
/// If the view makes no sense, or the core refuses the model in it.
pub fn check(model: &Model, view: &View) -> Result<Checked, ViewError> {
    let camera = view.reference_camera();
    let light = view.reference_light();
    let size = view.size.map(|c| c as usize);

    let drawn = fixed::draw(model, view)?;
    let (arithmetic, arithmetic_time) =
        timed(|| reference::draw_screen(&drawn.triangles, size.into()));
    let mesh = view.reference_mesh(model);
    let culling = reference::Culling::Back;
    let shading = view.shading.into();
    let (end_to_end, end_to_end_time) =
        timed(|| reference::draw_scene(&camera, &light, &mesh, shading, culling, size.into()));

    let rounded = view.rounded();
    let quantised = rounded.pose_points(&quantised_positions(model));
    let placed =
        |positions: &[[f64; 3]], camera| compare::vertex_error(&drawn.vertices, positions, &camera);
    let judge = |judge: &Judge<'_>| compare::compare(&drawn.picture, drawn.time, view.depth, judge);
    let outcome = Outcome {
        arithmetic: judge(&Judge {
            picture: &arithmetic,
            depth_unit: 1.0,
            vertex_error_max_px: placed(&quantised, rounded.reference_camera()),
            time: arithmetic_time,
        }),
        end_to_end: judge(&Judge {
            picture: &end_to_end,
            depth_unit: view.depth.max(),
            vertex_error_max_px: placed(&mesh.positions, camera),
            time: end_to_end_time,
        }),
    };
    Ok(Checked { outcome, fixed: drawn.picture, arithmetic, end_to_end, depth: view.depth })
}

/// Draws a model by the fixed-point core alone.
///
/// # Errors
///
/// If the view makes no sense, or the core refuses the model in it.
pub fn render(model: &Model, view: &View) -> Result<FixedPicture, ViewError> {
    Ok(fixed::draw(model, view)?.picture)
}

/// The positions that the tables stand for, exactly.
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
