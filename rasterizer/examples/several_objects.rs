//! Several objects in one picture: each is drawn by a call, and the depth buffer sorts them.
//!
//! The rocket flies before the planet, which hides a part of its moon.
//!
//! `cargo run -p rasterizer --example several_objects`

#[path = "models/ball.rs"]
mod ball;
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Material, Mesh},
    prelude::*,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(1, 3, 3);
const LIGHT: Light = Light::new(Vec3::lit("-3", "2", "3"), Level::lit("0.08"), Level::lit("0.92"));

/// From pole to pole in stripes. The counts of triangles are multiples of 80, but 40 at the poles.
static PLANET: Mesh<'static> = ball(&[
    Material::new([150, 120, 100], 40 + 2 * 80),
    Material::new([214, 178, 130], 3 * 80),
    Material::new([170, 106, 66], 2 * 80),
    Material::new([232, 206, 166], 3 * 80),
    Material::new([190, 130, 86], 3 * 80),
    Material::new([222, 190, 146], 2 * 80),
    Material::new([160, 112, 80], 3 * 80 + 40),
]);
static MOON: Mesh<'static> = ball(&[Material::new([150, 160, 180], ball::TRIANGLES)]);

/// Objects with shaders of one type share their storage: it holds the largest mesh.
const VERTICES: usize = {
    let (rocket, ball) = (ROCKET.vertex_count(), PLANET.vertex_count());
    if rocket > ball { rocket } else { ball }
};

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let shader = Gouraud::new(LIGHT);
    let planet = Pose::rotated(Rotation::about_z(Turn::degrees(20)))
        .at(const { Vec3::lit("-0.32", "-0.3", "-1") })
        .scaled(const { Distance::lit("1.05") });
    let moon = Pose::IDENTITY
        .at(const { Vec3::lit("0.62", "0.8", "-2.5") })
        .scaled(const { Distance::lit("0.45") });
    let tilted = Rotation::about_z(-Turn::degrees(60)) * Rotation::about_y(Turn::degrees(40));
    let rocket = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.32", "-0.12", "0.6") })
        .scaled(const { Distance::lit("0.5") });

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; VERTICES];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    for (mesh, pose) in [(&ROCKET, rocket), (&PLANET, planet), (&MOON, moon)] {
        Object::new(mesh, shader).posed(pose).draw(&camera, &mut vertices, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
