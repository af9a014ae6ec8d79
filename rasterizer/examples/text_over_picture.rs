//! Stars under the object, a line and text over it: a `Frame` is a `DrawTarget`.
//!
//! What embedded-graphics draws there leaves the depth as it is: before an object it is background,
//! after it, it lies over the object. The bands of a picture take it too, in the display's
//! coordinates.
//!
//! `cargo run -p rasterizer --example text_over_picture`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    mono_font::{MonoTextStyle, ascii::FONT_6X10, ascii::FONT_9X18_BOLD},
    pixelcolor::Rgb565,
    prelude::*,
    primitives::{Line, PrimitiveStyle},
    text::Text,
};
use rasterizer::prelude::*;
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(2, 5, 6);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(25)) * Rotation::about_y(Turn::degrees(45));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.1", "0.08", "0") })
        .scaled(const { Distance::lit("0.95") });
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let stars = (1..90).map(|n| Pixel(Point::new(n * 149 % 240, n * n * 7 % 211), star(n)));
    frame.draw_iter(stars)?;

    rocket.draw(&camera(SCREEN)?, &mut vertices, &mut frame)?;

    let title = MonoTextStyle::new(&FONT_9X18_BOLD, Rgb565::WHITE);
    Text::new("ROCKET", Point::new(12, 24), title).draw(&mut frame)?;
    let label = MonoTextStyle::new(&FONT_6X10, Rgb565::CSS_GOLD);
    let leader = PrimitiveStyle::with_stroke(Rgb565::CSS_GOLD, 1);
    for (text, from, to) in [
        ("window", Point::new(196, 130), Point::new(160, 95)),
        ("fin", Point::new(26, 150), Point::new(80, 170)),
        ("nozzle", Point::new(150, 216), Point::new(104, 198)),
    ] {
        Line::new(from, to).into_styled(leader).draw(&mut frame)?;
        Text::new(text, from + Point::new(-8, 10), label).draw(&mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

/// One in four stars is bright.
const fn star(number: i32) -> Rgb565 {
    if number % 4 == 0 { Rgb565::CSS_WHITE } else { Rgb565::CSS_SLATE_GRAY }
}

fn main() -> Result {
    common::run(draw)
}
