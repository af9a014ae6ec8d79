//! Prints the hash of each frame, on a microcontroller by semihosting.

#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::{
    frames::{self, PIXELS},
    memory::{Memory, Shared},
};

static MEMORY: Shared<PIXELS> = Memory::shared();

fn run() {
    critical_section::with(|token| frames::run(&mut MEMORY.borrow_ref_mut(token)));
}

firmware::entry!(run);
