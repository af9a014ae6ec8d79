//! Four ways to put a colour onto another: `Over`, `Add`, `Multiply` and `Screen`, each a pane of
//! the same orange before a rocket.
//!
//! `cargo run -p rasterizer --example blending_modes`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, camera};
use embedded_graphics::{
    mono_font::{MonoTextStyle, ascii::FONT_6X10},
    pixelcolor::Rgb565,
    prelude::*,
    text::{Alignment, Text},
};
use rasterizer::{
    color::Alpha,
    mesh::{Material, Positions, Tables, Triangles},
    numbers::Scale,
    output::{Add, Multiply, Over, Screen},
    prelude::*,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const SKY: Rgb565 = Rgb565::new(9, 22, 15);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));

/// A square of side 1/2.
static PANE: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[
        [-8192, -8192, 0],
        [8192, -8192, 0],
        [8192, 8192, 0],
        [-8192, 8192, 0],
    ]),
    scale: Scale::new(1, -15),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([230, 130, 30], 2)],
    ..Tables::EMPTY
});

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut common::Screen) -> Result {
    let camera = camera(SCREEN)?;
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted).scaled(const { Distance::lit("1.15") });
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    rocket.draw(&camera, &mut vertices, &mut frame)?;

    // Each mode is a type, so that the code of its own mode alone blends an object's pixels.
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; PANE.vertex_count()];
    let pane = |x: &str, y: &str| -> Result<_> {
        let at = Vec3::new(x.parse()?, y.parse()?, Scalar::lit("0.6"));
        Ok(Object::new(&PANE, Unlit::new())
            .posed(Pose::IDENTITY.at(at).scaled(Distance::lit("1.5"))))
    };
    let part = const { Alpha::lit("0.7") };
    pane("-0.44", "0.44")?.blended(Over(part)).draw(&camera, &mut vertices, &mut frame)?;
    pane("0.44", "0.44")?.blended(Add(part)).draw(&camera, &mut vertices, &mut frame)?;
    pane("-0.44", "-0.44")?.blended(Multiply(part)).draw(&camera, &mut vertices, &mut frame)?;
    pane("0.44", "-0.44")?.blended(Screen(part)).draw(&camera, &mut vertices, &mut frame)?;

    let style = MonoTextStyle::new(&FONT_6X10, Rgb565::WHITE);
    for (name, place) in
        [("Over", (60, 14)), ("Add", (180, 14)), ("Multiply", (60, 232)), ("Screen", (180, 232))]
    {
        Text::with_alignment(name, place.into(), style, Alignment::Center).draw(&mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
