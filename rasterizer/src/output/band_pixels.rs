//! How the pixels of a band lie in memory.

use embedded_graphics_core::{
    draw_target::DrawTarget, geometry::Size, pixelcolor::PixelColor, primitives::Rectangle,
};

use super::{
    BitOrder, DepthBuffer, Frame, FrameError, PackedColor, PackedFrame,
    bits::{bytes_of, rows_of, rows_of_byte},
};
use crate::numbers::divide;

/// How the pixels of [`Bands`](super::Bands) lie in memory: [`Unpacked`], or several in a byte,
/// [`InRows`](super::InRows) or [`InPages`](super::InPages).
pub trait BandPixels<C>: Memory<C> {}

/// Each pixel by itself: memory is a slice of colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Unpacked;

impl<C: Copy + 'static> BandPixels<C> for Unpacked {}
impl<C: PackedColor + 'static, O: BitOrder> BandPixels<C> for O {}

mod private {
    use super::{DepthBuffer, DrawTarget, FrameError, PixelColor, Rectangle, Size};

    /// Memory of a band's pixels.
    pub trait Memory<C> {
        /// What it consists of: pixels, or bytes.
        type Unit;
        /// All bands but the last have a multiple of this number of rows.
        const STEP: u32;
        /// A band as a frame.
        type Frame<'f, B: DepthBuffer>;

        /// How many units a rectangle takes.
        fn units(size: Size) -> usize;

        /// How many rows of a rectangle that many units hold, whose width is not 0.
        fn rows(units: usize, width: u32) -> u32;

        /// The error for memory with fewer units than a rectangle takes.
        fn too_short(needed: usize) -> FrameError;

        /// A band in memory of just its size, with its depth cleared.
        fn frame<B: DepthBuffer>(
            memory: &mut [Self::Unit],
            depth: B,
            area: Rectangle,
        ) -> Self::Frame<'_, B>;

        /// Sends a band.
        fn send<B: DepthBuffer, T: DrawTarget<Color = C>>(
            band: &Self::Frame<'_, B>,
            display: &mut T,
        ) -> Result<(), T::Error>
        where
            C: PixelColor;
    }
}

pub(super) use private::Memory;

impl<C: Copy + 'static> Memory<C> for Unpacked {
    type Unit = C;
    const STEP: u32 = 1;
    type Frame<'f, B: DepthBuffer> = Frame<'f, C, B>;

    #[inline(always)]
    fn units(Size { width, height }: Size) -> usize {
        width as usize * height as usize
    }

    #[inline(always)]
    fn rows(units: usize, width: u32) -> u32 {
        divide(units as u32, width)
    }

    fn too_short(needed: usize) -> FrameError {
        FrameError::ColorLength { needed }
    }

    #[inline(always)]
    fn frame<B: DepthBuffer>(memory: &mut [C], depth: B, area: Rectangle) -> Frame<'_, C, B> {
        let mut frame = Frame::part(memory, depth, area);
        frame.clear_depth();
        frame
    }

    #[inline(always)]
    fn send<B: DepthBuffer, T: DrawTarget<Color = C>>(
        band: &Frame<'_, C, B>,
        display: &mut T,
    ) -> Result<(), T::Error>
    where
        C: PixelColor,
    {
        band.present(display)
    }
}

impl<C: PackedColor + 'static, O: BitOrder> Memory<C> for O {
    type Unit = u8;
    const STEP: u32 = rows_of_byte::<C, O>();
    type Frame<'f, B: DepthBuffer> = PackedFrame<'f, C, B, O>;

    fn units(size: Size) -> usize {
        bytes_of::<C, O>(size)
    }

    fn rows(units: usize, width: u32) -> u32 {
        rows_of::<C, O>(units, width)
    }

    fn too_short(needed: usize) -> FrameError {
        FrameError::PackedLength { needed }
    }

    #[inline(always)]
    fn frame<B: DepthBuffer>(
        memory: &mut [u8],
        depth: B,
        area: Rectangle,
    ) -> PackedFrame<'_, C, B, O> {
        let mut frame = PackedFrame::part(memory, depth, area);
        frame.clear_depth();
        frame
    }

    #[inline(always)]
    fn send<B: DepthBuffer, T: DrawTarget<Color = C>>(
        band: &PackedFrame<'_, C, B, O>,
        display: &mut T,
    ) -> Result<(), T::Error> {
        band.present(display)
    }
}
