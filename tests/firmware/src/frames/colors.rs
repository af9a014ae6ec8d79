//! Frames of few colours: a rocket dithered to each, packed and not.

use embedded_graphics_core::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb888};
use rasterizer::{
    camera::Camera,
    color::Dither,
    geometry::{Pose, ScreenVertex},
    numbers::{Rotation, S4, S8, Turn, Vec3},
    output::{Bands, PackedColor, PackedFrame, Rgb565Be},
    scene::Object,
    shade::{Dithered, Gouraud, Light},
};

use super::{AREA, LENS, PIXELS, ROWS, VERTICES, draw};
use crate::{console, cost::fail, hash::hash, memory::Memory, models};

/// Filling the picture; with the surface through the near plane; from inside.
pub(super) fn dithered(memory: &mut Memory<PIXELS>, light: Light) {
    let pose = Pose::rotated(Rotation::about_x(Turn::degrees(25)));
    for (view, distance) in [("near", "3"), ("cut", "0.9"), ("inside", "0.05")] {
        let camera = Camera::at(Vec3::lit("0", "0", distance), Rotation::IDENTITY, LENS, AREA)
            .unwrap_or_else(fail);
        let binary = packed::<BinaryColor, 8, VERTICES>(light, pose, &camera, memory);
        let two_bits = packed::<Gray2, 4, VERTICES>(light, pose, &camera, memory);
        let four_bits = packed::<Gray4, 8, VERTICES>(light, pose, &camera, memory);
        let shader = Dithered::<_, Rgb565Be>::new(Gouraud::<Rgb888>::new(light));
        let object = Object::new(&models::ROCKET, shader).posed(pose);
        let [sixteen, _] = draw::<_, S4, u16, _, _, VERTICES>(&object, &camera, memory);
        console::line(format_args!(
            "rocket {view} dithered {binary:08x} {two_bits:08x} {four_bits:08x} {sixteen:08x}"
        ));
    }
}

/// Draws a packed frame as a whole and again in bands, and checks that they are the same. Returns
/// the hash of its bytes.
fn packed<C: PackedColor + Dither + 'static, const SIZE: usize, const VERTICES: usize>(
    light: Light,
    pose: Pose,
    camera: &Camera,
    memory: &mut Memory<PIXELS>,
) -> u32 {
    let shader = Dithered::<_, C, SIZE>::with_size(Gouraud::<Gray8>::new(light));
    let object = Object::new(&models::ROCKET, shader).posed(pose);
    let mut vertices = [ScreenVertex::<S8, u16, [u16; 1]>::EMPTY; VERTICES];
    let seen = object.project(camera, &mut vertices).unwrap_or_else(fail);
    let bytes: &mut [u8] = bytemuck::must_cast_slice_mut(&mut memory.color);
    let bytes = &mut bytes[..PackedFrame::<C>::bytes(AREA.size)];
    let mut frame = PackedFrame::<C, _>::new(bytes, &mut memory.depth, AREA).unwrap_or_else(fail);
    let black = C::from_bits(0);
    frame.clear(black);
    let Ok(()) = seen.draw(&mut frame);
    let whole = hash(0, frame.as_bytes().iter().map(|&byte| byte.into()));

    let row = bytes.len() / AREA.size.height as usize;
    let bytes = &mut bytes[..row * ROWS as usize];
    let mut bands =
        Bands::<_, C, _, _>::packed(AREA, bytes, &mut memory.depth).unwrap_or_else(fail);
    let mut of_bands = 0;
    for area in bands.areas() {
        let mut band = bands.band(area).unwrap_or_else(fail);
        band.clear_color(black);
        let Ok(()) = seen.draw(&mut band);
        of_bands = hash(of_bands, band.as_bytes().iter().map(|&byte| byte.into()));
    }
    assert_eq!(whole, of_bands, "bands differ from the whole frame");
    whole
}
