//! The triangles of an object from the farthest to the nearest.

use core::{convert::Infallible, iter::Copied, ops::Range, slice};

use super::{
    MeshOrder, Mode, Order, ProjectError, Projected, Vertices,
    order::Sequence,
    seen::{CoordinateOf, Rows},
    sort::{Distances, Members, Packing, sort},
};
use crate::{
    geometry::Projection,
    mesh::{Material, Tables},
    raster::Window,
    shade::{OnScreen, Shader},
};

/// The triangles of an object that are seen, from back to front: what
/// [`Projected::back_to_front`] makes.
#[derive(Clone, Copy, Debug)]
pub struct BackToFront<'b> {
    pub(super) words: &'b [u32],
    pub(super) packing: Packing,
    /// The number of its mesh's first triangle.
    pub(super) first: usize,
}

impl<'a, V, P, Sh, M> Projected<'a, V, P, Sh, M>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    /// Sorts the triangles that are seen, of all materials, by the distance of their middles along
    /// the camera's axis: the farthest is drawn first. Of equal distances, the first in the mesh
    /// is.
    ///
    /// It takes a word of `storage` for each triangle of the mesh
    /// ([`Needs::sort_words`](super::Needs::sort_words)), and is done once for all targets, such as
    /// the bands of a frame.
    ///
    /// For an object that is [blended](crate::output::Over) with itself, and without a depth
    /// buffer. A single key cannot order all triangles: of two that cross, each hides a part of the
    /// other; three may hide each other in a circle; and a large triangle may have its middle
    /// nearer than a small one that lies before it. Small triangles of one size, as curved surfaces
    /// have, keep such faults to a few pixels. The parts of the mesh that must be right can be
    /// objects that are drawn in their order.
    ///
    /// Where materials take turns, [`Shader::surface`] is called each time.
    ///
    /// # Errors
    ///
    /// If the storage is too small.
    pub fn back_to_front<'b>(
        self,
        storage: &'b mut [u32],
    ) -> Result<Projected<'a, V, P, Sh, M, BackToFront<'b>>, ProjectError> {
        let order = BackToFront::sorted(&&self, storage)?;
        Ok(Projected { seen: self.seen, order })
    }
}

impl<'b> BackToFront<'b> {
    /// Sorts the triangles that are seen of some objects.
    #[inline(always)]
    pub(super) fn sorted(
        objects: &impl Members,
        storage: &'b mut [u32],
    ) -> Result<Self, ProjectError> {
        let needed = objects.triangle_count();
        let words = storage.get_mut(..needed).ok_or(ProjectError::SortStorage { needed })?;
        let packing = Packing::new(objects.distances(), needed);
        let count = objects.write_words(words, packing, 0);
        let words = words.get_mut(..count).unwrap_or_default();
        sort(words);
        Ok(Self { words, packing, first: 0 })
    }

    /// The places of the triangles in the mesh's table, from back to front.
    pub fn triangles(&self) -> impl Iterator<Item = usize> {
        self.words.iter().map(|&word| self.number(word))
    }

    /// The same triangles of a mesh whose first one has the number `first`.
    pub(super) const fn of_mesh_from(self, first: usize) -> Self {
        Self { first, ..self }
    }

    /// Whether the first triangle is one of the mesh.
    pub(super) fn starts_within(&self, triangle_count: usize) -> bool {
        self.words.first().is_some_and(|&word| self.number(word) < triangle_count)
    }

    /// Divides it before the first triangle of another mesh.
    pub(super) fn split_at_object(self, triangle_count: usize) -> (Self, Self) {
        let is_other = |&word: &u32| self.number(word) >= triangle_count;
        let count = self.words.iter().position(is_other).unwrap_or(self.words.len());
        let (own, others) = self.words.split_at_checked(count).unwrap_or((self.words, &[]));
        (Self { words: own, ..self }, Self { words: others, ..self })
    }

    /// The place of a word's triangle in the mesh's table.
    #[inline(always)]
    const fn number(&self, word: u32) -> usize {
        self.packing.number(word).wrapping_sub(self.first)
    }
}

