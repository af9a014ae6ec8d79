//! The colours of vertices: `v x y z r g b`, which no manual of the format has and many programs
//! write.
//!
//! Red, green and blue run from 0 to 1, in the values that pictures store. A file whose numbers are
//! all whole and go up to 255 counts in 255ths. A fourth number alone is a weight, which only
//! curves have. A seventh is taken for an alpha, as other readers do, and ignored.

use std::path::Path;

use super::{Contents, source::Statement, warnings::Tally};

/// How many numbers a place has, and a place with its colour.
const PLACE: usize = 3;
const COLORED: usize = 6;

/// How the colours of a file are read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct VertexColors {
    /// What makes 255ths of a number; `None` if the file has no colours or none are kept.
    to_255ths: Option<f64>,
}

/// What a statement has behind the coordinates.
enum Behind<'a> {
    /// Nothing, or a weight.
    Nothing,
    Color([f64; 3]),
    /// Something else, with the word that is wrong, or the last one of too few.
    Fault(&'a [u8]),
}

fn behind<'a>(statement: &'a Statement<'_>) -> Behind<'a> {
    let count = statement.arguments().take(COLORED).count();
    let mut color = [0.0; 3];
    let mut last = None;
    for (channel, word) in color.iter_mut().zip(statement.arguments().skip(PLACE)) {
        let number = str::from_utf8(word).ok().and_then(|text| text.parse::<f64>().ok());
        let Some(number) = number.filter(|number| number.is_finite()) else {
            return Behind::Fault(word);
        };
        *channel = number;
        last = Some(word);
    }
    match last {
        Some(_) if count == COLORED => Behind::Color(color),
        Some(word) if count > PLACE + 1 => Behind::Fault(word),
        _ => Behind::Nothing,
    }
}

