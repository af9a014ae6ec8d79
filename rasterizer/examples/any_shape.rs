//! Objects of several shapes in one array: birds as they were modelled, between two shapes,
//! changed by a matrix, and both.
//!
//! What draws is compiled for the type of an object. Here the shape is chosen at run time, so that
//! all birds have one type, and what draws them is linked once.
//!
//! `cargo run -p rasterizer --example any_shape`

/// What `host-tools convert bird_up.obj bird_level.obj bird_down.obj -o bird.rs --name BIRD` makes.
#[path = "models/bird.rs"]
pub mod bird;
mod common;

use bird::{BIRD, BIRD_KEYFRAMES};
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    geometry::AnyShape, mesh::Progress, numbers::Matrix, output::Replace, prelude::*,
    raster::NoBias, scene::Modes,
};
use static_cell::ConstStaticCell;

const SKY: Rgb565 = Rgb565::new(14, 38, 27);
const SUN: Light = Light::new(Vec3::lit("-3", "4", "2"), Level::lit("0.25"), Level::lit("0.75"));

/// A bird of any shape.
type Bird<'a> =
    Object<'a, Gouraud<Rgb565>, Modes<CullBack, ClipAll, Replace, NoBias, AnyShape<'a>>>;

/// With half of the span.
const NARROW: Matrix = Matrix::scaling(Scalar::lit("0.5"), Scalar::ONE, Scalar::ONE);
/// Longer than it is.
const LONG: Matrix = Matrix::scaling(Scalar::ONE, Scalar::ONE, Scalar::lit("1.8"));

/// Where the birds are.
const PLACES: [Vec3; 4] = [
    Vec3::lit("-0.45", "0.45", "0"),
    Vec3::lit("0.45", "0.45", "0"),
    Vec3::lit("-0.45", "-0.45", "0"),
    Vec3::lit("0.45", "-0.45", "0"),
];

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([SKY; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; BIRD.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    let shader = Gouraud::new(SUN);
    let tween = BIRD_KEYFRAMES.between(1, 2, const { Progress::lit("0.8") }).ok_or("no shape")?;
    let modelled = Object::new(&BIRD, shader);
    let morphed = Object::morphed(&tween, shader);
    let flock: [Bird<'_>; 4] = [
        modelled.in_any_shape(),
        morphed.in_any_shape(),
        modelled.shaped(&NARROW).in_any_shape(),
        morphed.shaped(&LONG).in_any_shape(),
    ];

    let heading = Rotation::about_x(Turn::degrees(24)) * Rotation::about_y(Turn::degrees(38));
    for (bird, place) in flock.into_iter().zip(PLACES) {
        let pose = Pose::rotated(heading).at(place).scaled(const { Distance::lit("0.5") });
        bird.posed(pose).draw(&camera, &mut vertices, &mut frame)?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
