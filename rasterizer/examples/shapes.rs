//! Ready-made shapes, whose tables the compiler computes: no file of a model is needed.
//!
//! `cargo run -p rasterizer --example shapes`

mod common;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    mesh::{
        Material, Mesh,
        shapes::{Cone, Cube, Cylinder, Icosphere, Plane, Solid, Torus, UvSphere},
    },
    prelude::*,
};
use static_cell::ConstStaticCell;

const WALL: Rgb565 = Rgb565::new(4, 10, 7);
const SUN: Light = Light::new(Vec3::lit("-3", "3", "4"), Level::lit("0.15"), Level::lit("0.85"));

const SPHERE: UvSphere = UvSphere::new(24, 12);
const BALL: Icosphere = Icosphere::new(3);
const RING: Torus = Torus::new(30, 14, Scalar::lit("0.3"));
const CAN: Cylinder = Cylinder::new(24);
const HAT: Cone = Cone::new(24);
const FLOOR: Plane = Plane::new(4, 4);

static CUBE: Solid<{ Cube.vertices() }, { Cube.triangles() }> = Cube.solid();
static SPHERE_TABLES: Solid<{ SPHERE.vertices() }, { SPHERE.triangles() }> = SPHERE.solid();
static BALL_TABLES: Solid<{ BALL.vertices() }, { BALL.triangles() }> = BALL.solid();
static RING_TABLES: Solid<{ RING.vertices() }, { RING.triangles() }> = RING.solid();
static CAN_TABLES: Solid<{ CAN.vertices() }, { CAN.triangles() }> = CAN.solid();
static HAT_TABLES: Solid<{ HAT.vertices() }, { HAT.triangles() }> = HAT.solid();
static FLOOR_TABLES: Solid<{ FLOOR.vertices() }, { FLOOR.triangles() }> = FLOOR.solid();

/// Each with its place on the picture. A material has the triangles of one side of the cube; the
/// floor has its cells in two colours.
static SHAPES: [(Mesh<'static>, Vec3); 7] = [
    (
        CUBE.mesh(&[
            Material::new([214, 60, 50], 4),
            Material::new([240, 200, 60], 4),
            Material::new([60, 120, 200], 4),
        ]),
        Vec3::lit("-0.68", "0.66", "0"),
    ),
    (
        SPHERE_TABLES.mesh(&[Material::new([226, 92, 60], SPHERE.triangles() as u32)]),
        Vec3::lit("0", "0.66", "0"),
    ),
    (
        BALL_TABLES.mesh(&[Material::new([90, 170, 110], BALL.triangles() as u32)]),
        Vec3::lit("0.68", "0.66", "0"),
    ),
    (
        RING_TABLES.mesh(&[Material::new([230, 170, 60], RING.triangles() as u32)]),
        Vec3::lit("-0.68", "0", "0"),
    ),
    (
        CAN_TABLES.mesh(&[Material::new([90, 140, 210], CAN.triangles() as u32)]),
        Vec3::lit("0", "-0.02", "0"),
    ),
    (
        HAT_TABLES.mesh(&[Material::new([180, 100, 190], HAT.triangles() as u32)]),
        Vec3::lit("0.68", "0", "0"),
    ),
    (
        FLOOR_TABLES.mesh(&[
            Material::new([110, 120, 120], 8),
            Material::new([190, 190, 180], 8),
            Material::new([110, 120, 120], 8),
            Material::new([190, 190, 180], 8),
        ]),
        Vec3::lit("0", "-0.68", "0"),
    ),
];

/// Of the largest mesh.
const VERTICES: usize = RING.vertices();

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([WALL; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; VERTICES];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    let turned = Rotation::about_x(Turn::degrees(28)) * Rotation::about_y(Turn::degrees(30));
    for (mesh, place) in &SHAPES {
        let pose = Pose::rotated(turned).at(*place).scaled(const { Distance::lit("0.24") });
        Object::new(mesh, Gouraud::new(SUN)).posed(pose).draw(
            &camera,
            &mut vertices,
            &mut frame,
        )?;
    }
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
