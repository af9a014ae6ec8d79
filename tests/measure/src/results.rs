//! The files that keep figures in the repository: `results/*.json`, and `RESULTS.md` made of them.

use std::{fs, io::ErrorKind, path::PathBuf, time::SystemTime};

use anyhow::{Context as _, Result};
use host_tools::model::write_atomically;
use serde::{Serialize, de::DeserializeOwned};

use crate::{firmware, speed};

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
    let figures =
        figures.with_context(|| format!("{} holds no such figures: remove it, or restore it", path.display()));
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
    let sections = [load("speed.json")?.as_ref().map(speed::section)];
    let text = [TITLE.to_owned()].into_iter().chain(sections.into_iter().flatten());
    let text = text.collect::<Vec<_>>().join("\n");
    Ok(write_atomically(&file("../RESULTS.md"), text)?)
}

fn file(name: &str) -> PathBuf {
    firmware::root().join("tests/measure/results").join(name)
}

/// The date, as in 2026-01-31 (UTC).
pub(crate) fn today() -> String {
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    date(now.map_or(0, |time| time.as_secs() / 86_400))
}

/// The date of a day counted from 1970-01-01.
///
/// Howard Hinnant, "chrono-compatible low-level date algorithms", `civil_from_days`: years begin in March, so that the
/// day that some lack is their last; 400 years are 146,097 days.
fn date(day: u64) -> String {
    let day = day + 719_468; // from 0000-03-01
    let (era, day) = (day / 146_097, day % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, carry) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", 400 * era + year + carry)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_their_dates() {
        let days = [
            (0, "1970-01-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_453, "2025-12-31"),
        ];
        for (day, expected) in days {
            assert_eq!(date(day), expected);
        }
    }
}
