//! Writes the result: to a path, or from a build script.

use std::{
    env, fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
};

use super::{Model, Options, emit, error::ModelError};

/// Writes a file whole or not at all. A symbolic link stays, and the file that it names is written.
///
/// On Linux the file has no name until it is whole, so that a killed program leaves nothing behind.
/// Elsewhere, and on file systems that cannot do so, it is a temporary file in the same directory,
/// which then takes its name.
///
/// # Errors
///
/// Returns an error if the path is a directory, its directory is missing or not writable, or the
/// disk is full. An older file at the path is then unchanged.
pub fn write_atomically(path: &Path, contents: impl AsRef<[u8]>) -> Result<(), ModelError> {
    if path.is_dir() {
        return Err(ModelError::Directory { path: path.into() });
    }
    let contents = contents.as_ref();
    let write = || -> io::Result<()> {
        let target = behind_links(path)?;
        let directory = directory_of(&target);
        #[cfg(target_os = "linux")]
        if let Some(result) = unnamed::write(&target, directory, contents) {
            return result;
        }
        let mut file = builder().tempfile_in(directory)?;
        file.write_all(contents)?;
        file.as_file().sync_all()?;
        file.persist(target)?;
        Ok(())
    };
    write().map_err(|source| ModelError::Write { path: path.into(), source })
}

fn directory_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Temporary files of the mode of any new file: by default they are private to their owner.
fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

