//! The loop over pixels: depth test, colour, next pixel.

use core::convert::Infallible;

use crate::{
    attribute::{DepthFormat, Interpolate, Piece, Step as _},
    numbers::{IS_NARROW, codegen},
    raster::{Fragment, FragmentOf, Layout, Primitive, Span, Window},
    shade::Outcome,
};

/// From this many pixels on, taking two at a time pays for a call: the loop costs 12 to 16
/// instructions a pixel instead of 15 to 19.
const LONG_RUN: usize = 16;

/// Varyings of at most this size leave a narrow core the registers for blocks of more than two
/// pixels without depth. What takes more is divided at each pixel, beside which a block saves
/// little.
const FEW_BYTES: usize = 16;

/// Draws those pixels of a primitive that are nearer than what is stored, which their depth then
/// replaces, unless their outcome leaves it: what was drawn first wins a tie. `pixel` gets the
/// stored colour and the fragment. Addresses in `layout` count in `colors` as in `cells`.
#[inline(always)]
pub(super) fn draw<C: Copy, Q: Primitive, O: Outcome<C>>(
    colors: &mut [C],
    cells: &mut [Q::Depth],
    primitive: &Q,
    window: &Window,
    layout: Layout,
    pixel: impl Fn(C, FragmentOf<Q>) -> O + Copy,
) -> Result<(), Infallible> {
    // Of one length, they share the test of a span's end.
    let pixels = colors.len().min(cells.len());
    let colors = colors.get_mut(..pixels).unwrap_or_default();
    let cells = cells.get_mut(..pixels).unwrap_or_default();
    primitive.for_each_span(window, layout, |span| {
        let at = [span.start as i32, span.row];
        match Q::Varyings::whole(span.varyings, at, span.end - span.start) {
            Some(piece) => {
                if let (Some(colors), Some(cells)) =
                    (colors.get_mut(span.start..span.end), cells.get_mut(span.start..span.end))
                {
                    let run = Run::<Q::Depth, Q::Varyings>::of(span.depth, span.depth_step, piece);
                    run.draw(colors, cells, Place::of(span, layout), pixel);
                }
            }
            // codegen: a copy, so that spans of one piece are in registers.
            None => draw_pieces(colors, cells, &Span { ..*span }, Place::of(span, layout), pixel),
        }
        Ok(())
    })
}

/// Draws a span in several pieces.
// codegen: not inlined, because the loop over rows needs its registers.
#[inline(never)]
fn draw_pieces<C: Copy, D: DepthFormat, V: Interpolate, O: Outcome<C>>(
    colors: &mut [C],
    cells: &mut [D],
    span: &Span<'_, D, V>,
    place: Place,
    pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
) {
    // Of one length, they share the tests of a piece's ends.
    let pixels = span.end.wrapping_sub(span.start);
    let Some(colors) = colors.get_mut(span.start..span.end) else { return };
    let Some(cells) = cells.get_mut(span.start..span.end) else { return };
    let at = [span.start as i32, span.row];
    let (mut start, mut depth) = (0, span.depth);
    V::for_each_piece(span.varyings, at, pixels, |piece| {
        let end = start + piece.pixels;
        if let (Some(colors), Some(cells)) = (colors.get_mut(start..end), cells.get_mut(start..end))
        {
            let run = Run::<D, V>::of(depth, span.depth_step, piece);
            run.draw_long(colors, cells, place.right(start), pixel);
        }
        start = end;
        depth = depth.wrapping_add(span.depth_step.wrapping_mul(piece.pixels as i32));
    });
}

/// The place of a pixel on the display.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    column: i32,
    row: i32,
}

impl Place {
    /// Of the first pixel of a span.
    #[inline(always)]
    pub(super) const fn of<D: DepthFormat, V: Interpolate>(
        span: &Span<'_, D, V>,
        layout: Layout,
    ) -> Self {
        let column = (span.start as i32).wrapping_sub(layout.row_address(span.row));
        Self { column, row: span.row }
    }

    /// Some pixels to the right.
    #[inline(always)]
    pub(super) const fn right(self, pixels: usize) -> Self {
        Self { column: self.column.wrapping_add(pixels as i32), ..self }
    }
}

/// Depth and varyings on the way along pixels between which they change by equal steps: a piece of
/// a span.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run<D: DepthFormat, V: Interpolate> {
    depth: D::Walk,
    depth_step: D::Walk,
    varyings: V::Walk,
    varyings_step: V::Walk,
}

impl<D: DepthFormat, V: Interpolate> Run<D, V> {
    /// The first piece of a span, its number of pixels, and the pieces after it.
    #[inline(always)]
    pub(super) fn first_of(span: &Span<'_, D, V>) -> (Self, usize, V::Rest) {
        let at = [span.start as i32, span.row];
        let (piece, rest) = V::walk(span.varyings, at, span.end - span.start);
        (Self::of(span.depth, span.depth_step, piece), piece.pixels, rest)
    }

    /// A piece of a span, with the depth at its first pixel.
    #[inline(always)]
    const fn of(depth: D::Walk, depth_step: D::Walk, piece: Piece<V::Walk>) -> Self {
        Self { depth, depth_step, varyings: piece.first, varyings_step: piece.step }
    }

