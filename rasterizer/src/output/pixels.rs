//! The loop over pixels: depth test, colour, next pixel.
//!
//! Pixels of a long run whose depth cells are clear need no test. [`DepthFormat::claim`] stores
//! their depths, and a loop without test draws their colours. The rest of the run is tested.

use core::{convert::Infallible, mem};

use super::cell::{Cell, Claimed};
use crate::{
    attribute::{DepthFormat, Interpolate, Piece, Step as _},
    numbers::{IS_NARROW, codegen},
    raster::{Fragment, FragmentOf, Layout, Primitive, Span, Window},
    shade::{CodeSize, Outcome},
};

/// From this many pixels on, taking two at a time pays for a call: the loop costs 12 to 16
/// instructions a pixel instead of 15 to 19.
const LONG_RUN: usize = 16;

/// From this many pixels on, clear cells are claimed: that saves 1 to 4 instructions a pixel, and
/// two more calls take some 40.
const LONG_CLAIM: usize = 32;

/// Whether clear cells of runs by themselves are claimed, not only those of spans in pieces. A core
/// with twice as many registers has enough for one loop, and to save them for a call takes longer
/// than a claim saves: 7 % of `sphere-gouraud` on RV32IMC.
const CLAIMS_RUNS: bool = !cfg!(any(target_arch = "riscv32", target_arch = "riscv64"));

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
    let pixels = span.end.wrapping_sub(span.start);
    let Some(colors) = colors.get_mut(span.start..span.end) else { return };
    let Some(cells) = cells.get_mut(span.start..span.end) else { return };
    // Once for all pieces, which are often too short to pay for it.
    let claimed =
        if can_claim::<D, C, O>() { D::claim(cells, span.depth, span.depth_step) } else { 0 };
    let mut whole = PiecedSpan { cells, unclaimed: pixels - claimed, span, place };
    let at = [span.start as i32, span.row];
    let mut rest = colors;
    V::for_each_piece(span.varyings, at, pixels, |piece| {
        let (colors, later) =
            mem::take(&mut rest).split_at_mut_checked(piece.pixels).unwrap_or_default();
        let left = later.len();
        whole.draw(piece, colors, left, pixel);
        rest = later;
        left
    });
}

/// Whether every pixel that is nearer stores its depth, so that clear cells can be claimed, and its
/// code is short enough to be there twice.
#[inline(always)]
const fn can_claim<D: DepthFormat, C, O: Outcome<C>>() -> bool {
    D::HAS_CLEAR_CELLS && O::WRITES_DEPTH && !O::DISCARDS && !matches!(O::CODE, CodeSize::Large)
}

/// A span in several pieces.
struct PiecedSpan<'a, 'f, D: DepthFormat, V: Interpolate> {
    cells: &'a mut [D],
    /// The pixels at its end whose cells are not claimed.
    unclaimed: usize,
    span: &'a Span<'f, D, V>,
    /// Of its first pixel.
    place: Place,
}

impl<D: DepthFormat, V: Interpolate> PiecedSpan<'_, '_, D, V> {
    /// Draws the piece before the last `left` pixels.
    #[inline(always)]
    fn draw<C: Copy, O: Outcome<C>>(
        &mut self,
        piece: Piece<V::Walk>,
        colors: &mut [C],
        left: usize,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let start = self.cells.len() - left - colors.len();
        let (run, place) = (self.run(start, piece), self.place.right(start));
        // Without depth there is no test either.
        if size_of::<D>() == 0 || can_claim::<D, C, O>() && left >= self.unclaimed {
            run.draw_claimed(colors, place, pixel);
        } else if can_claim::<D, C, O>() {
            // codegen: a copy, so that the piece is in registers elsewhere.
            let mut piece = piece;
            codegen::in_memory(&mut piece);
            self.draw_partly_claimed(&piece, colors, left, pixel);
        } else if let Some(cells) = self.cells.get_mut(start..start + colors.len()) {
            run.draw_long(colors, cells, place, pixel);
        }
    }

