//! The command `size`: measures the flash, stack and RAM of scenes, and compares them with budgets.

mod budgets;
pub(crate) mod image;
mod report;
pub(crate) mod stack;
mod unwanted;

use std::{collections::BTreeSet, env, fs, path::Path};

use anyhow::{Context as _, Result, bail, ensure};
use clap::{
    Args, ValueEnum as _,
    builder::{PossibleValuesParser, TypedValueParser},
};
use serde::{Deserialize, Serialize};

use self::{
    budgets::{Budgets, Bytes, Kind},
    image::{Image, Symbol},
    report::Report,
};
use crate::{Done, cores::Core, firmware, progress};

const EXAMPLES: &str = "\
Examples:
  measure size                      Cortex-M0+ and Cortex-M4
  measure size m0plus --symbols     With the largest functions of each scene
  measure size --save               Sets the budgets to what is measured

Exit status: 0 if all scenes are within their budgets (which count only for the compiler that they
were saved with) and none brings unwanted code, 1 if not, 2 for bad usage or if something is
missing.";

/// Measure flash, stack and RAM of scenes, and compare them with their budgets
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores [default: m0plus and m4]
    #[arg(value_name = "CORE", value_parser = core(), default_values = ["m0plus", "m4"])]
    #[arg(hide_default_value = true)]
    cores: Vec<Core>,
    /// List the ten largest symbols of each scene
    #[arg(long)]
    symbols: bool,
    /// Set the budgets to what is measured, rounded up a little
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
/// The scene with a model that does not come with the project.
const SPOT: &str = "spot";

/// What a scene takes.
#[derive(Clone, Debug)]
struct Measured {
    core: Core,
    opt_level: Level,
    scene: String,
    bytes: Bytes,
    /// Bytes of flash for tables of models, which are not in `bytes`.
    models: u32,
    /// The checksum of its pictures.
    checksum: u32,
    /// Its functions and statics, the largest first.
    symbols: Vec<Symbol>,
}

