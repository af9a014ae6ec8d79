//! What a scene may take, and what it should: the file `budgets.json`.
//!
//! A *budget* is what a scene took when it was last saved, rounded up a little but not beyond a
//! goal that it meets, for each core and `opt-level`: taking more is a fault, if it is the same
//! compiler's code. A *goal* is what the project wants to get down to, at the better of the levels:
//! it is shown, and that it is not met is no fault. Unwanted code is a fault unless its symbol is
//! *tolerated*.

use std::{collections::BTreeMap, fs, path::PathBuf};

use anyhow::{Context as _, Result};
use host_tools::model::write_atomically;
use serde::{Deserialize, Serialize};

use super::Level;
use crate::{cores::Core, firmware};

/// Bytes of each kind of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Bytes {
    /// Code and constants, without the tables of models.
    pub(crate) flash: u32,
    /// The stack.
    pub(crate) stack: u32,
    /// Statics and stack.
    pub(crate) ram: u32,
}

/// A kind of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// See [`Bytes::flash`].
    Flash,
    /// See [`Bytes::stack`].
    Stack,
    /// See [`Bytes::ram`].
    Ram,
}

impl Kind {
    /// All, in the order of the table.
    pub(crate) const ALL: [Self; 3] = [Self::Flash, Self::Stack, Self::Ram];

    /// Its name in messages.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Flash => "flash",
            Self::Stack => "stack",
            Self::Ram => "RAM",
        }
    }

    /// So much of it.
    pub(crate) const fn of(self, bytes: &Bytes) -> u32 {
        match self {
            Self::Flash => bytes.flash,
            Self::Stack => bytes.stack,
            Self::Ram => bytes.ram,
        }
    }
}

impl Bytes {
    /// A budget for a scene that takes this: 1 % more, and up to a multiple of 32.
    const fn rounded_up(self) -> Self {
        const fn round(bytes: u32) -> u32 {
            (bytes + bytes / 100).next_multiple_of(32)
        }
        Self { flash: round(self.flash), stack: round(self.stack), ram: round(self.ram) }
    }

    /// The kinds of memory of which this is more than `budget`.
    pub(crate) fn over(&self, budget: &Self) -> Vec<Kind> {
        let exceeds = |kind: &Kind| kind.of(self) > kind.of(budget);
        Kind::ALL.into_iter().filter(exceeds).collect()
    }
}

/// What is wanted of a scene, or of all.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Goal {
    core: Core,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    flash: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stack: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ram: Option<u32>,
}

type Scenes = BTreeMap<String, Bytes>;

/// The contents of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Budgets {
    goals: Vec<Goal>,
    /// Symbols of unwanted code that scenes may bring until they no longer do.
    tolerated: Vec<String>,
    /// The compiler whose code the budgets were taken from: another makes other code.
    compiler: String,
    budgets: BTreeMap<Core, BTreeMap<Level, Scenes>>,
}

impl Budgets {
    /// Reads the file.
    ///
    /// # Errors
    ///
    /// If it cannot be read or understood; the message says at which line.
    pub(crate) fn load() -> Result<Self> {
        let path = path();
        let text = fs::read_to_string(&path)
            .with_context(|| format!("{} cannot be read", path.display()))?;
        serde_json::from_str(&text).with_context(|| format!("{} is not understood", path.display()))
    }

    /// Writes the file.
    ///
    /// # Errors
    ///
    /// If it cannot be written.
    pub(crate) fn store(&self) -> Result<()> {
        write_atomically(&path(), serde_json::to_string_pretty(self)? + "\n")?;
        Ok(())
    }

    /// The compiler that the budgets were taken from.
    pub(crate) fn compiler(&self) -> &str {
        &self.compiler
    }

    /// The budget of a scene.
    pub(crate) fn of(&self, core: Core, level: Level, scene: &str) -> Option<&Bytes> {
        self.budgets.get(&core)?.get(&level)?.get(scene)
    }

    /// The goal for one kind of memory of a scene: the strictest that is given.
    pub(crate) fn goal(&self, core: Core, scene: &str, kind: Kind) -> Option<u32> {
        let is_for = |goal: &&Goal| {
            goal.core == core && goal.scene.as_deref().is_none_or(|name| name == scene)
        };
        let bytes = |goal: &Goal| match kind {
            Kind::Flash => goal.flash,
            Kind::Stack => goal.stack,
            Kind::Ram => goal.ram,
        };
        self.goals.iter().filter(is_for).filter_map(bytes).min()
    }

    /// Whether a symbol of unwanted code is no fault.
    pub(crate) fn tolerates(&self, symbol: &str) -> bool {
        self.tolerated.iter().any(|name| name == symbol)
    }

