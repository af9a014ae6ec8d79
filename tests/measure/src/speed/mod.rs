//! The command `speed`: what the frames of the bench scenes cost on each core.

mod compare;
mod figures;
mod goals;
mod report;

use std::{env, fmt::Write as _};

use anyhow::{Context as _, Result, bail};
use clap::Args;
use compare::Change;
pub(crate) use figures::Speed;
use figures::{Line, Scene, Scenes};
pub(crate) use report::section;
use serde::Serialize;

use crate::{
    Done, conditions::Conditions, cores::Core, firmware, per_core::Measured, progress::Progress,
    qemu, results,
};

const EXAMPLES: &str = "\
Examples:
  measure speed                             All scenes on all cores, compared with the saved figures
  measure speed m0plus m4 --scene cube
  measure speed --json | jq '.cores[0].scenes'
  measure speed --fail-if-slower            For a change that must not cost anything
  measure speed --save                      Figures for the repository: tests/measure/RESULTS.md

The scenes spot-gouraud and suzanne-gouraud need spot.obj and suzanne.obj in the folder that RASTERIZER_MODELS names.

Exit status: 0 if all is well, 1 with --fail-if-slower if a scene got slower, 2 for bad usage or if something is missing.";

/// Count the instructions of the bench scenes' frames
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores [default: all of them]
    #[arg(value_name = "CORE")]
    cores: Vec<Core>,
    /// Only scenes with this in their names; may be repeated
    #[arg(long = "scene", value_name = "NAME")]
    scenes: Vec<String>,
    /// Print the figures as one JSON object
    #[arg(long)]
    json: bool,
    /// Write the figures to tests/measure/results/speed.json, and tests/measure/RESULTS.md
    #[arg(long, conflicts_with = "scenes")]
    save: bool,
    /// Fail if a scene takes more instructions than the saved figures say, by more than 1 %
    #[arg(long, conflicts_with = "save")]
    fail_if_slower: bool,
}

/// The models that are not the project's own.
const FOREIGN: &str = "spot-gouraud and suzanne-gouraud";

/// What `--json` prints.
#[derive(Serialize)]
struct Json<'a> {
    #[serde(flatten)]
    speed: &'a Speed,
    changes: &'a [Change],
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let has_models = env::var_os("RASTERIZER_MODELS").is_some();
    if arguments.save && !has_models {
        bail!(
            "{FOREIGN} must not be missing from what is saved: name the folder with spot.obj and suzanne.obj in \
             RASTERIZER_MODELS"
        );
    }
    let saved: Option<Speed> = results::load("speed.json")?;
    if arguments.fail_if_slower && saved.is_none() {
        bail!("there are no saved figures to compare with: `measure speed --save` writes them");
    }
    let speed = measure(&Core::or_all(&arguments.cores), &arguments.scenes)?;
    let saved = saved.unwrap_or_default();
    let changes = compare::changes(&saved, &speed);
    let mut done = Done {
        text: String::new(),
        is_good: !(arguments.fail_if_slower && changes.iter().any(Change::is_slower)),
    };
    if arguments.json {
        let object = Json { speed: &speed, changes: &changes };
        writeln!(done.text, "{}", serde_json::to_string_pretty(&object)?)?;
    } else {
        done.text = report::tables(&speed);
        if !has_models {
            writeln!(
                done.text,
                "{FOREIGN} are left out: RASTERIZER_MODELS names no folder with spot.obj and suzanne.obj.\n"
            )?;
        }
        done.text += &report::changes(&saved, &speed, &changes);
    }
    if arguments.save {
        results::save("speed.json", &saved.with(speed))?;
        results::render()?;
    }
    Ok(done)
}

/// Runs the bench programs on the cores.
fn measure(cores: &[Core], wanted: &[String]) -> Result<Speed> {
    let progress = Progress::over(4 * cores.len());
    let mut speed = Speed::default();
    for &core in cores {
        let lines = |program| {
            progress.say(format!("{program} on {}", core.title()));
            let lines = qemu::run(core, &firmware::build(core, program)?)?;
            progress.step();
            Ok::<_, anyhow::Error>(lines)
        };
        let (frames, set_up) = (lines("bench")?, lines("bench_set_up")?);
        let conditions = Conditions::of(core, &frames)?;
        let mut scenes = scenes_of(core, &frames, &set_up)?;
        scenes.extend(scenes_of(core, &lines("bench_frugal")?, &lines("bench_frugal_set_up")?)?);
        let is_wanted = |scene: &Scene| {
            wanted.is_empty() || wanted.iter().any(|name| scene.scene.contains(name.as_str()))
        };
        let mut names: Vec<_> = scenes.iter().map(|scene| scene.scene.clone()).collect();
        names.sort();
        names.dedup();
        let scenes: Vec<_> = scenes.into_iter().filter(is_wanted).collect();
        if scenes.is_empty() {
            bail!(
                "no scene has {} in its name; there are {}",
                wanted.join(" or "),
                names.join(", ")
            );
        }
        speed.cores.push(Measured { core, conditions, figures: Scenes { scenes } });
    }
    Ok(speed)
}

/// Brings both programs' lines together.
fn scenes_of(core: Core, frames: &[String], set_up: &[String]) -> Result<Vec<Scene>> {
    let (frames, set_up) = (Line::all(frames)?, Line::all(set_up)?);
    let scene = |line: &Line| {
        let set_up = set_up.iter().find(|set_up| set_up.is_same_scene(line));
        let set_up = set_up.with_context(|| format!("{} has no line of its set-up", line.scene))?;
        Ok(Scene::new(core, line, set_up))
    };
    frames.iter().map(scene).collect()
}
