//! The memory that a frame takes, as the firmware owns it.

use core::cell::RefCell;

use critical_section::Mutex;
use rasterizer::output::Rgb565Be;

/// Colour and depth of `PIXELS` pixels.
#[derive(Debug)]
pub struct Memory<const PIXELS: usize> {
    /// The pixels, as a display's bus takes them.
    pub color: [Rgb565Be; PIXELS],
    /// Their depth.
    pub depth: [u16; PIXELS],
}

/// Memory in a static, lent to one at a time.
pub type Shared<const PIXELS: usize> = Mutex<RefCell<Memory<PIXELS>>>;

impl<const PIXELS: usize> Memory<PIXELS> {
    /// For a static.
    #[must_use]
    pub const fn shared() -> Shared<PIXELS> {
        Mutex::new(RefCell::new(Self { color: [Rgb565Be::BLACK; PIXELS], depth: [0; PIXELS] }))
    }
}
