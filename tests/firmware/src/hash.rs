//! The hash of a picture.

/// FNV-1a over 16-bit values, which are the same on any core, continued from the hash `before`.
pub(crate) fn hash(before: u32, values: impl Iterator<Item = u16>) -> u32 {
    let start = before ^ 0x811C_9DC5;
    let end = values.fold(start, |hash, value| (hash ^ u32::from(value)).wrapping_mul(0x0100_0193));
    end ^ 0x811C_9DC5
}
