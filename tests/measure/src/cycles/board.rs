//! Compares the cycles that a board has counted with the model.

use std::{fs, path::Path};

use anyhow::{Context as _, Result, ensure};

use super::timing::Timing;
use crate::{
    Done,
    cores::Core,
    cost::{self, Line},
    counts::Counts,
    figures::count,
    firmware,
    plugin::Plugin,
    speed::Key,
    table::{Column, Table},
};

/// The program that a board runs.
const PROGRAM: &str = "bench_board";

/// A stage of a scene: means over its frames.
struct Row<'a> {
    key: &'a Key,
    stage: &'static str,
    board: u64,
    /// In each model of the core.
    models: Vec<u64>,
}

/// Runs the same program under the plugin, and compares with what a board has printed.
pub(super) fn run(core: Core, timing: &Timing, printed: &Path, miss: u64) -> Result<Done> {
    let name = printed.display();
    let text = fs::read_to_string(printed).with_context(|| name.to_string())?;
    // What the program that reads the board prints beside them is of no interest.
    let lines = text.lines().map(str::trim).filter(|line| line.starts_with('{'));
    let board: Vec<Line<Key>> = lines.map(cost::line).collect::<Result<_>>()?;
    ensure!(!board.is_empty(), "{name} has no line of {PROGRAM}: each begins with `{{\"scene\":`");
    let output = Plugin::build(core)?.run(&firmware::build(core, PROGRAM)?)?;
    let rows = rows(timing, &board, &cost::lines(&output)?, miss)?;
    Ok(Done { text: table(timing, &rows).to_string(), is_good: true })
}

fn rows<'a>(
    timing: &Timing,
    board: &'a [Line<Key>],
    model: &[Line<Key>],
    miss: u64,
) -> Result<Vec<Row<'a>>> {
    let mut rows = Vec::new();
    for Line { key, cost, .. } in board {
        let counted = model.iter().find(|line| line.key == *key);
        let stages = counted
            .with_context(|| {
                let Key { scene, precision, mode } = key;
                format!(
                    "the board has drawn {scene} in {precision} in {mode}, which the program built \
                     here does not: does RASTERIZER_MODELS name the same folder?"
                )
            })?
            .stages;
        let in_models = |counts: &Counts| {
            let models = 0..timing.models.len();
            models.map(|model| cost.mean(timing.cycles(model, counts, miss))).collect()
        };
        for (stage, sum, counts) in [
            ("clear", cost.clear, &stages.clear),
            ("vertices", cost.vertices, &stages.vertices),
            ("draw", cost.draw, &stages.draw),
        ] {
            rows.push(Row { key, stage, board: cost.mean(sum), models: in_models(counts) });
        }
    }
    Ok(rows)
}

fn table(timing: &Timing, rows: &[Row<'_>]) -> Table {
    let words: [Column<&Row<'_>>; 4] = [
        ("scene", |row| row.key.scene.clone()),
        ("bits", |row| row.key.precision.clone()),
        ("mode", |row| row.key.mode.clone()),
        ("stage", |row| row.stage.into()),
    ];
    let headings = words.iter().map(|(heading, _)| *heading).chain(["board"]);
    let models = timing.models.iter().map(|model| model.name);
    let headings: Vec<_> = headings.chain(models).chain(["board / cycles"]).collect();
    let mut table = Table::new(words.len(), &headings);
    for row in rows {
        let share = row.board as f64 / row.models[0].max(1) as f64;
        let words = words.iter().map(|(_, cell)| cell(&row));
        let figures = [row.board].into_iter().chain(row.models.iter().copied()).map(count);
        table.row(words.chain(figures).chain([format!("{share:.3}")]));
    }
    table
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::{cost::tests::output, speed::tests::cells};

    #[test]
    fn stages_of_the_same_scene_are_compared() {
        let key = |scene: &str| json!({ "scene": scene, "precision": "S4", "mode": "bands of 16" });
        let timing = Timing::of(Core::M4).unwrap();
        let line = |scene, draw| cost::lines(&output(key(scene), 8, 80, draw)).unwrap();
        let mut board = line("cube", 1);
        (board[0].cost.clear, board[0].cost.vertices, board[0].cost.draw) = (16, 80, 1_200);
        let rows = rows(&timing, &board, &line("cube", 800), 0).unwrap();
        let text = table(&timing, &rows).to_string();
        let draw = text.lines().last().unwrap();
        let expected = ["cube", "S4", "bands of 16", "draw", "150", "100", "100", "100", "1.500"];
        assert_eq!(cells(draw), expected);
        let other = super::rows(&timing, &board, &line("ball", 800), 0).err().unwrap();
        assert!(other.to_string().contains("cube in S4"));
    }
}
