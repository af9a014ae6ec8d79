//! Figures of several cores: how they are measured, saved, and shown as Markdown. The terminal and
//! `RESULTS.md` show the same.

use std::{fmt::Display, fs, io::ErrorKind};

use anyhow::{Context as _, Result};
use host_tools::model::{thousands, write_atomically};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::{
    conditions::Conditions,
    cores::Core,
    firmware,
    plugin::{Output, Plugin},
    progress, results, rows,
    table::Table,
};

/// Figures of a core.
pub(crate) trait Figures: Serialize + DeserializeOwned {
    /// Their file in `results`.
    const FILE: &'static str;

    /// The heading of their section in `RESULTS.md`.
    const TITLE: &'static str;

    /// Explains the columns of the tables, in Markdown.
    const LEGEND: &'static str;

    /// The programs that print them.
    const PROGRAMS: &'static [&'static str];

    /// Parses what each of the programs prints, and what the plugin counts in it.
    fn parse(outputs: &[Output]) -> Result<Self>;

    /// Tables, each after its caption, which may be empty.
    fn tables(&self, core: Core) -> Vec<(&'static str, Table)>;
}

/// The figures of some or all cores.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PerCore<T> {
    pub(crate) cores: Vec<Measured<T>>,
}

/// The figures of a core, and the conditions they were measured under.
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
    /// Returns the figures of a core.
    pub(crate) fn of(&self, core: Core) -> Option<&Measured<T>> {
        self.cores.iter().find(|measured| measured.core == core)
    }

    /// Replaces the figures of the cores that `newer` has.
    pub(crate) fn with(self, newer: Self) -> Self {
        let kept = self.cores.into_iter().filter(|old| newer.of(old.core).is_none());
        let mut cores: Vec<_> = kept.collect();
        cores.extend(newer.cores);
        cores.sort_by_key(|measured| measured.core);
        Self { cores }
    }
}

impl<T: Figures> PerCore<T> {
    /// Runs the programs on the cores.
    pub(crate) fn measure(cores: &[Core]) -> Result<Self> {
        let progress = progress::over(T::PROGRAMS.len() * cores.len());
        progress.set_message("building");
        firmware::build_ahead(cores, T::PROGRAMS)?;
        let of_core = |&core: &Core| {
            let plugin = Plugin::build(core)?;
            let output = |program: &&str| {
                progress.set_message(format!("{program} on {}", core.title()));
                let output = plugin.run(&firmware::build(core, program)?);
                progress.inc(1);
                output
            };
            let outputs = T::PROGRAMS.iter().map(output).collect::<Result<Vec<_>>>()?;
            let conditions = Conditions::of(core, &outputs[0].lines)?;
            Ok(Measured { core, conditions, figures: T::parse(&outputs)? })
        };
        Ok(Self { cores: cores.iter().map(of_core).collect::<Result<_>>()? })
    }

    /// Reads the saved figures. Without the file there are none.
    pub(crate) fn saved() -> Result<Self> {
        let path = results::file(T::FILE);
        let text = match fs::read_to_string(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Self::default()),
            text => text.with_context(|| path.display().to_string())?,
        };
        serde_json::from_str(&text).with_context(|| {
            format!("{} does not hold figures of this kind: remove or restore it", path.display())
        })
    }

    /// Saves these figures beside those of other cores, and renders `RESULTS.md`.
    pub(crate) fn save(self) -> Result<()> {
        let text = rows::to_string(&Self::saved()?.with(self))?;
        write_atomically(&results::file(T::FILE), text)?;
        results::render()
    }

    /// The tables of all cores.
    pub(crate) fn tables(&self) -> String {
        let text = self.cores.iter().map(|measured| {
            let note = format!("{}, {}.", measured.conditions.date, measured.conditions);
            of_core(measured.core, &note, &measured.figures.tables(measured.core))
        });
        text.collect::<Vec<_>>().join("\n")
    }

    /// The section of `RESULTS.md`.
    pub(crate) fn section(&self) -> String {
        format!("## {}\n\n{}\n\n{}", T::TITLE, T::LEGEND, self.tables())
    }
}

/// The tables of one core below its name and a note.
pub(crate) fn of_core(core: Core, note: &str, tables: &[(&str, Table)]) -> String {
    let mut text = format!("### {}\n\n{note}\n", core.title());
    for (caption, table) in tables {
        let caption = if caption.is_empty() { String::new() } else { format!("{caption}:\n\n") };
        text += &format!("\n{caption}{table}");
    }
    text
}

/// A list with a line for each item.
pub(crate) fn list(items: impl IntoIterator<Item = impl Display>) -> String {
    items.into_iter().map(|item| format!("- {item}\n")).collect()
}

/// A count with its digits in groups of three.
pub(crate) fn count(count: impl Into<u64>) -> String {
    thousands(count.into() as usize)
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
        PerCore { cores: vec![Measured { core, conditions, figures }] }
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
    fn a_file_gives_back_the_figures_written() {
        let figures = of(Core::Riscv, Answer { answer: 42 });
        let text = serde_json::to_string(&figures).unwrap();
        assert!(text.contains(r#""core":"riscv","date":"2026-01-31""#), "{text}");
        assert!(text.contains(r#""answer":42"#), "{text}");
        assert_eq!(serde_json::from_str::<PerCore<Answer>>(&text).unwrap(), figures);
    }
}
