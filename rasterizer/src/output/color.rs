//! What the memory of a frame holds.

use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, Rgb555, Rgb565, Rgb666,
    Rgb888,
};

use super::{ByteFill, Fill, PixelFill};
use crate::color::Rgb332;

/// A colour that memory can be filled with: all of embedded-graphics, [`Rgb332`] and
/// [`Rgb565Be`](super::Rgb565Be).
///
/// For your own colour type, it takes one line:
///
/// ```
/// use embedded_graphics_core::{pixelcolor::raw::RawU4, prelude::*, primitives::Rectangle};
/// use rasterizer::output::{Frame, PixelFill, StoredColor};
///
/// /// A place in a palette.
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// struct Indexed(u8);
///
/// impl PixelColor for Indexed {
///     type Raw = RawU4;
/// }
///
/// impl StoredColor for Indexed {
///     type Fill = PixelFill<Self>;
/// }
///
/// let mut pixels = [Indexed(0); 3 * 2];
/// Frame::without_depth(&mut pixels, Rectangle::new(Point::zero(), Size::new(3, 2)))?
///     .clear(Indexed(7));
/// assert_eq!(pixels, [Indexed(7); 6]);
/// # Ok::<(), rasterizer::output::FrameError>(())
/// ```
///
/// A colour of 16 bits that is plain data and aligned like a `u16` can have
/// [`WordFill`](super::WordFill) instead.
pub trait StoredColor: Copy {
    /// How runs of pixels are set to it.
    type Fill: Fill<Self>;
}

macro_rules! by_pixels {
    ($($color:ty),*) => {
        $(impl StoredColor for $color {
            type Fill = PixelFill<Self>;
        })*
    };
}

by_pixels!(BinaryColor, Gray2, Gray4, Gray8);
by_pixels!(Rgb555, Rgb565, Rgb666, Rgb888, Bgr555, Bgr565, Bgr666, Bgr888);

impl StoredColor for Rgb332 {
    type Fill = ByteFill<Self>;
}
