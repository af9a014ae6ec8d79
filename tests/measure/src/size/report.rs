//! Sizes as tables, with goals and faults.

use std::collections::BTreeMap;

use super::{
    Measured,
    budgets::{Budgets, Kind},
    image::Symbol,
    unwanted::Unwanted,
};
use crate::{
    cores::Core,
    figures::{count, list, of_core},
    table::Table,
};

/// How many symbols of a scene are listed.
const LISTED: usize = 10;

/// What was measured, and how it compares with budgets and goals.
#[derive(Clone, Debug)]
pub(super) struct Report<'a> {
    all: &'a [Measured],
    budgets: &'a Budgets,
    compiler: &'a str,
    missed_goals: Vec<String>,
    tolerated: Vec<String>,
    /// Scenes without a budget, or over it if it is for this compiler's code, and unwanted code
    /// that is not tolerated.
    pub(super) faults: Vec<String>,
}

impl<'a> Report<'a> {
    pub(super) fn new(all: &'a [Measured], budgets: &'a Budgets, compiler: &'a str) -> Self {
        let mut report = Self {
            all,
            budgets,
            compiler,
            missed_goals: missed_goals(all, budgets),
            tolerated: unwanted(all, |name| budgets.tolerates(name)),
            faults: vec![],
        };
        let excess = all.iter().flat_map(|measured| report.excess(measured));
        report.faults = excess.chain(unwanted(all, |name| !budgets.tolerates(name))).collect();
        report
    }

    fn is_comparable(&self) -> bool {
        self.compiler == self.budgets.compiler
    }

    /// The kinds of memory of which a scene takes more than its budget.
    fn excess(&self, measured: &Measured) -> Vec<String> {
        let Measured { core, opt_level, scene, bytes, .. } = measured;
        let place = format!("{scene} on {}", measured.place());
        let Some(budget) = self.budgets.of(*core, *opt_level, scene) else {
            return vec![format!("{place} has no budget: `measure size --save` sets it")];
        };
        let kinds = Kind::ALL.into_iter().filter(|kind| bytes[kind] > budget[kind]);
        let kinds = kinds.filter(|_| self.is_comparable()).map(|kind| {
            let (taken, budget) = (count(bytes[&kind]), count(budget[&kind]));
            format!("{place}: {taken} bytes of {} are over the budget of {budget}", kind.name())
        });
        kinds.collect()
    }

    /// Tables, one for each core, and lists.
    pub(super) fn text(&self, with_symbols: bool) -> String {
        let mut text = String::new();
        for core in Core::or_all(&[]) {
            let scenes: Vec<_> = self.all.iter().filter(|one| one.core == core).collect();
            if !scenes.is_empty() {
                text += &of_core(core, self.compiler, &[("", self.table(&scenes))]);
                text.push('\n');
            }
        }
        text += "Bytes. Flash is without the tables of models, which have their own column; \
                 RAM is statics and stack. All scenes include what `empty` takes.\n";
        if !self.is_comparable() {
            text += &format!(
                "The budgets are those of {}: exceeding them is no fault with another compiler.\n",
                self.budgets.compiler
            );
        }
        for measured in self.all.iter().filter(|_| with_symbols) {
            text += &format!("\n{} on {}:\n\n", measured.scene, measured.place());
            text += &list(
                largest(measured)
                    .map(|symbol| format!("{} bytes: {}", count(symbol.size), symbol.name)),
            );
        }
        let lists = [
            ("Goals that are not met", &self.missed_goals),
            ("Tolerated", &self.tolerated),
            ("Faults", &self.faults),
        ];
        for (title, items) in lists.into_iter().filter(|(_, items)| !items.is_empty()) {
            text += &format!("\n{title}:\n\n{}", list(items));
        }
        text
    }

    fn table(&self, scenes: &[&Measured]) -> Table {
        let kinds = Kind::ALL.into_iter().flat_map(|kind| [kind.name(), "budget", "goal"]);
        let headings = ["scene", "opt-level"].into_iter().chain(kinds).chain(["models"]);
        let mut table = Table::new(2, &headings.collect::<Vec<_>>());
        for Measured { core, opt_level, scene, bytes, models, .. } in scenes {
            let budget = self.budgets.of(*core, *opt_level, scene);
            let mut cells = vec![scene.clone(), opt_level.name().to_owned()];
            for kind in Kind::ALL {
                let taken = bytes[&kind];
                let is_over = budget.is_some_and(|budget| taken > budget[&kind]);
                cells.push(count(taken) + if is_over { "!" } else { "" });
                cells.push(budget.map_or("-".into(), |budget| count(budget[&kind])));
                let goal = self.budgets.goal(*core, scene, kind);
                cells.push(goal.map_or_else(String::new, |goal| {
                    count(goal) + if taken <= goal { " yes" } else { " no" }
                }));
            }
            cells.push(count(*models));
            table.row(cells);
        }
        table
    }
}

/// The goals that no level meets, each with what is missing.
fn missed_goals(all: &[Measured], budgets: &Budgets) -> Vec<String> {
    let mut best = BTreeMap::new();
    for Measured { core, scene, bytes, .. } in all {
        for (&kind, &taken) in bytes {
            let best = best.entry((*core, scene, kind)).or_insert(taken);
            *best = taken.min(*best);
        }
    }
    let missed = best.into_iter().filter_map(|((core, scene, kind), taken)| {
        let goal = budgets.goal(core, scene, kind).filter(|&goal| taken > goal)?;
        Some(format!(
            "{scene} on {}: {} bytes of {} are {} more than {}",
            core.title(),
            count(taken),
            kind.name(),
            count(taken - goal),
            count(goal)
        ))
    });
    missed.collect()
}

