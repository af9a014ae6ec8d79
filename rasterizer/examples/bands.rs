//! The picture in bands of twelve rows, in memory for one of them: `Bands`.
//!
//! 11.25 KB of colour and depth instead of 225 KB. Vertices are projected once; bins tell each band
//! which triangles reach it.
//!
//! `cargo run -p rasterizer --example bands`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use rasterizer::prelude::*;
use rocket::ROCKET;

const ROWS: u32 = 12;
/// The lengths of all buffers, at compile time.
const NEEDS: Needs = Needs::of(&ROCKET, SCREEN.size, ROWS);
const SUN: Vec3 = Vec3::lit("3", "-1", "3");
const LIGHT: Light = Light::new(SUN, Level::lit("0.25"), Level::lit("0.8"));

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(15)) * Rotation::about_y(Turn::degrees(40));
    let pose = Pose::rotated(tilted).scaled(const { Distance::lit("1.1") });
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);

    let (mut color, mut depth) = ([Rgb565::BLACK; NEEDS.pixels], [0u16; NEEDS.pixels]);
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; NEEDS.vertices];
    let mut bins = [0; NEEDS.bin_words];

    // What can fail about an object fails here, before the first pixel.
    let seen = rocket.project(&camera(SCREEN)?, &mut vertices)?.binned(ROWS, &mut bins)?;
    Bands::new(SCREEN, &mut color, &mut depth)?.show(
        screen,
        |band| band.clear_color(evening(band.bounding_box().top_left.y)),
        |band| seen.draw(band),
    )?;
    Ok(())
}

/// The sky's colour in a row: dark blue above, orange at the horizon.
fn evening(row: i32) -> Rgb565 {
    const SKY: [i32; 3] = [3, 8, 14];
    const HORIZON: [i32; 3] = [31, 38, 10];
    let [r, g, b] = core::array::from_fn(|i| SKY[i] + (HORIZON[i] - SKY[i]) * row / 240);
    Rgb565::new(r as u8, g as u8, b as u8)
}

fn main() -> Result {
    common::run(draw)
}
