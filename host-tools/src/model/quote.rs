//! Text of a file in messages.

use std::path::Path;

/// Escapes the characters that would act on a terminal or that would not be seen: control
/// characters, and Unicode's hard blank and marks of direction and zero width. ESC becomes
/// `\u{1b}`.
#[must_use]
pub fn printable(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for c in text.chars() {
        let is_unseen = c.is_control()
            || matches!(
                c,
                '\u{a0}'
                    | '\u{ad}'
                    | '\u{61c}'
                    | '\u{200b}'..='\u{200f}'
                    | '\u{2028}'..='\u{202e}'
                    | '\u{2060}'..='\u{206f}'
                    | '\u{feff}'
                    | '\u{e0000}'..='\u{e0fff}'
            );
        if is_unseen {
            result.extend(c.escape_unicode());
        } else {
            result.push(c);
        }
    }
    result
}

/// A word of a file for a message: printable, with replacement characters for what is not UTF-8,
/// and shortened, so that a file of one endless line does not become an endless message.
pub(super) fn quote(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    // A character takes four bytes at most.
    let start = String::from_utf8_lossy(&word[..word.len().min(4 * LONGEST)]);
    let short: String = start.chars().take(LONGEST).collect();
    let ending = if short.len() < start.len() || 4 * LONGEST < word.len() { "…" } else { "" };
    printable(&short) + ending
}

/// A path for a message.
pub(super) fn shown(path: &Path) -> String {
    printable(&path.to_string_lossy())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_acts_or_hides_is_escaped() {
        let plain = "C:\\a \"b\" 'c' é e\u{301} 模型 …\u{FFFD}";
        assert_eq!(printable(plain), plain);
        assert_eq!(printable("\u{1b}[2J\r\n"), "\\u{1b}[2J\\u{d}\\u{a}");
        assert_eq!(printable("1\u{a0}0"), "1\\u{a0}0");
        assert_eq!(printable("\u{9b}A\u{202e}\u{7f}"), "\\u{9b}A\\u{202e}\\u{7f}");
    }

    #[test]
    fn words_are_shortened_after_40_characters() {
        assert_eq!(quote(&[b'x'; 40]), "x".repeat(40));
        assert_eq!(quote(&[b'x'; 41]), "x".repeat(40) + "…");
        assert_eq!(quote("模".repeat(40).as_bytes()), "模".repeat(40));
        assert_eq!(quote("模".repeat(99).as_bytes()), "模".repeat(40) + "…");
        assert_eq!(quote(b"caf\xE9"), "caf\u{FFFD}");
    }
}
