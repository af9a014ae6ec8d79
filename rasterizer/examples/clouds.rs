//! Clouds: texels with an alpha plane of 8 bits, `Translucent`, put over what is behind by `Over`.
//!
//! Clouds are tested by depth and do not store it, and are drawn from the farthest to the nearest.
//!
//! `cargo run -p rasterizer --example clouds`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    color::Alpha,
    mesh::{Material, Positions, Tables, TextureCoordinates, Triangles},
    numbers::Scale,
    output::{KeepDepth, Over},
    prelude::*,
    texture::{Bilinear, Clamp, Indexed, Texture, Translucent},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const SKY: Rgb565 = Rgb565::new(8, 34, 27);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.25"), Level::lit("0.8"));

/// A rectangle of 2 x 1 with the whole texture.
#[rustfmt::skip]
static PUFF: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[[-2, -1, 0], [2, -1, 0], [2, 1, 0], [-2, 1, 0]]),
    scale: Scale::new(1, -1),
    texture_coordinates: TextureCoordinates::I16(&[
        [0, 1 << 14], [1 << 14, 1 << 14], [1 << 14, 0], [0, 0],
    ]),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([255; 3], 2)],
    ..Tables::EMPTY
});

const SIDE: usize = 32;

/// Balls of mist: middle and radius in texels.
const BALLS: [[i32; 3]; 6] =
    [[7, 21, 6], [13, 15, 8], [20, 12, 7], [25, 19, 6], [18, 21, 8], [11, 22, 6]];

/// The alpha of a texel: each ball hides a part of what the others let through.
const fn alpha(x: i32, y: i32) -> u8 {
    let (mut through, mut i) = (255, 0);
    while i < BALLS.len() {
        let [ball_x, ball_y, radius] = BALLS[i];
        // In quarter texels, from the middle of one.
        let (dx, dy) = (4 * x + 2 - 4 * ball_x, 4 * y + 2 - 4 * ball_y);
        let rest = 16 * radius * radius - dx * dx - dy * dy;
        if rest > 0 {
            through -= through * rest * 7 / (16 * radius * radius * 8);
        }
        i += 1;
    }
    (255 - through) as u8
}

/// White above, grey below, in four colours: invisible texels have one too.
type Cloud = Texture<
    Translucent<'static, Indexed<'static, Rgb565, 2, { SIDE * SIDE / 4 }, 4>, 8, { SIDE * SIDE }>,
    SIDE,
    SIDE,
    Clamp,
    Clamp,
>;
static CLOUD: [Cloud; 1] = {
    static ALPHA: [u8; SIDE * SIDE] = {
        let (mut plane, mut i) = ([0; SIDE * SIDE], 0);
        while i < SIDE * SIDE {
            plane[i] = alpha((i % SIDE) as i32, (i / SIDE) as i32);
            i += 1;
        }
        plane
    };
    /// The rows by quarters, from 2 bits each.
    static PLACES: [u8; SIDE * SIDE / 4] = {
        let (mut places, mut i) = ([0; SIDE * SIDE / 4], 0);
        while i < SIDE * SIDE / 4 {
            let row = i / (SIDE / 4);
            let place = if row < 12 {
                0
            } else if row < 17 {
                1
            } else if row < 22 {
                2
            } else {
                3
            };
            places[i] = 0b01_01_01_01 * place;
            i += 1;
        }
        places
    };
    static COLORS: [Rgb565; 4] = [
        Rgb565::new(31, 63, 31),
        Rgb565::new(30, 60, 31),
        Rgb565::new(28, 56, 29),
        Rgb565::new(25, 52, 28),
    ];
    [Texture::new(Translucent::new(Indexed::new(&PLACES, &COLORS), &ALPHA))]
};

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted).scaled(const { Distance::lit("1.1") });
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);
    rocket.draw(&camera, &mut vertices, &mut frame)?;

    let cloud = Object::new(&PUFF, Textured::new(&CLOUD).filtered(Bilinear));
    let cloud = cloud.blended(KeepDepth(Over(const { Alpha::lit("0.9") })));
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; PUFF.vertex_count()];
    // Two behind the rocket, one through it, two before it.
    for (place, size) in const {
        [
            (Vec3::lit("-0.5", "0.75", "-1.2"), Distance::lit("0.7")),
            (Vec3::lit("0.75", "0.05", "-0.8"), Distance::lit("0.9")),
            (Vec3::lit("0.1", "0.25", "0"), Distance::lit("0.8")),
            (Vec3::lit("-0.45", "-0.35", "0.4"), Distance::lit("0.85")),
            (Vec3::lit("0.4", "-0.65", "0.7"), Distance::lit("0.8")),
        ]
    } {
        let cloud = cloud.posed(Pose::IDENTITY.at(place).scaled(size));
        cloud.draw(&camera, &mut vertices, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
