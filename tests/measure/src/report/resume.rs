//! What earlier runs have found: a scene is not measured again until something that its figures
//! depend on has changed.

use std::{
    collections::hash_map::DefaultHasher,
    fs,
    hash::{Hash as _, Hasher as _},
    path::Path,
};

use anyhow::{Context as _, Result};
use host_tools::model::write_atomically;

use super::{points::Measured, scenes::Scene};
use crate::{conditions::Conditions, cores::Core, firmware};

/// A scene, and the conditions on each core.
pub(super) type Found = (Measured, Vec<(Core, Conditions)>);

/// What the figures of all scenes depend on, apart from the model's files and compilers.
const SOURCES: [&str; 18] = [
    "Cargo.lock",
    "Cargo.toml",
    "rasterizer/src",
    "host-tools/src/check",
    "host-tools/src/model",
    "host-tools/src/reference",
    "tests/firmware/src",
    "tests/measure/plugin/src",
    "tests/measure/src/cycles/tables.rs",
    "tests/measure/src/cycles/timing.rs",
    "tests/measure/src/report/choices.rs",
    "tests/measure/src/report/errors.rs",
    "tests/measure/src/report/narrow.rs",
    "tests/measure/src/report/points.rs",
    "tests/measure/src/report/program.rs",
    "tests/measure/src/report/run.rs",
    "tests/measure/src/report/scenes.rs",
    "tests/measure/src/report/split.rs",
];

const FILE: &str = "measured.json";

/// A number that changes with the sources, the model's files, the compiler and the cores.
///
/// # Errors
///
/// Returns an error if a file cannot be read.
pub(super) fn fingerprint(scene: &Scene, cores: &[Core]) -> Result<u64> {
    let mut hasher = DefaultHasher::new();
    for source in SOURCES {
        hash(&firmware::root().join(source), &mut hasher)?;
    }
    // A library or a picture may be missing.
    scene.inputs.iter().for_each(|input| fs::read(input).ok().hash(&mut hasher));
    serde_json::to_string(scene)?.hash(&mut hasher);
    for &core in cores {
        core.hash(&mut hasher);
        firmware::compiler_version(core)?.hash(&mut hasher);
    }
    Ok(hasher.finish())
}

/// Hashes a file, or all files below a folder.
fn hash(path: &Path, hasher: &mut DefaultHasher) -> Result<()> {
    let read = || path.display().to_string();
    if !path.is_dir() {
        fs::read(path).with_context(read)?.hash(hasher);
        return Ok(());
    }
    let entries = fs::read_dir(path).with_context(read)?;
    let mut paths = entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
    paths.sort();
    paths.iter().try_for_each(|path| hash(path, hasher))
}

/// What an earlier run has found of a scene.
///
/// # Errors
///
/// Returns an error if there is no folder for it.
pub(super) fn kept(scene: &Scene, fingerprint: u64) -> Result<Option<Found>> {
    let path = scene.folder()?.join(FILE);
    let kept: Option<(u64, Found)> =
        fs::read(path).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    Ok(kept.filter(|(of, _)| *of == fingerprint).map(|(_, found)| found))
}

/// Keeps what is found of a scene.
///
/// # Errors
///
/// Returns an error if the file cannot be written.
pub(super) fn keep(fingerprint: u64, found: &Found) -> Result<()> {
    let path = found.0.scene.folder()?.join(FILE);
    let text = serde_json::to_string(&(fingerprint, found))?;
    Ok(write_atomically(&path, text)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hash_of(path: &Path) -> u64 {
        let mut hasher = DefaultHasher::new();
        hash(path, &mut hasher).unwrap();
        hasher.finish()
    }

    #[test]
    fn what_figures_depend_on_exists_and_differs() {
        let all: Vec<_> =
            SOURCES.iter().map(|path| hash_of(&firmware::root().join(path))).collect();
        let mut distinct = all.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), all.len());
    }
}
