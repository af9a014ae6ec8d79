//! The scene of particles: those of the bench, without an object.

use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use rasterizer::{
    camera::Distance,
    color::Alpha,
    geometry::{Particle, ScreenParticle},
    numbers::{Scalar, Vec3},
    output::{self, Add, KeepDepth},
    scene::Particles,
    shade::Squares,
};

use super::{NARROW, PERSPECTIVE, PICTURE, camera, frames::for_each_view};
use crate::sizes::{Display, Scene};

const COUNT: usize = 100;
const DARK: Particle<Rgb565> = Particle::new(Vec3::ZERO, Distance::ZERO, Rgb565::BLACK);

/// Squares in a line that add their light, in bands with depth.
#[derive(Clone, Copy, Debug)]
pub struct ParticlesAdd;

/// The buffers: colour, depth, the particles, and their places on the screen.
#[derive(Debug)]
pub struct Store {
    sparks: [Particle<Rgb565>; COUNT],
    color: [Rgb565; NARROW],
    depth: [u16; NARROW],
    places: [ScreenParticle; COUNT],
}

impl Scene for ParticlesAdd {
    type Memory = Store;

    const MEMORY: Store = Store {
        sparks: [Particle { alpha: Alpha::CLEAR, ..DARK }; COUNT],
        color: [Rgb565::BLACK; NARROW],
        depth: [0; NARROW],
        places: [ScreenParticle::EMPTY; COUNT],
    };

    fn draw(memory: &mut Store, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let size = const { Distance::lit("0.03") };
            for (i, spark) in memory.sparks.iter_mut().enumerate() {
                let along = Scalar::from_bits((i as i32 - 50) << 10);
                let place = view.pose().rotation * Vec3::new(along, Scalar::ZERO, Scalar::ZERO);
                *spark = Particle::new(place, size, Rgb565::new(9, 20, i as u8 % 32));
            }
            let sparks = Particles::new(&memory.sparks, Squares);
            let sparks = sparks.blended(KeepDepth(Add(Alpha::OPAQUE)));
            let camera = camera(view, PERSPECTIVE, PICTURE)?;
            let seen = sparks.project(&camera, &mut memory.places).ok()?;
            let mut bands =
                output::Bands::new(PICTURE, &mut memory.color, &mut memory.depth).ok()?;
            let shown =
                bands.show(display, |band| band.clear_color(Rgb565::BLACK), |band| seen.draw(band));
            shown.ok()
        })
    }
}
