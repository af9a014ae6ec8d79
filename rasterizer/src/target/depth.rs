//! The depth test.

use core::{iter, slice};

use crate::{
    geometry::{DepthFormat, NoDepth},
    raster::Interpolate,
};

/// The depth of a frame's pixels: `&mut [u16]`, `&mut [u32]`, or [`NoDepth`].
pub trait DepthBuffer {
    /// How a depth is stored.
    type Format: DepthFormat + Interpolate;
    /// The cells of a run of pixels.
    type Cells<'s>: Iterator<Item: DepthCell<Self::Format>>
    where
        Self: 's;

    /// Whether pixels are tested at all.
    const IS_STORED: bool;

    /// Whether there is a cell for each of so many pixels.
    fn holds(&self, pixels: usize) -> bool;

    /// The cells from `start` on, up to `end`; nothing if there are not as many.
    fn cells(&mut self, start: usize, end: usize) -> Option<Self::Cells<'_>>;

    /// Sets all cells to the far end of the range.
    fn clear(&mut self);
}

/// The depth of a pixel.
pub trait DepthCell<D> {
    /// Whether `depth` is nearer than what is stored, which it then replaces. What was drawn first wins a tie.
    fn pass(&mut self, depth: D) -> bool;
}

impl<D: PartialOrd + Copy> DepthCell<D> for &mut D {
    #[inline(always)]
    fn pass(&mut self, depth: D) -> bool {
        let nearer = depth > **self;
        if nearer {
            **self = depth;
        }
        nearer
    }
}

impl DepthCell<Self> for NoDepth {
    #[inline(always)]
    fn pass(&mut self, _: Self) -> bool {
        true
    }
}

impl<D: DepthFormat + Interpolate + PartialOrd + 'static> DepthBuffer for &mut [D] {
    type Format = D;
    type Cells<'s>
        = slice::IterMut<'s, D>
    where
        Self: 's;

    const IS_STORED: bool = true;

    fn holds(&self, pixels: usize) -> bool {
        self.len() == pixels
    }

    #[inline(always)]
    fn cells(&mut self, start: usize, end: usize) -> Option<Self::Cells<'_>> {
        self.get_mut(start..end).map(<[D]>::iter_mut)
    }

    fn clear(&mut self) {
        set_all(self, D::ZERO);
    }
}

/// Sets all elements of a slice, at one instruction for each. A function of its own: inlined into a large one it takes
/// three times as long on the M0+.
#[inline(never)]
pub(super) fn set_all<T: Copy>(elements: &mut [T], value: T) {
    // Known to be zero it would become a call of `memset`, which on a microcontroller takes two.
    let value = core::hint::black_box(value);
    // Shorter runs are repeated by the compiler until they take twice the flash.
    let (runs, rest) = elements.as_chunks_mut::<64>();
    for run in runs {
        run.iter_mut().for_each(|element| *element = value);
    }
    for element in rest {
        // As above, lest the compiler make a case of each length.
        *element = core::hint::black_box(value);
    }
}

impl DepthBuffer for NoDepth {
    type Format = Self;
    type Cells<'s> = iter::Repeat<Self>;

    const IS_STORED: bool = false;

    fn holds(&self, _: usize) -> bool {
        true
    }

    #[inline(always)]
    fn cells(&mut self, _: usize, _: usize) -> Option<Self::Cells<'_>> {
        Some(iter::repeat(Self))
    }

    fn clear(&mut self) {}
}
