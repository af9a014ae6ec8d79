//! Two cameras on one picture: `Perspective` on the left, `Orthographic` on the right.
//!
//! A camera fills its viewport, a rectangle of the display, and its projection is part of its type:
//! a firmware links the code of those that it names. Both see the same three rockets, one behind
//! the other; in a parallel projection size does not depend on distance.
//!
//! `cargo run -p rasterizer --example projections`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::prelude::*;
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(4, 10, 8);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));
const HALF: Size = Size::new(120, 240);
const LEFT: Rectangle = Rectangle::new(Point::zero(), HALF);
const RIGHT: Rectangle = Rectangle::new(Point::new(120, 0), HALF);

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    const NEAR: Distance = Distance::lit("0.1");
    const FAR: Distance = Distance::lit("100");
    let perspective = camera(LEFT)?;
    // From the same place; 2.2 units fill the height of the viewport.
    let lens = const { Orthographic::new(Distance::lit("2.2"), NEAR, FAR) }?;
    let parallel = Camera::look_at(perspective.eye(), Vec3::ZERO, Vec3::Y, lens, RIGHT)?;

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    frame.fill_solid(&RIGHT, Rgb565::new(7, 11, 11))?;
    for place in const {
        [
            Vec3::lit("-0.15", "-0.45", "0"),
            Vec3::lit("0", "0.05", "-1.5"),
            Vec3::lit("0.15", "0.5", "-3"),
        ]
    } {
        let tilted = Rotation::about_z(-Turn::degrees(30)) * Rotation::about_y(Turn::degrees(50));
        let pose = Pose::rotated(tilted).at(place).scaled(const { Distance::lit("0.5") });
        let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);
        rocket.draw(&perspective, &mut vertices, &mut frame)?;
        rocket.draw(&parallel, &mut vertices, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
