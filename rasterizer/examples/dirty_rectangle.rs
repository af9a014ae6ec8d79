//! Only what changed is drawn and sent: `Projected::bounds`.
//!
//! The second frame takes the rectangle that holds the rocket's old place and its new one. In the
//! picture, which has both outlined, it lies on a lighter ground.
//!
//! `cargo run -p rasterizer --example dirty_rectangle`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    pixelcolor::Rgb565,
    prelude::*,
    primitives::{PrimitiveStyle, Rectangle},
};
use rasterizer::prelude::*;
use rocket::ROCKET;

const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));
/// The background of the first frame and of the second.
const GROUNDS: [Rgb565; 2] = [Rgb565::new(4, 10, 8), Rgb565::new(7, 18, 13)];

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    // Memory for sixteen rows of the display, or for more rows of a narrower rectangle.
    let (mut color, mut depth) = ([Rgb565::BLACK; 240 * 16], [0u16; 240 * 16]);
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];

    // The whole display is drawn first.
    let mut last = SCREEN;
    let mut outlines = [SCREEN; 2];
    for (frame, ground) in GROUNDS.into_iter().enumerate() {
        let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose(frame as i32));
        let seen = rocket.project(&camera, &mut vertices)?;
        // None if the object is out of the picture: what it left is then all that changes.
        let bounds = seen.bounds().unwrap_or(last);
        let changed = union(&bounds, &last);
        Bands::new(changed, &mut color, &mut depth)?.show(
            screen,
            |band| band.clear_color(ground),
            |band| seen.draw(band),
        )?;
        outlines = [last, bounds];
        last = bounds;
    }

    // Not part of the technique: the two places, on the finished picture.
    for (outline, color) in outlines.iter().zip([Rgb565::CSS_GRAY, Rgb565::CSS_GOLD]) {
        outline.into_styled(PrimitiveStyle::with_stroke(color, 1)).draw(screen)?;
    }
    Ok(())
}

/// The smallest rectangle that holds both.
fn union(one: &Rectangle, other: &Rectangle) -> Rectangle {
    let last = |area: &Rectangle| area.bottom_right().unwrap_or(area.top_left);
    Rectangle::with_corners(
        one.top_left.component_min(other.top_left),
        last(one).component_max(last(other)),
    )
}

/// The rocket flies upwards and to the right.
fn pose(frame: i32) -> Pose {
    const STEP: Vec3 = Vec3::lit("0.26", "0.26", "0");
    const START: Vec3 = Vec3::lit("-0.16", "-0.12", "0");
    let tilted = Rotation::about_z(-Turn::degrees(36)) * Rotation::about_y(Turn::degrees(50));
    Pose::rotated(tilted)
        .at(START + STEP * Scalar::from_num(frame))
        .scaled(const { Distance::lit("0.9") })
}

fn main() -> Result {
    common::run(draw)
}