/// The path that symbolic links lead to. There need be no file.
fn behind_links(path: &Path) -> io::Result<PathBuf> {
    /// As many as Linux follows.
    const MOST_LINKS: usize = 40;
    let mut target = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&target) {
            Ok(link) => target = directory_of(&target).join(link),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Files without a name.
#[cfg(target_os = "linux")]
mod unnamed {
    use std::{
        fs::{self, File},
        io::{self, Write as _},
        os::fd::AsRawFd as _,
        path::Path,
    };

    use rustix::{
        fs::{AtFlags, CWD, Mode, OFlags, linkat, open},
        io::Errno,
    };

    /// Writes a file; `None` if the file system has no files without a name.
    pub(super) fn write(path: &Path, directory: &Path, contents: &[u8]) -> Option<io::Result<()>> {
        let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
        let mut file = File::from(open(directory, flags, Mode::from_raw_mode(0o666)).ok()?);
        if let Err(error) = file.write_all(contents).and_then(|()| file.sync_all()) {
            return Some(Err(error));
        }
        let unnamed = format!("/proc/self/fd/{}", file.as_raw_fd());
        let link = |path: &Path| linkat(CWD, &unnamed, CWD, path, AtFlags::SYMLINK_FOLLOW);
        match link(path) {
            Ok(()) => Some(Ok(())),
            // A link cannot replace a file. A second name can.
            Err(Errno::EXIST) => {
                let named = super::builder().make_in(directory, |name| Ok(link(name)?));
                Some(named.and_then(|named| fs::rename(named.into_temp_path().keep()?, path)))
            }
            // Without /proc.
            Err(Errno::NOENT) if !Path::new(&unnamed).exists() => None,
            Err(error) => Some(Err(error.into())),
        }
    }
}

/// Converts a model from a build script: writes `<stem>.rs` into `OUT_DIR`, for
/// `include!(concat!(env!("OUT_DIR"), "/<stem>.rs"))`, and returns its path.
///
/// Prints instructions for Cargo to the standard output: the files on which the result depends, and
/// the warnings. Cargo always runs a build script again that has returned an error.
///
/// ```no_run
/// use host_tools::model::{Options, convert_for_build};
///
/// fn main() -> Result<(), Box<dyn std::error::Error>> {
///     convert_for_build("models/gear.obj", &Options::default())?;
///     Ok(())
/// }
/// ```
///
/// # Errors
///
/// Returns the errors of [`Model::load`] and [`write_atomically`], and one if `OUT_DIR` is not set.
pub fn convert_for_build(obj: impl AsRef<Path>, options: &Options) -> Result<PathBuf, ModelError> {
    let directory = env::var_os("OUT_DIR").ok_or(ModelError::NoOutDir)?;
    let (path, instructions) = convert_into(Path::new(&directory), obj.as_ref(), options)?;
    for line in instructions {
        println!("{line}");
    }
    Ok(path)
}

/// The result's path and the lines for Cargo.
fn convert_into(
    directory: &Path,
    obj: &Path,
    options: &Options,
) -> Result<(PathBuf, Vec<String>), ModelError> {
    let model = Model::load(obj, options)?;
    let mut path = directory.join(obj.file_stem().unwrap_or_default());
    path.as_mut_os_string().push(".rs");
    let text = emit::source(&model);
    // An unchanged file is not written, so that the compiler need not run again.
    if fs::read(&path).ok().as_deref() != Some(text.as_bytes()) {
        write_atomically(&path, &text)?;
    }
    let inputs =
        (model.inputs.iter()).map(|input| format!("cargo::rerun-if-changed={}", input.display()));
    let warnings = model.warnings.iter().map(|warning| format!("cargo::warning={warning}"));
    Ok((path, inputs.chain(warnings).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(directory: &Path) -> usize {
        fs::read_dir(directory).unwrap().count()
    }

    #[test]
    fn files_are_replaced_whole() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.rs");
        write_atomically(&path, "one").unwrap();
        write_atomically(&path, "two").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "two");
        assert_eq!(entries(directory.path()), 1);
        #[cfg(unix)]
        {
            let plain = directory.path().join("plain");
            fs::write(&plain, "").unwrap();
            let mode = |path| fs::metadata(path).unwrap().permissions();
            assert_eq!(mode(&path), mode(&plain));
        }
    }

    #[test]
    fn failures_leave_nothing_behind() {
        let directory = tempfile::tempdir().unwrap();
        let error = write_atomically(directory.path(), "x").unwrap_err().to_string();
        assert!(error.contains("is a directory"), "{error}");
        let error =
            write_atomically(&directory.path().join("no/a.rs"), "x").unwrap_err().to_string();
        assert!(
            error.contains("a.rs cannot be written")
                && error.contains("check that its directory exists")
        );
        // A name that the system refuses fails at the last step, after the temporary file is
        // written.
        let long = directory.path().join("x".repeat(300));
        assert!(write_atomically(&long, "x").is_err());
        assert_eq!(entries(directory.path()), 0);
    }

    #[test]
    fn a_full_disk_has_its_remedy() {
        let remedy = |kind: io::ErrorKind| {
            ModelError::Write { path: "a.rs".into(), source: kind.into() }.to_string()
        };
        assert!(
            remedy(io::ErrorKind::StorageFull)
                .ends_with("make room on the disk, or write to another")
        );
        assert!(remedy(io::ErrorKind::PermissionDenied).contains("is writable"));
    }

    #[test]
    fn build_scripts_get_a_file_and_its_inputs() {
        let directory = tempfile::tempdir().unwrap();
        let obj = directory.path().join("part 1.obj");
        fs::write(&obj, "mtllib no.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        let (path, lines) = convert_into(directory.path(), &obj, &Options::default()).unwrap();
        assert_eq!(path, directory.path().join("part 1.rs"));
        assert!(fs::read_to_string(&path).unwrap().contains("pub static PART_1:"));
        assert_eq!(lines[0], format!("cargo::rerun-if-changed={}", obj.display()));
        assert!(lines[1].ends_with("no.mtl"));
        assert!(lines[2].starts_with("cargo::warning=") && lines[2].contains("no.mtl: "));
        assert_eq!(lines.len(), 3);
    }

    #[test]
    fn without_out_dir_nothing_is_done() {
        if env::var_os("OUT_DIR").is_none() {
            let error = convert_for_build("no.obj", &Options::default()).unwrap_err();
            assert!(matches!(error, ModelError::NoOutDir));
        }
    }
}
