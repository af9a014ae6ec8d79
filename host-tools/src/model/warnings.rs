//! Warnings: one for each kind of fault, with its first place, a count and a few examples.

use std::path::Path;

use super::{
    quote::{quote, shown},
    report::thousands,
};

/// The faults of one kind.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    count: usize,
    /// Path and line of the first.
    place: String,
    /// Different words in which they lie, as examples.
    words: Vec<String>,
    /// How many have a word that is none of the examples.
    others: usize,
}

impl Tally {
    /// How many words a warning shows.
    const EXAMPLES: usize = 3;

    /// Counts a fault.
    pub(super) fn add(&mut self, path: &Path, line: usize) {
        if self.count == 0 {
            self.place = format!("{}:{line}", shown(path));
        }
        self.count += 1;
    }

    /// Counts a fault and keeps its word as an example.
    pub(super) fn add_word(&mut self, path: &Path, line: usize, word: &[u8]) {
        self.add(path, line);
        if self.words.len() < Self::EXAMPLES {
            let word = format!("`{}`", quote(word));
            if !self.words.contains(&word) {
                self.words.push(word);
            }
        } else {
            self.others += usize::from(!self.words.contains(&format!("`{}`", quote(word))));
        }
    }

    /// How many faults there are.
    pub(super) const fn count(&self) -> usize {
        self.count
    }

    /// The count and the name of what is counted.
    pub(super) fn counted(&self, singular: &str, plural: &str) -> String {
        let name = if self.count == 1 { singular } else { plural };
        format!("{} {name}", thousands(self.count))
    }

    /// Says that the faults are ignored, and how many they are if there are several.
    pub(super) fn ignored(&self) -> String {
        if self.count == 1 {
            "ignored".to_owned()
        } else {
            format!("ignored {} times", thousands(self.count))
        }
    }

    /// The examples, and how many others there are.
    pub(super) fn examples(&self) -> String {
        let words = self.words.join(", ");
        if self.others == 0 {
            words
        } else {
            format!("{words} and {} more", thousands(self.others))
        }
    }

    /// Adds the warning, if there is a fault. `text` is what follows its place.
    pub(super) fn warn(&self, warnings: &mut Vec<String>, text: impl FnOnce(&Self) -> String) {
        if self.count > 0 {
            warnings.push(format!("{}: {}", self.place, text(self)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn warning(words: &[&str]) -> Vec<String> {
        let mut tally = Tally::default();
        for (index, word) in words.iter().enumerate() {
            tally.add_word(Path::new("m.obj"), index + 7, word.as_bytes());
        }
        let mut warnings = Vec::new();
        tally.warn(&mut warnings, |t| format!("{}: {}", t.counted("fly", "flies"), t.examples()));
        warnings
    }

    #[test]
    fn faults_of_a_kind_are_one_warning() {
        assert_eq!(warning(&[]), [""; 0]);
        assert_eq!(warning(&["a"]), ["m.obj:7: 1 fly: `a`"]);
        assert_eq!(warning(&["a", "a", "\u{1b}"]), ["m.obj:7: 3 flies: `a`, `\\u{1b}`"]);
        let expected = "m.obj:7: 6 flies: `a`, `b`, `c` and 2 more";
        assert_eq!(warning(&["a", "b", "c", "d", "a", "e"]), [expected]);
        assert!(warning(&vec!["a"; 1_234])[0].starts_with("m.obj:7: 1,234 flies: `a`"));
    }
}
