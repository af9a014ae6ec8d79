//! A robot arm: the pose of each link is composed with the one that carries it. Half way between
//! two gestures every joint is half way between two rotations.
//!
//! `cargo run -p rasterizer --example robot_arm`

#[expect(dead_code, reason = "the camera is another one")]
mod common;

use common::{Result, SCREEN, Screen};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Material, Mesh, Normals, Positions, Tables, Triangles},
    numbers::{Quaternion, Scale},
    prelude::*,
};
use static_cell::ConstStaticCell;

const WALL: Rgb565 = Rgb565::new(4, 10, 7);
const SUN: Light = Light::new(Vec3::lit("-3", "3", "4"), Level::lit("0.2"), Level::lit("0.8"));

/// From a joint to the next one: a sixteenth of a unit wide, and half a unit high.
const LINK: Tables<'static> = Tables {
    positions: Positions::I16(&[
        [-2, -1, -2],
        [2, -1, -2],
        [-2, 17, -2],
        [2, 17, -2],
        [-2, -1, 2],
        [2, -1, 2],
        [-2, 17, 2],
        [2, 17, 2],
    ]),
    scale: Scale::new(1, -5),
    triangles: Triangles::U8(&[
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
    ]),
    face_normals: Normals::I8(&[
        [-127, 0, 0],
        [-127, 0, 0],
        [127, 0, 0],
        [127, 0, 0],
        [0, -127, 0],
        [0, -127, 0],
        [0, 127, 0],
        [0, 127, 0],
        [0, 0, -127],
        [0, 0, -127],
        [0, 0, 127],
        [0, 0, 127],
    ]),
    ..Tables::EMPTY
};
static LINKS: [Mesh<'static>; 3] = [
    Mesh::new_const(Tables { materials: &[Material::new([90, 110, 130], 12)], ..LINK }),
    Mesh::new_const(Tables { materials: &[Material::new([170, 140, 70], 12)], ..LINK }),
    Mesh::new_const(Tables { materials: &[Material::new([240, 150, 40], 12)], ..LINK }),
];

/// Where the next joint is.
const NEXT: Vec3 = Vec3::lit("0", "0.5", "0");

/// The axis of each joint, and its angle in the first gesture and in the second, in degrees.
const JOINTS: [(Vec3, u32, u32); 6] = [
    (Vec3::Y, 0, 40),
    (Vec3::Z, 70, 310),
    (Vec3::Z, 315, 20),
    (Vec3::lit("1", "0", "1"), 320, 60),
    (Vec3::Z, 330, 330),
    (Vec3::lit("0", "1", "2"), 330, 75),
];

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([WALL; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let lens = const { Perspective::new(Turn::degrees(40), Distance::ONE, Distance::lit("50")) }?;
    let eye = const { Vec3::lit("0", "2", "5.7") };
    let target = const { Vec3::lit("0", "1.1", "0") };
    let camera = Camera::look_at(eye, target, Vec3::Y, lens, SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; LINKS[0].vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    let times = const { [Scalar::ZERO, Scalar::lit("0.5"), Scalar::ONE] };
    for (mesh, time) in LINKS.iter().zip(times) {
        let mut carrier = Pose::IDENTITY.at(Vec3::X * (time - const { Scalar::lit("0.5") }));
        for (axis, from, to) in JOINTS {
            let [from, to] = [from, to].map(|angle| Quaternion::about(axis, Turn::degrees(angle)));
            let (Some(from), Some(to)) = (from, to) else { continue };
            let joint = Pose::rotated(from.slerp(to, time).into());
            let link = carrier.compose(joint);
            Object::new(mesh, Flat::new(SUN)).posed(link).draw(
                &camera,
                &mut vertices,
                &mut frame,
            )?;
            carrier = link.compose(Pose::IDENTITY.at(NEXT));
        }
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
