//! Transparent texels: plants by a colour key (`Keyed`), a fence by an alpha plane (`Masked`).
//!
//! A transparent texel leaves the pixel's colour and depth, so objects are drawn in any order.
//!
//! `cargo run -p rasterizer --example cutout`

#[expect(dead_code, reason = "the camera is another one")]
mod common;
/// What `host-tools convert --texture-format indexed4 --mipmaps` makes of `wooden_crate.obj`.
#[path = "models/wooden_crate.rs"]
pub mod wooden_crate;

use common::{Result, SCREEN, Screen};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use rasterizer::{
    mesh::{Material, Positions, Tables, TextureCoordinates, Triangles},
    numbers::Scale,
    prelude::*,
    texture::{Clamp, Indexed, Keyed, Masked, Texture},
};
use static_cell::ConstStaticCell;
use wooden_crate::{WOODEN_CRATE, WOODEN_CRATE_TEXTURES};

/// Three squares of side 1 that cross each other, each with the whole texture: 1 is 2^14.
#[rustfmt::skip]
static PLANT: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[
        [-8, 0, 0], [8, 0, 0], [8, 16, 0], [-8, 16, 0],
        [-4, 0, -7], [4, 0, 7], [4, 16, 7], [-4, 16, -7],
        [-4, 0, 7], [4, 0, -7], [4, 16, -7], [-4, 16, 7],
    ]),
    scale: Scale::new(1, -4),
    texture_coordinates: TextureCoordinates::I16(&[
        [0, 1 << 14], [1 << 14, 1 << 14], [1 << 14, 0], [0, 0],
        [0, 1 << 14], [1 << 14, 1 << 14], [1 << 14, 0], [0, 0],
        [0, 1 << 14], [1 << 14, 1 << 14], [1 << 14, 0], [0, 0],
    ]),
    triangles: Triangles::U8(&[
        [0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7], [8, 9, 10], [8, 10, 11],
    ]),
    materials: &[Material::new([255; 3], 6)],
    ..Tables::EMPTY
});

/// A rectangle with the texture four times side by side.
#[rustfmt::skip]
static FENCE: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[[-32, 0, 0], [32, 0, 0], [32, 16, 0], [-32, 16, 0]]),
    scale: Scale::new(1, -4),
    texture_coordinates: TextureCoordinates::I16(&[
        [i16::MIN, 1 << 14], [i16::MAX, 1 << 14], [i16::MAX, 0], [i16::MIN, 0],
    ]),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([255; 3], 2)],
    ..Tables::EMPTY
});

/// 16 x 16 texels of two bits; place 0 of the palette is transparent.
type Leaves = Texture<Keyed<Indexed<'static, Rgb565, 2, 64, 4>>, 16, 16, Clamp, Clamp>;
static LEAVES: [Leaves; 1] = {
    static PLACES: [u8; 64] = packed::<2, 64>(
        b"\
        ......33........\
        .....322....33..\
        ..33.321...3221.\
        .3221321..32211.\
        .1221.21.32211..\
        ..1121213211....\
        ....2121211.333.\
        .333.122113322..\
        32221.11132211..\
        122211212211....\
        .112211211......\
        ...1121211.33...\
        .33..1211.3221..\
        322211211321....\
        .11121121211....\
        .....11211......",
    );
    static COLORS: [Rgb565; 4] =
        [Rgb565::BLACK, Rgb565::new(3, 20, 4), Rgb565::new(6, 34, 5), Rgb565::new(13, 50, 8)];
    [Texture::new(Keyed::new(Indexed::new(&PLACES, &COLORS), 0))]
};

/// 16 x 16 texels of two bits, and an alpha plane of one.
type Pickets = Texture<Masked<'static, Indexed<'static, Rgb565, 2, 64, 4>, 1, 32>, 16, 16>;
static PICKETS: [Pickets; 1] = {
    const PICTURE: &[u8; 256] = b"\
        ...3.......3....\
        ..332.....332...\
        .33322...33322..\
        .33322...33322..\
        .33322...33322..\
        1333221113332211\
        0333220003332200\
        .33322...33322..\
        .33322...33322..\
        .33322...33322..\
        .33322...33322..\
        1333221113332211\
        0333220003332200\
        .33322...33322..\
        .33322...33322..\
        .33322...33322..";
    static PLACES: [u8; 64] = packed::<2, 64>(PICTURE);
    static ALPHA: [u8; 32] = packed::<1, 32>(PICTURE);
    static COLORS: [Rgb565; 4] = [
        Rgb565::new(13, 24, 12),
        Rgb565::new(19, 38, 18),
        Rgb565::new(24, 48, 23),
        Rgb565::new(30, 61, 29),
    ];
    [Texture::new(Masked::new(Indexed::new(&PLACES, &COLORS), &ALPHA))]
};

/// Two bits a texel: its digit. One bit: whether it has one. The leftmost is in the lowest bits.
const fn packed<const BITS: usize, const BYTES: usize>(picture: &[u8; 256]) -> [u8; BYTES] {
    let (mut bytes, mut i) = ([0; BYTES], 0);
    while i < 256 {
        let value = match (picture[i], BITS) {
            (b'.', _) => 0,
            (_, 1) => 1,
            (digit, _) => digit - b'0',
        };
        bytes[i * BITS / 8] |= value << (i * BITS % 8);
        i += 1;
    }
    bytes
}

const SKY: Rgb565 = Rgb565::new(17, 45, 30);
const GRASS: Rgb565 = Rgb565::new(11, 38, 9);
static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    const EYE: Vec3 = Vec3::lit("1", "1.3", "4");
    const TARGET: Vec3 = Vec3::lit("0", "0.5", "0");
    let lens = Perspective::new(Turn::degrees(34), Distance::lit("0.5"), Distance::lit("20"))?;
    let camera = Camera::look_at(EYE, TARGET, Vec3::Y, lens, SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    frame.fill_solid(&Rectangle::new(Point::new(0, 47), Size::new(240, 193)), GRASS)?;

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; FENCE.vertex_count()];
    let fence = Object::new(&FENCE, Textured::new(&PICKETS)).culled(CullNone);
    let place = const { Vec3::lit("0", "0", "0.5") };
    let fence = fence.posed(Pose::IDENTITY.at(place).scaled(const { Distance::lit("0.6") }));
    fence.draw(&camera, &mut vertices, &mut frame)?;

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; PLANT.vertex_count()];
    for (place, size) in const {
        [
            (Vec3::lit("-0.45", "0", "-0.6"), Distance::lit("1.3")),
            (Vec3::lit("1.05", "0", "1.2"), Distance::lit("0.55")),
        ]
    } {
        let plant = Object::new(&PLANT, Textured::new(&LEAVES)).culled(CullNone);
        let plant = plant.posed(Pose::IDENTITY.at(place).scaled(size));
        plant.draw(&camera, &mut vertices, &mut frame)?;
    }

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; WOODEN_CRATE.vertex_count()];
    let pose = Pose::rotated(Rotation::about_y(Turn::degrees(20)))
        .at(const { Vec3::lit("0.5", "0.4", "-0.5") })
        .scaled(const { Distance::lit("0.7") });
    let wooden_crate = Object::new(&WOODEN_CRATE, Textured::new(&WOODEN_CRATE_TEXTURES));
    wooden_crate.posed(pose).draw(&camera, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
