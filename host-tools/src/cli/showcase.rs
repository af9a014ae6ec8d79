//! Without a command: converts, renders and checks one model.

use std::{
    fs,
    path::{Path, PathBuf},
};

use anyhow::{Result, anyhow, bail};
use host_tools::{
    check::{Bounds, View},
    model::{Options, thousands},
};

use super::{
    Done,
    check::{Pictures, worst_frame, write_pictures},
    convert, image, output, png, render, table,
    view::Settings,
};

/// The directory of all results.
const DIRECTORY: &str = "target";

/// The number of sides that the check draws the model from.
const FRAMES: u32 = 12;

pub(super) fn run(model: Option<&Path>) -> Result<Done> {
    let path = model.map_or_else(shipped_model, |path| Ok(path.into()))?;
    let model = convert::load(&path, &Options::default())?;
    let view = View::default();
    let picture = image::of_fixed(&render::draw(&path, &model, &view)?, image::BACKGROUND);
    let worst = worst_frame(&path, &model, &view, FRAMES)?;

    fs::create_dir_all(DIRECTORY).map_err(|error| {
        anyhow!("{DIRECTORY}: {error}: the results go there, so run this in another directory")
    })?;
    let file = |ending| Path::new(DIRECTORY).join(output::named_after(&path, ending));
    let tables = file(".rs");
    let rendered = file(".png");
    let pictures = Pictures {
        fixed: file("-fixed.png"),
        reference: file("-reference.png"),
        difference: file("-difference.png"),
    };
    for picture in [&rendered, &pictures.fixed, &pictures.reference, &pictures.difference] {
        output::allow_png(picture)?;
    }
    convert::write(&model, &tables, false)?;
    output::write_png(&rendered, &png::still(&picture)?)?;
    let legend = write_pictures(&worst.checked, &pictures)?;

    let report = model.report;
    let outcome = worst.checked.outcome;
    let bounds = Bounds::ARITHMETIC;
    let name = &model.name;
    let lower = name.to_lowercase();
    let text = format!(
        "\
{model}: {vertices} vertices, {triangles} triangles

Tables      {tables}: {flash} bytes of flash, static {name}
Picture     {rendered}: {settings}

Checked from {FRAMES} sides; the worst is the one at {turn} degrees:
Fixed point {fixed}
Reference   {reference}: f64, from the numbers in the OBJ file
Difference  {difference}
{legend}
{comparisons}
{meaning}

Next: look at {rendered}. To put the model on a display, copy {tables} into your
firmware's src as {lower}.rs, add `mod {lower};` and draw `{lower}::{name}`, as the README shows.
More: host-tools --help
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
    Ok(Done { text, is_within_bounds: outcome.is_within(&bounds) })
}

/// The bundled rocket, in the directory of the program's sources.
fn shipped_model() -> Result<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/rocket.obj");
    if !path.is_file() {
        bail!("{} is missing: name a model, as in `host-tools model.obj`", path.display());
    }
    Ok(path)
}
