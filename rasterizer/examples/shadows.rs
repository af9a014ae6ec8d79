//! Shadows on a floor: that of a rocket, by the light's direction, in one tone (`PlanarShadow`,
//! `Once`), and a blob under a ball (a `Card` that is multiplied with the floor).
//!
//! `cargo run -p rasterizer --example shadows`

#[path = "models/ball.rs"]
pub mod ball;
#[expect(dead_code, reason = "the camera is another one")]
mod common;
/// What `host-tools convert --edges 0` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use core::cell::Cell;

use common::{Result, SCREEN, Screen};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::{
    color::Alpha,
    fixed::types::{I0F32, I8F8},
    geometry::{PlanarShadow, Plane},
    mesh::{Card, Material},
    output::{Blend, KeepDepth, Multiply, Once},
    prelude::*,
    raster::Bias,
    texture::{Bilinear, Clamp, Colors, Texture},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const SKY: Rgb565 = Rgb565::new(17, 45, 30);
const FLOOR: Plane = Plane::new(Vec3::Y, Scalar::ONE);
const SUN: Vec3 = Vec3::lit("-1", "2", "1");
const LIGHT: Light = Light::new(SUN, Level::lit("0.3"), Level::lit("0.7"));

static GROUND: Mesh<'static> = Card::<8, 8>::CENTERED;
static BLOB: Mesh<'static> = Card::<8, 8>::CENTERED;
static BALL: Mesh<'static> = ball::ball(&[Material::new([220, 150, 70], ball::TRIANGLES)]);

/// Dark in the middle, white outside.
type Blob = Texture<Colors<'static, Rgb565, 64>, 8, 8, Clamp, Clamp>;
static BLOBS: [Blob; 1] = {
    static TEXELS: [Rgb565; 64] = {
        let (mut texels, mut i) = ([Rgb565::new(31, 63, 31); 64], 0);
        while i < 64 {
            let (x, y) = (2 * (i % 8) as i32 - 7, 2 * (i / 8) as i32 - 7);
            let square = x * x + y * y;
            let level = if square < 40 { 8 + square / 5 } else { 31 };
            texels[i] = Rgb565::new(level as u8, 2 * level as u8, level as u8);
            i += 1;
        }
        texels
    };
    [Texture::new(Colors::new(&TEXELS))]
};

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    const EYE: Vec3 = Vec3::lit("0.6", "1.4", "5");
    const TARGET: Vec3 = Vec3::lit("0.1", "-0.2", "0");
    let lens = Perspective::new(Turn::degrees(36), Distance::lit("0.5"), Distance::lit("20"))?;
    let camera = Camera::look_at(EYE, TARGET, Vec3::Y, lens, SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    frame.fill_solid(&Rectangle::new(Point::zero(), Size::new(240, 60)), SKY)?;

    // The floor, one unit below the origin.
    let mut corners = [ScreenVertex::<S8, _, _>::EMPTY; 4];
    let flat = Pose::rotated(Rotation::about_x(-Turn::QUARTER));
    let ground = Object::new(&GROUND, Unlit::new());
    ground.posed(flat.at(const { Vec3::lit("0", "-1", "0") })).draw(
        &camera,
        &mut corners,
        &mut frame,
    )?;

    // A rocket and its shadow.
    let upright = Rotation::about_z(-Turn::degrees(14)) * Rotation::about_y(Turn::degrees(25));
    let pose = Pose::rotated(upright)
        .at(const { Vec3::lit("-0.3", "0.1", "0") })
        .scaled(const { Distance::lit("0.95") });
    let mut plain = [ScreenVertex::<S8, _, _>::EMPTY; ROCKET.vertex_count()];
    let bits = [const { Cell::new(0) }; Once::<()>::words(240 * 240)];
    let half = |stored: Rgb565, _| Rgb565::new(stored.r() / 2, stored.g() / 2, stored.b() / 2);
    Object::new(&ROCKET, Unlit::new())
        .posed(pose)
        .clipped(PlanarShadow::new(FLOOR, SUN))
        .blended(KeepDepth(Blend(half)))
        .biased(NEARER)
        .draw(&camera, &mut plain, &mut Once::new(&mut frame, &bits)?)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose).draw(
        &camera,
        &mut vertices,
        &mut frame,
    )?;

    // A ball and a blob under it.
    let place = const { Vec3::lit("1", "-0.55", "0.6") };
    let below = Vec3 { y: -Scalar::ONE, ..place };
    let mut corners = [ScreenVertex::<S8, _, _>::EMPTY; 4];
    Object::new(&BLOB, Textured::new(&BLOBS).filtered(Bilinear))
        .posed(flat.at(below).scaled(const { Distance::lit("0.13") }))
        .blended(KeepDepth(Multiply(Alpha::OPAQUE)))
        .biased(NEARER)
        .draw(&camera, &mut corners, &mut frame)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; BALL.vertex_count()];
    Object::new(&BALL, Gouraud::new(LIGHT))
        .posed(Pose::IDENTITY.at(place).scaled(const { Distance::lit("0.35") }))
        .draw(&camera, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

/// Shadows lie in the floor.
const NEARER: Bias = Bias { slope: I8F8::lit("1"), constant: I0F32::from_bits(3 << 16) };

fn main() -> Result {
    common::run(draw)
}
