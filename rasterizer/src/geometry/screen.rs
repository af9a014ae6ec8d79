//! Vertices on the screen.

use core::marker::PhantomData;

use crate::{
    attribute::{DepthFormat, Interpolate},
    numbers::Subpixel,
};

/// The guard band reaches 2<sup>10</sup> pixels to each side of the viewport's middle.
pub(crate) const GUARD_BITS: u32 = 10;

/// A vertex on the screen, with sub-pixel bits `S`, depth `D` and varyings `V`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ScreenVertex<S, D, V> {
    /// To the right from the display's left edge, in sub-pixels.
    pub(crate) x: i32,
    /// Downwards from the display's upper edge, in sub-pixels.
    pub(crate) y: i32,
    pub(crate) depth: D,
    pub(crate) varyings: V,
    precision: PhantomData<S>,
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate> ScreenVertex<S, D, V> {
    /// The initial content of storage. All its bits are 0, so that storage in a `static` takes no
    /// flash.
    pub const EMPTY: Self = Self::new(0, 0, D::ZERO, V::ZERO);

    /// A vertex outside near plane, far plane or guard band.
    pub(crate) const fn off_screen(varyings: V) -> Self {
        Self::new(i32::MIN, 0, D::ZERO, varyings)
    }

    /// From its coordinates in sub-pixels from the display's top-left corner. Returns `None` unless
    /// they lie within -1,024 <= x, y < 1,024 pixels: a [`Triangle`](crate::raster::Triangle) of
    /// such vertices is exact.
    ///
    /// So is one of vertices that lie as near to another point, such as those of an object, which
    /// are within 1,024 pixels of their viewport's middle; this does not take them.
    #[must_use]
    pub const fn checked(x: i32, y: i32, depth: D, varyings: V) -> Option<Self> {
        let limit = 1 << (GUARD_BITS + S::BITS);
        if -limit <= x && x < limit && -limit <= y && y < limit {
            Some(Self::new(x, y, depth, varyings))
        } else {
            None
        }
    }

    /// This vertex as a corner, 0 to 2, of one of its triangles.
    #[inline(always)]
    pub(crate) fn at(&self, corner: usize) -> Self {
        Self::new(self.x, self.y, self.depth, self.varyings.at_corner(corner))
    }

    /// This vertex without varyings.
    #[inline(always)]
    pub(crate) const fn bare(&self) -> ScreenVertex<S, D, [u16; 0]> {
        ScreenVertex::new(self.x, self.y, self.depth, [])
    }

    /// From its coordinates in sub-pixels.
    #[inline(always)]
    pub(crate) const fn new(x: i32, y: i32, depth: D, varyings: V) -> Self {
        Self { x, y, depth, varyings, precision: PhantomData }
    }

    /// Whether it lies within near plane, far plane and guard band.
    #[inline(always)]
    pub(crate) const fn is_on_screen(&self) -> bool {
        self.x != i32::MIN
    }

    /// Its coordinates in sub-pixels; `None` outside near plane, far plane or guard band.
    #[must_use]
    pub const fn position(&self) -> Option<[i32; 2]> {
        if self.is_on_screen() { Some([self.x, self.y]) } else { None }
    }

    /// Its depth.
    #[must_use]
    pub const fn depth(&self) -> D {
        self.depth
    }

    /// Its varyings.
    #[must_use]
    pub const fn varyings(&self) -> V {
        self.varyings
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        attribute::NoDepth,
        numbers::{S4, S8},
    };

    #[test]
    fn vertices_are_small() {
        assert_eq!(size_of::<ScreenVertex<S4, NoDepth, [u16; 0]>>(), 8);
        assert_eq!(size_of::<ScreenVertex<S8, u16, [u16; 1]>>(), 12);
        assert_eq!(size_of::<ScreenVertex<S8, u32, [u16; 1]>>(), 16);
    }
}
