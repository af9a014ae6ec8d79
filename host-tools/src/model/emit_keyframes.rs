//! Further shapes of a model as Rust.

use std::fmt::Write as _;

use super::{
    Model, Shape,
    emit::{row, table},
};

/// The shapes as keyframes, which the mesh checks.
pub(super) fn keyframes(out: &mut String, model: &Model) -> std::fmt::Result {
    let Some(first) = model.keyframes.first() else { return Ok(()) };
    let (name, count) = (&model.name, model.keyframes.len());
    let has_normals = !(first.vertex_normals.is_empty() && first.face_normals.is_empty());
    let normals = if has_normals { "Normals, " } else { "" };
    writeln!(out)?;
    writeln!(out, "/// [`{name}`] and {count} further shapes of it.")?;
    writeln!(
        out,
        "#[allow(clippy::needless_update, reason = \"a later version has more columns\")]"
    )?;
    writeln!(out, "#[rustfmt::skip]")?;
    writeln!(out, "pub static {name}_KEYFRAMES: ::rasterizer::mesh::Keyframes<'static> = {{")?;
    writeln!(out, "    use ::rasterizer::mesh::{{Keyframe, Keyframes, {normals}Positions}};")?;
    for (number, shape) in (1..).zip(&model.keyframes) {
        let Shape { positions, vertex_normals, face_normals, .. } = shape;
        table(out, &format!("POSITIONS_{number}"), "[i16; 3]", positions.iter().map(row))?;
        table(out, &format!("VERTEX_NORMALS_{number}"), "[i8; 3]", vertex_normals.iter().map(row))?;
        table(out, &format!("FACE_NORMALS_{number}"), "[i8; 3]", face_normals.iter().map(row))?;
    }
    writeln!(out, "    static FURTHER: [Keyframe<'static>; {count}] = [")?;
    for (number, shape) in (1..).zip(&model.keyframes) {
        writeln!(out, "        Keyframe {{")?;
        writeln!(out, "            positions: Positions::I16(&POSITIONS_{number}),")?;
        if !shape.vertex_normals.is_empty() {
            writeln!(out, "            vertex_normals: Normals::I8(&VERTEX_NORMALS_{number}),")?;
        }
        if !shape.face_normals.is_empty() {
            writeln!(out, "            face_normals: Normals::I8(&FACE_NORMALS_{number}),")?;
        }
        writeln!(out, "            ..Keyframe::EMPTY")?;
        writeln!(out, "        }},")?;
    }
    writeln!(out, "    ];")?;
    writeln!(out, "    Keyframes::new_const(&{name}, &FURTHER)")?;
    writeln!(out, "}};")
}
