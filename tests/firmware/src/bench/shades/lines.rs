//! The sphere's edges as lines: all of them, those that it does not hide, and both antialiased;
//! and its vertices as points.

use rasterizer::{
    attribute::NoDepth, fixed::types::U8F8, output::Rgb565Be, raster::Bias, scene::Object,
    shade::Unlit,
};

use super::Scenes;
use crate::{
    bench::{MODES, SUITED, Suited},
    models,
};

const WHITE: Rgb565Be = Rgb565Be::new(31, 63, 31);

/// A scene of the sphere with this depth, drawn by an expression of the object as it is seen and
/// the frame.
macro_rules! scene {
    ($scenes:ident, $name:literal, $depth:ty, |$seen:ident, $frame:ident| $draw:expr) => {
        let object = Object::new(&models::SPHERE, Unlit::new()).biased(Bias::BEHIND_LINES);
        let (camera, mode) = (&$scenes.camera, [$name, SUITED, MODES[0].name]);
        $scenes.bench.measure::<Suited, $depth, _, _>(
            mode,
            &object,
            |cost, object, vertices, _, memory| {
                cost.add_drawn(object, camera, vertices, |$seen, $frame| $draw, memory);
            },
        );
    };
}

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn lines(&mut self) {
        scene!(self, "sphere-lines", NoDepth, |seen, frame| {
            seen.lines(&models::SPHERE_EDGES).fill(WHITE, frame)
        });
        scene!(self, "sphere-lines-hidden", u16, |seen, frame| {
            seen.draw_depth(frame)?;
            seen.lines(&models::SPHERE_EDGES).fill(WHITE, frame)
        });
        scene!(self, "sphere-lines-smooth", NoDepth, |seen, frame| {
            seen.lines(&models::SPHERE_EDGES).smooth(U8F8::ONE).fill(WHITE, frame)
        });
        scene!(self, "sphere-lines-smooth-hidden", u16, |seen, frame| {
            seen.draw_depth(frame)?;
            seen.lines(&models::SPHERE_EDGES).smooth(U8F8::ONE).fill(WHITE, frame)
        });
        scene!(self, "sphere-points", NoDepth, |seen, frame| {
            seen.points(&models::SPHERE_POINTS).sized(3).fill(WHITE, frame)
        });
    }
}
