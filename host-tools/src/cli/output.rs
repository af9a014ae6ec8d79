//! Output: to the standard output, and to files that appear whole or not at all.

use std::{
    fs::{self, File},
    io::{self, ErrorKind, Read as _, Write as _},
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, bail};
use host_tools::model::{Model, printable, write_atomically};
use serde::Serialize;

use super::{gif, png, signals};

/// Prints to the standard output, with control characters of names escaped if it is text. A pipe
/// that its reader has closed is not an error.
pub(super) fn print(result: &[u8]) -> Result<()> {
    let escaped = str::from_utf8(result).map(lines);
    let result = escaped.as_deref().map_or(result, str::as_bytes);
    let mut out = io::stdout().lock();
    match out.write_all(result).and_then(|()| out.flush()) {
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

/// The model's file name with another ending, in the current directory; `model` for the standard
/// input.
pub(super) fn named_after(model: &Path, ending: &str) -> PathBuf {
    let model = if is_standard(model) { Path::new("model") } else { model };
    let mut name = model.file_stem().unwrap_or_default().to_os_string();
    name.push(ending);
    name.into()
}

/// What may be overwritten.
#[derive(Clone, Copy, Debug)]
pub(super) struct Overwriting<'a> {
    /// Also files that are not from this program.
    pub(super) force: bool,
    /// Never these, under any name.
    pub(super) inputs: &'a [PathBuf],
}

/// A kind of result.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    /// Whether a file that begins with these bytes is such a result.
    pub(super) is_ours: fn(&[u8]) -> bool,
    /// How to go on if it is not.
    pub(super) otherwise: &'static str,
}

/// Pictures.
pub(super) const PNG: Kind = Kind {
    is_ours: png::is_ours,
    otherwise: "choose another name, remove it, or overwrite it with --force",
};

/// Animations.
pub(super) const GIF: Kind = Kind { is_ours: gif::is_ours, ..PNG };

/// Enough bytes to recognise a result by: in a GIF file a palette of 768 precedes its mark.
const START: u64 = 1024;

/// Refuses a path that cannot or must not be written to: a directory, a device, one in a missing
/// directory, an input, or a file that is not from this program. An empty file may be overwritten.
pub(super) fn allow(path: &Path, kind: Kind, overwriting: Overwriting<'_>) -> Result<()> {
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
    if let Some(input) = overwriting.inputs.iter().find(|input| is_same_file(path, input)) {
        bail!(
            "{} is the input {}: choose another name for the result",
            path.display(),
            input.display()
        );
    }
    if overwriting.force || metadata.len() == 0 {
        return Ok(());
    }
    let mut start = Vec::new();
    let read = File::open(path).and_then(|file| file.take(START).read_to_end(&mut start));
    if read.is_err() || !(kind.is_ours)(&start) {
        bail!("{} exists and is not from this program: {}", path.display(), kind.otherwise);
    }
    Ok(())
}

/// Whether two paths lead to one file, through links of any kind.
fn is_same_file(one: &Path, other: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        let identity = |path| fs::metadata(path).map(|m| (m.dev(), m.ino())).ok();
        identity(one).is_some_and(|one| Some(one) == identity(other))
    }
    #[cfg(not(unix))]
    {
        fs::canonicalize(one).is_ok_and(|one| fs::canonicalize(other).is_ok_and(|o| o == one))
    }
}

/// The files that a model is made from, and the pictures that its material libraries name.
pub(super) fn inputs(model: &Model) -> Vec<PathBuf> {
    let mut inputs = model.inputs.clone();
    for library in model.inputs.iter().skip(1) {
        let text = fs::read(library).unwrap_or_default();
        for line in String::from_utf8_lossy(&text).lines() {
            let Some((keyword, rest)) = line.trim().split_once(char::is_whitespace) else {
                continue;
            };
            let keyword = keyword.to_lowercase();
            if !keyword.starts_with("map_")
                && !["bump", "disp", "decal", "refl", "norm"].contains(&&*keyword)
            {
                continue;
            }
            // Options may stand before the name, and blanks in it: any of its ends may be the name.
            let rest = rest.trim().replace('\\', "/");
            let ends = rest.char_indices().filter(|(_, c)| c.is_whitespace());
            let names = ends.map(|(i, _)| rest[i..].trim()).chain([&*rest]);
            let beside = library.parent().unwrap_or(Path::new(""));
            inputs.extend(names.map(|name| beside.join(name)));
        }
    }
    inputs
}

/// Whether the path stands for the standard input or output.
pub(super) fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Writes a file that [`allow`] allows. A signal that ends the program waits until the file has its
/// name.
pub(super) fn write(path: &Path, contents: &[u8]) -> Result<()> {
    signals::hold();
    let written = write_atomically(path, contents);
    signals::pass_on();
    Ok(written?)
}