    /// Takes what a scene takes now for its budget.
    pub(crate) fn set(&mut self, core: Core, level: Level, scene: &str, taken: Bytes) {
        let Bytes { flash, stack, ram } = taken.rounded_up();
        let within = |kind, taken, rounded: u32| match self.goal(core, scene, kind) {
            Some(goal) if taken <= goal => rounded.min(goal),
            _ => rounded,
        };
        let budget = Bytes {
            flash: within(Kind::Flash, taken.flash, flash),
            stack: within(Kind::Stack, taken.stack, stack),
            ram: within(Kind::Ram, taken.ram, ram),
        };
        let levels = self.budgets.entry(core).or_default();
        levels.entry(level).or_default().insert(scene.to_owned(), budget);
    }

    /// Says whose code the budgets are taken from.
    pub(crate) fn set_compiler(&mut self, version: &str) {
        version.clone_into(&mut self.compiler);
    }
}

fn path() -> PathBuf {
    firmware::root().join("tests/measure/budgets.json")
}

#[cfg(test)]
mod tests {
    use super::*;

    const TAKEN: Bytes = Bytes { flash: 9_964, stack: 1_000, ram: 1_196 };

    #[test]
    fn a_goal_that_is_met_is_not_given_up() {
        let goals = r#"{ "goals": [{ "core": "m0plus", "flash": 9970, "stack": 990 }], "tolerated": [], "compiler": "", "budgets": {} }"#;
        let mut budgets: Budgets = serde_json::from_str(goals).unwrap();
        budgets.set(Core::M0plus, Level::S, "cube", TAKEN);
        let Bytes { flash, stack, ram } = *budgets.of(Core::M0plus, Level::S, "cube").unwrap();
        assert_eq!(flash, 9_970);
        assert!(stack >= 1_000 && ram >= 1_196);
    }

    #[test]
    fn only_more_than_the_budget_is_too_much() {
        assert_eq!(TAKEN.over(&TAKEN), []);
        let tight = Bytes { flash: 9_963, ..TAKEN };
        assert_eq!(TAKEN.over(&tight), [Kind::Flash]);
        let tighter = Bytes { stack: 999, ram: 0, ..TAKEN };
        assert_eq!(TAKEN.over(&tighter), [Kind::Stack, Kind::Ram]);
    }

    #[test]
    fn what_was_saved_is_within_its_budget_and_little_below_it() {
        for bytes in [0, 1, 31, 32, 340, 9_964, 130_000] {
            let taken = Bytes { flash: bytes, stack: bytes, ram: bytes };
            let mut budgets = Budgets::default();
            budgets.set(Core::M4, Level::S, "cube", taken);
            let budget = *budgets.of(Core::M4, Level::S, "cube").unwrap();
            assert_eq!(taken.over(&budget), []);
            assert!(budget.flash < bytes + bytes / 100 + 32, "{budget:?}");
            let more = Bytes { stack: bytes + bytes / 100 + 32, ..taken };
            assert_eq!(more.over(&budget), [Kind::Stack]);
            assert_eq!(budgets.of(Core::M4, Level::Three, "cube"), None);
            assert_eq!(budgets.of(Core::M0plus, Level::S, "cube"), None);
        }
    }

    #[test]
    fn goals_are_for_a_scene_or_for_all_and_the_strictest_counts() {
        let text = r#"{
            "goals": [
                { "core": "m0plus", "stack": 2048 },
                { "core": "m0plus", "scene": "cube", "flash": 5120, "stack": 1024 },
                { "core": "m0plus", "scene": "cube", "stack": 4096 }
            ],
            "tolerated": [],
            "compiler": "",
            "budgets": {}
        }"#;
        let budgets: Budgets = serde_json::from_str(text).unwrap();
        let goal = |core, scene, kind| budgets.goal(core, scene, kind);
        assert_eq!(goal(Core::M0plus, "cube", Kind::Flash), Some(5_120));
        assert_eq!(goal(Core::M0plus, "cube", Kind::Stack), Some(1_024));
        assert_eq!(goal(Core::M0plus, "ball", Kind::Stack), Some(2_048));
        assert_eq!(goal(Core::M0plus, "ball", Kind::Flash), None);
        assert_eq!(goal(Core::M4, "cube", Kind::Stack), None);
    }

    #[test]
    fn the_file_is_understood_and_written_as_it_was_read() {
        let budgets = Budgets::load().unwrap();
        let text = serde_json::to_string_pretty(&budgets).unwrap() + "\n";
        assert_eq!(text, fs::read_to_string(path()).unwrap());
        assert!(serde_json::from_str::<Budgets>(&text.replace("flash", "flush")).is_err());
    }
}
