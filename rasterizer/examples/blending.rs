//! Glass: an object whose pixels are blended with those behind it, `Object::blended`.
//!
//! `cargo run -p rasterizer --example blending`

#[path = "models/ball.rs"]
mod ball;
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use rasterizer::{
    mesh::{Material, Mesh},
    output::Blend,
    prelude::*,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(4, 10, 8);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));
/// A light at the camera: the rim of the ball, which it grazes, stays dark.
const FRONT: Light = Light::new(Vec3::Z, Level::lit("0.1"), Level::lit("1.1"));
static GLASS: Mesh<'static> = ball(&[Material::new([255, 255, 255], ball::TRIANGLES)]);

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

/// The brighter the glass is lit, the more of what lies behind it is seen; the rest is sky.
fn see_through(stored: Rgb565, lit: Rgb565) -> Rgb565 {
    const SKY: Rgb565 = Rgb565::new(14, 50, 31);
    let part = u32::from(lit.g());
    let channel = |behind: u8, sky: u8| {
        ((u32::from(behind) * part + u32::from(sky) * (63 - part)) / 63) as u8
    };
    Rgb565::new(
        channel(stored.r(), SKY.r()),
        channel(stored.g(), SKY.g()),
        channel(stored.b(), SKY.b()),
    )
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted).scaled(const { Distance::lit("0.92") });
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);
    // Any function of two colours: the stored one and the shader's.
    let glass = Object::new(&GLASS, Gouraud::new(FRONT)).blended(Blend(see_through));

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; GLASS.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    // What is seen through comes after what is seen through it.
    rocket.draw(&camera, &mut vertices, &mut frame)?;
    glass.draw(&camera, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
