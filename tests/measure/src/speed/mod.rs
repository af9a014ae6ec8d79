//! The command `speed`: counts the instructions of the bench scenes' frames on each core.

mod compare;
mod goals;
mod scene;

use std::{env, fmt::Write as _};

use anyhow::{Result, bail};
use clap::Args;
use compare::Change;
pub(crate) use scene::Speed;

use crate::{Done, cores::Core, figures::PerCore};

const EXAMPLES: &str = "\
Examples:
  measure speed                             All scenes on all cores, compared with the saved figures
  measure speed m0plus m4 | grep cube
  measure speed --fail-if-slower            For a change that must not cost anything
  measure speed --save                      Figures for the repository: tests/measure/RESULTS.md

The scenes spot-gouraud and suzanne-gouraud need spot.obj and suzanne.obj in the folder that
RASTERIZER_MODELS names.

Exit status: 0 if all is well, 1 with --fail-if-slower if a scene got slower, 2 for bad usage or if
something is missing.";

/// Count the instructions of the bench scenes' frames
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores [default: all of them]
    #[arg(value_name = "CORE")]
    cores: Vec<Core>,
    /// Write the figures to tests/measure/results/speed.json, and render tests/measure/RESULTS.md
    #[arg(long)]
    save: bool,
    /// Fail if a scene takes over 1 % more instructions than saved
    #[arg(long, conflicts_with = "save")]
    fail_if_slower: bool,
}

/// The scenes of models that do not come with the project.
const FOREIGN: &str = "spot-gouraud and suzanne-gouraud";

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let has_models = env::var_os("RASTERIZER_MODELS").is_some();
    if arguments.save && !has_models {
        bail!(
            "saved figures must include {FOREIGN}: name the folder with spot.obj and suzanne.obj \
             in RASTERIZER_MODELS"
        );
    }
    let saved: Speed = PerCore::saved()?;
    if arguments.fail_if_slower && saved.cores.is_empty() {
        bail!("there are no saved figures to compare with: `measure speed --save` writes them");
    }
    let speed: Speed = PerCore::measure(&Core::or_all(&arguments.cores))?;
    let (compared, changes) = compare::changes(&saved, &speed);
    let is_good = !(arguments.fail_if_slower && changes.iter().any(Change::is_slower));
    let mut text = speed.tables() + "\n";
    if !has_models {
        writeln!(
            text,
            "{FOREIGN} are left out: RASTERIZER_MODELS names no folder with spot.obj and \
             suzanne.obj.\n"
        )?;
    }
    text += &compare::report(&saved, &speed, compared, &changes);
    if arguments.save {
        speed.save()?;
    }
    Ok(Done { text, is_good })
}
