//! What a camera would see: light at each point, textures in the file's own resolution, and the
//! mean over each pixel's area. Every choice of a renderer has its error against this picture.

use super::{
    shiny,
    skins::{self, Skins},
    surface::Surface,
    view::View,
};
use crate::{
    model::Model,
    reference::{self, Corner, Culling, Sample, Viewport, is_opaque, lit},
};

/// A picture without any choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Mean red, green and blue of each pixel, row by row, from 0 to 255: black where nothing is.
    pub colors: Vec<[f64; 3]>,
    /// The part of each pixel that the model covers, from 0 to 1.
    pub coverage: Vec<f64>,
}

/// A model whose true pictures are drawn.
#[derive(Debug)]
pub struct TrueModel<'a> {
    model: &'a Model,
    surface: Surface,
    skins: Skins,
}

/// A point of a face: normal, position, texture coordinate.
type Varyings = [f64; 8];

impl<'a> TrueModel<'a> {
    /// Prepares a model. Its textures are taken as they are in it, so it is to be loaded with
    /// textures in the pictures' own sizes, of direct colours of 8 bits.
    #[must_use]
    pub fn new(model: &'a Model) -> Self {
        let surface = Surface::of(model);
        Self { model, skins: Skins::new(model, &surface, skins::of_materials(model)), surface }
    }

    /// Draws the faces of the file in a view, from its floating-point numbers: the mean of `side`
    /// by `side` samples in each pixel, in stored values (as
    /// [`Mean`](rasterizer::color::Mean) is). Each is lit by its own normal, which is interpolated
    /// and has its length restored, without highlights; a texture has one colour within a texel.
    ///
    /// Of the view its camera, pose and lights count.
    #[must_use]
    pub fn picture(&self, view: &View, side: usize) -> Truth {
        let Self { model, surface, skins } = self;
        let size = view.size.map(|c| c as usize);
        let samples = View { size: view.size.map(|c| c * side as u32), ..*view };
        let (camera, mesh) = (samples.reference_camera(), surface.mesh(model, view));
        let normals = shiny::file_normals(model, surface, view);
        let uv = &model.exact.faces.texture_coordinates;
        let lights = view.lights.reference();
        let varyings = |Corner { vertex, position, .. }: Corner| -> Varyings {
            let ([nx, ny, nz], [x, y, z]) = (normals[vertex], position);
            let [u, v] = uv.get(vertex).copied().unwrap_or_default();
            [nx, ny, nz, x, y, z, u, v]
        };
        let shade = |sample: Sample<8>| {
            let [nx, ny, nz, x, y, z, u, v] = sample.varyings;
            let length = (nx * nx + ny * ny + nz * nz).sqrt();
            let level = lights.diffuse([x, y, z], [nx, ny, nz].map(|c| c / length));
            let material = skins.file_materials[sample.triangle];
            let texel = skins.textures[material].base().nearest([u, v]);
            is_opaque(texel).then(|| lit(texel, level))
        };
        let mut truth = Truth { size, colors: Vec::new(), coverage: Vec::new() };
        // Row by row, because a picture of all samples would take gigabytes.
        for row in 0..size[1] {
            let y = camera.viewport.y - (row * side) as f64;
            let camera =
                reference::Camera { viewport: Viewport { y, ..camera.viewport }, ..camera };
            let area = (size[0] * side, side);
            let drawn = reference::draw_scene(&camera, &mesh, Culling::Back, area, varyings, shade);
            for column in 0..size[0] {
                let places = (0..side * side).map(|i| (column * side + i % side, i / side));
                let seen: Vec<_> =
                    places.filter_map(|(x, y)| drawn.nearest(x, y)).map(|f| f.color).collect();
                let part = |sum: f64| sum / (side * side) as f64;
                let sum = |channel: usize| seen.iter().map(|color| color[channel]).sum::<f64>();
                truth.colors.push([0, 1, 2].map(|channel| part(sum(channel))));
                truth.coverage.push(part(seen.len() as f64));
            }
        }
        truth
    }
}
