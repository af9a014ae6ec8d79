//! A mesh between two shapes: the sphere, and one that is drawn out. The base scene of the sphere
//! is the same without a second shape.

use rasterizer::{mesh::Progress, scene::Object, shade::Gouraud};

use super::Scenes;
use crate::{
    bench::{MODES, SUITED, Suited, sun},
    cost::fail,
    models,
};

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn motion(&mut self) {
        let pulse = &models::PULSE_KEYFRAMES;
        let tween = pulse.between(0, 1, const { Progress::lit("0.3") }).ok_or("no such shape");
        let tween = tween.unwrap_or_else(fail);
        let object = Object::morphed(&tween, Gouraud::new(sun()));
        let (camera, mode) = (&self.camera, ["sphere-gouraud-morph", SUITED, MODES[0].name]);
        self.bench.measure::<Suited, u16, _, _>(
            mode,
            &object,
            |cost, object, vertices, _, memory| {
                cost.add_drawn(object, camera, vertices, |seen, frame| seen.draw(frame), memory);
            },
        );
    }
}
