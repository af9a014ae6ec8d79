//! The loop over pixels: depth test, colour, next pixel.

use core::convert::Infallible;

use crate::{
    attribute::{DepthFormat, Interpolate, Piece, Step as _},
    numbers::codegen,
    raster::{Fragment, FragmentOf, Layout, Primitive, Span, Window},
    shade::Outcome,
};

/// From this many pixels on, taking two at a time pays for a call: the loop costs 12 to 16
/// instructions a pixel instead of 15 to 19.
const LONG_RUN: usize = 16;

/// Draws those pixels of a primitive that are nearer than what is stored, which their depth then
/// replaces: what was drawn first wins a tie. `pixel` gets the stored colour and the fragment.
/// Addresses in `layout` count in `colors` as in `cells`.
#[inline(always)]
pub(super) fn draw<C: Copy, Q: Primitive, O: Outcome<C>>(
    colors: &mut [C],
    cells: &mut [Q::Depth],
    primitive: &Q,
    window: &Window,
    layout: Layout,
    mut pixel: impl FnMut(C, FragmentOf<Q>) -> O,
) -> Result<(), Infallible> {
    // Of one length, they share the test of a span's end.
    let pixels = colors.len().min(cells.len());
    let colors = colors.get_mut(..pixels).unwrap_or_default();
    let cells = cells.get_mut(..pixels).unwrap_or_default();
    primitive.for_each_span(window, layout, |span| {
        let mut start = span.start;
        let (mut run, mut rest) = Run::<Q::Depth, Q::Varyings>::first_of(span, layout);
        loop {
            let end = start + run.pixels;
            if let (Some(colors), Some(cells)) =
                (colors.get_mut(start..end), cells.get_mut(start..end))
            {
                run.draw(colors, cells, &mut pixel);
            }
            let Some(piece) = rest.next() else { return Ok(()) };
            start = end;
            run.skip();
            run.enter(piece);
        }
    })
}

/// Pixels in a row along which depth and varyings change by equal steps: a piece of a span.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run<D: DepthFormat, V: Interpolate> {
    pub(super) pixels: usize,
    depth: D::Accumulator,
    depth_step: D::Accumulator,
    varyings: V::Walk,
    varyings_step: V::Walk,
    column: i32,
    row: i32,
}

impl<D: DepthFormat, V: Interpolate> Run<D, V> {
    /// The first piece of a span, and the pieces after it.
    #[inline(always)]
    pub(super) fn first_of(span: &Span<D, V>, layout: Layout) -> (Self, V::Rest) {
        let (piece, rest) = V::walk(span.varyings, span.varyings_step, span.end - span.start);
        let run = Self {
            pixels: piece.pixels,
            depth: span.depth,
            depth_step: span.depth_step,
            varyings: piece.first,
            varyings_step: piece.step,
            column: (span.start as i32).wrapping_sub(layout.row_address(span.row)),
            row: span.row,
        };
        (run, rest)
    }

    /// Goes on with the span's next piece, behind the last pixel of this one.
    #[inline(always)]
    pub(super) fn enter(&mut self, piece: Piece<V::Walk>) {
        self.pixels = piece.pixels;
        (self.varyings, self.varyings_step) = (piece.first, piece.step);
    }

    /// Goes from the first pixel behind the last one; the varyings stay.
    #[inline(always)]
    fn skip(&mut self) {
        let pixels = self.pixels as i32;
        self.depth = self.depth.wrapping_add(self.depth_step.wrapping_mul(pixels));
        self.column = self.column.wrapping_add(pixels);
    }

    /// The fragment at hand.
    #[inline(always)]
    pub(super) fn fragment(&self) -> Fragment<V::Sample> {
        Fragment {
            varyings: V::sample(self.varyings),
            depth: D::at(self.depth).to_fraction(),
            column: self.column,
            row: self.row,
        }
    }

    /// Goes on to the next pixel.
    #[inline(always)]
    pub(super) fn step(&mut self) {
        self.depth = self.depth.wrapping_add(self.depth_step);
        self.varyings = self.varyings.wrapping_add(self.varyings_step);
        self.column = self.column.wrapping_add(1);
    }

    #[inline(always)]
    fn draw<C: Copy, O: Outcome<C>>(
        mut self,
        colors: &mut [C],
        cells: &mut [D],
        mut pixel: impl FnMut(C, Fragment<V::Sample>) -> O,
    ) {
        if cells.len() >= LONG_RUN {
            self.draw_long(colors, cells, pixel);
            return;
        }
        // codegen: by their places, for which compilers take an instruction less a span than for
        // slices zipped.
        for place in 0..cells.len() {
            codegen::keep_rolled();
            let (Some(color), Some(cell)) = (colors.get_mut(place), cells.get_mut(place)) else {
                break;
            };
            self.draw_pixel(color, cell, &mut pixel);
        }
    }

    /// Two pixels at a time.
    // codegen: not inlined, because it needs all registers.
    #[inline(never)]
    fn draw_long<C: Copy, O: Outcome<C>>(
        mut self,
        colors: &mut [C],
        cells: &mut [D],
        mut pixel: impl FnMut(C, Fragment<V::Sample>) -> O,
    ) {
        let (color_pairs, last_color) = colors.as_chunks_mut::<2>();
        let (cell_pairs, last_cell) = cells.as_chunks_mut::<2>();
        for ([color, next_color], [cell, next_cell]) in color_pairs.iter_mut().zip(cell_pairs) {
            codegen::keep_rolled();
            self.draw_pixel(color, cell, &mut pixel);
            self.draw_pixel(next_color, next_cell, &mut pixel);
        }
        for (color, cell) in last_color.iter_mut().zip(last_cell) {
            self.draw_pixel(color, cell, &mut pixel);
        }
    }

    /// Draws the pixel at hand if it is nearer than what is stored, and goes on to the next.
    #[inline(always)]
    fn draw_pixel<C: Copy, O: Outcome<C>>(
        &mut self,
        color: &mut C,
        cell: &mut D,
        pixel: &mut impl FnMut(C, Fragment<V::Sample>) -> O,
    ) {
        let here = *self;
        self.step();
        let depth = D::at(here.depth);
        if !depth.is_nearer(*cell) {
            return;
        }
        // codegen: before the shader runs, where nothing can prevent it: one register less.
        if !O::DISCARDS {
            *cell = depth;
        }
        if let Some(outcome) = pixel(*color, here.fragment()).color() {
            if O::DISCARDS {
                *cell = depth;
            }
            *color = outcome;
        }
    }
}
