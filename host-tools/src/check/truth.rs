//! What a camera would see: light at each point, textures in the file's own resolution, and the
//! mean over each pixel's area. Every choice of a renderer has its error against this picture.

use super::{
    skins::{self, Skins},
    surface::Surface,
    view::View,
};
use crate::{
    model::Model,
    reference::{self, Corner, Culling, Mesh, Sample, Viewport, is_opaque, lit},
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
    skins: Skins,
}

/// A point of a triangle: normal, position, texture coordinate.
type Varyings = [f64; 8];

impl<'a> TrueModel<'a> {
    /// Prepares a model. Its textures are taken as they are in it, so it is to be loaded with
    /// textures in the pictures' own sizes, of direct colours of 8 bits.
    #[must_use]
    pub fn new(model: &'a Model) -> Self {
        let skins = Skins::new(model, &Surface::default(), skins::of_materials(model));
        Self { model, skins }
    }

    /// Draws the triangles of the model in a view, from the floating-point numbers of the file: the
    /// mean of `side` by `side` samples in each pixel, in stored values (as
    /// [`Mean`](rasterizer::color::Mean) is). Each is lit by its own normal, which is interpolated
    /// and has its length restored, without highlights; a texture has one colour within a texel.
    ///
    /// The triangles are those of the tables: a face of four corners that is not flat is another
    /// surface for each way to cut it, and that is no error of a renderer. Of the view its camera,
    /// pose and lights count.
    #[must_use]
    pub fn picture(&self, view: &View, side: usize) -> Truth {
        let Self { model, skins } = self;
        let size = view.size.map(|c| c as usize);
        let samples = View { size: view.size.map(|c| c * side as u32), ..*view };
        let camera = samples.reference_camera();
        let table = model.triangles.as_triangles();
        let mesh = Mesh {
            positions: view.pose_points(&model.exact.positions),
            triangles: (0..).map_while(|i| table.get(i)).collect(),
        };
        let normals = view.pose_directions(&model.exact.vertex_normals);
        let of_triangles = view.pose_directions(&model.exact.face_normals);
        let uv = &model.exact.texture_coordinates;
        let lights = view.lights.reference();
        let varyings = |Corner { triangle, vertex, position: [x, y, z] }: Corner| -> Varyings {
            let normal = normals.get(vertex).or_else(|| of_triangles.get(triangle));
            let [nx, ny, nz] = normal.copied().unwrap_or_default();
            let [u, v] = uv.get(vertex).copied().unwrap_or_default();
            [nx, ny, nz, x, y, z, u, v]
        };
        let shade = |sample: Sample<8>| {
            let [nx, ny, nz, x, y, z, u, v] = sample.varyings;
            let length = (nx * nx + ny * ny + nz * nz).sqrt();
            let level = lights.diffuse([x, y, z], [nx, ny, nz].map(|c| c / length));
            let material = skins.materials[sample.triangle];
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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::{check::Projection, model::Options};

    /// The picture of a square of side 1 that faces the camera, four pixels a unit, with a corner
    /// at the middle of the picture.
    fn square(normals: [&str; 2]) -> Truth {
        let [left, right] = normals;
        let obj = format!(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn {left}\nvn {right}\nf 1//1 2//2 3//2 4//1\n"
        );
        let options = Options { fit: crate::model::Fit::Keep, ..Options::default() };
        let model = Model::from_bytes(Path::new("square.obj"), obj.as_bytes(), &options).unwrap();
        let view = View {
            size: [9, 9],
            projection: Projection::Orthographic { height: 9.0 / 4.0 },
            yaw_degrees: 0.0,
            pitch_degrees: 0.0,
            ..View::default()
        };
        TrueModel::new(&model).picture(&view, 8)
    }

    #[test]
    fn a_pixel_has_the_part_that_is_covered() {
        let truth = square(["0 0 1"; 2]);
        let at = |x: usize, y: usize| truth.coverage[9 * y + x];
        // The square lies between the middles of pixels 4 and 8; y runs up.
        assert_eq!([at(3, 4), at(4, 4), at(5, 4), at(5, 3), at(8, 1)], [0.0, 0.25, 0.5, 1.0, 0.5]);
        let of = |x: usize, y: usize| truth.colors[9 * y + x][0];
        assert!((of(4, 4) - of(5, 3) / 4.0).abs() < 1e-9);
        assert_eq!(of(3, 4), 0.0);
    }

    #[test]
    fn light_is_that_of_the_normal_at_each_point() {
        // The normal turns from one side to the other.
        let (bent, flat) = (square(["-1 0 1", "1 0 1"]), square(["0 0 1"; 2]));
        let [x, z] = [-1.0, 3.0].map(|c: f64| c / 14.0f64.sqrt());
        let lambert = |nx: f64| 0.2 + 0.8 * (nx * x + z) / (nx * nx + 1.0).sqrt();
        // The mean of a pixel of eight samples, which begins at a place on the square.
        let mean = |first: f64| {
            let place = |i: u32| first + (f64::from(i) + 0.5) / 32.0;
            (0..8).map(|i| lambert(2.0 * place(i) - 1.0)).sum::<f64>() / 8.0
        };
        for (column, first) in [(5, 0.125), (6, 0.375), (7, 0.625)] {
            let level = |truth: &Truth| truth.colors[9 * 3 + column][1];
            let (found, expected) = (level(&bent) / level(&flat), mean(first) / lambert(0.0));
            // The light's direction and levels are those of the core, in 16 bits.
            assert!((found - expected).abs() < 1e-4, "{column}: {found} {expected}");
        }
    }
}