/// The symbols of unwanted code whose names pass `filter`, each with the scenes that bring it.
fn unwanted(all: &[Measured], filter: impl Fn(&str) -> bool) -> Vec<String> {
    let mut scenes = BTreeMap::<_, Vec<&str>>::new();
    for measured in all {
        for Symbol { name, .. } in measured.symbols.iter().filter(|one| filter(&one.name)) {
            if let Some(kind) = Unwanted::of(name) {
                let scenes = scenes.entry((kind, measured.place(), name)).or_default();
                scenes.push(&measured.scene);
            }
        }
    }
    let lines = scenes.into_iter().map(|((kind, place, name), scenes)| {
        format!("{kind} on {place}: {name} in {}", scenes.join(", "))
    });
    lines.collect()
}

/// The largest functions and constants, without the tables of models.
fn largest(measured: &Measured) -> impl Iterator<Item = &Symbol> {
    let is_listed = |symbol: &&Symbol| symbol.is_in_flash && !symbol.is_of_a_model();
    measured.symbols.iter().filter(is_listed).take(LISTED)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size::{Level, budgets::tests::bytes, tests::measured};

    fn budgets() -> Budgets {
        let goals = r#"{
            "goals": [
                { "core": "m0plus", "scene": "cube", "flash": 5000 },
                { "core": "m0plus", "stack": 500 }
            ],
            "tolerated": ["core::option::unwrap_failed"], "compiler": "rustc 1", "budgets": {}
        }"#;
        let mut budgets: Budgets = serde_json::from_str(goals).unwrap();
        budgets.set(Core::M0plus, Level::S, "cube", &bytes(6_400, 400, 500));
        budgets.set(Core::M0plus, Level::Three, "cube", &bytes(6_400, 400, 500));
        budgets
    }

    fn faults(measured: Measured, compiler: &str) -> Vec<String> {
        Report::new(&[measured], &budgets(), compiler).faults
    }

    fn symbol(name: &str, size: u32) -> Symbol {
        Symbol { name: name.into(), address: 0, size, is_in_flash: true }
    }

    #[test]
    fn scenes_over_their_budget_without_one_or_with_unwanted_code_are_faults() {
        let none = Vec::<String>::new();
        let [within, over] = [6_464, 6_500].map(|flash| measured("cube", Level::S, flash, 400));
        assert_eq!(faults(within.clone(), "rustc 1"), none);
        let expected =
            "cube on Cortex-M0+ at opt-level s: 6,500 bytes of flash are over the budget of 6,464";
        assert_eq!(faults(over.clone(), "rustc 1"), [expected]);
        assert_eq!(faults(over, "rustc 2"), none);
        assert!(faults(measured("ball", Level::S, 0, 0), "rustc 1")[0].contains("no budget"));
        let names = ["__aeabi_fadd", "main", "core::option::unwrap_failed"];
        let heavy = Measured { symbols: names.map(|name| symbol(name, 8)).into(), ..within };
        let expected = "floating point on Cortex-M0+ at opt-level s: __aeabi_fadd in cube";
        assert_eq!(faults(heavy.clone(), "rustc 1"), [expected]);
        let text = Report::new(&[heavy], &budgets(), "rustc 1").text(false);
        assert!(text.contains("\nTolerated:\n\n- panics on"), "{text}");
    }

    #[test]
    fn a_goal_is_met_at_the_better_level() {
        let at = |s, three| {
            let all =
                [measured("cube", Level::S, s, 400), measured("cube", Level::Three, three, 600)];
            missed_goals(&all, &budgets())
        };
        assert_eq!(at(6_000, 5_000), Vec::<String>::new());
        let expected = "cube on Cortex-M0+: 5,001 bytes of flash are 1 more than 5,000";
        assert_eq!(at(5_001, 7_000), [expected]);
    }

    #[test]
    fn the_table_marks_goals_and_excess() {
        let all =
            [measured("cube", Level::S, 6_500, 400), measured("cube", Level::Three, 4_999, 501)];
        let text = Report::new(&all, &budgets(), "rustc 2").text(false);
        let rows: Vec<_> = text.lines().filter(|line| line.starts_with("| cube")).collect();
        let cells =
            |row: &str| row.replace('|', "").split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(cells(rows[0]), "cube s 6,500! 6,464 5,000 no 400 416 500 yes 500 512 24");
        assert_eq!(cells(rows[1]), "cube 3 4,999 6,464 5,000 yes 501! 416 500 no 601! 512 24");
        assert!(text.contains("The budgets are those of rustc 1"), "{text}");
        assert!(!text.contains("Faults"), "{text}");
        let same = Report::new(&all, &budgets(), "rustc 1").text(false);
        assert!(!same.contains("The budgets are") && same.contains("Faults"), "{same}");
    }

    #[test]
    fn the_largest_code_is_listed() {
        let table = symbol("firmware::models::CUBE::POSITIONS", 900);
        let buffer = Symbol { is_in_flash: false, ..symbol("BUFFER", 800) };
        let code = symbol("<Float>::times::<[u16; 1]>", 70);
        let mut symbols = vec![table, buffer, code];
        symbols.extend((0..20).map(|n| symbol("main", 60 - n)));
        let all = [Measured { symbols, ..measured("cube", Level::S, 0, 0) }];
        let text = Report::new(&all, &budgets(), "rustc 1").text(true);
        let lines: Vec<_> = text.lines().filter(|line| line.contains(" bytes: ")).collect();
        assert_eq!(lines.len(), LISTED);
        assert_eq!(lines[0], "- 70 bytes: <Float>::times::<[u16; 1]>");
        assert_eq!(lines[9], "- 52 bytes: main");
    }
}
