//! Frames that are drawn in several samples a pixel, and sent with their mean.

use core::array;

use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{Point, Size},
    pixelcolor::PixelColor,
    primitives::Rectangle,
};

use super::{
    BandPixels, Bands, DepthBuffer, Frame, FrameError, Rows, StoredDepth, Unpacked,
    band_pixels::Memory, frame::Packed,
};
use crate::color::Mean;

/// `N` by `N` samples a pixel, 2 or 4: a display is drawn in `N` times its width and height, and
/// each of its pixels is the mean of a square of them (a box filter), in the values that are
/// stored. Edges, textures and small highlights are smoother, and so is what is blended.
///
/// A camera's viewport is [`Supersampled::area`] of the display's part. All of it must lie within
/// 1,024 samples of the viewport's middle to be drawn without being clipped.
///
/// ```
/// use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
/// use rasterizer::{output::Supersampled, prelude::*};
///
/// const SCREEN: Rectangle = Rectangle::new(Point::new(4, 0), Size::new(240, 240));
/// const SAMPLES: Rectangle = Supersampled::<2>::area(SCREEN);
/// assert_eq!(SAMPLES, Rectangle::new(Point::new(8, 0), Size::new(480, 480)));
///
/// // Twelve rows of the display: 24 of samples.
/// let (mut color, mut depth) = ([Rgb565::BLACK; 480 * 24], [0u16; 480 * 24]);
/// let bands = Bands::supersampled::<2>(SCREEN, &mut color, &mut depth)?;
/// assert_eq!(bands.areas().count(), 20);
/// # Ok::<(), rasterizer::output::FrameError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Supersampled<const N: usize>;

impl<const N: usize> Supersampled<N> {
    const BITS: u32 = {
        assert!(N == 2 || N == 4, "a side of a pixel has 2 or 4 samples");
        2 * N.trailing_zeros()
    };

    /// The samples of a part of the display.
    #[must_use]
    pub const fn area(display: Rectangle) -> Rectangle {
        const { assert!(Self::BITS > 0) };
        let Rectangle { top_left: Point { x, y }, size: Size { width, height } } = display;
        let side = N as u32;
        Rectangle::new(
            Point::new(x * N as i32, y * N as i32),
            Size::new(width * side, height * side),
        )
    }
}

/// A frame as the mean of its samples: what [`Frame::resolved`] makes.
#[derive(Clone, Copy, Debug)]
pub struct Resolved<'f, C, const N: usize> {
    samples: &'f [C],
    stride: usize,
    area: Rectangle,
}

impl<C: Mean, const N: usize> Resolved<'_, C, N> {
    /// The part of the display.
    #[must_use]
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The pixels, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = C> {
        let Self { samples, stride, area } = *self;
        let width = area.size.width as usize;
        samples.chunks(stride * N).flat_map(move |rows| {
            let mut rows = rows.chunks(stride);
            let rows: [&[[C; N]]; N] =
                array::from_fn(|_| rows.next().unwrap_or_default().as_chunks().0);
            (0..width).map(move |column| {
                let mut sum = C::NOTHING;
                for row in rows {
                    let Some(samples) = row.get(column) else { continue };
                    for sample in samples {
                        sum = sample.added_to(sum);
                    }
                }
                C::of_sum(sum, Supersampled::<N>::BITS)
            })
        })
    }

    /// Sends the pixels to the display in one run.
    ///
    /// # Errors
    ///
    /// Returns the display's error.
    pub fn present<T: DrawTarget<Color = C>>(&self, display: &mut T) -> Result<(), T::Error>
    where
        C: PixelColor,
    {
        display.fill_contiguous(&self.area, self.pixels())
    }
}

impl<C: Mean, B: DepthBuffer, R: Rows> Frame<'_, C, B, R> {
    /// The frame as a picture of `N` by `N` samples a pixel. Returns `None` unless its corner and
    /// its sides are multiples of `N`, as those of [`Supersampled::area`] are.
    #[must_use]
    pub fn resolved<const N: usize>(&self) -> Option<Resolved<'_, C, N>> {
        const { assert!(Supersampled::<N>::BITS > 0) };
        let Rectangle { top_left: Point { x, y }, size: Size { width, height } } = self.area();
        // A power of two.
        let rest = (N - 1) as u32;
        if (x as u32 | y as u32 | width | height) & rest != 0 {
            return None;
        }
        let bits = N.trailing_zeros();
        let area = Rectangle::new(
            Point::new(x >> bits, y >> bits),
            Size::new(width >> bits, height >> bits),
        );
        Some(Resolved { samples: self.pixels(), stride: self.stride().max(1), area })
    }
}

impl<C: Mean + 'static, const N: usize> BandPixels<C> for Supersampled<N> {}

impl<C: Mean + 'static, const N: usize> Memory<C> for Supersampled<N> {
    type Unit = C;
    const STEP: u32 = N as u32;
    type Frame<'f, B: DepthBuffer> = Frame<'f, C, B, Packed>;

    #[inline(always)]
    fn units(size: Size) -> usize {
        <Unpacked as Memory<C>>::units(size)
    }

    #[inline(always)]
    fn rows(units: usize, width: u32) -> u32 {
        <Unpacked as Memory<C>>::rows(units, width)
    }

    fn too_short(needed: usize) -> FrameError {
        <Unpacked as Memory<C>>::too_short(needed)
    }

    #[inline(always)]
    fn frame<B: DepthBuffer>(memory: &mut [C], depth: B, area: Rectangle) -> Frame<'_, C, B> {
        <Unpacked as Memory<C>>::frame(memory, depth, area)
    }

    #[inline(always)]
    fn send<B: DepthBuffer, T: DrawTarget<Color = C>>(
        band: &Frame<'_, C, B>,
        display: &mut T,
    ) -> Result<(), T::Error>
    where
        C: PixelColor,
    {
        match band.resolved::<N>() {
            Some(resolved) => resolved.present(display),
            // All bands have a multiple of `STEP` rows.
            None => Ok(()),
        }
    }
}

impl<'d, M: AsMut<[C]>, C: Mean + 'static, D: StoredDepth> Bands<M, C, &'d mut [D]> {
    /// Bands of a part of the display in `N` by `N` samples a pixel, with a depth buffer. Each has
    /// as many rows of samples as both buffers hold, down to a multiple of `N`. The areas and the
    /// frames are those of the samples.
    ///
    /// # Errors
    ///
    /// If a buffer does not hold a row of pixels, which is `N` rows of samples.
    pub fn supersampled<const N: usize>(
        display: Rectangle,
        color: M,
        depth: &'d mut [D],
    ) -> Result<Bands<M, C, &'d mut [D], Supersampled<N>>, FrameError> {
        Bands::with_depth(Supersampled::<N>::area(display), color, depth)
    }
}
