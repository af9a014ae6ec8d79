//! The files that keep figures in the repository: `results/*.json`, and what is made of them.

use std::path::PathBuf;

use anyhow::Result;
use host_tools::model::write_atomically;

use crate::{
    cycles, firmware, report,
    scaling::{self, Scaling},
    speed::Speed,
};

const TITLE: &str = "\
# What it costs

Measured in QEMU and written by `cargo run --quiet --release --package measure`. The figures are the
same on every host that has the same compiler.
";

/// Writes `RESULTS.md`, its chart and the report from all saved figures.
pub(crate) fn render() -> Result<()> {
    for (name, bytes) in rendered()? {
        write_atomically(&file(&name), bytes)?;
    }
    Ok(())
}

/// The files that are made of the saved figures.
fn rendered() -> Result<Vec<(String, Vec<u8>)>> {
    let (speed, scaling) = (Speed::saved()?, Scaling::saved()?);
    let text = [TITLE, &speed.section(), &cycles::section(&speed), &scaling.section()].join("\n");
    let mut files = vec![
        ("../RESULTS.md".to_owned(), text.into_bytes()),
        ("scaling.svg".to_owned(), scaling::chart(&scaling).into_bytes()),
    ];
    files.extend(report::rendered()?);
    Ok(files)
}

pub(crate) fn file(name: &str) -> PathBuf {
    firmware::root().join("tests/measure/results").join(name)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn the_rendered_files_are_those_of_the_saved_figures() {
        for (name, text) in rendered().unwrap() {
            let found = fs::read(file(&name)).unwrap();
            assert!(found == text, "{name} is out of date: run `measure render`");
        }
    }
}
