//! The edges of a model as lines: all of them, those that the model does not hide, and over the lit
//! model.
//!
//! `cargo run -p rasterizer --example wireframe`

mod common;
/// What `host-tools convert --edges 0` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{prelude::*, raster::Bias};
use rocket::{ROCKET, ROCKET_EDGES};
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(1, 5, 5);
const GREEN: Rgb565 = Rgb565::new(6, 60, 12);
const DARK: Rgb565 = Rgb565::new(3, 6, 5);
const LIGHT: Light = Light::new(Vec3::lit("-3", "2", "3"), Level::lit("0.2"), Level::lit("0.8"));

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let upright = Rotation::about_z(Turn::degrees(12)) * Rotation::about_x(Turn::degrees(25));
    let pose = |x| {
        Pose::rotated(upright * Rotation::about_y(Turn::degrees(30)))
            .at(Vec3::new(x, Default::default(), Default::default()))
            .scaled(const { Distance::lit("0.72") })
    };
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).biased(Bias::BEHIND_LINES);
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    // All edges.
    let seen = rocket.posed(pose(const { Scalar::lit("-0.66") }));
    let seen = seen.project(&camera, &mut vertices)?;
    seen.lines(&ROCKET_EDGES).fill(GREEN, &mut frame)?;

    // Those that the model does not hide.
    let seen = rocket.posed(pose(Scalar::ZERO)).project(&camera, &mut vertices)?;
    seen.draw_depth(&mut frame)?;
    seen.lines(&ROCKET_EDGES).fill(GREEN, &mut frame)?;

    // Over the model.
    let seen = rocket.posed(pose(const { Scalar::lit("0.66") })).project(&camera, &mut vertices)?;
    seen.draw(&mut frame)?;
    seen.lines(&ROCKET_EDGES).fill(DARK, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
