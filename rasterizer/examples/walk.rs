//! A walk through a small world, in bands of a few rows: `Scene`, `each`, `Levels`, two cameras,
//! fog, a shadow and a label. `world/mod.rs` draws a frame; the firmware that is measured draws the
//! same.
//!
//! `cargo run -p rasterizer --example walk` also writes the moving picture of all frames.

#[expect(dead_code, reason = "the cameras are others")]
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;
mod world;

use common::{Result, Screen};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use rasterizer::output::Bands;
use world::{BAND_ROWS, FRAMES, SCREEN, Storage};

/// Draws a frame: 32 rows of 240 pixels with depth take 30 KB, the rocket's vertices and the rows
/// of all objects 10 KB.
fn draw_frame(frame: u32, screen: &mut Screen) -> Result {
    let mut storage = Storage::EMPTY;
    let mut color = [Rgb565::BLACK; 240 * BAND_ROWS];
    let mut depth = [0u16; 240 * BAND_ROWS];
    let mut bands = Bands::new(SCREEN, &mut color[..], &mut depth[..])?;
    Ok(world::draw(frame, &mut storage, &mut bands, screen)?)
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    draw_frame(2, screen)
}

/// The moving picture, eight frames a second: an animated PNG.
pub(crate) fn moving_picture() -> Result<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, SCREEN.size.width, SCREEN.size.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    encoder.set_animated(FRAMES, 0)?;
    encoder.set_frame_delay(1, 8)?;
    let mut writer = encoder.write_header()?;
    for frame in 0..FRAMES {
        let mut screen = Screen::default();
        draw_frame(frame, &mut screen)?;
        writer.write_image_data(&screen.rgb())?;
    }
    writer.finish()?;
    Ok(file)
}

fn main() -> Result {
    common::run(draw)?;
    common::write("walk_moving", &moving_picture()?)
}
