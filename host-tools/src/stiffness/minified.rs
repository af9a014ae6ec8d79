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

use embedded_graphics_core::{
    geometry::{Point, Size},
    pixelcolor::{Gray8, GrayColor as _},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{Affine, NoDepth},
    camera::{Camera, Distance, Orthographic},
    geometry::{Pose, ScreenVertex},
    mesh::{Material, Mesh, Positions, Tables, TextureCoordinates, Triangles},
    numbers::{Rotation, S8, Scale, Vec3},
    output::Frame,
    scene::Object,
    shade::{OnScreen, Shader, Textured},
    texture::{Colors, Filter, Mipmaps, Nearest, PerTriangle, Trilinear},
};

use super::{
    curve::{Family, Law, Point as CurvePoint, powers},
    stage::{self, Lens, Stage},
    work::{Cost, Scene, Work},
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
        work: |scale, random| Some(work(scale, "Nearest", random)),
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
        work: |scale, random| Some(work(scale, "Trilinear(PerTriangle)", random)),
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
const SIDE: usize = 256;
/// Of all levels.
const TEXELS: usize = (4 * SIDE * SIDE - 1) / 3;
type Texture<'a> = Mipmaps<Colors<'a, Gray8, TEXELS>, SIDE, SIDE>;

/// Width and height of the picture in pixels.
const PIXELS: u32 = 16;
/// Half the width of the square in pixels.
const HALF: i16 = 32;

/// One in ten instances, each with 256 pixels.
fn measure<F>(instances: usize, filter: F, bound: fn(f64) -> f64) -> Vec<CurvePoint>
where
    F: for<'a> Filter<Texture<'a>> + Copy + std::fmt::Debug,
{
    let instances = instances.div_ceil(10);
    let levels = levels(&mut Random(1));
    let point = |scale| {
        let mut random = Random(2);
        let squares = (0..instances).map(|_| mean_square(&levels, filter, scale, &mut random));
        let mean = squares.sum::<f64>() / instances as f64;
        let bound = Some(bound(scale));
        CurvePoint { parameter: scale, error: Some(mean.sqrt()), bound, instances, without: 0 }
    };
    powers(-3, 6).map(point).collect()
}

/// The greys of all levels, each the rounded average of four of the level before it.
fn levels(random: &mut Random) -> Box<[Gray8; TEXELS]> {
    let mut level: Vec<f64> = (0..SIDE * SIDE).map(|_| random.real(0.0, 256.0).floor()).collect();
    let mut side = SIDE;
    let mut greys = Vec::with_capacity(TEXELS);
    loop {
        greys.extend(level.iter().map(|&grey| Gray8::new(grey.round() as u8)));
        if side == 1 {
            break;
        }
        let four = |x: usize, y: usize| -> f64 {
            let row = |y: usize| level[y * side + 2 * x] + level[y * side + 2 * x + 1];
            (row(2 * y) + row(2 * y + 1)) / 4.0
        };
        let half = side / 2;
        level = (0..half * half).map(|place| four(place % half, place / half)).collect();
        side = half;
    }
    greys.into_boxed_slice().try_into().expect("it has all levels")
}

/// The corners of the square.
const POSITIONS: [[i16; 3]; 4] =
    [[-HALF, -HALF, 0], [HALF, -HALF, 0], [HALF, HALF, 0], [-HALF, HALF, 0]];

/// Their texture coordinates. v runs down.
fn coordinates(scale: f64) -> [[i32; 2]; 4] {
    let end = (f64::from(HALF) * scale / SIDE as f64 * 2f64.powi(24)) as i32;
    [[-end, end], [end, end], [end, -end], [-end, -end]]
}

/// Where the square's middle is.
fn place(random: &mut Random) -> [f64; 3] {
    [random.real(-8.0, 8.0), random.real(-8.0, 8.0), -50.0]
}

/// Draws the square with a filter.
fn work(scale: f64, filter: &'static str, random: &mut Random) -> Work {
    let stage = Stage {
        positions: POSITIONS.to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        scale: Scale::ONE,
        pose: Pose::IDENTITY.at(stage::vector(place(random))),
        eye: Vec3::ZERO,
        lens: Lens::orthographic(Distance::ONE, Distance::from_num(100)),
    };
    let side = PIXELS as i32;
    Work::DrawTexture {
        scene: Scene {
            texture_coordinates: coordinates(scale).to_vec(),
            size: [PIXELS; 2],
            ..stage.scene::<S8>()
        },
        part: [0, 0, side, side],
        filter,
        correction: "Affine".into(),
    }
}

/// The mean square of the errors of a picture with `scale` texels a pixel.
fn mean_square<'a, F>(greys: &'a [Gray8; TEXELS], filter: F, scale: f64, random: &mut Random) -> f64
where
    F: Filter<Texture<'a>> + Copy + std::fmt::Debug,
{
    let coordinates = coordinates(scale);
    let mesh = Mesh::new_const(Tables {
        positions: Positions::I16(&POSITIONS),
        texture_coordinates: TextureCoordinates::I32(&coordinates),
        triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
        materials: const { &[Material::new([255; 3], 2)] },
        ..Tables::EMPTY
    });
    let place = place(random);
    let pose = Pose::IDENTITY.at(stage::vector(place));
    let picture = Rectangle::new(Point::zero(), Size::new(PIXELS, PIXELS));
    let height = Distance::from_num(PIXELS);
    let camera = Orthographic::new(height, Distance::ONE, Distance::from_num(100))
        .and_then(|lens| Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, picture))
        .expect("the distances are in order");
    let textures = [Mipmaps::new(Colors::new(greys))];
    let shader =
        Textured::new(&textures).filtered(filter).corrected(Affine).with_wide_coordinates();
    let mut pixels = vec![Gray8::new(0); (PIXELS * PIXELS) as usize];
    let mut frame = Frame::without_depth(&mut pixels, picture).expect("it has its size");
    draw(Object::new(&mesh, shader).posed(pose), &camera, &mut frame);
    let middle = f64::from(PIXELS) / 2.0;
    let squares = (0u32..).zip(&pixels).map(|(index, pixel)| {
        let [column, row] = [index % PIXELS, index / PIXELS].map(|c| f64::from(c) + 0.5);
        // In texels.
        let at = [column - middle - place[0], row - middle + place[1]].map(|c| c * scale);
        (f64::from(pixel.luma()) - average(greys, at, scale)).powi(2)
    });
    squares.sum::<f64>() / f64::from(PIXELS * PIXELS)
}

fn draw<Sh: Shader<Color = Gray8>>(
    object: Object<'_, Sh>,
    camera: &Camera<Orthographic>,
    frame: &mut Frame<'_, Gray8, NoDepth>,
) {
    let mut vertices = [ScreenVertex::<S8, NoDepth, OnScreen<Sh>>::EMPTY; 4];
    let Ok(()) = object.draw(camera, &mut vertices, frame) else {
        unreachable!("the square is in the view")
    };
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
