//! A material library, an MTL file: what of it matters to colour.
//!
//! A model without its colours is still a model, so each fault is a warning.

use std::path::Path;

use rasterizer::mesh::Finish;

use super::{
    source::{self, Statement},
    texture_map::TextureMap,
    warnings::Tally,
};

/// The exponent of a material that has `Ks` without `Ns`: the format names none, and others take
/// 30.
const DEFAULT_EXPONENT: f64 = 30.0;

/// A material.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Definition {
    pub name: Vec<u8>,
    /// The line of its `newmtl`.
    pub line: usize,
    /// Its last valid `Kd` and the line of that.
    pub color: Option<([f64; 3], usize)>,
    /// Its texture, the last `map_Kd`.
    pub texture: Option<TextureMap>,
    /// The light that it gives off, by its last valid `Ke`.
    emission: [f64; 3],
    /// The colour of its highlights, by its last valid `Ks`.
    specular: [f64; 3],
    /// Its last valid `Ns`.
    exponent: Option<f64>,
    /// The opacity by its last valid `d` and the line of that.
    dissolve: Option<(f64, usize)>,
    /// The transparency by its last valid `Tr` and the line of that.
    transparency: Option<(f64, usize)>,
    /// The line of its texture of opacity, `map_d`.
    opacity_texture: Option<usize>,
    /// The line of its texture of highlights, `map_Ks`.
    specular_texture: Option<usize>,
}

impl Definition {
    /// What it shows besides its colour, in the numbers of a table.
    pub(super) fn finish(&self) -> Finish {
        let mut finish = Finish::MATTE
            .with_emission(quantised(self.emission))
            .with_opacity(quantised_channel(self.opacity().map_or(1.0, |(opacity, _)| opacity)));
        let specular = quantised(self.specular);
        if specular != [0; 3] {
            let exponent = self.exponent.unwrap_or(DEFAULT_EXPONENT);
            let exponent = exponent.clamp(1.0, f64::from(Finish::MOST_EXPONENT)).round();
            finish = finish.with_specular(specular, exponent as u16);
        }
        finish
    }

    /// The opacity, from 0 to 1 if the file does not go beyond that, and the line that gives it.
    /// Some programs write opacity as `Tr`, so a `d` beside it is what counts.
    fn opacity(&self) -> Option<(f64, usize)> {
        self.dissolve.or(self.transparency.map(|(transparency, line)| (1.0 - transparency, line)))
    }

    /// The line that makes it transparent.
    pub(super) fn transparent_line(&self) -> Option<usize> {
        let by_number = self.opacity().filter(|&(opacity, _)| opacity < 1.0);
        by_number.map(|(_, line)| line).or(self.opacity_texture)
    }

    /// Whether it shines by itself.
    fn is_emissive(&self) -> bool {
        self.emission != [0.0; 3]
    }

    /// The line of a texture that its highlights lack.
    pub(super) fn gloss_line(&self) -> Option<usize> {
        self.specular_texture.filter(|_| self.specular != [0.0; 3])
    }

    /// The line of its `Kd` if that is black although the material has a colour: that of a texture
    /// or of its own light.
    pub(super) fn black_line(&self) -> Option<usize> {
        let ([r, g, b], line) = self.color?;
        let is_black = r.max(g).max(b) <= 0.0 && (self.texture.is_some() || self.is_emissive());
        is_black.then_some(line)
    }

    /// The line of its `Kd` if that is no grey, and there is a texture.
    pub(super) fn tint_line(&self) -> Option<usize> {
        let ([r, g, b], line) = self.color?;
        (self.texture.is_some() && (r, g) != (g, b)).then_some(line)
    }
}

/// The faults of all libraries.
#[derive(Clone, Debug, Default)]
pub(super) struct Faults {
    nameless: Tally,
    early: Tally,
    color: Tally,
    shine: Tally,
    number: Tally,
    option: Tally,
}

