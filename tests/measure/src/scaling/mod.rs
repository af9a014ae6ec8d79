//! The command `scaling`: how the cost of a frame grows with its triangles, and with its pixels.

mod chart;
mod curve;
mod report;
mod steps;

use std::fmt::Write as _;

use anyhow::Result;
use clap::Args;
pub(crate) use curve::Scaling;
use curve::{Point, Points};
pub(crate) use report::section;

use crate::{
    Done, conditions::Conditions, cores::Core, firmware, per_core::Measured, progress::Progress,
    qemu, results,
};

const EXAMPLES: &str = "\
Examples:
  measure scaling                   Cortex-M0+ and Cortex-M4
  measure scaling riscv --json
  measure scaling --save            Figures and chart for the repository: tests/measure/RESULTS.md

Exit status: 0 if all is well, 1 if a curve has a step that is not explained, 2 for bad usage or if something is missing.";

/// Count instructions against the number of triangles, and of pixels
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores [default: m0plus and m4]
    #[arg(value_name = "CORE", default_values = ["m0plus", "m4"], hide_default_value = true)]
    cores: Vec<Core>,
    /// Print the figures as one JSON object
    #[arg(long)]
    json: bool,
    /// Write the figures to tests/measure/results/scaling.json and scaling.svg, and
    /// tests/measure/RESULTS.md
    #[arg(long)]
    save: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let scaling = measure(&Core::or_all(&arguments.cores))?;
    let steps = steps::of(&scaling);
    let mut done =
        Done { text: String::new(), is_good: steps.iter().all(|step| step.cause().is_some()) };
    if arguments.json {
        writeln!(done.text, "{}", serde_json::to_string_pretty(&scaling)?)?;
    } else {
        done.text = report::tables(&scaling) + &report::steps(&steps);
    }
    if arguments.save {
        let saved: Option<Scaling> = results::load("scaling.json")?;
        let scaling = saved.unwrap_or_default().with(scaling);
        results::save("scaling.json", &scaling)?;
        results::save_text("scaling.svg", chart::svg(&scaling))?;
        results::render()?;
    }
    Ok(done)
}

fn measure(cores: &[Core]) -> Result<Scaling> {
    let progress = Progress::over(cores.len());
    let mut scaling = Scaling::default();
    for &core in cores {
        progress.say(format!("curves on {}", core.title()));
        let lines = qemu::run(core, &firmware::build(core, "scaling")?)?;
        scaling.cores.push(Measured {
            core,
            conditions: Conditions::of(core, &lines)?,
            figures: Points { points: Point::all(core, &lines)? },
        });
        progress.step();
    }
    Ok(scaling)
}
