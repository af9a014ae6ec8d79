//! The fixed-point picture against the f64 one.
//!
//! Two comparisons are kept apart, because they ask different questions:
//!
//! * **arithmetic**: are the computations right? The reference gets the vertices as the core places
//!   them on the screen, quantised and snapped. Coverage must then be equal, a depth within
//!   one unit of its format, a colour within one of 256 steps: see [`Bounds`]. The vertices
//!   themselves must lie within 5/8 of a sub-pixel of where exact arithmetic puts the positions of
//!   the tables.
//! * **end to end**: is the picture that of the file? The reference starts from the faces of the
//!   OBJ file, cuts them into triangles by itself, and rounds only the view, to the core's numbers.
//!   A vertex may be half a quantum farther off; and each pixel that lies farther than that from
//!   all edges must show the face that the file has there, or none: see [`Places`]. How far pixels
//!   at edges are off has no bound that holds for every model, so the reader judges.
//!
//! In a view that blends, the layers of each pixel, which the core draws from back to front without
//! storing depth, are compared too, with their alphas, and their blended colour with f64: see
//! [`Blended`].
//!
//! [`Outcome::is_within`] tells whether all of it holds.
//!
//! [`check`] compares a model in a view, [`Checker`] in several. [`judge`] compares any object of
//! the core, with any shader, against a definition of that shader.

mod alphas;
mod any_depth;
mod any_mode;
mod any_texture;
mod blending;
mod compare;
mod coordinates;
mod correction;
mod depth;
mod display;
mod drawing;
mod face_colors;
mod filter;
mod fixed;
mod fog;
mod form;
mod judged_lines;
mod layers;
mod light_levels;
mod lights;
mod line_ends;
mod lines;
mod matcap;
mod normals;
mod noted;
mod object;
mod placement;
mod places;
mod planes;
mod probe;
mod scene;
mod shading;
mod shiny;
mod skins;
mod stand;
mod surface;
#[cfg(test)]
mod tests;
mod textured;
mod truth;
mod view;

use std::{
    borrow::Cow,
    time::{Duration, Instant},
};

pub use alphas::{AlphaBound, AlphaError, FadeAlong};
pub use blending::{BACKGROUND, BlendBound, BlendError, Blended, Blending};
pub use compare::{Bounds, Comparison, Deviation, Difference, Outcome, VertexError, Vertices};
pub use coordinates::{ExactCoordinate, TexelError, Texels};
pub use correction::Correction;
pub use depth::{DefinedDepth, DepthFormat};
pub use display::{Colors, Display, DisplayOutcome, Matrix};
pub use filter::{Filter, Precision, Right, Seen};
pub use fog::{Fog, FogBy};
pub use form::Form;
pub use judged_lines::{LineEndError, LineOutcome};
pub use lights::{Lamp, MOST_LIGHTS, Sun, ViewLights};
pub use lines::{Edges, LineOptions, judge_lines, render_with_lines, wireframe};
pub use normals::NormalErrors;
pub use object::{FixedPicture, Judged, Pixel, judge, screen_triangles};
pub use places::{Fault, Places, Wrong};
pub use planes::{MOST_PLANES, PlaneSpace, ViewPlanes};
pub use scene::{SceneModel, ScenePicture, render_scene};
pub use shading::Shading;
pub use stand::{Look, Place};
pub use truth::{TrueModel, Truth};
pub use view::{Projection, Subpixel, View, ViewError};
#[cfg(feature = "plan")]
pub(crate) use {stand::angle, view::checked};

use crate::{model::Model, reference};
use fixed::Drawn;
use noted::Noted;
use placement::Placement;
use places::{FaceColors, Judge};
use skins::Skins;
use surface::Surface;

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
    /// The pixels that are wrong by their place, row by row.
    pub wrong: Vec<Wrong>,
    /// How the fixed-point picture stores its depth.
    pub depth: DepthFormat,
    /// The fixed-point picture with the model blended with itself and the background, if the view
    /// blends.
    pub blended: Option<FixedPicture>,
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

/// A model with what the comparisons of all its views share.
#[derive(Debug)]
pub struct Checker<'a> {
    model: &'a Model,
    surface: Surface,
    skins: Skins,
}

impl<'a> Checker<'a> {
    /// Prepares the comparisons: cuts the faces of the file into triangles, apart from the tables.
    #[must_use]
    pub fn new(model: &'a Model) -> Self {
        Self::of(model, false)
    }

    /// Of a model whose faces run the way that its tables do, or the other one.
    fn of(model: &'a Model, is_mirrored: bool) -> Self {
        let surface = Surface::of(model, is_mirrored);
        Self { model, skins: Skins::new(model, &surface, skins::of_materials(model)), surface }
    }

    /// Draws a view by the fixed-point core and by the reference, and compares.
    ///
    /// # Errors
    ///
    /// Returns an error if the view's numbers are out of range, or if the core cannot draw the
    /// model in it.
    pub fn check(&self, view: &View) -> Result<Checked, ViewError> {
        match view.form.made(self.model)? {
            Cow::Borrowed(_) => self.check_made(view),
            Cow::Owned(made) => {
                let mut checker = Checker::of(&made, view.form.is_mirrored());
                let surface = &mut checker.surface;
                if let Some(normals) = view.form.triangle_normals(self.model, &surface.triangles) {
                    surface.normals = normals;
                }
                checker.check_made(view)
            }
        }
    }

