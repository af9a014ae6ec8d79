//! The files that keep figures in the repository: `results/*.json`, and what is made of them.

use std::{fs, io::ErrorKind, path::PathBuf};

use anyhow::{Context as _, Result};
use host_tools::model::write_atomically;
use serde::{Serialize, de::DeserializeOwned};

use crate::{
    firmware,
    scaling::{self, Scaling},
    speed::Speed,
};

const TITLE: &str = "\
# What it costs

Measured in QEMU and written by `cargo run --quiet --release --package measure`. The figures are the
same on every host that has the same compiler.
";

/// Reads a file of figures. Without the file there are none.
pub(crate) fn load<T: DeserializeOwned + Default>(name: &str) -> Result<T> {
    let path = file(name);
    let text = match fs::read_to_string(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(T::default()),
        text => text.with_context(|| path.display().to_string())?,
    };
    serde_json::from_str(&text).with_context(|| {
        format!("{} does not hold figures of this kind: remove or restore it", path.display())
    })
}

/// Writes a file of figures.
pub(crate) fn save<T: Serialize>(name: &str, figures: &T) -> Result<()> {
    fs::create_dir_all(file(""))?;
    Ok(write_atomically(&file(name), serde_json::to_string_pretty(figures)? + "\n")?)
}

/// Writes `RESULTS.md` and its chart from all saved figures.
pub(crate) fn render() -> Result<()> {
    for (name, text) in rendered()? {
        write_atomically(&file(name), text)?;
    }
    Ok(())
}

/// The files that are made of the saved figures.
fn rendered() -> Result<[(&'static str, String); 2]> {
    let (speed, scaling) = (Speed::saved()?, Scaling::saved()?);
    let text = [TITLE, &speed.section(), &scaling.section()].join("\n");
    Ok([("../RESULTS.md", text), ("scaling.svg", scaling::chart(&scaling))])
}

fn file(name: &str) -> PathBuf {
    firmware::root().join("tests/measure/results").join(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rendered_files_are_those_of_the_saved_figures() {
        for (name, text) in rendered().unwrap() {
            let found = fs::read_to_string(file(name)).unwrap();
            assert!(found == text, "{name} is out of date: run `measure render`");
        }
    }
}