    /// Goes on with the span's next piece, behind the last pixel of this one. Returns its number of
    /// pixels.
    #[inline(always)]
    pub(super) const fn enter(&mut self, piece: Piece<V::Walk>) -> usize {
        (self.varyings, self.varyings_step) = (piece.first, piece.step);
        piece.pixels
    }

    /// The fragment at hand.
    #[inline(always)]
    pub(super) fn fragment(&self, place: Place) -> Fragment<V::Sample> {
        Fragment {
            varyings: V::sample(self.varyings),
            depth: D::at(self.depth).to_fraction(),
            column: place.column,
            row: place.row,
        }
    }

    /// Goes on to the next pixel.
    #[inline(always)]
    pub(super) fn step(&mut self) {
        self.depth = self.depth.wrapping_add(self.depth_step);
        self.varyings = self.varyings.wrapping_add(self.varyings_step);
    }

    #[inline(always)]
    fn draw<C: Copy, O: Outcome<C>>(
        mut self,
        colors: &mut [C],
        cells: &mut [D],
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        if cells.len() >= LONG_RUN {
            self.draw_long(colors, cells, place, pixel);
            return;
        }
        // codegen: by their indices, for which compilers take an instruction less a span than for
        // slices zipped.
        for index in 0..cells.len() {
            codegen::keep_rolled();
            let (Some(color), Some(cell)) = (colors.get_mut(index), cells.get_mut(index)) else {
                break;
            };
            self.draw_pixel(color, cell, place.right(index), pixel);
        }
    }

    /// Several pixels at a time.
    #[inline(always)]
    fn draw_long<C: Copy, O: Outcome<C>>(
        self,
        colors: &mut [C],
        cells: &mut [D],
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let Self { depth, depth_step, varyings, varyings_step } = self;
        let (depth, varyings) = ((depth, depth_step), (&varyings, &varyings_step));
        Self::draw_blocks(depth, varyings, colors, cells, place, pixel);
    }

    /// The same from depth and varyings with their steps.
    // codegen: not inlined, because it needs all registers. References to what has up to three
    // numbers become arguments for those that are read; one to a run, which has more, would keep it
    // in memory.
    #[inline(never)]
    fn draw_blocks<C: Copy, O: Outcome<C>>(
        (depth, depth_step): (D::Walk, D::Walk),
        (&varyings, &varyings_step): (&V::Walk, &V::Walk),
        colors: &mut [C],
        cells: &mut [D],
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let tests_depth = size_of::<D>() != 0;
        // codegen: with one length for both; on a narrow core that costs the loop a register.
        if !(IS_NARROW && tests_depth) && colors.len() != cells.len() {
            return;
        }
        let run = Self { depth, depth_step, varyings, varyings_step };
        let has_few_registers = size_of::<V::Walk>() > FEW_BYTES;
        // A blended pixel is long: to repeat it eight times takes flash, and saves little.
        if IS_NARROW && !tests_depth && !has_few_registers && !O::IS_BLENDED {
            run.draw_in_blocks_of::<8, _, _>(colors, cells, place, pixel);
        } else {
            run.draw_in_blocks_of::<2, _, _>(colors, cells, place, pixel);
        }
    }

    /// `N` pixels at a time, an even number.
    #[inline(always)]
    fn draw_in_blocks_of<const N: usize, C: Copy, O: Outcome<C>>(
        mut self,
        colors: &mut [C],
        cells: &mut [D],
        mut place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        // codegen: the optimiser computes multiples of the steps for a longer block, and has no
        // registers for them, unless the values at its start have no law that it can see.
        let mut nothing = (D::Walk::ZERO, V::Walk::ZERO);
        if N > 2 {
            codegen::in_memory(&mut nothing);
        }
        let (color_blocks, last_colors) = colors.as_chunks_mut::<N>();
        let (cell_blocks, last_cells) = cells.as_chunks_mut::<N>();
        for (colors, cells) in color_blocks.iter_mut().zip(cell_blocks) {
            codegen::keep_rolled();
            if N > 2 {
                self.depth = self.depth.wrapping_add(nothing.0);
                self.varyings = self.varyings.wrapping_add(nothing.1);
            }
            let (color_pairs, cell_pairs) = (colors.as_chunks_mut().0, cells.as_chunks_mut().0);
            for ([color, next_color], [cell, next_cell]) in color_pairs.iter_mut().zip(cell_pairs) {
                self.draw_pixel(color, cell, place, pixel);
                self.draw_pixel(next_color, next_cell, place.right(1), pixel);
                place = place.right(2);
            }
        }
        for (color, cell) in last_colors.iter_mut().zip(last_cells) {
            codegen::keep_rolled();
            self.draw_pixel(color, cell, place, pixel);
            place = place.right(1);
        }
    }

    /// Draws the pixel at hand if it is nearer than what is stored, and goes on to the next.
    #[inline(always)]
    fn draw_pixel<C: Copy, O: Outcome<C>>(
        &mut self,
        color: &mut C,
        cell: &mut D,
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let here = *self;
        self.step();
        let depth = D::at(here.depth);
        if !depth.is_nearer(*cell) {
            return;
        }
        // codegen: before the shader runs, where nothing can prevent it: one register less.
        if O::WRITES_DEPTH && !O::DISCARDS {
            *cell = depth;
        }
        if let Some(outcome) = pixel(*color, here.fragment(place)).color() {
            if O::WRITES_DEPTH && O::DISCARDS {
                *cell = depth;
            }
            *color = outcome;
        }
    }
}
