//! 500 particles of some five pixels a side: by one call, in the slice's order and sorted; and each
//! a card of its own.

use rasterizer::{
    attribute::Affine,
    camera::Distance,
    color::Alpha,
    geometry::{Particle, Pose, ScreenParticle, ScreenVertex},
    mesh::{Card, Mesh},
    numbers::{Rotation, Scalar, Turn, Vec3},
    output::{Add, KeepDepth, Over, Rgb565Be},
    scene::{Object, Particles},
    shade::{Flat, Frames, Squares, Textured},
    texture::{Clamp, Colors, Texture, Translucent},
};

use super::Scenes;
use crate::{
    bench::{MODES, SUITED, Suited, sun},
    cost::fail,
    models,
};

const COUNT: usize = 500;
const SIZE: Distance = Distance::lit("0.03");

/// 8 x 8 texels with an alpha plane.
type Puff = Texture<Translucent<'static, Colors<'static, Rgb565Be, 64>, 8, 64>, 8, 8, Clamp, Clamp>;
static PUFFS: [Puff; 1] = {
    static COLORS: [Rgb565Be; 64] = [Rgb565Be::new(20, 30, 10); 64];
    static PLANE: [u8; 64] = [128; 64];
    [Texture::new(Translucent::new(Colors::new(&COLORS), &PLANE))]
};
static CARD: Mesh<'static> = Card::<8, 8>::CENTERED;

/// Places in a ball, by the golden angle.
fn cloud() -> [Particle<Rgb565Be>; COUNT] {
    core::array::from_fn(|i| {
        let turn = Rotation::about_y(Turn::degrees((i * 137 % 360) as u32))
            * Rotation::about_x(Turn::degrees((i * 71 % 360) as u32));
        let out = Scalar::from_num(i % 50) / 50;
        let place = turn * Vec3::new(Scalar::ZERO, Scalar::ZERO, out);
        Particle::new(place, SIZE, Rgb565Be::new(12, 20, (i % 32) as u8))
    })
}

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn particles(&mut self) {
        let cloud = cloud();
        let mut places = [ScreenParticle::EMPTY; COUNT];
        let mut order = [0; COUNT];
        let sparks = Particles::new(&cloud, Squares).blended(KeepDepth(Add(Alpha::OPAQUE)));
        let puffs =
            Particles::new(&cloud, Frames::new(&PUFFS)).blended(KeepDepth(Over(Alpha::OPAQUE)));
        let card = Object::new(&CARD, Textured::new(&PUFFS).corrected(Affine))
            .blended(KeepDepth(Over(Alpha::OPAQUE)));
        let scale = SIZE / 8;

        let camera = &self.camera;
        let mode = |name| [name, SUITED, MODES[0].name];
        // It counts as the model of these scenes, and isn't drawn.
        let model = Object::new(&models::CUBE, Flat::new(sun()));
        let bench = &mut self.bench;
        bench.measure::<Suited, u16, _, _>(
            mode("particles-add"),
            &model,
            |cost, object, vertices, _, memory| {
                cost.add_steps(object, camera, vertices, memory, |_, frame| {
                    sparks.project(camera, &mut places).unwrap_or_else(fail).draw(frame)
                });
            },
        );
        bench.measure::<Suited, u16, _, _>(
            mode("particles-over-texel-sorted"),
            &model,
            |cost, object, vertices, _, memory| {
                cost.add_steps(object, camera, vertices, memory, |_, frame| {
                    let seen = puffs.project(camera, &mut places).unwrap_or_else(fail);
                    seen.back_to_front(&mut order).unwrap_or_else(fail).draw(frame)
                });
            },
        );
        bench.measure::<Suited, u16, _, _>(
            mode("cards-over-texel"),
            &model,
            |cost, object, vertices, _, memory| {
                cost.add_steps(object, camera, vertices, memory, |_, frame| {
                    let mut corners = [ScreenVertex::<Suited, u16, _>::EMPTY; 4];
                    cloud.iter().try_for_each(|particle| {
                        let pose = Pose::facing(camera, particle.place).scaled(scale);
                        let card = card.posed(pose);
                        card.project(camera, &mut corners).unwrap_or_else(fail).draw(frame)
                    })
                });
            },
        );
    }
}
