//! The shaders that a view offers, each with the definition that judges it.
//!
//! A new shader of the core takes three entries in this file: a variant of [`Shading`], its name in
//! [`Shading::NAMES`], and an arm in [`draw`]. The command line takes its choices from the names.

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::shade::{Flat, Gouraud, Shader as _, Unlit};

use super::{
    fixed::{self, Drawn},
    view::{View, ViewError},
};
use crate::{
    model::Model,
    reference::{Corner, Sample},
};

/// How triangles are coloured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shading {
    /// Lit by the triangle's normal.
    Flat,
    /// Lit at the vertices and interpolated.
    #[default]
    Gouraud,
    /// The material's colour.
    Unlit,
}

impl Shading {
    /// All of them, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 3] =
        [("flat", Self::Flat), ("gouraud", Self::Gouraud), ("unlit", Self::Unlit)];
}

/// Steps of interpolated light: as many as a channel of the pictures that are compared has.
const LEVELS: usize = 256;

/// Draws the model by the shader of the view. The closures are the definition: what the reference
/// interpolates, from the core's own vertices and from the OBJ file's numbers, and the colour.
pub(super) fn draw<'a>(model: &'a Model, view: &View) -> Result<Drawn<'a>, ViewError> {
    let (core_light, light) = (View::light(), view.reference_light());
    let colors = triangle_colors(model);
    let lit = {
        let colors = colors.clone();
        move |Sample { triangle, varyings: [level], .. }: Sample<1>| {
            Some(colors[triangle].map(|channel| channel * level))
        }
    };
    match view.shading {
        Shading::Flat => {
            let shader = Flat::<Rgb888>::new(core_light);
            let turned = shader.for_object(&view.pose());
            let face_normals = view.pose_points(&model.exact.face_normals);
            fixed::draw(
                model,
                view,
                &shader,
                |triangle, []| [quantised_level(&turned, model.face_normals[triangle])],
                move |corner: Corner| [light.level(face_normals[corner.triangle])],
                lit,
            )
        }
        Shading::Gouraud => {
            let vertex_normals = view.pose_points(&model.exact.vertex_normals);
            fixed::draw(
                model,
                view,
                &Gouraud::<Rgb888, LEVELS>::with_levels(core_light),
                |_, [place]| [ramp_level(place)],
                move |corner: Corner| [light.level(vertex_normals[corner.vertex])],
                lit,
            )
        }
        Shading::Unlit => fixed::draw(
            model,
            view,
            &Unlit::<Rgb888>::new(),
            |_, []| [],
            |_| [],
            move |sample: Sample<0>| Some(colors[sample.triangle]),
        ),
    }
}

/// The level of a face by the definition, from its normal in the table and from a shader in object
/// space.
fn quantised_level(shader: &Flat<Rgb888>, normal: [i8; 3]) -> f64 {
    let light = shader.light();
    let product =
        |i: usize| f64::from(normal[i]) / 127.0 * f64::from(light.toward()[i]) / 2f64.powi(30);
    let dot: f64 = (0..3).map(product).sum();
    (light.ambient().to_num::<f64>() + light.diffuse().to_num::<f64>() * dot.max(0.0)).min(1.0)
}

/// The level that a place in the ramp stands for: 0 and 1 lie in the middle of the first and the
/// last of its [`LEVELS`].
fn ramp_level(place: u16) -> f64 {
    let levels = LEVELS as f64;
    (f64::from(place) / 65536.0 * levels - 0.5) / (levels - 1.0)
}

/// The colour of each triangle's material.
fn triangle_colors(model: &Model) -> Vec<[f64; 3]> {
    let run = |m: &rasterizer::mesh::Material| {
        std::iter::repeat_n(m.color.map(f64::from), m.triangle_count as usize)
    };
    model.materials.iter().flat_map(run).collect()
}
