//! The command `speed`: counts the instructions and the cycles of the bench scenes' frames on each
//! core.

mod compare;
mod goals;
mod scene;

use std::{env, fmt::Write as _};

use anyhow::{Result, bail};
use clap::Args;
#[cfg(test)]
pub(crate) use scene::tests;
pub(crate) use scene::{Key, Parts, Scene, Scenes, Speed};

use crate::{Done, cores::Core, figures::PerCore};

const EXAMPLES: &str = "\
Examples:
  measure speed                             All scenes on all cores, compared with the saved figures
  measure speed m0plus m4 | grep cube
  measure speed --fail-if-slower            For a change that must not cost anything
  measure speed --fail-if-slower=0.2 m4     The same, by a fifth of a percent
  measure speed --save                      Figures for the repository: tests/measure/RESULTS.md

The scenes of spot and suzanne need spot.obj, suzanne.obj, and spot_textured.obj with its picture,
in the folder that RASTERIZER_MODELS names.

Exit status: 0 if all is well, 1 with --fail-if-slower if a scene got slower, 2 for bad usage or if
something is missing.";

/// Count the instructions and cycles of the bench scenes' frames
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores [default: all of them]
    #[arg(value_name = "CORE")]
    cores: Vec<Core>,
    /// Write the figures to tests/measure/results/speed.json, and render tests/measure/RESULTS.md
    #[arg(long)]
    save: bool,
    /// Fail if a scene takes over 1 % (or PERCENT) more cycles than saved, or more instructions on
    /// a core without a timing table
    #[arg(long, value_name = "PERCENT", conflicts_with = "save", num_args = 0..=1)]
    #[arg(require_equals = true, default_missing_value = "1", value_parser = percent)]
    fail_if_slower: Option<f64>,
}

fn percent(text: &str) -> Result<f64, String> {
    let percent = text.parse().ok().filter(|percent: &f64| percent.is_finite() && *percent >= 0.0);
    percent.ok_or_else(|| "a number of percent from 0 on, as in 0.5".into())
}

/// The scenes of models that do not come with the project.
const FOREIGN: &str = "the scenes of spot and suzanne";
/// The files of these models.
const FILES: &str = "spot.obj, suzanne.obj and spot_textured.obj";

fn has_foreign_models() -> bool {
    env::var_os("RASTERIZER_MODELS").is_some()
}

/// Runs the bench programs on the cores.
///
/// # Errors
///
/// Also returns an error if the figures are `to_be_saved` and lack scenes.
pub(crate) fn measure(cores: &[Core], to_be_saved: bool) -> Result<Speed> {
    if to_be_saved && !has_foreign_models() {
        bail!(
            "saved figures must include {FOREIGN}: name the folder with {FILES} in \
             RASTERIZER_MODELS"
        );
    }
    PerCore::measure(cores)
}

/// A note about scenes that are left out, or nothing.
pub(crate) fn left_out() -> String {
    if has_foreign_models() {
        return String::new();
    }
    format!("\nLeft out are {FOREIGN}: RASTERIZER_MODELS names no folder with {FILES}.\n")
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let saved: Speed = PerCore::saved()?;
    if arguments.fail_if_slower.is_some() && saved.cores.is_empty() {
        bail!("there are no saved figures to compare with: `measure speed --save` writes them");
    }
    let speed = measure(&Core::or_all(&arguments.cores), arguments.save)?;
    let percent = arguments.fail_if_slower.unwrap_or(compare::THRESHOLD);
    let is_slower = compare::changes(&saved, &speed, percent).1.iter().any(|c| c.percent() > 0.0);
    let mut text = speed.tables() + &left_out();
    writeln!(text)?;
    text += &compare::report(&saved, &speed, percent);
    if arguments.save {
        speed.save()?;
    }
    Ok(Done { text, is_good: arguments.fail_if_slower.is_none() || !is_slower })
}

#[cfg(test)]
mod arguments {
    use super::*;

    #[test]
    fn the_percentage_is_optional_and_checked() {
        use clap::Parser as _;

        #[derive(clap::Parser)]
        struct Speed {
            #[command(flatten)]
            arguments: Arguments,
        }

        let parse = |arguments: &[&str]| {
            let all = ["speed"].iter().chain(arguments);
            Speed::try_parse_from(all).ok().map(|speed| speed.arguments)
        };
        let percent = |arguments: &[&str]| parse(arguments).map(|a| (a.fail_if_slower, a.cores));
        assert_eq!(percent(&["m4"]), Some((None, vec![Core::M4])));
        assert_eq!(percent(&["--fail-if-slower", "m4"]), Some((Some(1.0), vec![Core::M4])));
        assert_eq!(percent(&["--fail-if-slower=0.2"]), Some((Some(0.2), vec![])));
        assert_eq!(percent(&["--fail-if-slower=-1"]), None);
        assert_eq!(percent(&["--fail-if-slower=nan"]), None);
    }
}
