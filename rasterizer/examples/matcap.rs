//! Matcap: a picture of a lit ball gives each normal its colour, `Matcap`.
//!
//! Light, highlight and a rim of light from behind cost what a texture costs. The compiler computes
//! the picture; a photo of a ball does as well.
//!
//! `cargo run -p rasterizer --example matcap`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    prelude::*,
    shade::Matcap,
    texture::{Bilinear, Clamp, Colors, Texture},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const WALL: Rgb565 = Rgb565::new(5, 9, 6);

const SIDE: usize = 64;
type Ball = Texture<Colors<'static, Rgb565, { SIDE * SIDE }>, SIDE, SIDE, Clamp, Clamp>;
static BALLS: [Ball; 1] = [Texture::new(Colors::new(&TEXELS))];

/// Copper: a soft light from above, a sharp highlight, and a cold rim.
static TEXELS: [Rgb565; SIDE * SIDE] = {
    let (mut texels, mut i) = ([WALL; SIDE * SIDE], 0);
    while i < SIDE * SIDE {
        // The normal, in 128ths of its length.
        let x = 4 * (i % SIDE) as i32 - 126;
        let y = 126 - 4 * (i / SIDE) as i32;
        let rest = 128 * 128 - x * x - y * y;
        let z = if rest > 0 { rest.isqrt() } else { 0 };
        // From the light at (-1, 2, 2) / 3, and its mirror image.
        let diffuse = positive(-x + 2 * y + 2 * z) / 3;
        let mirrored = positive(2 * z * (2 * y - x + 2 * z) / 128 - 256) / 3;
        let mut highlight = mirrored;
        let mut power = 0;
        while power < 3 {
            highlight = highlight * highlight / 128;
            power += 1;
        }
        let rim = positive(100 - z) * positive(x - y + 60) / 128;
        texels[i] = color(
            channel([210, 30], [diffuse, rim, highlight]),
            channel([110, 70], [diffuse, rim, highlight]),
            channel([60, 130], [diffuse, rim, highlight]),
        );
        i += 1;
    }
    texels
};

const fn positive(number: i32) -> i32 {
    if number > 0 { number } else { 0 }
}

/// A channel of copper in the light, with that of the sky at the rim: 0 to 255.
const fn channel([copper, sky]: [i32; 2], [diffuse, rim, highlight]: [i32; 3]) -> i32 {
    copper * (24 + diffuse) / 128 + sky * rim / 100 + 2 * highlight
}

const fn color(red: i32, green: i32, blue: i32) -> Rgb565 {
    Rgb565::new((least(red) >> 3) as u8, (least(green) >> 2) as u8, (least(blue) >> 3) as u8)
}

const fn least(channel: i32) -> i32 {
    if channel < 255 { channel } else { 255 }
}

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([WALL; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let tilted = Rotation::about_z(-Turn::degrees(30)) * Rotation::about_x(Turn::degrees(20));
    let shader = Matcap::new(&BALLS).filtered(Bilinear);
    let rocket = Object::new(&ROCKET, shader).posed(Pose::rotated(tilted));
    rocket.project_on_demand(&camera, S4)?.draw(&mut frame);
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
