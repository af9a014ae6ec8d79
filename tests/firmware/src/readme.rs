//! The firmware of the README, word for word.

#![expect(missing_docs, reason = "it is quoted as it stands")]

use crate::models::ROCKET;

// README
use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::prelude::*;

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
const ROWS: u32 = 16;
const NEEDS: Needs = Needs::of(&ROCKET, SCREEN.size, ROWS);
const NEAR: Distance = Distance::lit("0.1");
const FAR: Distance = Distance::lit("100");
const EYE: Vec3 = Vec3::lit("0", "1", "3");
const SUN: Vec3 = Vec3::lit("-1", "2", "3");
const LIGHT: Light = Light::new(SUN, Level::lit("0.2"), Level::lit("0.8"));

pub fn show<T: DrawTarget<Color = Rgb565>>(display: &mut T, turn: Turn) -> Result<(), T::Error> {
    let lens = const { Perspective::new(Turn::degrees(40), NEAR, FAR) }.unwrap();
    let camera = Camera::look_at(EYE, Vec3::ZERO, Vec3::Y, lens, SCREEN).unwrap();
    let rocket =
        Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(Pose::rotated(Rotation::about_y(turn)));

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; NEEDS.vertices];
    let mut bins = [0; NEEDS.bin_words];
    let (mut color, mut depth) = ([Rgb565::BLACK; NEEDS.pixels], [0u16; NEEDS.pixels]);
    let seen = rocket.project(&camera, &mut vertices).unwrap();
    let seen = seen.binned(ROWS, &mut bins).unwrap();
    let mut bands = Bands::new(SCREEN, &mut color, &mut depth).unwrap();
    bands.show(display, |band| band.clear_color(Rgb565::BLACK), |band| seen.draw(band))
}
// README
