//! The edges, lines and points of a model as Rust.

use std::fmt::Write as _;

use super::{
    Indices, Model,
    emit::{row, table},
    report::thousands,
};

/// The edges as lines, which the mesh checks.
pub(super) fn edges(out: &mut String, model: &Model) -> std::fmt::Result {
    if model.edges.is_empty() {
        return Ok(());
    }
    let (name, count) = (&model.name, model.edges.len());
    let format = format_name(model);
    writeln!(out)?;
    writeln!(out, "/// {} edges of [`{name}`].", thousands(count))?;
    writeln!(out, "#[rustfmt::skip]")?;
    writeln!(out, "pub static {name}_EDGES: ::rasterizer::mesh::Lines<'static> = {{")?;
    writeln!(out, "    use ::rasterizer::mesh::{{Lines, Segments}};")?;
    segments(out, model, "EDGES", &model.edges)?;
    writeln!(out, "    Lines::new_const(&{name}, Segments::{format}(&EDGES))")?;
    writeln!(out, "}};")
}

/// The lines of each material.
pub(super) fn lines(out: &mut String, model: &Model) -> std::fmt::Result {
    let names =
        Names { count: model.report.lines, plural: "lines", table: "Lines", column: "Segments" };
    by_material(out, model, names, &model.lines, segments)
}

/// The points of each material.
pub(super) fn points(out: &mut String, model: &Model) -> std::fmt::Result {
    let names = Names {
        count: model.report.points,
        plural: "points",
        table: "Points",
        column: "PointIndices",
    };
    by_material(out, model, names, &model.points, |out, model, name, points| {
        let index = format_name(model).to_lowercase();
        table(out, name, &index, points.iter().map(u32::to_string))
    })
}

/// How the elements of a kind and their types are named.
struct Names {
    count: usize,
    plural: &'static str,
    table: &'static str,
    column: &'static str,
}

/// An array with a table for each material, empty ones too. `write` writes the static of one.
fn by_material<T>(
    out: &mut String,
    model: &Model,
    names: Names,
    elements: &[Vec<T>],
    write: impl Fn(&mut String, &Model, &str, &[T]) -> std::fmt::Result,
) -> std::fmt::Result {
    if elements.is_empty() {
        return Ok(());
    }
    let Names { count, plural, table, column } = names;
    let (name, format, capitals) = (&model.name, format_name(model), plural.to_uppercase());
    writeln!(out)?;
    writeln!(out, "/// {} {plural} of [`{name}`]: a table for each material.", thousands(count))?;
    writeln!(out, "#[rustfmt::skip]")?;
    let length = elements.len();
    writeln!(
        out,
        "pub static {name}_{capitals}: [::rasterizer::mesh::{table}<'static>; {length}] = {{"
    )?;
    writeln!(out, "    use ::rasterizer::mesh::{{{table}, {column}}};")?;
    let static_name = |material: usize| format!("{capitals}_{material}");
    for (material, elements) in elements.iter().enumerate() {
        write(out, model, &static_name(material), elements)?;
    }
    writeln!(out, "    [")?;
    for (material, elements) in elements.iter().enumerate() {
        let slice = if elements.is_empty() { "[]".to_owned() } else { static_name(material) };
        writeln!(out, "        {table}::new_const(&{name}, {column}::{format}(&{slice})),")?;
    }
    writeln!(out, "    ]")?;
    writeln!(out, "}};")
}

/// The static of pairs of vertices.
fn segments(out: &mut String, model: &Model, name: &str, pairs: &[[u32; 2]]) -> std::fmt::Result {
    let entry = format!("[{}; 2]", format_name(model).to_lowercase());
    table(out, name, &entry, pairs.iter().map(|pair| row(&pair.map(|i| i as i32))))
}

/// The variant of tables of indices.
const fn format_name(model: &Model) -> &'static str {
    match model.triangles {
        Indices::U8(_) => "U8",
        Indices::U16(_) => "U16",
    }
}
