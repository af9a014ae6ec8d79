//! Prints how many instructions a frame of each bench scene takes; on the host, where nothing counts them, zeros.

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

use firmware::{
    bench::{self, PIXELS, VERTICES},
    counter,
    memory::{Memory, Shared},
};

static MEMORY: Shared<PIXELS, VERTICES> = Memory::shared();

fn run() {
    counter::start();
    critical_section::with(|token| bench::run(&mut MEMORY.borrow_ref_mut(token)));
}

firmware::entry!(run);
