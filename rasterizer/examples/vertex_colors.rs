//! Colours of vertices: `Colored` as they are, and `ColoredGouraud` in the light.
//!
//! The converter takes them from lines `v x y z r g b` of a file; here the compiler computes them.
//!
//! `cargo run -p rasterizer --example vertex_colors`

#[path = "models/ball.rs"]
mod ball;
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Material, Positions, Tables},
    prelude::*,
    shade::{Colored, ColoredGouraud},
};
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(2, 4, 4);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "2"), Level::lit("0.1"), Level::lit("0.9"));

const BALL: Mesh<'static> = ball(&[Material::new([255; 3], ball::TRIANGLES)]);
static COLORED: Mesh<'static> =
    Mesh::new_const(Tables { vertex_colors: &COLORS, ..*BALL.tables() });

/// Red grows to the right, green upwards and blue towards the viewer.
static COLORS: [[u8; 3]; BALL.vertex_count()] = {
    let Positions::I16(positions) = BALL.tables().positions else { panic!("another format") };
    let (mut colors, mut vertex) = ([[0; 3]; BALL.vertex_count()], 0);
    while vertex < colors.len() {
        let mut axis = 0;
        while axis < 3 {
            colors[vertex][axis] = ((positions[vertex][axis] as i32 + 32_768) >> 8) as u8;
            axis += 1;
        }
        vertex += 1;
    }
    colors
};

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let pose =
        Pose::rotated(Rotation::about_y(Turn::degrees(30))).scaled(const { Distance::lit("0.6") });
    let unlit = Object::new(&COLORED, Colored::new());
    let unlit = unlit.posed(pose.at(const { Vec3::lit("-0.4", "0.4", "0") }));
    unlit.project_on_demand(&camera, S4)?.draw(&mut frame);
    let lit = Object::new(&COLORED, ColoredGouraud::new(LIGHT));
    let lit = lit.posed(pose.at(const { Vec3::lit("0.4", "-0.4", "0") }));
    lit.project_on_demand(&camera, S4)?.draw(&mut frame);
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