impl Faults {
    pub(super) fn warn(&self, warnings: &mut Vec<String>) {
        for (tally, fault) in [
            (&self.early, "`Kd` before any `newmtl`"),
            (&self.color, "`Kd` needs three numbers from 0 to 1"),
            (&self.shine, "`Ks` and `Ke` need three numbers from 0 to 1"),
            (&self.number, "`Ns`, `d` and `Tr` need a number"),
            (&self.nameless, "`newmtl` without a name"),
        ] {
            tally.warn(warnings, |tally| format!("{fault}: {}", tally.ignored()));
        }
        self.option.warn(warnings, |tally| {
            let options = tally.counted("option", "options");
            format!("{options} of `map_Kd` without effect here: {}: ignored", tally.examples())
        });
    }
}

/// Reads the materials of a library's text.
pub(super) fn definitions(path: &Path, text: &[u8], faults: &mut Faults) -> Vec<Definition> {
    let mut definitions: Vec<Definition> = Vec::new();
    let mut has_name = false;
    for statement in source::statements(text) {
        let line = statement.line;
        if statement.keyword() == b"newmtl" {
            let name = statement.name().to_vec();
            has_name = !name.is_empty();
            if has_name {
                definitions.push(Definition { name, line, ..Definition::default() });
            } else {
                faults.nameless.add(path, line);
            }
            continue;
        }
        let Some(material) = definitions.last_mut().filter(|_| has_name) else {
            if statement.keyword() == b"Kd" {
                faults.early.add(path, line);
            }
            continue;
        };
        let has_arguments = statement.arguments().next().is_some();
        match statement.keyword() {
            b"Kd" => match color(&statement) {
                Some(color) => material.color = Some((color, line)),
                None => faults.color.add(path, line),
            },
            keyword @ (b"Ks" | b"Ke") => match color(&statement) {
                Some(color) if keyword == b"Ks" => material.specular = color,
                Some(color) => material.emission = color,
                None => faults.shine.add(path, line),
            },
            keyword @ (b"Ns" | b"d" | b"Tr") => match (last_number(&statement), keyword) {
                (None, _) => faults.number.add(path, line),
                (exponent, b"Ns") => material.exponent = exponent,
                (Some(opacity), b"d") => material.dissolve = Some((opacity, line)),
                (Some(transparency), _) => material.transparency = Some((transparency, line)),
            },
            b"map_Kd" => {
                let ignore = |option: &[u8]| faults.option.add_word(path, line, option);
                material.texture = TextureMap::read(&statement, ignore).or(material.texture.take());
            }
            b"map_d" if has_arguments => material.opacity_texture = Some(line),
            b"map_Ks" if has_arguments => material.specular_texture = Some(line),
            _ => {}
        }
    }
    definitions
}

/// Reads `Kd r g b`; `Kd r` is the grey of that value.
fn color(statement: &Statement<'_>) -> Option<[f64; 3]> {
    let values: Vec<f64> = statement.arguments().map(number).collect::<Option<_>>()?;
    match values[..] {
        [grey] => Some([grey; 3]),
        [r, g, b, ..] => Some([r, g, b]),
        _ => None,
    }
}

/// A colour from 0 to 1 in 255ths.
pub(super) fn quantised(color: [f64; 3]) -> [u8; 3] {
    color.map(quantised_channel)
}

fn quantised_channel(value: f64) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0).round() as u8
}

