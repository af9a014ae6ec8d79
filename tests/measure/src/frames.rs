//! The command `frames`: compares the frames of the cores with those of the host.

use std::{fmt::Write as _, process::Command};

use anyhow::Result;
use clap::Args;

use crate::{Done, cores::Core, firmware, progress, qemu};

const EXAMPLES: &str = "\
Examples:
  measure frames                    All cores
  measure frames m4 riscv

Exit status: 0 if all frames hash as on the host, 1 if not, 2 for bad usage or if something is
missing.";

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
    let progress = progress::over(1 + cores.len());
    progress.set_message("frames on the host");
    let host = firmware::output_of(&mut Command::new(firmware::build_for_host("frames")?))?;
    let host: Vec<_> = host.lines().collect();
    progress.inc(1);
    progress.set_message("building for the cores");
    firmware::build_ahead(&cores, &["frames"])?;
    let (mut text, mut is_good) = (String::new(), true);
    for core in cores {
        progress.set_message(format!("frames on {}", core.title()));
        let lines = qemu::run(core, &firmware::build(core, "frames")?)?;
        let differences = differences(&host, &lines);
        let (same, all) = (host.len().saturating_sub(differences.len()), host.len());
        writeln!(text, "{:<10}  {same} of {all} frames hash as on the host", core.title())?;
        for [host, core] in &differences {
            writeln!(text, "  host: {host}\n  core: {core}")?;
        }
        is_good &= differences.is_empty();
        progress.inc(1);
    }
    Ok(Done { text, is_good })
}

/// The lines of the host and of the core that differ, and those that only one of the two has.
fn differences<'a>(host: &[&'a str], core: &'a [String]) -> Vec<[&'a str; 2]> {
    let lines = 0..host.len().max(core.len());
    let pairs = lines.map(|line| {
        let [host, core] = [host.get(line).copied(), core.get(line).map(String::as_str)];
        [host, core].map(|line| line.unwrap_or("(nothing)"))
    });
    pairs.filter(|[host, core]| host != core).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differing_missing_and_surplus_lines_are_found() {
        let core = ["a", "b"].map(str::to_owned);
        assert!(differences(&["a", "b"], &core).is_empty());
        assert_eq!(differences(&["a", "c"], &core), [["c", "b"]]);
        assert_eq!(differences(&["a"], &core), [["(nothing)", "b"]]);
        assert_eq!(differences(&["a", "b"], &core[..1]), [["b", "(nothing)"]]);
    }
}
