//! One sample a pixel on the left, and the mean of 4 x 4 on the right: `Bands::supersampled`.
//!
//! `cargo run -p rasterizer --example supersampling`

mod common;
/// What `host-tools convert --edges 0` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, Screen, camera};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::{output::Supersampled, prelude::*};
use rocket::ROCKET;

const LEFT: Rectangle = Rectangle::new(Point::zero(), Size::new(120, 240));
const RIGHT: Rectangle = Rectangle::new(Point::new(120, 0), Size::new(120, 240));
/// A part of the display in samples: what a camera sees.
const SAMPLES: Rectangle = Supersampled::<4>::area(RIGHT);

const LIGHT: Light = Light::new(Vec3::lit("-2", "1", "3"), Level::lit("0.2"), Level::lit("0.8"));
const PAPER: Rgb565 = Rgb565::new(29, 58, 27);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(9)) * Rotation::about_y(Turn::degrees(70));
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(Pose::rotated(tilted));
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];

    // 24 rows of a band.
    let (mut color, mut depth) = ([PAPER; 120 * 24], [0u16; 120 * 24]);
    let seen = rocket.project(&camera(LEFT)?, &mut vertices)?;
    Bands::new(LEFT, &mut color[..], &mut depth)?.show(
        screen,
        |band| band.clear_color(PAPER),
        |band| seen.draw(band),
    )?;

    // 16 rows of samples: four of the display.
    let (mut color, mut depth) = ([PAPER; 480 * 16], [0u16; 480 * 16]);
    let seen = rocket.project(&camera(SAMPLES)?, &mut vertices)?;
    Bands::supersampled::<4>(RIGHT, &mut color[..], &mut depth)?.show(
        screen,
        |band| band.clear_color(PAPER),
        |band| seen.draw(band),
    )?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
