//! Three formats of depth, two thousand near distances away: `u16`, `FloatDepth` and `u32`.
//!
//! A rocket 40 units away, and another one behind it, which is drawn first. There a step of `u16`
//! is 1.2 units: what is drawn first stays. `FloatDepth` takes the same memory, and resolves a
//! 2,048th of the distance at any distance, here 0.02 units: the glass of the windows is thinner.
//!
//! `cargo run -p rasterizer --example depth_formats`

#[expect(dead_code, reason = "its camera stands too near")]
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, Screen};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::{output::StoredDepth, prelude::*};
use rocket::ROCKET;

const NIGHT: Rgb565 = Rgb565::new(4, 10, 8);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));
const PART: Size = Size::new(80, 240);
const PIXELS: usize = 80 * 240;

/// Draws both rockets with a depth buffer of format `D` into the part of the display that begins at
/// a column.
fn draw_in<D: StoredDepth>(screen: &mut Screen, column: i32) -> Result {
    const EYE: Vec3 = Vec3::lit("0", "0", "40");
    // A long lens: 240 rows for 2.4 units.
    let lens = const {
        let near = Distance::lit("0.02");
        Perspective::with_focal_length(Distance::lit("4000"), near, Distance::lit("80"))
    }?;
    let part = Rectangle::new(Point::new(column, 0), PART);
    let camera = Camera::look_at(EYE, Vec3::ZERO, Vec3::Y, lens, part)?;

    let mut vertices = vec![ScreenVertex::<S4, D, _>::EMPTY; ROCKET.vertex_count()];
    let (mut color, mut depth) = (vec![NIGHT; PIXELS], vec![D::ZERO; PIXELS]);
    let mut frame = Frame::new(&mut color, &mut depth, part)?;
    for (tilt, place) in const {
        [
            (Turn::degrees(320), Vec3::lit("0.05", "0.1", "-1")),
            (Turn::degrees(30), Vec3::lit("0", "-0.1", "0")),
        ]
    } {
        let pose = Pose::rotated(Rotation::about_z(tilt)).at(place);
        let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);
        rocket.draw(&camera, &mut vertices, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    draw_in::<u16>(screen, 0)?;
    draw_in::<FloatDepth>(screen, 80)?;
    draw_in::<u32>(screen, 160)
}

fn main() -> Result {
    common::run(draw)
}
