//! Builds and runs the programs of choices.

use std::{
    collections::HashMap,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail, ensure};
use host_tools::model::write_atomically;
use serde::Deserialize;

use super::{
    choices::Choice,
    errors::Picture,
    program,
    scenes::{Scene, Tables},
};
use crate::{conditions::Conditions, cores::Core, counts::Counts, firmware, plugin::Plugin};

/// What a program prints of a choice.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
struct Line {
    choice: String,
    frames: u64,
    /// Of all pixels of all frames.
    hash: String,
    /// Nanoseconds on the host.
    ticks: u64,
}

/// A choice on the host.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawn {
    /// The hash of its pictures.
    pub(super) hash: String,
    /// Its pictures.
    pub(super) frames: Vec<Picture>,
    /// Those of the shifted scene.
    pub(super) shifted: Vec<Picture>,
    /// Nanoseconds of a frame in each run, in increasing order.
    pub(super) nanoseconds: Vec<u64>,
}

/// How often the host's program is run: its times differ.
const RUNS: usize = 7;

/// What the programs of a scene share.
#[derive(Debug)]
pub(super) struct Programs<'a> {
    pub(super) scene: &'a Scene,
    folder: PathBuf,
    tables: Vec<Tables>,
}

impl<'a> Programs<'a> {
    /// Writes the tables that the choices need.
    ///
    /// # Errors
    ///
    /// Returns an error if the model cannot be converted, or a file not be written.
    pub(super) fn new(scene: &'a Scene, choices: &[Choice]) -> Result<Self> {
        let folder = scene.folder()?;
        Ok(Self { tables: Tables::write(scene, choices, &folder)?, scene, folder })
    }

    /// Draws all choices on the host, each run one after the other, so that what else the machine
    /// does meets all of them.
    ///
    /// # Errors
    ///
    /// Returns an error if the program cannot be built or run.
    pub(super) fn on_host(&self, choices: &[Choice]) -> Result<HashMap<String, Drawn>> {
        let program = self.build(None, choices, "choices")?;
        let run = |variables: &[&str]| {
            let mut command = Command::new(&program);
            command.envs(variables.iter().map(|variable| (variable, &self.folder)));
            lines(firmware::output_of(&mut command)?.lines())
        };
        let mut drawn: HashMap<String, Drawn> = HashMap::new();
        for line in run(&["PICTURES"])? {
            let frames = pictures(&self.folder, &line)?;
            let found = Drawn { hash: line.hash, frames, ..Drawn::default() };
            drawn.insert(line.choice, found);
        }
        for line in run(&["PICTURES", "SHIFTED"])? {
            let shifted = pictures(&self.folder, &line)?;
            drawn.entry(line.choice).and_modify(|found| found.shifted = shifted);
        }
        for _ in 0..RUNS {
            for line in run(&[])? {
                let time = line.ticks / line.frames.max(1);
                drawn.entry(line.choice).and_modify(|found| found.nanoseconds.push(time));
            }
        }
        drawn.values_mut().for_each(|drawn| drawn.nanoseconds.sort_unstable());
        Ok(drawn)
    }

    /// Counts the frames of a choice on a core.
    ///
    /// # Errors
    ///
    /// Returns an error if the program cannot be built or run, or if a picture is not that of the
    /// host.
    pub(super) fn on_core(
        &self,
        plugin: &Plugin,
        core: Core,
        choice: Choice,
        drawn: &HashMap<String, Drawn>,
    ) -> Result<Counted> {
        let output = plugin.run(&self.build(Some(core), &[choice], core.facts().name)?)?;
        let lines = lines(output.lines.iter().map(String::as_str))?;
        let ([line], [stages]) = (lines.as_slice(), output.reports.as_slice()) else {
            bail!("one choice has {} lines and {} reports", lines.len(), output.reports.len());
        };
        ensure!(
            drawn.get(&line.choice).is_some_and(|drawn| drawn.hash == line.hash),
            "{} of {} on {} is not the picture of the host",
            line.choice,
            self.scene.name,
            core.title()
        );
        Ok(Counted {
            counts: stages.clear + stages.vertices + stages.draw,
            frames: line.frames.max(1),
            conditions: Conditions::of(core, &output.lines)?,
        })
    }

    /// Writes the source of a program under a name, and builds it.
    fn build(&self, core: Option<Core>, choices: &[Choice], name: &str) -> Result<PathBuf> {
        let path = self.folder.join(name).with_extension("rs");
        write_atomically(&path, program::source(self.scene, &self.tables, choices))?;
        firmware::build_choices(core, &path)
    }
}

/// Reads the pictures of a choice, and removes their files.
fn pictures(folder: &Path, line: &Line) -> Result<Vec<Picture>> {
    let picture = |frame| {
        let path = folder.join(format!("{}-{frame}.rgb", line.choice));
        let picture = fs::read(&path).with_context(|| path.display().to_string())?;
        fs::remove_file(&path).with_context(|| path.display().to_string())?;
        Ok(picture)
    };
    (0..line.frames).map(picture).collect()
}

/// What the frames of a choice take on a core.
#[derive(Clone, Debug)]
pub(super) struct Counted {
    /// A sum over the frames.
    pub(super) counts: Counts,
    pub(super) frames: u64,
    pub(super) conditions: Conditions,
}

/// Parses what a program prints behind its `opt-level`.
fn lines<'a>(lines: impl Iterator<Item = &'a str>) -> Result<Vec<Line>> {
    let parse = |line| {
        serde_json::from_str(line)
            .with_context(|| format!("the firmware has printed `{line}` instead of a choice"))
    };
    lines.skip(1).map(parse).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_is_no_choice() {
        let line = r#"{"choice":"flat","frames":8,"hash":"0123abcd","ticks":7}"#;
        let found = lines(["opt-level 3", line].into_iter()).unwrap();
        let hash = "0123abcd".to_owned();
        assert_eq!(found, [Line { choice: "flat".into(), frames: 8, hash, ticks: 7 }]);
        let error = lines(["opt-level 3", "panicked"].into_iter()).unwrap_err();
        assert!(error.to_string().contains("`panicked`"));
    }
}
