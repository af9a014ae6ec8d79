//! The colours and textures of an OBJ's materials, from its material libraries.

use std::{
    collections::{HashMap, HashSet},
    path::{Path, PathBuf},
};

use rasterizer::mesh::Finish;

use super::{
    Contents, Provenance,
    error::ModelError,
    library_path,
    mtl::{self, Definition, Faults, quantised},
    quote::shown,
    source::{self, without_clear_comment, without_possible_comment},
    texture_map::TextureMap,
    textures::Wanted,
    validate::Checked,
    warnings::Tally,
};

/// The colour of a face without a material, or with one whose colour is unknown.
pub(super) const DEFAULT_COLOR: [u8; 3] = [200; 3];

/// What becomes of the textures that materials have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Pictures {
    /// They are kept, and take the place of `Kd`.
    Kept,
    /// They are not wanted.
    #[default]
    LeftOut,
    /// No face has texture coordinates.
    Unplaced,
}

/// A material that a library defines.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Material {
    /// Its colour.
    pub color: [u8; 3],
    /// What it shows besides.
    pub finish: Finish,
    /// Whether the mean colour of its texture is a better one: it has no `Kd`, or a black one.
    pub takes_mean: bool,
    /// Its texture, and the library that names it.
    pub map: Option<(TextureMap, PathBuf)>,
}

/// All libraries of a model.
#[derive(Clone, Debug, Default)]
pub(super) struct Libraries {
    /// All materials that they define.
    pub materials: Vec<Material>,
    /// For each of the OBJ's [`materials`](Checked::materials), its index in `materials`.
    pub chosen: Vec<Option<usize>>,
    /// The files named, readable or not.
    pub paths: Vec<PathBuf>,
    /// The files read.
    pub files: Vec<Provenance>,
    /// What is missing, broken or dropped.
    pub warnings: Vec<String>,
}

/// Reads the libraries that the OBJ file at `obj` names, and finds its materials in them.
pub(super) fn load(
    obj: &Path,
    checked: &Checked,
    contents: Contents,
    pictures: Pictures,
) -> Libraries {
    let mut libraries = Libraries::default();
    let mut defined = Vec::new();
    let mut faults = Faults::default();
    let mut known = HashSet::new();
    let (mut no_file, mut unread) = (Tally::default(), Unread::default());
    for (line, argument) in &checked.libraries {
        let paths = library_path::files(obj, argument);
        if paths.is_empty() {
            no_file.add_word(obj, *line, argument);
        }
        for path in paths {
            if !known.insert(path.clone()) {
                continue;
            }
            match library(&path, &mut faults) {
                Ok((file, definitions)) => {
                    defined.extend(definitions.into_iter().map(|d| (libraries.paths.len(), d)));
                    libraries.files.push(file);
                }
                Err(error) => unread.add(obj, *line, &path, &error),
            }
            libraries.paths.push(path);
        }
    }
    no_file.warn(&mut libraries.warnings, |tally| {
        format!("`mtllib` names no file ({}): {}", tally.examples(), tally.ignored())
    });
    unread.warn(&mut libraries.warnings);
    faults.warn(&mut libraries.warnings);

    let names = Names::of(&defined);
    libraries.chosen = checked.materials.iter().map(|(_, name)| names.find(name)).collect();
    libraries.materials = (defined.iter())
        .map(|(file, material)| {
            let map = material.texture.clone();
            Material {
                color: material.color.map_or(DEFAULT_COLOR, |(color, _)| quantised(color)),
                finish: material.finish(),
                takes_mean: material.color.is_none() || material.black_line().is_some(),
                map: map.map(|map| (map, libraries.paths[*file].clone())),
            }
        })
        .collect();
    let is_colorless = |material: &Definition| {
        material.color.is_none() && (pictures != Pictures::Kept || material.texture.is_none())
    };
    let mut colorless = Tally::default();
    for ((line, name), chosen) in checked.materials.iter().zip(&libraries.chosen) {
        if chosen.is_none_or(|chosen| is_colorless(&defined[chosen].1)) {
            colorless.add_word(obj, *line, name);
        }
    }
    colorless.warn(&mut libraries.warnings, |tally| {
        format!(
            "no material library gives {} a colour (`newmtl NAME`, then `Kd r g b`): drawn in grey",
            tally.examples()
        )
    });
    dropped(&defined, &names.again, contents, pictures, &mut libraries);
    libraries
}

impl Libraries {
    /// What a material shows besides its colour, by its index in `materials` or one past the end.
    pub(super) fn finish(&self, material: usize) -> Finish {
        self.materials.get(material).map(|material| material.finish).unwrap_or_default()
    }

