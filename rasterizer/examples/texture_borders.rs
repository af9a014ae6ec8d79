//! What lies beyond the borders of a texture: `Repeat`, `Mirror` or `Clamp`, for each axis.
//!
//! `cargo run -p rasterizer --example texture_borders`

mod common;

use common::{Result, SCREEN, Screen, camera};
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
    texture::{Clamp, Indexed, Mirror, Repeat, Texture, Wrap},
};
use static_cell::ConstStaticCell;

/// A texture's middle part is the texture; there is as much again on each side: 1 is 2^14.
const BEFORE: i16 = -1 << 14;
const BEHIND: i16 = i16::MAX;
static SQUARE: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
    texture_coordinates: TextureCoordinates::I16(&[
        [BEFORE, BEHIND],
        [BEHIND, BEHIND],
        [BEHIND, BEFORE],
        [BEFORE, BEFORE],
    ]),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([255; 3], 2)],
    ..Tables::EMPTY
});

/// 16 x 16 texels of two bits.
type Letter<X, Y> = Texture<Indexed<'static, Rgb565, 2, 64, 4>, 16, 16, X, Y>;
static COLORS: [Rgb565; 4] = [
    Rgb565::new(29, 54, 22),
    Rgb565::new(5, 14, 14),
    Rgb565::new(26, 18, 6),
    Rgb565::new(8, 34, 22),
];
static TEXELS: [u8; 64] = {
    const PICTURE: &[u8; 256] = b"\
        ++++++++--------\
        +..............-\
        +..............-\
        +...########...-\
        +...########...-\
        +...##.........-\
        +...##.........-\
        +...######.....-\
        #...######.....#\
        #...##.........#\
        #...##.........#\
        #...##.........#\
        #...##.........#\
        #..............#\
        #..............#\
        --------++++++++";
    // The leftmost of four texels is in the lowest bits of a byte.
    let (mut texels, mut i) = ([0; 64], 0);
    while i < 256 {
        let place = match PICTURE[i] {
            b'#' => 1,
            b'+' => 2,
            b'-' => 3,
            _ => 0,
        };
        texels[i / 4] |= place << (2 * (i % 4));
        i += 1;
    }
    texels
};

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> =
    ConstStaticCell::new([Rgb565::new(3, 6, 5); 240 * 240]);

/// Draws the square into a quarter of the picture.
fn quarter<X: Wrap, Y: Wrap>(
    frame: &mut Frame<'_, Rgb565, NoDepth>,
    corner: Point,
    (_, _): (X, Y),
    name: &str,
) -> Result {
    let textures = [Letter::<X, Y>::new(Indexed::new(&TEXELS, &COLORS))];
    let camera = camera(Rectangle::new(corner, Size::new(120, 120)))?;
    let lower = Pose::IDENTITY.at(Vec3::lit("0", "-0.08", "0")).scaled(Distance::lit("0.9"));
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; SQUARE.vertex_count()];
    let square = Object::new(&SQUARE, Textured::new(&textures)).posed(lower);
    square.draw(&camera, &mut vertices, frame)?;
    let style = MonoTextStyle::new(&FONT_6X10, Rgb565::WHITE);
    Text::new(name, corner + Point::new(11, 9), style).draw(frame)?;
    Ok(())
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let mut frame = Frame::without_depth(COLOR.take(), SCREEN)?;
    quarter(&mut frame, Point::new(0, 0), (Repeat, Repeat), "Repeat")?;
    quarter(&mut frame, Point::new(120, 0), (Mirror, Mirror), "Mirror")?;
    quarter(&mut frame, Point::new(0, 120), (Clamp, Clamp), "Clamp")?;
    quarter(&mut frame, Point::new(120, 120), (Repeat, Clamp), "Repeat, Clamp")?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
