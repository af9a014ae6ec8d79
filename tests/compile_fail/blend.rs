//! An object is blended with the pixels of a frame, or, without `--cfg readable`, with those of a
//! display, which does not compile. `tests/compile_fail.rs` hands it to the compiler; it is no
//! target of Cargo's.

#![crate_type = "lib"]

use rasterizer::{embedded_graphics_core::pixelcolor::Rgb565, output::Blend, prelude::*};

/// Memory that can be read, and a display like any other.
type Memory<'a> = Frame<'a, Rgb565, NoDepth>;

#[cfg(readable)]
type Canvas<'a> = Memory<'a>;
#[cfg(not(readable))]
type Canvas<'a> = Direct<'a, Memory<'a>>;

fn keep(stored: Rgb565, _new: Rgb565) -> Rgb565 {
    stored
}

pub fn draw_glass(
    mesh: &Mesh<'_>,
    camera: &Camera,
    storage: &mut [ScreenVertex<S8, NoDepth, [u16; 0]>],
    canvas: &mut Canvas<'_>,
) -> bool {
    let glass = Object::new(mesh, Unlit::new()).blended(Blend(keep));
    glass.draw(camera, storage, canvas).is_ok()
}
