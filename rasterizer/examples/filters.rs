//! A floor to the horizon: the nearest texel, the mean of four (`Bilinear`), and with mip levels
//! the nearest texel of the nearest level (`NearestMip`) and the mean of two levels (`Trilinear`).
//!
//! Far away a pixel covers many texels. One of them, or four, is a matter of chance, which flickers
//! when the camera moves; mip levels are their means.
//!
//! `cargo run -p rasterizer --example filters`

#[expect(dead_code, reason = "the camera is another one")]
mod common;
/// What `host-tools convert --texture-format indexed4 --mipmaps` makes of `wooden_crate.obj`.
#[path = "models/wooden_crate.rs"]
pub mod wooden_crate;

use common::{Result, SCREEN, Screen};
use embedded_graphics::{
    mono_font::{MonoTextStyle, ascii::FONT_6X10},
    pixelcolor::Rgb565,
    prelude::*,
    primitives::Rectangle,
    text::Text,
};
use rasterizer::{
    mesh::{Material, Positions, Tables, TextureCoordinates, Triangles},
    prelude::*,
    texture::{Bilinear, Filter, Nearest, NearestMip, PerPixel, Trilinear},
};
use static_cell::ConstStaticCell;
use wooden_crate::{WOODEN_CRATE_TEXTURES, WoodenCrateTexture};

/// 64 repeats of the texture: 1 is 2^24.
const END: i32 = 32 << 24;
/// Two triangles, 512 units wide.
static FLOOR: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[[-256, 0, 256], [256, 0, 256], [256, 0, -256], [-256, 0, -256]]),
    texture_coordinates: TextureCoordinates::I32(&[
        [-END, END],
        [END, END],
        [END, -END],
        [-END, -END],
    ]),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([255; 3], 2)],
    ..Tables::EMPTY
});

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> =
    ConstStaticCell::new([Rgb565::new(14, 36, 24); 240 * 240]);

/// Draws the floor into a quarter of the picture.
fn quarter<F: Filter<WoodenCrateTexture>>(
    frame: &mut Frame<'_, Rgb565, NoDepth>,
    corner: Point,
    filter: F,
    name: &str,
) -> Result {
    const EYE: Vec3 = Vec3::lit("1", "1.6", "0");
    const TARGET: Vec3 = Vec3::lit("3", "0.5", "-4");
    let viewport = Rectangle::new(corner, Size::new(119, 119));
    let lens = Perspective::new(Turn::degrees(50), Distance::lit("0.5"), Distance::lit("500"))?;
    let camera = Camera::look_at(EYE, TARGET, Vec3::Y, lens, viewport)?;
    // The coordinates need more than the 16 bits that go to -2 and 2.
    let shader = Textured::new(&WOODEN_CRATE_TEXTURES).filtered(filter).with_wide_coordinates();
    let mut vertices = [ScreenVertex::<S8, _, _>::EMPTY; FLOOR.vertex_count()];
    Object::new(&FLOOR, shader).draw(&camera, &mut vertices, frame)?;
    let style = MonoTextStyle::new(&FONT_6X10, Rgb565::WHITE);
    Text::new(name, corner + Point::new(4, 10), style).draw(frame)?;
    Ok(())
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let mut frame = Frame::without_depth(COLOR.take(), SCREEN)?;
    quarter(&mut frame, Point::new(0, 0), Nearest, "Nearest")?;
    quarter(&mut frame, Point::new(121, 0), Bilinear, "Bilinear")?;
    quarter(&mut frame, Point::new(0, 121), NearestMip(PerPixel), "NearestMip")?;
    quarter(&mut frame, Point::new(121, 121), Trilinear(PerPixel), "Trilinear")?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
