//! Several objects straight onto the display, sorted from back to front: `Painter`.
//!
//! There is no buffer for pixels or depth. A word for each triangle orders all of them: the rocket
//! flies through the moons of its planet, before some and behind others.
//!
//! `cargo run -p rasterizer --example painter`

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
    prelude::*,
    scene::Painter,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(2, 3, 6);
const LIGHT: Light = Light::new(Vec3::lit("-3", "2", "3"), Level::lit("0.1"), Level::lit("0.9"));

static MOON: Mesh<'static> = ball(&[Material::new([196, 186, 160], ball::TRIANGLES)]);
static OTHER: Mesh<'static> = ball(&[Material::new([96, 150, 190], ball::TRIANGLES)]);

/// A word for each triangle of all objects.
static ORDER: ConstStaticCell<[u32; WORDS]> = ConstStaticCell::new([0; WORDS]);
const WORDS: usize = ROCKET.triangle_count() + 2 * MOON.triangle_count() + OTHER.triangle_count();

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let tilted = Rotation::about_z(-Turn::degrees(50)) * Rotation::about_y(Turn::degrees(70));
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(Pose::rotated(tilted));
    let ball = |mesh, place, size| {
        Object::new(mesh, Gouraud::new(LIGHT)).posed(Pose::IDENTITY.at(place).scaled(size))
    };
    let behind = ball(&OTHER, const { Vec3::lit("0.3", "0.35", "-0.6") }, Distance::lit("0.5"));
    let before = ball(&MOON, const { Vec3::lit("-0.3", "-0.45", "0.7") }, Distance::lit("0.28"));
    let small = ball(&MOON, const { Vec3::lit("0.3", "-0.02", "0.55") }, Distance::lit("0.13"));

    // The vertices of stored objects stay until all is drawn; those of the moons are projected
    // when a triangle needs them.
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let rocket = rocket.project(&camera, &mut vertices)?;
    let behind = behind.project_on_demand(&camera, S4)?;
    let before = before.project_on_demand(&camera, S4)?;
    let small = small.project_on_demand(&camera, S4)?;

    screen.clear(NIGHT)?;
    Painter::new((&rocket, &behind, &before, &small), ORDER.take())?
        .draw(&mut Direct::new(screen))?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
