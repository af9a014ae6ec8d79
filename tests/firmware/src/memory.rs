//! The memory that a frame takes, as the firmware owns it.

use core::cell::RefCell;

use critical_section::Mutex;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use rasterizer::geometry::{S4, S8, ScreenVertex};

/// Colour, depth, and vertices of each kind that the scenes use.
#[derive(Debug)]
pub struct Memory<const PIXELS: usize, const VERTICES: usize> {
    /// The pixels.
    pub color: [Rgb565; PIXELS],
    /// Their depth.
    pub depth: [u16; PIXELS],
    /// Vertices in sixteenths of a pixel.
    pub coarse: [ScreenVertex<S4, u16, [u16; 1]>; VERTICES],
    /// Vertices in 256ths of a pixel.
    pub fine: [ScreenVertex<S8, u16, [u16; 1]>; VERTICES],
}

/// Memory in a static, lent to one at a time.
pub type Shared<const PIXELS: usize, const VERTICES: usize> = Mutex<RefCell<Memory<PIXELS, VERTICES>>>;

impl<const PIXELS: usize, const VERTICES: usize> Memory<PIXELS, VERTICES> {
    /// For a static.
    #[must_use]
    pub const fn shared() -> Shared<PIXELS, VERTICES> {
        Mutex::new(RefCell::new(Self {
            color: [Rgb565::BLACK; PIXELS],
            depth: [0; PIXELS],
            coarse: [ScreenVertex::EMPTY; VERTICES],
            fine: [ScreenVertex::EMPTY; VERTICES],
        }))
    }
}
