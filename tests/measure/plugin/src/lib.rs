//! A plugin for QEMU that counts executed instructions by what their timing depends on.
//!
//! QEMU translates code in blocks. Each is decoded once, when it is translated; a run of it adds
//! one to a number. A block that does not begin where the one before it ended was jumped to, so
//! taken branches are exact. What two neighbouring instructions cost each other is found within a
//! block: after a jump the pipeline is empty.
//!
//! The program says what to count: it writes to a word of memory, a *mark*, before and after each
//! stage. See [`windows`]. How many cycles the counts take is worked out by the package `measure`.
//!
//! Only the module `qemu` calls QEMU and has unsafe code.

pub mod arguments;
pub mod block;
pub mod cache;
pub mod counts;
pub mod instruction;
pub mod predictor;
#[cfg(not(test))]
mod qemu;
pub mod riscv;
pub mod thumb;
mod thumb_float;
mod thumb_wide;
pub mod windows;
