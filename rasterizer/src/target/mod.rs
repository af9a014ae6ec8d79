//! Where pixels go: into memory, or straight onto a display.

mod bands;
mod big_endian;
mod color;
mod depth;
mod direct;
mod fill;
mod frame;

pub use bands::{BandAreas, Bands, StreamError};
pub use big_endian::Rgb565Be;
pub use color::StoredColor;
pub use depth::{DepthBuffer, StoredDepth};
pub use direct::Direct;
use embedded_graphics_core::pixelcolor::PixelColor;
pub use fill::{Fill, PixelFill, WordFill};
pub use frame::{Frame, FrameError};

use crate::{
    geometry::{DepthFormat, Subpixel, Varyings},
    raster::{Interpolate, Triangle, Window},
};

/// What triangles are drawn into.
pub trait Target {
    /// The colour of its pixels.
    type Color: PixelColor;
    /// How it keeps depth, if it does.
    type Depth: DepthFormat + Interpolate;
    /// What can go wrong with drawing into it.
    type Error;

    /// The pixels that it takes.
    fn window(&self) -> Window;

    /// Draws a triangle's spans in a part of the window, each pixel in the colour that `pixel`
    /// makes of its varyings.
    ///
    /// # Errors
    ///
    /// Whatever the target's drawing ends in.
    fn shade<S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        triangle: Triangle<'_, S, Self::Depth, V>,
        window: &Window,
        pixel: impl FnMut(V::Sample) -> Self::Color,
    ) -> Result<(), Self::Error>;

    /// Draws a triangle's spans in a part of the window in one colour: [`shade`](Self::shade),
    /// unless there is a shorter way.
    ///
    /// # Errors
    ///
    /// Whatever the target's drawing ends in.
    #[inline(always)]
    fn fill<S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        triangle: Triangle<'_, S, Self::Depth, V>,
        window: &Window,
        color: Self::Color,
    ) -> Result<(), Self::Error> {
        self.shade(triangle, window, |_| color)
    }
}
