//! The files that a `mtllib` or a `map_Kd` names.

use std::path::{Path, PathBuf};

use super::source::{without_clear_comment, without_possible_comment, words};

/// The longest argument that is tried, in bytes: the longest path that common systems accept.
const LONGEST: usize = 4096;

/// Returns the files that the argument of a `mtllib` in the OBJ file at `obj` names; none if it
/// cannot name any.
///
/// The format separates names by blanks, but names themselves often have blanks. So the whole
/// argument is one name if that file exists, or if at most one of its words looks like a library's
/// name. Otherwise it is cut where a comment may start.
pub(super) fn files(obj: &Path, argument: &[u8]) -> Vec<PathBuf> {
    if argument.is_empty() || argument.len() > LONGEST {
        return Vec::new();
    }
    let cuts = [argument, without_clear_comment(argument), without_possible_comment(argument)];
    for name in cuts {
        let is_list = words(name).filter(|word| is_library(word)).count() > 1;
        // The last part of a list is that of its last name.
        let places = if is_list { whole_places(obj, name) } else { places(obj, name) };
        if let Some(path) = places.into_iter().find(|path| path.is_file()) {
            return vec![path];
        }
    }
    let name = cuts[2];
    let found_or_first = |name| {
        let places = places(obj, name);
        places.iter().find(|path| path.is_file()).unwrap_or(&places[0]).clone()
    };
    if words(name).filter(|word| is_library(word)).count() <= 1 {
        vec![found_or_first(argument)]
    } else {
        words(name).map(found_or_first).collect()
    }
}

/// Returns the picture that a name in the library at `library` stands for: the first place where
/// there is a file, else the likeliest one.
pub(super) fn picture(library: &Path, name: &[u8]) -> PathBuf {
    let name = &name[..name.len().min(LONGEST)];
    let unquoted = name.strip_prefix(b"\"").and_then(|name| name.strip_suffix(b"\""));
    let cuts = [name, without_clear_comment(name), without_possible_comment(name)];
    let all = cuts.into_iter().chain(unquoted).flat_map(|name| places(library, name));
    let likeliest = places(library, cuts[1]).swap_remove(0);
    all.into_iter().find(|path| path.is_file()).unwrap_or(likeliest)
}

fn is_library(word: &[u8]) -> bool {
    word.to_ascii_lowercase().ends_with(b".mtl")
}

/// Where a file may lie, the likeliest place first: where its name says, or, if that is a path of
/// another machine, beside the file that names it.
fn places(obj: &Path, name: &[u8]) -> Vec<PathBuf> {
    let mut places = whole_places(obj, name);
    let last = name.rsplit(|byte| matches!(byte, b'/' | b'\\')).next().unwrap_or_default();
    if !last.is_empty() && last.len() < name.len() {
        places.extend(whole_places(obj, last));
    }
    places
}

/// Where a file lies by its whole name, with the separators as written or as those of Windows.
fn whole_places(obj: &Path, name: &[u8]) -> Vec<PathBuf> {
    let directory = obj.parent().unwrap_or(Path::new(""));
    let slashes = name.iter().map(|&byte| if byte == b'\\' { b'/' } else { byte }).collect();
    let names = if name.contains(&b'\\') { vec![name.to_vec(), slashes] } else { vec![slashes] };
    names.iter().flat_map(|name| readings(name)).map(|name| directory.join(name)).collect()
}

/// A file's name from its bytes. A name that is not UTF-8 is one in Latin-1 on a system whose names
/// are text.
fn readings(name: &[u8]) -> Vec<PathBuf> {
    if let Ok(text) = str::from_utf8(name) {
        return vec![text.into()];
    }
    let latin_1: String = name.iter().map(|&byte| char::from(byte)).collect();
    #[cfg(unix)]
    let readings = {
        use std::os::unix::ffi::OsStrExt as _;
        vec![std::ffi::OsStr::from_bytes(name).into(), latin_1.into()]
    };
    #[cfg(not(unix))]
    let readings = vec![latin_1.into()];
    readings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_libraries_may_share_a_line() {
        let files = |argument: &str| files(Path::new("dir/m.obj"), argument.as_bytes());
        assert_eq!(files("a.mtl b.MTL"), [PathBuf::from("dir/a.mtl"), PathBuf::from("dir/b.MTL")]);
        assert_eq!(files("my colours.mtl"), [PathBuf::from("dir/my colours.mtl")]);
        assert!(files("").is_empty());
    }

    #[test]
    fn a_windows_path_is_tried_as_written_with_slashes_and_beside_the_obj() {
        let obj = Path::new("dir/m.obj");
        let expected = ["dir/.\\sub\\a.mtl", "dir/./sub/a.mtl", "dir/a.mtl"];
        assert_eq!(places(obj, b".\\sub\\a.mtl"), expected.map(PathBuf::from));
        assert_eq!(places(obj, b"a.mtl"), [PathBuf::from("dir/a.mtl")]);
        assert_eq!(places(obj, b"sub\\").len(), 2);
    }

    #[test]
    #[cfg(unix)]
    fn a_name_of_another_encoding_is_tried_as_bytes_and_as_latin_1() {
        use std::os::unix::ffi::OsStrExt as _;
        let places = places(Path::new("m.obj"), b"gr\xFCn.mtl");
        let names = places.iter().map(|place| place.as_os_str().as_bytes());
        assert_eq!(names.collect::<Vec<_>>(), [&b"gr\xFCn.mtl"[..], "gr\u{fc}n.mtl".as_bytes()]);
    }
}
