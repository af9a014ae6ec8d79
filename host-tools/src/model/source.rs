//! From a file's bytes to its statements, each with the number of its line.
//!
//! Wavefront's format ("Object Files (.obj)", appendix B1 of the Advanced Visualizer manual) has
//! one statement per line. `#` starts a comment, and `\` at the end of a line continues the
//! statement on the next.
//!
//! A file need not be UTF-8: comments and names are often in an older encoding. So a statement is
//! bytes, and only what is read as a number must be text.

use std::{borrow::Cow, fs, path::Path};

use super::error::ModelError;

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

/// Returns the text without a byte order mark. Refuses UTF-16.
pub(super) fn text<'a>(path: &Path, bytes: &'a [u8]) -> Result<&'a [u8], ModelError> {
    if is_utf_16(bytes) {
        return Err(ModelError::Utf16 { path: path.into() });
    }
    Ok(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes))
}

/// Whether a text is UTF-16, with or without a byte order mark. Its ASCII characters have a zero
/// byte each: in most of the pairs, exactly one byte is 0.
fn is_utf_16(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1 << 16)];
    let halves = start.chunks_exact(2).filter(|pair| (pair[0] == 0) != (pair[1] == 0)).count();
    matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]) || 2 * halves > start.len() / 2
}

/// A statement: continued lines joined, comment and outer blanks removed, not empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Statement<'a> {
    /// The first of its lines, from 1.
    pub line: usize,
    text: Cow<'a, [u8]>,
}

impl Statement<'_> {
    /// The first word.
    pub(super) fn keyword(&self) -> &[u8] {
        first_word(&self.text).unwrap_or_default()
    }

    /// The words after the first.
    pub(super) fn arguments(&self) -> impl Iterator<Item = &[u8]> {
        words(&self.text).skip(1)
    }

    /// All the text after the keyword: a name may have blanks.
    pub(super) fn name(&self) -> &[u8] {
        self.text[self.keyword().len()..].trim_ascii()
    }
}

