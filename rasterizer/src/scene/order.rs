//! The order in which an object's triangles are drawn.

use core::ops::Range;

use crate::{
    mesh::{Material, Tables},
    raster::Window,
};

/// The order of an object's triangles: [`MeshOrder`], [`Bins`](super::Bins) that leave out those
/// that miss a band, both of them [`InParts`](super::InParts), or
/// [`BackToFront`](super::BackToFront).
pub trait Order: Copy + Sequence {}

mod private {
    use core::ops::Range;

    use super::{Material, Tables, Window, for_each_material};

    /// A sequence of triangles.
    pub trait Sequence {
        /// The part of it that may reach a window.
        type Reach;
        /// The triangles of a run, by their places in the mesh's table.
        type Indices<'s>: Iterator<Item = usize>
        where
            Self: 's;

        /// The part that may reach a window of the viewport.
        fn reach(&self, window: &Window, viewport: &Window) -> Self::Reach;

        /// Visits the runs of triangles of one material, with its place in the table and the
        /// triangles' places in the sequence.
        #[inline(always)]
        fn for_each_run<E>(
            &self,
            tables: &Tables<'_>,
            visit: impl FnMut((usize, &Material), Range<usize>) -> Result<(), E>,
        ) -> Result<(), E> {
            for_each_material(tables, visit)
        }

        /// The triangles of a run that may reach the window.
        fn indices(&self, run: Range<usize>, reach: &Self::Reach) -> Self::Indices<'_>;
    }
}

pub(super) use private::Sequence;

/// The order of the mesh's table, all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct MeshOrder;

impl Order for MeshOrder {}

impl Sequence for MeshOrder {
    type Reach = ();
    type Indices<'s> = Range<usize>;

    #[inline(always)]
    fn reach(&self, _: &Window, _: &Window) {}

    #[inline(always)]
    fn indices(&self, run: Range<usize>, (): &()) -> Range<usize> {
        run
    }
}

/// Visits the materials with the triangles that each covers.
#[inline(always)]
pub(super) fn for_each_material<E>(
    tables: &Tables<'_>,
    mut visit: impl FnMut((usize, &Material), Range<usize>) -> Result<(), E>,
) -> Result<(), E> {
    let mut first = 0;
    for (index, material) in tables.materials.iter().enumerate() {
        let end = first + material.triangle_count as usize;
        visit((index, material), first..end)?;
        first = end;
    }
    Ok(())
}
