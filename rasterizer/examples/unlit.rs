//! Materials in their plain colours, without light: `Unlit`.
//!
//! It is the shader that costs least, and reads no normals: a model for it alone is converted with
//! `--normals none`.
//!
//! `cargo run -p rasterizer --example unlit`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::prelude::*;
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const SKY: Rgb565 = Rgb565::new(12, 40, 26);

// All memory is the caller's: colour and depth of the whole picture, 4 bytes a pixel.
static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.03", "0.13", "0") })
        .scaled(const { Distance::lit("1.25") });
    let rocket = Object::new(&ROCKET, Unlit::new()).posed(pose);

    // Each vertex is projected once, into this storage: to 1/16 of a pixel (`S4`), with its depth.
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    rocket.draw(&camera(SCREEN)?, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
