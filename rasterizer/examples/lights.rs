//! Several lights: an array or a tuple of them takes the place of one.
//!
//! A sun from the left, a weaker one from the right that fills the shadows, and one from behind
//! that draws the outline. Levels are added, and the sum is at most full light.
//!
//! `cargo run -p rasterizer --example lights`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::prelude::*;
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(2, 5, 6);
/// Ambient light is that of all together: one of them has it.
const KEY: Light = Light::new(Vec3::lit("-3", "1", "2"), Level::lit("0.08"), Level::lit("0.8"));
const FILL: Light = Light::new(Vec3::lit("3", "-1", "2"), Level::ZERO, Level::lit("0.25"));
const RIM: Light = Light::new(Vec3::lit("2", "4", "-2"), Level::ZERO, Level::lit("0.8"));

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let tilted = Rotation::about_z(-Turn::degrees(20)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted).scaled(const { Distance::lit("0.7") });
    let left = pose.at(const { Vec3::lit("-0.5", "0", "0") });
    let right = pose.at(const { Vec3::lit("0.5", "0", "0") });

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let one = Object::new(&ROCKET, Gouraud::new(KEY)).posed(left);
    one.draw(&camera, &mut vertices, &mut frame)?;
    let three = Object::new(&ROCKET, Gouraud::new([KEY, FILL, RIM])).posed(right);
    three.draw(&camera, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
