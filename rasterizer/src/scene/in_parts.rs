//! The parts of a mesh from back to front: no depth, and no sorting of triangles.

use core::ops::Range;

use super::{
    Bins, MeshOrder, Mode, Order, Projected, Vertices,
    order::{Sequence, for_each_material},
    seen::CoordinateOf,
};
use crate::{
    geometry::{Change as _, Projection},
    mesh::{Material, Parts, Tables},
    raster::Window,
    shade::{OnScreen, Shader},
};

/// An order that visits triangles as they stand in the mesh's table: [`MeshOrder`] or [`Bins`].
pub trait TableOrder: Order {}

impl TableOrder for MeshOrder {}
impl TableOrder for Bins<'_> {}

/// The parts of a mesh from back to front, each in the order of the table: what
/// [`Projected::in_parts`] makes.
#[derive(Clone, Copy, Debug)]
pub struct InParts<'p, O> {
    parts: Parts<'p>,
    /// The parts from back to front, as many as there are.
    order: [u8; Parts::MOST],
    within: O,
}

impl<'a, V, P, Sh, M, O> Projected<'a, V, P, Sh, M, O>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
    O: TableOrder,
{
    /// Draws the parts of the mesh from back to front: of two parts that a plane keeps apart, the
    /// one on the viewer's side cannot be hidden by the other. That is found out once for all
    /// targets, by one determinant for each plane.
    ///
    /// Right without depth from wherever the mesh is seen if that is so for each part alone: if a
    /// part is convex, or its triangles stand in an order in which those in front come last, with
    /// back faces culled. What keeps the parts of a mesh apart must do so in the shape in which it
    /// is drawn: a [matrix](super::Object::shaped) that has an inverse leaves it so, keyframes may
    /// not.
    ///
    /// Where a part begins within a material, [`Shader::surface`] is called again.
    #[must_use]
    pub fn in_parts<'p>(self, parts: &Parts<'p>) -> Projected<'a, V, P, Sh, M, InParts<'p, O>> {
        let seen = &self.seen;
        let is_mirrored = seen.mode.shape().is_mirrored();
        let order = parts.back_to_front(|plane| {
            seen.transform.is_in_front_of::<CoordinateOf<V, Sh>>(plane.points()) != is_mirrored
        });
        let order = InParts { parts: *parts, order, within: self.order };
        Projected { seen: self.seen, order }
    }
}

impl<V, P: Projection, Sh: Shader, M, O> Projected<'_, V, P, Sh, M, InParts<'_, O>> {
    /// Its order.
    #[must_use]
    pub const fn order(&self) -> &InParts<'_, O> {
        &self.order
    }
}

impl<O> InParts<'_, O> {
    /// The parts from back to front.
    pub fn parts(&self) -> impl Iterator<Item = usize> {
        self.order.iter().take(self.parts.count()).map(|&part| usize::from(part))
    }
}

impl<O: TableOrder> Order for InParts<'_, O> {}

impl<O: TableOrder> Sequence for InParts<'_, O> {
    type Reach = O::Reach;
    type Indices<'s>
        = O::Indices<'s>
    where
        Self: 's;

    #[inline(always)]
    fn reach(&self, window: &Window, viewport: &Window) -> O::Reach {
        self.within.reach(window, viewport)
    }

    // codegen: not inlined, or its two loops take registers of what the caller does for each pixel.
    #[inline(never)]
    fn for_each_run<E>(
        &self,
        tables: &Tables<'_>,
        mut visit: impl FnMut((usize, &Material), Range<usize>) -> Result<(), E>,
    ) -> Result<(), E> {
        for part in self.parts() {
            let part = self.parts.triangles(part);
            for_each_material(tables, |material, run| {
                let run = run.start.max(part.start)..run.end.min(part.end);
                if run.is_empty() { Ok(()) } else { visit(material, run) }
            })?;
        }
        Ok(())
    }

    #[inline(always)]
    fn indices(&self, run: Range<usize>, reach: &O::Reach) -> O::Indices<'_> {
        self.within.indices(run, reach)
    }
}
