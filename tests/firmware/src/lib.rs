//! The frames that the firmware draws, the same on every core and on the host.

#![no_std]

#[macro_use]
mod cost_fields;

pub mod bench;
pub mod choice;
pub mod console;
pub mod cost;
pub mod counter;
pub mod entry;
pub mod frames;
pub mod memory;
pub mod models;
pub mod nothing;
pub mod readme;
pub mod scaling;
pub mod shiny;
pub mod sizes;
pub mod stiff;
pub mod surface;
pub mod walk;
