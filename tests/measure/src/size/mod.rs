//! The command `size`: what scenes take of flash and RAM, and whether that is within their budgets.

mod budgets;
mod image;
mod report;
mod stack;
mod unwanted;

use std::{fs, path::Path};

use anyhow::{Context as _, Result, bail, ensure};
use clap::Args;
use serde::{Deserialize, Serialize};

use self::{
    budgets::{Budgets, Bytes},
    image::{Image, Symbol},
};
use crate::{Done, cores::Core, firmware, progress::Progress};

const EXAMPLES: &str = "\
Examples:
  measure size                      Cortex-M0+ and Cortex-M4
  measure size m0plus --symbols     With the largest functions of each scene
  measure size --save               Takes what is measured for the budgets

Exit status: 0 if all is within its budget (those of another compiler do not count) and no scene brings unwanted code, 1
if not, 2 for bad usage or if something is missing.";

/// Measure what scenes take of flash and RAM, and compare it with their budgets
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores: m0plus, m4 [default: both]
    #[arg(value_name = "CORE")]
    cores: Vec<Core>,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// List the ten largest symbols of each scene
    #[arg(long)]
    symbols: bool,
    /// Take what is measured, rounded up a little, for the budgets
    #[arg(long)]
    save: bool,
}

/// The `opt-level` of a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum Level {
    /// For size.
    #[serde(rename = "s")]
    S,
    /// For speed.
    #[serde(rename = "3")]
    Three,
}

impl Level {
    const ALL: [Self; 2] = [Self::S, Self::Three];

    /// As cargo takes it.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::S => "s",
            Self::Three => "3",
        }
    }
}

/// The runtime alone, which all scenes have.
const EMPTY: &str = "empty";
/// The scene with an array of [`DEPTH`] bytes on the stack.
const DEEP: &str = "deep";
const DEPTH: u32 = 4096;
/// The scene with a model that is not the project's own.
const SPOT: &str = "spot";

/// The scenes, the smallest first. Each is the program `size_*` of the firmware, with underscores.
const SCENES: [&str; 14] = [
    EMPTY,
    DEEP,
    "unlit-direct",
    "flat-direct",
    "flat-bands",
    "flat-depth",
    "gouraud-unclipped",
    "gouraud-s4",
    "gouraud-binned",
    "gouraud-s8",
    "gouraud-wide",
    "parallel",
    "everything",
    SPOT,
];

/// What a scene takes.
#[derive(Clone, Debug)]
struct Measured {
    core: Core,
    level: Level,
    scene: &'static str,
    bytes: Bytes,
    /// Bytes of flash for tables of models, which are not in `bytes`.
    models: u32,
    /// The checksum of its pictures.
    checksum: u32,
    /// All its functions and statics, the largest first.
    symbols: Vec<Symbol>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let cores = cores(&arguments.cores)?;
    let mut budgets = Budgets::load()?;
    let scenes: Vec<_> = SCENES
        .into_iter()
        .filter(|&scene| scene != SPOT || std::env::var_os("RASTERIZER_MODELS").is_some())
        .collect();
    let progress = Progress::over(cores.len() * Level::ALL.len() * (1 + scenes.len()));
    let mut all = Vec::new();
    for &core in &cores {
        for level in Level::ALL {
            progress.say(format!("building for {} at opt-level {}", core.title(), level.name()));
            let programs: Vec<_> = scenes.iter().map(|scene| program(scene)).collect();
            let names: Vec<_> = programs.iter().map(String::as_str).collect();
            let directory = firmware::build_all(core, &names, Some(level.name()))?;
            progress.step();
            for (&scene, name) in scenes.iter().zip(&names) {
                progress.say(format!("{scene} on {}", core.title()));
                all.push(measure(core, level, scene, &directory.join(name))?);
                progress.step();
            }
        }
    }
    drop(progress);
    check_pictures(&all)?;
    check_stack(&all)?;
    all.retain(|measured| measured.scene != DEEP);

    let compiler = firmware::compiler_version(cores[0])?;
    if arguments.save {
        for measured in &all {
            budgets.set(measured.core, measured.level, measured.scene, measured.bytes);
        }
        budgets.set_compiler(&compiler);
        budgets.store()?;
    }
    Ok(Done {
        text: if arguments.json {
            report::json(&all, &budgets, &compiler, arguments.symbols)?
        } else {
            report::text(&all, &budgets, &compiler, arguments.symbols)
        },
        is_good: report::faults(&all, &budgets, &compiler).is_empty(),
    })
}

