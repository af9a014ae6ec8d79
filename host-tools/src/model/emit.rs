//! The tables as a Rust source file.
//!
//! The file has plain comments only, so that it can be a module or be included by `include!`. All
//! tables are statics inside the initialiser of the one public static, where their names cannot
//! collide with others. `#[rustfmt::skip]` on it keeps a formatter from putting each number on a
//! separate line. A model with textures has a second public static and their type.

use std::fmt::{Display, Write as _};

use rasterizer::mesh::{Finish, Material};

use super::{
    Indices, Model, TextureTable, emit_keyframes, emit_lines, emit_textures,
    report::{grouped, thousands},
};

/// The longest line of a table.
const WIDTH: usize = 100;

#[cfg(feature = "plan")]
pub(crate) use emit_textures::texture_type;

/// The source file of a model. Equal models give equal text.
#[must_use]
pub fn source(model: &Model) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = header(&mut out, model)
        .and_then(|()| mesh(&mut out, model))
        .and_then(|()| emit_keyframes::keyframes(&mut out, model))
        .and_then(|()| emit_lines::edges(&mut out, model))
        .and_then(|()| emit_lines::lines(&mut out, model))
        .and_then(|()| emit_lines::points(&mut out, model))
        .and_then(|()| emit_textures::textures(&mut out, model));
    out
}

fn header(out: &mut String, model: &Model) -> std::fmt::Result {
    let version = env!("CARGO_PKG_VERSION");
    writeln!(out, "// A model as const tables, written by host-tools {version}: do not edit.")?;
    writeln!(out, "//")?;
    for file in &model.provenance {
        let (name, bytes) = (in_comment(&file.file_name), thousands(file.bytes));
        writeln!(out, "// From {name}: {bytes} bytes, FNV-1a {:016x}", file.hash)?;
    }
    writeln!(out, "// With {}", options(model))?;
    writeln!(out, "//")?;
    let textures = model.textures.as_ref().map(ToString::to_string).unwrap_or_default();
    for line in model.report.to_string().lines().chain(textures.lines()) {
        writeln!(out, "// {line}")?;
    }
    writeln!(out, "//")?;
    writeln!(out, "// To leave out a table that no shader uses, convert again with fewer contents.")
}

fn options(model: &Model) -> String {
    let options = &model.options;
    let contents = options.contents;
    let tables: Vec<&str> = [
        (contents.vertex_normals, "vertex normals"),
        (contents.face_normals, "face normals"),
        (contents.texture_coordinates, "texture coordinates"),
        (!model.vertex_colors.is_empty(), "vertex colours"),
    ]
    .into_iter()
    .filter_map(|(kept, name)| kept.then_some(name))
    .collect();
    let tables = if tables.is_empty() { "none".to_owned() } else { tables.join(", ") };
    let winding = if options.fix_winding { "winding mended, " } else { "" };
    let most = (options.simplify)
        .map_or_else(String::new, |most| format!("at most {} triangles, ", thousands(most)));
    let fit = options.fit;
    let groups = if model.report.smoothing_groups { "smoothing groups, " } else { "" };
    let crease = options.crease_degrees;
    format!("{fit}, {groups}a crease angle of {crease} degrees, {winding}{most}contents: {tables}")
}

