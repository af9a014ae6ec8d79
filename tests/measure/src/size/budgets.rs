//! The memory that a scene may take, and that it should take: the file `budgets.json`.
//!
//! A *budget* is what a scene took when it was last saved, rounded up a little but not beyond a
//! goal that it meets, for each core and `opt-level`. Taking more is a fault, provided that the
//! same compiler made the code. A *goal* is what the project wants to get down to, at the better of
//! the levels. A missed goal is reported but is not a fault. Unwanted code is a fault unless its
//! symbol is *tolerated*.

use std::{collections::BTreeMap, fs, path::PathBuf};

use anyhow::{Context as _, Result};
use host_tools::model::write_atomically;
use serde::{Deserialize, Serialize};

use super::Level;
use crate::{cores::Core, firmware};

/// A kind of memory, in the order of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Kind {
    /// Code and constants, without the tables of models.
    Flash,
    Stack,
    /// Statics and stack.
    Ram,
}

impl Kind {
    pub(crate) const ALL: [Self; 3] = [Self::Flash, Self::Stack, Self::Ram];

    /// Its name in tables and messages.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Flash => "flash",
            Self::Stack => "stack",
            Self::Ram => "RAM",
        }
    }
}

/// Bytes of each kind of memory.
pub(crate) type Bytes = BTreeMap<Kind, u32>;

/// Returns a budget for what is taken: 1 % more, and up to a multiple of 32.
const fn rounded_up(bytes: u32) -> u32 {
    (bytes + bytes / 100).next_multiple_of(32)
}

/// A goal for one scene, or for all if none is named.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Goal {
    core: Core,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    #[serde(flatten)]
    bytes: Bytes,
}

/// The contents of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Budgets {
    goals: Vec<Goal>,
    /// Symbols of unwanted code that scenes may bring until they no longer do.
    tolerated: Vec<String>,
    /// The compiler whose code the budgets were taken from.
    pub(crate) compiler: String,
    budgets: BTreeMap<Core, BTreeMap<Level, BTreeMap<String, Bytes>>>,
}

impl Budgets {
    /// Reads the file.
    pub(crate) fn load() -> Result<Self> {
        let path = path();
        let text = fs::read_to_string(&path)
            .with_context(|| format!("{} cannot be read", path.display()))?;
        serde_json::from_str(&text).with_context(|| format!("{} is not understood", path.display()))
    }

    /// Writes the file.
    pub(crate) fn store(&self) -> Result<()> {
        Ok(write_atomically(&path(), serde_json::to_string_pretty(self)? + "\n")?)
    }

    /// The budget of a scene.
    pub(crate) fn of(&self, core: Core, level: Level, scene: &str) -> Option<&Bytes> {
        self.budgets.get(&core)?.get(&level)?.get(scene)
    }

    /// The strictest goal for one kind of memory of a scene.
    pub(crate) fn goal(&self, core: Core, scene: &str, kind: Kind) -> Option<u32> {
        let is_for = |goal: &&Goal| {
            goal.core == core && goal.scene.as_deref().is_none_or(|name| name == scene)
        };
        self.goals.iter().filter(is_for).filter_map(|goal| goal.bytes.get(&kind).copied()).min()
    }

    /// Whether a symbol of unwanted code is no fault.
    pub(crate) fn tolerates(&self, symbol: &str) -> bool {
        self.tolerated.iter().any(|name| name == symbol)
    }

    /// Derives the budget of a scene from what it takes.
    pub(crate) fn set(&mut self, core: Core, level: Level, scene: &str, taken: &Bytes) {
        let budget = |(&kind, &taken): (&Kind, &u32)| {
            let met = self.goal(core, scene, kind).filter(|&goal| taken <= goal);
            (kind, rounded_up(taken).min(met.unwrap_or(u32::MAX)))
        };
        let budget = taken.iter().map(budget).collect();
        let levels = self.budgets.entry(core).or_default();
        levels.entry(level).or_default().insert(scene.to_owned(), budget);
    }
}

fn path() -> PathBuf {
    firmware::root().join("tests/measure/budgets.json")
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Bytes of flash, stack and RAM.
    pub(in crate::size) fn bytes(flash: u32, stack: u32, ram: u32) -> Bytes {
        Bytes::from([(Kind::Flash, flash), (Kind::Stack, stack), (Kind::Ram, ram)])
    }

    fn with_goals(goals: &str) -> Budgets {
        let text = format!(
            r#"{{ "goals": [{goals}], "tolerated": [], "compiler": "", "budgets": {{}} }}"#
        );
        serde_json::from_str(&text).unwrap()
    }

    #[test]
    fn a_budget_stays_within_a_goal_that_is_met() {
        let mut budgets = with_goals(r#"{ "core": "m0plus", "flash": 9970, "stack": 990 }"#);
        budgets.set(Core::M0plus, Level::S, "cube", &bytes(9_964, 1_000, 1_196));
        let budget = budgets.of(Core::M0plus, Level::S, "cube").unwrap();
        assert_eq!(*budget, bytes(9_970, 1_024, 1_216));
    }

    #[test]
    fn a_budget_is_little_more_than_what_was_taken() {
        for taken in [0, 1, 31, 32, 340, 9_964, 130_000] {
            let mut budgets = Budgets::default();
            budgets.set(Core::M4, Level::S, "cube", &bytes(taken, taken, taken));
            let budget = &budgets.of(Core::M4, Level::S, "cube").unwrap()[&Kind::Stack];
            assert!((taken..taken + taken / 100 + 32).contains(budget), "{budget}");
            assert_eq!(budgets.of(Core::M4, Level::Three, "cube"), None);
            assert_eq!(budgets.of(Core::M0plus, Level::S, "cube"), None);
        }
    }

    #[test]
    fn goals_are_for_a_scene_or_for_all_and_the_strictest_counts() {
        let budgets = with_goals(
            r#"{ "core": "m0plus", "stack": 2048 },
               { "core": "m0plus", "scene": "cube", "flash": 5120, "stack": 1024 },
               { "core": "m0plus", "scene": "cube", "stack": 4096 }"#,
        );
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
