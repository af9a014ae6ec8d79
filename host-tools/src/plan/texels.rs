//! What perspective does to a texture, and how many of its texels a pixel covers.

use super::{Request, views::Placed};
use crate::{model::Model, reference};

/// A model with texture coordinates, for measuring in views.
pub(super) struct Coverage<'a> {
    triangles: Vec<[usize; 3]>,
    positions: &'a [[f64; 3]],
    /// In texels.
    coordinates: Vec<[f64; 2]>,
    focal_length_px: f64,
    /// Width and height of the display.
    display: [u32; 2],
}

/// How many texels a step of a pixel covers on a triangle.
///
/// With q = 1 / distance, q, u q and v q are linear on the screen; the area of texels that a pixel
/// covers is the Jacobian determinant of that mapping: D / q^3, where D is the determinant of the
/// three linear functions. It follows from the corners a, b and c, and from the areas of the
/// triangle in texels and on the screen:
///
/// ```text
///   D = texels q(a) q(b) q(c) / pixels
/// ```
#[derive(Clone, Copy, Debug)]
struct Step {
    /// The first corner in pixels, and q there.
    corner: [f64; 3],
    /// What q changes by from a pixel to the next one on the right, and below.
    slope: [f64; 2],
    /// D.
    texels: f64,
}

impl Step {
    /// Of a triangle with corners in pixels, q there, and texels.
    fn new(corners: [([f64; 3], [f64; 2]); 3]) -> Self {
        let [a, b, c] = corners.map(|(place, _)| place);
        let [ab, ac] = [b, c].map(|to| [0, 1, 2].map(|i| to[i] - a[i]));
        let twice = ab[0] * ac[1] - ab[1] * ac[0];
        let slope =
            [(ab[2] * ac[1] - ac[2] * ab[1]) / twice, (ac[2] * ab[0] - ab[2] * ac[0]) / twice];
        let texels = area(corners.map(|(_, texels)| texels));
        let texels = texels * a[2] * b[2] * c[2] / (twice.abs() / 2.0);
        Self { corner: a, slope, texels }
    }

    /// The side of a square of as many texels as a pixel covers.
    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let [left, upper, q] = self.corner;
        let q = q + self.slope[0] * (x - left) + self.slope[1] * (y - upper);
        // Middles of pixels lie within the triangle but for what its corners are rounded by.
        (self.texels / q.max(1e-9).powi(3)).sqrt()
    }
}

/// What a view, or several, shows of textures.
#[derive(Clone, Debug, Default)]
pub(super) struct Sampling {
    /// The largest error of linear interpolation, in texels.
    pub(super) affine_error: f64,
    /// The largest ratio of distances within a triangle.
    pub(super) ratio: f64,
    /// Pixels by the texels that a step between them covers: by quarters of a power of two from
    /// 2^-8.
    pixels: Vec<u64>,
}

/// Steps of [`Sampling::pixels`] in a power of two.
const STEPS: f64 = 4.0;
const LEAST: f64 = -8.0;

impl<'a> Coverage<'a> {
    /// Those of a model, or `None` without textures.
    pub(super) fn new(model: &'a Model, request: &Request) -> Option<Self> {
        let size = model.textures.as_ref()?.size.map(|side| side as f64);
        let table = model.triangles.as_triangles();
        Some(Self {
            triangles: (0..model.report.triangles).filter_map(|number| table.get(number)).collect(),
            positions: &model.exact.positions,
            coordinates: (model.exact.texture_coordinates.iter())
                .map(|uv| [uv[0] * size[0], uv[1] * size[1]])
                .collect(),
            focal_length_px: request.focal_length_px(),
            display: request.display,
        })
    }

    /// Measures the pixels of a view, given the faces that they show: their numbers from 1, or 0.
    pub(super) fn measure(&self, view: &Placed, faces: &[u32], sampling: &mut Sampling) {
        sampling.pixels.resize(64, 0);
        let seen: Vec<_> = self.positions.iter().map(|&point| view.see(point)).collect();
        let mut steps: Vec<Option<Step>> = vec![None; self.triangles.len()];
        let width = self.display[0] as usize;
        for (pixel, &face) in faces.iter().enumerate().filter(|&(_, &face)| face > 0) {
            let number = face as usize - 1;
            let step = *steps[number].get_or_insert_with(|| {
                let corners = self.triangles[number];
                let corners = corners.map(|corner| (seen[corner], self.coordinates[corner]));
                sampling.add_edges(corners);
                Step::new(corners.map(|(place, texels)| (self.on_screen(place), texels)))
            });
            let middle = [pixel % width, pixel / width].map(|place| place as f64 + 0.5);
            let place = (step.at(middle).log2() - LEAST) * STEPS;
            // A conversion to an integer ends at 0, where a triangle without an area has it, too.
            let place = (place as usize).min(sampling.pixels.len() - 1);
            sampling.pixels[place] += 1;
        }
    }

    /// A place in pixels from the upper left corner, and 1 / distance.
    fn on_screen(&self, [x, y, distance]: [f64; 3]) -> [f64; 3] {
        let [right, down] = self.display.map(|side| f64::from(side) / 2.0);
        let per_unit = self.focal_length_px / distance;
        [right + x * per_unit, down - y * per_unit, 1.0 / distance]
    }
}

