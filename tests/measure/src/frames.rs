//! The command `frames`: whether a core draws the same frames as the host.

use std::{fmt::Write as _, process::Command};

use anyhow::Result;
use clap::Args;

use crate::{Done, cores::Core, firmware, progress::Progress, qemu};

const EXAMPLES: &str = "\
Examples:
  measure frames                    All cores
  measure frames m4 riscv

Exit status: 0 if all frames hash as on the host, 1 if not, 2 for bad usage or if something is missing.";

/// Compare the hashes of frames on the cores with those of the host
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores [default: all of them]
    #[arg(value_name = "CORE")]
    cores: Vec<Core>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let cores = Core::or_all(&arguments.cores);
    let progress = Progress::over(1 + cores.len());
    progress.say("frames on the host".into());
    let host = firmware::output_of(&mut Command::new(firmware::build_for_host("frames")?))?;
    let host: Vec<_> = host.lines().collect();
    progress.step();
    let mut done = Done::default();
    for &core in &cores {
        progress.say(format!("frames on {}", core.title()));
        let lines = qemu::run(core, &firmware::build(core, "frames")?)?;
        let differences = differences(&host, &lines);
        if differences.is_empty() {
            writeln!(
                done.text,
                "{:<10}  all {} frames hash as on the host",
                core.title(),
                host.len()
            )?;
        } else {
            done.is_good = false;
            let same = host.len().saturating_sub(differences.len());
            writeln!(
                done.text,
                "{:<10}  {same} of {} frames hash as on the host",
                core.title(),
                host.len()
            )?;
            for Difference { host, core } in differences {
                writeln!(done.text, "  host: {host}\n  core: {core}")?;
            }
        }
        progress.step();
    }
    Ok(done)
}

/// A line that is not the same.
#[derive(Debug, PartialEq, Eq)]
struct Difference<'a> {
    host: &'a str,
    core: &'a str,
}

/// The lines that differ, and those that only one of the two has.
fn differences<'a>(host: &[&'a str], core: &'a [String]) -> Vec<Difference<'a>> {
    let lines = 0..host.len().max(core.len());
    let pairs = lines.map(|line| Difference {
        host: host.get(line).copied().unwrap_or("(nothing)"),
        core: core.get(line).map_or("(nothing)", String::as_str),
    });
    pairs.filter(|pair| pair.host != pair.core).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differing_missing_and_surplus_lines_are_found() {
        let lines = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
        let found = |host: &[&str], core: &[String]| {
            let pairs = differences(host, core);
            pairs.iter().map(|pair| format!("{}/{}", pair.host, pair.core)).collect::<Vec<_>>()
        };
        assert!(found(&["a", "b"], &lines("a b")).is_empty());
        assert_eq!(found(&["a", "b"], &lines("a c")), ["b/c"]);
        assert_eq!(found(&["a", "b"], &lines("a")), ["b/(nothing)"]);
        assert_eq!(found(&["a"], &lines("a b")), ["(nothing)/b"]);
    }
}
