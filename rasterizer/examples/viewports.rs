//! Four cameras in one picture, each on its part of it: one that circles, one that walks, one that
//! looks straight down, and a parallel one. Labels stand at points of the world; a finger's pixel
//! has its place on the ground.
//!
//! `cargo run -p rasterizer --example viewports`

#[expect(dead_code, reason = "the cameras are others")]
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen};
use embedded_graphics::{
    mono_font::{MonoTextStyle, ascii::FONT_6X10},
    pixelcolor::Rgb565,
    prelude::*,
    primitives::{Circle, PrimitiveStyle, Rectangle},
    text::Text,
};
use rasterizer::{
    camera::{FirstPerson, Orbit},
    geometry::{CullNone, Plane, Projection},
    mesh::{Card, Material, Mesh, Tables},
    output::Scissored,
    prelude::*,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const SKY: Rgb565 = Rgb565::new(8, 22, 14);
const SUN: Light = Light::new(Vec3::lit("-3", "4", "5"), Level::lit("0.2"), Level::lit("0.8"));
const GROUND: Plane = Plane::new(Vec3::Y, Scalar::ZERO);
static FIELD: Mesh<'static> = Mesh::new_const(Tables {
    materials: &[Material::new([80, 110, 60], 2)],
    ..*Card::<1, 1>::CENTERED.tables()
});
/// The two rockets, which stand on the ground.
const PLACES: [(&str, Vec3); 2] =
    [("one", Vec3::lit("-1.2", "1", "0")), ("two", Vec3::lit("1.2", "1", "-1"))];
const TOP: Vec3 = Vec3::lit("0", "1.15", "0");

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

type Picture<'a> = Frame<'a, Rgb565, &'a mut [u16]>;

/// Draws the world into a camera's viewport, and nothing beside it.
fn world<P: Projection>(camera: &Camera<P>, frame: &mut Picture<'_>) -> Result {
    let frame = &mut Scissored::new(frame, &camera.viewport());
    let level = Rotation::about_x(-Turn::QUARTER);
    let field = Pose::rotated(level).scaled(const { Distance::lit("6") });
    let mut corners = [ScreenVertex::<S4, _, _>::EMPTY; FIELD.vertex_count()];
    Object::new(&FIELD, Unlit::new()).posed(field).culled(CullNone).draw(
        camera,
        &mut corners,
        frame,
    )?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    for (_, place) in PLACES {
        let rocket = Object::new(&ROCKET, Gouraud::new(SUN)).posed(Pose::IDENTITY.at(place));
        rocket.draw(camera, &mut vertices, frame)?;
    }
    Ok(())
}

/// Writes the rockets' names above them.
fn labels<P: Projection>(camera: &Camera<P>, screen: &mut Screen) -> Result {
    let style = MonoTextStyle::new(&FONT_6X10, Rgb565::WHITE);
    let screen = &mut screen.clipped(&camera.viewport());
    for (name, place) in PLACES {
        if let Some(place) = camera.place_on_screen(place + TOP) {
            Text::new(name, place.pixel() - Point::new(9, 0), style).draw(screen)?;
        }
    }
    Ok(())
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let [left, right] =
        [0, 121].map(|x| [0, 121].map(|y| Rectangle::new(Point::new(x, y), Size::new(119, 119))));
    let lens =
        const { Perspective::new(Turn::degrees(50), Distance::lit("0.2"), Distance::lit("60")) }?;
    let map =
        const { Orthographic::new(Distance::lit("7"), Distance::lit("0.2"), Distance::lit("60")) }?;

    let mut orbit = Orbit::new(const { Vec3::lit("0", "0.8", "0") }, const { Distance::lit("6") });
    orbit.turn(Turn::degrees(30), Turn::degrees(20));
    let circling = orbit.camera(lens, left[0])?;
    let mut walker = FirstPerson::new(const { Vec3::lit("0", "0.5", "4") });
    walker.look(Turn::degrees(20), Turn::degrees(14));
    walker.step(const { Scalar::lit("1.5") }, Scalar::ZERO, Scalar::ZERO);
    let walking = walker.camera(lens, right[0])?;
    let above = Camera::level(const { Vec3::lit("0", "8", "0") }, Vec3::ZERO, lens, left[1])?;
    let aside = Camera::level(const { Vec3::lit("8", "5", "8") }, Vec3::Y, map, right[1])?;

    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    world(&circling, &mut frame)?;
    world(&walking, &mut frame)?;
    world(&above, &mut frame)?;
    world(&aside, &mut frame)?;
    frame.present(screen)?;
    labels(&circling, screen)?;
    labels(&walking, screen)?;
    labels(&above, screen)?;
    labels(&aside, screen)?;

    // A finger in the first view, and the same place of the ground in all of them.
    let finger = Point::new(60, 92);
    if let Some(place) = circling.ray(finger).meets(&GROUND) {
        let marks = [
            circling.place_on_screen(place),
            walking.place_on_screen(place),
            above.place_on_screen(place),
            aside.place_on_screen(place),
        ];
        for mark in marks.into_iter().flatten() {
            let style = PrimitiveStyle::with_stroke(Rgb565::YELLOW, 1);
            Circle::with_center(mark.pixel(), 9).into_styled(style).draw(screen)?;
        }
    }
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
