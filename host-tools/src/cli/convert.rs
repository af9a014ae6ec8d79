//! The command `convert`: from an OBJ file to const tables.

use std::{
    fmt::Write as _,
    io::{self, Read as _},
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, bail};
use clap::{Args, ValueEnum};
use host_tools::model::{Contents, Fit, Model, Options, Report, blob, emit};
use serde::Serialize;

use super::{
    Done,
    output::{self, Kind, Overwriting},
    progress::Progress,
    reduction::Reduction,
    smoothing::Smoothing,
    textures::{TextureArguments, TextureJson},
    view::within,
};

/// Files of tables. Each begins with these words.
const TABLES: Kind = Kind {
    is_ours: |start| start.starts_with(b"// A model as const tables, written by host-tools "),
    otherwise: "choose another name, remove it, or convert with --force",
};

/// Models as bytes.
const BLOB: Kind = Kind {
    is_ours: |start| start.starts_with(b"RMSH"),
    otherwise: "choose another name, remove it, or convert with --force",
};

const EXAMPLES: &str = "\
Examples:
  host-tools convert model.obj
  host-tools convert model.obj -o firmware/src/model.rs --name SHIP
  host-tools convert model.obj --normals face        Flat shading needs no other normals
  host-tools convert model.obj --texture-size 64x64 --texture-format indexed4 --mipmaps
  host-tools convert model.obj --no-textures         Only colours
  host-tools convert model.obj --edges 30            Also its edges, for a wireframe
  host-tools convert model.obj --simplify 500        At most 500 triangles, and what that costs
  host-tools convert model.obj --json | jq .flash
  host-tools convert up.obj down.obj -o bird.rs      Shapes of one model, for an animation
  host-tools convert model.obj -o model.bin          Bytes for external flash, in place of Rust
  export | host-tools convert - -o - > model.rs       Standard input and output

Use the tables as a module of the firmware (`mod model;`) and draw `model::MODEL`. The textures of
its materials are `model::MODEL_TEXTURES`, its edges `model::MODEL_EDGES`; its lines (`l`) and points
(`p`) are `model::MODEL_LINES` and `model::MODEL_POINTS`, a table for each material. Of several files
`model::MODEL_KEYFRAMES` has all shapes; the files have the same faces, texture coordinates and
materials. `Mesh::from_bytes` reads a file that ends with .bin.";

/// Write a model as const tables in Rust
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The OBJ file; - for the standard input, whose libraries lie in this directory
    model: PathBuf,
    /// Further shapes of the model, for an animation: OBJ files that differ in positions and
    /// normals alone
    #[arg(value_name = "SHAPE")]
    shapes: Vec<PathBuf>,
    /// Where to write the tables: as Rust, or to a name that ends with .bin as bytes; - for the
    /// standard output, without the report [default: the model's name with .rs, in this
    /// directory]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The name of the static, written in capitals [default: that of the model]
    #[arg(long)]
    name: Option<String>,
    /// Keep the file's coordinates, instead of fitting the model into a sphere of radius 1 about
    /// the origin
    #[arg(long)]
    keep_units: bool,
    #[command(flatten)]
    smoothing: Smoothing,
    #[command(flatten)]
    reduction: Reduction,
    /// Turn over faces that run against their neighbours, and closed parts that are inside out
    #[arg(long)]
    fix_winding: bool,
    /// Which normals: vertex for Gouraud shading, face for flat shading
    #[arg(long, value_name = "WHICH", default_value = "both")]
    normals: Normals,
    /// Keep texture coordinates even without textures
    #[arg(long)]
    texture_coordinates: bool,
    /// Make lines of the edges in which faces meet at this angle or more, and of borders: 0 for all
    /// edges
    #[arg(long, value_name = "DEGREES", value_parser = within(0.0, 180.0))]
    edges: Option<f64>,
    /// Leave out the colours of vertices (`v x y z r g b`): materials have colours (`Kd`) too
    #[arg(long)]
    no_vertex_colors: bool,
    #[command(flatten)]
    textures: TextureArguments,
    /// Overwrite a file that is not from this program
    #[arg(long)]
    force: bool,
    /// Print the report as one JSON object
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Normals {
    Vertex,
    Face,
    Both,
    None,
}

impl Arguments {
    fn options(&self) -> Options {
        Options {
            fit: if self.keep_units { Fit::Keep } else { Fit::Unit },
            fix_winding: self.fix_winding,
            simplify: self.reduction.simplify,
            edges_degrees: self.edges,
            contents: Contents {
                vertex_normals: matches!(self.normals, Normals::Vertex | Normals::Both),
                face_normals: matches!(self.normals, Normals::Face | Normals::Both),
                texture_coordinates: self.texture_coordinates,
                vertex_colors: !self.no_vertex_colors,
            },
            textures: self.textures.options(),
            name: self.name.clone(),
            ..self.smoothing.options()
        }
    }
}