/// One object.
impl<V, P, Sh, M> Members for &Projected<'_, V, P, Sh, M>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    const COUNT: usize = 1;

    fn triangle_count(&self) -> usize {
        self.seen.triangle_count()
    }

    fn distances(&self) -> Distances {
        let seen = &self.seen;
        if seen.is_outside_view {
            return Distances::NONE;
        }
        Distances::between(seen.transform.distances(seen.mesh), seen.transform.unit())
    }

    fn write_words(&self, words: &mut [u32], packing: Packing, first: usize) -> usize {
        let seen = &self.seen;
        let zero = seen.transform.distance_zero::<CoordinateOf<V, Sh>>(seen.mesh);
        let packing = packing.of_object(self.distances(), zero);
        let (mut count, mut last) = (0, usize::MAX);
        let all = (&MeshOrder, &(), 0..seen.triangle_count());
        let rows = Rows::of::<V::Subpixel>(&seen.viewport);
        let mut lookup = seen.vertices.lookup();
        let Ok(()) = seen.for_each_visible(all, rows, &mut lookup, |number, _, _| {
            // The parts of one that is clipped come one after the other.
            if number != last {
                last = number;
                if let Some(word) = words.get_mut(count) {
                    *word = packing.word(seen.distance(number), first + number);
                    count += 1;
                }
            }
            Ok::<(), Infallible>(())
        });
        count
    }

    fn locate(&self, number: usize) -> (usize, usize) {
        (0, number)
    }
}

impl<V, P: Projection, Sh: Shader, M> Projected<'_, V, P, Sh, M, BackToFront<'_>> {
    /// The order of its triangles.
    #[must_use]
    pub const fn order(&self) -> &BackToFront<'_> {
        &self.order
    }
}

impl Order for BackToFront<'_> {}

impl<'b> Sequence for BackToFront<'b> {
    type Reach = ();
    type Indices<'s>
        = Numbers<'b>
    where
        Self: 's;

    #[inline(always)]
    fn reach(&self, _: &Window, _: &Window) {}

    /// Neighbours in the order that have one material are a run.
    #[inline(always)]
    fn for_each_run<E>(
        &self,
        tables: &Tables<'_>,
        mut visit: impl FnMut((usize, &Material), Range<usize>) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut rest = self.words;
        let mut first = 0;
        while let Some(&word) = rest.first() {
            let (material, triangles) = material_of(tables, self.number(word));
            let is_other = |&word: &u32| !triangles.contains(&self.number(word));
            let count = rest.iter().position(is_other).unwrap_or(rest.len());
            if let Some(of_table) = tables.materials.get(material) {
                visit((material, of_table), first..first + count)?;
            }
            rest = rest.get(count..).unwrap_or_default();
            first += count;
        }
        Ok(())
    }

    #[inline(always)]
    fn indices(&self, run: Range<usize>, (): &()) -> Numbers<'b> {
        let words = self.words.get(run).unwrap_or_default();
        Numbers { words: words.iter().copied(), order: *self }
    }
}

/// The material of a triangle, and the triangles that have it.
// codegen: not inlined, because the loop over triangles needs its registers.
#[inline(never)]
fn material_of(tables: &Tables<'_>, triangle: usize) -> (usize, Range<usize>) {
    let mut triangles = 0..0;
    for (index, material) in tables.materials.iter().enumerate() {
        triangles = triangles.end..triangles.end + material.triangle_count as usize;
        if triangle < triangles.end {
            return (index, triangles);
        }
    }
    // Each triangle has a material: the numbers come from the table of triangles.
    (0, triangle..triangle + 1)
}

/// The numbers of some triangles in their order.
#[derive(Clone, Debug)]
pub struct Numbers<'b> {
    words: Copied<slice::Iter<'b, u32>>,
    order: BackToFront<'b>,
}

impl Iterator for Numbers<'_> {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        self.words.next().map(|word| self.order.number(word))
    }
}
