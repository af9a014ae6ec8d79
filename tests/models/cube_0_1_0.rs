// A model as const tables, written by host-tools 0.1.0: do not edit.
//
// From `cube.obj`: 262 bytes, FNV-1a eb0d12a457c69f3b
// From `cube.mtl`: 53 bytes, FNV-1a 7464fdce6a024ed2
// With unit fit, a crease angle of 60 degrees, contents: vertex normals, face normals, texture coordinates
//
// Vertices: 24, in the file 8
// Triangles: 12, in the file 6 faces; left out as they have no area: 0
// Size (diagonal of the bounding box): 2.0000 units
// Position error: 1.09e-10 units at most (0.00000 % of the size), 1.09e-10 root mean square (0.00000 %)
// Normal error: 0.000 degrees at most
// Texture coordinate error: 0.00e0 of a repeat at most
// Vertices transformed per triangle (cache of 16): 2.000, in the file's order 2.000
// Flash: 400 bytes
//   positions                  144
//   vertex_normals              72
//   face_normals                36
//   texture_coordinates         96
//   triangles                   36
//   materials                   16
//
// To leave out a table that no shader uses, convert again with fewer contents.

/// `cube.obj`: 24 vertices, 12 triangles.
#[allow(clippy::needless_update, reason = "a later version has more tables")]
#[rustfmt::skip]
pub static CUBE: ::rasterizer::mesh::Mesh<'static> = {
    use ::rasterizer::{
        mesh::{Material, Mesh, Normals, Positions, Tables, TextureCoordinates, Triangles},
        numbers::{Scale, Vec3},
    };
    static POSITIONS: [[i16; 3]; 24] = [
        [32767, 32767, 32767], [-32767, 32767, 32767], [-32767, -32767, 32767],
        [32767, -32767, 32767], [-32767, 32767, -32767], [32767, 32767, -32767],
        [32767, -32767, -32767], [-32767, -32767, -32767], [32767, 32767, -32767],
        [-32767, 32767, -32767], [-32767, 32767, 32767], [32767, 32767, 32767],
        [32767, -32767, 32767], [-32767, -32767, 32767], [-32767, -32767, -32767],
        [32767, -32767, -32767], [32767, 32767, -32767], [32767, 32767, 32767],
        [32767, -32767, 32767], [32767, -32767, -32767], [-32767, 32767, 32767],
        [-32767, 32767, -32767], [-32767, -32767, -32767], [-32767, -32767, 32767],
    ];
    static VERTEX_NORMALS: [[i8; 3]; 24] = [
        [0, 0, 127], [0, 0, 127], [0, 0, 127], [0, 0, 127], [0, 0, -127], [0, 0, -127],
        [0, 0, -127], [0, 0, -127], [0, 127, 0], [0, 127, 0], [0, 127, 0], [0, 127, 0],
        [0, -127, 0], [0, -127, 0], [0, -127, 0], [0, -127, 0], [127, 0, 0], [127, 0, 0],
        [127, 0, 0], [127, 0, 0], [-127, 0, 0], [-127, 0, 0], [-127, 0, 0], [-127, 0, 0],
    ];
    static FACE_NORMALS: [[i8; 3]; 12] = [
        [0, 0, 127], [0, 0, 127], [0, 0, -127], [0, 0, -127], [0, 127, 0], [0, 127, 0],
        [0, -127, 0], [0, -127, 0], [127, 0, 0], [127, 0, 0], [-127, 0, 0], [-127, 0, 0],
    ];
    static TEXTURE_COORDINATES: [[u16; 2]; 24] = [
        [32768, 0], [0, 0], [0, 32768], [32768, 32768], [32768, 0], [0, 0], [0, 32768],
        [32768, 32768], [32768, 0], [0, 0], [0, 32768], [32768, 32768], [32768, 0], [0, 0],
        [0, 32768], [32768, 32768], [32768, 0], [0, 0], [0, 32768], [32768, 32768], [32768, 0],
        [0, 0], [0, 32768], [32768, 32768],
    ];
    static TRIANGLES: [[u8; 3]; 12] = [
        [0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7], [8, 9, 10], [8, 10, 11], [12, 13, 14],
        [12, 14, 15], [16, 17, 18], [16, 18, 19], [20, 21, 22], [20, 22, 23],
    ];
    static MATERIALS: [Material; 2] = [
        Material::new([204, 51, 26], 8), Material::new([26, 77, 230], 4),
    ];
    Mesh::new_const(Tables {
        positions: Positions::I16(&POSITIONS),
        scale: Scale::new(0x93CE_61C9, -47),
        offset: Vec3::from_bits([0, 0, 0]),
        vertex_normals: Normals::I8(&VERTEX_NORMALS),
        face_normals: Normals::I8(&FACE_NORMALS),
        texture_coordinates: TextureCoordinates::U16 {
            table: &TEXTURE_COORDINATES,
            fraction_bits: 15,
        },
        triangles: Triangles::U8(&TRIANGLES),
        materials: &MATERIALS,
        ..Tables::EMPTY
    })
};
