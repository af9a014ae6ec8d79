//! The shaders that a view offers, each with the definition that judges it.
//!
//! A new shader of the core takes three entries in this file: a variant of [`Shading`], its name in
//! [`Shading::NAMES`], and an arm in [`draw`]; and one in `levels` of [`super::face_colors`]. The
//! command line takes its choices from the names.

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::{
    attribute::{Affine, Components, Correction as Mode, InverseW},
    shade::{
        Colored, ColoredGouraud, FarViewer, Flat, Gouraud, Lighting, NearViewer, Phong,
        PhongCorrection, Textured, TexturedFlat, TexturedGouraud, Unlit,
    },
    texture::TextureVarying,
};

use super::{
    any_mode::{AnyMode, InAnyMode},
    any_texture::AnyFilter,
    fixed::{self, Drawn},
    light_levels::{corner_levels, flat_levels},
    matcap,
    shiny::{self, Definition},
    skins::Skins,
    surface::Surface,
    textured::{self, PlacedCorner},
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
    /// The same with highlights and with light of materials.
    GlossyGouraud,
    /// Lit at each pixel, with highlights as a far viewer sees them, or a near one if there are
    /// lamps.
    Phong,
    /// The same for a viewer that each point sees in its own direction.
    PhongNear,
    /// The material's colour.
    Unlit,
    /// The colours of the vertices, without light.
    Colored,
    /// The colours of the vertices, lit there and interpolated.
    ColoredGouraud,
    /// The picture of a ball of copper, looked up by the normal.
    Matcap,
    /// The material's texture, without light.
    Textured,
    /// The texture, lit by the triangle's normal.
    TexturedFlat,
    /// The texture, lit at the vertices and interpolated.
    TexturedGouraud,
}

impl Shading {
    /// All of them, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 12] = [
        ("flat", Self::Flat),
        ("gouraud", Self::Gouraud),
        ("unlit", Self::Unlit),
        ("glossy-gouraud", Self::GlossyGouraud),
        ("phong", Self::Phong),
        ("phong-near", Self::PhongNear),
        ("colored", Self::Colored),
        ("colored-gouraud", Self::ColoredGouraud),
        ("matcap", Self::Matcap),
        ("textured", Self::Textured),
        ("textured-flat", Self::TexturedFlat),
        ("textured-gouraud", Self::TexturedGouraud),
    ];

    /// What a model is drawn with unless another one is chosen: its textures, or else the colours
    /// of its vertices, if it has any.
    #[must_use]
    pub const fn of(model: &Model) -> Self {
        if model.textures.is_some() {
            Self::TexturedGouraud
        } else if model.vertex_colors.is_empty() {
            Self::Gouraud
        } else {
            Self::ColoredGouraud
        }
    }

    /// Whether it shows the colours of vertices.
    #[must_use]
    pub const fn is_colored(self) -> bool {
        matches!(self, Self::Colored | Self::ColoredGouraud)
    }

    /// Whether it has highlights.
    #[must_use]
    pub const fn is_shiny(self) -> bool {
        matches!(self, Self::GlossyGouraud | Self::Phong | Self::PhongNear)
    }

    /// Whether the reference has the colour of each layer, and not of the nearest one only.
    pub(super) fn has_plain_layers(self) -> bool {
        !self.is_textured() && !self.is_shiny() && self != Self::Matcap
    }

    /// Whether it reads texture coordinates.
    #[must_use]
    pub const fn is_textured(self) -> bool {
        matches!(self, Self::Textured | Self::TexturedFlat | Self::TexturedGouraud)
    }
}

/// Steps of interpolated light: as many as a channel of the pictures that are compared has.
const LEVELS: usize = 256;

/// Draws the model by the shader of the view. The closures are the definition: what the reference
/// interpolates, from the core's own vertices and from the OBJ file's numbers, and the colour.
pub(super) fn draw<'a>(
    model: &'a Model,
    surface: &'a Surface,
    skins: &'a Skins,
    view: &View,
) -> Result<Drawn<'a>, ViewError> {
    // One far light has its own type where that is most often used; elsewhere it is one of several,
    // which are dark, so that fewer shaders are compiled.
    match (view.shading, view.lights.single()) {
        (Shading::Flat | Shading::Gouraud, Some(light)) => draw_lit(model, surface, view, light),
        (Shading::Flat | Shading::Gouraud, None) => {
            draw_lit(model, surface, view, view.lights.core())
        }
        (Shading::GlossyGouraud, _) => {
            let definition = Definition::new((model, surface), &view.rounded(), false);
            shiny::draw_at_vertices(definition, view, view.lights.core())
        }
        (Shading::Phong | Shading::PhongNear, _) => draw_at_pixels(model, surface, view),
        (Shading::Textured | Shading::TexturedFlat | Shading::TexturedGouraud, _) => {
            draw_textured(model, surface, skins, view)
        }
        (Shading::Matcap, _) => matcap::draw((model, surface, skins), view),
        (Shading::Unlit | Shading::Colored | Shading::ColoredGouraud, _) => {
            draw_colored(model, surface, view)
        }
    }
}

