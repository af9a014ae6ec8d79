//! One point: a square of pixels about a vertex.
//!
//! A point of a size covers the square with sides of that many pixels whose middle is its vertex,
//! and owns the pixels whose centres lie in it; a centre on a side belongs to it if that is the
//! left or the upper one. So it is rasterised by Vulkan ("Basic Point Rasterization") and by
//! Direct3D 10 and later (functional specification 3.4.5: as two triangles, with the top-left
//! rule). It has `size` pixels in each of `size` rows, wherever the vertex lies.

use super::{Layout, Primitive, Span, Window, square::Square};
use crate::{
    attribute::{DepthFormat, Interpolate},
    geometry::ScreenVertex,
    numbers::Subpixel,
};

/// A point on the screen: a square of pixels, in the depth and with the varyings of its vertex.
#[derive(Clone, Copy, Debug)]
pub struct Point<'v, S, D, V> {
    vertex: &'v ScreenVertex<S, D, V>,
    size: i32,
}

impl<'v, S: Subpixel, D: DepthFormat, V: Interpolate> Point<'v, S, D, V> {
    /// One pixel large. Returns `None` if the vertex is not on the screen.
    #[must_use]
    pub fn new(vertex: &'v ScreenVertex<S, D, V>) -> Option<Self> {
        vertex.is_on_screen().then_some(Self { vertex, size: 1 })
    }

    /// At a vertex that is on the screen.
    pub(crate) const fn at(vertex: &'v ScreenVertex<S, D, V>, size: u8) -> Self {
        Self { vertex, size: size as i32 }
    }

    /// The same point in another size: the pixels along a side. A point of size 0 has no pixel.
    #[must_use]
    pub const fn sized(self, size: u8) -> Self {
        Self { size: size as i32, ..self }
    }
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate> Primitive for Point<'_, S, D, V> {
    type Depth = D;
    type Varyings = V;

    fn for_each_span<E>(
        &self,
        window: &Window,
        layout: Layout,
        visit: impl FnMut(&Span<'_, D, V>) -> Result<(), E>,
    ) -> Result<(), E> {
        Square::about(self.vertex, self.size << S::BITS).for_each_span(window, layout, visit)
    }
}
