//! What perspective does to a texture, and how many of its texels a pixel covers.

use super::views::Placed;
use crate::{model::Model, reference};

/// A model with texture coordinates, for measuring in views.
pub(super) struct Texels<'a> {
    triangles: Vec<[usize; 3]>,
    positions: &'a [[f64; 3]],
    /// In texels.
    coordinates: Vec<[f64; 2]>,
    focal_length_px: f64,
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

impl<'a> Texels<'a> {
    /// Those of a model, or `None` without textures.
    pub(super) fn new(model: &'a Model, focal_length_px: f64) -> Option<Self> {
        let size = model.textures.as_ref()?.size.map(|side| side as f64);
        let table = model.triangles.as_triangles();
        Some(Self {
            triangles: (0..model.report.triangles).filter_map(|number| table.get(number)).collect(),
            positions: &model.exact.positions,
            coordinates: (model.exact.texture_coordinates.iter())
                .map(|uv| [uv[0] * size[0], uv[1] * size[1]])
                .collect(),
            focal_length_px,
        })
    }

    /// Measures the triangles that a view shows, each by its number of pixels.
    ///
    /// The error of linear interpolation along a chord whose ends' distances have the ratio r is
    /// (sqrt r - 1) / (sqrt r + 1) of what changes along it ([`reference::chord_error`]): the
    /// longest chords are the edges.
    pub(super) fn measure(&self, view: &Placed, pixels_of: &[u32], sampling: &mut Sampling) {
        sampling.pixels.resize(64, 0);
        let seen: Vec<_> = self.positions.iter().map(|&point| view.see(point)).collect();
        for (&corners, &pixels) in self.triangles.iter().zip(pixels_of) {
            if pixels == 0 {
                continue;
            }
            let [a, b, c] = corners.map(|corner| (seen[corner], self.coordinates[corner]));
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let ratio = (from.0[2] / to.0[2]).max(to.0[2] / from.0[2]);
                let change = (0..2).map(|i| (from.1[i] - to.1[i]).abs()).fold(0.0, f64::max);
                let error = reference::chord_error(change, ratio);
                sampling.affine_error = sampling.affine_error.max(error);
                sampling.ratio = sampling.ratio.max(ratio);
            }
            let place = [a, b, c].map(|(at, _)| [at[0] / at[2], at[1] / at[2]]);
            let on_screen = area(place) * self.focal_length_px.powi(2);
            let texels = area([a.1, b.1, c.1]);
            // The side of a square of as many texels as a pixel covers.
            let step = (texels / on_screen).sqrt().max(f64::MIN_POSITIVE).log2();
            let place = ((step - LEAST) * STEPS).clamp(0.0, 63.0);
            sampling.pixels[place as usize] += u64::from(pixels);
        }
    }
}

impl Sampling {
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
    fn texels(positions: &[[f64; 3]]) -> Texels<'_> {
        Texels {
            triangles: vec![[0, 1, 2]],
            positions,
            coordinates: vec![[0.0, 0.0], [64.0, 0.0], [0.0, 64.0]],
            focal_length_px: 200.0,
        }
    }

    const VIEW: Placed = Placed { rotation: Rotation::IDENTITY, distance: 4.0 };

    #[test]
    fn a_triangle_across_the_view_has_no_perspective() {
        let mut sampling = Sampling::default();
        // A unit is 50 pixels wide at this distance: 64 texels on 50 pixels.
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        texels(&positions).measure(&VIEW, &[100], &mut sampling);
        assert_eq!((sampling.affine_error, sampling.ratio), (0.0, 1.0));
        assert!((sampling.median_texels() / 1.28 - 1.0).abs() < 0.1, "{sampling:?}");
        assert_eq!(sampling.halvings(), 0);
    }

    #[test]
    fn a_triangle_along_the_view_has_the_error_of_its_chord() {
        let mut sampling = Sampling::default();
        // From 1 to 4 away: a third of its 64 texels.
        let positions = [[0.0, 0.0, 0.0], [0.0, 0.2, 3.0], [0.2, 0.0, 0.0]];
        texels(&positions).measure(&VIEW, &[100], &mut sampling);
        assert!((sampling.affine_error - 64.0 / 3.0).abs() < 1e-9, "{sampling:?}");
        assert_eq!(sampling.ratio, 4.0);
    }

    #[test]
    fn a_triangle_that_is_not_seen_does_not_count() {
        let mut sampling = Sampling::default();
        let positions = [[0.0, 0.0, 0.0], [0.0, 0.2, 3.0], [0.2, 0.0, 0.0]];
        texels(&positions).measure(&VIEW, &[0], &mut sampling);
        assert_eq!(sampling.affine_error, 0.0);
    }

    #[test]
    fn small_pictures_need_small_textures() {
        let mut sampling = Sampling::default();
        // 64 texels on 5 pixels: at an eighth of the size there are 1.6 for each.
        let positions = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]];
        texels(&positions).measure(&VIEW, &[100], &mut sampling);
        assert_eq!(sampling.halvings(), 3);
    }
}
