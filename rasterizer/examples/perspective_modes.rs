//! A floor in perspective: straight lines (`Affine`), divided at every 16th pixel (`Every`), as
//! often as half a texel needs it (`Adaptive`) and at every pixel (`EveryPixel`).
//!
//! The camera leans to the side, so that a row of pixels runs from near to far.
//!
//! `cargo run -p rasterizer --example perspective_modes`

#[expect(dead_code, reason = "the camera is another one")]
mod common;

use common::{Result, SCREEN, Screen};
use embedded_graphics::{
    mono_font::{MonoTextStyle, ascii::FONT_6X10},
    pixelcolor::Rgb565,
    prelude::*,
    primitives::Rectangle,
    text::Text,
};
use rasterizer::{
    attribute::{Adaptive, Affine, Correction, Every, EveryPixel},
    mesh::{Material, Positions, Tables, TextureCoordinates, Triangles},
    prelude::*,
    texture::{Indexed, Texture},
};
use static_cell::ConstStaticCell;

/// Two triangles, with the texture once: 1 is 2^14.
static FLOOR: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[[-2, 0, 2], [2, 0, 2], [2, 0, -14], [-2, 0, -14]]),
    texture_coordinates: TextureCoordinates::I16(&[
        [0, 1 << 14],
        [1 << 14, 1 << 14],
        [1 << 14, 0],
        [0, 0],
    ]),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([255; 3], 2)],
    ..Tables::EMPTY
});

/// 4 tiles across and 16 along, of one bit a texel.
type Tiles = Texture<Indexed<'static, Rgb565, 1, 1024, 2>, 64, 128>;
static TILES: [Tiles; 1] = [Texture::new(Indexed::new(&TEXELS, &COLORS))];
static COLORS: [Rgb565; 2] = [Rgb565::new(6, 20, 16), Rgb565::new(30, 56, 22)];
static TEXELS: [u8; 1024] = {
    let (mut texels, mut byte) = ([0; 1024], 0);
    while byte < 1024 {
        // A row has eight bytes, and a tile two of them in eight rows.
        let is_bright = (byte / 2 + byte / 64) % 2 == 0;
        texels[byte] = if is_bright { 0xFF } else { 0 };
        byte += 1;
    }
    texels
};

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> =
    ConstStaticCell::new([Rgb565::new(3, 6, 5); 240 * 240]);

/// Draws the floor into a quarter of the picture.
fn quarter<M: Correction>(
    frame: &mut Frame<'_, Rgb565, NoDepth>,
    corner: Point,
    mode: M,
    name: &str,
) -> Result {
    const EYE: Vec3 = Vec3::lit("-0.4", "1.2", "3.2");
    const TARGET: Vec3 = Vec3::lit("0.2", "0", "-1.5");
    const UP: Vec3 = Vec3::lit("0.55", "1", "0");
    let viewport = Rectangle::new(corner, Size::new(119, 119));
    let lens = Perspective::new(Turn::degrees(50), Distance::lit("0.1"), Distance::lit("100"))?;
    let camera = Camera::look_at(EYE, TARGET, UP, lens, viewport)?;
    let shader = Textured::new(&TILES).corrected(mode);
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; FLOOR.vertex_count()];
    Object::new(&FLOOR, shader).draw(&camera, &mut vertices, frame)?;
    let style = MonoTextStyle::new(&FONT_6X10, Rgb565::WHITE);
    Text::new(name, corner + Point::new(4, 10), style).draw(frame)?;
    Ok(())
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let mut frame = Frame::without_depth(COLOR.take(), SCREEN)?;
    quarter(&mut frame, Point::new(0, 0), Affine, "Affine")?;
    quarter(&mut frame, Point::new(121, 0), Every::<16>, "Every::<16>")?;
    quarter(&mut frame, Point::new(0, 121), Adaptive::<8>, "Adaptive")?;
    quarter(&mut frame, Point::new(121, 121), EveryPixel, "EveryPixel")?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
