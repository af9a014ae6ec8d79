//! Points of a size: vertices of a mesh that has no triangles. Stars in their own colours, near
//! ones larger, and a planet that hides those behind it.
//!
//! `cargo run -p rasterizer --example points`

#[path = "models/ball.rs"]
mod ball;
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Material, PointIndices, Points, Positions, Tables},
    numbers::Scale,
    prelude::*,
    shade::Colored,
};
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(1, 2, 4);
const LIGHT: Light = Light::new(Vec3::lit("-3", "2", "1"), Level::lit("0.1"), Level::lit("0.9"));
const COUNT: usize = 250;

/// Places in a cube from -1 to 1 in quanta of 2^-15, and colours from orange to blue.
const SKY: ([[i16; 3]; COUNT], [[u8; 3]; COUNT]) = {
    let (mut places, mut colors) = ([[0; 3]; COUNT], [[0; 3]; COUNT]);
    // A linear congruential generator.
    let (mut random, mut i) = (7u32, 0);
    while i < COUNT {
        let mut axis = 0;
        while axis < 3 {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            places[i][axis] = (random >> 16) as i16;
            axis += 1;
        }
        let warmth = (random >> 8) as u8;
        colors[i] = [255 - warmth / 4, 225, 170 + warmth / 3];
        i += 1;
    }
    (places, colors)
};
static PLANET: Mesh<'static> = ball(&[Material::new([120, 150, 230], ball::TRIANGLES)]);
static STARS: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&SKY.0),
    scale: Scale::new(1, -15),
    vertex_colors: &SKY.1,
    ..Tables::EMPTY
});
const INDICES: [u8; COUNT] = {
    let (mut indices, mut i) = ([0; COUNT], 0);
    while i < COUNT {
        indices[i] = i as u8;
        i += 1;
    }
    indices
};
static SMALL: Points<'static> =
    Points::new_const(&STARS, PointIndices::U8(INDICES.split_at(150).0));
static MIDDLE: Points<'static> =
    Points::new_const(&STARS, PointIndices::U8(INDICES.split_at(150).1.split_at(80).0));
static LARGE: Points<'static> =
    Points::new_const(&STARS, PointIndices::U8(INDICES.split_at(230).1));

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    let place = const { Vec3::lit("0.2", "-0.15", "0") };
    let pose = Pose::IDENTITY.at(place).scaled(const { Distance::lit("0.45") });
    let planet = Object::new(&PLANET, Gouraud::new(LIGHT)).posed(pose);
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; PLANET.vertex_count()];
    planet.draw(&camera, &mut vertices, &mut frame)?;

    let stars = Object::new(&STARS, Colored::new());
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; STARS.vertex_count()];
    let seen = stars.project(&camera, &mut vertices)?;
    for (points, size) in [(&SMALL, 1), (&MIDDLE, 2), (&LARGE, 4)] {
        seen.points(points).sized(size).draw(&mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
