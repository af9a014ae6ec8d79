//! Model files that earlier versions of the converter wrote: they compile and are drawn alike.
//!
//! Each file in `models` stays as it was written. Where the converter writes other text, a file of
//! that version joins them.

use embedded_graphics::{
    geometry::{Point, Size},
    pixelcolor::{Rgb888, RgbColor},
    primitives::Rectangle,
};
use fixed::types::U16F16;
use rasterizer::{
    attribute::EveryPixel,
    camera::{Camera, Distance, Perspective},
    mesh::{Material, Mesh, MeshMaterial, MeshVertex, RequiredTables},
    numbers::{Turn, Vec3},
    raster::Fragment,
    shade::{Flat, Gouraud, Level, Light, Shader, Textured, Unlit},
    texture::{TexelMap, Texels},
};
use rasterizer_tests::Picture;

#[expect(unreachable_pub, reason = "a model file is a module of any crate")]
mod version_0_1_0 {
    include!("../models/cube_0_1_0.rs");
}
use version_0_1_0::CUBE;

/// The same version, with textures.
#[expect(unreachable_pub, reason = "a model file is a module of any crate")]
mod textured_0_1_0 {
    include!("../models/textured_cube_0_1_0.rs");
}
use textured_0_1_0::{TEXTURED_CUBE, TEXTURED_CUBE_TEXTURES};

const DISPLAY: Rectangle = Rectangle::new(Point::zero(), Size::new(24, 24));

/// What a shader makes of a cube, seen from the right, from above and from the front.
fn pixels(cube: &Mesh<'_>, shader: impl Shader<Color = Rgb888>) -> Vec<Rgb888> {
    let (near, far) = (Distance::lit("0.1"), Distance::lit("10"));
    let lens = Perspective::new(Turn::degrees(36), near, far).unwrap();
    let eye = Vec3::lit("1.5", "1.5", "2.5");
    let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, DISPLAY).unwrap();
    let mut picture = Picture::<_, u16>::empty(DISPLAY, Rgb888::WHITE);
    picture.draw(cube, shader, &camera);
    picture.color
}

/// Every second row of a picture.
fn text(pixels: &[Rgb888], letter: impl Fn(Rgb888) -> char) -> Vec<String> {
    let rows = pixels.chunks(DISPLAY.size.width as usize).step_by(2);
    rows.map(|row| row.iter().map(|&color| letter(color)).collect()).collect()
}

/// The letter of a shade of red, of a shade of blue, of black, or of the background.
fn hue(color: Rgb888) -> char {
    match (color.r(), color.b()) {
        (255, 255) => '.',
        (red, blue) if red > blue => 'r',
        (red, blue) if red < blue => 'b',
        _ => '0',
    }
}

/// A chessboard of 2 x 2 fields over each repeat of a texture.
#[derive(Clone)]
struct Chessboard;

impl Shader for Chessboard {
    type Color = Rgb888;
    /// u and v, with all 16 bits behind the binary point.
    type Varyings = [u16; 2];
    type Surface = ();
    type Face = ();
    type Outcome = Rgb888;

    const TABLES: RequiredTables =
        RequiredTables { texture_coordinates: true, ..RequiredTables::NONE };

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 2] {
        vertex.texture_coordinates().map(|c| (c >> 8).min(0xFFFF) as u16)
    }

    fn pixel(&self, (): &(), (): &(), fragment: Fragment<[U16F16; 2]>) -> Rgb888 {
        let [u, v] = fragment.varyings;
        let field = |c: U16F16| c.to_bits() >> 31;
        if field(u) == field(v) { Rgb888::BLACK } else { Rgb888::BLUE }
    }
}

#[test]
fn version_0_1_0_has_all_its_tables() {
    let tables = CUBE.tables();
    assert_eq!([CUBE.vertex_count(), CUBE.triangle_count()], [24, 12]);
    assert_eq!((CUBE.bounds().min, CUBE.bounds().max), ([-32_767; 3], [32_767; 3]));
    assert_eq!(tables.positions.get(2), Some([-32_767, -32_767, 32_767]));
    assert_eq!(tables.vertex_normals.get(23), Some([-127, 0, 0]));
    assert_eq!(tables.face_normals.get(4), Some([0, 127, 0]));
    assert_eq!(tables.texture_coordinates.get(3), Some([1 << 24, 1 << 24]));
    assert_eq!(tables.triangles.get(11), Some([20, 22, 23]));
    assert_eq!(
        tables.materials,
        [Material::new([204, 51, 26], 8), Material::new([26, 77, 230], 4)]
    );
}

