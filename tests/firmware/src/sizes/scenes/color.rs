//! The scenes of a display of 128 x 64 pixels that are on or off: the ball with light at its
//! vertices, dithered.

use core::convert::Infallible;

use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point, Size},
    pixelcolor::{BinaryColor, Gray8, Rgb565, raw::RawU16},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::NoDepth,
    geometry::{ClipNone, ScreenVertex},
    numbers::S4,
    output::{Direct, InPages, PackedFrame},
    scene::Object,
    shade::{Dithered, Gouraud},
};

use super::{LIGHT, PERSPECTIVE, camera, frames::for_each_view};
use crate::models::BALL;
use crate::sizes::{Display, Scene};

const OLED: Rectangle = Rectangle::new(Point::zero(), Size::new(128, 64));
const PIXELS: usize = 128 * 64;
const BYTES: usize = PackedFrame::<BinaryColor, NoDepth, InPages>::bytes(OLED.size);

const SHADER: Dithered<Gouraud<Gray8>, BinaryColor> = Dithered::new(Gouraud::new(LIGHT));

/// The ball's vertices.
type Vertices<D> = [ScreenVertex<S4, D, [u16; 1]>; BALL.vertex_count()];

/// With depth, in a frame that holds the display's bytes, which are sent as they are.
#[derive(Clone, Copy, Debug)]
pub struct DitheredPacked;

/// The memory of [`DitheredPacked`].
#[derive(Debug)]
pub struct Packed {
    bytes: [u8; BYTES],
    depth: [u16; PIXELS],
    vertices: Vertices<u16>,
}

impl Scene for DitheredPacked {
    type Memory = Packed;

    const MEMORY: Packed = Packed {
        bytes: [0; BYTES],
        depth: [0; PIXELS],
        vertices: [ScreenVertex::EMPTY; BALL.vertex_count()],
    };

    fn draw(memory: &mut Packed, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let Packed { bytes, depth, vertices } = &mut *memory;
            let mut frame = PackedFrame::in_pages(bytes, depth, OLED).ok()?;
            frame.clear(BinaryColor::Off);
            let object = Object::new(&BALL, SHADER).posed(view.pose());
            object.draw(&camera(view, PERSPECTIVE, OLED)?, vertices, &mut frame).ok()?;
            let bytes = frame.as_bytes().iter();
            display.fill_contiguous(&OLED, bytes.map(|&byte| RawU16::new(byte.into()).into())).ok()
        })
    }
}

/// Without any buffer for pixels or depth. Its author keeps it before the camera: nothing is
/// clipped.
#[derive(Clone, Copy, Debug)]
pub struct DitheredDirect;

impl Scene for DitheredDirect {
    type Memory = Vertices<NoDepth>;

    const MEMORY: Self::Memory = [ScreenVertex::EMPTY; BALL.vertex_count()];

    fn draw(vertices: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let object = Object::new(&BALL, SHADER).posed(view.pose()).clipped(ClipNone);
            let mut oled = Oled(display);
            object
                .draw(&camera(view, PERSPECTIVE, OLED)?, vertices, &mut Direct::new(&mut oled))
                .ok()
        })
    }
}

/// The display's driver.
struct Oled<'d>(&'d mut Display);

impl Dimensions for Oled<'_> {
    fn bounding_box(&self) -> Rectangle {
        OLED
    }
}

impl DrawTarget for Oled<'_> {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        self.0.draw_iter(pixels.into_iter().map(|Pixel(at, color)| Pixel(at, word(color))))
    }

    fn fill_contiguous<I: IntoIterator<Item = BinaryColor>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        self.0.fill_contiguous(area, colors.into_iter().map(word))
    }
}

fn word(color: BinaryColor) -> Rgb565 {
    RawU16::new(color.is_on().into()).into()
}
