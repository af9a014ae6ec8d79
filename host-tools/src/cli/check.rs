//! The command `check`: the fixed-point picture against the f64 reference.

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, anyhow, bail};
use clap::Args;
use host_tools::{
    check::{
        BACKGROUND, Bounds, Checked, Checker, Display, Edges, LineOptions, LineOutcome, Matrix,
        Outcome, Shading, View, judge_lines,
    },
    model::{Model, Options},
};
use serde::Serialize;

use super::{
    Done, convert,
    image::{self, Legend},
    output::{self, Overwriting},
    png,
    progress::Progress,
    render, table,
    view::{Settings, ViewOptions, within},
};

const EXAMPLES: &str = "\
Examples:
  host-tools check model.obj
  host-tools check model.obj --frames 60 --depth u32
  host-tools check model.obj --eye 2,1.5,2 --target 0,0.2,0
  host-tools check model.obj --simplify 500          The tables of `convert --simplify`
  host-tools check model.obj --json | jq .arithmetic
  host-tools check model.obj --filter trilinear --perspective every-16
  host-tools check model.obj --shading flat --colors binary --dither 8
  host-tools check model.obj --shading phong --light 1,2,2,0.5 --lamp 0,0.5,1.5,1
  host-tools check model.obj --blend over --opacity 0.5 --fade y
  host-tools check model.obj --edges 30
  host-tools check model.obj --clip 0,0,-1,0.25 --clip-in world
  host-tools check model.obj --matrix=1,0.5,0,0,1,0,0,0,-2
  host-tools check up.obj down.obj --between 0..1 --frames 12

What is judged:
  Arithmetic    The picture against exact arithmetic on the core's own vertices, and each vertex
                against its exact place: 1/2 sub-pixel of snapping, 1/8 of arithmetic. Of a texture,
                each coordinate against the exact one, in texels: within 1/16 texel or 1/256 pixel,
                and what the steps of --perspective add. Close to the border of a texel, either
                texel is right; elsewhere one is. With light at pixels, each normal against the
                exact one: within half a degree; and the colour against that of the pixel's normal,
                where a highlight may be off by what a cosine of 15 bits leaves of its power,
                (1 + Ns / 32) / 256 of the light.
                With --blend, the layers of each pixel from back to front: their alphas, which are
                the product of those of the vertices (--fade), the texel, the material and
                --opacity, within 1/2 unit of 1/256 for each that is rounded and for each product;
                and their blended colour against f64: 1/2 step of rounding for each layer, times
                what later ones let pass.
                With --stretch or --matrix, each normal that the core makes of one of the tables
                against the inverse transpose times it: within half a degree. With --between,
                against the blend of both shapes' normals: within 0.4 degrees. A position is that
                blend too, rounded to a quantum; end to end a vertex may be off by one quantum.
  End to end    Against the faces of the file, which the reference cuts into triangles by itself.
                Each vertex may be off by half a quantum more. Each pixel that lies farther than
                that from every edge must be covered, or free, and show the right face; so must be
                covered those where faces meet. With --clip, a pixel is also not judged where a face
                lies so close to a plane that quanta may bring it onto the other side.
  Lines         The lines (l) and points (p) of the file, and with --edges the edges of its faces,
                all of them and those that are not hidden: each pixel by the diamond-exit rule and
                the square of a point, on the ends that the core has after clipping; depth within a
                unit of 32 bits and colour within a step. They are not in the pictures.
  Display       With --colors: each pixel has the step that the definition of dithering gives the
                core's colour, and one that it gives the exact colour, give or take a step of 8
                bits. The mean of each 8x8 square of one colour is within 1/64 of white of it with
                --dither 8, within 1/32 with 4: of its light with one and two bits, else of its
                stored values.

Exit status: 0 if all bounds are kept, also if the view shows nothing; 1 if not; 2 for bad usage or
bad input.";

/// Compare the fixed-point picture of a model with an f64 reference
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The OBJ file; - for the standard input, whose libraries lie in this directory
    model: PathBuf,
    /// The same model in another shape, for --between: an OBJ file that differs in positions and
    /// normals alone
    #[arg(value_name = "SHAPE", requires = "between")]
    shape: Option<PathBuf>,
    /// Directory for fixed.png, reference.png, difference.png and, with --colors, display.png
    /// [default: target/check/NAME, or NAME-check without a directory target]
    #[arg(long, value_name = "DIR")]
    pictures: Option<PathBuf>,
    /// Overwrite pictures that are not from this program
    #[arg(long)]
    force: bool,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
    /// Judge the edges too in which faces meet at this angle or more, and borders: all of them, and
    /// those that the model does not hide
    #[arg(
        long,
        value_name = "DEGREES",
        value_parser = within(0.0, 180.0),
        allow_negative_numbers = true
    )]
    edges: Option<f64>,
    #[command(flatten)]
    view: ViewOptions,
}

