//! Where pixels go: into memory, or straight onto a display.

mod band_pixels;
mod bands;
mod big_endian;
mod bits;
mod blending;
mod cell;
mod color;
mod depth;
mod direct;
mod dithering;
mod factor;
mod fill;
mod frame;
mod gradient;
mod keep_depth;
mod modes;
mod once;
mod packed;
mod pixels;
mod scissored;
mod supersampled;

pub use band_pixels::{BandPixels, Unpacked};
pub use bands::{BandAreas, Bands, StreamError};
pub use big_endian::Rgb565Be;
pub use bits::{BitOrder, InPages, InRows, PackedColor};
pub use blending::{Blend, Blending, Replace};
pub use color::StoredColor;
pub use depth::{DepthBuffer, FrameDepth, StoredDepth};
pub use direct::Direct;
pub use dithering::Dithering;
pub use factor::{Factor, MaterialOpacity};
pub use fill::{ByteFill, Fill, PixelFill, WordFill};
pub use frame::{Frame, FrameError, Packed, Rows, Strided};
pub use gradient::VerticalGradient;
pub use keep_depth::KeepDepth;
pub use modes::{Add, Multiply, Over, Screen};
pub use once::Once;
pub use packed::PackedFrame;
pub use scissored::Scissored;
pub use supersampled::{Resolved, Supersampled};

use crate::{
    attribute::DepthFormat,
    raster::{FragmentOf, Primitive, Window},
    shade::Outcome,
};

/// What primitives are drawn into.
pub trait Target {
    /// The colour of its pixels.
    type Color: Copy;
    /// How it keeps depth.
    type Depth: DepthFormat;
    /// How drawing into it fails.
    type Error;

    /// The pixels that can be drawn.
    fn window(&self) -> Window;

    /// Draws a primitive's pixels in a part of the window, each in the colour that `pixel` makes of
    /// its fragment.
    ///
    /// # Errors
    ///
    /// Returns the target's error.
    fn shade<Q: Primitive<Depth = Self::Depth>, O: Outcome<Self::Color>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Self::Error>;

    /// Draws a primitive's pixels in a part of the window, all of one colour. By
    /// [`shade`](Self::shade), unless the target has a shorter way.
    ///
    /// # Errors
    ///
    /// Returns the target's error.
    #[inline(always)]
    fn fill<Q: Primitive<Depth = Self::Depth>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        color: Self::Color,
    ) -> Result<(), Self::Error> {
        self.shade(primitive, window, move |_| color)
    }
}

/// A target whose pixels can be read, so that colours can be blended with them: a [`Frame`], or a
/// band of [`Bands`].
#[diagnostic::on_unimplemented(
    message = "the pixels of `{Self}` cannot be read, so nothing can be blended with them",
    label = "its pixels cannot be read",
    note = "a display only takes pixels: blend in a `Frame` or in `Bands`, and send those"
)]
pub trait Readable: Target {
    /// Draws a primitive's pixels in a part of the window, each in the colour that `pixel` makes of
    /// the stored one and its fragment.
    ///
    /// # Errors
    ///
    /// Returns the target's error.
    fn blend<Q: Primitive<Depth = Self::Depth>, O: Outcome<Self::Color>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(Self::Color, FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Self::Error>;
}
