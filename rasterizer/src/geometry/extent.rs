//! The rows of pixels that a box may reach.

use super::{ClipVertex, Projection, ScreenVertex, Transform};
use crate::{
    attribute::NoDepth,
    mesh::BoundingBox,
    numbers::{Subpixel, codegen},
    raster::Window,
};

/// A corner is placed within a sub-pixel, and so are the vertices in the box: together less than a
/// pixel.
const MARGIN: i32 = 1;

impl<P: Projection> Transform<P> {
    /// The first row that a box in a viewport may reach, and the one after the last: all of them if
    /// a corner lies beyond the near plane, the far plane or the guard band, because there it is
    /// not known where the box ends on the screen.
    ///
    /// A box before the eye is seen as the convex hull of its corners, and so is all that is in it.
    // codegen: not inlined, or the corners would be on the stack while triangles are drawn.
    #[inline(never)]
    pub(crate) fn rows_of<S: Subpixel>(&self, cuboid: &BoundingBox, viewport: &Window) -> [i32; 2] {
        let (mut top, mut bottom) = (viewport.bottom, viewport.top);
        for index in 0..codegen::unknown(8) {
            let [x, y, z] = self.object_to_clip_outlined::<S::Coordinate>(cuboid.corner(index));
            let corner = ClipVertex { x, y, z, varyings: [0u16; 0] };
            let corner: ScreenVertex<S, NoDepth, _> = self.clip_to_screen(corner);
            let Some([_, y]) = corner.position() else {
                return [viewport.top, viewport.bottom];
            };
            let row = y >> S::BITS;
            top = top.min(row - MARGIN);
            bottom = bottom.max(row + MARGIN + 1);
        }
        [top.max(viewport.top), bottom.min(viewport.bottom)]
    }
}
