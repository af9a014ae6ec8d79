//! Light times texture: `TexturedFlat` and `TexturedGouraud`, with a table of shades.
//!
//! Any texture can be lit. One of the format `Shaded` has its palette in 32 rows from dark to
//! bright: the least work for a pixel, and light of any colour.
//!
//! `cargo run -p rasterizer --example lit_texture`

#[path = "models/ball.rs"]
mod ball;
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::Material,
    prelude::*,
    texture::{Clamp, Repeat, SHADES, Shaded, Texture},
};
use static_cell::ConstStaticCell;

static PLANET: Mesh<'static> = ball(&[Material::new([255; 3], ball::TRIANGLES)]);
const SPACE: Rgb565 = Rgb565::new(1, 2, 4);
const SUN: Light = Light::new(Vec3::lit("-2", "2", "3"), Level::lit("0.05"), Level::lit("0.95"));

const WIDTH: usize = 128;
const HEIGHT: usize = 64;
/// Two texels of four bits in a byte.
const BYTES: usize = WIDTH * HEIGHT / 2;
type Map = Texture<Shaded<'static, Rgb565, 4, BYTES, 16>, WIDTH, HEIGHT, Repeat, Clamp>;
static MAPS: [Map; 1] = [Texture::new(Shaded::new(&HEIGHTS, &PALETTES))];

/// The colours of heights in full light, from the bottom of the sea to the snow.
const COLORS: [[u8; 3]; 16] = [
    [16, 40, 110],
    [18, 50, 126],
    [20, 60, 142],
    [24, 72, 158],
    [30, 88, 172],
    [44, 112, 186],
    [72, 146, 196],
    [220, 204, 140],
    [126, 168, 70],
    [92, 150, 58],
    [70, 130, 52],
    [92, 122, 60],
    [128, 112, 76],
    [146, 130, 104],
    [196, 190, 180],
    [250, 250, 252],
];

/// From a blue night to a slightly yellow day.
static PALETTES: [[Rgb565; 16]; SHADES] = {
    const NIGHT: [u32; 3] = [20, 30, 64];
    const DAY: [u32; 3] = [255, 248, 232];
    let (mut table, mut i) = ([[Rgb565::new(0, 0, 0); 16]; SHADES], 0);
    while i < SHADES * 16 {
        let (row, place) = (i / 16, i % 16);
        let bright = row as u32;
        let (mut channels, mut c) = ([0; 3], 0);
        while c < 3 {
            // In units of 1 / (255 * 31).
            let light = NIGHT[c] * (31 - bright) + DAY[c] * bright;
            channels[c] = COLORS[place][c] as u32 * light / (255 * 31);
            c += 1;
        }
        let [r, g, b] = channels;
        table[row][place] = Rgb565::new((r >> 3) as u8, (g >> 2) as u8, (b >> 3) as u8);
        i += 1;
    }
    table
};

/// Hills of three sizes: random numbers at the corners of a grid, straight lines between them.
static HEIGHTS: [u8; BYTES] = {
    let (mut table, mut i) = ([0; BYTES], 0);
    while i < WIDTH * HEIGHT {
        let (x, y) = (i % WIDTH, i / WIDTH);
        let sum = 4 * hills(x, y, 32) + 2 * hills(x, y, 16) + hills(x, y, 8);
        // The poles are under ice.
        let from_pole = if y < HEIGHT / 2 { y } else { HEIGHT - 1 - y };
        let is_ice = from_pole < 3 + hills(x, y, 4) / 64;
        // The sum is mostly about half of 7 * 255.
        let steps = if sum < 600 { 0 } else { (sum - 600) / 48 };
        let height = if is_ice || steps > 15 { 15 } else { steps };
        table[i / 2] |= (height as u8) << (4 * (i % 2));
        i += 1;
    }
    table
};

/// 0 to 255 at a texel, in a grid of cells this wide that goes round the planet.
const fn hills(x: usize, y: usize, cell: usize) -> usize {
    let (column, row) = (x / cell, y / cell);
    let (right, down) = (x % cell, y % cell);
    let upper = random(column, row, cell) * (cell - right) + random(column + 1, row, cell) * right;
    let lower =
        random(column, row + 1, cell) * (cell - right) + random(column + 1, row + 1, cell) * right;
    (upper * (cell - down) + lower * down) / (cell * cell)
}

const fn random(column: usize, row: usize, cell: usize) -> usize {
    let seed = (column % (WIDTH / cell) * 7_919 + row * 104_729 + cell * 1_299_709) as u32;
    let mixed = (seed ^ (seed >> 7)).wrapping_mul(0x9E37_79B1);
    ((mixed ^ (mixed >> 15)).wrapping_mul(0x85EB_CA77) >> 24) as usize
}

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SPACE; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let size = const { Distance::lit("0.6") };
    let tilted = Rotation::about_z(Turn::degrees(20)) * Rotation::about_y(-Turn::degrees(100));
    let pose = Pose::rotated(tilted).scaled(size);

    // Without memory for vertices: each corner of a triangle is projected when it is drawn.
    let flat = Object::new(&PLANET, TexturedFlat::new(&MAPS, SUN).with_wide_coordinates());
    let flat = flat.posed(pose.at(const { Vec3::lit("-0.4", "0.4", "0") }));
    flat.project_on_demand(&camera, S4)?.draw(&mut frame);

    let smooth = Object::new(&PLANET, TexturedGouraud::new(&MAPS, SUN).with_wide_coordinates());
    let smooth = smooth.posed(pose.at(const { Vec3::lit("0.4", "-0.4", "0") }));
    smooth.project_on_demand(&camera, S4)?.draw(&mut frame);
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