#[test]
fn version_0_1_0_is_drawn_in_every_shader() {
    let unlit = text(&pixels(&CUBE, Unlit::new()), hue);
    assert_eq!(
        unlit,
        [
            "........................",
            "........................",
            ".......rrrrrrrrrrr......",
            "..rrrrrrrrrrrrrrrrrbb...",
            "..rrrrrrrrrrrrrrrbbbb...",
            "..rrrrrrrrrrrrrbbbbbb...",
            "..rrrrrrrrrrrrrbbbbb....",
            "...rrrrrrrrrrrrbbbbb....",
            "...rrrrrrrrrrrrbbbbb....",
            "...rrrrrrrrrrrrbbb......",
            "........rrrrrrrbb.......",
            "............rrr.........",
        ]
    );
    let light = |toward| Light::new(toward, Level::ZERO, Level::ONE);
    let (before, behind) = (Vec3::lit("1", "1", "1"), Vec3::lit("-1", "-1", "-1"));
    assert_eq!(text(&pixels(&CUBE, Flat::new(light(before))), hue), unlit);
    assert_eq!(text(&pixels(&CUBE, Gouraud::<_, 64>::new(light(before))), hue), unlit);
    let dark: Vec<String> = unlit.iter().map(|row| row.replace(['r', 'b'], "0")).collect();
    assert_eq!(text(&pixels(&CUBE, Flat::new(light(behind))), hue), dark);
    assert_eq!(text(&pixels(&CUBE, Gouraud::<_, 64>::new(light(behind))), hue), dark);
    assert_eq!(
        text(&pixels(&CUBE, Chessboard), hue),
        [
            "........................",
            "........................",
            ".......00000000bbb......",
            "..bbbbbbbb00000bbbbbb...",
            "..000000bb00000000bbb...",
            "..0000000bbbbbb000bbb...",
            "..0000000bbbbbb000b0....",
            "...bbbbbb0bbbbb00b00....",
            "...bbbbbb000000bbb00....",
            "...bbbbbb000000bb0......",
            "........b000000bb.......",
            "............000.........",
        ]
    );
}

#[test]
fn version_0_1_0_has_textures() {
    let tables = TEXTURED_CUBE.tables();
    assert_eq!(tables.texture_coordinates.get_q14(3), Some([1 << 14, 1 << 14]));
    assert!(TEXTURED_CUBE_TEXTURES[1].is_none(), "the second material has a colour");
    let texture = TEXTURED_CUBE_TEXTURES[0].unwrap();
    // The upper row: black, red and two of blue. In the lower rows, blue is transparent.
    let texel = |index| texture.texels().texel(index);
    assert_eq!(texel(0), Some(Rgb888::BLACK));
    assert!(texel(1).is_some_and(|color| hue(color) == 'r'));
    assert!(texel(2).is_some_and(|color| hue(color) == 'b'));
    assert_eq!((texel(10), texel(15)), (None, None));
    // The last level is the mean of the others.
    assert!(texel(20).is_some());

    let textured = Textured::new(&TEXTURED_CUBE_TEXTURES).corrected(EveryPixel);
    let nearest = text(&pixels(&TEXTURED_CUBE, textured), hue);
    assert_eq!(
        nearest,
        [
            "........................",
            "........................",
            ".......bbbbbbbbbbb......",
            "..bbbbbbbbbbbbbbbbbbb...",
            "..000rrrbbbbbbbbbrrbb...",
            "..rr0rrrbbbbbbb00rbbb...",
            "..rrrrrrbbbbbbb0rrb.....",
            "...rrrrrbbbbbbbrrr......",
            "...rrrrr.....bbrrr......",
            "...rrrrr.......rrr......",
            "...............rr.......",
            "........................",
        ]
    );
}