/// Where the three pictures go.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Pictures {
    #[serde(serialize_with = "lossy")]
    pub(super) fixed: PathBuf,
    #[serde(serialize_with = "lossy")]
    pub(super) reference: PathBuf,
    #[serde(serialize_with = "lossy")]
    pub(super) difference: PathBuf,
    /// What a display shows, beside its nearest colours.
    #[serde(serialize_with = "lossy_or_none", skip_serializing_if = "Option::is_none")]
    pub(super) display: Option<PathBuf>,
}

impl Pictures {
    /// Refuses pictures that must not be overwritten.
    pub(super) fn allow(&self, overwriting: Overwriting<'_>) -> Result<()> {
        [&self.fixed, &self.reference, &self.difference]
            .into_iter()
            .chain(&self.display)
            .try_for_each(|path| output::allow(path, output::PNG, overwriting))
    }
}

/// Writes a path with replacement characters for what is not UTF-8, so that the result stays
/// readable.
fn lossy<S: serde::Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path.to_string_lossy())
}

fn lossy_or_none<S: serde::Serializer>(
    path: &Option<PathBuf>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    lossy(path.as_deref().unwrap_or(Path::new("")), serializer)
}

/// The worst frame of a turntable.
#[derive(Debug)]
pub(super) struct Worst {
    pub(super) frame: u32,
    pub(super) checked: Checked,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Json {
    model: String,
    vertices: usize,
    triangles: usize,
    settings: Settings,
    frames: u32,
    frame: u32,
    #[serde(flatten)]
    outcome: Option<Outcome>,
    #[serde(flatten)]
    lines: Option<LineOutcome>,
    bounds: Bounds,
    within_bounds: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pictures: Option<Pictures>,
}

pub(super) fn run(arguments: &Arguments) -> Result<Done> {
    let (path, frames) = (&arguments.model, arguments.view.frames.unwrap_or(1));
    arguments.view.check(1 + usize::from(arguments.shape.is_some()), frames)?;
    if let Some(directory) = &arguments.pictures {
        allow_directory(directory)?;
    }
    let conversion = Options { edges_degrees: arguments.edges, ..arguments.view.conversion() };
    let model = match &arguments.shape {
        None => convert::load(path, &conversion)?,
        Some(shape) => convert::load_shapes(path, std::slice::from_ref(shape), &conversion)?,
    };
    let view = arguments.view.view(Shading::of(&model));
    let lines = judged_lines(path, &model, &view, arguments)?;
    if model.report.triangles == 0 {
        return without_faces(arguments, &model, &view, lines);
    }
    let worst = worst_frame(path, &model, &view, frames)?;
    if !worst.checked.outcome.shows_something() {
        output::complain("warning", &render::nothing_seen(path));
    }
    let directory = (arguments.pictures.clone()).unwrap_or_else(|| default_directory(path));
    fs::create_dir_all(&directory).map_err(|error| {
        anyhow!("{}: {error}: name another directory for the pictures", directory.display())
    })?;
    let pictures = Pictures {
        fixed: directory.join("fixed.png"),
        reference: directory.join("reference.png"),
        difference: directory.join("difference.png"),
        display: view.display.map(|_| directory.join("display.png")),
    };
    let inputs = output::inputs(&model);
    pictures.allow(Overwriting { force: arguments.force, inputs: &inputs })?;
    let legend = write_pictures(&worst.checked, &pictures, view.display)?;

    let outcome = worst.checked.outcome;
    let is_within_bounds =
        outcome.is_within(&Bounds::ARITHMETIC) && lines.is_none_or(|lines| lines.is_within());
    let settings = Settings::of(&model, &view);
    let text = if arguments.json {
        let object = Json {
            model: path.to_string_lossy().into_owned(),
            vertices: model.report.vertices,
            triangles: model.report.triangles,
            settings,
            frames,
            frame: worst.frame,
            outcome: Some(outcome),
            lines,
            bounds: Bounds::ARITHMETIC,
            within_bounds: is_within_bounds,
            pictures: Some(pictures),
        };
        output::json(&object)?
    } else {
        let (vertices, triangles) = (model.report.vertices, model.report.triangles);
        let mut text = format!("{}: {vertices} vertices, {triangles} triangles\n", path.display());
        writeln!(text, "{}", settings.summary())?;
        if frames > 1 {
            writeln!(text, "The worst of {frames} frames: frame {}", worst.frame)?;
        }
        writeln!(text, "\n{}", table::comparisons(&outcome, &Bounds::ARITHMETIC))?;
        if let Some(lines) = &lines {
            writeln!(text, "{}", table::of_lines(lines))?;
        }
        writeln!(text, "{}\n", table::meaning(&model, &outcome, &Bounds::ARITHMETIC))?;
        writeln!(text, "Fixed point  {}", pictures.fixed.display())?;
        writeln!(text, "Reference    {}", pictures.reference.display())?;
        writeln!(text, "Difference   {}", pictures.difference.display())?;
        if let Some(path) = &pictures.display {
            writeln!(text, "Display      {}, beside the nearest colours", path.display())?;
        }
        text + &table::legend(&legend)
    };
    Ok(Done { output: text.into(), is_within_bounds })
}

/// Judges the lines and points of a model in every frame of the turntable, and its edges; `None`
/// without any.
fn judged_lines(
    path: &Path,
    model: &Model,
    view: &View,
    arguments: &Arguments,
) -> Result<Option<LineOutcome>> {
    let kinds: &[Edges] = match arguments.edges {
        Some(_) => &[Edges::All, Edges::Visible],
        None if model.report.lines + model.report.points > 0 => &[Edges::None],
        None => return Ok(None),
    };
    let frames = arguments.view.frames.unwrap_or(1);
    let mut found = LineOutcome::default();
    for frame in 0..frames {
        for &edges in kinds {
            let options = LineOptions { edges, ..LineOptions::default() };
            let view = view.turned(frame, frames);
            let of_frame = judge_lines(model, &view, options)
                .map_err(|error| render::refused(path, &error))?;
            found = found.and(of_frame);
        }
    }
    Ok(Some(found))
}

/// The result for a model of lines and points alone, of which there are no pictures.
fn without_faces(
    arguments: &Arguments,
    model: &Model,
    view: &View,
    lines: Option<LineOutcome>,
) -> Result<Done> {
    let path = &arguments.model;
    let (settings, lines) = (Settings::of(model, view), lines.unwrap_or_default());
    if lines.line_pixels == 0 {
        output::complain("warning", &render::nothing_seen(path));
    }
    let (is_within_bounds, vertices) = (lines.is_within(), model.report.vertices);
    let text = if arguments.json {
        output::json(&Json {
            model: path.to_string_lossy().into_owned(),
            vertices,
            triangles: 0,
            settings,
            frames: arguments.view.frames.unwrap_or(1),
            frame: 0,
            outcome: None,
            lines: Some(lines),
            bounds: Bounds::ARITHMETIC,
            within_bounds: is_within_bounds,
            pictures: None,
        })?
    } else {
        format!(
            "{}: {vertices} vertices, no faces\n{}\n\n{}",
            path.display(),
            settings.summary(),
            table::of_lines(&lines)
        )
    };
    Ok(Done { output: text.into(), is_within_bounds })
}

/// Refuses a model of lines and points alone, and warns of those beside faces.
pub(super) fn refuse_without_faces(path: &Path, model: &Model) -> Result<()> {
    let path = path.display();
    if model.report.triangles == 0 {
        bail!(
            "{path} has lines and points but no faces to judge: `host-tools convert {path}` writes \
             its tables, and `host-tools render {path}` draws it"
        );
    }
    if model.report.lines + model.report.points > 0 {
        let text = format!("{path}: lines and points are not in these pictures");
        output::complain("warning", &text);
    }
    Ok(())
}

/// Checks every frame of the turntable and returns the worst: one that exceeds a bound, if any
/// does.
pub(super) fn worst_frame(path: &Path, model: &Model, view: &View, frames: u32) -> Result<Worst> {
    let progress = Progress::over(frames, "checking");
    let checker = Checker::new(model);
    let mut worst: Option<Worst> = None;
    for frame in 0..frames {
        let checked = checker
            .check(&view.turned(frame, frames))
            .map_err(|error| render::refused(path, &error))?;
        let is_worse = |worst: &Worst| checked.outcome.badness() > worst.checked.outcome.badness();
        if worst.as_ref().is_none_or(is_worse) {
            worst = Some(Worst { frame, checked });
        }
        progress.step();
    }
    drop(progress);
    worst.context("there is no frame to check")
}

/// Writes the three pictures of a frame, which [`Pictures::allow`] allows.
pub(super) fn write_pictures(
    checked: &Checked,
    pictures: &Pictures,
    display: Option<Display>,
) -> Result<Legend> {
    let (difference, legend) = image::of_differences(checked, &Bounds::ARITHMETIC);
    let fixed = image::of_fixed(&checked.fixed, BACKGROUND);
    let reference = image::of_reference(&checked.end_to_end, BACKGROUND);
    if let (Some(path), Some(display)) = (&pictures.display, display) {
        let nearest = Display { dither: Matrix::None, ..display };
        let both = fixed.shown_by(display).beside(&fixed.shown_by(nearest));
        output::write(path, &png::still(&both)?)?;
    }
    let files = [
        (&pictures.fixed, fixed),
        (&pictures.reference, reference),
        (&pictures.difference, difference),
    ];
    for (path, image) in &files {
        output::write(path, &png::still(image)?)?;
    }
    Ok(legend)
}

fn default_directory(model: &Path) -> PathBuf {
    if Path::new("target").is_dir() {
        Path::new("target/check").join(output::named_after(model, ""))
    } else {
        output::named_after(model, "-check")
    }
}

/// Refuses a path that is not a directory, or that cannot be created for lack of a parent.
fn allow_directory(directory: &Path) -> Result<()> {
    let parent = directory.parent().filter(|parent| !parent.as_os_str().is_empty());
    if directory.exists() && !directory.is_dir() {
        bail!("{} is not a directory: name another for the pictures", directory.display());
    }
    if let Some(parent) = parent.filter(|parent| !parent.is_dir()) {
        bail!(
            "{}: there is no directory {}: create it, or choose another place",
            directory.display(),
            parent.display()
        );
    }
    Ok(())
}
