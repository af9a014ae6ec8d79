//! Textures: the nearest texel, with coordinates in perspective, times the level of light.

use core::iter;

use rasterizer::{
    mesh::Material,
    output::Rgb565Be,
    shade::Slot,
    texture::{Grid, Mix, Outcome as _, Table, Texel as _, TexelMap, Texels, Texture, Wrap},
};

use super::paint::{Computed, Paint, Run};

/// A texture that is looked up by coordinates with 24 bits behind the point, as meshes have them.
pub trait Lookup: TexelMap {
    /// The number of the texel there.
    fn number(coordinates: [i32; 2]) -> usize;
}

impl<F: Table, const W: usize, const H: usize, X: Wrap, Y: Wrap> Lookup for Texture<F, W, H, X, Y> {
    fn number(coordinates: [i32; 2]) -> usize {
        const { Grid::new(W, H) }.nearest::<X, Y>(coordinates)
    }
}

/// A texture in the colours of the frame, or an `Option` of one.
pub trait Covering: Slot<Texture: Lookup<Texels: Texels<Color = Rgb565Be>>> {}

impl<S: Slot<Texture: Lookup<Texels: Texels<Color = Rgb565Be>>>> Covering for S {}

/// Levels of light, as the library has them for these colours.
const LEVELS: u32 = 1 << Rgb565Be::LIGHT_BITS;

/// What covers a material: a texture, or else the material's colour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Skin<S> {
    slot: S,
    color: Rgb565Be,
}

impl<S: Covering> Skin<S> {
    /// That of the material with a number. `textures` has one for each.
    pub(super) fn of(textures: &[S], (number, material): (usize, &Material)) -> Self {
        Self { slot: textures[number], color: Computed::of(material).at(1.0) }
    }

    /// Nearness, the level and half of one more, for the nearest, and the coordinates times
    /// nearness: these are linear on the screen.
    fn vertex(nearness: f32, level: f32, [u, v]: [f32; 2]) -> [f32; 4] {
        [nearness, level * LEVELS as f32 + 0.5, u * nearness, v * nearness]
    }

    /// The colour of a pixel.
    fn texel(&self, level: f32, coordinates: [f32; 2]) -> Option<Rgb565Be> {
        // Over it only by a rounding error.
        let level = (level as u32).min(LEVELS);
        self.slot.texture_or(
            |texture| {
                let number = S::Texture::number(coordinates.map(|c| c as i32));
                texture.texels().texel(number).recolored(|color| color.lit(level)).color()
            },
            || Some(self.color.lit(level)),
        )
    }
}

/// Takes coordinates times nearness to coordinates.
fn divided([nearness, _, u, v]: [f32; 4]) -> [f32; 2] {
    let distance = 1.0 / nearness;
    [u * distance, v * distance]
}

/// With a division at each pixel that is seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct EveryPixel<S>(pub(super) Skin<S>);

impl<S: Covering> Paint<4> for EveryPixel<S> {
    type Color = Rgb565Be;

    fn vertex(nearness: f32, level: f32, coordinates: [f32; 2]) -> [f32; 4] {
        Skin::<S>::vertex(nearness, level, coordinates)
    }

    fn color(&self, values: [f32; 4]) -> Option<Rgb565Be> {
        self.0.texel(values[1], divided(values))
    }
}

/// With a division every `PIXELS` pixels of a span; between them coordinates are linear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Every<S, const PIXELS: usize>(pub(super) Skin<S>);

impl<S: Covering, const PIXELS: usize> Paint<4> for Every<S, PIXELS> {
    type Color = Rgb565Be;

    fn vertex(nearness: f32, level: f32, coordinates: [f32; 2]) -> [f32; 4] {
        Skin::<S>::vertex(nearness, level, coordinates)
    }

    fn pieces(mut run: Run<4>, mut pixels: usize) -> impl Iterator<Item = (usize, Run<4>)> {
        let mut coordinates = divided(run.values);
        iter::from_fn(move || {
            if pixels == 0 {
                return None;
            }
            let piece = pixels.min(PIXELS);
            pixels -= piece;
            let [nearness, level, ..] = run.values;
            let [nearness_step, level_step, ..] = run.steps;
            let [u, v] = coordinates;
            // The last piece goes to the last pixel: the plane may be behind the camera after it.
            let (distance, part) = match (pixels, piece) {
                (0, 1) => (0.0, 0.0),
                (0, _) => ((piece - 1) as f32, 1.0 / (piece - 1) as f32),
                _ => (PIXELS as f32, 1.0 / PIXELS as f32),
            };
            run.advance(distance);
            coordinates = divided(run.values);
            let [u_step, v_step] =
                [coordinates[0] - u, coordinates[1] - v].map(|change| change * part);
            let values = [nearness, level, u, v];
            Some((piece, Run { values, steps: [nearness_step, level_step, u_step, v_step] }))
        })
    }

