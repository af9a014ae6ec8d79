//! Figures of several cores, as the files of figures hold them.

use serde::{Deserialize, Serialize};

use crate::{conditions::Conditions, cores::Core};

/// The figures of some or all cores.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PerCore<T> {
    pub(crate) cores: Vec<Measured<T>>,
}

/// The figures of a core, and what they were measured with.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Measured<T> {
    pub(crate) core: Core,
    #[serde(flatten)]
    pub(crate) conditions: Conditions,
    #[serde(flatten)]
    pub(crate) figures: T,
}

impl<T> Default for PerCore<T> {
    fn default() -> Self {
        Self { cores: Vec::new() }
    }
}

impl<T> PerCore<T> {
    /// Those of a core.
    pub(crate) fn of(&self, core: Core) -> Option<&Measured<T>> {
        self.cores.iter().find(|measured| measured.core == core)
    }

    /// These figures, with those of some cores replaced.
    pub(crate) fn with(self, newer: Self) -> Self {
        let kept = self.cores.into_iter().filter(|old| newer.of(old.core).is_none());
        let mut cores: Vec<_> = kept.collect();
        cores.extend(newer.cores);
        cores.sort_by_key(|measured| measured.core);
        Self { cores }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Figures of one core.
    pub(crate) fn of<T>(core: Core, figures: T) -> PerCore<T> {
        let conditions = Conditions {
            date: "2026-01-31".into(),
            rustc: "rustc 1.95.0".into(),
            opt_level: "3".into(),
            qemu: "7.2".into(),
        };
        let measured = Measured { core, conditions, figures };
        PerCore { cores: vec![measured] }
    }

    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    struct Answer {
        answer: u64,
    }

    #[test]
    fn newer_figures_replace_those_of_their_cores_only() {
        let old = of(Core::M4, Answer { answer: 1 }).with(of(Core::M0plus, Answer { answer: 2 }));
        let new = old.with(of(Core::M4, Answer { answer: 3 }));
        let found: Vec<_> = new.cores.iter().map(|c| (c.core, c.figures.answer)).collect();
        assert_eq!(found, [(Core::M0plus, 2), (Core::M4, 3)]);
    }

    #[test]
    fn a_file_gives_back_what_it_was_given() {
        let figures = of(Core::Riscv, Answer { answer: 42 });
        let text = serde_json::to_string(&figures).unwrap();
        assert!(
            text.contains(r#""core":"riscv","date":"2026-01-31""#)
                && text.contains(r#""answer":42"#),
            "{text}"
        );
        assert_eq!(serde_json::from_str::<PerCore<Answer>>(&text).unwrap(), figures);
    }
}