impl Sampling {
    /// Adds a triangle's error of linear interpolation.
    ///
    /// That along a chord whose ends' distances have the ratio r is (sqrt r - 1) / (sqrt r + 1) of
    /// what changes along it ([`reference::chord_error`]): the longest chords are the edges.
    fn add_edges(&mut self, [a, b, c]: [([f64; 3], [f64; 2]); 3]) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let ratio = (from.0[2] / to.0[2]).max(to.0[2] / from.0[2]);
            let change = (0..2).map(|i| (from.1[i] - to.1[i]).abs()).fold(0.0, f64::max);
            let error = reference::chord_error(change, ratio);
            self.affine_error = self.affine_error.max(error);
            self.ratio = self.ratio.max(ratio);
        }
    }

    /// As many powers of two as the sides of the texture can be divided by so that a tenth of the
    /// pixels at most has fewer than one texel for itself.
    pub(super) fn halvings(&self) -> u32 {
        let all: u64 = self.pixels.iter().sum();
        let mut below = 0;
        for (place, pixels) in self.pixels.iter().enumerate() {
            below += pixels;
            if 10 * below > all {
                return (place as f64 / STEPS + LEAST).max(0.0) as u32;
            }
        }
        0
    }

    /// The part of the pixels whose step covers at least this number of texels.
    pub(super) fn part_of(&self, texels: f64) -> f64 {
        let all: u64 = self.pixels.iter().sum();
        let first = ((texels.log2() - LEAST) * STEPS).ceil() as usize;
        let covering: u64 = self.pixels.iter().skip(first).sum();
        covering as f64 / all.max(1) as f64
    }

    /// The texels that a step of a pixel covers, for the middle one of the pixels.
    pub(super) fn median_texels(&self) -> f64 {
        let all: u64 = self.pixels.iter().sum();
        let mut below = 0;
        let middle = self.pixels.iter().position(|pixels| {
            below += pixels;
            2 * below >= all
        });
        ((middle.unwrap_or(0) as f64 + 0.5) / STEPS + LEAST).exp2()
    }
}

/// The area of a triangle.
fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs() / 2.0
}

#[cfg(test)]
mod tests {
    use rasterizer::numbers::Rotation;

    use super::*;

    /// A triangle before the camera, 4 away, whose texture is 64 texels wide.
    fn texels(positions: &[[f64; 3]]) -> Coverage<'_> {
        Coverage {
            triangles: vec![[0, 1, 2]],
            positions,
            coordinates: vec![[0.0, 0.0], [64.0, 0.0], [0.0, 64.0]],
            focal_length_px: 200.0,
            display: [100, 80],
        }
    }

    const VIEW: Placed = Placed { rotation: Rotation::IDENTITY, distance: 4.0 };

    /// The face of each pixel: of some, the triangle.
    fn faces(pixels: &[[usize; 2]]) -> Vec<u32> {
        let mut faces = vec![0; 100 * 80];
        pixels.iter().for_each(|[x, y]| faces[y * 100 + x] = 1);
        faces
    }

    #[test]
    fn a_triangle_across_the_view_has_no_perspective() {
        let mut sampling = Sampling::default();
        // A unit is 50 pixels wide at this distance: 64 texels on 50 pixels.
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        texels(&positions).measure(&VIEW, &faces(&[[52, 38], [70, 30]]), &mut sampling);
        assert_eq!((sampling.affine_error, sampling.ratio), (0.0, 1.0));
        assert!((sampling.median_texels() / 1.28 - 1.0).abs() < 0.1, "{sampling:?}");
        assert_eq!(sampling.halvings(), 0);
    }

    #[test]
    fn a_triangle_along_the_view_has_the_error_of_its_chord() {
        let mut sampling = Sampling::default();
        // From 1 to 4 away: a third of its 64 texels.
        let positions = [[0.0, 0.0, 0.0], [0.0, 0.2, 3.0], [0.2, 0.0, 0.0]];
        texels(&positions).measure(&VIEW, &faces(&[[52, 38]]), &mut sampling);
        assert!((sampling.affine_error - 64.0 / 3.0).abs() < 1e-9, "{sampling:?}");
        assert_eq!(sampling.ratio, 4.0);
    }

    #[test]
    fn steps_of_a_triangle_grow_with_distance() {
        // A floor a unit below the camera: its texels are squares of 1/64 unit.
        let positions = [[0.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, -1.0, -1.0]];
        let floor = texels(&positions);
        let corners = [0, 1, 2].map(|corner| {
            let place = floor.on_screen(VIEW.see(positions[corner]));
            (place, floor.coordinates[corner])
        });
        let step = Step::new(corners);
        for distance in [4.0, 4.5, 5.0, 40.0] {
            let [x, y, _] = floor.on_screen([0.1, -1.0, distance]);
            // A pixel is d / 200 units wide, and d^2 / 200 long at a height of one.
            let expected = 64.0 / 200.0 * distance.powf(1.5);
            assert!((step.at([x, y]) / expected - 1.0).abs() < 1e-9, "{distance}");
        }
    }

    #[test]
    fn a_triangle_that_is_not_seen_does_not_count() {
        let mut sampling = Sampling::default();
        let positions = [[0.0, 0.0, 0.0], [0.0, 0.2, 3.0], [0.2, 0.0, 0.0]];
        texels(&positions).measure(&VIEW, &faces(&[]), &mut sampling);
        assert_eq!(sampling.affine_error, 0.0);
    }

    #[test]
    fn small_pictures_need_small_textures() {
        let mut sampling = Sampling::default();
        // 64 texels on 5 pixels: at an eighth of the size there are 1.6 for each.
        let positions = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]];
        texels(&positions).measure(&VIEW, &faces(&[[51, 38]]), &mut sampling);
        assert_eq!(sampling.halvings(), 3);
        // A step covers 12.8 of them.
        assert_eq!([1.0, 8.0, 16.0].map(|texels| sampling.part_of(texels)), [1.0, 1.0, 0.0]);
    }
}
