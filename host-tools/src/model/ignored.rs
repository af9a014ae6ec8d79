//! What of an OBJ file has no place in the tables.

use std::path::Path;

use super::{smoothing::Smoothing, source::Statement, warnings::Tally};

/// The statements that are left out although they show something, or that are not understood.
#[derive(Clone, Debug, Default)]
pub(super) struct Ignored {
    curves: Tally,
    calls: Tally,
    nameless: Tally,
    smoothing: Tally,
    unknown: Tally,
}

impl Ignored {
    /// Counts a statement if it is left out.
    pub(super) fn count(&mut self, path: &Path, statement: &Statement<'_>) {
        let tally = match statement.keyword() {
            b"curv" | b"surf" | b"bsp" | b"bzp" | b"cdc" | b"cdp" => &mut self.curves,
            b"call" | b"csh" => &mut self.calls,
            b"usemtl" if statement.name().is_empty() => &mut self.nameless,
            b"s" if Smoothing::of(statement).is_none() => {
                return self.smoothing.add_word(path, statement.line, statement.name());
            }
            word if !is_known(word) => {
                return self.unknown.add_word(path, statement.line, word);
            }
            _ => return,
        };
        tally.add(path, statement.line);
    }

    /// Adds a warning for each kind.
    pub(super) fn warn(&self, warnings: &mut Vec<String>) {
        for (tally, singular, plural, keywords) in [
            (&self.curves, "curve or surface", "curves and surfaces", "`curv`, `surf`"),
            (&self.calls, "call of another file", "calls of other files", "`call`"),
        ] {
            tally.warn(warnings, |tally| {
                format!("{} ({keywords}): left out", tally.counted(singular, plural))
            });
        }
        self.nameless
            .warn(warnings, |tally| format!("`usemtl` without a name: {}", tally.ignored()));
        self.smoothing.warn(warnings, |tally| {
            format!("`s` needs a number or `off` ({}): {}", tally.examples(), tally.ignored())
        });
        self.unknown.warn(warnings, |tally| {
            let lines = tally.counted("line begins", "lines begin");
            format!("{lines} with an unknown word: {}: ignored", tally.examples())
        });
    }
}

/// The format's statements. Besides those that are read or counted, these name things, describe
/// curves or set how Wavefront's renderers draw.
const KNOWN: &str = "v vt vn f fo l p usemtl mtllib o g s mg vp cstype deg bmat step curv2 parm trim \
                     hole scrv sp end con ctech stech res bevel c_interp d_interp lod usemap \
                     maplib shadow_obj trace_obj";

fn is_known(keyword: &[u8]) -> bool {
    KNOWN.split(' ').any(|known| known.as_bytes() == keyword)
}
