//! Helpers that the tests share.

pub mod bands;
mod counter;
pub mod ends;
pub mod exact;
mod picture;
#[path = "../../rasterizer/src/random.rs"]
mod random;
mod recorder;
mod scene;
mod surface;
pub mod vector;

pub use counter::Counter;
pub use picture::Picture;
pub use random::Random;
pub use recorder::{BusError, Call, Recorder};
pub use scene::{Placed, Scene, area, front_vertices, pixel_camera, places};
pub use surface::{Surface, edges, is_closed};

use std::{
    fs,
    path::{Path, PathBuf},
};

/// The OBJ files of a folder, in order.
///
/// # Panics
///
/// Panics if the folder cannot be read or holds no OBJ file: a test without a model to test must
/// not pass.
#[must_use]
pub fn obj_files(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries
        .map(|entry| entry.expect("a directory entry can be read").path())
        .filter(|path| path.extension().is_some_and(|e| e == "obj"))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{} holds no OBJ file", folder.display());
    files
}

/// The models that the project ships.
#[must_use]
pub fn shipped_models() -> Vec<PathBuf> {
    obj_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../host-tools/models"))
}

/// The models in the folder that `RASTERIZER_MODELS` names; none if it is not set.
#[must_use]
pub fn other_models() -> Vec<PathBuf> {
    std::env::var_os("RASTERIZER_MODELS")
        .map_or_else(Vec::new, |folder| obj_files(Path::new(&folder)))
}