    /// The same for a piece of which not all cells are claimed.
    // codegen: not inlined, because it is rare.
    #[inline(never)]
    fn draw_partly_claimed<C: Copy, O: Outcome<C>>(
        &mut self,
        &piece: &Piece<V::Walk>,
        colors: &mut [C],
        left: usize,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let pixels = colors.len();
        let start = self.cells.len() - left - pixels;
        let (run, place) = (self.run(start, piece), self.place.right(start));
        let claimed = (left + pixels).saturating_sub(self.unclaimed);
        let Some(cells) = self.cells.get_mut(start + claimed..start + pixels) else { return };
        let Some((colors, others)) = colors.split_at_mut_checked(claimed) else { return };
        if claimed != 0 {
            run.draw_claimed(colors, place, pixel);
        }
        run.skip(claimed).draw_long(others, cells, place.right(claimed), pixel);
    }

    /// A piece from this pixel on.
    #[inline(always)]
    fn run(&self, start: usize, piece: Piece<V::Walk>) -> Run<D, V> {
        let &Span { depth, depth_step, .. } = self.span;
        let depth = depth.wrapping_add(depth_step.wrapping_mul(start as i32));
        Run::of(depth, depth_step, piece)
    }
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

    /// Goes on to a later pixel.
    #[inline(always)]
    fn skip(self, pixels: usize) -> Self {
        Self {
            depth: self.depth.wrapping_add(self.depth_step.wrapping_mul(pixels as i32)),
            varyings: self.varyings.wrapping_add(self.varyings_step.wrapping_mul(pixels as i32)),
            ..self
        }
    }

    /// Several pixels at a time, with a test if there is depth.
    #[inline(always)]
    fn draw_long<C: Copy, O: Outcome<C>>(
        self,
        colors: &mut [C],
        cells: &mut [D],
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        if size_of::<D>() == 0 {
            self.draw_claimed(colors, place, pixel);
            return;
        }
        let Self { depth, depth_step, varyings, varyings_step } = self;
        let (depth, varyings) = ((depth, depth_step), (&varyings, &varyings_step));
        Self::draw_tested(depth, varyings, colors, cells, place, pixel);
    }

    /// Several pixels at a time that are tested, but for those at the start whose cells are clear.
    // codegen: not inlined, because it needs all registers. References to what has up to three
    // numbers become arguments for those that are read; one to a run, which has more, would keep it
    // in memory.
    #[inline(never)]
    fn draw_tested<C: Copy, O: Outcome<C>>(
        (depth, depth_step): (D::Walk, D::Walk),
        (&varyings, &varyings_step): (&V::Walk, &V::Walk),
        mut colors: &mut [C],
        mut cells: &mut [D],
        mut place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let mut run = Self { depth, depth_step, varyings, varyings_step };
        let claims = CLAIMS_RUNS && can_claim::<D, C, O>() && cells.len() >= LONG_CLAIM;
        if claims && D::starts_clear(cells) {
            let (depth, varyings) = ((depth, depth_step), (&varyings, &varyings_step));
            let claimed = Self::draw_clear(depth, varyings, colors, cells, place, pixel);
            colors = colors.get_mut(claimed..).unwrap_or_default();
            cells = cells.get_mut(claimed..).unwrap_or_default();
            place = place.right(claimed);
            run = run.skip(claimed);
        }
        run.draw_pairs(colors, cells, place, pixel);
    }

    /// Draws the first pixels of a run, up to the first cell that is not clear. Returns their
    /// number.
    // codegen: cold, so that the loop after it keeps its registers.
    #[cold]
    #[inline(never)]
    fn draw_clear<C: Copy, O: Outcome<C>>(
        (depth, depth_step): (D::Walk, D::Walk),
        (&varyings, &varyings_step): (&V::Walk, &V::Walk),
        colors: &mut [C],
        cells: &mut [D],
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) -> usize {
        let claimed = D::claim(cells, depth, depth_step);
        if let Some(colors) = colors.get_mut(..claimed) {
            let run = Self { depth, depth_step, varyings, varyings_step };
            run.draw_claimed(colors, place, pixel);
        }
        claimed
    }

    /// Several pixels at a time that need no test.
    #[inline(always)]
    fn draw_claimed<C: Copy, O: Outcome<C>>(
        self,
        colors: &mut [C],
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let Self { depth, depth_step, varyings, varyings_step } = self;
        let (depth, varyings) = ((depth, depth_step), (&varyings, &varyings_step));
        Self::draw_untested(depth, varyings, colors, place, pixel);
    }

