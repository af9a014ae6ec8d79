//! Highlights by vertex and by pixel: `GlossyGouraud` above, `Phong` below, with exponents of 8, 30
//! and 120.
//!
//! A highlight by vertex takes triangles that are smaller than it is. By pixel, the normal is
//! interpolated and made a unit vector for each: the highlight is round at any size.
//!
//! `cargo run -p rasterizer --example highlights`

#[path = "models/ball.rs"]
mod ball;
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Finish, Material, Mesh, Tables},
    prelude::*,
    shade::{GlossyGouraud, OnScreen, Phong},
};
use static_cell::ConstStaticCell;

const PAPER: Rgb565 = Rgb565::new(4, 9, 6);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.12"), Level::lit("0.8"));

const MATERIALS: &[Material] = &[Material::new([40, 90, 190], ball::TRIANGLES)];

/// A ball with highlights of this exponent.
const fn shiny(finishes: &'static [Finish; 1]) -> Mesh<'static> {
    Mesh::new_const(Tables { finishes, ..*ball(MATERIALS).tables() })
}

static BALLS: [Mesh<'static>; 3] = [
    shiny(&[Finish::MATTE.with_specular([230; 3], 8)]),
    shiny(&[Finish::MATTE.with_specular([230; 3], 30)]),
    shiny(&[Finish::MATTE.with_specular([230; 3], 120)]),
];
const VERTICES: usize = BALLS[0].vertex_count();

/// Vertices carry normals, with near / w: these are interpolated in perspective.
type Vertex = ScreenVertex<S4, u16, OnScreen<Phong<Rgb565>>>;

static NORMALS: ConstStaticCell<[Vertex; VERTICES]> =
    ConstStaticCell::new([Vertex::EMPTY; VERTICES]);
static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([PAPER; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let places = const { [Vec3::lit("-0.7", "0", "0"), Vec3::ZERO, Vec3::lit("0.7", "0", "0")] };
    let [up, down] = const { [Vec3::lit("0", "0.45", "0"), Vec3::lit("0", "-0.45", "0")] };
    let normals = NORMALS.take();
    let size = Pose::IDENTITY.scaled(const { Distance::lit("0.33") });
    for (ball, place) in BALLS.iter().zip(places) {
        let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; VERTICES];
        let by_vertex = Object::new(ball, GlossyGouraud::new(LIGHT)).posed(size.at(place + up));
        by_vertex.draw(&camera, &mut vertices, &mut frame)?;

        let by_pixel = Object::new(ball, Phong::new(LIGHT)).posed(size.at(place + down));
        by_pixel.draw(&camera, normals, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
