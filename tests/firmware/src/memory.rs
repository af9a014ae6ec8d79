//! The memory that a frame takes, as the firmware owns it.

use core::cell::RefCell;

use critical_section::Mutex;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};

/// Colour and depth of so many pixels.
#[derive(Debug)]
pub struct Memory<const PIXELS: usize> {
    /// The pixels.
    pub color: [Rgb565; PIXELS],
    /// Their depth.
    pub depth: [u16; PIXELS],
}

/// Memory in a static, lent to one at a time.
pub type Shared<const PIXELS: usize> = Mutex<RefCell<Memory<PIXELS>>>;

impl<const PIXELS: usize> Memory<PIXELS> {
    /// For a static.
    #[must_use]
    pub const fn shared() -> Shared<PIXELS> {
        Mutex::new(RefCell::new(Self {
            color: [Rgb565::BLACK; PIXELS],
            depth: [0; PIXELS],
        }))
    }
}