impl VertexColors {
    /// Reads the statements of a file ahead. Adds a warning for each kind of doubt.
    pub(super) fn of(
        path: &Path,
        statements: &[Statement<'_>],
        contents: Contents,
        warnings: &mut Vec<String>,
    ) -> Self {
        if !contents.vertex_colors {
            return Self::default();
        }
        let (mut faulty, mut colorless) = (Tally::default(), Tally::default());
        let (mut over, mut outside) = (Tally::default(), Tally::default());
        let (mut colored, mut are_steps) = (false, true);
        for statement in statements.iter().filter(|s| s.keyword() == b"v") {
            match behind(statement) {
                Behind::Nothing => colorless.add(path, statement.line),
                Behind::Fault(word) => faulty.add_word(path, statement.line, word),
                Behind::Color(color) => {
                    colored = true;
                    are_steps &=
                        color.iter().all(|c| c.fract() == 0.0 && (0.0..=255.0).contains(c));
                    if color.iter().any(|&c| c > 1.0) {
                        over.add(path, statement.line);
                    }
                    if color.iter().any(|c| !(0.0..=1.0).contains(c)) {
                        outside.add(path, statement.line);
                    }
                }
            }
        }
        faulty.warn(warnings, |tally| {
            let vertices = tally.counted("vertex has", "vertices have");
            format!(
                "{vertices} no colour that can be read ({}): write `v x y z r g b` with numbers from \
                 0 to 1",
                tally.examples()
            )
        });
        if !colored {
            return Self::default();
        }
        are_steps &= over.count() > 0;
        if are_steps {
            over.warn(warnings, |_| {
                "colours of vertices over 1, all of whole numbers up to 255: read as 255ths".into()
            });
        } else {
            outside.warn(warnings, |tally| {
                let vertices = tally.counted("vertex has", "vertices have");
                format!("{vertices} a colour outside 0 to 1: taken for the nearest one inside")
            });
        }
        colorless.warn(warnings, |tally| {
            let vertices = tally.counted("vertex has", "vertices have");
            format!("{vertices} no colour, unlike others: drawn in the colour of the material")
        });
        Self { to_255ths: Some(if are_steps { 1.0 } else { 255.0 }) }
    }

    /// What `tobj` gets behind a vertex's coordinates: the colour from 0 to 255, or NaN for none.
    pub(super) fn text(&self, statement: &Statement<'_>) -> String {
        let Some(to_255ths) = self.to_255ths else { return String::new() };
        match behind(statement) {
            Behind::Color(color) => {
                let [red, green, blue] = color.map(|c| (c * to_255ths).clamp(0.0, 255.0));
                format!(" {red} {green} {blue}")
            }
            Behind::Nothing | Behind::Fault(_) => " NaN NaN NaN".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{super::source::statements, *};

    /// The colours of a file, one line for each vertex, and its warnings.
    fn read(text: &str) -> (Vec<String>, Vec<String>) {
        let (statements, mut warnings) = (statements(text.as_bytes()), Vec::new());
        let contents = Contents::default();
        let colors = VertexColors::of(Path::new("m.obj"), &statements, contents, &mut warnings);
        (statements.iter().map(|s| colors.text(s)).collect(), warnings)
    }

    fn one_warning(text: &str, parts: &[&str]) -> Vec<String> {
        let (colors, warnings) = read(text);
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(parts.iter().all(|part| warnings[0].contains(part)), "{warnings:?}");
        colors
    }

    #[test]
    fn files_without_colours_say_nothing() {
        for text in ["v 0 0 0\nv 1 0 0 1", "v 1 1 1 0.5\nvn 0 0 1 1 1 1"] {
            let (colors, warnings) = read(text);
            assert_eq!((colors.concat().as_str(), warnings.len()), ("", 0));
        }
        let statements = statements(b"v 0 0 0 1 x 1\nv 0 0 0 1 1 1");
        let contents = Contents { vertex_colors: false, ..Contents::default() };
        let mut warnings = Vec::new();
        let none = VertexColors::of(Path::new("m.obj"), &statements, contents, &mut warnings);
        assert_eq!((none, warnings.len()), (VertexColors::default(), 0));
    }

    #[test]
    fn numbers_run_from_0_to_1() {
        let (colors, warnings) = read("v 0 0 0 1 0 0.2\nv 0 0 0 1 1 0\nv 9 9 9 0 1 0 0.5");
        assert_eq!(colors, [" 255 0 51", " 255 255 0", " 0 255 0"]);
        assert_eq!(warnings, [""; 0]);
    }

    #[test]
    fn whole_numbers_up_to_255_are_255ths() {
        let colors = one_warning("v 0 0 0 1 0 0\nv 0 0 0 12 255.0 0", &["m.obj:2: ", "255ths"]);
        assert_eq!(colors, [" 1 0 0", " 12 255 0"]);
    }

    #[test]
    fn other_numbers_are_clamped() {
        for (text, clamped) in [
            ("v 0 0 0 1.5 -0.5 0\nv 0 0 0 3 0 0", " 255 0 0"),
            ("v 0 0 0 256 0 0\nv 0 0 0 255 0 0", " 255 0 0"),
            ("v 0 0 0 0 0 -1\nv 0 0 0 2 0 -1", " 255 0 0"),
        ] {
            let colors = one_warning(text, &["m.obj:1: 2 vertices have a colour outside 0 to 1"]);
            assert_eq!(colors[1], clamped, "{text}");
        }
    }

    #[test]
    fn what_is_no_colour_is_told_with_its_line() {
        for (line, word) in [
            ("v 0 0 0 1 0", "`0`"),
            ("v 0 0 0 red 0 0", "`red`"),
            ("v 0 0 0 0.5 nan 0.5", "`nan`"),
            ("v 0 0 0 1 1 1e999", "`1e999`"),
            ("v 0 0 0 0,5 0,5 0,5", "`0,5`"),
            ("v 0 0 0 \u{fffd}", "`"),
        ] {
            let parts = ["m.obj:2: 1 vertex has no colour that can be read", word];
            let colors = one_warning(&format!("v 0 0 0 0 0 0\n{line}\nv 1 1 1 1 1 1"), &parts);
            assert_eq!(colors, [" 0 0 0", " NaN NaN NaN", " 255 255 255"]);
        }
    }

    #[test]
    fn a_colour_that_others_lack_is_told() {
        let parts = ["m.obj:1: 2 vertices have no colour, unlike others"];
        let colors = one_warning("v 0 0 0\nv 0 0 0 1 1 1\nv 0 0 0 0.5", &parts);
        assert_eq!(colors, [" NaN NaN NaN", " 255 255 255", " NaN NaN NaN"]);
    }
}