/// Those that were named, or both.
fn cores(named: &[Core]) -> Result<Vec<Core>> {
    let measured = [Core::M0plus, Core::M4];
    if let Some(other) = named.iter().find(|core| !measured.contains(core)) {
        bail!("sizes are measured on m0plus and m4, not on {}", other.name());
    }
    Ok(measured.into_iter().filter(|core| named.is_empty() || named.contains(core)).collect())
}

fn program(scene: &str) -> String {
    format!("size_{}", scene.replace('-', "_"))
}

fn measure(core: Core, level: Level, scene: &'static str, program: &Path) -> Result<Measured> {
    let file =
        fs::read(program).with_context(|| format!("{} cannot be read", program.display()))?;
    let image =
        Image::parse(&file).with_context(|| format!("{} cannot be measured", program.display()))?;
    let run = stack::run(core, program, &image)?;
    Ok(Measured {
        core,
        level,
        scene,
        bytes: Bytes {
            flash: image.code(),
            stack: run.stack,
            ram: image.static_bytes() + run.stack,
        },
        models: image.models,
        checksum: run.checksum,
        symbols: image.symbols,
    })
}

/// Whether every scene has drawn something, and the same on all cores at all levels.
fn check_pictures(all: &[Measured]) -> Result<()> {
    for measured in all {
        let Measured { scene, checksum, .. } = *measured;
        let place = || format!("{} at opt-level {}", measured.core.title(), measured.level.name());
        let is_blank = scene == EMPTY || scene == DEEP;
        ensure!(is_blank || checksum != 0, "{scene} draws nothing on {}", place());
        let other = all.iter().find(|other| other.scene == scene && other.checksum != checksum);
        if let Some(other) = other {
            bail!(
                "{scene} draws other pictures on {} than on {} at opt-level {}",
                place(),
                other.core.title(),
                other.level.name()
            );
        }
    }
    Ok(())
}

/// Whether an array of known size on the stack is measured as what it is, but for the words of a
/// call.
fn check_stack(all: &[Measured]) -> Result<()> {
    for deep in all.iter().filter(|measured| measured.scene == DEEP) {
        let is_base = |measured: &&Measured| {
            measured.scene == EMPTY && (measured.core, measured.level) == (deep.core, deep.level)
        };
        let base = all.iter().find(is_base).context("the runtime was not measured")?;
        let more = deep.bytes.stack.saturating_sub(base.bytes.stack);
        ensure!(
            (DEPTH..DEPTH + 64).contains(&more),
            "the measurement of the stack is out of order on {}: {DEPTH} bytes are measured as {more}",
            deep.core.title()
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn measured(scene: &'static str, level: Level, flash: u32, stack: u32) -> Measured {
        Measured {
            core: Core::M0plus,
            level,
            scene,
            bytes: Bytes { flash, stack, ram: stack + 100 },
            models: 24,
            checksum: 7,
            symbols: vec![],
        }
    }

    #[test]
    fn every_scene_has_its_program() {
        for scene in SCENES {
            let source =
                firmware::root().join(format!("tests/firmware/src/bin/{}.rs", program(scene)));
            assert!(source.is_file(), "{} is missing", source.display());
        }
    }

    #[test]
    fn a_wrong_measurement_of_the_stack_is_noticed() {
        let with = |stack| {
            check_stack(&[measured(EMPTY, Level::S, 0, 100), measured(DEEP, Level::S, 0, stack)])
        };
        assert!(with(100 + DEPTH).is_ok());
        assert!(with(100 + DEPTH + 40).is_ok());
        assert!(with(100).is_err());
        assert!(with(100 + DEPTH - 4).is_err());
        assert!(with(100 + 2 * DEPTH).is_err());
        assert!(check_stack(&[measured(DEEP, Level::S, 0, 5_000)]).is_err());
    }

    #[test]
    fn a_scene_that_draws_nothing_or_another_picture_is_noticed() {
        let cube = |level, checksum| Measured { checksum, ..measured("cube", level, 0, 0) };
        assert!(check_pictures(&[cube(Level::S, 7), cube(Level::Three, 7)]).is_ok());
        assert!(check_pictures(&[cube(Level::S, 7), cube(Level::Three, 8)]).is_err());
        assert!(check_pictures(&[cube(Level::S, 0)]).is_err());
    }

    #[test]
    fn only_cortex_m_is_measured() {
        assert_eq!(cores(&[]).unwrap(), [Core::M0plus, Core::M4]);
        assert_eq!(cores(&[Core::M4]).unwrap(), [Core::M4]);
        assert!(cores(&[Core::Riscv]).is_err());
    }
}
