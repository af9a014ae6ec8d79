//! Hints to the compiler: how a loop is to be compiled, never what it computes.
//!
//! Each is `core::hint::black_box` under a name that says what it is for. `black_box` returns its
//! argument unchanged, so that no frame depends on it; it has no instruction of its own, and hides
//! from the optimiser where a value comes from. The figures are of rustc 1.96, instructions for a
//! frame or a pixel of the bench scenes in `tests/measure`; a new compiler can make any of these
//! lines unnecessary, or necessary elsewhere, which `measure speed` shows.
//!
//! On a host they do nothing: there the plain loop is a second form of the code, and the frames'
//! hashes compare it with the hinted one.
//!
//! No other file of the crate may call `black_box` (`clippy.toml`).

use super::IS_NARROW;

/// Keeps the loop that it stands in as it is written.
///
/// Without it the optimiser unrolls the loop over pixels four times, computes multiples of the
/// steps beforehand, and has too few registers for them: 16 to 18 instructions a pixel on the
/// Cortex-M4 instead of 12 to 15 (`cube-gouraud`).
#[inline(always)]
pub(crate) const fn keep_rolled() {
    unknown(());
}

/// Has the way that it stands in laid out apart from the other one, on a narrow core.
///
/// Without it the optimiser takes a hidden pixel to be as likely as a visible one: 1 % more
/// instructions for a frame on the Cortex-M0+ (`suzanne-gouraud`). On others it costs registers.
#[inline(always)]
pub(crate) const fn unlikely() {
    if IS_NARROW {
        core::hint::cold_path();
    }
}

/// Keeps two stores apart that the compiler would join, on cores with an instruction for two words.
///
/// `STRD` takes three cycles on the Cortex-M4, and two `STR` two (DDI0439D, table 3-1): cycles that
/// a count of instructions does not show.
#[inline(always)]
pub(crate) const fn keep_apart() {
    if !IS_NARROW {
        unknown(());
    }
}

/// Has what is written before it stored before what is written after it.
///
/// Without it the optimiser stores a pixel's depth after its four texels are mixed, and takes it to
/// the stack and back: an instruction a pixel on the Cortex-M4 (`cube-texture-bilinear`).
#[inline(always)]
pub(crate) const fn in_order() {
    unknown(());
}

/// The same value, about which the optimiser knows nothing.
///
/// A value that may be different is not propagated: a loop that stores a zero is not turned into a
/// call of `memset`, which takes two instructions a word instead of one (`sphere-flat`), branches
/// on it stay where they are, and a loop of unknown length is not unrolled (170 bytes of flash in
/// what is done once a frame).
#[inline(always)]
#[expect(clippy::disallowed_methods, reason = "this file names what it is for")]
pub(crate) const fn unknown<T>(value: T) -> T {
    if cfg!(target_os = "none") { core::hint::black_box(value) } else { value }
}

/// Keeps a value in memory, from where it is read each time.
///
/// Without it the optimiser keeps values that are used once a row in registers, and spills those
/// that are used for every pixel: 18 instead of 15 instructions a pixel on the Cortex-M4
/// (`cube-gouraud`).
#[inline(always)]
pub(crate) const fn in_memory<T>(value: &mut T) {
    unknown(value);
}

/// The same array, addressed from its own start.
///
/// Without it the optimiser addresses the last elements of a slice backwards from the end, where
/// the short store instructions of ARMv6-M do not reach: an address is computed for each
/// (`cube-flat` on the Cortex-M0+).
#[inline(always)]
pub(crate) const fn rebased<T, const N: usize>(array: &mut [T; N]) -> &mut [T; N] {
    unknown(array)
}
