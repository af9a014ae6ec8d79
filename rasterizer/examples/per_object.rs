//! What an object can have at run time, with the same tables: another colour of a material
//! (`Recolored`), another texture (another shader value), another place of the texture (`Offset`).
//!
//! `cargo run -p rasterizer --example per_object`

#[path = "models/ball.rs"]
mod ball;
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{pixelcolor::Rgb565, pixelcolor::Rgb888, prelude::*};
use rasterizer::{
    fixed::types::I8F24,
    mesh::Material,
    prelude::*,
    shade::Recolored,
    texture::{Colors, Offset, Texture},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(2, 5, 5);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "3"), Level::lit("0.2"), Level::lit("0.8"));

static BALL: Mesh<'static> = ball(&[Material::new([255; 3], ball::TRIANGLES)]);

/// Stripes from pole to pole, the first of another colour.
type Stripes = Texture<Colors<'static, Rgb565, 8>, 8, 1>;
static STRIPES: [Stripes; 2] = {
    const RED: Rgb565 = Rgb565::new(28, 10, 6);
    const SAND: Rgb565 = Rgb565::new(30, 54, 20);
    const TEAL: Rgb565 = Rgb565::new(4, 36, 18);
    const INK: Rgb565 = Rgb565::new(4, 8, 10);
    [
        Texture::new(Colors::new(&[RED, SAND, TEAL, SAND, TEAL, SAND, TEAL, SAND])),
        Texture::new(Colors::new(&[RED, INK, SAND, INK, SAND, INK, SAND, INK])),
    ]
};

/// The place of the stripe in the rocket's table of materials.
const STRIPE: usize = 2;

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let size = const { Distance::lit("0.48") };

    let teams = [Rgb888::CSS_CRIMSON, Rgb888::CSS_GOLD, Rgb888::CSS_MEDIUM_SEA_GREEN];
    for (column, team) in (-1i32..).zip(teams) {
        let shader = Recolored::material(Gouraud::new(LIGHT), STRIPE, team);
        let rocket = Object::new(&ROCKET, shader).posed(pose(column, UPPER).scaled(size));
        rocket.project_on_demand(&camera, S4)?.draw(&mut frame);
    }

    // The first texture; the same, an eighth farther on; and the second texture.
    let still = [STRIPES[0]];
    let moved = [Offset::new(STRIPES[0], [I8F24::lit("0.125"), I8F24::ZERO])];
    let other = [STRIPES[1]];
    let size = const { Distance::lit("0.3") };
    let [left, middle, right] = [-1, 0, 1].map(|column| pose(column, LOWER).scaled(size));
    let shader = TexturedGouraud::new(&still, LIGHT).with_wide_coordinates();
    Object::new(&BALL, shader).posed(left).project_on_demand(&camera, S4)?.draw(&mut frame);
    let shader = TexturedGouraud::new(&moved, LIGHT).with_wide_coordinates();
    Object::new(&BALL, shader).posed(middle).project_on_demand(&camera, S4)?.draw(&mut frame);
    let shader = TexturedGouraud::new(&other, LIGHT).with_wide_coordinates();
    Object::new(&BALL, shader).posed(right).project_on_demand(&camera, S4)?.draw(&mut frame);
    frame.present(screen)?;
    Ok(())
}

const UPPER: Scalar = Scalar::lit("0.45");
const LOWER: Scalar = Scalar::lit("-0.55");

/// In one of three columns, at this height.
fn pose(column: i32, height: Scalar) -> Pose {
    let place = Vec3::new(Scalar::lit("0.68") * Scalar::from_num(column), height, Scalar::ZERO);
    Pose::rotated(Rotation::about_x(Turn::degrees(15))).at(place)
}

fn main() -> Result {
    common::run(draw)
}
