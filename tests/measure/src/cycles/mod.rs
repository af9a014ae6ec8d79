//! The command `cycles`: what the bench scenes' frames take by the timing tables of the cores.

mod board;
mod loops;
mod report;
mod tables;
pub(crate) mod timing;

use std::path::PathBuf;

use anyhow::{Context as _, Result, bail, ensure};
use clap::Args;
pub(crate) use report::section;
pub(crate) use timing::Timing;

use crate::{Done, cores::Core, speed};

const EXAMPLES: &str = "\
Examples:
  measure cycles                    All cores that there is a timing table of
  measure cycles m4 | grep cube
  measure cycles m0plus --miss-cycles 116
                                    An RP2040 whose flash runs at a quarter of its clock
  measure cycles --json             With all counts, for programs
  measure cycles --test             Loops that were counted by hand
  measure cycles m4 --board out.txt Compare with what a board has printed: tests/measure/BOARDS.md
  measure cycles --save             Figures for the repository, as `measure speed --save`

Exit status: 0 if all is well, 1 with --test if a loop takes other than by hand, 2 for bad usage or
if something is missing.";

/// Show the cycles of the bench scenes' frames, and the range that they lie in
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores [default: m0plus, m4, m33 and riscv]
    #[arg(value_name = "CORE")]
    cores: Vec<Core>,
    /// Cycles that the RP2040 waits when its cache misses
    #[arg(long, value_name = "CYCLES", default_value_t = timing::MISS)]
    miss_cycles: u64,
    /// Print all counts and cycles as JSON
    #[arg(long)]
    json: bool,
    /// Count loops that were counted by hand, and compare
    #[arg(long, conflicts_with_all = ["json", "save", "miss_cycles"])]
    test: bool,
    /// Compare with what `bench_board` has printed on a board with the one core named
    #[arg(long, value_name = "FILE", conflicts_with_all = ["json", "save", "test"])]
    board: Option<PathBuf>,
    /// Write the figures to tests/measure/results/speed.json, and render tests/measure/RESULTS.md
    #[arg(long)]
    save: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let without_table = arguments.cores.iter().find(|&&core| Timing::of(core).is_none());
    if let Some(core) = without_table {
        bail!("there is no timing table of the {}: `measure speed` has instructions", core.title());
    }
    let mut cores = Core::or_all(&arguments.cores);
    cores.retain(|&core| Timing::of(core).is_some());
    if arguments.test {
        return loops::run(&cores);
    }
    ensure!(arguments.miss_cycles <= 10_000, "a miss takes at most 10,000 cycles");
    if let Some(printed) = &arguments.board {
        let (&[core], [_]) = (&cores[..], &arguments.cores[..]) else {
            bail!("--board compares with one board: name its core");
        };
        let timing = Timing::of(core).context("it has a table, or it was refused above")?;
        return board::run(core, &timing, printed, arguments.miss_cycles);
    }
    let speed = speed::measure(&cores, arguments.save)?;
    let text = if arguments.json {
        report::json(&speed, arguments.miss_cycles)?
    } else {
        report::tables(&speed, arguments.miss_cycles) + &speed::left_out()
    };
    if arguments.save {
        speed.save()?;
    }
    Ok(Done { text, is_good: true })
}
