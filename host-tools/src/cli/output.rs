//! Output: to the standard output, and to files that appear whole or not at all.

use std::{
    fmt::Display,
    fs::{self, File},
    io::{self, ErrorKind, Read as _, Write as _},
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, bail};
use host_tools::model::{printable, write_atomically};
use serde::Serialize;

/// Prints to the standard output, with control characters of names escaped. A pipe that its reader
/// has closed is not an error.
pub(super) fn print(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(lines(text).as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).context("the result cannot be printed")
        }
        _ => Ok(()),
    }
}

/// Prints a line to the standard error. Ignores an error: there is nowhere left to report it.
pub(super) fn complain(kind: &str, message: &str) {
    let _ = writeln!(io::stderr(), "{kind}: {}", lines(message));
}

/// Escapes what would act on a terminal, but for the ends of lines.
fn lines(text: &str) -> String {
    text.split('\n').map(printable).collect::<Vec<_>>().join("\n")
}

/// An object as JSON for the standard output. What would act on a terminal is escaped as in JSON.
pub(super) fn json(object: &impl Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(object)? + "\n";
    // Such a character stands in a string, as those between the values are blanks and line ends.
    let escape = |c: char| match c {
        '\n' => c.to_string(),
        _ if printable(c.encode_utf8(&mut [0; 4])).len() == c.len_utf8() => c.to_string(),
        _ => c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")).collect(),
    };
    Ok(text.chars().map(escape).collect())
}

/// The model's file name with another ending, in the current directory.
pub(super) fn named_after(model: &Path, ending: &str) -> PathBuf {
    let mut name = model.file_stem().unwrap_or_default().to_os_string();
    name.push(ending);
    name.into()
}

/// Refuses a path that cannot or must not be written to: a directory, a device, one in a missing
/// directory, or a file that does not begin with `mark` and so is not from this program.
pub(super) fn allow(path: &Path, mark: &[u8], otherwise: impl Display) -> Result<()> {
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    if let Some(directory) = directory.filter(|directory| !directory.is_dir()) {
        bail!(
            "{}: there is no directory {}: create it, or choose another place",
            path.display(),
            directory.display()
        );
    }
    let metadata = match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) => bail!("{}: {error}: choose another name for the result", path.display()),
        Ok(metadata) => metadata,
    };
    if metadata.is_dir() {
        bail!("{} is a directory: name a file in it for the result", path.display());
    }
    if !metadata.is_file() {
        bail!("{} is not an ordinary file: choose another name for the result", path.display());
    }
    let mut start = Vec::new();
    let read =
        File::open(path).and_then(|file| file.take(mark.len() as u64).read_to_end(&mut start));
    if read.is_err() || start != mark {
        bail!("{} exists and is not from this program: {otherwise}", path.display());
    }
    Ok(())
}

/// Writes a PNG file. Replaces an older PNG file.
pub(super) fn write_png(path: &Path, png: &[u8]) -> Result<()> {
    allow_png(path)?;
    Ok(write_atomically(path, png)?)
}

/// Refuses the paths that [`write_png`] refuses. Call this before long work.
pub(super) fn allow_png(path: &Path) -> Result<()> {
    const SIGNATURE: &[u8; 8] = b"\x89PNG\r\n\x1a\n";
    allow(path, SIGNATURE, "it is not a PNG file; choose another name, or remove it")
}
