//! A scissor: the right half of the sphere.

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use rasterizer::{output::Scissored, scene::Object, shade::Gouraud};

use super::Scenes;
use crate::{
    bench::{MODES, SIZE, SUITED, Suited, sun},
    models,
};

/// The right half of the picture.
const HALF: Rectangle = Rectangle::new(Point::new(160, 0), Size::new(SIZE.width / 2, SIZE.height));

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn scissor(&mut self) {
        let object = Object::new(&models::SPHERE, Gouraud::new(sun()));
        let (camera, mode) = (&self.camera, ["sphere-scissored", SUITED, MODES[0].name]);
        self.bench.measure::<Suited, u16, _, _>(
            mode,
            &object,
            |cost, object, vertices, _, memory| {
                cost.add_drawn(
                    object,
                    camera,
                    vertices,
                    |seen, frame| seen.draw(&mut Scissored::new(frame, &HALF)),
                    memory,
                );
            },
        );
    }
}