    /// The texture of a material, by its index in `materials` or one past the end.
    pub(super) fn wanted(&self, material: usize) -> Option<Wanted> {
        let (map, library) = self.materials.get(material)?.map.as_ref()?;
        Some(Wanted {
            picture: library_path::picture(library, &map.file),
            place: (library.clone(), map.line),
            clamps: map.clamps,
        })
    }
}

/// Reads a library.
fn library(path: &Path, faults: &mut Faults) -> Result<(Provenance, Vec<Definition>), ModelError> {
    let bytes = source::read(path)?;
    let definitions = mtl::definitions(path, source::text(path, &bytes)?, faults);
    Ok((Provenance::of(path, &bytes), definitions))
}

/// The libraries that cannot be read.
#[derive(Default)]
struct Unread {
    first: Option<String>,
    others: Tally,
}

impl Unread {
    fn add(&mut self, obj: &Path, line: usize, path: &Path, error: &ModelError) {
        if self.first.is_none() {
            let obj = shown(obj);
            self.first =
                Some(format!("{error} (named in {obj}:{line}; its materials are drawn in grey)"));
        } else {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            self.others.add_word(obj, line, name.as_bytes());
        }
    }

    fn warn(&self, warnings: &mut Vec<String>) {
        warnings.extend(self.first.as_ref().map(|first| match self.others.count() {
            0 => first.clone(),
            _ => {
                let others = self.others.counted("more library", "more libraries");
                format!("{first}; {others} cannot be read: {}", self.others.examples())
            }
        }));
    }
}

/// The materials by name. Of several with one name the first counts, as in the format's text.
struct Names<'a> {
    whole: HashMap<&'a [u8], usize>,
    /// By the name without a ` # ...`.
    clear: HashMap<&'a [u8], usize>,
    /// By the name without a ` #...`.
    possible: HashMap<&'a [u8], usize>,
    /// Those whose name is defined before, and the first of that name.
    again: Vec<(usize, usize)>,
}

impl<'a> Names<'a> {
    fn of(defined: &'a [(usize, Definition)]) -> Self {
        let [whole, clear, possible] = [const { Vec::new() }; 3].map(HashMap::from_iter);
        let mut names = Self { whole, clear, possible, again: Vec::new() };
        for (index, (_, Definition { name, .. })) in defined.iter().enumerate() {
            let first = *names.whole.entry(name).or_insert(index);
            if first != index {
                names.again.push((index, first));
            }
            names.clear.entry(without_clear_comment(name)).or_insert(index);
            names.possible.entry(without_possible_comment(name)).or_insert(index);
        }
        names
    }

    /// Finds a name of `usemtl`. Names may have a `#`, so what looks like a comment is cut off only
    /// if the whole name is unknown. A ` #25` is more often a part of a name than a comment: it is
    /// cut off on one of the two sides only, so that `Material #26` is not `Material #25`.
    fn find(&self, name: &[u8]) -> Option<usize> {
        let cuts = [name, without_clear_comment(name), without_possible_comment(name)];
        let whole = cuts.iter().find_map(|&cut| self.whole.get(cut));
        let clear = || cuts.iter().find_map(|&cut| self.clear.get(cut));
        let possible = || self.possible.get(name);
        whole.or_else(clear).or_else(possible).copied()
    }
}

