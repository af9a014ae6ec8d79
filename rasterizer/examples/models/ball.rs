//! A ball of radius 1 whose tables the compiler computes.

use rasterizer::{
    mesh::{Material, Mesh, Normals, Positions, Tables, TextureCoordinates, Triangles},
    numbers::{Scale, Turn},
};

const SECTORS: usize = 40;
const RINGS: usize = 20;
/// The first meridian is there twice, with the texture's left edge and with its right one.
const MERIDIANS: usize = SECTORS + 1;
const VERTICES: usize = MERIDIANS * (RINGS + 1);
/// Two for each field of a ring, but one at the poles.
pub(crate) const TRIANGLES: u32 = 2 * SECTORS as u32 * (RINGS as u32 - 1);

static POSITIONS: [[i16; 3]; VERTICES] = {
    let (mut table, mut vertex) = ([[0; 3]; VERTICES], 0);
    while vertex < VERTICES {
        let [x, y, z] = point(vertex, 32_767);
        table[vertex] = [x as i16, y as i16, z as i16];
        vertex += 1;
    }
    table
};

static NORMALS: [[i8; 3]; VERTICES] = {
    let (mut table, mut vertex) = ([[0; 3]; VERTICES], 0);
    while vertex < VERTICES {
        let [x, y, z] = point(vertex, 127);
        table[vertex] = [x as i8, y as i8, z as i8];
        vertex += 1;
    }
    table
};

static TEXTURE_COORDINATES: [[i32; 2]; VERTICES] = {
    let (mut table, mut vertex) = ([[0; 2]; VERTICES], 0);
    while vertex < VERTICES {
        let (sector, ring) = (vertex % MERIDIANS, vertex / MERIDIANS);
        table[vertex] = [((sector << 24) / SECTORS) as i32, ((ring << 24) / RINGS) as i32];
        vertex += 1;
    }
    table
};

/// Ring by ring from the north pole.
static INDICES: [[u16; 3]; TRIANGLES as usize] = {
    let (mut table, mut count, mut field) = ([[0; 3]; TRIANGLES as usize], 0, 0);
    while field < SECTORS * RINGS {
        let (sector, ring) = (field % SECTORS, field / SECTORS);
        let left = (ring * MERIDIANS + sector) as u16;
        let below = left + MERIDIANS as u16;
        if ring < RINGS - 1 {
            table[count] = [left, below, below + 1];
            count += 1;
        }
        if ring > 0 {
            table[count] = [left, below + 1, left + 1];
            count += 1;
        }
        field += 1;
    }
    table
};

/// In the direction of the middle of its corners.
static FACE_NORMALS: [[i8; 3]; TRIANGLES as usize] = {
    let (mut table, mut face) = ([[0; 3]; TRIANGLES as usize], 0);
    while face < TRIANGLES as usize {
        let [a, b, c] = INDICES[face];
        let [a, b, c] = [POSITIONS[a as usize], POSITIONS[b as usize], POSITIONS[c as usize]];
        let [x, y, z] = [sum(a[0], b[0], c[0]), sum(a[1], b[1], c[1]), sum(a[2], b[2], c[2])];
        let length = (x * x + y * y + z * z).isqrt();
        table[face] =
            [(127 * x / length) as i8, (127 * y / length) as i8, (127 * z / length) as i8];
        face += 1;
    }
    table
};

const fn sum(a: i16, b: i16, c: i16) -> i64 {
    a as i64 + b as i64 + c as i64
}

/// A vertex of a ball of this radius.
const fn point(vertex: usize, radius: i64) -> [i64; 3] {
    let longitude = Turn::fraction((vertex % MERIDIANS) as u32, SECTORS as u32);
    let colatitude = Turn::fraction((vertex / MERIDIANS) as u32, 2 * RINGS as u32);
    let [across, up] = [colatitude.sin().to_bits() as i64, colatitude.cos().to_bits() as i64];
    let [right, front] = [longitude.sin().to_bits() as i64, longitude.cos().to_bits() as i64];
    [
        rounded(((across * right) >> 30) * radius),
        rounded(up * radius),
        rounded(((across * front) >> 30) * radius),
    ]
}

const fn rounded(q30: i64) -> i64 {
    (q30 + (1 << 29)) >> 30
}

/// The ball in these materials, which cover its triangles from the north pole to the south pole.
pub(crate) const fn ball(materials: &'static [Material]) -> Mesh<'static> {
    Mesh::new_const(Tables {
        positions: Positions::I16(&POSITIONS),
        scale: Scale::new(1, -15),
        vertex_normals: Normals::I8(&NORMALS),
        face_normals: Normals::I8(&FACE_NORMALS),
        texture_coordinates: TextureCoordinates::I32(&TEXTURE_COORDINATES),
        triangles: Triangles::U16(&INDICES),
        materials,
        ..Tables::EMPTY
    })
}
