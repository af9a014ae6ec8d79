//! One colour a triangle, by its normal and a light: `Flat`.
//!
//! Facets stay visible, and pixels cost as little as unlit ones. It reads the normals of triangles:
//! a model for it alone is converted with `--normals face`.
//!
//! `cargo run -p rasterizer --example flat`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::prelude::*;
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(4, 10, 8);

/// Where the light is, seen from the origin; it is infinitely far away.
const SUN: Vec3 = Vec3::lit("-2", "3", "4");
/// A surface has 0.25 of its colour in the shade, and 1 where it faces the sun. A constant takes no
/// code.
const LIGHT: Light = Light::new(SUN, Level::lit("0.25"), Level::lit("0.75"));

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.03", "0.13", "0") })
        .scaled(const { Distance::lit("1.25") });
    // The light stays where it is in the world; the object turns in it.
    let rocket = Object::new(&ROCKET, Flat::new(LIGHT)).posed(pose);

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    rocket.draw(&camera(SCREEN)?, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
