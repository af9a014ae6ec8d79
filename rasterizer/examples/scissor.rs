//! A view in a view: a rocket in the whole picture, and its nose in a pane that nothing of either
//! leaves: `Scissored`.
//!
//! `cargo run -p rasterizer --example scissor`

mod common;
/// What `host-tools convert --edges 0` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    pixelcolor::Rgb565,
    prelude::*,
    primitives::{PrimitiveStyle, Rectangle},
};
use rasterizer::{output::Scissored, prelude::*};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const SKY: Rgb565 = Rgb565::new(6, 18, 12);
const PAPER: Rgb565 = Rgb565::new(29, 58, 27);
const LIGHT: Light = Light::new(Vec3::lit("-3", "2", "3"), Level::lit("0.2"), Level::lit("0.8"));
/// The pane, and the frame round it.
const PANE: Rectangle = Rectangle::new(Point::new(132, 22), Size::new(88, 88));
const BORDER: Rectangle = Rectangle::new(Point::new(130, 20), Size::new(92, 92));

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(Turn::degrees(30)) * Rotation::about_y(Turn::degrees(70));
    let pose = Pose::rotated(tilted).at(const { Vec3::lit("-0.2", "-0.15", "0") });
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    rocket.draw(&camera(SCREEN)?, &mut vertices, &mut frame)?;

    // Behind the second view: its own background, and a depth that hides nothing.
    frame.fill_solid(&BORDER, Rgb565::BLACK)?;
    PANE.into_styled(PrimitiveStyle::with_fill(PAPER)).draw(&mut frame)?;
    frame.clear_depth();
    // A camera near the nose. Its picture is as large as the display, and the pane cuts it.
    let viewport = Rectangle::new(Point::new(40, -70), SCREEN.size);
    let near = const { Vec3::lit("-0.4", "0.5", "2") };
    let lens =
        const { Perspective::new(Turn::degrees(45), Distance::lit("0.1"), Distance::lit("100")) }?;
    let close = Camera::at(near, Rotation::IDENTITY, lens, viewport)?;
    rocket.draw(&close, &mut vertices, &mut Scissored::new(&mut frame, &PANE))?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
