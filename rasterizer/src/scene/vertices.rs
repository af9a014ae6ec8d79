//! Where the vertices of triangles come from: storage that is filled once, or projection on demand.

use core::marker::PhantomData;

use crate::{
    attribute::{DepthFormat, Interpolate},
    geometry::ScreenVertex,
    numbers::Subpixel,
};

/// A source of vertices on the screen with varyings `V`: a slice of them, or [`OnDemand`].
pub trait Vertices<V>: Copy + private::Sealed {
    /// How finely they are placed.
    type Subpixel: Subpixel;
    /// How their depth is kept.
    type Depth: DepthFormat;
    /// What finds them while triangles are visited.
    type Lookup: Lookup<Self::Subpixel, Self::Depth, V>;

    /// Begins a pass over triangles.
    fn lookup(self) -> Self::Lookup;
}

mod private {
    pub trait Sealed {}
    impl<T> Sealed for &[T] {}
    impl<S, D, const N: usize> Sealed for super::OnDemand<S, D, N> {}
}

/// Finds the vertices of triangles.
pub trait Lookup<S, D, V> {
    /// Returns the three vertices of these indices, or `None` if one does not exist. `place`
    /// projects a vertex.
    fn corners(
        &mut self,
        indices: [usize; 3],
        place: impl Fn(usize) -> ScreenVertex<S, D, V>,
    ) -> Option<[&ScreenVertex<S, D, V>; 3]>;
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate> Vertices<V> for &[ScreenVertex<S, D, V>] {
    type Subpixel = S;
    type Depth = D;
    type Lookup = Self;

    #[inline(always)]
    fn lookup(self) -> Self {
        self
    }
}

impl<S, D, V> Lookup<S, D, V> for &[ScreenVertex<S, D, V>] {
    #[inline(always)]
    fn corners(
        &mut self,
        [a, b, c]: [usize; 3],
        _: impl Fn(usize) -> ScreenVertex<S, D, V>,
    ) -> Option<[&ScreenVertex<S, D, V>; 3]> {
        Some([self.get(a)?, self.get(b)?, self.get(c)?])
    }
}

/// No storage: a vertex is projected when a triangle needs it, and `N` recent ones are kept on the
/// stack while an object is drawn, 16 bytes each with 16-bit depth and one varying.
///
/// The converter orders triangles so that their vertices come up again soon. How often a vertex is
/// projected on average when the bundled models are drawn once:
///
/// | `N` | 0 | 8 | 16 | 32 |
/// |---|---|---|---|---|
/// | gear | 2.9 | 1.0 | 1.0 | 1.0 |
/// | rocket | 3.8 | 1.4 | 1.3 | 1.2 |
/// | torus knot | 6.0 | 2.4 | 1.8 | 1.0 |
///
/// Each draw begins with an empty cache, so a frame in 15 bands costs that 15 times.
/// [Bins](super::Projected::binned) reduce it to the vertices of the triangles in each band: of
/// 5,856 triangles, 6.2 million instructions with 35 KB of vertices and 11 KB of bins (Cortex-M0+,
/// 320 x 240) become 7.7 million with the bins alone, and 30 million with neither. Powers of two
/// are the fastest `N`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OnDemand<S, D, const N: usize = 32> {
    precision: S,
    depth: PhantomData<D>,
}

impl<S, D, const N: usize> OnDemand<S, D, N> {
    pub(super) const fn new(precision: S) -> Self {
        let depth = PhantomData;
        Self { precision, depth }
    }

    pub(super) fn with_cache<const M: usize>(self) -> OnDemand<S, D, M> {
        OnDemand::new(self.precision)
    }
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate, const N: usize> Vertices<V>
    for OnDemand<S, D, N>
{
    type Subpixel = S;
    type Depth = D;
    type Lookup = Recent<S, D, V, N>;

    fn lookup(self) -> Recent<S, D, V, N> {
        Recent {
            slots: [Slot { index: usize::MAX, vertex: ScreenVertex::EMPTY }; N],
            corners: [ScreenVertex::EMPTY; 3],
        }
    }
}

/// A direct-mapped cache: vertex i has its place in slot i mod `N`.
#[derive(Clone, Copy, Debug)]
pub struct Recent<S, D, V, const N: usize> {
    slots: [Slot<S, D, V>; N],
    /// The corners of the current triangle: in the cache, one may replace another.
    corners: [ScreenVertex<S, D, V>; 3],
}

/// A cached vertex and its index; `usize::MAX` marks an empty slot.
#[derive(Clone, Copy, Debug)]
struct Slot<S, D, V> {
    index: usize,
    vertex: ScreenVertex<S, D, V>,
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate, const N: usize> Lookup<S, D, V>
    for Recent<S, D, V, N>
{
    #[inline(always)]
    fn corners(
        &mut self,
        indices: [usize; 3],
        place: impl Fn(usize) -> ScreenVertex<S, D, V>,
    ) -> Option<[&ScreenVertex<S, D, V>; 3]> {
        for (corner, index) in self.corners.iter_mut().zip(indices) {
            let slot = index.checked_rem(N).and_then(|slot| self.slots.get_mut(slot));
            *corner = match slot {
                Some(slot) if slot.index == index => slot.vertex,
                Some(slot) => {
                    let vertex = place(index);
                    *slot = Slot { index, vertex };
                    vertex
                }
                None => place(index),
            };
        }
        Some(self.corners.each_ref())
    }
}
