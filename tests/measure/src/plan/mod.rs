//! The command `plan`: what `host-tools plan` predicts against what is measured.

mod bodies;
mod calibrate;
mod compare;
mod fit;
mod page;
mod program;
mod scenes;

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, ensure};
use clap::Args;
use host_tools::{
    model::write_atomically,
    plan::{self, Costs},
};

use self::{compare::Compared, page::Saved};
use crate::{Done, cores::Core, firmware, plugin::Plugin, progress, size};

const EXAMPLES: &str = "\
Examples:
  measure plan                      The plans of all scenes: predicted and measured
  measure plan rocket               That of one
  measure plan --save               Writes tests/measure/PLANS.md
  measure plan --calibrate          Measures the costs that plans are made by

Exit status: 0 if what is measured is what was predicted, 1 if not, 2 for bad usage or if something
is missing.";

/// Compare what plans predict with what is measured
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The scenes [default: all]
    #[arg(value_name = "SCENE")]
    scenes: Vec<String>,
    /// Write the page of the plans
    #[arg(long, conflicts_with_all = ["scenes", "calibrate"])]
    save: bool,
    /// Measure the costs of all renderers, which takes an hour; those that are known are kept,
    /// so that it goes on where it was stopped
    #[arg(long, conflicts_with = "scenes")]
    calibrate: bool,
    /// Measure only renderers whose name contains this, and these anew
    #[arg(long, value_name = "TEXT", requires = "calibrate")]
    only: Option<String>,
}

/// The cores that plans are for, here and there.
const CORES: [(Core, plan::Core); 3] = [
    (Core::M0plus, plan::Core::M0plus),
    (Core::M4, plan::Core::M4),
    (Core::Riscv, plan::Core::Riscv),
];

/// Where programs and bodies lie: it can be removed at any time.
fn folder() -> Result<PathBuf> {
    let folder = firmware::target_directory().join("plan");
    fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    Ok(folder)
}

/// The file of the costs.
fn costs_file() -> PathBuf {
    firmware::root().join("host-tools/src/plan/costs.json")
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    if arguments.calibrate {
        return calibrate(arguments.only.as_deref());
    }
    let folder = folder()?;
    let mut scenes = scenes::all(&folder)?;
    let names: Vec<_> = scenes.iter().map(|scene| scene.name).collect();
    for name in &arguments.scenes {
        ensure!(names.contains(&&**name), "there is no scene {name}, but {}", names.join(", "));
    }
    scenes.retain(|scene| {
        arguments.scenes.is_empty() || arguments.scenes.iter().any(|name| name == scene.name)
    });
    let plans = compare(&scenes, &folder)?;
    let is_good = plans.iter().all(Compared::is_good);
    let saved = Saved { compiler: firmware::compiler_version(CORES[0].0)?, plans };
    if arguments.save {
        let path = firmware::root().join("tests/measure/PLANS.md");
        write_atomically(&path, page::page(&saved))?;
    }
    Ok(Done { text: page::summary(&saved), is_good })
}

/// Plans and measures all scenes.
fn compare(scenes: &[scenes::Scene], folder: &Path) -> Result<Vec<Compared>> {
    let costs = Costs::measured();
    let progress = progress::over(scenes.len());
    let mut plans = Vec::new();
    for (core, named) in CORES {
        let of_core: Vec<_> = scenes.iter().filter(|scene| scene.request.core == named).collect();
        if of_core.is_empty() {
            continue;
        }
        let (plugin, runtime) = (Plugin::build(core)?, size::runtime(core)?);
        for scene in of_core {
            progress.set_message(format!("{} on {}", scene.name, core.title()));
            plans.push(Compared::of(scene, &costs, (core, &plugin), runtime, folder)?);
            progress.inc(1);
        }
    }
    let place = |plan: &Compared| scenes.iter().position(|scene| scene.name == plan.scene);
    plans.sort_by_key(place);
    Ok(plans)
}

/// Measures costs.
fn calibrate(only: Option<&str>) -> Result<Done> {
    let is_chosen = |types: &plan::Types| only.is_none_or(|only| types.to_string().contains(only));
    let types: Vec<_> = plan::Types::all_measured().into_iter().filter(is_chosen).collect();
    let file = costs_file();
    let text = fs::read_to_string(&file).with_context(|| file.display().to_string())?;
    let mut costs: Costs = serde_json::from_str(&text)?;
    let progress = progress::over(CORES.len() * types.len());
    let mut text = String::new();
    for (core, named) in CORES {
        if let Some(costs) = costs.cores.get_mut(named.name()).filter(|_| only.is_some()) {
            costs.retain(|name, _| !types.iter().any(|types| types.to_string() == *name));
        }
        let save = |costs: &Costs| {
            Ok(write_atomically(&file, serde_json::to_string(costs)?.replace("},", "},\n") + "\n")?)
        };
        let measured = calibrate::costs((core, named), &types, &mut costs, save, &progress)?;
        for (types, residual) in measured {
            let [rms, most] = [residual.rms, residual.most].map(|part| 100.0 * part);
            let core = core.title();
            let _ =
                writeln!(text, "{core} {types}: frames are off by {rms:.1} %, {most:.1} % at most");
        }
    }
    Ok(Done { text, is_good: true })
}
