//! All memory of a picture, known when the firmware is compiled: `Needs`.
//!
//! `cargo run -p rasterizer --example needs`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use std::fmt::Write as _;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    mono_font::{MonoTextStyle, ascii::FONT_6X10},
    pixelcolor::Rgb565,
    prelude::*,
    text::Text,
};
use heapless::String;
use rasterizer::{prelude::*, shade::OnScreen};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const ROWS: u32 = 16;
const NEEDS: Needs = Needs::of(&ROCKET, SCREEN.size, ROWS);

type Shading = Gouraud<Rgb565>;
/// What one vertex takes depends on precision, depth and shader.
type Vertex = ScreenVertex<S4, u16, OnScreen<Shading>>;

// The linker places them, and reports if RAM is too small.
static COLOR: ConstStaticCell<[Rgb565; NEEDS.pixels]> =
    ConstStaticCell::new([Rgb565::BLACK; NEEDS.pixels]);
static DEPTH: ConstStaticCell<[u16; NEEDS.pixels]> = ConstStaticCell::new([0; NEEDS.pixels]);
static VERTICES: ConstStaticCell<[Vertex; NEEDS.vertices]> =
    ConstStaticCell::new([Vertex::EMPTY; NEEDS.vertices]);
static BINS: ConstStaticCell<[u32; NEEDS.bin_words]> = ConstStaticCell::new([0; NEEDS.bin_words]);

const BYTES: usize = NEEDS.bytes::<S4, u16, Shading>();
const _: () = assert!(BYTES <= 32 * 1024, "the picture takes more RAM than there is for it");

const NIGHT: Rgb565 = Rgb565::new(4, 10, 8);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(20)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.28", "0.02", "0") })
        .scaled(const { Distance::lit("1.05") });
    let rocket = Object::new(&ROCKET, Shading::new(LIGHT)).posed(pose);

    let seen = rocket.project(&camera(SCREEN)?, VERTICES.take())?.binned(ROWS, BINS.take())?;
    Bands::new(SCREEN, COLOR.take(), DEPTH.take())?.show(
        screen,
        |band| band.clear_color(NIGHT),
        |band| seen.draw(band),
    )?;

    let style = MonoTextStyle::new(&FONT_6X10, Rgb565::CSS_GOLD);
    for (line, (name, bytes)) in [
        ("vertices", NEEDS.vertices * size_of::<Vertex>()),
        ("bins", NEEDS.bin_words * size_of::<u32>()),
        ("colour", NEEDS.pixels * size_of::<Rgb565>()),
        ("depth", NEEDS.pixels * size_of::<u16>()),
        ("together", BYTES),
    ]
    .into_iter()
    .enumerate()
    {
        let mut text = String::<32>::new();
        write!(text, "{name:8} {bytes:6} bytes")?;
        Text::new(&text, Point::new(10, 20 + 12 * line as i32), style).draw(screen)?;
    }
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