    /// The same from depth and varyings with their steps.
    // codegen: not inlined, because it needs all registers.
    #[inline(never)]
    fn draw_untested<C: Copy, O: Outcome<C>>(
        (depth, depth_step): (D::Walk, D::Walk),
        (&varyings, &varyings_step): (&V::Walk, &V::Walk),
        colors: &mut [C],
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let run = Self { depth, depth_step, varyings, varyings_step };
        let has_few_registers = size_of::<V::Walk>() > FEW_BYTES;
        if IS_NARROW && !has_few_registers && matches!(O::CODE, CodeSize::Small) {
            run.draw_blocks(colors, place, pixel);
        } else {
            Claimed::cells(colors.len(), |cells| run.draw_pairs(colors, cells, place, pixel));
        }
    }

    /// Two pixels at a time.
    #[inline(always)]
    fn draw_pairs<K: Cell<D>, C: Copy, O: Outcome<C>>(
        mut self,
        colors: &mut [C],
        cells: &mut [K],
        mut place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        // codegen: with one length for both; on a narrow core that costs the loop a register.
        if !(IS_NARROW && size_of::<K>() != 0) && colors.len() != cells.len() {
            return;
        }
        let (color_pairs, last_color) = colors.as_chunks_mut::<2>();
        let (cell_pairs, last_cell) = cells.as_chunks_mut::<2>();
        for (colors, cells) in color_pairs.iter_mut().zip(cell_pairs) {
            codegen::keep_rolled();
            // codegen: a loop over the one pair, without which long pixels lose a register.
            let (colors, cells) = (colors.as_chunks_mut().0, cells.as_chunks_mut().0);
            for ([color, next_color], [cell, next_cell]) in colors.iter_mut().zip(cells) {
                self.draw_pixel(color, cell, place, pixel);
                self.draw_pixel(next_color, next_cell, place.right(1), pixel);
                place = place.right(2);
            }
        }
        for (color, cell) in last_color.iter_mut().zip(last_cell) {
            codegen::keep_rolled();
            self.draw_pixel(color, cell, place, pixel);
            place = place.right(1);
        }
    }

    /// Eight pixels at a time that need no test.
    #[inline(always)]
    fn draw_blocks<C: Copy, O: Outcome<C>>(
        mut self,
        colors: &mut [C],
        mut place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        // codegen: the optimiser computes multiples of the steps for a longer block, and has no
        // registers for them, unless the values at its start have no law that it can see.
        let mut nothing = (D::Walk::ZERO, V::Walk::ZERO);
        codegen::in_memory(&mut nothing);
        let (mut blocks, last) = colors.as_chunks_mut::<8>();
        // codegen: an iterator would be compiled to an address and an index.
        while let Some((block, later)) = mem::take(&mut blocks).split_first_mut() {
            codegen::keep_rolled();
            self.depth = self.depth.wrapping_add(nothing.0);
            self.varyings = self.varyings.wrapping_add(nothing.1);
            for [color, next_color] in block.as_chunks_mut().0 {
                self.draw_pixel(color, &mut Claimed, place, pixel);
                self.draw_pixel(next_color, &mut Claimed, place.right(1), pixel);
                place = place.right(2);
            }
            blocks = later;
        }
        Claimed::cells(last.len(), |cells| self.draw_pairs(last, cells, place, pixel));
    }

    /// Draws the pixel at hand if it is nearer than what is stored, and goes on to the next.
    #[inline(always)]
    fn draw_pixel<C: Copy, O: Outcome<C>>(
        &mut self,
        color: &mut C,
        cell: &mut impl Cell<D>,
        place: Place,
        pixel: impl Fn(C, Fragment<V::Sample>) -> O + Copy,
    ) {
        let here = *self;
        self.step();
        let depth = D::at(here.depth);
        if !cell.is_behind(depth) {
            codegen::unlikely();
            return;
        }
        // codegen: before the shader runs, where nothing can prevent it: one register less.
        if O::WRITES_DEPTH && !O::DISCARDS {
            cell.store(depth);
        }
        if let Some(outcome) = pixel(*color, here.fragment(place)).color() {
            if O::WRITES_DEPTH && O::DISCARDS {
                cell.store(depth);
            }
            *color = outcome;
        }
    }
}
