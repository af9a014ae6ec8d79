//! The shader that looks a texture up by the normal, and the definition that judges it.

use std::sync::LazyLock;

use rasterizer::shade::Matcap;

use super::{
    any_mode::AnyMode,
    any_texture::{AnyFilter, AnyTable, AnyTexture},
    fixed::Drawn,
    places::FaceColors,
    shading::placed_corner,
    skins::Skins,
    surface::Surface,
    textured,
    view::{View, ViewError},
};
use crate::{
    model::Model,
    reference::{Corner, Mipmaps, Texture, Wrap},
};

/// The side of the picture that models are drawn with.
const SIDE: usize = 64;

/// A ball of copper: light from the upper left, a highlight, and a cold rim.
static PICTURE: LazyLock<Mipmaps> = LazyLock::new(|| {
    let texel = |i: usize| {
        let place = |at: usize| (2.0 * at as f64 + 1.0) / SIDE as f64 - 1.0;
        let (x, y) = (place(i % SIDE), -place(i / SIDE));
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let diffuse = ((2.0 * y - x + 2.0 * z) / 3.0).max(0.0);
        let highlight = (2.0 * z * diffuse - 2.0 / 3.0).max(0.0).powi(12);
        let rim = (1.0 - z).powi(2);
        let channel = |copper: f64, sky: f64| {
            (copper * (0.2 + 0.8 * diffuse) + sky * rim + 255.0 * highlight).min(255.0).round()
        };
        [channel(210.0, 20.0), channel(110.0, 60.0), channel(60.0, 120.0), 255.0]
    };
    let texels = (0..SIDE * SIDE).map(texel).collect();
    Mipmaps::new(vec![Texture::new([SIDE; 2], [Wrap::Clamp; 2], texels)])
});

/// The same in the core's numbers.
static TABLE: LazyLock<AnyTable> = LazyLock::new(|| AnyTable::new(&PICTURE, false));

/// The coordinates of a unit normal in camera space, by the shader's definition.
fn coordinates([x, y, _]: [f64; 3]) -> [f64; 2] {
    [0.5 + 63.0 / 128.0 * x, 0.5 - 63.0 / 128.0 * y]
}

/// Draws a model in the picture of a ball.
pub(super) fn draw<'a>(
    (model, surface, skins): (&'a Model, &'a Surface, &'a Skins),
    view: &View,
) -> Result<Drawn<'a>, ViewError> {
    let textures = [AnyTexture::new(&TABLE, view.filter)];
    let shader = Matcap::new(&textures).filtered(AnyFilter).corrected(AnyMode);
    let normals = corner_normals(model, surface, view);
    textured::draw(
        (model, surface, skins),
        |_| &PICTURE,
        view,
        &shader,
        |seen| Some(seen.value.uv()),
        |_, corner| placed_corner(&corner, 1.0),
        move |corner: Corner| (coordinates(normals[corner.vertex]), 1.0),
    )
}

/// The unit normal of each corner of the file, in the camera's axes.
fn corner_normals(model: &Model, surface: &Surface, view: &View) -> Vec<[f64; 3]> {
    let faces = model.exact.faces.faces.iter();
    let of_corners = faces.zip(&surface.planes).flat_map(|(face, plane)| {
        surface.vertices[face.corners.clone()].iter().map(|vertices| {
            let known = |&vertex: &usize| model.exact.vertex_normals.get(vertex).copied();
            let normal = vertices.iter().find_map(known).or_else(|| plane.normal());
            normal.unwrap_or_default()
        })
    });
    let camera = view.reference_camera();
    let in_world = view.pose_directions(&of_corners.collect::<Vec<_>>());
    in_world.into_iter().map(|normal| camera.turn_to_view(normal)).collect()
}

/// The colours that any face may have.
pub(super) fn colors() -> FaceColors {
    let texels = || PICTURE.base().texels().iter();
    let bound = |channel: usize, start: f64, least: fn(f64, f64) -> f64| {
        texels().map(|texel| texel[channel]).fold(start, least)
    };
    FaceColors {
        range: [
            [0, 1, 2].map(|channel| bound(channel, 255.0, f64::min)),
            [0, 1, 2].map(|channel| bound(channel, 0.0, f64::max)),
        ],
        levels: [1.0, 1.0],
    }
}
