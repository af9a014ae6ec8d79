//! From a file's bytes to its statements, each with the number of its line.
//!
//! Wavefront's format ("Object Files (.obj)", appendix B1 of the Advanced Visualizer manual) has
//! one statement per line. `#` starts a comment, and `\` at the end of a line continues the
//! statement on the next.

use std::{borrow::Cow, fs, path::Path};

use super::error::{LineFault, ModelError};

/// Reads a whole file. Refuses a device or a pipe, which may never end.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, ModelError> {
    let path_buf = || path.to_path_buf();
    let failed = |source| ModelError::Read { path: path_buf(), source };
    let kind = fs::metadata(path).map_err(failed)?;
    if kind.is_dir() {
        return Err(ModelError::Directory { path: path_buf() });
    }
    if !kind.is_file() {
        return Err(ModelError::NotAFile { path: path_buf() });
    }
    fs::read(path).map_err(failed)
}

/// Returns the bytes as text, without a byte order mark.
pub(super) fn text<'a>(path: &Path, bytes: &'a [u8]) -> Result<&'a str, ModelError> {
    match str::from_utf8(bytes) {
        Ok(text) => Ok(text.strip_prefix('\u{feff}').unwrap_or(text)),
        Err(error) => {
            let good = String::from_utf8_lossy(&bytes[..error.valid_up_to()]).replace("\r\n", "\n");
            Err(ModelError::Line {
                path: path.to_path_buf(),
                line: 1 + good.matches(['\n', '\r']).count(),
                fault: LineFault::NotUtf8 { byte: bytes[error.valid_up_to()] },
            })
        }
    }
}

/// A statement: continued lines joined, comment and outer blanks removed, not empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Statement<'a> {
    /// The first of its lines, from 1.
    pub line: usize,
    text: Cow<'a, str>,
}

impl Statement<'_> {
    /// The first word.
    pub(super) fn keyword(&self) -> &str {
        first_word(&self.text).unwrap_or_default()
    }

    /// The words after the first.
    pub(super) fn arguments(&self) -> impl Iterator<Item = &str> {
        self.text.split_whitespace().skip(1)
    }

    /// All the text after the keyword: a name may have blanks.
    pub(super) fn name(&self) -> &str {
        self.text[self.keyword().len()..].trim()
    }
}

/// Splits a text into its statements.
pub(super) fn statements<'a>(text: &'a str) -> Vec<Statement<'a>> {
    let mut statements = Vec::new();
    let mut continued: Option<(usize, String)> = None;
    let mut push = |line, text: Cow<'a, str>| {
        if !text.is_empty() {
            statements.push(Statement { line, text });
        }
    };
    for (index, line) in lines(text).enumerate() {
        let (first, mut before) = continued.take().unwrap_or((index + 1, String::new()));
        let line = without_comment(first_word(&before).or_else(|| first_word(line)), line).trim();
        let (part, goes_on) =
            line.strip_suffix('\\').map_or((line, false), |part| (part.trim(), true));
        if goes_on || !before.is_empty() {
            if !before.is_empty() && !part.is_empty() {
                before.push(' ');
            }
            before.push_str(part);
        }
        if goes_on {
            continued = Some((first, before));
        } else if before.is_empty() {
            push(first, Cow::Borrowed(part));
        } else {
            push(first, Cow::Owned(before));
        }
    }
    if let Some((first, text)) = continued {
        push(first, Cow::Owned(text));
    }
    statements
}

fn first_word(text: &str) -> Option<&str> {
    text.split_whitespace().next()
}

/// Cuts the comment off a line. Names may have a `#` ("Material #25" is a common one), so a
/// statement with a name keeps its whole line.
fn without_comment<'a>(keyword: Option<&str>, line: &'a str) -> &'a str {
    match keyword {
        Some("mtllib" | "newmtl" | "usemtl") => line,
        _ => line.split('#').next().unwrap_or_default(),
    }
}

/// The lines of a text. LF, CR LF or a lone CR ends a line.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = rest.find(['\n', '\r']).unwrap_or(rest.len());
        let (line, tail) = rest.split_at(end);
        rest = tail.strip_prefix("\r\n").unwrap_or_else(|| tail.get(1..).unwrap_or_default());
        Some(line)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str) -> Vec<(usize, String)> {
        statements(text).iter().map(|s| (s.line, s.text.to_string())).collect()
    }

    #[test]
    fn every_line_ending_counts_lines_alike() {
        let expected = [(1, "v 1".into()), (3, "v 2".into())];
        for text in ["v 1\n\nv 2", "v 1\r\n\r\nv 2\r\n", "v 1\r\rv 2\r", "\tv 1 \n \n\tv 2\t\n"] {
            assert_eq!(split(text), expected, "{text:?}");
        }
    }

    #[test]
    fn continued_statements_are_joined_and_keep_their_first_line() {
        assert_eq!(split("f 1 \\\n2\\\r\n  3\nv"), [(1, "f 1 2 3".into()), (4, "v".into())]);
        assert_eq!(split("\\\n\\\nf 1\\"), [(1, "f 1".into())]);
    }

    #[test]
    fn comments_end_statements_but_not_names() {
        assert_eq!(split("v 1 2 3# x\n#v\n # y"), [(1, "v 1 2 3".into())]);
        assert_eq!(split("usemtl Material #25"), [(1, "usemtl Material #25".into())]);
        // A Windows path in a comment does not swallow the next line.
        assert_eq!(split("# C:\\models\\\nv 1"), [(2, "v 1".into())]);
    }

    #[test]
    fn names_keep_inner_blanks() {
        let text = "usemtl \t dark  red ";
        assert_eq!(statements(text)[0].name(), "dark  red");
        assert_eq!(statements(text)[0].keyword(), "usemtl");
    }

    #[test]
    fn bad_byte_is_located() {
        let error = text(Path::new("a.obj"), b"v 0 0 0\r\n# caf\xE9\n").unwrap_err();
        assert!(error.to_string().starts_with("a.obj:2: byte 0xE9 is not UTF-8"), "{error}");
        assert_eq!(text(Path::new("a.obj"), b"\xEF\xBB\xBFv").unwrap(), "v");
    }
}
