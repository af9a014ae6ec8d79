//! Models that a matrix changes before their pose: stretched, mirrored, sheared, flattened.
//!
//! Above, a ball in the air, and as it hits the ground; a rocket, and the same in a mirror. Below,
//! the rocket sheared to one side, and made narrow. Light is as on models that were made
//! in these shapes.
//!
//! `cargo run -p rasterizer --example shaped`

#[path = "models/ball.rs"]
mod ball;
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Material, Mesh},
    numbers::Matrix,
    prelude::*,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const WALL: Rgb565 = Rgb565::new(4, 10, 7);
const LIGHT: Light = Light::new(Vec3::lit("-3", "3", "4"), Level::lit("0.15"), Level::lit("0.85"));

static BALL: Mesh<'static> = ball(&[Material::new([226, 92, 60], ball::TRIANGLES)]);

const ZERO: Scalar = Scalar::ZERO;
const ONE: Scalar = Scalar::ONE;

const STRETCHED: Matrix =
    Matrix::scaling(Scalar::lit("0.8"), Scalar::lit("1.5"), Scalar::lit("0.8"));
const SQUASHED: Matrix =
    Matrix::scaling(Scalar::lit("1.35"), Scalar::lit("0.55"), Scalar::lit("1.35"));
const MIRRORED: Matrix = Matrix::scaling(Scalar::NEG_ONE, ONE, ONE);
/// What is higher is farther to the right.
const SHEARED: Matrix =
    Matrix::from_rows([[ONE, Scalar::lit("0.7"), ZERO], [ZERO, ONE, ZERO], [ZERO, ZERO, ONE]]);
/// A third as wide.
const NARROW: Matrix = Matrix::scaling(Scalar::lit("0.35"), ONE, ONE);

/// Of the larger mesh.
const VERTICES: usize = {
    let (rocket, ball) = (ROCKET.vertex_count(), BALL.vertex_count());
    if rocket > ball { rocket } else { ball }
};

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([WALL; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; VERTICES];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let turned = Rotation::about_z(-Turn::degrees(15)) * Rotation::about_y(Turn::degrees(40));
    let leaning = Matrix::from(turned);
    let rocket = |at: Vec3| Pose::IDENTITY.at(at).scaled(const { Distance::lit("0.42") });
    let ball = |at: Vec3| Pose::IDENTITY.at(at).scaled(const { Distance::lit("0.26") });

    // A rotation in the matrix comes before the change to its left.
    for (mesh, matrix, pose) in [
        (&BALL, STRETCHED, ball(const { Vec3::lit("-0.72", "0.6", "0") })),
        (&BALL, SQUASHED, ball(const { Vec3::lit("-0.62", "-0.72", "0") })),
        (&ROCKET, leaning, rocket(const { Vec3::lit("0.05", "0.5", "0") })),
        (&ROCKET, MIRRORED * leaning, rocket(const { Vec3::lit("0.7", "0.5", "0") })),
        (&ROCKET, SHEARED, rocket(const { Vec3::lit("0.05", "-0.5", "0") })),
        (&ROCKET, NARROW * leaning, rocket(const { Vec3::lit("0.7", "-0.5", "0") })),
    ] {
        Object::new(mesh, Gouraud::new(LIGHT)).shaped(&matrix).posed(pose).draw(
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
