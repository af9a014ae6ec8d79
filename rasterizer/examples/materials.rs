//! Materials with finishes: the `Ks`, `Ns` and `Ke` of an MTL file beside its `Kd`.
//!
//! `host-tools convert` writes this table for a model whose library has them. Here a ball has four
//! materials in rings: a lamp that gives off light, matte clay, brass with coloured highlights, and
//! black lacquer with small white ones. A second light shows a second highlight.
//!
//! `cargo run -p rasterizer --example materials`

#[path = "models/ball.rs"]
mod ball;
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Finish, Material, Mesh, Tables},
    prelude::*,
    shade::{OnScreen, Phong},
};
use static_cell::ConstStaticCell;

const WALL: Rgb565 = Rgb565::new(5, 9, 5);
const WINDOW: Light = Light::new(Vec3::lit("-2", "2", "4"), Level::lit("0.15"), Level::lit("0.75"));
const SPOT: Light = Light::new(Vec3::lit("3", "0.5", "2"), Level::ZERO, Level::lit("0.5"));

/// From the north pole, in rings of 80 triangles, but 40 at the poles.
static BALL: Mesh<'static> = Mesh::new_const(Tables {
    finishes: &[
        Finish::MATTE.with_emission([250, 200, 90]),
        Finish::MATTE,
        Finish::MATTE.with_specular([255, 220, 130], 25),
        Finish::MATTE.with_specular([255; 3], 90),
    ],
    ..*ball(&[
        Material::new([60, 40, 10], 40 + 3 * 80),
        Material::new([190, 110, 80], 5 * 80),
        Material::new([150, 110, 40], 5 * 80),
        Material::new([40, 30, 60], 5 * 80 + 40),
    ])
    .tables()
});

type Vertex = ScreenVertex<S4, u16, OnScreen<Phong<Rgb565, [Light; 2]>>>;
const VERTICES: usize = BALL.vertex_count();

static NORMALS: ConstStaticCell<[Vertex; VERTICES]> =
    ConstStaticCell::new([Vertex::EMPTY; VERTICES]);
static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([WALL; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    // The lower rings are turned to the viewer, and all of them rolled.
    let turned = Rotation::about_z(Turn::degrees(25)) * Rotation::about_x(-Turn::degrees(12));
    let pose = Pose::rotated(turned).scaled(const { Distance::lit("0.95") });
    let shader = Phong::new([WINDOW, SPOT]);
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let object = Object::new(&BALL, shader).posed(pose);
    object.draw(&camera(SCREEN)?, NORMALS.take(), &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
