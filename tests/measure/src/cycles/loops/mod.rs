//! Loops whose cycles were counted by hand, from the manuals: tests of the plugin and the tables.

mod image;
mod riscv;
mod thumb;

use std::fs;

use anyhow::{Context as _, Result};

use super::timing::{MISS, Timing};
use crate::{
    Done,
    cores::Core,
    counts::Counts,
    figures::count,
    firmware,
    plugin::Plugin,
    table::{Column, Table},
};

/// A loop, and what was counted by hand.
#[derive(Clone, Copy, Debug)]
struct Loop {
    name: &'static str,
    /// Its instructions, in halfwords.
    code: &'static [u16],
    instructions: u64,
    /// Cycles in each model of a core's timing. A core that is not among these lacks instructions.
    cycles: &'static [(Core, &'static [u64])],
}

impl Loop {
    /// All that run on a core.
    fn of(core: Core) -> impl Iterator<Item = (&'static Self, &'static [u64])> {
        let all = if core == Core::Riscv { riscv::LOOPS } else { thumb::LOOPS };
        all.iter().filter_map(move |code| {
            let by_hand = code.cycles.iter().find(|(of, _)| *of == core)?;
            Some((code, by_hand.1))
        })
    }
}

/// A loop on a core: its instructions, and its cycles in each model.
struct Row {
    core: Core,
    name: &'static str,
    by_hand: Vec<u64>,
    counted: Vec<u64>,
}

impl Row {
    fn is_equal(&self) -> bool {
        self.by_hand == self.counted
    }
}

/// Runs all loops on the cores, and compares.
pub(super) fn run(cores: &[Core]) -> Result<Done> {
    let mut rows = Vec::new();
    for &core in cores {
        let plugin = Plugin::build(core)?;
        for (code, by_hand) in Loop::of(core) {
            let counts = counted(core, &plugin, code)
                .with_context(|| format!("{} on {}", code.name, core.title()))?;
            rows.push(compare(core, code, by_hand, &counts));
        }
    }
    let columns: [Column<&Row>; 6] = [
        ("core", |row| row.core.facts().name.into()),
        ("loop", |row| row.name.into()),
        ("", |row| if row.is_equal() { "equal" } else { "DIFFERENT" }.into()),
        ("instructions", |row| count(row.counted[0])),
        ("cycles by hand", |row| cycles(&row.by_hand)),
        ("cycles counted", |row| cycles(&row.counted)),
    ];
    let is_good = rows.iter().all(Row::is_equal);
    let models = "Cycles are in the models of RESULTS.md, in the order of its columns.\n\n";
    Ok(Done { text: format!("{models}{}", Table::of(3, &columns, &rows)), is_good })
}

/// All but the instructions.
fn cycles(figures: &[u64]) -> String {
    figures[1..].iter().map(|&figure| count(figure)).collect::<Vec<_>>().join(" / ")
}

fn counted(core: Core, plugin: &Plugin, code: &Loop) -> Result<Counts> {
    let image = image::of(core, code.code);
    let path = firmware::target_directory().join("loop.bin");
    fs::write(&path, image.bytes).with_context(|| path.display().to_string())?;
    let loaded_by = image::loaded_by(core, &path);
    let arguments = loaded_by.each_ref().map(AsRef::as_ref);
    let output = plugin.run_with(&path, image.marks, &arguments)?;
    let report = output.reports.first().context("the loop has not come to its end")?;
    Ok(report.clear)
}

/// Compares a loop with what was counted by hand. Memory is in no model of it.
fn compare(core: Core, code: &Loop, by_hand: &[u64], counts: &Counts) -> Row {
    let mut counted = vec![counts.instructions];
    if let Some(timing) = Timing::of(core) {
        let models = timing.models.iter().enumerate().filter(|(_, model)| !model.is_in_flash);
        counted.extend(models.map(|(index, _)| timing.cycles(index, counts, MISS)));
    }
    let by_hand = [&[code.instructions], by_hand].concat();
    Row { core, name: code.name, by_hand, counted }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_core_with_a_table_has_loops_counted_in_each_of_its_models() {
        for core in Core::or_all(&[]) {
            let models = Timing::of(core).map_or(0, |timing| {
                timing.models.iter().filter(|model| !model.is_in_flash).count()
            });
            let loops: Vec<_> = Loop::of(core).collect();
            assert!(loops.len() >= if models == 0 { 0 } else { 5 }, "{core:?}");
            for (code, by_hand) in loops {
                assert_eq!(by_hand.len(), models, "{} on {core:?}", code.name);
            }
        }
    }

    #[test]
    fn a_difference_is_found() {
        let (code, by_hand) = Loop::of(Core::M4).next().unwrap();
        let row = |instructions, taken| {
            let counts = Counts { instructions, taken, ..Counts::default() };
            compare(Core::M4, code, by_hand, &counts)
        };
        assert!(row(201, 99).is_equal());
        assert_eq!(row(201, 99).counted, [201, 399, 300, 498]);
        assert!(!row(201, 98).is_equal());
        assert!(!row(200, 99).is_equal());
    }
}
