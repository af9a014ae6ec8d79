//! What is in the depth buffer before an object is drawn: its pixels are those that are nearer,
//! whichever of them are claimed without a test.

use embedded_graphics::{pixelcolor::Rgb888, primitives::Rectangle};
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    mesh::{
        Material,
        shapes::{Cube, Solid},
    },
    numbers::{Rotation, Turn, Vec3},
    shade::{Gouraud, Shader, Textured, TexturedGouraud, Unlit},
    texture::{Bilinear, Colors, Texture},
};
use rasterizer_tests::{Picture, Random, area, bands::light};

const DISPLAY: Rectangle = area(0, 0, 201, 120);
const BACKGROUND: Rgb888 = Rgb888::new(1, 2, 3);
const MATERIAL: &[Material] = &[Material::new([200, 150, 100], 12)];

static CUBE: Solid<{ Cube.vertices() }, { Cube.triangles() }> = Cube.solid();

/// Any colours, no two neighbours alike.
static TEXELS: [Rgb888; 64] = {
    let mut texels = [BACKGROUND; 64];
    let mut i = 0;
    while i < 64 {
        let [red, green, blue, _] = (i as u32 + 1).wrapping_mul(0x9E37_79B9).to_le_bytes();
        texels[i] = Rgb888::new(red, green, blue);
        i += 1;
    }
    texels
};
type Checks = Texture<Colors<'static, Rgb888, 64>, 8, 8>;
static CHECKS: [Checks; 1] = [Texture::new(Colors::new(&TEXELS))];

/// A picture in which runs of pixels are clear, between some that are near, far, or within a unit
/// of the object in `whole`.
fn used(whole: &Picture<Rgb888, u16>, random: &mut Random) -> Picture<Rgb888, u16> {
    let mut picture = Picture::empty(DISPLAY, BACKGROUND);
    let mut clear = 0;
    for (place, cell) in picture.depth.iter_mut().enumerate() {
        if clear > 0 {
            clear -= 1;
        } else {
            let depth = i32::from(whole.depth[place]) + random.within(-1, 1);
            *cell = random.pick(&[1, u16::MAX, depth.clamp(0, 65_535) as u16, 0]);
            clear = random.within(0, 3) * random.within(0, 30);
        }
    }
    picture
}

/// Each pixel of a convex body shows one triangle: what it shows in a used picture follows from
/// that and the cell.
fn pixels_are_those_that_are_nearer<Sh: Shader<Color = Rgb888>>(shader: &Sh, seed: u64) {
    let mesh = CUBE.mesh(MATERIAL);
    let mut random = Random::new(seed);
    let lens = Perspective::new(Turn::degrees(50), Distance::lit("0.1"), Distance::lit("50"));
    for _ in 0..40 {
        let turn = |random: &mut Random| Turn::from_bits(random.bits() as u32);
        let rotation = Rotation::about_x(turn(&mut random)) * Rotation::about_y(turn(&mut random));
        // The camera turns about the cube: from far, filling the picture, and cut by its edges.
        let away = random.pick(&["8", "3", "1.9"]);
        let eye = rotation * Vec3::lit("0", "0", away);
        let camera = Camera::at(eye, rotation, lens.unwrap(), DISPLAY).unwrap();
        let mut whole = Picture::empty(DISPLAY, BACKGROUND);
        whole.draw(&mesh, shader.clone(), &camera);
        let mut expected = used(&whole, &mut random);
        let mut drawn = expected.clone();
        drawn.draw(&mesh, shader.clone(), &camera);
        for (place, (&color, &depth)) in whole.color.iter().zip(&whole.depth).enumerate() {
            if depth > expected.depth[place] {
                (expected.color[place], expected.depth[place]) = (color, depth);
            }
        }
        let wrong = (0..drawn.color.len()).find(|&place| {
            drawn.color[place] != expected.color[place]
                || drawn.depth[place] != expected.depth[place]
        });
        assert_eq!(wrong, None, "{away} away");
    }
}

#[test]
fn pixels_of_all_shaders_are_those_that_are_nearer() {
    pixels_are_those_that_are_nearer(&Unlit::new(), 71);
    pixels_are_those_that_are_nearer(&Gouraud::new(light()), 72);
    // Divided in pieces.
    pixels_are_those_that_are_nearer(&Textured::new(&CHECKS), 73);
    pixels_are_those_that_are_nearer(&Textured::new(&CHECKS).filtered(Bilinear), 74);
    pixels_are_those_that_are_nearer(&TexturedGouraud::new(&CHECKS, light()), 75);
}
