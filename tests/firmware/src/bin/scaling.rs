//! Prints the cost of frames with growing numbers of triangles, and of pixels.

#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::{
    console, counter,
    memory::{Memory, Shared},
    scaling::{self, TRIANGLES, VERTICES},
    stage::PIXELS,
    surface::{self, Surface},
};

static MEMORY: Shared<PIXELS> = Memory::shared();
static SURFACE: surface::Shared<VERTICES, TRIANGLES> = Surface::shared();

fn run() {
    counter::start();
    console::build();
    critical_section::with(|token| {
        scaling::run(&mut MEMORY.borrow_ref_mut(token), &mut SURFACE.borrow_ref_mut(token));
    });
}

firmware::entry!(run);
