//! Where a pixel's depth is tested and stored.

use crate::attribute::DepthFormat;

/// The cell of a pixel, or [`Claimed`].
pub(super) trait Cell<D: DepthFormat> {
    /// Whether a depth is nearer than what is stored.
    fn is_behind(&self, depth: D) -> bool;

    /// Stores a depth.
    fn store(&mut self, depth: D);
}

impl<D: DepthFormat> Cell<D> for D {
    #[inline(always)]
    fn is_behind(&self, depth: D) -> bool {
        depth.is_nearer(*self)
    }

    #[inline(always)]
    fn store(&mut self, depth: D) {
        *self = depth;
    }
}

/// A cell that has the pixel's depth already.
#[derive(Clone, Copy, Debug)]
pub(super) struct Claimed;

impl Claimed {
    /// Calls `visit` with `count` of them, which take no memory.
    #[inline(always)]
    pub(super) fn cells(count: usize, visit: impl FnOnce(&mut [Self])) {
        visit([Self; isize::MAX as usize].get_mut(..count).unwrap_or_default());
    }
}

impl<D: DepthFormat> Cell<D> for Claimed {
    #[inline(always)]
    fn is_behind(&self, _: D) -> bool {
        true
    }

    #[inline(always)]
    fn store(&mut self, _: D) {}
}