/// [`draw`] for shaders with light at each pixel.
fn draw_at_pixels<'a>(
    model: &'a Model,
    surface: &'a Surface,
    view: &View,
) -> Result<Drawn<'a>, ViewError> {
    let lights = view.lights.core();
    // With positions for lamps there are those for a near viewer too.
    let is_near = view.shading == Shading::PhongNear || view.lights.are_near();
    let definition = Definition::new((model, surface), &view.rounded(), is_near);
    let over = |inverse_w: InverseW| f64::from(inverse_w.to_bits()) / 2f64.powi(32);
    if is_near {
        shiny::draw_at_pixels::<_, NearViewer>(
            definition,
            view,
            &Phong::new(lights).with_near_viewer().with_levels(),
            |seen| seen.value.first_chunk().map(|normal| normal.map(fixed_bits)),
            |corner| {
                let (corner, inverse_w) = PhongCorrection::parts::<[i16; 6]>(corner);
                let [x, y, z, u, v, w] = corner.map(f64::from);
                ([[x, y, z], [u, v, w]], over(inverse_w))
            },
        )
    } else {
        let (suns, _) = lights;
        shiny::draw_at_pixels::<_, FarViewer>(
            definition,
            view,
            &Phong::new(suns).with_levels(),
            |seen| Some(seen.value.map(fixed_bits)),
            |corner| {
                let (normal, inverse_w) = PhongCorrection::parts::<[i16; 3]>(corner);
                ([normal.map(f64::from), [0.0; 3]], over(inverse_w))
            },
        )
    }
}

const fn fixed_bits(number: rasterizer::fixed::types::I16F16) -> i32 {
    number.to_bits()
}

/// [`draw`] for the colours of materials with light at vertices or triangles.
fn draw_lit<'a, L: Lighting>(
    model: &'a Model,
    surface: &'a Surface,
    view: &View,
    core_lights: L,
) -> Result<Drawn<'a>, ViewError> {
    let colors = triangle_colors(model);
    let file_color =
        |triangle: usize| model.exact.faces.faces[surface.faces[triangle]].color.map(f64::from);
    let lit = move |Sample { triangle, varyings: [level], .. }: Sample<1>| {
        Some(colors[triangle].map(|channel| channel * level))
    };
    let file_lit = move |Sample { triangle, varyings: [level], .. }: Sample<1>| {
        Some(file_color(triangle).map(|channel| channel * level))
    };
    if view.shading == Shading::Flat {
        let (levels, file_levels) = flat_levels(model, surface, view)?;
        fixed::draw(
            (model, surface),
            view,
            &Flat::<Rgb888, L>::new(core_lights),
            |triangle, []| [levels[triangle]],
            lit,
            move |corner: Corner| [file_levels[corner.triangle]],
            file_lit,
        )
    } else {
        let levels = corner_levels(model, surface, view);
        fixed::draw(
            (model, surface),
            view,
            &Gouraud::<Rgb888, LEVELS, L>::with_levels(core_lights),
            |_, [place]| [ramp_level(place)],
            lit,
            move |corner: Corner| [levels[corner.vertex][0]],
            file_lit,
        )
    }
}

/// [`draw`] for colours without light, and for those of vertices.
fn draw_colored<'a>(
    model: &'a Model,
    surface: &'a Surface,
    view: &View,
) -> Result<Drawn<'a>, ViewError> {
    match view.shading {
        Shading::Colored => fixed::draw(
            (model, surface),
            view,
            &Colored::<Rgb888>::new(),
            |_, corner| channels(&corner),
            |sample: Sample<3>| Some(sample.varyings),
            |corner: Corner| file_channels(model, corner.vertex),
            |sample: Sample<3>| Some(sample.varyings),
        ),
        Shading::ColoredGouraud => {
            let levels = corner_levels(model, surface, view);
            fixed::draw(
                (model, surface),
                view,
                &ColoredGouraud::<Rgb888, Affine, _>::new(view.lights.core()),
                |_, corner| channels(&corner),
                |sample: Sample<3>| Some(sample.varyings),
                move |corner: Corner| {
                    let level = levels[corner.vertex][0];
                    file_channels(model, corner.vertex).map(|channel| channel * level)
                },
                |sample: Sample<3>| Some(sample.varyings),
            )
        }
        _ => {
            let colors = triangle_colors(model);
            let faces = &model.exact.faces.faces;
            fixed::draw(
                (model, surface),
                view,
                &Unlit::<Rgb888>::new(),
                |_, []| [],
                move |sample: Sample<0>| Some(colors[sample.triangle]),
                |_| [],
                |sample: Sample<0>| {
                    Some(faces[surface.faces[sample.triangle]].color.map(f64::from))
                },
            )
        }
    }
}