    /// [`check`](Self::check) of a model whose faces are in the form of the view.
    fn check_made(&self, view: &View) -> Result<Checked, ViewError> {
        let drawn = shading::draw(self.model, &self.surface, &self.skins, view)?;
        let colors = face_colors::colors(self.model, &self.surface, &self.skins, &view.rounded());
        let mut checked = self.compare(view, drawn, &colors);
        if view.form != Form::AsModelled {
            let exact = view.form.table_normals(self.model);
            let errors = Noted::of(self.model, view)?.normal_errors(&exact, view.form);
            let normals = &mut checked.outcome.arithmetic.normals;
            *normals = Some(normals.map_or(errors, |own| own.or_worse(errors)));
        }
        Ok(checked)
    }

    /// Draws the reference of a view that the core has drawn, and compares. `colors` are
    /// those that each face may have; `None` for one with holes.
    fn compare(&self, view: &View, drawn: Drawn<'_>, colors: &[Option<FaceColors>]) -> Checked {
        let Self { model, surface, .. } = self;
        let ((arithmetic, texels, normals, alphas), arithmetic_time) =
            timed(|| (drawn.arithmetic)(&drawn.picture));
        let (end_to_end, end_to_end_time) = timed(drawn.end_to_end);

        let (fixed, depth) = (drawn.picture, view.depth.definition());
        let rounded = view.rounded();
        let placement = Placement::new(model, &rounded);
        let camera = rounded.reference_camera();
        let vertices = |points: Vec<[f64; 3]>, bound: &dyn Fn([f64; 3]) -> f64| {
            compare::vertices(&drawn.vertices, points.iter().map(|&p| camera.to_view(p)), |p| {
                (placement.place(p), bound(p))
            })
        };
        let has_colors = view.fog.is_none() && view.shading.has_plain_layers();
        let layers = drawn.blended;
        let blend =
            layers.as_ref().map(|layers| layers.judge(&arithmetic, alphas.as_ref(), has_colors));
        let comparison = |reference, vertices, (texels, normals, blend), time| Comparison {
            deviation: compare::compare(&fixed, reference, depth),
            vertices,
            texels,
            normals,
            blend,
            fixed_ms: milliseconds(drawn.time),
            reference_ms: milliseconds(time),
        };
        let quantised =
            vertices(rounded.core_pose_points(&view.form.table_positions(model)), &|_| {
                placement.of_arithmetic()
            });
        let exact =
            vertices(rounded.pose_points(&model.exact.positions), &|p| placement.of_vertex(p));
        let judge = Judge {
            model,
            surface,
            view: &rounded,
            colors,
            exact: &end_to_end,
            arithmetic: &arithmetic,
        };
        let (places, wrong) = judge.judge(&fixed);
        let outcome = Outcome {
            arithmetic: comparison(
                &arithmetic,
                quantised,
                (texels, normals, blend),
                arithmetic_time,
            ),
            end_to_end: comparison(&end_to_end, exact, (None, None, None), end_to_end_time),
            places,
            display: None,
        };
        let blended = layers.map(|layers| blended(&fixed, &layers.colors));
        let mut checked =
            Checked { outcome, fixed, arithmetic, end_to_end, wrong, depth: view.depth, blended };
        checked.outcome.display = view.display.map(|display| display::judge(display, &checked));
        checked
    }
}

/// Draws one view of a model by the fixed-point core and by the reference, and compares.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw the model in
/// it.
pub fn check(model: &Model, view: &View) -> Result<Checked, ViewError> {
    Checker::new(model).check(view)
}

/// Draws a model by the fixed-point core alone, with the lines and points of its file: blended with
/// itself and the background if the view blends.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw the model in
/// it.
pub fn render(model: &Model, view: &View) -> Result<FixedPicture, ViewError> {
    render_with_lines(model, view, LineOptions::default())
}

/// Draws the surfaces of a model by the core. In a view that blends they lie on the picture
/// `under`, or on the background without one.
fn surfaces(
    model: &Model,
    view: &View,
    under: Option<&[[u8; 3]]>,
) -> Result<FixedPicture, ViewError> {
    // The surface is for the reference, which isn't drawn.
    let surface = Surface::default();
    let skins = Skins::new(model, &surface, skins::of_materials(model));
    let drawn = shading::draw(model, &surface, &skins, view)?;
    Ok(match (&drawn.blended, under) {
        (Some(layers), Some(under)) => blended(&drawn.picture, &layers.over(under)),
        (Some(layers), None) => blended(&drawn.picture, &layers.colors),
        (None, _) => drawn.picture,
    })
}

/// A picture in its blended colours.
fn blended(picture: &FixedPicture, colors: &[[u8; 3]]) -> FixedPicture {
    let recolored = |(pixel, &color): (&Pixel, &[u8; 3])| Pixel { color, ..*pixel };
    let pixels = picture.pixels.iter().zip(colors).map(recolored).collect();
    FixedPicture { pixels, ..*picture }
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed())
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
