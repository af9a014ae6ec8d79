//! Cycles of stiff problems on a core.

use anyhow::{Context as _, Result, ensure};
use host_tools::{
    model::write_atomically,
    stiffness::{Curve, Family, Work},
};

use super::program;
use crate::{cores::Core, cycles::Timing, firmware, plugin::Plugin, report};

/// The cycles of an instance, in the mean, for each point of a family's curve; `None` where the
/// core refuses all of them or they are not measured.
pub(super) type Cycles = Vec<Option<f64>>;

/// Measures the points of all families on a core.
///
/// # Errors
///
/// Returns an error if the program cannot be built or run.
pub(super) fn of<'a>(
    core: Core,
    measured: impl Iterator<Item = (&'a Family, &'a Curve)>,
) -> Result<Vec<Cycles>> {
    let name = core.title();
    let timing = Timing::of(core).with_context(|| format!("{name}: no table of its timing"))?;
    let works: Vec<Vec<Vec<Work>>> = measured
        .map(|(family, curve)| {
            curve.points.iter().map(|point| family.cost.work(point.parameter)).collect()
        })
        .collect();
    let solved: Vec<_> = works.iter().flatten().filter(|works| !works.is_empty()).collect();
    let file = report::folder()?.join("stiff.rs");
    write_atomically(&file, program::source(solved.iter().map(|works| works.as_slice())))?;
    let output = Plugin::build(core)?.run(&firmware::build_stiff(core, &file)?)?;
    let (points, reports) = (solved.len(), output.reports.len());
    ensure!(points == reports, "{name}: {reports} of {points} points were solved: {output:?}");
    let mut reports = output.reports.iter();
    let mut cycles = |works: &Vec<Work>| {
        let stages = if works.is_empty() { None } else { reports.next() }?;
        let counted = match works.first() {
            Some(Work::Place(_)) => &stages.vertices,
            _ => &stages.draw,
        };
        let [_, cycles, _] = timing.range(counted);
        Some(cycles as f64 / works.len() as f64)
    };
    Ok(works.iter().map(|points| points.iter().map(&mut cycles).collect()).collect())
}
