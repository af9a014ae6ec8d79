//! The cycles of the bench scenes as tables and as JSON.

use anyhow::Result;
use serde::Serialize;

use super::timing::{MISS, Timing};
use crate::{
    cores::Core,
    figures::{self, count},
    speed::{Parts, Scene, Scenes, Speed},
    table::Table,
};

const TITLE: &str = "Cycles";

/// Explains the columns, in Markdown.
const LEGEND: &str = "\
Cycles for a frame of the scenes above. They are a model, not a measurement: a plugin for QEMU
counts the executed instructions by what their timing depends on, exactly, and a table of the core
says what each takes. The tables below have the source of each of their rows. `measure cycles
--test` counts loops that were also counted by hand. No board has been measured yet:
[BOARDS.md](BOARDS.md) says how to.

*CPI* is cycles for an instruction, */ pixel* cycles for a pixel that the finished frame covers;
*clear* to *pixels* are the parts of *cycles*. *least* and *most* are the ends of what the tables
leave open. On the Cortex-M4 *cycles* refills the pipeline in P = 2 cycles after a jump and divides
in 3, *least* is P = 1, 2 for a division and none for IT, *most* is P = 3 and 12 for a division. The
figures of the Cortex-M33 are rough: ARM publishes no table, and the rules are what one person
measured on one chip. *multiply in 32* is a Cortex-M0+ with the small multiplier. *RP2040, flash*
has code and tables in flash behind the chip's cache (16 KB, two ways, lines of 8 bytes, the one
used longest ago is replaced; a miss takes 60 cycles, or `--miss-cycles`). RV32IMC is timed as
Hazard3.

Not in the model: wait states of flash, and its caches but the RP2040's; waiting for memory that DMA
or another core uses; interrupts; instructions that depend on each other across the end of a block
that is not a jump. An instruction behind IT counts as if its condition held. A Cortex-M7 issues
pairs of instructions by rules that nobody has published, so it has no figures here.";

/// The section of `RESULTS.md`.
pub(crate) fn section(speed: &Speed) -> String {
    format!("## {TITLE}\n\n{LEGEND}\n\n{}", tables(speed, MISS))
}

/// The cycles, and the timing table, of each core that has one.
pub(super) fn tables(speed: &Speed, miss: u64) -> String {
    let text = speed.cores.iter().filter_map(|measured| {
        let timing = Timing::of(measured.core)?;
        let note = format!("{}, {}.", measured.conditions.date, measured.conditions);
        let tables = [
            ("", scenes(&timing, &measured.figures, miss)),
            ("Cycles beyond the one that each instruction takes", rows(&timing)),
        ];
        Some(figures::of_core(measured.core, &note, &tables))
    });
    text.collect::<Vec<_>>().join("\n")
}

fn scenes(timing: &Timing, scenes: &Scenes, miss: u64) -> Table {
    let models = timing.models.iter().map(|model| model.name);
    let headings: Vec<_> = ["scene", "bits", "mode"]
        .into_iter()
        .chain(models)
        .chain(["CPI", "/ pixel", "clear", "vertices", "set-up", "pixels"])
        .collect();
    let mut table = Table::new(3, &headings);
    for scene in &scenes.scenes {
        let key = &scene.key;
        let all = models_of(timing, scene, miss);
        let (cycles, instructions) = (all[0], scene.instructions());
        let per = |items: u64| cycles.frame as f64 / items.max(1) as f64;
        let parts = [Some(cycles.clear), Some(cycles.vertices), cycles.set_up, Some(cycles.pixels)];
        let words = [&key.scene, &key.precision, &key.mode].map(String::clone).into_iter();
        table.row(
            words
                .chain(all.iter().map(|parts| count(parts.frame)))
                .chain([
                    format!("{:.2}", per(instructions.frame)),
                    format!("{:.1}", per(scene.pixels_drawn)),
                ])
                .chain(parts.map(|part| part.map_or_else(String::new, count))),
        );
    }
    table
}

/// The cycles of a scene in each model.
fn models_of(timing: &Timing, scene: &Scene, miss: u64) -> Vec<Parts> {
    (0..timing.models.len()).map(|model| scene.cycles(timing, model, miss)).collect()
}

/// The timing table itself.
fn rows(timing: &Timing) -> Table {
    let models = timing.models.iter().map(|model| model.name);
    let headings: Vec<_> = ["what", "source"].into_iter().chain(models).collect();
    let mut table = Table::new(2, &headings);
    for row in timing.rows {
        let words = [row.what, row.source].map(str::to_owned).into_iter();
        table.row(words.chain(row.more.iter().map(|more| format!("{more:+}"))));
    }
    table
}

/// A scene of a core, for programs.
#[derive(Serialize)]
struct Row<'a> {
    core: Core,
    /// The sums of its frames.
    #[serde(flatten)]
    scene: &'a Scene,
    /// Means over the frames.
    instructions: Parts,
    models: Vec<Model>,
}

#[derive(Serialize)]
struct Model {
    name: &'static str,
    cycles: Parts,
}

/// All counts and cycles, as an array with an object for each scene of each core.
pub(super) fn json(speed: &Speed, miss: u64) -> Result<String> {
    let mut rows = Vec::new();
    for measured in &speed.cores {
        let core = measured.core;
        for scene in &measured.figures.scenes {
            let models = Timing::of(core).map_or_else(Vec::new, |timing| {
                let all = models_of(&timing, scene, miss).into_iter();
                let models = timing.models.iter().zip(all);
                models.map(|(model, cycles)| Model { name: model.name, cycles }).collect()
            });
            rows.push(Row { core, scene, instructions: scene.instructions(), models });
        }
    }
    Ok(serde_json::to_string_pretty(&rows)? + "\n")
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::speed::tests::{cells, speed};

    /// 100,000 instructions, of which ten thousand are loads and one thousand miss a cache.
    fn loads(core: Core) -> Speed {
        let mut speed = speed(core, "cube", 100_000);
        let draw = &mut speed.cores[0].figures.scenes[0].draw;
        (draw.loads, draw.data_misses) = (10_000, 1_000);
        speed
    }

    #[test]
    fn a_table_has_the_models_and_the_parts() {
        let text = tables(&loads(Core::M0plus), 60);
        let row = text.lines().find(|line| line.starts_with("| cube")).unwrap();
        let expected = [
            "cube", "S4", "whole", "110,000", "110,000", "170,000", "1.10", "22.0", "0", "1,000",
            "2,000", "107,000",
        ];
        assert_eq!(cells(row), expected);
        assert!(text.contains("| loads and stores of one register: 2"), "{text}");
        // No table, no section.
        assert_eq!(tables(&loads(Core::M7), 60), "");
    }

    #[test]
    fn the_cost_of_a_miss_is_a_parameter() {
        let rows: Value = serde_json::from_str(&json(&loads(Core::M0plus), 1).unwrap()).unwrap();
        let row = &rows[0];
        assert_eq!((&row["core"], &row["scene"]), (&"m0plus".into(), &"cube".into()));
        assert_eq!(row["draw"]["loads"], 10_000);
        assert_eq!(row["instructions"]["frame"], 100_000);
        assert_eq!(row["models"][2]["name"], "RP2040, flash");
        assert_eq!(row["models"][2]["cycles"]["frame"], 111_000);
    }
}
