//! The sphere's edges as lines: all of them, and those that it does not hide.

use rasterizer::{
    attribute::NoDepth,
    fixed::types::{I0F32, I8F8},
    raster::Bias,
    scene::Object,
    shade::Unlit,
};

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
        const BEHIND: Bias = Bias { slope: I8F8::lit("-1"), constant: I0F32::from_bits(-2 << 16) };
        let object = Object::new(&models::SPHERE, Unlit::new()).biased(BEHIND);
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
