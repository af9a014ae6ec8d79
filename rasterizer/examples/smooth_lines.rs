//! Antialiased lines: the visible edges of a model by the diamond-exit rule, antialiased by
//! coverage, and as lines of light that add up where they cross.
//!
//! `cargo run -p rasterizer --example smooth_lines`

mod common;
/// What `host-tools convert --edges 0` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    color::Alpha,
    fixed::types::U8F8,
    output::{Add, KeepDepth},
    prelude::*,
    raster::Bias,
};
use rocket::{ROCKET, ROCKET_EDGES};
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(1, 5, 5);
const GREEN: Rgb565 = Rgb565::new(6, 60, 12);
const GLOW: Rgb565 = Rgb565::new(4, 20, 28);

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
    let rocket = Object::new(&ROCKET, Unlit::new()).biased(Bias::BEHIND_LINES);
    let mut vertices = [ScreenVertex::<S8, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    // Pixels that are on or off.
    let seen = rocket.posed(pose(const { Scalar::lit("-0.66") }));
    let seen = seen.project(&camera, &mut vertices)?;
    seen.draw_depth(&mut frame)?;
    seen.lines(&ROCKET_EDGES).fill(GREEN, &mut frame)?;

    // The same lines antialiased.
    let seen = rocket.posed(pose(Scalar::ZERO)).project(&camera, &mut vertices)?;
    seen.draw_depth(&mut frame)?;
    seen.lines(&ROCKET_EDGES).smooth(U8F8::ONE).fill(GREEN, &mut frame)?;

    // All of them, added to what is there.
    let seen = rocket.posed(pose(const { Scalar::lit("0.66") })).project(&camera, &mut vertices)?;
    let glow = seen.lines(&ROCKET_EDGES).smooth(const { U8F8::lit("1.5") });
    glow.blended(KeepDepth(Add(Alpha::OPAQUE))).fill(GLOW, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
