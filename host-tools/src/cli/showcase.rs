//! Without a command: converts, renders and checks a model, or two that are shipped.

use std::{
    fs,
    path::{Path, PathBuf},
};

use anyhow::{Result, anyhow, bail};
use host_tools::{
    check::{BACKGROUND, Bounds, Shading, View},
    model::{Options, thousands},
};

use super::{
    Done,
    check::{Pictures, refuse_without_faces, worst_frame, write_pictures},
    convert, image,
    output::{self, Overwriting},
    png, render, table,
    view::Settings,
};

/// The directory of all results.
const DIRECTORY: &str = "target";

/// The number of sides that the check draws the model from.
const FRAMES: u32 = 12;

pub(super) fn run(model: Option<&Path>, force: bool) -> Result<Done> {
    let paths = model.map_or_else(shipped_models, |path| Ok(vec![path.into()]))?;
    let shown: Vec<Shown> = paths.iter().map(|path| show(path, force)).collect::<Result<_>>()?;
    let reports: Vec<&str> = shown.iter().map(|model| &*model.report).collect();
    // One model is an example of what to do with any.
    let next = shown.first().map_or("", |model| &model.next);
    let output = format!("{}\n{next}More: host-tools --help\n", reports.join("\n"));
    let is_within_bounds = shown.iter().all(|model| model.is_within_bounds);
    Ok(Done { output: output.into(), is_within_bounds })
}

/// What is told of a model.
struct Shown {
    report: String,
    /// What to do with it.
    next: String,
    is_within_bounds: bool,
}

fn show(path: &Path, force: bool) -> Result<Shown> {
    let model = convert::load(path, &Options::default())?;
    refuse_without_faces(path, &model)?;
    let view = View { shading: Shading::of(&model), ..View::default() };
    let picture = image::of_fixed(&render::draw(path, &model, &view)?, BACKGROUND);
    let worst = worst_frame(path, &model, &view, FRAMES)?;

    fs::create_dir_all(DIRECTORY).map_err(|error| {
        anyhow!("{DIRECTORY}: {error}: the results go there, so run this in another directory")
    })?;
    let file = |ending| Path::new(DIRECTORY).join(output::named_after(path, ending));
    let tables = file(".rs");
    let rendered = file(".png");
    let pictures = Pictures {
        fixed: file("-fixed.png"),
        reference: file("-reference.png"),
        difference: file("-difference.png"),
        display: None,
    };
    let inputs = output::inputs(&model);
    let overwriting = Overwriting { force, inputs: &inputs };
    output::allow(&rendered, output::PNG, overwriting)?;
    pictures.allow(overwriting)?;
    convert::allow(&tables, overwriting)?;
    convert::write(&model, &tables)?;
    output::write(&rendered, &png::still(&picture)?)?;
    let legend = write_pictures(&worst.checked, &pictures, view.display)?;

    let report = &model.report;
    let outcome = worst.checked.outcome;
    let bounds = Bounds::ARITHMETIC;
    let name = &model.name;
    let module = module_name(name);
    let statics = convert::statics(&model);
    let with_textures = if model.textures.is_some() {
        format!(" with `{module}::{name}_TEXTURES`")
    } else {
        String::new()
    };
    let text = format!(
        "\
{model}: {vertices} vertices, {triangles} triangles

Tables      {tables}: {flash} bytes of flash, {statics}
Picture     {rendered}: {settings}

Checked from {FRAMES} sides; the worst is the one at {turn} degrees:
Fixed point {fixed}
Reference   {reference}: f64, from the numbers in the OBJ file
Difference  {difference}
{legend}
{comparisons}
{meaning}
",
        model = path.display(),
        vertices = thousands(report.vertices),
        triangles = thousands(report.triangles),
        tables = tables.display(),
        flash = thousands(report.flash.total()),
        rendered = rendered.display(),
        settings = Settings::of(&model, &view).summary(),
        turn = 360 * worst.frame / FRAMES,
        fixed = pictures.fixed.display(),
        reference = pictures.reference.display(),
        difference = pictures.difference.display(),
        legend = table::legend(&legend),
        comparisons = table::comparisons(&outcome, &bounds),
        meaning = table::meaning(&model, &outcome, &bounds),
    );
    let next = format!(
        "\
Next: look at {rendered}. To put the model on a display, copy {tables} into your
firmware's src as {module}.rs, add `mod {module};` and draw `{module}::{name}`{with_textures},
as the README shows.
",
        rendered = rendered.display(),
        tables = tables.display(),
    );
    Ok(Shown { report: text, next, is_within_bounds: outcome.is_within(&bounds) })
}

/// The bundled models that are shown, in the directory of the program's sources: one with a
/// texture and one without.
fn shipped_models() -> Result<Vec<PathBuf>> {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let found = ["wooden_crate.obj", "rocket.obj"].map(|name| models.join(name));
    if let Some(path) = found.iter().find(|path| !path.is_file()) {
        bail!("{} is missing: name a model, as in `host-tools model.obj`", path.display());
    }
    Ok(found.into())
}

/// A module for the static of this name: in small letters, with `_model` behind names that the
/// firmware has already, or that the compiler or Cargo take for something else.
fn module_name(name: &str) -> String {
    #[rustfmt::skip]
    const TAKEN: &[&str] = &[
        // Keywords, of all editions and reserved ones.
        "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
        "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
        "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub",
        "ref", "return", "self", "static", "struct", "super", "trait", "true", "try", "type",
        "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
        // Files with a meaning.
        "bin", "build", "lib", "main", "tests",
        // Types, which a module would hide.
        "bool", "char", "f16", "f32", "f64", "f128", "i8", "i16", "i32", "i64", "i128", "isize",
        "str", "u8", "u16", "u32", "u64", "u128", "usize",
        // Crates, which a module would hide.
        "alloc", "bytemuck", "core", "defmt", "embedded_graphics", "embedded_graphics_core",
        "fixed", "micromath", "proc_macro", "rasterizer", "std", "test",
    ];
    let module = name.to_lowercase();
    if TAKEN.contains(&&*module) { module + "_model" } else { module }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modules_hide_nothing_and_are_no_keywords() {
        for (name, module) in [
            ("SPOT", "spot"),
            ("MODEL_2CV", "model_2cv"),
            ("TYPE", "type_model"),
            ("MAIN", "main_model"),
            ("SELF", "self_model"),
            ("CORE", "core_model"),
            ("RASTERIZER", "rasterizer_model"),
            ("U8", "u8_model"),
        ] {
            assert_eq!(module_name(name), module);
        }
    }
}
