//! The statement `map_Kd` of a material library: options, then the name of a picture.

use super::source::Statement;

/// The texture of a material.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TextureMap {
    /// The line of its `map_Kd`.
    pub line: usize,
    /// The name of the picture as written.
    pub file: Vec<u8>,
    /// Whether it ends at its borders instead of repeating (`-clamp on`).
    pub clamps: bool,
    /// The factors of u and v (`-s`).
    scale: [f64; 2],
    /// What is added to u and v after that (`-o`).
    offset: [f64; 2],
}

impl TextureMap {
    /// Reads a statement; `None` if it names no file. Calls `ignore` with each option that has no
    /// effect.
    pub(super) fn read(statement: &Statement<'_>, mut ignore: impl FnMut(&[u8])) -> Option<Self> {
        let mut map = Self {
            line: statement.line,
            file: Vec::new(),
            clamps: false,
            scale: [1.0; 2],
            offset: [0.0; 2],
        };
        let mut rest = statement.name();
        loop {
            let (option, behind) = split(rest);
            let word = split(behind).0;
            match option {
                b"-s" => rest = set(&mut map.scale, behind),
                b"-o" => rest = set(&mut map.offset, behind),
                b"-clamp" if matches!(word, b"on" | b"off") => {
                    map.clamps = word == b"on";
                    rest = split(behind).1;
                }
                b"-t" | b"-mm" | b"-texres" | b"-boost" | b"-bm" => {
                    ignore(option);
                    rest = set(&mut [0.0; 2], behind);
                }
                b"-blendu" | b"-blendv" | b"-cc" | b"-clamp" | b"-imfchan" | b"-type" => {
                    ignore(option);
                    rest = split(behind).1;
                }
                _ => break,
            }
        }
        map.file = rest.into();
        (!rest.is_empty()).then_some(map)
    }

    /// Texture coordinates of a face, as the picture has them.
    pub(super) fn place(&self, texture: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| texture[axis] * self.scale[axis] + self.offset[axis])
    }
}

/// The first word, and what follows the blanks behind it.
fn split(text: &[u8]) -> (&[u8], &[u8]) {
    let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    (&text[..end], text[end..].trim_ascii_start())
}

/// Reads up to three numbers, and returns what follows them. The second and the third may be left
/// out; the last word is the file's name, even if it is a number.
fn set<'a>(values: &mut [f64; 2], text: &'a [u8]) -> &'a [u8] {
    let mut rest = text;
    for place in 0..3 {
        let (word, behind) = split(rest);
        let number = str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        let Some(number) = number.filter(|n: &f64| n.is_finite() && !behind.is_empty()) else {
            break;
        };
        if let Some(value) = values.get_mut(place) {
            *value = number;
        }
        rest = behind;
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::{super::source::statements, *};

    fn read(text: &str) -> (Option<TextureMap>, Vec<String>) {
        let text = format!("map_Kd {text}");
        let mut ignored = Vec::new();
        let map = TextureMap::read(&statements(text.as_bytes())[0], |option| {
            ignored.push(String::from_utf8_lossy(option).into_owned());
        });
        (map, ignored)
    }

    #[test]
    fn options_come_before_a_name_with_blanks() {
        let (map, ignored) = read("-clamp on  -s 2 3 4 -o 0.5 -0.25 my dark  wood.png");
        let map = map.unwrap();
        assert_eq!((&map.file[..], map.clamps), (&b"my dark  wood.png"[..], true));
        assert_eq!((map.scale, map.offset), ([2.0, 3.0], [0.5, -0.25]));
        assert_eq!(map.place([1.0, -1.0]), [2.5, -3.25]);
        assert_eq!(ignored, [""; 0]);
        let plain = read("C:\\a b\\wood.png").0.unwrap();
        assert_eq!((&plain.file[..], plain.clamps), (&b"C:\\a b\\wood.png"[..], false));
        assert_eq!(plain.place([0.25, 7.0]), [0.25, 7.0]);
    }

    #[test]
    fn numbers_may_be_left_out_but_not_the_name() {
        let one = read("-s 2 a.png").0.unwrap();
        assert_eq!((one.scale, &one.file[..]), ([2.0, 1.0], &b"a.png"[..]));
        let name = read("-o 1 2 3").0.unwrap();
        assert_eq!((name.offset, &name.file[..]), ([1.0, 2.0], &b"3"[..]));
        assert_eq!(read("-s nan a.png").0.unwrap().file, b"nan a.png");
        assert_eq!(read("-4 x.png").0.unwrap().file, b"-4 x.png");
        for nothing in ["-clamp on", "-blendu off", "-s", "-o", "-mm 0"] {
            let map = read(nothing).0;
            assert!(map.is_none_or(|map| map.file == b"0"), "{nothing}");
        }
    }

    #[test]
    fn other_options_are_told() {
        let text = "-blendu on -blendv off -cc on -mm 0 1 -t 1 2 3 -texres 256 -imfchan r -boost 2 \
                    -bm 1 -type sphere -clamp maybe a.png";
        let (map, ignored) = read(text);
        assert_eq!(map.unwrap().file, b"a.png");
        assert_eq!(ignored.len(), 11, "{ignored:?}");
    }
}
