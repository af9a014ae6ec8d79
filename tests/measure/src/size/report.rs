//! What is said about sizes: tables, JSON, and what is wrong.

use std::{collections::BTreeMap, fmt::Write as _};

use anyhow::Result;
use host_tools::model::thousands;
use serde_json::{Value, json};

use super::{
    Level, Measured,
    budgets::{Budgets, Kind},
    image::Symbol,
    unwanted::Unwanted,
};
use crate::{cores::Core, table::Table};

/// How many symbols of a scene are listed.
const LISTED: usize = 10;

/// Tables, one for each core, and what is wrong.
pub(super) fn text(
    all: &[Measured],
    budgets: &Budgets,
    compiler: &str,
    with_symbols: bool,
) -> String {
    let mut text = String::new();
    for core in Core::ALL {
        let of_core: Vec<_> = all.iter().filter(|measured| measured.core == core).collect();
        if of_core.is_empty() {
            continue;
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}, {compiler}", core.title());
        text += &table(&of_core, budgets).aligned();
        text.push('\n');
    }
    text += "Bytes. Flash is without the tables of models, which have their column; RAM is statics and stack. All scenes \
             have what `empty` has.\n";
    if compiler != budgets.compiler() {
        let _ = writeln!(
            text,
            "The budgets are those of {}: another compiler makes other code, and what is over them is no fault.",
            budgets.compiler()
        );
    }
    if with_symbols {
        for measured in all {
            text += &symbols(measured);
        }
    }
    for goal in missed_goals(all, budgets) {
        let _ = writeln!(text, "goal not met: {goal}");
    }
    for tolerated in unwanted(all, |name| budgets.tolerates(name)) {
        let _ = writeln!(text, "tolerated: {tolerated}");
    }
    for fault in faults(all, budgets, compiler) {
        let _ = writeln!(text, "fault: {fault}");
    }
    text
}

fn table(of_core: &[&Measured], budgets: &Budgets) -> Table {
    let mut table = Table::new(
        2,
        &[
            "scene",
            "opt-level",
            "flash",
            "budget",
            "goal",
            "stack",
            "budget",
            "goal",
            "RAM",
            "budget",
            "goal",
            "models",
        ],
    );
    for measured in of_core {
        let Measured { core, level, scene, .. } = **measured;
        let budget = budgets.of(core, level, scene);
        let mut cells = vec![scene.to_owned(), level.name().to_owned()];
        for kind in Kind::ALL {
            let taken = kind.of(&measured.bytes);
            let is_over = budget.is_some_and(|budget| taken > kind.of(budget));
            cells.push(number(taken) + if is_over { "!" } else { "" });
            cells.push(budget.map_or("-".into(), |budget| number(kind.of(budget))));
            cells.push(budgets.goal(core, scene, kind).map_or(String::new(), |goal| {
                let mark = if taken <= goal { " yes" } else { " no" };
                number(goal) + mark
            }));
        }
        cells.push(number(measured.models));
        table.row(cells);
    }
    table
}

/// What a scene takes at the better of the levels.
fn best(of_core: &[&Measured], scene: &str, kind: Kind) -> u32 {
    let of_scene = of_core.iter().filter(|measured| measured.scene == scene);
    of_scene.map(|measured| kind.of(&measured.bytes)).min().unwrap_or(0)
}

/// The goals that are not met, each with what is missing.
fn missed_goals(all: &[Measured], budgets: &Budgets) -> Vec<String> {
    let mut missed = Vec::new();
    for core in Core::ALL {
        let of_core: Vec<_> = all.iter().filter(|measured| measured.core == core).collect();
        // Each scene once.
        for measured in of_core.iter().filter(|measured| measured.level == Level::S) {
            for kind in Kind::ALL {
                let taken = best(&of_core, measured.scene, kind);
                match budgets.goal(core, measured.scene, kind) {
                    Some(goal) if taken > goal => missed.push(format!(
                        "{} on {}: {} bytes of {} are {} more than {}",
                        measured.scene,
                        core.title(),
                        number(taken),
                        kind.name(),
                        number(taken - goal),
                        number(goal)
                    )),
                    _ => {}
                }
            }
        }
    }
    missed
}

