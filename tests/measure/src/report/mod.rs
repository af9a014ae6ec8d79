//! The command `report`: error against run time.

mod choices;
mod diagram;
mod errors;
#[cfg(feature = "flip")]
mod flip;
mod front;
mod page;
mod points;
mod program;
mod resume;
mod run;
mod scenes;
mod split;

use std::{
    env, fs,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, bail};
use clap::Args;
use host_tools::model::write_atomically;
use serde::{Deserialize, Serialize};

use crate::{Done, chart, conditions::Conditions, cores::Core, firmware, progress, results, rows};
use points::Measured;
use scenes::Scene;

const EXAMPLES: &str = "\
Examples:
  measure report                        Models of the project, Cortex-M0+ and Cortex-M4
  measure report model.obj              Your own model
  measure report --core riscv model.obj
  measure report --quick model.obj      One model, two frames, the times of this machine alone
  measure report --json | jq .scenes[0].points
  measure report --save                 Figures for the repository: tests/measure/WORK_PRECISION.md

The page report.md, diagrams as SVG and PNG, report.csv and report.json are written to target/report
(or --out DIR). A run that was interrupted goes on from the last whole scene. A model is converted
as by `host-tools convert`, and turned in eight frames. Built with the feature `flip`, the report
also has what an eye sees of the errors, by NVIDIA's FLIP.

Exit status: 0 if all is well, 2 for bad usage or if something is missing.";

/// Show what accuracy costs: the error of each choice against its run time
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// OBJ files [default: three models of the project, and two of `RASTERIZER_MODELS`]
    #[arg(value_name = "MODEL.obj")]
    models: Vec<PathBuf>,
    /// A core to count on; may be repeated
    #[arg(long = "core", value_name = "CORE", default_values = ["m0plus", "m4"])]
    cores: Vec<Core>,
    /// Only the times of this machine, without QEMU
    #[arg(long, conflicts_with = "save")]
    host: bool,
    /// A rough report in less time: one model, two frames, --host
    #[arg(long, conflicts_with = "save")]
    quick: bool,
    /// Where the report is written
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print all figures as JSON in place of the page
    #[arg(long)]
    json: bool,
    /// Write the report into the repository
    #[arg(long, conflicts_with = "out")]
    save: bool,
}

/// All figures of a report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Report {
    cores: Vec<Core>,
    conditions: Vec<(Core, Conditions)>,
    scenes: Vec<Measured>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let is_on_host = arguments.host || arguments.quick;
    let cores = if is_on_host { Vec::new() } else { Core::or_all(&arguments.cores) };
    let mut files = arguments.models.clone();
    if files.is_empty() {
        files = default_models(arguments.save)?;
    }
    if arguments.quick {
        files.truncate(1);
    }
    let frames = if arguments.quick { 2 } else { 8 };
    let report = measure(&files, frames, cores)?;
    let text = if arguments.json {
        rows::to_string(&report)?
    } else {
        page::page(&report, "", |name| format!("{name}.svg"))
    };
    if arguments.save {
        let text = rows::to_string(&report)?;
        write_atomically(&results::file(FILE), text)?;
        results::render()?;
    } else {
        write(&report, &arguments.out.clone().map_or_else(folder, Ok)?)?;
    }
    Ok(Done { text, is_good: true })
}

/// Where reports are written unless another place is named.
///
/// # Errors
///
/// Returns an error if it cannot be made.
pub(crate) fn folder() -> Result<PathBuf> {
    let folder = firmware::target_directory().join("report");
    fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    Ok(folder)
}

/// The models that are compared unless others are named.
fn default_models(to_be_saved: bool) -> Result<Vec<PathBuf>> {
    let mut files = scenes::shipped();
    match env::var_os("RASTERIZER_MODELS") {
        Some(folder) => files.extend(scenes::foreign(Path::new(&folder))),
        None if to_be_saved => {
            bail!("a saved report has scenes of RASTERIZER_MODELS: name their folder in it")
        }
        None => {}
    }
    Ok(files)
}

/// Measures the scenes that no earlier run has.
fn measure(files: &[PathBuf], frames: u32, cores: Vec<Core>) -> Result<Report> {
    let scenes = files.iter().map(|file| Scene::of(file, frames)).collect::<Result<Vec<_>>>()?;
    let steps = |scene: &Scene| points::steps(scene, cores.len());
    let progress = progress::over(scenes.iter().map(steps).sum());
    let mut report = Report { cores, conditions: Vec::new(), scenes: Vec::new() };
    for scene in scenes {
        let fingerprint = resume::fingerprint(&scene, &report.cores)?;
        let (measured, conditions) = match resume::kept(&scene, fingerprint)? {
            Some(kept) => {
                progress.inc(points::steps(&scene, report.cores.len()) as u64);
                kept
            }
            None => {
                let found = Measured::of(scene, &report.cores, &progress)?;
                resume::keep(fingerprint, &found)?;
                found
            }
        };
        report.scenes.push(measured);
        report.conditions = conditions;
    }
    Ok(report)
}

/// The figures in the repository, and the page.
const FILE: &str = "report.json";
const PAGE: &str = "../WORK_PRECISION.md";

/// How the page is made, and what to pick by the saved figures.
const ADVICE: &str = include_str!("advice.md");

/// The files that are made of the saved figures.
pub(crate) fn rendered() -> Result<Vec<(String, Vec<u8>)>> {
    let path = results::file(FILE);
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    let report: Report = serde_json::from_str(&text)
        .with_context(|| format!("{} does not hold a report", path.display()))?;
    let name = |scene: &str| format!("report-{scene}.svg");
    let page = page::page(&report, ADVICE, |scene| format!("results/{}", name(scene)));
    let mut files = vec![(PAGE.to_owned(), page.into_bytes())];
    files.push(("report.csv".to_owned(), page::csv(&report).into_bytes()));
    for measured in &report.scenes {
        let charts = diagrams(&report, measured);
        let svg = chart::svg(&charts, columns(&charts));
        files.push((name(&measured.scene.name), svg.into_bytes()));
    }
    Ok(files)
}

/// The diagrams of a scene for each core, or for the host: two for one with a texture.
fn diagrams(report: &Report, measured: &Measured) -> Vec<chart::Chart> {
    let cores: Vec<_> = report.cores.iter().map(|&core| Some(core)).collect();
    let cores = if cores.is_empty() { vec![None] } else { cores };
    let of_core = |core| {
        let texels = measured.scene.is_textured.then(|| diagram::texels(measured, core));
        [diagram::diagram(measured, core)].into_iter().chain(texels)
    };
    cores.into_iter().flat_map(of_core).collect()
}

/// Diagrams in a row: up to two.
fn columns(charts: &[chart::Chart]) -> usize {
    charts.len().min(2)
}

/// Writes a report into a folder.
fn write(report: &Report, folder: &Path) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let write = |name: String, bytes: Vec<u8>| write_atomically(&folder.join(name), bytes);
    for measured in &report.scenes {
        let (name, charts) = (&measured.scene.name, diagrams(report, measured));
        write(format!("{name}.svg"), chart::svg(&charts, columns(&charts)).into_bytes())?;
        write(format!("{name}.png"), chart::png(&charts, columns(&charts))?)?;
    }
    let page = page::page(report, "", |name| format!("{name}.svg"));
    write("report.md".into(), page.into_bytes())?;
    write("report.csv".into(), page::csv(report).into_bytes())?;
    write("report.json".into(), rows::to_string(report)?.into_bytes())?;
    Ok(())
}
