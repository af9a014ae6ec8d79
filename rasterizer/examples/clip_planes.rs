//! A rocket cut open by a plane of the object, and one in two parts by a plane of the world: clip
//! planes of your own.
//!
//! `cargo run -p rasterizer --example clip_planes`

mod common;
/// What `host-tools convert --edges 0` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    geometry::{ClipPlanes, Plane},
    prelude::*,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(3, 9, 8);
const LIGHT: Light = Light::new(Vec3::lit("-3", "2", "3"), Level::lit("0.25"), Level::lit("0.75"));
/// What lies behind the middle of the rocket, as it was modelled.
const BEHIND: Plane = Plane::new(Vec3::lit("0", "0", "-1"), Scalar::ZERO);
/// The parts of the other one: where each stands, and what it keeps, of the world.
const ABOVE: Part = (Vec3::lit("0.6", "0.12", "0"), Plane::new(Vec3::Y, Scalar::lit("-0.12")));
const BELOW: Part =
    (Vec3::lit("0.6", "-0.12", "0"), Plane::new(Vec3::lit("0", "-1", "0"), Scalar::lit("-0.12")));

type Part = (Vec3, Plane);

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut plain = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT));
    let turned = |degrees| Rotation::about_x(Turn::degrees(20)) * Rotation::about_y(degrees);

    // Cut open: the plane turns with the rocket. Its inside is seen, in plain colours.
    let pose = Pose::rotated(turned(Turn::degrees(40)))
        .at(const { Vec3::lit("-0.55", "0", "0") })
        .scaled(const { Distance::lit("0.85") });
    let open = ClipPlanes::in_object([BEHIND]);
    rocket.posed(pose).clipped(open).draw(&camera, &mut vertices, &mut frame)?;
    let inside = Object::new(&ROCKET, Unlit::new()).posed(pose).culled(CullFront).clipped(open);
    inside.draw(&camera, &mut plain, &mut frame)?;

    // In two parts, at a plane of the world.
    let pose = Pose::rotated(Rotation::about_z(-Turn::degrees(30)) * turned(Turn::degrees(60)))
        .scaled(const { Distance::lit("0.85") });
    for (place, plane) in [ABOVE, BELOW] {
        let part = rocket.posed(pose.at(place)).clipped(ClipPlanes::in_world([plane]));
        part.draw(&camera, &mut vertices, &mut frame)?;
        let inside = Object::new(&ROCKET, Unlit::new()).posed(pose.at(place)).culled(CullFront);
        let inside = inside.clipped(ClipPlanes::in_world([plane]));
        inside.draw(&camera, &mut plain, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
