//! A model as bytes, in the format of [`rasterizer::mesh::blob`].

use rasterizer::mesh::Finish;

use super::{Indices, Model, TextureTable};

/// The multiple that each table begins at.
const ALIGNMENT: usize = 4;
/// Where the length of the file is.
const LENGTH: std::ops::Range<usize> = 8..12;

/// The bytes of a model's mesh. Its textures, edges, lines, points and keyframes are not in them.
///
/// # Panics
///
/// Panics if it has 4 GiB of tables.
#[must_use]
pub fn bytes(model: &Model) -> Vec<u8> {
    let mut out = Vec::from(*b"RMSH");
    out.extend(1_u16.to_le_bytes());
    out.extend(0x1234_u16.to_le_bytes());
    let is_wide = matches!(model.triangles, Indices::U16(_));
    let [narrow_texture, wide_texture] = match &model.texture_coordinates {
        TextureTable::I16(table) => [!table.is_empty(), false],
        TextureTable::I32(table) => [false, !table.is_empty()],
    };
    let columns = [
        !model.vertex_normals.is_empty(),
        !model.face_normals.is_empty(),
        narrow_texture,
        wide_texture,
        !model.vertex_colors.is_empty(),
        is_wide,
        !model.finishes.is_empty(),
    ];
    let columns =
        (0..).zip(columns).fold(0, |bits, (bit, is_there)| bits | u32::from(is_there) << bit);
    let counts = [model.positions.len(), model.report.triangles, model.materials.len()];
    let count = |n: usize| u32::try_from(n).expect("a model has fewer than 2^32 of anything");
    let numbers = [0].into_iter().chain(counts.map(count)).chain([columns, model.scale.mantissa()]);
    numbers.for_each(|number: u32| out.extend(number.to_le_bytes()));
    let [x, y, z] = model.offset.to_bits();
    [model.scale.exponent(), x, y, z].iter().for_each(|n| out.extend(n.to_le_bytes()));

    column(&mut out, model.positions.as_flattened(), |n| n.to_le_bytes());
    column(&mut out, model.vertex_normals.as_flattened(), |n| n.to_le_bytes());
    column(&mut out, model.face_normals.as_flattened(), |n| n.to_le_bytes());
    match &model.texture_coordinates {
        TextureTable::I16(table) => column(&mut out, table.as_flattened(), |n| n.to_le_bytes()),
        TextureTable::I32(table) => column(&mut out, table.as_flattened(), |n| n.to_le_bytes()),
    }
    column(&mut out, model.vertex_colors.as_flattened(), |n| n.to_le_bytes());
    match &model.triangles {
        Indices::U8(table) => column(&mut out, table.as_flattened(), |n| n.to_le_bytes()),
        Indices::U16(table) => column(&mut out, table.as_flattened(), |n| n.to_le_bytes()),
    }
    column(&mut out, &model.materials, |material| {
        let [red, green, blue] = material.color;
        let [a, b, c, d] = material.triangle_count.to_le_bytes();
        [red, green, blue, 0, a, b, c, d]
    });
    column(&mut out, &model.finishes, finish);
    let length = count(out.len()).to_le_bytes();
    out[LENGTH].copy_from_slice(&length);
    out
}

const fn finish(finish: &Finish) -> [u8; 10] {
    let ([a, b, c], [d, e, f]) = (finish.specular, finish.emission);
    let [low, high] = finish.exponent.to_le_bytes();
    [a, b, c, 0, low, high, d, e, f, finish.opacity]
}

/// A table, and what follows it.
fn column<T, const N: usize>(out: &mut Vec<u8>, table: &[T], bytes: impl Fn(&T) -> [u8; N]) {
    table.iter().for_each(|entry| out.extend(bytes(entry)));
    out.resize(out.len().next_multiple_of(ALIGNMENT), 0);
}
