//! The colours of an OBJ's material libraries.
//!
//! Without its library a model loses its colours but is still converted: each fault is a warning.

use std::{
    collections::HashSet,
    fmt::Write as _,
    path::{Path, PathBuf},
};

use super::{
    Provenance,
    error::{ModelError, quote},
    source::{self, Statement},
    validate::Checked,
};

/// The colour of a face without a material, or with one whose colour is unknown.
pub(super) const DEFAULT_COLOR: [u8; 3] = [200; 3];

/// The longest `mtllib` that is tried, in bytes: the longest path that common systems accept.
const LONGEST: usize = 4096;

/// All libraries of a model.
#[derive(Clone, Debug, Default)]
pub(super) struct Libraries {
    /// Its `newmtl` and `Kd` statements alone, each checked: `tobj` panics on a `Kd` of fewer than
    /// three numbers, and drops the whole library for a fault in a line that does not matter to
    /// colour.
    pub text: String,
    /// The files named, readable or not.
    pub paths: Vec<PathBuf>,
    /// The files read.
    pub files: Vec<Provenance>,
    /// What is missing or broken.
    pub warnings: Vec<String>,
}

/// Reads the libraries that the OBJ file at `obj` names, and warns of materials without a colour.
pub(super) fn load(obj: &Path, checked: &Checked) -> Libraries {
    let mut libraries = Libraries::default();
    let mut colored = HashSet::new();
    for (line, argument) in &checked.libraries {
        if argument.is_empty() || argument.len() > LONGEST {
            let (obj, name) = (obj.display(), quote(argument));
            let warning = format!("{obj}:{line}: `mtllib {name}` names no file: ignored");
            libraries.warnings.push(warning);
            continue;
        }
        for path in files(obj, argument) {
            if libraries.paths.contains(&path) {
                continue;
            }
            if let Err(error) = library(&path, &mut libraries, &mut colored) {
                libraries.warnings.push(format!(
                    "{error} (named in {}:{line}; its materials are drawn in grey)",
                    obj.display()
                ));
            }
            libraries.paths.push(path);
        }
    }
    for (line, name) in checked.materials.iter().filter(|(_, name)| !colored.contains(name)) {
        libraries.warnings.push(format!(
            "{}:{line}: no material library gives `{}` a colour (`newmtl {}`, then `Kd r g b`): \
             it is drawn in grey",
            obj.display(),
            quote(name),
            quote(name)
        ));
    }
    libraries
}

/// The files that a `mtllib` names. The format separates names by blanks, but names themselves
/// often have blanks. So the whole argument is one name if that file exists, or if at most one of
/// its words looks like a library's name.
fn files(obj: &Path, argument: &str) -> Vec<PathBuf> {
    let beside = |name: &str| obj.parent().unwrap_or(Path::new("")).join(name);
    let names: Vec<&str> = argument.split_whitespace().collect();
    let libraries = names.iter().filter(|n| n.to_lowercase().ends_with(".mtl")).count();
    if libraries <= 1 || beside(argument).exists() {
        vec![beside(argument)]
    } else {
        names.into_iter().map(beside).collect()
    }
}

fn library(
    path: &Path,
    libraries: &mut Libraries,
    colored: &mut HashSet<String>,
) -> Result<(), ModelError> {
    let bytes = source::read(path)?;
    let text = source::text(path, &bytes)?;
    libraries.files.push(Provenance::of(path, &bytes));
    let mut material = None;
    for statement in source::statements(text) {
        let fault = match (statement.keyword(), material.as_ref()) {
            ("newmtl", _) => {
                let name = statement.name();
                material = (!name.is_empty()).then(|| name.to_owned());
                if name.is_empty() {
                    "`newmtl` without a name"
                } else {
                    let _ = writeln!(libraries.text, "newmtl {name}");
                    continue;
                }
            }
            ("Kd", Some(name)) => {
                if let Some([r, g, b]) = color(&statement) {
                    let _ = writeln!(libraries.text, "Kd {r} {g} {b}");
                    colored.insert(name.clone());
                    continue;
                }
                "`Kd` needs three numbers from 0 to 1"
            }
            ("Kd", None) => "`Kd` before any `newmtl`",
            _ => continue,
        };
        libraries.warnings.push(format!("{}:{}: {fault}: ignored", path.display(), statement.line));
    }
    Ok(())
}

/// Reads `Kd r g b`; `Kd r` is the grey of that value.
fn color(statement: &Statement<'_>) -> Option<[f64; 3]> {
    let values: Vec<f64> = statement
        .arguments()
        .map(|word| word.parse().ok().filter(|v: &f64| v.is_finite()))
        .collect::<Option<_>>()?;
    match values[..] {
        [grey] => Some([grey; 3]),
        [r, g, b, ..] => Some([r, g, b]),
        _ => None,
    }
}

/// A colour from 0 to 1 in 255ths.
pub(super) fn quantised(color: [f64; 3]) -> [u8; 3] {
    color.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)
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
            libraries: vec![(3, "a b.mtl".into())],
            materials: names.iter().map(|&n| (5, n.into())).collect(),
            ..Checked::default()
        };
        load(&directory.path().join("m.obj"), &checked)
    }

    #[test]
    fn colours_are_read_and_everything_else_is_ignored() {
        let text = b"# c\r\nnewmtl\tdark red\r\nillum what\r\nKd 0.5 0 \\\r\n0 # c\r\n\
                     newmtl g\r\nKd 0.25\r\nKa 1";
        let libraries = libraries(Some(text), &["dark red", "g"]);
        assert_eq!(libraries.text, "newmtl dark red\nKd 0.5 0 0\nnewmtl g\nKd 0.25 0.25 0.25\n");
        assert_eq!(libraries.warnings, [""; 0]);
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
        let endless =
            Checked { libraries: vec![(3, "x".repeat(LONGEST + 1))], ..Checked::default() };
        let warnings = load(Path::new("m.obj"), &endless).warnings;
        assert!(warnings[0].starts_with("m.obj:3: `mtllib xxx") && warnings[0].len() < 100);
        let missing = libraries(None, &[]).warnings;
        assert!(missing[0].contains("a b.mtl: ") && missing[0].contains("m.obj:3"), "{missing:?}");
        let broken = libraries(Some(b"newmtl \xFF"), &[]).warnings;
        assert!(broken[0].contains("a b.mtl:1: byte 0xFF"), "{broken:?}");
    }

    #[test]
    fn several_libraries_may_share_a_line() {
        let obj = Path::new("dir/m.obj");
        assert_eq!(
            files(obj, "a.mtl b.MTL"),
            [PathBuf::from("dir/a.mtl"), PathBuf::from("dir/b.MTL")]
        );
        assert_eq!(files(obj, "my colours.mtl"), [PathBuf::from("dir/my colours.mtl")]);
    }

    #[test]
    fn colours_are_clamped_and_rounded() {
        assert_eq!(quantised([-1.0, 0.5, 7.0]), [0, 128, 255]);
    }
}
