//! The costs of renderers, measured.

use std::{collections::btree_map::Entry, path::PathBuf};

use anyhow::{Context as _, Result};
use host_tools::{
    model::write_atomically,
    plan::{self, Cost, Costs, Load, Types},
};
use indicatif::ProgressBar;

use super::{
    bodies::Bodies,
    fit::fit,
    program::{self, Measured},
};
use crate::{cores::Core, cycles::Timing, firmware, plugin::Plugin, size};

/// How well the weights fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residual {
    /// The root of the mean square of relative errors of frames.
    pub(super) rms: f64,
    pub(super) most: f64,
}

/// Measures the costs of types on a core. Those that `known` has are not measured again.
///
/// # Errors
///
/// Returns an error if a program cannot be built or run, or costs cannot be saved.
pub(super) fn costs(
    (core, named): (Core, plan::Core),
    types: &[Types],
    known: &mut Costs,
    save: impl Fn(&Costs) -> Result<()>,
    progress: &ProgressBar,
) -> Result<Vec<(Types, Residual)>> {
    let (bench, mut residuals) = (Bench::new(core, named)?, Vec::new());
    known.compiler = firmware::compiler_version(core)?;
    for types in types {
        progress.inc(1);
        progress.set_message(format!("{types} on {}", core.title()));
        let costs = known.cores.entry(named.name().to_owned()).or_default();
        if let Entry::Vacant(entry) = costs.entry(types.to_string()) {
            let (cost, residual) = bench.cost(types)?;
            entry.insert(cost);
            residuals.push((*types, residual));
            save(known)?;
        }
    }
    Ok(residuals)
}

/// The parts of a load.
const N: usize = Load::PARTS.len();

/// A frame: what there is in it, and its cycles.
type Frame = ([f64; N], f64);

/// A core, and what is drawn on it.
struct Bench {
    core: Core,
    plugin: Plugin,
    timing: Timing,
    /// Flash and stack of a program that draws nothing.
    runtime: [u32; 2],
    bodies: Bodies,
    folder: PathBuf,
}

impl Bench {
    fn new(core: Core, named: plan::Core) -> Result<Self> {
        let folder = super::folder()?;
        Ok(Self {
            core,
            plugin: Plugin::build(core)?,
            timing: Timing::of(core).context("the core has no table of its timing")?,
            runtime: size::runtime(core)?,
            bodies: Bodies::new(&folder.join("bodies"), named)?,
            folder,
        })
    }

    /// Builds and measures a program.
    fn run(&self, source: &str) -> Result<Measured> {
        let file = self.folder.join("calibration.rs");
        write_atomically(&file, source)?;
        program::run((self.core, &self.plugin, &self.timing), &file)
    }

    /// Measures one renderer with all bodies.
    fn cost(&self, types: &Types) -> Result<(Cost, Residual)> {
        let (mut frames, mut flash, mut stack) = (Vec::new(), 0, 0);
        for (study, rows) in self.bodies.of(types) {
            let model = study.model(types)?;
            let measured = self.run(&program::source(study, &study.source(types, rows)?)?)?;
            let [own_flash, own_stack] = self.runtime;
            let tables = model.report.flash.total() as u32;
            flash = flash.max(measured.flash.saturating_sub(own_flash + tables));
            stack = stack.max(measured.stack.saturating_sub(own_stack));
            let loads = study.loads(&model, types, rows).into_iter().map(|load| load.0);
            frames.extend(loads.zip(measured.cycles.iter().map(|&cycles| cycles as f64)));
        }
        let cost = Cost { flash_bytes: flash, stack_bytes: stack, cycles: fit(&frames) };
        Ok((cost, residual(&frames, &cost)))
    }
}

fn residual(frames: &[Frame], cost: &Cost) -> Residual {
    let errors = frames.iter().map(|&(load, cycles)| cost.cycles_of(&Load(load)) / cycles - 1.0);
    let squares: f64 = errors.clone().map(|error| error * error).sum();
    Residual {
        rms: (squares / frames.len().max(1) as f64).sqrt(),
        most: errors.map(f64::abs).fold(0.0, f64::max),
    }
}
