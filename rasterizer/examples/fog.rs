//! Fog: `Fogged` lets the colours of any shader fade into the background with the distance.
//!
//! The ground is two large triangles, so that its fog is computed at the pixels; the rockets have
//! small ones, for which the vertices are enough.
//!
//! `cargo run -p rasterizer --example fog`

#[expect(dead_code, reason = "the camera is another one: it stands on the ground")]
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{Material, Positions, Tables, Triangles},
    prelude::*,
    shade::{AtVertices, Fog, Fogged},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

/// The mist and the sky.
const MIST: Rgb565 = Rgb565::new(22, 48, 26);
const LIGHT: Light = Light::new(Vec3::lit("-3", "3", "2"), Level::lit("0.3"), Level::lit("0.7"));

/// In flash: none up to 2 units from the camera, all from 12 on.
static FOG: Fog = Fog::linear(Distance::lit("2"), Distance::lit("12")).unwrap();

static GROUND: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[[-30, 0, 4], [30, 0, 4], [30, 0, -30], [-30, 0, -30]]),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([70, 92, 58], 2)],
    ..Tables::EMPTY
});

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([MIST; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    const EYE: Vec3 = Vec3::lit("0", "1.3", "4");
    const TARGET: Vec3 = Vec3::lit("0", "0.9", "0");
    let lens =
        const { Perspective::new(Turn::degrees(50), Distance::lit("0.25"), Distance::lit("40")) }?;
    let camera = Camera::look_at(EYE, TARGET, Vec3::Y, lens, SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    let ground = Object::new(&GROUND, Fogged::new(Unlit::new(), &FOG, MIST));
    ground.project_on_demand(&camera, S8)?.draw(&mut frame);

    let shader = Fogged::new(Gouraud::new(LIGHT), &FOG, MIST).computed(AtVertices);
    let rocket = Object::new(&ROCKET, shader);
    for row in 0..6 {
        for side in [-1, 1] {
            let place = Vec3::new(
                Scalar::from_num(side) * Scalar::lit("1.25"),
                Scalar::ONE,
                Scalar::from_num(-2 * row),
            );
            let turned = Rotation::about_y(Turn::degrees(70 * row as u32 + 20));
            let rocket = rocket.posed(Pose::rotated(turned).at(place));
            rocket.project_on_demand(&camera, S4)?.draw(&mut frame);
        }
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