    fn color(&self, [_, level, u, v]: [f32; 4]) -> Option<Rgb565Be> {
        self.0.texel(level, [u, v])
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::{vec, vec::Vec};

    use rasterizer::texture::{Clamp, Colors, Keyed, Mirror, Repeat};

    use super::{
        super::{Triangle, Vertex},
        *,
    };
    use crate::stage::{PIXELS, SIZE};

    const SIDE: usize = 16;
    const BACKGROUND: Rgb565Be = Rgb565Be::new(31, 63, 31);
    /// All different, and none of them the background.
    static TEXELS: [Rgb565Be; SIDE * SIDE] = {
        let (mut texels, mut i) = ([BACKGROUND; SIDE * SIDE], 0);
        while i < texels.len() {
            texels[i] = Rgb565Be::new((i % SIDE) as u8, (i / SIDE) as u8, 9);
            i += 1;
        }
        texels
    };

    type Tiles<X, Y> = Texture<Colors<'static, Rgb565Be, 256>, SIDE, SIDE, X, Y>;

    /// Pixels to the right, downwards and ahead of the camera, and coordinates there.
    const CORNERS: [[f64; 5]; 3] =
        [[-3.0, 2.0, 2.5, -1.25, 1.75], [4.0, 1.5, 3.0, 1.5, 1.875], [1.0, -9.0, 12.0, 0.75, -1.5]];
    const FOCAL_LENGTH: f64 = 110.0;

    fn middle() -> [f64; 2] {
        [SIZE.width, SIZE.height].map(|size| f64::from(size) / 2.0)
    }

    fn skin<S>(slot: S) -> Skin<S> {
        Skin { slot, color: Rgb565Be::new(20, 40, 8) }
    }

    /// The pixels that a paint draws of the triangle.
    fn drawn<P: Paint<4, Color = Rgb565Be>>(paint: &P, level: f32) -> (Vec<Rgb565Be>, Vec<f32>) {
        let (mut color, mut depth) = (vec![BACKGROUND; PIXELS], vec![0.0; PIXELS]);
        let corners = CORNERS.map(|[x, y, z, u, v]| {
            let place = [x, y].map(|c| c * FOCAL_LENGTH / z);
            let q24 = [u, v].map(|c| (c * 16_777_216.0) as f32);
            Vertex {
                x: (middle()[0] + place[0]) as f32,
                y: (middle()[1] + place[1]) as f32,
                values: P::vertex((1.0 / z) as f32, level, q24),
            }
        });
        Triangle::of(corners).unwrap().draw(&mut color, &mut depth, paint);
        (color, depth)
    }

    /// The coordinates in texels where the ray through a pixel meets the triangle, if it does: by
    /// Cramer's rule from the corners in space.
    fn exact(pixel: usize) -> Option<[f64; 2]> {
        let at = [pixel % SIZE.width as usize, pixel / SIZE.width as usize];
        let ray = [0, 1].map(|i| (at[i] as f64 + 0.5 - middle()[i]) / FOCAL_LENGTH);
        let triple = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        let [a, b, c] = CORNERS.map(|[x, y, z, ..]| [x, y, z]);
        let ray = [ray[0], ray[1], 1.0];
        let weights = [triple(ray, b, c), triple(a, ray, c), triple(a, b, ray)];
        let sum: f64 = weights.iter().sum();
        let parts = weights.map(|weight| weight / sum);
        let is_inside = parts.iter().all(|&part| part > 0.0);
        let mean = |i: usize| (0..3).map(|corner| parts[corner] * CORNERS[corner][i]).sum::<f64>();
        is_inside.then(|| [3, 4].map(|i| mean(i) * SIDE as f64))
    }

    /// Each pixel that is well inside a texel shows it.
    fn check<X: Wrap, Y: Wrap>(wrapped: [fn(i32) -> i32; 2]) {
        let (color, _) = drawn(&EveryPixel(skin(Tiles::<X, Y>::new(Colors::new(&TEXELS)))), 1.0);
        let mut found = 0;
        for (pixel, shown) in color.into_iter().enumerate() {
            let Some(coordinates) = exact(pixel) else { continue };
            let off = coordinates.map(|c| (c - c.round()).abs());
            if off.iter().any(|&off| off < 1e-3) {
                continue;
            }
            let texel = [0, 1].map(|i| wrapped[i](coordinates[i].floor() as i32) as usize);
            assert_eq!(shown, TEXELS[texel[1] * SIDE + texel[0]], "{pixel}: {coordinates:?}");
            found += 1;
        }
        assert!(found > 5000, "{found}");
    }

    #[test]
    fn pixels_show_the_texel_of_the_exact_perspective() {
        let repeated = |texel: i32| texel.rem_euclid(16);
        let mirrored = |texel: i32| [texel, 31 - texel][usize::from(texel & 16 != 0)] & 15;
        let clamped = |texel: i32| texel.clamp(0, 15);
        check::<Repeat, Repeat>([repeated; 2]);
        check::<Mirror, Clamp>([mirrored, clamped]);
    }

    #[test]
    fn pieces_are_exact_at_their_first_pixels_and_the_last_one_at_its_last() {
        type Sixteen = Every<Tiles<Repeat, Repeat>, 16>;
        // Coordinates are u = (2 + x) / (1 - x / 64), v = 3 / (1 - x / 64) at the pixel x.
        let exact = |x: f32| [(2.0 + x) / (1.0 - x / 64.0), 3.0 / (1.0 - x / 64.0)];
        let run = Run { values: [1.0, 0.5, 2.0, 3.0], steps: [-1.0 / 64.0, 0.25, 1.0, 0.0] };
        for (pixels, wanted) in [(1, &[1][..]), (16, &[16]), (17, &[16, 1]), (40, &[16, 16, 8])] {
            let pieces: Vec<_> = Sixteen::pieces(run, pixels).collect();
            assert_eq!(pieces.iter().map(|(pixels, _)| *pixels).collect::<Vec<_>>(), wanted);
            let mut x = 0;
            let is_near = |values: [f32; 4], x: usize| {
                let [u, v] = exact(x as f32);
                let wanted = [1.0 - x as f32 / 64.0, 0.5 + x as f32 / 4.0, u, v];
                let off = [0, 1, 2, 3].map(|i| (values[i] - wanted[i]).abs() / wanted[i]);
                assert!(off.iter().all(|&off| off < 1e-5), "{values:?}, not {wanted:?}");
            };
            for &(pixels, run) in &pieces {
                is_near(run.values, x);
                x += pixels;
            }
            let (last, mut run) = pieces[pieces.len() - 1];
            run.advance((last - 1) as f32);
            is_near(run.values, x - 1);
        }
    }

    #[test]
    fn pieces_make_up_the_whole_span() {
        let skin = skin(Tiles::<Repeat, Repeat>::new(Colors::new(&TEXELS)));
        let [(_, whole), (_, in_pieces)] =
            [drawn(&EveryPixel(skin), 1.0), drawn(&Every::<_, 16>(skin), 1.0)];
        assert!(whole.iter().filter(|&&nearness| nearness > 0.0).count() > 5000);
        // A step rounds values below 1/2 by at most 2^-26, and a span has at most 320.
        let most = 2.0 * 320.0 / 67_108_864.0;
        for (whole, piece) in whole.into_iter().zip(in_pieces) {
            assert!((whole - piece).abs() <= most && (whole > 0.0) == (piece > 0.0));
        }
    }

    #[test]
    fn light_is_that_of_the_library_and_holes_show_what_is_behind() {
        let keyed = Keyed::new(Colors::new(&TEXELS), TEXELS[5]);
        let map: Texture<Keyed<_>, SIDE, SIDE, Repeat, Repeat> = Texture::new(keyed);
        let (full, _) =
            drawn(&EveryPixel(skin(Tiles::<Repeat, Repeat>::new(Colors::new(&TEXELS)))), 1.0);
        // 0.71 of 32 levels are 22.72.
        let (lit, depth) = drawn(&EveryPixel(skin(map)), 0.71);
        let (bare, _) = drawn(&EveryPixel(skin(None::<Tiles<Repeat, Repeat>>)), 0.71);
        let mut holes = 0;
        for (i, &texel) in full.iter().enumerate() {
            if texel == BACKGROUND {
                continue;
            }
            assert_eq!(bare[i], Rgb565Be::new(20, 40, 8).lit(23));
            let is_hole = texel == TEXELS[5];
            assert_eq!(lit[i], if is_hole { BACKGROUND } else { texel.lit(23) });
            assert_eq!(depth[i] == 0.0, is_hole);
            holes += usize::from(is_hole);
        }
        assert!(holes > 10, "{holes}");
    }
}
