//! A lamp among balls: light from a point, which gets weaker with distance.
//!
//! `Lamp` has a place in the world and the distance at which its level is half. It goes with any
//! shader that takes a light; with a `Light` in a tuple, the night is not quite dark.
//!
//! `cargo run -p rasterizer --example lamp`

#[path = "models/ball.rs"]
mod ball;
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Material, Mesh},
    prelude::*,
    shade::Lamp,
};
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(1, 2, 3);
const MOON: Light = Light::new(Vec3::lit("0", "1", "0"), Level::lit("0.05"), Level::lit("0.1"));
const PLACE: Vec3 = Vec3::lit("0.05", "0.05", "0.2");
const LAMP: Lamp = Lamp::new(PLACE, Distance::lit("1.2"), Level::ONE);

static BULB: Mesh<'static> = ball(&[Material::new([255, 240, 190], ball::TRIANGLES)]);
static BALL: Mesh<'static> = ball(&[Material::new([220, 170, 110], ball::TRIANGLES)]);

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    // Each ball sees the lamp in its own direction and at its own distance.
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; BALL.vertex_count()];
    let lit = Object::new(&BALL, Gouraud::new((MOON, LAMP)));
    for (place, size) in const {
        [
            (Vec3::lit("-0.55", "0.3", "0"), Distance::lit("0.28")),
            (Vec3::lit("0.5", "0.5", "-0.4"), Distance::lit("0.3")),
            (Vec3::lit("0.6", "-0.35", "0.3"), Distance::lit("0.2")),
            (Vec3::lit("-0.3", "-0.6", "-0.2"), Distance::lit("0.35")),
            (Vec3::lit("-1.1", "1.1", "-1.5"), Distance::lit("0.3")),
        ]
    } {
        let pose = Pose::IDENTITY.at(place).scaled(size);
        lit.posed(pose).draw(&camera, &mut vertices, &mut frame)?;
    }

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; BULB.vertex_count()];
    let bulb = Pose::IDENTITY.at(PLACE).scaled(const { Distance::lit("0.06") });
    let bulb = Object::new(&BULB, Unlit::new()).posed(bulb);
    bulb.draw(&camera, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
