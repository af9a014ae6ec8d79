//! What is behind the objects: a colour, a gradient from one colour to another, the same without
//! stripes, and a picture, which is a texture.
//!
//! `cargo run -p rasterizer --example backgrounds`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, Screen, camera};
use embedded_graphics::{
    image::Image,
    pixelcolor::{Rgb565, Rgb888},
    prelude::*,
    primitives::Rectangle,
};
use rasterizer::{
    output::{Dithering, VerticalGradient},
    prelude::*,
    texture::{Clamp, Colors, Texture},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const LIGHT: Light = Light::new(Vec3::lit("-3", "2", "3"), Level::lit("0.2"), Level::lit("0.8"));
const SIDE: Size = Size::new(120, 120);
const QUARTERS: [Rectangle; 4] = [
    Rectangle::new(Point::new(0, 0), SIDE),
    Rectangle::new(Point::new(120, 0), SIDE),
    Rectangle::new(Point::new(0, 120), SIDE),
    Rectangle::new(Point::new(120, 120), SIDE),
];
const DUSK: [u8; 3] = [20, 30, 62];
const GLOW: [u8; 3] = [92, 62, 74];

/// A weave of 120 x 120 texels: any texture of any format is a picture.
static WEAVE: Texture<Colors<'static, Rgb565, 14_400>, 120, 120, Clamp, Clamp> = {
    static TEXELS: [Rgb565; 14_400] = {
        let (mut texels, mut index) = ([Rgb565::BLACK; 14_400], 0);
        while index < 14_400 {
            let (x, y) = (index % 120 / 6, index / 120 / 6);
            let level = ((x + 2 * y) % 5 * 2) as u8;
            texels[index] = Rgb565::new(4 + level, 14 + level, 12 + level);
            index += 1;
        }
        texels
    };
    Texture::new(Colors::new(&TEXELS))
};

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> =
    ConstStaticCell::new([Rgb565::BLACK; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), common::SCREEN)?;
    let [one, two, three, four] = QUARTERS;
    frame.fill_solid(&one, Rgb565::new(8, 22, 14))?;
    VerticalGradient::new(two, DUSK, GLOW).draw(&mut frame)?;
    VerticalGradient::<Rgb888>::new(three, DUSK, GLOW).draw(&mut Dithering::new(&mut frame))?;
    Image::new(&WEAVE, four.top_left).draw(&mut frame)?;

    let tilted = Rotation::about_z(-Turn::degrees(30)) * Rotation::about_y(Turn::degrees(40));
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(Pose::rotated(tilted));
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    for quarter in QUARTERS {
        rocket.draw(&camera(quarter)?, &mut vertices, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
