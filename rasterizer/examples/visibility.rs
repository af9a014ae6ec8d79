//! Which triangle is under a finger: a visibility buffer, `Visibility`, and shading after all
//! triangles are drawn, `Deferred`.
//!
//! The touched triangle is white, its corner that is nearest to the finger red, and the object
//! that it belongs to shines.
//!
//! `cargo run -p rasterizer --example visibility`

#[path = "models/ball.rs"]
mod ball;
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    pixelcolor::Rgb565,
    prelude::*,
    primitives::{Circle, PrimitiveStyle, Triangle},
};
use rasterizer::{
    mesh::{Material, Mesh},
    prelude::*,
    shade::{Deferred, Visibility, VisiblePixel},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(2, 3, 6);
/// Where the display is touched.
const FINGER: Point = Point::new(118, 112);

static MOON: Mesh<'static> = ball(&[Material::new([150, 160, 180], ball::TRIANGLES)]);

const PIXELS: usize = 240 * 240;
/// 8 bytes for each pixel.
static BUFFER: ConstStaticCell<[VisiblePixel; PIXELS]> =
    ConstStaticCell::new([VisiblePixel::NONE; PIXELS]);
static DEPTH: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static COLOR: ConstStaticCell<[Rgb565; PIXELS]> = ConstStaticCell::new([NIGHT; PIXELS]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let tilted = Rotation::about_z(-Turn::degrees(50)) * Rotation::about_y(Turn::degrees(70));
    let moon = Pose::IDENTITY
        .at(const { Vec3::lit("-0.35", "0.3", "-0.6") })
        .scaled(const { Distance::lit("0.7") });
    let objects = [(&ROCKET, Pose::rotated(tilted)), (&MOON, moon)];

    // What is seen: the number of an object, a triangle, and a place in it.
    let buffer = BUFFER.take();
    let mut frame = Frame::new(&mut buffer[..], DEPTH.take(), SCREEN)?;
    for (number, (mesh, pose)) in (0..).zip(objects) {
        let object = Object::new(mesh, Visibility::of_object(number)).posed(pose);
        object.project_on_demand(&camera, S4)?.draw(&mut frame)?;
    }
    let touched = buffer[(FINGER.y * 240 + FINGER.x) as usize];

    // Each pixel that is seen is shaded once. This takes no depth.
    let mut frame = Frame::without_depth(COLOR.take(), SCREEN)?;
    for (number, (mesh, pose)) in (0..).zip(objects) {
        let level = if touched.object() == Some(number) { "0.75" } else { "0.3" };
        let sun = Light::new(Vec3::lit("-3", "2", "3"), Level::ZERO, Level::lit(level));
        let shader = Deferred::new(Gouraud::new(sun), number, buffer, SCREEN);
        let object = Object::new(mesh, shader).posed(pose);
        object.project_on_demand::<_, S4, NoDepth>(&camera, S4)?.draw(&mut frame)?;
    }

    // The corners of the touched triangle on the screen, of which the greatest weight is nearest.
    if let Some(object) = touched.object() {
        let (mesh, pose) = objects[usize::from(object)];
        let object = Object::new(mesh, Unlit::<Rgb565>::new()).posed(pose);
        let seen = object.project_on_demand::<_, S4, NoDepth>(&camera, S4)?;
        seen.for_each_triangle(|triangle, corners| {
            let pixel = |[x, y]: [i32; 2]| Point::new(x >> 4, y >> 4);
            let places = corners.map(|corner| corner.position().map(pixel));
            if let (true, [Some(a), Some(b), Some(c)]) = (triangle == touched.triangle(), places) {
                let style = PrimitiveStyle::with_fill(Rgb565::WHITE);
                Triangle::new(a, b, c).into_styled(style).draw(&mut frame)?;
                let nearest = (touched.weights().into_iter().zip([a, b, c]))
                    .max_by_key(|(weight, _)| *weight)
                    .map_or(a, |(_, place)| place);
                let style = PrimitiveStyle::with_fill(Rgb565::RED);
                Circle::with_center(nearest, 9).into_styled(style).draw(&mut frame)?;
            }
            Ok::<(), core::convert::Infallible>(())
        })?;
    }
    let style = PrimitiveStyle::with_stroke(Rgb565::CSS_GOLD, 2);
    Circle::with_center(FINGER, 41).into_styled(style).draw(&mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
