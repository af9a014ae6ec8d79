//! A mesh in parts, straight onto the display, without depth and without sorting: `Parts`.
//!
//! Four balls lie on a plate, all in one mesh. Each part is convex, so that no front face of it
//! hides another one. A plane lies under the balls, and more of them between the balls: the sides
//! on which the viewer is tell which part hides which. The compiler checks that no triangle lies on
//! the wrong side of a plane.
//!
//! `cargo run -p rasterizer --example parts`

mod common;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use rasterizer::{
    mesh::{
        Material, Mesh, Normals, Parts, Positions, SeparatingPlane, Tables, Triangles,
        shapes::{Cube, Icosphere, Solid},
    },
    numbers::Scale,
    prelude::*,
};

const NIGHT: Rgb565 = Rgb565::new(3, 8, 8);
const LIGHT: Light = Light::new(Vec3::lit("-3", "4", "3"), Level::lit("0.15"), Level::lit("0.85"));

const BALL: Icosphere = Icosphere::new(7);
const VERTICES: usize = 4 * BALL.vertices() + Cube.vertices();
const TRIANGLES: usize = 4 * BALL.triangles() + Cube.triangles();

const BALL_TABLES: Solid<{ BALL.vertices() }, { BALL.triangles() }> = BALL.solid();
const CUBE: Solid<{ Cube.vertices() }, { Cube.triangles() }> = Cube.solid();

/// Where the balls lie: first the two on the right, of each two first the one in front.
const MIDDLES: [[i16; 3]; 4] =
    [[8000, 7000, 8000], [8000, 7000, -8000], [-8000, 7000, 8000], [-8000, 7000, -8000]];
const RADIUS: i16 = 7000;
/// Of the plate: half its sides, and where its middle lies, so that its top is at y = 0.
const PLATE: [i16; 3] = [16_000, 1000, 16_000];
const PLATE_MIDDLE: [i16; 3] = [0, -1000, 0];

type Vertices = ([[i16; 3]; VERTICES], [[i8; 3]; VERTICES]);

static VERTEX_TABLES: Vertices = {
    let (mut tables, mut ball, mut count) = (([[0; 3]; VERTICES], [[0; 3]; VERTICES]), 0, 0);
    while ball < 4 {
        let mut vertex = 0;
        while vertex < BALL.vertices() {
            let position = BALL_TABLES.positions[vertex];
            tables.0[count] = placed(position, [RADIUS; 3], MIDDLES[ball]);
            tables.1[count] = BALL_TABLES.vertex_normals[vertex];
            (vertex, count) = (vertex + 1, count + 1);
        }
        ball += 1;
    }
    let mut vertex = 0;
    while vertex < Cube.vertices() {
        tables.0[count] = placed(CUBE.positions[vertex], PLATE, PLATE_MIDDLE);
        tables.1[count] = CUBE.vertex_normals[vertex];
        (vertex, count) = (vertex + 1, count + 1);
    }
    tables
};

static INDICES: [[u16; 3]; TRIANGLES] = {
    let (mut table, mut triangle) = ([[0; 3]; TRIANGLES], 0);
    while triangle < TRIANGLES {
        let (body, own) = (triangle / BALL.triangles(), triangle % BALL.triangles());
        let [a, b, c] = if body < 4 { BALL_TABLES.triangles[own] } else { CUBE.triangles[own] };
        let first = (body * BALL.vertices()) as u16;
        table[triangle] = [first + a, first + b, first + c];
        triangle += 1;
    }
    table
};

/// A vertex of a shape, whose unit has 16,384 quanta, in another size and at another place.
const fn placed(position: [i16; 3], size: [i16; 3], middle: [i16; 3]) -> [i16; 3] {
    let (mut placed, mut axis) = ([0; 3], 0);
    while axis < 3 {
        placed[axis] = ((position[axis] as i32 * size[axis] as i32) >> 14) as i16 + middle[axis];
        axis += 1;
    }
    placed
}

const PART: u32 = BALL.triangles() as u32;

static BALLS: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&VERTEX_TABLES.0),
    scale: Scale::new(1, -14),
    vertex_normals: Normals::I8(&VERTEX_TABLES.1),
    triangles: Triangles::U16(&INDICES),
    materials: &[
        Material::new([214, 70, 56], PART),
        Material::new([240, 190, 60], PART),
        Material::new([80, 140, 220], PART),
        Material::new([96, 180, 110], PART),
        Material::new([190, 180, 160], Cube.triangles() as u32),
    ],
    ..Tables::EMPTY
});

/// Between the balls and the plate, between the right and the left balls, and between the front and
/// the back ball of each side.
static PLANES: [SeparatingPlane; 4] = [
    SeparatingPlane::new([[0, 0, 0], [0, 0, 9000], [9000, 0, 0]], [0, 4, 5]),
    SeparatingPlane::new([[0, 0, 0], [0, 9000, 0], [0, 0, 9000]], [0, 2, 4]),
    SeparatingPlane::new([[0, 0, 0], [9000, 0, 0], [0, 9000, 0]], [0, 1, 2]),
    SeparatingPlane::new([[0, 0, 0], [9000, 0, 0], [0, 9000, 0]], [2, 3, 4]),
];
static PARTS: Parts<'static> =
    Parts::new_const(&BALLS, &[PART, 2 * PART, 3 * PART, 4 * PART, TRIANGLES as u32], &PLANES);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let turned = Rotation::about_x(Turn::degrees(24)) * Rotation::about_y(Turn::degrees(28));
    let pose = Pose::rotated(turned)
        .at(const { Vec3::lit("0", "-0.16", "0") })
        .scaled(const { Distance::lit("0.74") });
    let balls = Object::new(&BALLS, Gouraud::new(LIGHT)).posed(pose);

    screen.clear(NIGHT)?;
    let seen = balls.project_on_demand(&camera(SCREEN)?, S4)?.in_parts(&PARTS);
    seen.draw(&mut Direct::new(screen))?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
