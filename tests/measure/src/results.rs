//! The files that keep figures in the repository: `results/*.json`, and `RESULTS.md` made of them.

use std::{fs, io::ErrorKind, path::PathBuf};

use anyhow::{Context as _, Result};
use host_tools::model::write_atomically;
use serde::{Serialize, de::DeserializeOwned};

use crate::{firmware, scaling, speed};

const TITLE: &str = "\
# What it costs

Measured in QEMU by `cargo run --quiet --release --package measure`, and written by it: the same figures come out on every
host, as far as it has the same compiler.
";

/// A file of figures, or nothing if there is none.
///
/// # Errors
///
/// If it cannot be read or holds something else.
pub(crate) fn load<T: DeserializeOwned>(name: &str) -> Result<Option<T>> {
    let path = file(name);
    let text = match fs::read_to_string(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        text => text.with_context(|| path.display().to_string())?,
    };
    let figures = serde_json::from_str(&text);
    let figures = figures.with_context(|| {
        format!("{} holds no such figures: remove it, or restore it", path.display())
    });
    Ok(Some(figures?))
}

/// Writes a file of figures.
///
/// # Errors
///
/// If it cannot be written.
pub(crate) fn save<T: Serialize>(name: &str, figures: &T) -> Result<()> {
    save_text(name, serde_json::to_string_pretty(figures)? + "\n")
}

/// Writes a file beside the figures.
///
/// # Errors
///
/// If it cannot be written.
pub(crate) fn save_text(name: &str, text: String) -> Result<()> {
    fs::create_dir_all(file(""))?;
    Ok(write_atomically(&file(name), text)?)
}

/// Writes `RESULTS.md` anew, from all figures that are saved.
///
/// # Errors
///
/// If a file cannot be read or written.
pub(crate) fn render() -> Result<()> {
    let sections = [
        load("speed.json")?.as_ref().map(speed::section),
        load("scaling.json")?.as_ref().map(scaling::section),
    ];
    let text = [TITLE.to_owned()].into_iter().chain(sections.into_iter().flatten());
    let text = text.collect::<Vec<_>>().join("\n");
    Ok(write_atomically(&file("../RESULTS.md"), text)?)
}

fn file(name: &str) -> PathBuf {
    firmware::root().join("tests/measure/results").join(name)
}
