//! Prints what the frames of each bench scene cost without their pixels; on the host, where nothing counts instructions, zeros.

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

use firmware::{
    bench::{self, PIXELS},
    console, counter,
    memory::{Memory, Shared},
};

static MEMORY: Shared<PIXELS> = Memory::shared();

fn run() {
    counter::start();
    console::build();
    critical_section::with(|token| bench::run::<true>(&mut MEMORY.borrow_ref_mut(token)));
}

firmware::entry!(run);