fn number(word: &[u8]) -> Option<f64> {
    str::from_utf8(word).ok()?.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Reads `d 0.5` or `d -halo 0.5`.
fn last_number(statement: &Statement<'_>) -> Option<f64> {
    statement.arguments().last().and_then(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &[u8]) -> (Vec<Definition>, Vec<String>) {
        let mut faults = Faults::default();
        let definitions = definitions(Path::new("a.mtl"), text, &mut faults);
        let mut warnings = Vec::new();
        faults.warn(&mut warnings);
        (definitions, warnings)
    }

    #[test]
    fn colours_are_read_and_everything_else_is_ignored() {
        let text = b"# c\r\nnewmtl\tdark red\r\nillum what\r\nKd 0.5 0 \\\r\n0 # c\r\n\
                     newmtl g\r\nKd 0.25\r\nKa 1";
        let (definitions, warnings) = read(text);
        let colors: Vec<_> = definitions.iter().map(|d| (&d.name[..], d.line, d.color)).collect();
        let expected =
            [(&b"dark red"[..], 2, Some(([0.5, 0.0, 0.0], 4))), (b"g", 6, Some(([0.25; 3], 7)))];
        assert_eq!((colors.as_slice(), &warnings[..]), (&expected[..], &[][..]));
    }

    #[test]
    fn faults_are_warnings_with_file_and_line() {
        let (_, warnings) = read(b"Kd 1 1 1\nnewmtl r\nKd 1 1\nKd nan 0 0\nnewmtl\nKd 1 1 1\n");
        assert_eq!(
            warnings,
            [
                "a.mtl:1: `Kd` before any `newmtl`: ignored 2 times",
                "a.mtl:3: `Kd` needs three numbers from 0 to 1: ignored 2 times",
                "a.mtl:5: `newmtl` without a name: ignored",
            ]
        );
    }

    #[test]
    fn opacity_goes_before_transparency() {
        for (text, opacity, line) in [
            ("d 1\nTr 1", 255, None),
            ("Tr 1", 0, Some(2)),
            ("Tr 0.25", 191, Some(2)),
            ("Tr 0\nd 0.5", 128, Some(3)),
            ("d -halo 0.5", 128, Some(2)),
            ("d 1\nmap_d a.png", 255, Some(3)),
            ("d x\nTr\nmap_d", 255, None),
            ("d 0.2\nd x", 51, Some(2)),
            ("d -3", 0, Some(2)),
            ("Tr -1", 255, None),
        ] {
            let (definitions, _) = read(format!("newmtl a\n{text}").as_bytes());
            let finish = Finish::MATTE.with_opacity(opacity);
            let got = (definitions[0].finish(), definitions[0].transparent_line());
            assert_eq!(got, (finish, line), "{text}");
        }
    }

    #[test]
    fn highlights_and_light_are_read() {
        let matte = Finish::MATTE;
        for (text, finish, faults) in [
            ("Ns 250", matte, 0),
            ("Ks 0 0 0\nNs 250\nKe 0 0 0\nillum 2", matte, 0),
            ("Ks 1 0.5 0\nNs 96.4", matte.with_specular([255, 128, 0], 96), 0),
            ("Ks 0.2", matte.with_specular([51; 3], 30), 0),
            ("Ks 1\nNs 0", matte.with_specular([255; 3], 1), 0),
            ("Ks 9 -1 0\nNs 4000", matte.with_specular([255, 0, 0], 1000), 0),
            ("Ke 0 0.2 4\nmap_Ks a.png", matte.with_emission([0, 51, 255]), 0),
            ("Ks 0 0\nKe spectral a.rfl\nNs\nd x", matte, 2),
        ] {
            let (definitions, warnings) = read(format!("newmtl a\n{text}").as_bytes());
            assert_eq!((definitions[0].finish(), warnings.len()), (finish, faults), "{text}");
        }
    }

    #[test]
    fn a_texture_of_highlights_is_lost_where_there_are_highlights() {
        for (text, line) in [
            ("map_Ks a.png", None),
            ("map_Ks a.png\nKs 0 0 0", None),
            ("Ks 0.5 0 0\nmap_Ks", None),
            ("Ks 0.5 0 0\nmap_Ks a.png", Some(3)),
        ] {
            let (definitions, _) = read(format!("newmtl a\n{text}").as_bytes());
            assert_eq!(definitions[0].gloss_line(), line, "{text}");
        }
    }

    #[test]
    fn black_hides_a_colour_only_where_there_is_another() {
        for (text, line) in [
            ("Kd 0 0 0", None),
            ("map_Kd a.png\nKd 0 0 0", Some(3)),
            ("Kd 0 0 0\nKe 0 0 0", None),
            ("Kd 0\nKe 1 0 0", Some(2)),
            ("map_Kd a.png\nKd 0 0 0.1", None),
            ("map_Kd a.png", None),
        ] {
            let (definitions, _) = read(format!("newmtl a\n{text}").as_bytes());
            assert_eq!(definitions[0].black_line(), line, "{text}");
        }
    }
}
