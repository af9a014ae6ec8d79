//! The depth test, and the loop over pixels that it is part of.

use core::{convert::Infallible, hint::black_box};

use crate::{
    geometry::{DepthFormat, NoDepth, Subpixel, Varyings},
    raster::{Interpolate, Layout, Span, Step, Triangle, Window},
};

/// The depth of a frame's pixels: `&mut [u16]`, `&mut [u32]`, or [`NoDepth`].
pub trait DepthBuffer {
    /// How a depth is stored.
    type Format: DepthFormat + Interpolate;

    /// Whether pixels are tested at all.
    const IS_STORED: bool;

    /// Whether there is a cell for each of so many pixels.
    fn holds(&self, pixels: usize) -> bool;

    /// Sets all cells to the far end of the range.
    fn clear(&mut self);

    /// Draws those pixels of a triangle that are nearer than what is stored, which their depth then
    /// replaces: what was drawn first wins a tie. Addresses in `layout` count in `colors` as in
    /// the buffer.
    ///
    /// # Errors
    ///
    /// None.
    fn shade<C, S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        colors: &mut [C],
        triangle: Triangle<'_, S, Self::Format, V>,
        window: &Window,
        layout: Layout,
        pixel: impl FnMut(V::Sample) -> C,
    ) -> Result<(), Infallible>;
}

/// A format of depth that a buffer can keep: `u16` or `u32`. The depth of 0 has no bit set.
pub trait StoredDepth: DepthFormat + Interpolate + PartialOrd + bytemuck::Pod {}

impl StoredDepth for u16 {}
impl StoredDepth for u32 {}

/// From so many pixels on, taking two at a time pays for a call: the loop costs 12 to 16
/// instructions a pixel instead of 15 to 19.
const LONG_RUN: usize = 16;

impl<D: StoredDepth> DepthBuffer for &mut [D] {
    type Format = D;

    const IS_STORED: bool = true;

    fn holds(&self, pixels: usize) -> bool {
        self.len() == pixels
    }

    fn clear(&mut self) {
        // All bits of a zero are 0, in words of any size.
        let (start, words, end) = bytemuck::pod_align_to_mut::<D, u32>(self);
        start.fill(D::ZERO);
        clear_words(words);
        end.fill(D::ZERO);
    }

    #[inline(always)]
    fn shade<C, S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        colors: &mut [C],
        triangle: Triangle<'_, S, D, V>,
        window: &Window,
        layout: Layout,
        mut pixel: impl FnMut(V::Sample) -> C,
    ) -> Result<(), Infallible> {
        // Of one length, they share the test of a span's end.
        let pixels = colors.len().min(self.len());
        let colors = colors.get_mut(..pixels).unwrap_or_default();
        let cells = self.get_mut(..pixels).unwrap_or_default();
        triangle.for_each_span(window, layout, |span| {
            let (start, end) = (span.start, span.end);
            if let (Some(colors), Some(cells)) =
                (colors.get_mut(start..end), cells.get_mut(start..end))
            {
                let mut run = Run::new(span);
                if cells.len() >= LONG_RUN {
                    run.draw_long(colors, cells, &mut pixel);
                } else {
                    // By their places, for which compilers take an instruction less a span than for
                    // slices zipped.
                    for place in 0..end - start {
                        roll();
                        let (Some(color), Some(cell)) =
                            (colors.get_mut(place), cells.get_mut(place))
                        else {
                            break;
                        };
                        run.draw(color, cell, &mut pixel);
                    }
                }
            }
            Ok(())
        })
    }
}

/// Sets words to zero, at one instruction for each. A function of its own: inlined into a large one
/// it takes three times as long on the M0+.
#[inline(never)]
fn clear_words(words: &mut [u32]) {
    // Known to be zero it would become a call of `memset`, which on a microcontroller takes two.
    let zero = black_box(0);
    // Shorter runs are repeated by the compiler until they take twice the flash.
    let (runs, rest) = words.as_chunks_mut::<64>();
    for run in runs {
        run.iter_mut().for_each(|word| *word = zero);
    }
    for word in rest {
        // As above, lest the compiler make a case of each length.
        *word = black_box(zero);
    }
}

/// Depth and varyings on the way along a span.
#[derive(Clone, Copy)]
struct Run<D: Interpolate, V: Interpolate> {
    depth: D::Accumulator,
    depth_step: D::Accumulator,
    varyings: V::Accumulator,
    varyings_step: V::Accumulator,
}

impl<D: Interpolate + PartialOrd, V: Interpolate> Run<D, V> {
    #[inline(always)]
    const fn new(span: &Span<D, V>) -> Self {
        Self {
            depth: span.depth,
            depth_step: span.depth_step,
            varyings: span.varyings,
            varyings_step: span.varyings_step,
        }
    }

    /// Draws a pixel if it is nearer, and goes on to the next.
    #[inline(always)]
    fn draw<C>(&mut self, color: &mut C, cell: &mut D, pixel: &mut impl FnMut(V::Sample) -> C) {
        let (depth, varyings) = (D::value(self.depth), self.varyings);
        self.depth = self.depth.plus(self.depth_step);
        self.varyings = self.varyings.plus(self.varyings_step);
        if depth > *cell {
            *cell = depth;
            *color = pixel(V::sample(varyings));
        }
    }

    /// Two pixels at a time, in a function of its own: it needs all registers.
    #[inline(never)]
    fn draw_long<C>(
        mut self,
        colors: &mut [C],
        cells: &mut [D],
        mut pixel: impl FnMut(V::Sample) -> C,
    ) {
        let (color_pairs, last_color) = colors.as_chunks_mut::<2>();
        let (cell_pairs, last_cell) = cells.as_chunks_mut::<2>();
        for ([color, next_color], [cell, next_cell]) in color_pairs.iter_mut().zip(cell_pairs) {
            roll();
            self.draw(color, cell, &mut pixel);
            self.draw(next_color, next_cell, &mut pixel);
        }
        for (color, cell) in last_color.iter_mut().zip(last_cell) {
            self.draw(color, cell, &mut pixel);
        }
    }
}

/// Keeps a loop as it is written. Compilers unroll the loop over pixels four times, work out
/// multiples of the steps beforehand and then have too few registers for them: 16 to 18
/// instructions a pixel on the Cortex-M4 instead of 12 to 15. It is no instruction itself.
#[inline(always)]
pub(super) const fn roll() {
    black_box(());
}

impl DepthBuffer for NoDepth {
    type Format = Self;

    const IS_STORED: bool = false;

    fn holds(&self, _: usize) -> bool {
        true
    }

    fn clear(&mut self) {}

    #[inline(always)]
    fn shade<C, S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        colors: &mut [C],
        triangle: Triangle<'_, S, Self, V>,
        window: &Window,
        layout: Layout,
        mut pixel: impl FnMut(V::Sample) -> C,
    ) -> Result<(), Infallible> {
        triangle.for_each_span(window, layout, |span| {
            let mut varyings = span.varyings;
            for color in colors.get_mut(span.start..span.end).unwrap_or_default() {
                *color = pixel(V::sample(varyings));
                varyings = varyings.plus(span.varyings_step);
            }
            Ok(())
        })
    }
}
