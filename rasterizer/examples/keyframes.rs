//! A bird between the shapes of three files, and a flock of it: its vertices and normals are
//! interpolated as they are projected.
//!
//! In the middle the wings are as in each file: up, level, down. The flock round it is at eight
//! times between them.
//!
//! `cargo run -p rasterizer --example keyframes`

/// What `host-tools convert bird_up.obj bird_level.obj bird_down.obj -o bird.rs --name BIRD` makes.
#[path = "models/bird.rs"]
pub mod bird;
mod common;

use bird::BIRD_KEYFRAMES;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{mesh::Progress, prelude::*};
use static_cell::ConstStaticCell;

const SKY: Rgb565 = Rgb565::new(14, 38, 27);
const SUN: Light = Light::new(Vec3::lit("-3", "4", "2"), Level::lit("0.25"), Level::lit("0.75"));

/// The large birds: their shape, and how high they are.
const SHAPES: [(usize, Vec3); 3] = [
    (0, Vec3::lit("-0.34", "0.36", "0")),
    (1, Vec3::lit("-0.34", "-0.1", "0")),
    (2, Vec3::lit("-0.34", "-0.5", "0")),
];
/// The flock.
const BIRDS: i32 = 8;

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; BIRD_KEYFRAMES.mesh().vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let heading = Rotation::about_x(Turn::degrees(24)) * Rotation::about_y(Turn::degrees(38));

    for (shape, place) in SHAPES {
        let tween = BIRD_KEYFRAMES.between(shape, shape, Progress::ZERO).ok_or("no such shape")?;
        let pose = Pose::rotated(heading).at(place).scaled(const { Distance::lit("0.52") });
        Object::morphed(&tween, Gouraud::new(SUN)).posed(pose).draw(
            &camera,
            &mut vertices,
            &mut frame,
        )?;
    }
    for bird in 0..BIRDS {
        // From 0, wings up, to 2, wings down.
        let time = Distance::from_num(2 * bird) / BIRDS as u32;
        let tween = BIRD_KEYFRAMES.at(time);
        // One behind and above the other, in steps of 2^-16.
        let place =
            Vec3::from_bits([36_000 + bird % 2 * 14_000, -52_000 + 15_000 * bird, -4_000 * bird]);
        let pose = Pose::rotated(heading).at(place).scaled(const { Distance::lit("0.2") });
        Object::morphed(&tween, Gouraud::new(SUN)).posed(pose).draw(
            &camera,
            &mut vertices,
            &mut frame,
        )?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
