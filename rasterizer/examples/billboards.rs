//! Billboards: trees that face the camera, sized in units, and sparks sized in pixels, which add
//! their light.
//!
//! `cargo run -p rasterizer --example billboards`

#[expect(dead_code, reason = "the camera is another one")]
mod common;

use common::{Result, SCREEN, Screen};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::{
    attribute::Affine,
    color::Alpha,
    mesh::Card,
    output::{Add, KeepDepth},
    prelude::*,
    texture::{Clamp, Colors, Indexed, Keyed, Texture},
};
use static_cell::ConstStaticCell;

static TREE: Mesh<'static> = Card::<8, 12>::STANDING;
static SPARK: Mesh<'static> = Card::<5, 5>::CENTERED;

/// 8 x 12 texels of two bits; place 0 of the palette is transparent.
type Tree = Texture<Keyed<Indexed<'static, Rgb565, 2, 24, 4>>, 8, 12, Clamp, Clamp>;
static TREES: [Tree; 1] = {
    static PLACES: [u8; 24] = {
        let picture: &[u8; 96] = b"\
            ...33...\
            ..3322..\
            ..3221..\
            .332211.\
            ..3221..\
            .332221.\
            33222211\
            .332211.\
            33222211\
            33222211\
            ...11...\
            ...11...";
        let (mut bytes, mut i) = ([0; 24], 0);
        while i < 96 {
            let value = if picture[i] == b'.' { 0 } else { picture[i] - b'0' };
            bytes[i / 4] |= value << (i % 4 * 2);
            i += 1;
        }
        bytes
    };
    static COLORS: [Rgb565; 4] =
        [Rgb565::BLACK, Rgb565::new(4, 18, 5), Rgb565::new(5, 30, 6), Rgb565::new(11, 46, 8)];
    [Texture::new(Keyed::new(Indexed::new(&PLACES, &COLORS), 0))]
};

/// Bright in the middle.
type Spark = Texture<Colors<'static, Rgb565, 25>, 5, 5, Clamp, Clamp>;
static SPARKS: [Spark; 1] = {
    static TEXELS: [Rgb565; 25] = {
        let (mut texels, mut i) = ([Rgb565::BLACK; 25], 0);
        while i < 25 {
            let (x, y) = ((i % 5) as i32 - 2, (i / 5) as i32 - 2);
            let level = 7 - x * x - y * y;
            let level = if level < 0 { 0 } else { level as u8 };
            texels[i] = Rgb565::new(4 * level, 4 * level, level / 2);
            i += 1;
        }
        texels
    };
    [Texture::new(Colors::new(&TEXELS))]
};

const SKY: Rgb565 = Rgb565::new(4, 10, 10);
const GRASS: Rgb565 = Rgb565::new(4, 16, 6);
static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    const EYE: Vec3 = Vec3::lit("0", "1.5", "5");
    const TARGET: Vec3 = Vec3::lit("0", "0.6", "0");
    let lens = Perspective::new(Turn::degrees(40), Distance::lit("0.5"), Distance::lit("30"))?;
    let camera = Camera::look_at(EYE, TARGET, Vec3::Y, lens, SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    frame.fill_solid(&Rectangle::new(Point::new(0, 62), Size::new(240, 178)), GRASS)?;

    // Nothing is divided: all of a billboard has one depth.
    let tree = Object::new(&TREE, Textured::new(&TREES).corrected(Affine));
    let mut corners = [ScreenVertex::<S4, _, _>::EMPTY; 4];
    for i in 0..9 {
        let place = Vec3::new(
            Scalar::from_num(i * 37 % 11 - 5) / 3,
            Scalar::ZERO,
            Scalar::from_num(i * 23 % 13 - 9) / 3,
        );
        let pose = Pose::facing(&camera, place).scaled(const { Distance::lit("0.11") });
        tree.posed(pose).draw(&camera, &mut corners, &mut frame)?;
    }

    // A fountain of particles in any order, as light is added.
    let spark = Object::new(&SPARK, Textured::new(&SPARKS).corrected(Affine))
        .blended(KeepDepth(Add(Alpha::OPAQUE)));
    let mut corners = [ScreenVertex::<S4, _, _>::EMPTY; 4];
    for i in 0..60i32 {
        let angle = Turn::degrees((i * 137 % 360) as u32);
        let time = Scalar::from_num(i % 20) / 20;
        let out = Rotation::about_y(angle) * Vec3::new(time, Scalar::ZERO, Scalar::ZERO);
        let rise = time * 5 - time * time * 5;
        let place = out + Vec3::new(Scalar::ZERO, rise, Scalar::ONE);
        let pose = Pose::facing(&camera, place).in_pixels(&camera, const { Distance::lit("1.5") });
        spark.posed(pose).draw(&camera, &mut corners, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