fn mesh(out: &mut String, model: &Model) -> std::fmt::Result {
    let (name, file) = (&model.name, in_comment(&model.provenance[0].file_name));
    let (vertices, triangles) =
        (thousands(model.positions.len()), thousands(model.report.triangles));
    writeln!(out)?;
    writeln!(out, "/// {file}: {vertices} vertices, {triangles} triangles.")?;
    // A file may name all the tables that this version has, and others come with the next one.
    writeln!(
        out,
        "#[allow(clippy::needless_update, reason = \"a later version has more tables\")]"
    )?;
    writeln!(out, "#[rustfmt::skip]")?;
    writeln!(out, "pub static {name}: ::rasterizer::mesh::Mesh<'static> = {{")?;
    writeln!(out, "    use ::rasterizer::{{")?;
    let has_triangles = !model.triangles.as_triangles().is_empty();
    let is_textured = !model.texture_coordinates.as_column().is_empty();
    let columns: String = [
        (!model.finishes.is_empty(), "Finish, "),
        (true, "Material, Mesh"),
        (!(model.vertex_normals.is_empty() && model.face_normals.is_empty()), ", Normals"),
        (true, ", Positions, Tables"),
        (is_textured, ", TextureCoordinates"),
        (has_triangles, ", Triangles"),
    ]
    .into_iter()
    .filter_map(|(used, names)| used.then_some(names))
    .collect();
    writeln!(out, "        mesh::{{{columns}}},")?;
    writeln!(out, "        numbers::{{Scale, Vec3}},")?;
    writeln!(out, "    }};")?;
    table(out, "POSITIONS", "[i16; 3]", model.positions.iter().map(row))?;
    table(out, "VERTEX_NORMALS", "[i8; 3]", model.vertex_normals.iter().map(row))?;
    table(out, "FACE_NORMALS", "[i8; 3]", model.face_normals.iter().map(row))?;
    let coordinates = match &model.texture_coordinates {
        TextureTable::I16(coordinates) => {
            table(out, "TEXTURE_COORDINATES", "[i16; 2]", coordinates.iter().map(row))?;
            "I16"
        }
        TextureTable::I32(coordinates) => {
            table(out, "TEXTURE_COORDINATES", "[i32; 2]", coordinates.iter().map(row))?;
            "I32"
        }
    };
    table(out, "VERTEX_COLORS", "[u8; 3]", model.vertex_colors.iter().map(row))?;
    let index = match &model.triangles {
        Indices::U8(triangles) => {
            table(out, "TRIANGLES", "[u8; 3]", triangles.iter().map(row))?;
            "U8"
        }
        Indices::U16(triangles) => {
            table(out, "TRIANGLES", "[u16; 3]", triangles.iter().map(row))?;
            "U16"
        }
    };
    table(out, "MATERIALS", "Material", model.materials.iter().map(material))?;
    table(out, "FINISHES", "Finish", model.finishes.iter().map(finish))?;
    let (mantissa, exponent) = (model.scale.mantissa(), model.scale.exponent());
    writeln!(out, "    Mesh::new_const(Tables {{")?;
    writeln!(out, "        positions: Positions::I16(&POSITIONS),")?;
    writeln!(
        out,
        "        scale: Scale::new(0x{:04X}_{:04X}, {exponent}),",
        mantissa >> 16,
        mantissa & 0xFFFF
    )?;
    writeln!(out, "        offset: Vec3::from_bits({}),", row(&model.offset.to_bits()))?;
    if !model.vertex_normals.is_empty() {
        writeln!(out, "        vertex_normals: Normals::I8(&VERTEX_NORMALS),")?;
    }
    if !model.face_normals.is_empty() {
        writeln!(out, "        face_normals: Normals::I8(&FACE_NORMALS),")?;
    }
    if is_textured {
        let column = format!("TextureCoordinates::{coordinates}(&TEXTURE_COORDINATES)");
        writeln!(out, "        texture_coordinates: {column},")?;
    }
    if !model.vertex_colors.is_empty() {
        writeln!(out, "        vertex_colors: &VERTEX_COLORS,")?;
    }
    if has_triangles {
        writeln!(out, "        triangles: Triangles::{index}(&TRIANGLES),")?;
    }
    writeln!(out, "        materials: &MATERIALS,")?;
    if !model.finishes.is_empty() {
        writeln!(out, "        finishes: &FINISHES,")?;
    }
    writeln!(out, "        ..Tables::EMPTY")?;
    writeln!(out, "    }})")?;
    writeln!(out, "}};")
}

/// One table, as many entries to a line as fit; an empty one is not written.
pub(super) fn table(
    out: &mut String,
    name: &str,
    entry_type: &str,
    entries: impl ExactSizeIterator<Item = String>,
) -> std::fmt::Result {
    if entries.len() == 0 {
        return Ok(());
    }
    writeln!(out, "    static {name}: [{entry_type}; {}] = [", entries.len())?;
    rows(out, entries)?;
    writeln!(out, "    ];")
}

