//! Meshes that change before they are posed: the sphere in a matrix, and between two shapes, itself
//! and one that is drawn out. The base scene of the sphere is the same without.

use rasterizer::{
    geometry::{ClipAll, CullBack, Shape},
    mesh::Progress,
    numbers::{Matrix, Scalar},
    output::{Replace, Rgb565Be},
    raster::NoBias,
    scene::{Modes, Object},
    shade::Gouraud,
};

use super::Scenes;
use crate::{
    bench::{MODES, SUITED, Suited, sun},
    cost::fail,
    models,
};

/// The sphere in some shape.
type Changed<'a, G> = Object<'a, Gouraud<Rgb565Be>, Modes<CullBack, ClipAll, Replace, NoBias, G>>;

/// Stretched, mirrored and sheared.
const MATRIX: Matrix = {
    const ZERO: Scalar = Scalar::ZERO;
    Matrix::from_rows([
        [Scalar::NEG_ONE, Scalar::lit("0.25"), ZERO],
        [ZERO, Scalar::lit("0.75"), ZERO],
        [ZERO, ZERO, Scalar::ONE],
    ])
};

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn motion(&mut self) {
        let pulse = &models::PULSE_KEYFRAMES;
        let tween = pulse.between(0, 1, const { Progress::lit("0.3") }).ok_or("no such shape");
        let tween = tween.unwrap_or_else(fail);
        let shaped = Object::new(&models::SPHERE, Gouraud::new(sun())).shaped(&MATRIX);
        self.object("sphere-gouraud-shaped", &shaped);
        self.object("sphere-gouraud-morph", &Object::morphed(&tween, Gouraud::new(sun())));
    }

    /// The whole frame of an object.
    fn object<G: Shape>(&mut self, name: &str, object: &Changed<'_, G>) {
        let camera = &self.camera;
        self.bench.measure::<Suited, u16, _, _>(
            [name, SUITED, MODES[0].name],
            object,
            |cost, object, vertices, _, memory| {
                cost.add_drawn(object, camera, vertices, |seen, frame| seen.draw(frame), memory);
            },
        );
    }
}
