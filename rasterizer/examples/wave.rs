//! Water, whose vertices move in RAM: a field of heights with rings that run from a point, and
//! their normals. Indices and materials are checked once, and a frame's heights not at all.
//!
//! `cargo run -p rasterizer --example wave`

mod common;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{
        BoundingBox, Material, Moving, MovingMesh, Tables, Triangles,
        shapes::{Plane, Solid},
    },
    prelude::*,
};
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(2, 5, 6);
const SUN: Light = Light::new(Vec3::lit("-4", "3", "0"), Level::lit("0.1"), Level::lit("0.9"));

/// Cells along a side.
const CELLS: usize = 40;
const FIELD: Plane = Plane::new(CELLS, CELLS);
/// A flat field, for its indices and for where its vertices are at first: in 16,384ths.
const FLAT: Solid<{ FIELD.vertices() }, { FIELD.triangles() }> = FIELD.solid();
static TRIANGLES: [[u16; 3]; FIELD.triangles()] = FLAT.triangles;
/// What stays.
const WATER: Tables<'static> = Tables {
    scale: Solid::<{ FIELD.vertices() }, { FIELD.triangles() }>::SCALE,
    triangles: Triangles::U16(&TRIANGLES),
    materials: &[Material::new([70, 170, 235], FIELD.triangles() as u32)],
    ..Tables::EMPTY
};
/// No wave is higher than this, or deeper.
const HIGHEST: i16 = 1400;
const RANGE: BoundingBox =
    BoundingBox { min: [-16_384, -HIGHEST, -16_384], max: [16_384, HIGHEST, 16_384] };

static POSITIONS: ConstStaticCell<[[i16; 3]; FIELD.vertices()]> =
    ConstStaticCell::new(FLAT.positions);
static NORMALS: ConstStaticCell<[[i8; 3]; FIELD.vertices()]> =
    ConstStaticCell::new([[0, 127, 0]; FIELD.vertices()]);
static VERTICES: ConstStaticCell<[ScreenVertex<S8, u16, [u16; 1]>; FIELD.vertices()]> =
    ConstStaticCell::new([ScreenVertex::EMPTY; FIELD.vertices()]);
static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

/// The height of the water at a place, in 16,384ths: rings that run outwards by a wave a turn, and
/// get lower.
fn height(x: i32, z: i32, time: Turn) -> i32 {
    // The square of the distance from where a stone fell.
    let (x, z) = (x - 3000, z + 2500);
    let distance = (x * x + z * z).isqrt();
    // A wave is half a unit long.
    let angle = Turn::from_bits((distance as u32).wrapping_mul(1 << 19)) - time;
    let highest = i32::from(HIGHEST) * 4000 / (4000 + distance);
    ((i64::from(angle.sin().to_bits()) * i64::from(highest)) >> 30) as i32
}

/// Moves the water.
fn flow(water: &mut MovingMesh<'_>, time: Turn) {
    water.update(|_, [x, _, z]| [x, height(x.into(), z.into(), time) as i16, z]);
    let step = 32_768 / CELLS as i32;
    for vertex in 0..FIELD.vertices() {
        let position = water.mesh().tables().positions.get(vertex).unwrap_or_default();
        let [x, _, z] = position.map(i32::from);
        // The slopes from neighbour to neighbour: at right angles to both is this direction.
        let [left, right] = [x - step, x + step].map(|x| height(x, z, time));
        let [back, front] = [z - step, z + step].map(|z| height(x, z, time));
        water.set_vertex_normal(vertex, [left - right, 2 * step, back - front]);
    }
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let moving =
        Moving { positions: POSITIONS.take(), vertex_normals: NORMALS.take(), ..Moving::default() };
    // Once, when the firmware starts.
    let mut water = MovingMesh::new(WATER, moving, RANGE)?;

    let camera = camera(SCREEN)?;
    let leaning = Rotation::about_x(Turn::degrees(38)) * Rotation::about_y(Turn::degrees(35));
    let pose = Pose::rotated(leaning).scaled(const { Distance::lit("0.78") });
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    // In each frame.
    flow(&mut water, Turn::degrees(100));
    let mesh = water.mesh();
    Object::new(&mesh, Gouraud::new(SUN)).posed(pose).draw(&camera, VERTICES.take(), &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
