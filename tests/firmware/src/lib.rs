//! The frames that the firmware draws, the same on every core and on the host.

#![no_std]

#[macro_use]
mod cost_fields;

#[cfg(feature = "bench")]
pub mod bench;
pub mod choice;
pub mod console;
pub mod cost;
pub mod counter;
pub mod entry;
#[cfg(feature = "frames")]
pub mod frames;
mod hash;
pub mod memory;
pub mod models;
pub mod nothing;
pub mod readme;
#[cfg(feature = "bench")]
pub mod scaling;
pub mod shiny;
pub mod sizes;
pub mod stage;
pub mod stiff;
pub mod surface;
#[cfg(any(feature = "bench", feature = "scenes"))]
pub mod walk;
