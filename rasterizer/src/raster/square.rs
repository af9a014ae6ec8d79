//! A square of any size about a vertex.

use super::{Layout, Primitive, Span, Triangle, Window, first_center, signed_area};
use crate::{
    attribute::{DepthFormat, Interpolate},
    geometry::ScreenVertex,
    numbers::Subpixel,
};

/// A square on the screen, with upright sides, in the depth and with the varyings of the vertex in
/// its middle. It owns the pixels whose centres lie in it; a centre on a side belongs to it if that
/// is the left or the upper one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Square<'v, S, D, V> {
    vertex: &'v ScreenVertex<S, D, V>,
    /// The length of a side, in sub-pixels.
    side: i32,
}

impl<'v, S: Subpixel, D: DepthFormat, V: Interpolate> Square<'v, S, D, V> {
    /// About a vertex that is on the screen. Of a side with an odd number of sub-pixels, the right
    /// and the lower half have one more.
    #[inline(always)]
    pub(crate) const fn about(vertex: &'v ScreenVertex<S, D, V>, side: i32) -> Self {
        Self { vertex, side }
    }

    /// Its pixels, also those outside all windows.
    #[inline(always)]
    pub(crate) fn pixels(&self) -> Window {
        let pixels = |middle: i32| {
            let start = middle - (self.side >> 1);
            [start, start + self.side].map(first_center::<S>)
        };
        let ([left, right], [top, bottom]) = (pixels(self.vertex.x), pixels(self.vertex.y));
        Window { left, top, right, bottom }
    }

    /// Depth and varyings, which are the same at all pixels: those of a triangle whose corners have
    /// the same.
    fn fields(&self, layout: Layout) -> (D::Field, V::Field) {
        let &ScreenVertex { x, y, depth, varyings, .. } = self.vertex;
        let pixel = 1 << S::BITS;
        let right = ScreenVertex::new(x + pixel, y, depth, varyings);
        let below = ScreenVertex::new(x, y + pixel, depth, varyings);
        let corners = [self.vertex, &right, &below];
        Triangle::with_area(corners, signed_area(corners)).fields(layout)
    }
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate> Primitive for Square<'_, S, D, V> {
    type Depth = D;
    type Varyings = V;

    #[inline(always)]
    fn for_each_span<E>(
        &self,
        window: &Window,
        layout: Layout,
        mut visit: impl FnMut(&Span<'_, D, V>) -> Result<(), E>,
    ) -> Result<(), E> {
        let covered = self.pixels().intersection(window);
        if covered.is_empty() {
            return Ok(());
        }
        let (depth, varyings) = self.fields(layout);
        for row in covered.top..covered.bottom {
            let address = layout.row_address(row);
            let start = address.wrapping_add(covered.left);
            visit(&Span {
                row,
                start: start as usize,
                end: address.wrapping_add(covered.right) as usize,
                depth: depth.at(start, row),
                depth_step: depth.per_column,
                varyings: &varyings,
            })?;
        }
        Ok(())
    }
}
