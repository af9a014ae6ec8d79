//! What the firmware draws, the same on every core and on the host.

#![no_std]

pub mod bench;
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
pub mod sizes;
pub mod surface;
