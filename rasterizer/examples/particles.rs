//! Particles from a slice, by one call: 500 sparks that add their light, behind a ball and before
//! it, and smoke that is sorted from back to front. In bands.
//!
//! `cargo run -p rasterizer --example particles`

#[path = "models/ball.rs"]
mod ball;
#[expect(dead_code, reason = "the camera is another one")]
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    color::Alpha,
    geometry::{AsParticle, Particle, ScreenParticle},
    mesh::Material,
    output::{Add, KeepDepth, Over},
    prelude::*,
    scene::Particles,
    shade::{Frames, Squares},
    texture::{Clamp, Indexed, Texture, TranslucentPalette},
};
use static_cell::ConstStaticCell;

/// A spark as the program keeps it: what draws it asks for a particle.
#[derive(Clone, Copy)]
struct Spark {
    place: Vec3,
    speed: Vec3,
    /// From 0, new, to 63.
    age: u8,
}

impl Spark {
    const UNBORN: Self = Self { place: Vec3::ZERO, speed: Vec3::ZERO, age: 0 };
    const GRAVITY: Vec3 = Vec3::lit("0", "-0.0016", "0");

    /// One of a fountain, in the direction that its number tells.
    fn born(number: u32) -> Self {
        let out = Rotation::about_y(Turn::degrees(number * 137 % 360));
        let slow = Scalar::from_num(number * 31 % 17) / 1000;
        let speed = out * Vec3::new(slow, Scalar::lit("0.055") - slow, Scalar::ZERO);
        Self { place: const { Vec3::lit("0", "-0.6", "0") }, speed, age: 0 }
    }

    /// It falls, and bounces off the ground.
    fn step(&mut self) {
        self.place = self.place + self.speed;
        self.speed = self.speed + Self::GRAVITY;
        let [x, y, z] = self.speed.to_bits();
        if self.place.to_bits()[1] < -0xB000 && y < 0 {
            self.speed = Vec3::from_bits([x, -y / 2, z]);
        }
        self.age = (self.age + 1).min(63);
    }
}

impl AsParticle for Spark {
    type Color = Rgb565;

    /// White at first, then yellow, then red, then black, which adds nothing.
    fn particle(&self) -> Particle<Rgb565> {
        let heat = 63 - self.age;
        let color = Rgb565::new((heat * 2).min(31), heat, heat.saturating_sub(40));
        Particle::new(self.place, const { Distance::lit("0.025") }, color)
    }
}

/// A puff in 8 x 8 texels of 2 bits, thinner outside.
type Puff =
    Texture<TranslucentPalette<'static, Indexed<'static, Rgb565, 2, 16, 4>, 4>, 8, 8, Clamp, Clamp>;
static PUFFS: [Puff; 1] = {
    static COLORS: [Rgb565; 4] = [Rgb565::new(14, 28, 15); 4];
    static ALPHAS: [u8; 4] = [0, 40, 90, 140];
    static PLACES: [u8; 16] = {
        let (mut bytes, mut i) = ([0; 16], 0);
        while i < 64 {
            let (x, y) = (2 * (i % 8) as i32 - 7, 2 * (i / 8) as i32 - 7);
            let value = (62 - x * x - y * y) / 16;
            bytes[i / 4] |= (if value > 0 { value as u8 } else { 0 }) << (i % 4 * 2);
            i += 1;
        }
        bytes
    };
    [Texture::new(TranslucentPalette::new(Indexed::new(&PLACES, &COLORS), &ALPHAS))]
};

static BALL: Mesh<'static> = ball(&[Material::new([70, 90, 140], ball::TRIANGLES)]);
const SUN: Light = Light::new(Vec3::lit("-1", "2", "2"), Level::lit("0.2"), Level::lit("0.7"));
const NIGHT: Rgb565 = Rgb565::new(1, 3, 4);

const ROWS: u32 = 16;
const SPARKS: usize = 500;
static COLOR: ConstStaticCell<[Rgb565; 240 * ROWS as usize]> =
    ConstStaticCell::new([NIGHT; 240 * ROWS as usize]);
static DEPTH: ConstStaticCell<[u16; 240 * ROWS as usize]> =
    ConstStaticCell::new([0; 240 * ROWS as usize]);
static SPARK_PLACES: ConstStaticCell<[ScreenParticle; SPARKS]> =
    ConstStaticCell::new([ScreenParticle::EMPTY; SPARKS]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    // What a program does in each frame: some are born, all move.
    let mut sparks = [Spark::UNBORN; SPARKS];
    for frame in 0..63u32 {
        for (number, spark) in (0..).zip(&mut sparks) {
            if number * 63 / SPARKS as u32 == frame {
                *spark = Spark::born(number);
            }
            spark.step();
        }
    }
    let smoke: [Particle<Rgb565>; 12] = core::array::from_fn(|i| {
        let [x, y, z] = [i * 5 % 7, i, i * 7 % 5].map(|c| Scalar::from_num(c) / 12);
        let place = Vec3::new(x - Scalar::lit("0.9"), y, z - Scalar::lit("0.2"));
        let size = Distance::lit("0.3") + Distance::from_num(i) / 40;
        Particle {
            alpha: Alpha::from_bits(250 - 18 * i as u16),
            ..Particle::new(place, size, NIGHT)
        }
    });

    const EYE: Vec3 = Vec3::lit("0", "0.8", "4");
    let lens =
        const { Perspective::new(Turn::degrees(30), Distance::lit("0.5"), Distance::lit("30")) }?;
    let camera = Camera::look_at(EYE, Vec3::ZERO, Vec3::Y, lens, SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; BALL.vertex_count()];
    let pose = Pose::IDENTITY
        .at(const { Vec3::lit("0.35", "-0.3", "0") })
        .scaled(const { Distance::lit("0.4") });
    let ball = Object::new(&BALL, Gouraud::new(SUN)).posed(pose).project(&camera, &mut vertices)?;

    let sparks = Particles::new(&sparks, Squares).blended(KeepDepth(Add(Alpha::OPAQUE)));
    let sparks = sparks.project(&camera, SPARK_PLACES.take())?;
    let (mut places, mut order) = ([ScreenParticle::EMPTY; 12], [0; 12]);
    let smoke = Particles::new(&smoke, Frames::new(&PUFFS)).blended(KeepDepth(Over(Alpha::OPAQUE)));
    let smoke = smoke.project(&camera, &mut places)?.back_to_front(&mut order)?;

    let mut bands = Bands::new(SCREEN, COLOR.take(), DEPTH.take())?;
    bands.show(
        screen,
        |band| band.clear_color(NIGHT),
        |band| {
            ball.draw(band)?;
            smoke.draw(band)?;
            sparks.draw(band)
        },
    )?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
