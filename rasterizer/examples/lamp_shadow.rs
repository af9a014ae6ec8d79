//! Shadows on a floor in the light of a lamp between a rocket and a ball: they run away from its
//! foot, and grow with the distance (`LampShadow`).
//!
//! `cargo run -p rasterizer --example lamp_shadow`

#[path = "models/ball.rs"]
pub mod ball;
#[expect(dead_code, reason = "the camera is another one")]
mod common;
/// What `host-tools convert --edges 0` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use core::cell::Cell;

use common::{Result, SCREEN, Screen};
use embedded_graphics::pixelcolor::{Rgb565, RgbColor as _};
use rasterizer::{
    fixed::types::{I0F32, I8F8},
    geometry::{LampShadow, Particle, Plane, ScreenParticle},
    mesh::{Card, Material},
    output::{Blend, KeepDepth, Once},
    prelude::*,
    raster::Bias,
    scene::Particles,
    shade::{Lamp, Squares},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(3, 7, 6);
const FLOOR: Plane = Plane::new(Vec3::Y, Scalar::ONE);
const LAMP: Vec3 = Vec3::lit("0.35", "1.15", "-0.1");
const DIM: Light = Light::new(Vec3::lit("0", "1", "1"), Level::lit("0.25"), Level::lit("0.1"));

static GROUND: Mesh<'static> = Card::<8, 8>::CENTERED;
static BALL: Mesh<'static> = ball::ball(&[Material::new([220, 150, 70], ball::TRIANGLES)]);

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    const EYE: Vec3 = Vec3::lit("0.5", "1.8", "5");
    const TARGET: Vec3 = Vec3::lit("0.15", "-0.2", "0");
    let lens = Perspective::new(Turn::degrees(36), Distance::lit("0.5"), Distance::lit("20"))?;
    let camera = Camera::look_at(EYE, TARGET, Vec3::Y, lens, SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    // The floor, one unit below the origin.
    let mut corners = [ScreenVertex::<S8, _, _>::EMPTY; 4];
    let flat = Pose::rotated(Rotation::about_x(-Turn::QUARTER));
    let ground = Object::new(&GROUND, Unlit::new());
    let place = const { Vec3::lit("0", "-1", "0") };
    ground.posed(flat.at(place)).draw(&camera, &mut corners, &mut frame)?;

    let rocket = Pose::rotated(Rotation::about_z(Turn::degrees(8)))
        .at(const { Vec3::lit("-0.6", "-0.15", "0") })
        .scaled(const { Distance::lit("0.8") });
    let ball = Pose::IDENTITY
        .at(const { Vec3::lit("1.05", "-0.6", "0.5") })
        .scaled(const { Distance::lit("0.4") });

    // Shadows: the pixels of both have one tone.
    let bits = [const { Cell::new(0) }; Once::<()>::words(240 * 240)];
    let mut floor = Once::new(&mut frame, &bits)?;
    // The ball has more vertices than the rocket.
    let mut positions = [[0; 3]; BALL.vertex_count()];
    let mut vertices = [ScreenVertex::<S8, _, _>::EMPTY; BALL.vertex_count()];
    for (mesh, pose) in [(&ROCKET, rocket), (&BALL, ball)] {
        let shadow = LampShadow::new(mesh, &pose, FLOOR, LAMP, &mut positions)?;
        Object::new(shadow.mesh(), Unlit::new())
            .posed(*shadow.pose())
            .clipped(shadow.clipping())
            .blended(KeepDepth(Blend(darker)))
            .biased(NEARER)
            .draw(&camera, &mut vertices, &mut floor)?;
    }

    // What casts them, and the lamp.
    let lamp = Lamp::new(LAMP, Distance::ONE, Level::lit("0.9"));
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; BALL.vertex_count()];
    for (mesh, pose) in [(&ROCKET, rocket), (&BALL, ball)] {
        let object = Object::new(mesh, Gouraud::new((DIM, lamp))).posed(pose);
        object.draw(&camera, &mut vertices, &mut frame)?;
    }
    let bulb = [Particle::new(LAMP, const { Distance::lit("0.08") }, Rgb565::WHITE)];
    Particles::new(&bulb, Squares).draw(&camera, &mut [ScreenParticle::EMPTY], &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

/// A third of the floor's colour.
fn darker(stored: Rgb565, _: Rgb565) -> Rgb565 {
    Rgb565::new(stored.r() / 3, stored.g() / 3, stored.b() / 3)
}

/// Shadows lie in the floor.
const NEARER: Bias = Bias { slope: I8F8::lit("1"), constant: I0F32::from_bits(3 << 16) };

fn main() -> Result {
    common::run(draw)
}
