//! Straight onto the display, without a buffer for pixels, depth or vertices: `Direct`.
//!
//! Each row of a triangle is a call of the display's `fill_contiguous`. Nothing tests depth: it is
//! for convex objects, and for objects drawn from back to front. `project_on_demand` projects a
//! vertex whenever a triangle needs it.
//!
//! `cargo run -p rasterizer --example direct`

#[path = "models/ball.rs"]
mod ball;
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use rasterizer::{
    mesh::{Material, Mesh},
    prelude::*,
};

const LIGHT: Light = Light::new(Vec3::lit("3", "2", "2"), Level::lit("0.06"), Level::lit("0.98"));

/// From pole to pole in stripes. The counts of triangles are multiples of 80, but 40 at the poles.
static PLANET: Mesh<'static> = ball(&[
    Material::new([226, 240, 244], 40 + 80),
    Material::new([120, 190, 220], 3 * 80),
    Material::new([64, 130, 200], 4 * 80),
    Material::new([96, 170, 224], 2 * 80),
    Material::new([40, 96, 176], 5 * 80),
    Material::new([110, 180, 216], 3 * 80 + 40),
]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    screen.clear(Rgb565::BLACK)?;
    let stars = (1..80).map(|n| Point::new(n * 149 % 240, n * n * 7 % 239));
    screen.draw_iter(stars.map(|star| Pixel(star, Rgb565::CSS_SLATE_GRAY)))?;

    let tilted = Rotation::about_z(-Turn::degrees(25)) * Rotation::about_x(Turn::degrees(15));
    let pose = Pose::rotated(tilted).scaled(const { Distance::lit("0.85") });
    let planet = Object::new(&PLANET, Gouraud::new(LIGHT)).posed(pose);
    planet.project_on_demand(&camera(SCREEN)?, S4)?.draw(&mut Direct::new(screen))?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
