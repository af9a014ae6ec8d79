// A model as const tables, written by host-tools 0.1.0: do not edit.
//
// From `textured_cube.obj`: 262 bytes, FNV-1a 14e765b8e0b3b279
// From `textured_cube.mtl`: 56 bytes, FNV-1a 140370116efed62a
// From `flag.png`: 88 bytes, FNV-1a 8445a5823a60dac8
// With unit fit, a crease angle of 60 degrees, contents: vertex normals, face normals, texture coordinates
//
// Vertices: 24, in the file 8
// Triangles: 12, in the file 6 faces; left out as they have no area: 0
// Size (diagonal of the bounding box): 2.0000 units
// Position error: 1.09e-10 units at most (0.00000 % of the size), 1.09e-10 root mean square (0.00000 %)
// Normal error: 0.000 degrees at most
// Texture coordinate error: 0.00e0 of a repeat at most
// Vertices transformed per triangle (cache of 16): 2.000, in the file's order 2.000
// Flash: 422 bytes
//   positions                  144
//   vertex_normals              72
//   face_normals                36
//   texture_coordinates         96
//   triangles                   36
//   materials                   16
//   textures                    22
// Textures: 4x4, indexed2, rgb888, 3 mip levels, colour key
//   flag.png: 22 bytes, from 4x4 pixels, 32.9 dB from it in that size
//
// To leave out a table that no shader uses, convert again with fewer contents.

/// `textured_cube.obj`: 24 vertices, 12 triangles.
#[allow(clippy::needless_update, reason = "a later version has more tables")]
#[rustfmt::skip]
pub static TEXTURED_CUBE: ::rasterizer::mesh::Mesh<'static> = {
    use ::rasterizer::{
        mesh::{Material, Mesh, Normals, Positions, Tables, TextureCoordinates, Triangles},
        numbers::{Scale, Vec3},
    };
    static POSITIONS: [[i16; 3]; 24] = [
        [32767, 32767, 32767], [-32767, 32767, 32767], [-32767, -32767, 32767],
        [32767, -32767, 32767], [-32767, 32767, -32767], [32767, 32767, -32767],
        [32767, -32767, -32767], [-32767, -32767, -32767], [32767, 32767, -32767],
        [32767, 32767, 32767], [32767, -32767, 32767], [32767, -32767, -32767],
        [-32767, 32767, 32767], [-32767, 32767, -32767], [-32767, -32767, -32767],
        [-32767, -32767, 32767], [32767, 32767, -32767], [-32767, 32767, -32767],
        [-32767, 32767, 32767], [32767, 32767, 32767], [32767, -32767, 32767],
        [-32767, -32767, 32767], [-32767, -32767, -32767], [32767, -32767, -32767],
    ];
    static VERTEX_NORMALS: [[i8; 3]; 24] = [
        [0, 0, 127], [0, 0, 127], [0, 0, 127], [0, 0, 127], [0, 0, -127], [0, 0, -127],
        [0, 0, -127], [0, 0, -127], [127, 0, 0], [127, 0, 0], [127, 0, 0], [127, 0, 0],
        [-127, 0, 0], [-127, 0, 0], [-127, 0, 0], [-127, 0, 0], [0, 127, 0], [0, 127, 0],
        [0, 127, 0], [0, 127, 0], [0, -127, 0], [0, -127, 0], [0, -127, 0], [0, -127, 0],
    ];
    static FACE_NORMALS: [[i8; 3]; 12] = [
        [0, 0, 127], [0, 0, 127], [0, 0, -127], [0, 0, -127], [127, 0, 0], [127, 0, 0],
        [-127, 0, 0], [-127, 0, 0], [0, 127, 0], [0, 127, 0], [0, -127, 0], [0, -127, 0],
    ];
    static TEXTURE_COORDINATES: [[i16; 2]; 24] = [
        [16384, 0], [0, 0], [0, 16384], [16384, 16384], [16384, 0], [0, 0], [0, 16384],
        [16384, 16384], [16384, 0], [0, 0], [0, 16384], [16384, 16384], [16384, 0], [0, 0],
        [0, 16384], [16384, 16384], [16384, 0], [0, 0], [0, 16384], [16384, 16384], [16384, 0],
        [0, 0], [0, 16384], [16384, 16384],
    ];
    static TRIANGLES: [[u8; 3]; 12] = [
        [0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7], [8, 9, 10], [8, 10, 11], [12, 13, 14],
        [12, 14, 15], [16, 17, 18], [16, 18, 19], [20, 21, 22], [20, 22, 23],
    ];
    static MATERIALS: [Material; 2] = [
        Material::new([174, 41, 142], 8), Material::new([26, 77, 230], 4),
    ];
    Mesh::new_const(Tables {
        positions: Positions::I16(&POSITIONS),
        scale: Scale::new(0x93CE_61C9, -47),
        offset: Vec3::from_bits([0, 0, 0]),
        vertex_normals: Normals::I8(&VERTEX_NORMALS),
        face_normals: Normals::I8(&FACE_NORMALS),
        texture_coordinates: TextureCoordinates::I16(&TEXTURE_COORDINATES),
        triangles: Triangles::U8(&TRIANGLES),
        materials: &MATERIALS,
        ..Tables::EMPTY
    })
};

/// A texture of [`TEXTURED_CUBE`]: 4x4, indexed2, rgb888, 3 mip levels, colour key.
#[rustfmt::skip]
pub type TexturedCubeTexture = ::rasterizer::texture::Mipmaps<
    ::rasterizer::texture::Keyed<::rasterizer::texture::Indexed<'static, ::rasterizer::embedded_graphics_core::pixelcolor::Rgb888, 2, 6, 4>>,
    4, 4, ::rasterizer::texture::Repeat, ::rasterizer::texture::Repeat,
>;

/// The texture of each material of [`TEXTURED_CUBE`]; `None` where it has a colour.
#[rustfmt::skip]
pub static TEXTURED_CUBE_TEXTURES: [Option<TexturedCubeTexture>; 2] = {
    use ::rasterizer::embedded_graphics_core::pixelcolor::Rgb888;
    use ::rasterizer::texture::{Indexed, Keyed};
    const fn colors<const N: usize>(numbers: [u32; N]) -> [Rgb888; N] {
        let (mut colors, mut i) = ([Rgb888::new(0, 0, 0); N], 0);
        while i < N {
            colors[i] = Rgb888::new((numbers[i] >> 16) as u8, (numbers[i] >> 8) as u8, numbers[i] as u8);
            i += 1;
        }
        colors
    }
    // 0: `flag.png`.
    static TEXELS_0: [u8; 6] = [
        173, 175, 15, 15, 59, 3,
    ];
    static PALETTE_0: [Rgb888; 4] = colors([
        0x00_0000, 0x00_0000, 0x28_3CE6, 0xD5_1F29,
    ]);
    [
        Some(TexturedCubeTexture::new(Keyed::new(Indexed::new(&TEXELS_0, &PALETTE_0), 0))),
        None,
    ]
};
