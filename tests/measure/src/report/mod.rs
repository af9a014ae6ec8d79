//! The command `report`: error against run time.

mod choices;
mod diagram;
mod errors;
#[cfg(feature = "flip")]
mod flip;
mod front;
mod merge;
mod narrow;
mod page;
mod points;
mod program;
mod resume;
mod run;
mod scenes;
mod split;
mod stiff;

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
  measure report --only labels --only floor
                                        Two scenes of those without models
  measure report --json | jq .scenes[0].points
  measure report --save                 Figures for the repository: tests/measure/WORK_PRECISION.md
  measure report --save --only floor    One scene anew, the others as they are saved

The page report.md, diagrams as SVG and PNG, report.csv and report.json are written to target/report
(or --out DIR). A run that was interrupted goes on from the last whole scene. A model is converted
as by `host-tools convert`, and turned in eight frames. Built with the feature `flip`, the report
also has what an eye sees of the errors, by NVIDIA's FLIP.

Exit status: 0 if all is well, 2 for bad usage or if something is missing.";

/// Show what accuracy costs: the error of each choice against its run time
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// OBJ files [default: three models of the project, two of `RASTERIZER_MODELS`, and two scenes
    /// that are hard to draw]
    #[arg(value_name = "MODEL.obj")]
    models: Vec<PathBuf>,
    /// Only this scene of those without models; may be repeated
    #[arg(long, value_name = "SCENE", conflicts_with = "models")]
    only: Vec<String>,
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
    /// Scenes that were measured on another day, and when.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    later: Vec<(String, String)>,
    scenes: Vec<Measured>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let is_on_host = arguments.host || arguments.quick;
    let cores = if is_on_host { Vec::new() } else { Core::or_all(&arguments.cores) };
    let frames = if arguments.quick { 2 } else { 8 };
    let scenes = if arguments.models.is_empty() {
        default_scenes(arguments.save, frames)?
    } else {
        of_files(&arguments.models, frames)?
    };
    let names: Vec<_> = scenes.iter().map(|scene| scene.name.clone()).collect();
    let mut scenes = chosen(scenes, &arguments.only)?;
    if arguments.quick {
        scenes.truncate(1);
    }
    let keeps_others = arguments.save && !arguments.only.is_empty();
    let kept = if keeps_others { Some(merge::kept(saved()?, &cores)?) } else { None };
    let measured = measure(scenes, cores)?;
    let report = match kept {
        Some(kept) => merge::merge(kept, measured, &names)?,
        None => measured,
    };
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

/// What is compared unless models are named.
fn default_scenes(to_be_saved: bool, frames: u32) -> Result<Vec<Scene>> {
    let mut files = scenes::shipped();
    match env::var_os("RASTERIZER_MODELS") {
        Some(folder) => files.extend(scenes::foreign(Path::new(&folder))),
        None if to_be_saved => {
            bail!("a saved report has scenes of RASTERIZER_MODELS: name their folder in it")
        }
        None => {}
    }
    let mut scenes = of_files(&files, frames)?;
    scenes.extend(stiff::scenes(frames)?);
    Ok(scenes)
}

/// Models, each as a scene.
fn of_files(files: &[PathBuf], frames: u32) -> Result<Vec<Scene>> {
    files.iter().map(|file| Scene::of(file, frames)).collect()
}

/// The scenes of these names, or all if none is named.
fn chosen(mut scenes: Vec<Scene>, names: &[String]) -> Result<Vec<Scene>> {
    let all: Vec<_> = scenes.iter().map(|scene| scene.name.clone()).collect();
    if let Some(name) = names.iter().find(|name| !all.contains(name)) {
        bail!("there is no scene {name}: name one of {}", all.join(", "));
    }
    scenes.retain(|scene| names.is_empty() || names.contains(&scene.name));
    Ok(scenes)
}

/// Measures the scenes that no earlier run has.
fn measure(scenes: Vec<Scene>, cores: Vec<Core>) -> Result<Report> {
    let steps = |scene: &Scene| points::steps(scene, cores.len());
    let progress = progress::over(scenes.iter().map(steps).sum());
    let (conditions, later) = (Vec::new(), Vec::new());
    let mut report = Report { cores, conditions, later, scenes: Vec::new() };
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

/// The saved figures, if there are any.
fn saved() -> Result<Option<Report>> {
    let path = results::file(FILE);
    if !path.exists() {
        return Ok(None);
    }
    let text = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    let report = serde_json::from_str(&text)
        .with_context(|| format!("{} does not hold a report", path.display()))?;
    Ok(Some(report))
}

/// The files that are made of the saved figures.
pub(crate) fn rendered() -> Result<Vec<(String, Vec<u8>)>> {
    let Some(report) = saved()? else { return Ok(Vec::new()) };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_are_chosen_by_their_names() {
        let all = of_files(&scenes::shipped(), 1).unwrap();
        let names = |only: &[&str]| {
            let only: Vec<_> = only.iter().map(|&name| name.to_owned()).collect();
            let scenes = chosen(all.clone(), &only)?;
            anyhow::Ok(scenes.into_iter().map(|scene| scene.name).collect::<Vec<_>>())
        };
        assert_eq!(names(&[]).unwrap(), ["torus_knot", "wooden_crate", "rocket"]);
        assert_eq!(names(&["rocket", "torus_knot"]).unwrap(), ["torus_knot", "rocket"]);
        let error = names(&["rocket", "crate"]).unwrap_err().to_string();
        assert!(error.contains("crate: ") && error.contains("wooden_crate"), "{error}");
    }
}