/// Warns of what the chosen materials lose. A texture is not lost if its coordinates are kept: the
/// shader may have one.
fn dropped(
    defined: &[(usize, Definition)],
    again: &[(usize, usize)],
    contents: Contents,
    pictures: Pictures,
    libraries: &mut Libraries,
) {
    let used: HashSet<usize> = libraries.chosen.iter().copied().flatten().collect();
    let (mut doubles, mut transparent) = (Tally::default(), Tally::default());
    let mut glossy = Tally::default();
    let (mut textured, mut black) = (Tally::default(), Tally::default());
    let mut tinted = Tally::default();
    for &(index, first) in again {
        if used.contains(&first) {
            let (file, material) = &defined[index];
            doubles.add_word(&libraries.paths[*file], material.line, &material.name);
        }
    }
    for (index, (file, material)) in defined.iter().enumerate() {
        if used.contains(&index) {
            let map = material.texture.as_ref().map(|map| map.line);
            let is_kept = map.is_some() && pictures == Pictures::Kept;
            let is_lost = !is_kept && !contents.texture_coordinates;
            for (tally, line) in [
                (&mut transparent, material.transparent_line()),
                (&mut glossy, material.gloss_line()),
                (&mut textured, map.filter(|_| is_lost)),
                (&mut black, material.black_line().filter(|_| !is_kept)),
                (&mut tinted, material.tint_line().filter(|_| is_kept)),
            ] {
                if let Some(line) = line {
                    tally.add_word(&libraries.paths[*file], line, &material.name);
                }
            }
        }
    }
    let warnings = &mut libraries.warnings;
    doubles.warn(warnings, |tally| {
        let definitions = tally.counted("definition repeats", "definitions repeat");
        format!("{definitions} a material's name ({}): the first one counts", tally.examples())
    });
    transparent.warn(warnings, |tally| {
        let materials = tally.counted("material is", "materials are");
        let names = tally.examples();
        format!(
            "{materials} transparent (`d`, `Tr`, `map_d`): drawn opaque unless the program blends \
             by their finish, and `map_d` is ignored: {names}"
        )
    });
    glossy.warn(warnings, |tally| {
        let materials = tally.counted("material has", "materials have");
        let names = tally.examples();
        format!("{materials} a texture of highlights (`map_Ks`), which is ignored: {names}")
    });
    textured.warn(warnings, |tally| {
        let materials = tally.counted("material has", "materials have");
        let names = tally.examples();
        let reason = match pictures {
            Pictures::Unplaced => " as no face has texture coordinates",
            _ => "",
        };
        format!("{materials} a texture (`map_Kd`), which is ignored{reason}: {names}")
    });
    tinted.warn(warnings, |tally| {
        let materials = tally.counted("material has", "materials have");
        let names = tally.examples();
        format!(
            "{materials} a coloured `Kd` beside a texture (`map_Kd`), whose colours count: {names}"
        )
    });
    black.warn(warnings, |tally| {
        let materials = tally.counted("material has", "materials have");
        format!(
            "{materials} a black `Kd` beside a texture or light (`map_Kd`, `Ke`), drawn in black: \
             {}: write the mean colour as `Kd`",
            tally.examples()
        )
    });
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn libraries(mtl: Option<&[u8]>, names: &[&str]) -> Libraries {
        let directory = tempfile::tempdir().unwrap();
        if let Some(bytes) = mtl {
            fs::write(directory.path().join("a b.mtl"), bytes).unwrap();
        }
        let checked = Checked {
            libraries: vec![(3, b"a b.mtl".to_vec())],
            materials: names.iter().map(|&n| (5, n.into())).collect(),
            ..Checked::default()
        };
        load(&directory.path().join("m.obj"), &checked, Contents::default(), Pictures::Kept)
    }

    #[test]
    fn materials_are_found_by_name() {
        let text = b"newmtl dark red\nKd 0.5 0 0\nnewmtl g\nKd 0.25\n";
        let libraries = libraries(Some(text), &["g", "dark red", "g2"]);
        let colors: Vec<[u8; 3]> = libraries.materials.iter().map(|m| m.color).collect();
        assert_eq!(colors, [[128, 0, 0], [64; 3]]);
        assert_eq!(libraries.chosen, [Some(1), Some(0), None]);
        assert_eq!(libraries.files[0].bytes, text.len());
    }

    #[test]
    fn faults_are_warnings_with_file_and_line() {
        let warnings = libraries(Some(b"Kd 1 1 1\nnewmtl r\nKd 1 1\nnewmtl\n"), &["r"]).warnings;
        for (warning, part) in warnings.iter().zip([
            "a b.mtl:1: `Kd` before any `newmtl`",
            "a b.mtl:3: `Kd` needs three numbers",
            "a b.mtl:4: `newmtl` without a name",
            "m.obj:5: no material library gives `r` a colour",
        ]) {
            assert!(warning.contains(part), "{warning}");
        }
        assert_eq!(warnings.len(), 4);
        let endless = Checked { libraries: vec![(3, vec![b'x'; 5_000])], ..Checked::default() };
        let (obj, contents) = (Path::new("m.obj"), Contents::default());
        let warnings = load(obj, &endless, contents, Pictures::Kept).warnings;
        assert!(warnings[0].starts_with("m.obj:3: `mtllib` names no file (`xxx"), "{warnings:?}");
        assert!(warnings[0].len() < 120, "{warnings:?}");
        let missing = libraries(None, &[]).warnings;
        assert!(missing[0].contains("a b.mtl: ") && missing[0].contains("m.obj:3"), "{missing:?}");
    }

    #[test]
    fn colours_are_clamped_and_rounded() {
        assert_eq!(quantised([-1.0, 0.5, 7.0]), [0, 128, 255]);
    }
}
