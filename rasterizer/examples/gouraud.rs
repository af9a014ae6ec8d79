//! Light worked out at the vertices and interpolated between them: `Gouraud`.
//!
//! Curved surfaces look round. It reads the normals of vertices: a model for it alone is converted
//! with `--normals vertex`, and edges sharper than `--crease` stay sharp.
//!
//! `cargo run -p rasterizer --example gouraud`

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
const SUN: Vec3 = Vec3::lit("-2", "3", "4");
const LIGHT: Light = Light::new(SUN, Level::lit("0.15"), Level::lit("0.9"));

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.03", "0.13", "0") })
        .scaled(const { Distance::lit("1.25") });
    // 64 levels of brightness for each material, as many as RGB565 can show.
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);

    // A vertex carries its light level too, which the compiler infers from the shader.
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    rocket.draw(&camera(SCREEN)?, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
