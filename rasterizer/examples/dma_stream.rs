//! A band is drawn while DMA sends the one before it: `Bands::stream` with two buffers.
//!
//! The picture has the bands of one buffer on blue, those of the other on purple.
//!
//! `cargo run -p rasterizer --example dma_stream`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use std::convert::Infallible;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    pixelcolor::{Rgb565, raw::RawU16},
    prelude::*,
    primitives::Rectangle,
};
use rasterizer::prelude::*;
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const ROWS: u32 = 20;
const NEEDS: Needs = Needs::of(&ROCKET, SCREEN.size, ROWS);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.15"), Level::lit("0.9"));

/// Pixels in the byte order of an SPI bus. DMA takes them as they lie in memory, which must be
/// static.
type Buffer = [Rgb565Be; NEEDS.pixels];
static FIRST: ConstStaticCell<Buffer> = ConstStaticCell::new([Rgb565Be::BLACK; NEEDS.pixels]);
static SECOND: ConstStaticCell<Buffer> = ConstStaticCell::new([Rgb565Be::BLACK; NEEDS.pixels]);

/// Stands for a DMA channel of the SPI bus, and a transfer that is under way.
struct Transfer<'d> {
    display: &'d mut Screen,
    sending: &'static mut Buffer,
}

impl Transfer<'_> {
    /// Waits until the last transfer is complete, starts the next, and returns the free buffer.
    fn swap(
        &mut self,
        drawn: &'static mut Buffer,
        area: Rectangle,
    ) -> Result<&'static mut Buffer, Infallible> {
        // A driver waits here for its channel, sets the display's window, and starts the transfer
        // of these bytes. This one is complete when it returns.
        let pixels = (area.size.width * area.size.height) as usize;
        let (bytes, _) = Rgb565Be::as_bytes(&drawn[..pixels]).as_chunks();
        let colors = bytes.iter().map(|&pair| RawU16::new(u16::from_be_bytes(pair)).into());
        self.display.fill_contiguous(&area, colors)?;
        Ok(core::mem::replace(&mut self.sending, drawn))
    }
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(Turn::degrees(35)) * Rotation::about_y(-Turn::degrees(20));
    let pose = Pose::rotated(tilted).scaled(const { Distance::lit("1.2") });
    let rocket = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose);

    let mut depth = [0u16; NEEDS.pixels];
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; NEEDS.vertices];
    let mut bins = [0; NEEDS.bin_words];
    let seen = rocket.project(&camera(SCREEN)?, &mut vertices)?.binned(ROWS, &mut bins)?;

    let grounds = [Rgb565::new(4, 16, 14), Rgb565::new(9, 11, 14)].map(Rgb565Be::from);
    let mut transfer = Transfer { display: screen, sending: SECOND.take() };
    Bands::new(SCREEN, FIRST.take(), &mut depth)?.stream(
        |band| {
            let number = band.bounding_box().top_left.y as usize / ROWS as usize;
            band.clear_color(grounds[number % 2]);
        },
        |band| seen.draw(band),
        |drawn, area| transfer.swap(drawn, area),
    )?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
