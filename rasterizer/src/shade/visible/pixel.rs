//! The pixels of a visibility buffer.

use crate::output::{PixelFill, StoredColor};

/// The object and the triangle that are seen at a pixel. 4 bytes.
///
/// A [`Frame`](crate::output::Frame) of these is drawn by
/// [`Visibility::without_weights`](super::Visibility::without_weights), and cleared to
/// [`NONE`](Self::NONE).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VisibleTriangle {
    /// The object in the upper 8 bits, the triangle in the others.
    id: u32,
}

/// The bits of a triangle's number.
const TRIANGLE_BITS: u32 = 24;

impl VisibleTriangle {
    /// The background.
    pub const NONE: Self = Self { id: u32::MAX };

    /// A triangle of an object.
    pub(super) const fn new(object: u8, triangle: usize) -> Self {
        let triangle = triangle as u32 & ((1 << TRIANGLE_BITS) - 1);
        Self { id: (object as u32) << TRIANGLE_BITS | triangle }
    }

    /// The object's number; `None` for the background.
    #[must_use]
    pub const fn object(self) -> Option<u8> {
        if self.id == u32::MAX { None } else { Some((self.id >> TRIANGLE_BITS) as u8) }
    }

    /// The triangle's place in the mesh's table, clipped or not; that of a mesh of more than
    /// 2<sup>24</sup> triangles, modulo that number.
    #[must_use]
    pub const fn triangle(self) -> usize {
        (self.id & ((1 << TRIANGLE_BITS) - 1)) as usize
    }
}

/// The background.
impl Default for VisibleTriangle {
    fn default() -> Self {
        Self::NONE
    }
}

impl StoredColor for VisibleTriangle {
    type Fill = PixelFill<Self>;
}

/// What is seen at a pixel of a visibility buffer (Burns and Hunt, *The Visibility Buffer*, JCGT
/// 2(2), 2013): an object, one of its triangles, and a place in it. 8 bytes.
///
/// A [`Frame`](crate::output::Frame) of these is drawn by [`Visibility`](super::Visibility), and
/// cleared to [`NONE`](Self::NONE).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VisiblePixel {
    seen: VisibleTriangle,
    weights: [u16; 2],
}

impl VisiblePixel {
    /// The background.
    pub const NONE: Self = Self::new(VisibleTriangle::NONE, [0; 2]);

    /// A place in a triangle, by the weights of its first two corners.
    pub(super) const fn new(seen: VisibleTriangle, weights: [u16; 2]) -> Self {
        Self { seen, weights }
    }

    /// The object's number; `None` for the background.
    #[must_use]
    pub const fn object(self) -> Option<u8> {
        self.seen.object()
    }

    /// The triangle's place in the mesh's table, clipped or not; that of a mesh of more than
    /// 2<sup>24</sup> triangles, modulo that number.
    #[must_use]
    pub const fn triangle(self) -> usize {
        self.seen.triangle()
    }

    /// The barycentric coordinates in the mesh's triangle: how much of its three corners, in Q0.16,
    /// where 65,535 stands for 1. The first two are rounded to the nearest unit, the third is what
    /// they leave of 65,535.
    #[must_use]
    pub const fn weights(self) -> [u16; 3] {
        let [first, second] = self.weights;
        [first, second, u16::MAX.saturating_sub(first).saturating_sub(second)]
    }
}

/// The background.
impl Default for VisiblePixel {
    fn default() -> Self {
        Self::NONE
    }
}

impl StoredColor for VisiblePixel {
    type Fill = PixelFill<Self>;
}

/// A pixel of a visibility buffer: [`VisibleTriangle`] or [`VisiblePixel`].
pub trait Visible: Copy + sealed::Visible {}

impl Visible for VisibleTriangle {}
impl Visible for VisiblePixel {}

pub(super) mod sealed {
    use super::{VisiblePixel, VisibleTriangle};

    pub trait Visible {
        /// Without the place in the triangle.
        fn seen(self) -> VisibleTriangle;
    }

    impl Visible for VisibleTriangle {
        #[inline(always)]
        fn seen(self) -> VisibleTriangle {
            self
        }
    }

    impl Visible for VisiblePixel {
        #[inline(always)]
        fn seen(self) -> VisibleTriangle {
            self.seen
        }
    }
}
