//! The bench scenes of light, colour, blending, fog, lines, points and particles, of a scissor, of
//! layers that are shaded once, of several samples a pixel, and of meshes that a matrix or a second
//! shape changes.

mod blend;
mod color;
mod fog;
mod layers;
mod light;
mod lines;
mod motion;
mod particles;
mod samples;
mod scissor;

use rasterizer::{
    camera::Camera,
    mesh::Mesh,
    output::Rgb565Be,
    scene::Object,
    shade::{Gouraud, Shader},
};

use super::{Bench, MEMORY, MODES, PIXELS, SUITED, Suited, sun, view};
use crate::{console, cost::Depth, counter, models, stage::LAMP};

/// The largest model's vertices.
const VERTICES: usize = 300;

/// The program: starts the counter, says how it was compiled, and measures whole frames.
///
/// Its parameter has it compiled for its own program only, not for all that share this crate.
pub fn main<const SET_UP: bool>() {
    counter::start();
    console::build();
    Bench::within(&MEMORY, |bench| {
        let mut scenes = Scenes::<SET_UP> { bench, camera: view("400", "2.4") };
        scenes.base();
        scenes.blend();
        scenes.light();
        scenes.colors();
        scenes.fog();
        scenes.lines();
        scenes.scissor();
        scenes.layers();
        scenes.samples();
        scenes.motion();
        scenes.particles();
    });
}

struct Scenes<'a, const SET_UP: bool> {
    bench: Bench<'a, SET_UP, PIXELS, VERTICES>,
    camera: Camera,
}

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    /// What the others are compared with, besides the cube of the first bench program.
    fn base(&mut self) {
        self.scene::<u16, _>("sphere-gouraud", &models::SPHERE, Gouraud::new(sun()));
    }

    /// The whole frame.
    fn scene<D: Depth, Sh: Shader<Color = Rgb565Be>>(
        &mut self,
        name: &str,
        mesh: &Mesh<'_>,
        shader: Sh,
    ) {
        let object = Object::new(mesh, shader);
        self.bench.scene_in::<Suited, D, _>([name, SUITED], MODES[0], &object, &self.camera);
    }
}
