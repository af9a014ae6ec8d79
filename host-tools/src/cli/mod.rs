//! The arguments and the exit status: 0 for success, 1 if a bound is exceeded, 2 for bad usage or
//! bad input.

mod animation;
mod background;
mod check;
mod convert;
mod gif;
mod image;
mod output;
mod placed;
mod plan;
mod png;
mod progress;
mod reduction;
mod render;
mod showcase;
mod signals;
mod smoothing;
mod table;
mod textures;
mod view;

use std::{ffi::OsStr, path::PathBuf, process::ExitCode};

use anyhow::Result;
use clap::{
    CommandFactory as _, Parser, Subcommand,
    builder::{PathBufValueParser, TypedValueParser as _},
    error::ErrorKind,
};

const EXAMPLES: &str = "\
Examples:
  host-tools                        Convert, render and check the bundled crate and rocket
  host-tools model.obj              Convert, render and check your own model
  host-tools convert model.obj      Only the tables: model.rs
  host-tools render model.obj       Only the picture that a display shows: model.png
  host-tools check model.obj        Only fixed point against f64, in numbers and pictures
  host-tools plan model.obj         A renderer that has only what the model needs

Exit status: 0 for success, 1 if the check exceeds a bound or a plan is too slow, 2 for bad usage or bad input.";

/// Turns OBJ models into const tables for the fixed-point rasterizer, and checks its pictures
/// against an f64 reference.
///
/// Without a command: converts, renders and checks a model, and leaves tables and pictures in the
/// directory `target`.
#[derive(Debug, Parser)]
#[command(version, after_help = EXAMPLES, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// The OBJ file to convert, render and check [default: the bundled crate and rocket]
    #[arg(value_parser = PathBufValueParser::new().try_map(no_mistyped_command))]
    model: Option<PathBuf>,
    /// Overwrite files that are not from this program
    #[arg(long, requires = "model")]
    force: bool,
}

/// Accepts all paths except a bare word that is not a file. It is probably a mistyped command, so
/// the error names the commands.
fn no_mistyped_command(path: PathBuf) -> Result<PathBuf, &'static str> {
    if path.exists() || path.extension().is_some() || path.components().count() > 1 {
        Ok(path)
    } else {
        Err("there is no such file, and the commands are convert, render, check and plan")
    }
}

#[derive(Debug, Subcommand)]
enum Command {
    Convert(convert::Arguments),
    Render(render::Arguments),
    Check(check::Arguments),
    Plan(plan::Arguments),
}

/// The result of a command after its files are written.
struct Done {
    /// For the standard output.
    output: Vec<u8>,
    /// Whether all bounds are kept.
    is_within_bounds: bool,
}

impl<T: Into<Vec<u8>>> From<T> for Done {
    /// For commands that have no bounds.
    fn from(output: T) -> Self {
        Self { output: output.into(), is_within_bounds: true }
    }
}

/// Runs the program.
pub(crate) fn run() -> ExitCode {
    let arguments = Arguments::try_parse().unwrap_or_else(|error| {
        // The parser takes a mistyped command for the model, and the next word for a command, which
        // cannot follow a model. Parsing the first word alone gives the better error.
        if error.kind() == ErrorKind::ArgumentConflict
            && let Some(word) = std::env::args_os().nth(1)
            && !Arguments::command().get_subcommands().any(|command| *command.get_name() == *word)
        {
            let _ = Arguments::try_parse_from([OsStr::new("host-tools"), &word])
                .map_err(|error| error.exit());
        }
        error.exit()
    });
    let done = match &arguments.command {
        Some(Command::Convert(arguments)) => convert::run(arguments),
        Some(Command::Render(arguments)) => render::run(arguments),
        Some(Command::Check(arguments)) => check::run(arguments),
        Some(Command::Plan(arguments)) => plan::run(arguments),
        None => showcase::run(arguments.model.as_deref(), arguments.force),
    };
    let told = done.and_then(|done| output::print(&done.output).map(|()| done.is_within_bounds));
    ExitCode::from(status(told))
}

/// The exit status of a command, from whether it keeps its bounds. Prints the error of one that
/// fails.
fn status(told: Result<bool>) -> u8 {
    match told {
        Ok(true) => 0,
        Ok(false) => 1,
        Err(error) => {
            output::complain("error", &error.to_string());
            2
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_well_formed() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn the_exit_status_tells_a_bound_from_a_failure() {
        let failure = Err(anyhow::anyhow!("this line belongs to a test"));
        assert_eq!([Ok(true), Ok(false), failure].map(status), [0, 1, 2]);
    }
}