/// Splits a text into its statements.
pub(super) fn statements<'a>(text: &'a [u8]) -> Vec<Statement<'a>> {
    let mut statements = Vec::new();
    let mut continued: Option<(usize, Vec<u8>)> = None;
    let mut push = |line, text: Cow<'a, [u8]>| {
        if !text.is_empty() {
            statements.push(Statement { line, text });
        }
    };
    for (index, line) in lines(text).enumerate() {
        let (first, mut before) = continued.take().unwrap_or((index + 1, Vec::new()));
        let keyword = first_word(&before).or_else(|| first_word(line)).unwrap_or_default();
        let line = if has_name(keyword) { line } else { without_comment(line) }.trim_ascii();
        let (part, goes_on) = match line.strip_suffix(b"\\") {
            Some(part) if can_go_on(keyword, part) => (part.trim_ascii(), true),
            _ => (line, false),
        };
        if goes_on || !before.is_empty() {
            if !before.is_empty() && !part.is_empty() {
                before.push(b' ');
            }
            before.extend_from_slice(part);
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

/// The words of a text.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

fn first_word(text: &[u8]) -> Option<&[u8]> {
    words(text).next()
}

/// Whether the whole line after the keyword is a name. It may have a `#` ("Material #25" is a
/// common one), so it keeps what looks like a comment.
fn has_name(keyword: &[u8]) -> bool {
    matches!(keyword, b"mtllib" | b"newmtl" | b"usemtl" | b"map_Kd")
}

/// Whether a statement whose line is `part` and then `\` goes on in the next line.
///
/// Names may end with `\`, such as the folders of Windows that exporters write as names of groups.
/// So a statement goes on only if numbers are its arguments, or files behind a blank.
fn can_go_on(keyword: &[u8], part: &[u8]) -> bool {
    match keyword.strip_suffix(b"\\").unwrap_or(keyword) {
        b"" | b"v" | b"vt" | b"vn" | b"vp" | b"f" | b"fo" | b"l" | b"p" | b"s" | b"mg" => true,
        b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim" | b"hole" => true,
        b"scrv" | b"sp" | b"con" | b"deg" => true,
        b"Ka" | b"Kd" | b"Ks" | b"Ke" | b"Tf" | b"d" | b"Tr" | b"Ns" | b"Ni" => true,
        b"mtllib" => part.last().is_some_and(u8::is_ascii_whitespace),
        _ => false,
    }
}

/// Cuts the comment off a line. It starts with a `#` at the beginning or at the end of a word, but
/// not inside one: `1.#QNAN` is what some C libraries print for NaN.
fn without_comment(line: &[u8]) -> &[u8] {
    let is_blank = |place: usize| line.get(place).is_none_or(u8::is_ascii_whitespace);
    let mut place = 0;
    while let Some(distance) = line[place..].iter().position(|&byte| byte == b'#') {
        let start = place + distance;
        place = start + line[start..].iter().take_while(|&&byte| byte == b'#').count();
        let starts_word = start == 0 || is_blank(start - 1);
        // "1.#" is a shortened infinity.
        if starts_word || (is_blank(place) && line[start - 1] != b'.') {
            return &line[..start];
        }
    }
    line
}

/// A name without what may be a comment behind it: cut before the first `#` that follows a blank
/// and that `is_comment` accepts by the text behind it.
fn cut(name: &[u8], is_comment: impl Fn(&[u8]) -> bool) -> &[u8] {
    let starts = |i: &usize| name[i - 1].is_ascii_whitespace() && name[*i] == b'#';
    let start = (1..name.len()).find(|i| starts(i) && is_comment(&name[i + 1..]));
    start.map_or(name, |start| name[..start].trim_ascii_end())
}

/// A name without ` # ...`: the `#` is a word.
pub(super) fn without_clear_comment(name: &[u8]) -> &[u8] {
    cut(name, |rest| rest.first().is_none_or(u8::is_ascii_whitespace))
}

/// A name without ` #...`: the `#` is a word or starts one, as in `Material #25`.
pub(super) fn without_possible_comment(name: &[u8]) -> &[u8] {
    cut(name, |_| true)
}

/// The lines of a text. LF, CR LF or a lone CR ends a line.
fn lines(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut rest = text;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let (line, tail) = rest.split_at(end.unwrap_or(rest.len()));
        rest = tail.strip_prefix(b"\r\n").unwrap_or_else(|| tail.get(1..).unwrap_or_default());
        Some(line)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str) -> Vec<(usize, String)> {
        let joined = |s: &Statement<'_>| String::from_utf8_lossy(&s.text).into_owned();
        statements(text.as_bytes()).iter().map(|s| (s.line, joined(s))).collect()
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
        assert_eq!(split("f\\\n1 2 3"), [(1, "f 1 2 3".into())]);
    }

    #[test]
    fn names_may_end_with_the_sign_of_continuation() {
        for line in ["usemtl a\\", "usemtl a \\", "g C:\\a\\", "newmtl \\", "map_Kd C:\\ \\"] {
            assert_eq!(split(&format!("{line}\nv 1")), [(1, line.into()), (2, "v 1".into())]);
        }
        assert_eq!(split("mtllib a \\\nb"), [(1, "mtllib a b".into())]);
        assert_eq!(split("mtllib a\\\nv"), [(1, "mtllib a\\".into()), (2, "v".into())]);
    }

    #[test]
    fn comments_end_statements_but_not_names() {
        assert_eq!(split("v 1 2 3# x\n#v\n # y"), [(1, "v 1 2 3".into())]);
        assert_eq!(split("usemtl Material #25"), [(1, "usemtl Material #25".into())]);
        // A Windows path in a comment does not swallow the next line.
        assert_eq!(split("# C:\\models\\\nv 1"), [(2, "v 1".into())]);
    }

    #[test]
    fn comments_begin_or_end_words() {
        for (line, kept) in [
            ("v 1 #2", "v 1"),
            ("v 1 ## #2", "v 1"),
            ("v 1## 2", "v 1"),
            ("v 1#", "v 1"),
            ("v 1#2 3", "v 1#2 3"),
            ("v 1##2 #3", "v 1##2"),
            ("v 1.#QNAN # 2", "v 1.#QNAN"),
            ("v 1.# 2", "v 1.# 2"),
        ] {
            assert_eq!(split(line), [(1, kept.into())], "{line}");
        }
    }

    #[test]
    fn names_keep_inner_blanks() {
        let text = b"usemtl \t dark  red ";
        assert_eq!(statements(text)[0].name(), b"dark  red");
        assert_eq!(statements(text)[0].keyword(), b"usemtl");
    }

    #[test]
    fn names_are_cut_at_a_blank_and_a_number_sign() {
        let cuts = |name: &'static str| {
            let name = name.as_bytes();
            (without_clear_comment(name), without_possible_comment(name))
        };
        assert_eq!(cuts("a b # c #d"), (&b"a b"[..], &b"a b"[..]));
        assert_eq!(cuts("a #25 # c"), (&b"a #25"[..], &b"a"[..]));
        assert_eq!(cuts("a#1 #"), (&b"a#1"[..], &b"a#1"[..]));
        assert_eq!(cuts("#a"), (&b"#a"[..], &b"#a"[..]));
        assert_eq!(cuts(""), (&b""[..], &b""[..]));
    }

    #[test]
    fn only_utf_16_has_a_zero_in_most_pairs() {
        let path = Path::new("a.obj");
        assert_eq!(text(path, b"\xEF\xBB\xBFv").unwrap(), b"v");
        assert_eq!(text(path, b"v 0\0\0\0\0\0\0\0\0").unwrap(), b"v 0\0\0\0\0\0\0\0\0");
        for bytes in [&b"v\0 \x001\0"[..], b"\0v\0 \x001", b"\xFF\xFEv\0", b"\xFE\xFF"] {
            let error = text(path, bytes).unwrap_err().to_string();
            assert!(error.starts_with("a.obj is UTF-16"), "{error}");
        }
    }
}