/// The lines of a table.
pub(super) fn rows(out: &mut String, entries: impl Iterator<Item = String>) -> std::fmt::Result {
    let mut column = 0;
    for entry in entries {
        if column == 0 || column + entry.len() + 2 > WIDTH {
            write!(out, "{}       ", if column == 0 { "" } else { "\n" })?;
            column = 7;
        }
        write!(out, " {entry},")?;
        column += entry.len() + 2;
    }
    writeln!(out)
}

pub(super) fn row<T: Display + Copy + Into<i32>, const N: usize>(numbers: &[T; N]) -> String {
    let mut text = "[".to_owned();
    for (place, &n) in numbers.iter().enumerate() {
        text += if place > 0 { ", " } else { "" };
        push_number(&mut text, n.into());
    }
    text + "]"
}

/// Numbers of more than five digits are grouped, as `clippy::unreadable_literal` wants them.
fn push_number(text: &mut String, number: i32) {
    let magnitude = number.unsigned_abs() as usize;
    if magnitude < 100_000 {
        // Writing to a string cannot fail.
        let _ = write!(text, "{number}");
    } else {
        *text += if number < 0 { "-" } else { "" };
        *text += &grouped(magnitude, '_');
    }
}

fn material(material: &Material) -> String {
    format!(
        "Material::new({}, {})",
        row(&material.color),
        grouped(material.triangle_count as usize, '_')
    )
}

/// The calls that make it of a matte one.
fn finish(finish: &Finish) -> String {
    let mut text = "Finish::MATTE".to_owned();
    let matte = Finish::MATTE;
    // Writing to a string cannot fail.
    if finish.specular != matte.specular {
        let _ = write!(text, ".with_specular({}, {})", row(&finish.specular), finish.exponent);
    }
    if finish.emission != matte.emission {
        let _ = write!(text, ".with_emission({})", row(&finish.emission));
    }
    if finish.opacity != matte.opacity {
        let _ = write!(text, ".with_opacity({})", finish.opacity);
    }
    text
}

/// A file name that can neither end a comment nor its code span.
pub(super) fn in_comment(name: &str) -> String {
    format!("`{}`", name.escape_debug().to_string().replace('`', "'"))
}

/// The name of the static for a file stem or for the name asked for: words in capitals, joined by
/// underscores. A word also starts where a capital follows a small letter. Capitals are no
/// keywords, so any name in them can be used.
pub(super) fn static_name(name: &str) -> String {
    let mut result = String::new();
    let mut before = ' ';
    for c in name.chars() {
        let starts_word = before.is_lowercase() && c.is_uppercase();
        if (starts_word || !c.is_ascii_alphanumeric())
            && !result.is_empty()
            && !result.ends_with('_')
        {
            result.push('_');
        }
        if c.is_ascii_alphanumeric() {
            result.push(c.to_ascii_uppercase());
        }
        before = c;
    }
    let result = result.trim_end_matches('_');
    match result.chars().next() {
        None => "MODEL".to_owned(),
        Some('0'..='9') => format!("MODEL_{result}"),
        Some(_) => result.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_stem_becomes_an_identifier() {
        for (stem, name) in [
            ("gear", "GEAR"),
            ("torus_knot", "TORUS_KNOT"),
            ("TorusKnot-v2 (final).1", "TORUS_KNOT_V2_FINAL_1"),
            ("2cv", "MODEL_2CV"),
            ("Würfel", "W_RFEL"),
            ("模型", "MODEL"),
            ("", "MODEL"),
            ("__", "MODEL"),
            ("static", "STATIC"),
            ("SPOT", "SPOT"),
        ] {
            assert_eq!(static_name(stem), name);
        }
    }

    #[test]
    fn long_numbers_are_grouped() {
        assert_eq!(row(&[-32_767_i16, 0, 99]), "[-32767, 0, 99]");
        assert_eq!(row(&[-1_234_567, 99_999, 100_000]), "[-1_234_567, 99999, 100_000]");
    }

    #[test]
    fn file_names_stay_in_their_comment() {
        assert_eq!(in_comment("a\nb`c.obj"), "`a\\nb'c.obj`");
    }
}
