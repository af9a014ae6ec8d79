//! A model that is not compiled in: its bytes are in external flash, and are checked once.
//!
//! Here they come by `include_bytes!`; a firmware may have a slice of memory-mapped flash instead.
//!
//! `cargo run -p rasterizer --example model_file`

mod common;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{mesh::Aligned, prelude::*};
use static_cell::ConstStaticCell;

const WALL: Rgb565 = Rgb565::new(4, 10, 7);
const SUN: Light = Light::new(Vec3::lit("-3", "3", "4"), Level::lit("0.15"), Level::lit("0.85"));

/// What `host-tools convert rocket.obj -o rocket.bin` makes.
static ROCKET: &Aligned<[u8]> = &Aligned(*include_bytes!("models/rocket.bin"));
/// Its vertices, or more.
const VERTICES: usize = 700;

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([WALL; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    // Once, when the firmware starts.
    let rocket = Mesh::from_bytes(&ROCKET.0)?;

    let camera = camera(SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; VERTICES];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let turned = Rotation::about_z(-Turn::degrees(20)) * Rotation::about_y(Turn::degrees(30));
    Object::new(&rocket, Gouraud::new(SUN)).posed(Pose::rotated(turned)).draw(
        &camera,
        &mut vertices,
        &mut frame,
    )?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
