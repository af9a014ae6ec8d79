//! A texture that has more texels to a pixel along x than along y, and the blur of a border in it.
//!
//! A mip level has square texels. The core takes the level whose texels are as large as a pixel's
//! area on the texture ([`footprint`](rasterizer::texture::Footprint)): with m texels to a pixel
//! along y and a m along x, their side is m root(a) texels. Along y that is root(a) pixels, which
//! is blur; along x a pixel has root(a) of them and shows one. A level by the longer axis, as
//! graphics libraries take it, has one to a pixel along x, and blurs by a pixels along y.
//!
//! A border lies anywhere in a level's texel of side l, and texels are interpolated: it is blurred
//! as by a box of width l and a tent of width 2 l, of variance `l^2 / 12 + l^2 / 6`. So its
//! deviation is l / 2. Between two levels, variances are mixed by how far the level is from both:
//! up to 1.264 times that of the level in between, at 0.39 of the way.

use embedded_graphics_core::pixelcolor::{Gray8, GrayColor as _};
use rasterizer::texture::{PerTriangle, Trilinear};

use super::{
    curve::{Family, Law, Point, powers},
    square::{self, SIDE, Square, TEXELS},
    work::Cost,
};
use crate::reference::random::Random;

/// The family.
pub(super) static TRILINEAR: Family = Family {
    name: "A texture minified unevenly, trilinear",
    about: "\
A square with a texture of one border between black and white faces the viewer, at a random place. A
pixel has two texels across the border, and a times as many along it. The blur of the border in
16 x 64 pixels is the root of its variance, by the second moment of what the picture has more or
less than the border itself. An exact average over each pixel has 0.29 pixels.",
    parameter: "a: texels a pixel along the border over those across",
    error: "deviation of the blur in pixels",
    laws: &[Law {
        slope: 0.5,
        tolerance: 0.05,
        segment: [1.0, 64.0],
        why: "a level's texels have the area of a pixel, and a side of the root of a pixels (with \
              the level by the longer axis, as graphics libraries choose it, it would be 1)",
    }],
    bound: "root(a) / 2 pixels, an eighth more between two levels",
    end: "It holds for all of them, and claims little from a = 4 on, where it is over a pixel: mip \
          levels blur a slanted surface along one axis, and along the other a pixel shows one of \
          root(a) texels. The core has no filter that takes several of them.",
    cost: Cost {
        of: "to draw the 16 x 64 pixels",
        laws: &[Law {
            slope: 0.0,
            tolerance: 0.05,
            segment: [1.0, 64.0],
            why: "texels of any level take the same; between two levels, at odd powers, a pixel \
                  has eight of them, otherwise four",
        }],
        work: |ratio, random| Some(square(ratio, random).work("Trilinear(PerTriangle)")),
    },
    measure,
};

/// Texels a pixel across the border: a level's texels are then several of the texture for most a,
/// so that a border lies anywhere in them.
const ACROSS: f64 = 2.0;

/// The border blurs to up to 12 pixels on both sides. The next one is 64 pixels away.
const PICTURE: [u32; 2] = [16, 64];

/// Rows by which borders are moved: those of the largest texel of a level.
const BORDERS: usize = 16;

fn square(ratio: f64, random: &mut Random) -> Square {
    Square::new([ratio * ACROSS, ACROSS], PICTURE, random)
}

/// One in ten instances, each with 64 rows.
fn measure(instances: usize) -> Vec<Point> {
    let instances = instances.div_ceil(10);
    let textures: Vec<_> = (0..BORDERS).map(Border::new).collect();
    let point = |ratio: f64| {
        let mut random = Random(1);
        let borders = textures.iter().cycle().take(instances);
        let variances = borders.map(|border| border.variance(&square(ratio, &mut random)));
        let deviation = (variances.sum::<f64>() / instances as f64).sqrt();
        let bound = Some(1.125 * ratio.sqrt() / 2.0);
        Point { parameter: ratio, error: Some(deviation), bound, instances, without: 0 }
    };
    powers(0, 6).map(point).collect()
}

/// A texture that is white above a row, and black from there on.
struct Border {
    levels: Box<[Gray8; TEXELS]>,
    row: f64,
}

impl Border {
    /// A number of rows below the corner of the texture.
    fn new(row: usize) -> Self {
        let is_black = |y: usize| (y + SIDE - row) % SIDE < SIDE / 2;
        let levels = square::levels(|_, y| if is_black(y) { 0.0 } else { 255.0 });
        Self { levels, row: row as f64 }
    }

    /// The variance of its blur in a picture, in square pixels. Where the border itself is a step
    /// from 1 to 0 at y = 0, and f is what is seen of it, that is the integral of 2 y (f - step).
    fn variance(&self, square: &Square) -> f64 {
        let picture = square.draw(&self.levels, Trilinear(PerTriangle));
        let [width, height] = PICTURE;
        let part = |index: u32, grey: Gray8| {
            let [_, v] = square.texel([index % width, index / width]);
            let y = (v - self.row) / ACROSS;
            let step = if y < 0.0 { 1.0 } else { 0.0 };
            2.0 * y * (f64::from(grey.luma()) / 255.0 - step)
        };
        let parts = (0..width * height).zip(picture).map(|(index, grey)| part(index, grey));
        parts.sum::<f64>() / f64::from(width)
    }
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn by_mip_levels() {
        holds(&super::TRILINEAR);
    }
}
