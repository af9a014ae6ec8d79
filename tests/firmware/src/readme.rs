//! The firmware of the README, word for word.

#![expect(missing_docs, reason = "it is quoted as it stands")]

use crate::models::ROCKET;

// README
use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::prelude::*;

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
const NEAR: Distance = Distance::lit("0.1");
const FAR: Distance = Distance::lit("100");
const EYE: Vec3 = Vec3::lit("0", "1", "3");
const SUN: Vec3 = Vec3::lit("-1", "2", "3");

pub fn show<T: DrawTarget<Color = Rgb565>>(display: &mut T, turn: Angle) -> Result<(), T::Error> {
    let lens = Perspective::new(Angle::degrees(40), NEAR, FAR).unwrap();
    let camera = Camera::look_at(EYE, Vec3::ZERO, Vec3::Y, lens, SCREEN).unwrap();
    let light = Light::new(SUN, const { Level::lit("0.2") }, const { Level::lit("0.8") });
    let rocket = Object::new(&ROCKET, Gouraud::new(light)).posed(Pose::rotated(Rotation::about_y(turn)));

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let (mut color, mut depth) = ([Rgb565::BLACK; 240 * 16], [0u16; 240 * 16]);
    let seen = rocket.project(&camera, &mut vertices).unwrap();
    for top in (0..240).step_by(16) {
        let rows = Rectangle::new(Point::new(0, top), Size::new(240, 16));
        let mut band = Frame::new(&mut color, &mut depth, rows).unwrap();
        band.clear(Rgb565::BLACK);
        let Ok(()) = seen.draw(&mut band);
        band.present(display)?;
    }
    Ok(())
}
// README
