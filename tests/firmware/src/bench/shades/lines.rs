//! The sphere's edges as lines: all of them, and those that it does not hide.

use rasterizer::{attribute::NoDepth, raster::Bias, scene::Object, shade::Unlit};

use super::Scenes;
use crate::{
    bench::{MODES, SUITED, Suited},
    cost::Depth,
    models,
};

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn lines(&mut self) {
        self.edges::<NoDepth>("sphere-lines", false);
        self.edges::<u16>("sphere-lines-hidden", true);
    }

    fn edges<D: Depth>(&mut self, name: &str, are_hidden: bool) {
        let object = Object::new(&models::SPHERE, Unlit::new()).biased(Bias::BEHIND_LINES);
        let (camera, mode) = (&self.camera, [name, SUITED, MODES[0].name]);
        self.bench.measure::<Suited, D, _, _>(
            mode,
            &object,
            |cost, object, vertices, _, memory| {
                let lines = (&models::SPHERE_EDGES, are_hidden);
                cost.add_lines(object, camera, vertices, lines, memory);
            },
        );
    }
}
