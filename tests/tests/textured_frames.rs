//! Hashes of textured frames: the same on every machine, and in the arithmetic of the cores that
//! have no long multiply and no divider, in which `.ci/narrow` runs this test too.

use std::path::Path;

use embedded_graphics::{
    pixelcolor::{IntoStorage as _, Rgb565},
    primitives::Rectangle,
};
use host_tools::model::{Model, Options};
use rasterizer::{
    attribute::EveryPixel,
    camera::{Camera, Distance, Perspective},
    geometry::{Pose, ScreenVertex},
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
    output::Frame,
    scene::Object,
    shade::{OnScreen, Shader, Textured, TexturedFlat, TexturedGouraud},
    texture::{Bilinear, Colors, Mipmaps, PerPixel, Trilinear},
};
use rasterizer_tests::{area, bands::light};

const DISPLAY: Rectangle = area(0, 0, 160, 120);
const BACKGROUND: Rgb565 = Rgb565::new(1, 2, 3);

/// Texels of 16 x 16 and of all smaller levels.
const COUNT: usize = 256 + 64 + 16 + 4 + 1;
type Map = Mipmaps<Colors<'static, Rgb565, COUNT>, 16, 16>;
static MAPS: [Map; 1] = [Mipmaps::new(Colors::new(&TEXELS))];
/// Any colours, no two neighbours alike.
static TEXELS: [Rgb565; COUNT] = {
    let mut texels = [BACKGROUND; COUNT];
    let mut i = 0;
    while i < COUNT {
        let hash = (i as u32).wrapping_mul(0x9E37_79B9);
        texels[i] = Rgb565::new((hash >> 27) as u8, (hash >> 21) as u8, (hash >> 16) as u8);
        i += 1;
    }
    texels
};

/// FNV-1a over the pixels of the crate from four distances: far away, filling the picture, cut by
/// the near plane, and from inside.
fn hash<S: Subpixel, Sh: Shader<Color = Rgb565>>(shader: Sh) -> u32 {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../host-tools/models/wooden_crate.obj");
    let model = Model::load(path, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    let mesh = model.mesh();
    let lens = Perspective::new(Turn::degrees(40), Distance::lit("0.02"), Distance::lit("100"));
    let turned = Rotation::about_x(Turn::degrees(25)) * Rotation::about_y(Turn::degrees(35));
    let object = Object::new(&mesh, shader).posed(Pose::rotated(turned));
    let mut hash = 0x811C_9DC5_u32;
    for distance in ["15", "3", "0.7", "0.05"] {
        let eye = Vec3::lit("0", "0", distance);
        let camera = Camera::at(eye, Rotation::IDENTITY, lens.unwrap(), DISPLAY).unwrap();
        let mut vertices = vec![ScreenVertex::<S, u16, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
        let (mut color, mut depth) = (vec![BACKGROUND; 160 * 120], vec![0_u16; 160 * 120]);
        let mut frame = Frame::new(&mut color, &mut depth, DISPLAY).unwrap();
        object.draw(&camera, &mut vertices, &mut frame).unwrap();
        let drawn = color.iter().filter(|&&pixel| pixel != BACKGROUND).count();
        assert!(drawn > 200, "only {drawn} pixels are drawn from {distance}");
        let words = color.iter().map(|pixel| pixel.into_storage()).chain(depth);
        hash = words.fold(hash, |hash, word| (hash ^ u32::from(word)).wrapping_mul(0x0100_0193));
    }
    hash
}

#[test]
fn textured_frames_have_the_same_pixels_in_every_arithmetic() {
    let textured = Textured::new(&MAPS);
    let bilinear = textured.filtered(Bilinear).corrected(EveryPixel);
    let trilinear = textured.filtered(Trilinear(PerPixel));
    let found = [
        hash::<S4, _>(textured),
        hash::<S8, _>(textured),
        hash::<S8, _>(bilinear),
        hash::<S4, _>(trilinear),
        hash::<S4, _>(TexturedFlat::new(&MAPS, light())),
        hash::<S8, _>(TexturedGouraud::new(&MAPS, light())),
    ];
    // A change that is meant to move pixels puts new hashes here.
    let expected = [0x4CDD_9503, 0x4DD1_D803, 0x2768_ED83, 0xAF2B_0D8B, 0x32A6_F78D, 0x4ED9_C9A5];
    assert_eq!(found, expected, "{found:#010X?}");
}
