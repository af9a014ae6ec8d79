//! What can be seen of an object: the sphere within a rectangle.

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use rasterizer::{scene::Object, shade::Gouraud};

use super::Scenes;
use crate::{
    bench::{MODES, SIZE, SUITED, Suited, sun},
    models,
};

/// The right half of the picture.
const HALF: Rectangle = Rectangle::new(Point::new(160, 0), Size::new(SIZE.width / 2, SIZE.height));

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn seen(&mut self) {
        let object = Object::new(&models::SPHERE, Gouraud::new(sun()));
        let (camera, mode) = (&self.camera, ["sphere-scissored", SUITED, MODES[0].name]);
        self.bench.measure::<Suited, u16, _, _>(
            mode,
            &object,
            |cost, object, vertices, _, memory| {
                cost.add_scissored(object, camera, vertices, &HALF, memory);
            },
        );
    }
}
