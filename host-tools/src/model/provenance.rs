//! The files that a model is made from.

use std::path::Path;

/// A file that a model is made from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Provenance {
    /// Its name without directories.
    pub file_name: String,
    /// Its size.
    pub bytes: usize,
    /// The 64-bit FNV-1a hash of its bytes (Fowler, Noll and Vo), which is the same in every
    /// version of a library or compiler.
    pub hash: u64,
}

impl Provenance {
    pub(super) fn of(path: &Path, bytes: &[u8]) -> Self {
        let hash = bytes.iter().fold(0xCBF2_9CE4_8422_2325, |hash: u64, &byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3)
        });
        Self {
            file_name: path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            bytes: bytes.len(),
            hash,
        }
    }
}
