//! Builds the firmware for microcontrollers, runs it in QEMU, and measures what frames cost there.

mod chart;
mod conditions;
mod cores;
mod cost;
mod counts;
mod cycles;
mod figures;
mod firmware;
mod frames;
mod plan;
mod plugin;
mod progress;
mod qemu;
mod report;
mod results;
mod rows;
mod scaling;
mod size;
mod speed;
mod stiffness;
mod table;

use std::{
    io::{self, ErrorKind, Write as _},
    process::ExitCode,
};

use anyhow::{Context as _, Result};
use clap::{Parser, Subcommand};

const EXAMPLES: &str = "\
Examples:
  cargo run --quiet --release --package measure -- frames
  cargo run --quiet --release --package measure -- speed m0plus m4
  cargo run --quiet --release --package measure -- cycles --test
  cargo run --quiet --release --package measure -- scaling
  cargo run --quiet --release --package measure -- size
  cargo run --quiet --release --package measure -- report model.obj
  cargo run --quiet --release --package measure -- stiffness
  cargo run --quiet --release --package measure -- plan

Exit status: 0 if all is well, 1 if a comparison fails, 2 for bad usage or if something is
missing.";

/// Builds the firmware for microcontrollers, runs it in QEMU, compares its frames with those of the
/// host, and measures what they cost.
#[derive(Debug, Parser)]
#[command(name = "measure", version, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Frames(frames::Arguments),
    Speed(speed::Arguments),
    Cycles(cycles::Arguments),
    Scaling(scaling::Arguments),
    Size(size::Arguments),
    Report(report::Arguments),
    Stiffness(stiffness::Arguments),
    Plan(plan::Arguments),
    /// Write tests/measure/RESULTS.md and its chart again, from the saved figures
    Render,
}

/// The result of a command, once its files are written.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Done {
    /// For the standard output.
    text: String,
    /// Whether all comparisons came out well.
    is_good: bool,
}

fn main() -> ExitCode {
    let done = match &Arguments::parse().command {
        Command::Frames(arguments) => frames::run(arguments),
        Command::Speed(arguments) => speed::run(arguments),
        Command::Cycles(arguments) => cycles::run(arguments),
        Command::Scaling(arguments) => scaling::run(arguments),
        Command::Size(arguments) => size::run(arguments),
        Command::Report(arguments) => report::run(arguments),
        Command::Stiffness(arguments) => stiffness::run(arguments),
        Command::Plan(arguments) => plan::run(arguments),
        Command::Render => results::render().map(|()| Done { text: String::new(), is_good: true }),
    };
    match done.and_then(|done| print(&done.text).map(|()| done.is_good)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            // If the standard error is closed too, there is nowhere left to report to.
            let _ = writeln!(io::stderr(), "error: {error:#}");
            ExitCode::from(2)
        }
    }
}

/// Prints to the standard output. A closed pipe is no error: its reader has seen enough.
fn print(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).context("the result could not be printed")
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_arguments_are_well_formed() {
        Arguments::command().debug_assert();
    }
}