impl Measured {
    /// Where it was measured, for messages.
    fn place(&self) -> String {
        format!("{} at opt-level {}", self.core.title(), self.opt_level.name())
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let cores = Core::or_all(&arguments.cores);
    let mut budgets = Budgets::load()?;
    let scenes = scenes()?;
    let names: Vec<_> = scenes.iter().map(String::as_str).collect();
    let progress = progress::over(Level::ALL.len() * (1 + cores.len() * scenes.len()));
    let mut all = Vec::new();
    for level in Level::ALL {
        progress.set_message(format!("building at opt-level {}", level.name()));
        firmware::build_scenes(&cores, &names, level.name())?;
        progress.inc(1);
        for &core in &cores {
            let directory = firmware::scenes(core)?;
            for name in &names {
                progress.set_message(format!("{name} on {}", core.title()));
                all.push(measure(core, level, &name.replace('_', "-"), &directory.join(name))?);
                progress.inc(1);
            }
        }
    }
    drop(progress);
    check_pictures(&all)?;
    check_stack(&all)?;
    all.retain(|measured| measured.scene != DEEP);
    all.sort_by_key(|measured| (measured.core, measured.opt_level, measured.bytes[&Kind::Flash]));

    let compiler = firmware::compiler_version(cores[0])?;
    if arguments.save {
        for measured in &all {
            let Measured { core, opt_level, scene, bytes, .. } = measured;
            budgets.set(*core, *opt_level, scene, bytes);
        }
        budgets.compiler.clone_from(&compiler);
        budgets.store()?;
    }
    let report = Report::new(&all, &budgets, &compiler);
    Ok(Done { text: report.text(arguments.symbols), is_good: report.faults.is_empty() })
}

/// The bytes of flash and of stack that a program takes which draws nothing.
///
/// # Errors
///
/// Returns an error if it cannot be built or run.
pub(crate) fn runtime(core: Core) -> Result<[u32; 2]> {
    firmware::build_scenes(&[core], &[EMPTY], Level::Three.name())?;
    let measured = measure(core, Level::Three, EMPTY, &firmware::scenes(core)?.join(EMPTY))?;
    Ok([Kind::Flash, Kind::Stack].map(|kind| measured.bytes[&kind]))
}

/// Accepts the cores that the scenes can be built for.
fn core() -> impl TypedValueParser<Value = Core> {
    PossibleValuesParser::new(["m0plus", "m4"]).try_map(|name| Core::from_str(&name, false))
}

/// Returns the programs of the scenes. Each is an example of the firmware.
fn scenes() -> Result<BTreeSet<String>> {
    let folder = firmware::root().join("tests/firmware/examples");
    let files = fs::read_dir(&folder).with_context(|| folder.display().to_string())?;
    let mut scenes = BTreeSet::new();
    for file in files {
        let path = file?.path();
        scenes.extend(path.file_stem().map(|name| name.to_string_lossy().into_owned()));
    }
    if env::var_os("RASTERIZER_MODELS").is_none() {
        scenes.remove(SPOT);
    }
    Ok(scenes)
}

fn measure(core: Core, level: Level, scene: &str, program: &Path) -> Result<Measured> {
    let file =
        fs::read(program).with_context(|| format!("{} cannot be read", program.display()))?;
    let image =
        Image::parse(&file).with_context(|| format!("{} cannot be measured", program.display()))?;
    let run = stack::run(core, program, &image)?;
    Ok(Measured {
        core,
        opt_level: level,
        scene: scene.to_owned(),
        bytes: Bytes::from([
            (Kind::Flash, image.code()),
            (Kind::Stack, run.stack),
            (Kind::Ram, image.static_bytes() + run.stack),
        ]),
        models: image.models,
        checksum: run.checksum,
        symbols: image.symbols,
    })
}

/// Checks that every scene draws something, and the same on all cores at all levels.
fn check_pictures(all: &[Measured]) -> Result<()> {
    for measured in all {
        let Measured { scene, checksum, .. } = measured;
        let is_blank = scene == EMPTY || scene == DEEP;
        ensure!(is_blank || *checksum != 0, "{scene} draws nothing on {}", measured.place());
        let other = all.iter().find(|other| other.scene == *scene && other.checksum != *checksum);
        if let Some(other) = other {
            bail!("{scene} draws other pictures on {} than on {}", measured.place(), other.place());
        }
    }
    Ok(())
}

/// Checks that an array of known size on the stack is measured correctly, up to the words of a
/// call.
fn check_stack(all: &[Measured]) -> Result<()> {
    for deep in all.iter().filter(|measured| measured.scene == DEEP) {
        let is_base =
            |measured: &&Measured| measured.scene == EMPTY && measured.place() == deep.place();
        let base = all.iter().find(is_base).context("the runtime was not measured")?;
        let more = deep.bytes[&Kind::Stack].saturating_sub(base.bytes[&Kind::Stack]);
        ensure!(
            (DEPTH..DEPTH + 64).contains(&more),
            "the measurement of the stack is wrong on {}: {DEPTH} bytes are measured as {more}",
            deep.place()
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{budgets::tests::bytes, *};

    pub(super) fn measured(scene: &str, level: Level, flash: u32, stack: u32) -> Measured {
        Measured {
            core: Core::M0plus,
            opt_level: level,
            scene: scene.into(),
            bytes: bytes(flash, stack, stack + 100),
            models: 24,
            checksum: 7,
            symbols: vec![],
        }
    }

    #[test]
    fn every_scene_has_a_budget() {
        let (scenes, budgets) = (scenes().unwrap(), Budgets::load().unwrap());
        assert!(scenes.contains(EMPTY) && scenes.contains(DEEP));
        for scene in scenes.iter().filter(|scene| *scene != DEEP) {
            let scene = scene.replace('_', "-");
            assert!(budgets.of(Core::M4, Level::S, &scene).is_some(), "{scene} has no budget");
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
}