/// What `--json` prints.
#[derive(Serialize)]
struct Json<'a> {
    model: String,
    output: String,
    name: &'a str,
    #[serde(flatten)]
    report: Report,
    position_error_max_percent: f64,
    position_error_rms_percent: f64,
    flash_total: usize,
    textures: Vec<TextureJson>,
    warnings: &'a [String],
}

pub(super) fn run(arguments: &Arguments) -> Result<Done> {
    let path =
        (arguments.output.clone()).unwrap_or_else(|| output::named_after(&arguments.model, ".rs"));
    let is_standard = output::is_standard(&path);
    if is_standard && arguments.json {
        bail!("--json and -o - both write to the standard output: leave out one");
    }
    let is_blob = path.extension().is_some_and(|extension| extension == "bin");
    if is_blob && !arguments.shapes.is_empty() {
        bail!("a .bin file holds one shape: convert several to Rust, or each to its own file");
    }
    let model = if arguments.shapes.is_empty() {
        load(&arguments.model, &arguments.options())?
    } else {
        load_shapes(&arguments.model, &arguments.shapes, &arguments.options())?
    };
    if is_standard {
        return Ok(emit::source(&model).into());
    }
    let inputs = output::inputs(&model);
    let overwriting = Overwriting { force: arguments.force, inputs: &inputs };
    let kind = if is_blob { BLOB } else { TABLES };
    output::allow(&path, kind, overwriting)?;
    if is_blob {
        output::write(&path, &blob::bytes(&model))?;
    } else {
        write(&model, &path)?;
    }
    let text = if arguments.json {
        json(arguments, &path, &model)?
    } else {
        let mut text = model.report.to_string();
        if let Some(textures) = &model.textures {
            write!(text, "{textures}")?;
        }
        let what = if is_blob { "a mesh".to_owned() } else { statics(&model) };
        writeln!(text, "\nWrote {}: {what}", path.display())?;
        text
    };
    Ok(text.into())
}

/// The names of a model's statics.
pub(super) fn statics(model: &Model) -> String {
    let name = &model.name;
    let others = [
        (!model.keyframes.is_empty(), "KEYFRAMES"),
        (!model.edges.is_empty(), "EDGES"),
        (!model.lines.is_empty(), "LINES"),
        (!model.points.is_empty(), "POINTS"),
        (model.textures.is_some(), "TEXTURES"),
    ];
    let others = others.iter().filter(|(exists, _)| *exists);
    let others: Vec<_> = others.map(|(_, ending)| format!("{name}_{ending}")).collect();
    match others.split_last() {
        None => format!("static {name}"),
        Some((last, [])) => format!("statics {name} and {last}"),
        Some((last, others)) => format!("statics {name}, {} and {last}", others.join(", ")),
    }
}

fn json(arguments: &Arguments, path: &Path, model: &Model) -> Result<String> {
    let report = model.report;
    let object = Json {
        model: arguments.model.to_string_lossy().into_owned(),
        output: path.to_string_lossy().into_owned(),
        name: &model.name,
        report,
        position_error_max_percent: report.percent_of_size(report.position_error_max),
        position_error_rms_percent: report.percent_of_size(report.position_error_rms),
        flash_total: report.flash.total(),
        textures: model.textures.as_ref().map(TextureJson::all).unwrap_or_default(),
        warnings: &model.warnings,
    };
    output::json(&object)
}

/// Loads a model and prints its warnings.
pub(super) fn load(path: &Path, options: &Options) -> Result<Model> {
    let model = {
        let _progress = Progress::over(1, "reading the model");
        if output::is_standard(path) {
            let mut bytes = Vec::new();
            io::stdin().read_to_end(&mut bytes).context("the standard input cannot be read")?;
            Model::from_bytes(path, &bytes, options)?
        } else {
            Model::load(path, options)?
        }
    };
    warn(&model);
    Ok(model)
}

/// Loads a model in several shapes and prints its warnings.
pub(super) fn load_shapes(first: &Path, further: &[PathBuf], options: &Options) -> Result<Model> {
    let mut all = std::iter::once(first).chain(further.iter().map(PathBuf::as_path));
    if all.any(output::is_standard) {
        bail!("several shapes cannot be read from the standard input: name their files");
    }
    let model = {
        let _progress = Progress::over(1, "reading the shapes");
        Model::load_keyframes(first, further, options)?
    };
    warn(&model);
    Ok(model)
}

fn warn(model: &Model) {
    for warning in &model.warnings {
        output::complain("warning", warning);
    }
}

/// Refuses a path for tables.
pub(super) fn allow(path: &Path, overwriting: Overwriting<'_>) -> Result<()> {
    output::allow(path, TABLES, overwriting)
}

/// Writes a model's tables.
pub(super) fn write(model: &Model, path: &Path) -> Result<()> {
    output::write(path, emit::source(model).as_bytes())
}