/// What is wrong: scenes over their budget, if it is for this compiler's code, or without one, and
/// code that no scene may bring.
pub(super) fn faults(all: &[Measured], budgets: &Budgets, compiler: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let is_comparable = compiler == budgets.compiler();
    for measured in all {
        let Measured { core, level, scene, .. } = *measured;
        let place = format!("{scene} on {} at opt-level {}", core.title(), level.name());
        match budgets.of(core, level, scene) {
            Some(_) if !is_comparable => {}
            Some(budget) => faults.extend(measured.bytes.over(budget).into_iter().map(|kind| {
                let (taken, budget) = (kind.of(&measured.bytes), kind.of(budget));
                format!(
                    "{place}: {} bytes of {} are over the budget of {}",
                    number(taken),
                    kind.name(),
                    number(budget)
                )
            })),
            None => faults.push(format!("{place} has no budget: give it one by --save")),
        }
    }
    faults.extend(unwanted(all, |name| !budgets.tolerates(name)));
    faults
}

/// The symbols of code that no scene may bring, as far as they are asked for, each with the scenes
/// that bring it.
fn unwanted(all: &[Measured], is_asked_for: impl Fn(&str) -> bool) -> Vec<String> {
    let mut scenes = BTreeMap::<_, Vec<&str>>::new();
    for measured in all {
        let names = measured.symbols.iter().map(|symbol| symbol.name.as_str());
        for name in names.filter(|&name| is_asked_for(name)) {
            if let Some(unwanted) = Unwanted::of(name) {
                let place = (measured.core, measured.level, unwanted, name);
                scenes.entry(place).or_default().push(measured.scene);
            }
        }
    }
    let line =
        |((core, level, unwanted, name), scenes): ((Core, Level, Unwanted, &str), Vec<&str>)| {
            format!(
                "{unwanted} on {} at opt-level {}: {name} in {}",
                core.title(),
                level.name(),
                scenes.join(", ")
            )
        };
    scenes.into_iter().map(line).collect()
}

fn symbols(measured: &Measured) -> String {
    let mut text = format!(
        "\n{} on {} at opt-level {}\n",
        measured.scene,
        measured.core.title(),
        measured.level.name()
    );
    for Symbol { name, size, .. } in largest(measured) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:>8}  {}", number(*size), without_modules(name));
    }
    text
}

/// The largest functions and constants, without the tables of models.
fn largest(measured: &Measured) -> impl Iterator<Item = &Symbol> {
    let in_flash =
        measured.symbols.iter().filter(|symbol| symbol.is_in_flash && !symbol.is_of_a_model());
    in_flash.take(LISTED)
}

/// A name without the modules that lead to its parts, which in the name of a generic function are
/// many.
fn without_modules(name: &str) -> String {
    let mut short = String::new();
    for (number, part) in name.split("::").enumerate() {
        // The module that `::` follows is the word at the end; what stands before it stays.
        if number > 0 && (part.starts_with(['<', '{']) || short.ends_with('>')) {
            short += "::";
        } else if number > 0 {
            short.truncate(short.trim_end_matches(|c: char| c.is_alphanumeric() || c == '_').len());
        }
        short += part;
    }
    short
}

/// The same for programs to read.
pub(super) fn json(
    all: &[Measured],
    budgets: &Budgets,
    compiler: &str,
    with_symbols: bool,
) -> Result<String> {
    let scenes: Vec<Value> = all
        .iter()
        .map(|measured| {
            let mut scene = json!({
                "core": measured.core,
                "opt_level": measured.level,
                "scene": measured.scene,
                "flash": measured.bytes.flash,
                "stack": measured.bytes.stack,
                "ram": measured.bytes.ram,
                "models": measured.models,
                "checksum": format!("{:08x}", measured.checksum),
                "budget": budgets.of(measured.core, measured.level, measured.scene),
            });
            if with_symbols {
                let symbols = largest(measured)
                    .map(|symbol| json!({ "name": symbol.name, "size": symbol.size }));
                scene["symbols"] = symbols.collect();
            }
            scene
        })
        .collect();
    let (missed_goals, faults) = (missed_goals(all, budgets), faults(all, budgets, compiler));
    let report = json!({ "scenes": scenes, "missed_goals": missed_goals, "faults": faults });
    Ok(serde_json::to_string_pretty(&report)? + "\n")
}

