//! An object lies over the pixels of a frame. With `--cfg display` they are those of a display,
//! with `--cfg binary` they are on or off: neither compiles. `tests/compile_fail.rs` hands it to
//! the compiler; it is no target of Cargo's.

#![crate_type = "lib"]

use rasterizer::{
    color::Alpha,
    embedded_graphics_core::pixelcolor::{BinaryColor, Rgb565},
    output::Over,
    prelude::*,
};

#[cfg(not(binary))]
type Color = Rgb565;
#[cfg(binary)]
type Color = BinaryColor;

/// Memory that can be read, and a display like any other.
type Memory<'a> = Frame<'a, Color, NoDepth>;

#[cfg(not(display))]
type Canvas<'a> = Memory<'a>;
#[cfg(display)]
type Canvas<'a> = Direct<'a, Memory<'a>>;

pub fn draw_glass<Sh: Shader<Color = Color, Varyings = [u16; 0]>>(
    mesh: &Mesh<'_>,
    shader: Sh,
    camera: &Camera,
    storage: &mut [ScreenVertex<S8, NoDepth, [u16; 0]>],
    canvas: &mut Canvas<'_>,
) -> bool {
    let glass = Object::new(mesh, shader).blended(Over(Alpha::HALF));
    glass.draw(camera, storage, canvas).is_ok()
}
