//! A flame that adds light and fades along its way: `KeepDepth(Add(..))`, with an alpha by vertex,
//! `Faded`.
//!
//! Sums do not depend on their order, and the flame stores no depth that would hide what is behind
//! it: its cones are drawn in the order of the mesh.
//!
//! `cargo run -p rasterizer --example glow`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    color::Alpha,
    mesh::{Material, MeshVertex, Positions, Tables, Triangles},
    numbers::Scale,
    output::{Add, KeepDepth},
    prelude::*,
    shade::Faded,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(4, 9, 9);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));

const SIDES: usize = 16;
/// Three cones, each in the next: their width at the nozzle, their length in units of 2^-14.
const CONES: [(i64, i16); 3] = [(2600, 32_000), (1900, 27_500), (1100, 22_500)];
const VERTICES: usize = 3 * (SIDES + 1);
const NOZZLE: i16 = -14_400;
/// The rocket's axis is not the origin's.
const AXIS: i64 = 1830;

static POSITIONS: [[i16; 3]; VERTICES] = {
    let (mut table, mut vertex) = ([[0; 3]; VERTICES], 0);
    while vertex < VERTICES {
        let (radius, length) = CONES[vertex / (SIDES + 1)];
        let side = vertex % (SIDES + 1);
        table[vertex] = if side == SIDES {
            [0, -length, AXIS as i16]
        } else {
            let turn = Turn::fraction(side as u32, SIDES as u32);
            let [x, z] = [turn.cos().to_bits() as i64, turn.sin().to_bits() as i64];
            [((x * radius) >> 30) as i16, NOZZLE, (AXIS + ((z * radius) >> 30)) as i16]
        };
        vertex += 1;
    }
    table
};

static TRIANGLES: [[u8; 3]; 3 * SIDES] = {
    let (mut table, mut i) = ([[0; 3]; 3 * SIDES], 0);
    while i < 3 * SIDES {
        let (first, side) = (i / SIDES * (SIDES + 1), i % SIDES);
        let next = (side + 1) % SIDES;
        table[i] = [(first + side) as u8, (first + next) as u8, (first + SIDES) as u8];
        i += 1;
    }
    table
};

static FLAME: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&POSITIONS),
    scale: Scale::new(1, -14),
    triangles: Triangles::U8(&TRIANGLES),
    materials: &[
        Material::new([150, 40, 10], SIDES as u32),
        Material::new([150, 80, 20], SIDES as u32),
        Material::new([160, 140, 90], SIDES as u32),
    ],
    ..Tables::EMPTY
});

/// All of the light at the nozzle, none at the tips.
fn fading(vertex: &MeshVertex<'_>) -> Alpha {
    let [_, y, _] = vertex.position();
    if y == NOZZLE { Alpha::OPAQUE } else { Alpha::CLEAR }
}

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.32", "0.4", "0") })
        .scaled(const { Distance::lit("0.85") });
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);
    rocket.draw(&camera, &mut vertices, &mut frame)?;

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; FLAME.vertex_count()];
    let flame = Object::new(&FLAME, Faded::new(Unlit::new(), fading)).posed(pose);
    let flame = flame.culled(CullNone).blended(KeepDepth(Add(Alpha::OPAQUE)));
    flame.draw(&camera, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
