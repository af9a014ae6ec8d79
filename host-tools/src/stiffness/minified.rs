//! A texture of noise, from magnified to minified, against its average over each pixel.
//!
//! With m texels to a pixel and independent texels of deviation s, a pixel's average has s / m.
//!
//! * The nearest texel is one of the m^2: it is off by `s sqrt(1 - 1 / m^2)`, nearly all of s. A
//!   magnified pixel is off only where it lies on a border of texels, as often as m is large; the
//!   mean square is proportional to m.
//! * A mip level has the averages of m x m texels on a grid, and between four of them it is
//!   interpolated. Along an axis, the weights of the texels in the pixel and those of the level
//!   both have the sum 1. Over all places of the pixel the products of these weights add up to
//!   1 / m for the pixel, 2 / 3 of that for the level, and as much for both; in two dimensions
//!   `1 - 2 (2 / 3)^2 + (2 / 3)^2 = 5 / 9`, so that the level is off by `0.75 s / m`. (With one
//!   texel to a pixel both have the same weights, and the level is exact; with few it is nearly.)

use embedded_graphics_core::pixelcolor::{Gray8, GrayColor as _};
use rasterizer::texture::{Filter, Nearest, PerTriangle, Trilinear};

use super::{
    curve::{Family, Law, Point, powers},
    square::{self, SIDE, Square, TEXELS, Texture},
    work::Cost,
};
use crate::reference::random::Random;

const ABOUT: &str = "\
A square with a texture of 256 x 256 random greys faces the viewer, at a random place. The greys of
16 x 16 pixels are compared with the average of the texture over each pixel, in f64.";
const PARAMETER: &str = "texels a pixel along an axis";
const ERROR: &str = "greys of 256, root of the mean square";

/// The nearest texel.
pub(super) static NEAREST: Family = Family {
    name: "A minified texture, nearest",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[
        Law {
            slope: 0.5,
            tolerance: 0.1,
            segment: [0.125, 0.5],
            why: "a part of the pixels, in proportion to m, lies on a border of texels",
        },
        Law {
            slope: 0.0,
            tolerance: 0.1,
            segment: [4.0, 64.0],
            why: "one texel stands for all of a pixel's",
        },
    ],
    bound: "the deviation of the texture, 73.9 greys, and a tenth for the sample",
    end: "It holds for all of them, and is of no use: a minified texture needs mip levels.",
    cost: Cost {
        of: "to draw the 16 x 16 pixels",
        laws: &[flat()],
        work: |scale, random| Some(square(scale, random).work("Nearest")),
    },
    measure: |instances| measure(instances, Nearest, |_| 1.1 * DEVIATION),
};

/// Mip levels.
pub(super) static MIPMAPS: Family = Family {
    name: "A minified texture, trilinear",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law {
        slope: -1.0,
        tolerance: 0.15,
        segment: [8.0, 64.0],
        why: "the level's averages and the pixel's have deviations in proportion to 1 / m; with 8 \
              texels the pixel's border is a twelfth of it, with 64 rounding to greys adds a tenth",
    }],
    bound: "the deviation of a pixel's average, and 1 grey for rounding",
    end: "Beyond the last level, of one texel, all pixels are alike, as they should be.",
    cost: Cost {
        of: "to draw the 16 x 16 pixels",
        laws: &[],
        work: |scale, random| Some(square(scale, random).work("Trilinear(PerTriangle)")),
    },
    measure: |instances| {
        measure(instances, Trilinear(PerTriangle), |scale| DEVIATION / scale.max(1.0) + 1.0)
    },
};

/// Of cycles.
const fn flat() -> Law {
    Law {
        slope: 0.0,
        tolerance: 0.05,
        segment: [0.125, 64.0],
        why: "a pixel has one texel; a cache in front of the texture, which suffers, is not counted",
    }
}

/// Of 256 greys that are equally likely: the root of (256^2 - 1) / 12.
const DEVIATION: f64 = 73.9;

/// Width and height of the picture in pixels.
const PIXELS: u32 = 16;

fn square(scale: f64, random: &mut Random) -> Square {
    Square::new([scale; 2], [PIXELS; 2], random)
}

/// One in ten instances, each with 256 pixels.
fn measure<F>(instances: usize, filter: F, bound: fn(f64) -> f64) -> Vec<Point>
where
    F: for<'a> Filter<Texture<'a>> + Copy + std::fmt::Debug,
{
    let instances = instances.div_ceil(10);
    let mut random = Random(1);
    let levels = square::levels(|_, _| random.real(0.0, 256.0).floor());
    let point = |scale| {
        let mut random = Random(2);
        let squares = (0..instances).map(|_| mean_square(&levels, filter, scale, &mut random));
        let mean = squares.sum::<f64>() / instances as f64;
        let bound = Some(bound(scale));
        Point { parameter: scale, error: Some(mean.sqrt()), bound, instances, without: 0 }
    };
    powers(-3, 6).map(point).collect()
}

/// The mean square of the errors of a picture with `scale` texels a pixel.
fn mean_square<'a, F>(greys: &'a [Gray8; TEXELS], filter: F, scale: f64, random: &mut Random) -> f64
where
    F: Filter<Texture<'a>> + Copy + std::fmt::Debug,
{
    let square = square(scale, random);
    let squares = (0u32..).zip(square.draw(greys, filter)).map(|(index, pixel)| {
        let at = square.texel([index % PIXELS, index / PIXELS]);
        (f64::from(pixel.luma()) - average(greys, at, scale)).powi(2)
    });
    squares.sum::<f64>() / f64::from(PIXELS * PIXELS)
}

/// The average of the texture, which repeats, over a square of `side` texels about a place.
fn average(greys: &[Gray8; TEXELS], at: [f64; 2], side: f64) -> f64 {
    // The texels along an axis, and how much of each lies in the square.
    let [columns, rows] = at.map(|middle| {
        let [from, to] = [middle - side / 2.0, middle + side / 2.0];
        let texels = from.floor() as i32..to.ceil() as i32;
        texels.map(move |texel| {
            let part = to.min(f64::from(texel) + 1.0) - from.max(f64::from(texel));
            (texel.rem_euclid(SIDE as i32) as usize, part / side)
        })
    });
    let row = |y: usize| -> f64 {
        columns.clone().map(|(x, part)| part * f64::from(greys[y * SIDE + x].luma())).sum()
    };
    rows.map(|(y, part)| part * row(y)).sum()
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn by_the_nearest_texel() {
        holds(&super::NEAREST);
    }

    #[test]
    fn by_mip_levels() {
        holds(&super::MIPMAPS);
    }
}