const MATERIALS: &str = "a model has triangles, and these have materials";

/// [`draw`] for shaders with textures.
fn draw_textured<'a>(
    model: &'a Model,
    surface: &'a Surface,
    skins: &'a Skins,
    view: &View,
) -> Result<Drawn<'a>, ViewError> {
    let core_lights = view.lights.core();
    let textures = skins.filtered(view.filter);
    let all = (model, surface, skins);
    let texture_of = |material: usize| &skins.textures[material];
    let file_uv = |corner: Corner| {
        let all = &model.exact.faces.texture_coordinates;
        all.get(corner.vertex).copied().unwrap_or_default()
    };
    match view.shading {
        Shading::TexturedFlat => {
            let shader = TexturedFlat::from_slice(&textures, core_lights)
                .expect(MATERIALS)
                .filtered(AnyFilter)
                .corrected(AnyMode)
                .with_wide_coordinates();
            let (levels, file_levels) = flat_levels(model, surface, view)?;
            textured::draw(
                all,
                texture_of,
                view,
                &shader,
                |seen| Some(seen.value.uv()),
                |triangle, corner| placed_corner(&corner, levels[triangle]),
                move |corner| (file_uv(corner), file_levels[corner.triangle]),
            )
        }
        Shading::TexturedGouraud => {
            let shader = TexturedGouraud::from_slice(&textures, core_lights)
                .expect(MATERIALS)
                .filtered(AnyFilter)
                .corrected(AnyMode)
                .with_wide_coordinates();
            let levels = corner_levels(model, surface, view);
            textured::draw(
                all,
                texture_of,
                view,
                &shader,
                |(seen, _)| Some(seen.value.uv()),
                |_, (corner, level)| {
                    let (level, _) = Affine::parts(&level);
                    placed_corner(&corner, lit_level(level))
                },
                move |corner| (file_uv(corner), levels[corner.vertex][0]),
            )
        }
        _ => {
            let shader = Textured::from_slice(&textures)
                .expect(MATERIALS)
                .filtered(AnyFilter)
                .corrected(AnyMode)
                .with_wide_coordinates();
            textured::draw(
                all,
                texture_of,
                view,
                &shader,
                |seen| Some(seen.value.uv()),
                |_, corner| placed_corner(&corner, 1.0),
                move |corner| (file_uv(corner), 1.0),
            )
        }
    }
}

/// A corner on the screen with a light level.
pub(super) fn placed_corner<V: Components + TextureVarying>(
    corner: &InAnyMode<V>,
    light: f64,
) -> PlacedCorner {
    let (coordinates, inverse_w) = AnyMode::parts(corner);
    PlacedCorner {
        uv: coordinates.uv().map(|c| f64::from(c) / 2f64.powi(24)),
        inverse_w: f64::from(inverse_w.to_bits()) / 2f64.powi(32),
        light,
    }
}

/// The level that a varying of textures stands for: 0 and 1 lie in the middle of the first and the
/// last of 257, in steps of 2^-15.
fn lit_level(varying: u16) -> f64 {
    (f64::from(varying) - 64.0) / 32_768.0
}

/// The level that a place in the ramp stands for: 0 and 1 lie in the middle of the first and the
/// last of its [`LEVELS`].
fn ramp_level(place: u16) -> f64 {
    let levels = LEVELS as f64;
    (f64::from(place) / 65536.0 * levels - 0.5) / (levels - 1.0)
}

/// The colour that the varyings of a corner stand for, from 0 to 255: 0 and 1 lie in the middle of
/// the first and the last of 256 steps.
pub(super) fn channels(corner: &<Affine as Mode>::OnScreen<[u16; 3]>) -> [f64; 3] {
    let (channels, _) = Affine::parts(corner);
    channels.map(|channel| f64::from(channel) / 256.0 - 0.5)
}

/// The colour of a corner of the file, from 0 to 255.
pub(super) fn file_channels(model: &Model, corner: usize) -> [f64; 3] {
    model.exact.faces.vertex_colors.get(corner).copied().unwrap_or_default()
}

/// The colour of each triangle's material.
fn triangle_colors(model: &Model) -> Vec<[f64; 3]> {
    let run = |m: &rasterizer::mesh::Material| {
        std::iter::repeat_n(m.color.map(f64::from), m.triangle_count as usize)
    };
    model.materials.iter().flat_map(run).collect()
}