fn number(bytes: u32) -> String {
    thousands(bytes as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size::{budgets::Bytes, tests::measured};

    fn budgets() -> Budgets {
        let goals = r#"{ "goals": [{ "core": "m0plus", "scene": "cube", "flash": 5000 }, { "core": "m0plus", "stack": 500 }],
            "tolerated": ["core::option::unwrap_failed"], "compiler": "rustc 1", "budgets": {} }"#;
        let mut budgets: Budgets = serde_json::from_str(goals).unwrap();
        let taken = Bytes { flash: 6_400, stack: 400, ram: 500 };
        budgets.set(Core::M0plus, Level::S, "cube", taken);
        budgets.set(Core::M0plus, Level::Three, "cube", taken);
        budgets
    }

    #[test]
    fn faults_are_what_is_over_its_budget_has_none_or_brings_unwanted_code() {
        let within = measured("cube", Level::S, 6_464, 400);
        assert_eq!(
            faults(std::slice::from_ref(&within), &budgets(), "rustc 1"),
            Vec::<String>::new()
        );
        let over = measured("cube", Level::S, 6_500, 400);
        assert_eq!(
            faults(std::slice::from_ref(&over), &budgets(), "rustc 1"),
            [
                "cube on Cortex-M0+ at opt-level s: 6,500 bytes of flash are over the budget of 6,464"
            ]
        );
        assert_eq!(faults(&[over], &budgets(), "rustc 2"), Vec::<String>::new());
        let unknown = faults(&[measured("ball", Level::S, 0, 0)], &budgets(), "rustc 1");
        assert!(unknown[0].contains("no budget"), "{unknown:?}");
        let heavy = Measured {
            symbols: ["__aeabi_fadd", "main", "core::option::unwrap_failed"]
                .map(|name| symbol(name, 8))
                .into(),
            ..within
        };
        assert!(
            text(std::slice::from_ref(&heavy), &budgets(), "", false).contains("tolerated: panics")
        );
        assert_eq!(
            faults(&[heavy], &budgets(), "rustc 1"),
            ["floating point on Cortex-M0+ at opt-level s: __aeabi_fadd in cube"]
        );
    }

    #[test]
    fn a_goal_is_met_at_the_better_level() {
        let at = |s, three| {
            let all =
                [measured("cube", Level::S, s, 400), measured("cube", Level::Three, three, 600)];
            missed_goals(&all, &budgets())
        };
        assert_eq!(at(6_000, 5_000), Vec::<String>::new());
        assert_eq!(
            at(5_001, 7_000),
            ["cube on Cortex-M0+: 5,001 bytes of flash are 1 more than 5,000"]
        );
    }

    #[test]
    fn the_table_marks_goals_and_excess() {
        let all =
            [measured("cube", Level::S, 6_500, 400), measured("cube", Level::Three, 4_999, 501)];
        let text = text(&all, &budgets(), "rustc 2", false);
        assert!(!text.contains("fault: "), "{text}");
        let row: Vec<_> = text.lines().nth(2).unwrap().split_whitespace().collect();
        assert_eq!(
            row,
            [
                "cube", "s", "6,500!", "6,464", "5,000", "no", "400", "416", "500", "yes", "500",
                "512", "24"
            ]
        );
        let row: Vec<_> = text.lines().nth(3).unwrap().split_whitespace().collect();
        assert_eq!(row[2..9], ["4,999", "6,464", "5,000", "yes", "501!", "416", "500"]);
        assert!(text.contains("The budgets are those of rustc 1"), "{text}");
        assert!(!super::text(&all, &budgets(), "rustc 1", false).contains("The budgets are"));
    }

    #[test]
    fn only_code_is_listed_the_largest_first_without_modules() {
        let table = symbol("firmware::models::CUBE::POSITIONS", 900);
        let buffer = Symbol { is_in_flash: false, ..symbol("BUFFER", 800) };
        let code = symbol("<rasterizer::numbers::float::Float>::times::<[u16; 1]>", 70);
        let mut symbols = vec![table, buffer, code];
        symbols.extend((0..20).map(|n| symbol("main", 60 - n)));
        let listing = super::symbols(&Measured { symbols, ..measured("cube", Level::S, 0, 0) });
        let lines: Vec<_> = listing.lines().skip(2).map(str::trim).collect();
        assert_eq!(lines.len(), LISTED);
        assert_eq!(lines[0], "70  <Float>::times::<[u16; 1]>");
        assert_eq!(lines[9], "52  main");
        assert_eq!(
            without_modules("core::fmt::num::imp::<impl u32>::f::{closure#0}"),
            "imp::<impl u32>::f::{closure#0}"
        );
    }

    #[test]
    fn json_says_the_same() {
        let all = [measured("cube", Level::S, 6_500, 400)];
        let report: Value =
            serde_json::from_str(&json(&all, &budgets(), "rustc 1", false).unwrap()).unwrap();
        assert_eq!(report["scenes"][0]["flash"], 6_500);
        assert_eq!(report["scenes"][0]["budget"]["flash"], 6_464);
        assert_eq!(report["scenes"][0]["opt_level"], "s");
        assert_eq!(report["faults"].as_array().unwrap().len(), 1);
        assert_eq!(report["missed_goals"].as_array().unwrap().len(), 1);
    }

    fn symbol(name: &str, size: u32) -> Symbol {
        Symbol { name: name.into(), address: 0, size, is_in_flash: true }
    }
}
