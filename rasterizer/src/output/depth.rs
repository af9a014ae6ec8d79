//! The depth of a frame's pixels.

use crate::{
    attribute::{DepthFormat, FloatDepth, NoDepth},
    numbers::codegen,
};

/// The depth of a frame's pixels: `&mut [u16]`, `&mut [FloatDepth]`, `&mut [u32]`, or [`NoDepth`].
pub trait DepthBuffer: Cells {}

/// A format of depth that a frame can have: `u16`, [`FloatDepth`], `u32`, or [`NoDepth`].
pub trait FrameDepth: DepthFormat + 'static {
    /// What keeps a depth for each pixel.
    type Buffer<'b>: DepthBuffer<Format = Self>;
}

/// A format of depth that a buffer can keep: `u16`, [`FloatDepth`] or `u32`. The depth of 0 has no
/// bit set.
pub trait StoredDepth: bytemuck::Pod + for<'b> FrameDepth<Buffer<'b> = &'b mut [Self]> {}

impl StoredDepth for u16 {}
impl StoredDepth for FloatDepth {}
impl StoredDepth for u32 {}

impl<D: StoredDepth> DepthBuffer for &mut [D] {}
impl DepthBuffer for NoDepth {}

mod private {
    use super::{FrameDepth, Lent};

    /// A cell for each pixel.
    pub trait Cells {
        /// How a depth is stored.
        type Format: FrameDepth;

        /// Whether pixels are tested at all.
        const IS_STORED: bool;

        /// Whether there are exactly `count` cells.
        fn is_of(&self, count: usize) -> bool;

        /// Whether there are at least `count` cells.
        fn holds(&self, count: usize) -> bool;

        /// Lends the first `count` cells, or all if there are fewer.
        fn lend(&mut self, count: usize) -> Lent<'_, Self>;

        /// Sets all cells to the far end of the range.
        fn clear(&mut self);

        /// Sets some cells to the far end of the range.
        fn clear_part(&mut self, cells: core::ops::Range<usize>);

        /// Calls `visit` with all cells.
        fn with<R>(&mut self, visit: impl FnOnce(&mut [Self::Format]) -> R) -> R;
    }
}

pub(super) use private::Cells;

/// Cells that are lent for a time.
pub(super) type Lent<'l, B> = <<B as Cells>::Format as FrameDepth>::Buffer<'l>;

impl FrameDepth for u16 {
    type Buffer<'b> = &'b mut [Self];
}

impl FrameDepth for FloatDepth {
    type Buffer<'b> = &'b mut [Self];
}

impl FrameDepth for u32 {
    type Buffer<'b> = &'b mut [Self];
}

impl FrameDepth for NoDepth {
    type Buffer<'b> = Self;
}

impl<D: StoredDepth> Cells for &mut [D] {
    type Format = D;

    const IS_STORED: bool = true;

    #[inline(always)]
    fn is_of(&self, count: usize) -> bool {
        self.len() == count
    }

    #[inline(always)]
    fn holds(&self, count: usize) -> bool {
        self.len() >= count
    }

    #[inline(always)]
    fn lend(&mut self, count: usize) -> &mut [D] {
        let count = count.min(self.len());
        self.get_mut(..count).unwrap_or_default()
    }

    fn clear(&mut self) {
        // All bits of a zero are 0, in words of any size.
        let (start, words, end) = bytemuck::pod_align_to_mut::<D, u32>(self);
        clear_words(words);
        // Half a word at each end at most.
        if let Some(cell) = start.first_mut() {
            *cell = D::ZERO;
        }
        if let Some(cell) = end.first_mut() {
            *cell = D::ZERO;
        }
    }

    fn clear_part(&mut self, cells: core::ops::Range<usize>) {
        self.get_mut(cells).unwrap_or_default().clear();
    }

    #[inline(always)]
    fn with<R>(&mut self, visit: impl FnOnce(&mut [D]) -> R) -> R {
        visit(self)
    }
}

/// Sets words to zero, at one instruction for each.
// codegen: not inlined. In a large function it takes three times as long on the M0+.
#[inline(never)]
fn clear_words(words: &mut [u32]) {
    // Opaque, or the loops are unrolled for a buffer whose place and length are constants.
    let (words, zero) = (codegen::unknown(words), codegen::unknown(0));
    // Shorter runs are repeated by the compiler until they take twice the flash.
    let (runs, rest) = words.as_chunks_mut::<64>();
    for run in runs {
        codegen::keep_rolled();
        run.iter_mut().for_each(|word| {
            *word = zero;
            codegen::keep_apart();
        });
    }
    // Of unknown length, or the compiler makes a case of each.
    for word in codegen::unknown(rest) {
        codegen::keep_rolled();
        *word = zero;
    }
}

impl Cells for NoDepth {
    type Format = Self;

    const IS_STORED: bool = false;

    fn is_of(&self, _: usize) -> bool {
        true
    }

    fn holds(&self, _: usize) -> bool {
        true
    }

    fn lend(&mut self, _: usize) -> Self {
        Self
    }

    fn clear(&mut self) {}

    fn clear_part(&mut self, _: core::ops::Range<usize>) {}

    /// Its cells have no size, so that there are enough of them for any frame.
    #[inline(always)]
    fn with<R>(&mut self, visit: impl FnOnce(&mut [Self]) -> R) -> R {
        visit(&mut [Self; isize::MAX as usize])
    }
}
