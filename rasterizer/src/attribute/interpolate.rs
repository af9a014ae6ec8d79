//! The numbers of a vertex on the screen, on their way to a pixel.

use super::{Field, Plane, QuickGradients, TriangleSetup};
use crate::numbers::Subpixel;

/// A running value that is stepped from pixel to pixel, modulo its width.
///
/// Gradients of slivers can be far larger than the width. They wrap, and at a covered centre the
/// value is between those of the corners again.
pub trait Step: Copy + core::fmt::Debug {
    /// No change.
    const ZERO: Self;

    /// This and `change`, modulo the width.
    #[must_use]
    fn wrapping_add(self, change: Self) -> Self;

    /// `count` times this, modulo the width.
    #[must_use]
    fn wrapping_mul(self, count: i32) -> Self;
}

impl Step for u32 {
    const ZERO: Self = 0;

    #[inline(always)]
    fn wrapping_add(self, change: Self) -> Self {
        self.wrapping_add(change)
    }

    #[inline(always)]
    fn wrapping_mul(self, count: i32) -> Self {
        self.wrapping_mul(count as Self)
    }
}

impl Step for u64 {
    const ZERO: Self = 0;

    #[inline(always)]
    fn wrapping_add(self, change: Self) -> Self {
        self.wrapping_add(change)
    }

    #[inline(always)]
    fn wrapping_mul(self, count: i32) -> Self {
        self.wrapping_mul(i64::from(count) as Self)
    }
}

impl Step for () {
    const ZERO: Self = ();

    #[inline(always)]
    fn wrapping_add(self, (): Self) -> Self {}

    #[inline(always)]
    fn wrapping_mul(self, _: i32) -> Self {}
}

impl<T: Step, const N: usize> Step for [T; N] {
    const ZERO: Self = [T::ZERO; N];

    #[inline(always)]
    fn wrapping_add(self, change: Self) -> Self {
        core::array::from_fn(|i| self[i].wrapping_add(change[i]))
    }

    #[inline(always)]
    fn wrapping_mul(self, count: i32) -> Self {
        self.map(|a| a.wrapping_mul(count))
    }
}

impl<A: Step, B: Step> Step for (A, B) {
    const ZERO: Self = (A::ZERO, B::ZERO);

    #[inline(always)]
    fn wrapping_add(self, change: Self) -> Self {
        (self.0.wrapping_add(change.0), self.1.wrapping_add(change.1))
    }

    #[inline(always)]
    fn wrapping_mul(self, count: i32) -> Self {
        (self.0.wrapping_mul(count), self.1.wrapping_mul(count))
    }
}

/// Pixels of a span along which a value changes by the same step from each to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece<W> {
    /// The value at the first pixel's centre.
    pub first: W,
    /// Its change from a pixel to the one on its right.
    pub step: W,
    /// The number of pixels, at least 1.
    pub pixels: usize,
}

impl<W: Step> Piece<W> {
    /// Returns the piece without its first `count` pixels; `count` is at most `pixels`.
    #[inline(always)]
    fn skip(self, count: usize) -> Self {
        Self {
            first: self.first.wrapping_add(self.step.wrapping_mul(count as i32)),
            pixels: self.pixels - count,
            ..self
        }
    }
}

/// The pieces after the first one, of a value whose first piece is the whole span.
pub type Whole<W> = core::iter::Empty<Piece<W>>;

impl<W: Step> Plane<W> {
    /// A span of a linear value, which is one piece.
    #[inline(always)]
    pub fn piece(&self, [address, row]: [i32; 2], pixels: usize) -> Piece<W> {
        Piece { first: self.at(address, row), step: self.per_column, pixels }
    }
}

/// A number, or several, that can be interpolated over a triangle.
///
/// A function of the pixel (`Field`) is set up once a triangle. The value that is derived from it
/// (`Walk`) is stepped along a span. For a linear number a span is one piece. A number that is
/// divided at every N-th pixel and stepped linearly in between has several pieces.
pub trait Interpolate: Copy {
    /// The value of a vertex that has none yet.
    const ZERO: Self;

    /// Whether the values of a vertex differ from one of its triangles to another, as
    /// [`Weights`](super::Weights) do.
    const DIFFERS_BY_TRIANGLE: bool = false;

    /// Its function of the pixel: a [`Plane`], or several, for linear numbers.
    type Field: Field;
    /// What is stepped from pixel to pixel.
    type Walk: Step;
    /// The pieces of a span after its first one.
    type Rest: Iterator<Item = Piece<Self::Walk>>;
    /// The value that a shader sees.
    type Sample: Copy;

    /// The function through the values at a triangle's corners, about the anchor; without `quick`
    /// gradients are divided exactly.
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Self::Field;

    /// A span of `pixels`, at least 1, if it is one piece. It begins at an address of a row.
    fn whole(field: &Self::Field, at: [i32; 2], pixels: usize) -> Option<Piece<Self::Walk>>;

    /// The first piece of such a span, and the pieces after it.
    fn walk(field: &Self::Field, at: [i32; 2], pixels: usize) -> (Piece<Self::Walk>, Self::Rest);

    /// Visits all pieces of such a span, from left to right. `visit` returns the number of pixels
    /// behind the piece, which its caller counts anyway.
    #[inline(always)]
    fn for_each_piece(
        field: &Self::Field,
        at: [i32; 2],
        pixels: usize,
        mut visit: impl FnMut(Piece<Self::Walk>) -> usize,
    ) {
        let (first, rest) = Self::walk(field, at, pixels);
        core::iter::once(first).chain(rest).for_each(|piece| _ = visit(piece));
    }

    /// Returns the value that a shader sees.
    fn sample(value: Self::Walk) -> Self::Sample;

    /// Returns the values of a vertex as a corner, 0 to 2, of one of its triangles. Called if
    /// [`DIFFERS_BY_TRIANGLE`](Self::DIFFERS_BY_TRIANGLE).
    #[inline(always)]
    #[must_use]
    fn at_corner(self, _corner: usize) -> Self {
        self
    }
}

/// Linear numbers of one type.
impl<A, const N: usize> Interpolate for [A; N]
where
    A: Interpolate<Field = Plane<<A as Interpolate>::Walk>, Rest = Whole<<A as Interpolate>::Walk>>,
{
    const ZERO: Self = [A::ZERO; N];

    type Field = Plane<[A::Walk; N]>;
    type Walk = [A::Walk; N];
    type Rest = Whole<Self::Walk>;
    type Sample = [A::Sample; N];

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        [a, b, c]: [Self; 3],
    ) -> Self::Field {
        let mut all =
            Plane { anchor: Step::ZERO, per_column: Step::ZERO, per_row: Self::Walk::ZERO };
        // codegen: a loop, because a closure of `from_fn` is called, with the set-up in memory.
        for i in 0..N {
            let plane = A::plane(setup, quick, [a[i], b[i], c[i]]);
            (all.anchor[i], all.per_column[i], all.per_row[i]) =
                (plane.anchor, plane.per_column, plane.per_row);
        }
        all
    }

    #[inline(always)]
    fn whole(field: &Self::Field, at: [i32; 2], pixels: usize) -> Option<Piece<Self::Walk>> {
        Some(field.piece(at, pixels))
    }

    #[inline(always)]
    fn walk(field: &Self::Field, at: [i32; 2], pixels: usize) -> (Piece<Self::Walk>, Self::Rest) {
        (field.piece(at, pixels), core::iter::empty())
    }

    #[inline(always)]
    fn sample(value: Self::Walk) -> Self::Sample {
        value.map(A::sample)
    }
}

/// Numbers of two types, each in its own pieces.
impl<A: Interpolate, B: Interpolate> Interpolate for (A, B) {
    const ZERO: Self = (A::ZERO, B::ZERO);
    const DIFFERS_BY_TRIANGLE: bool = A::DIFFERS_BY_TRIANGLE || B::DIFFERS_BY_TRIANGLE;

    type Field = (A::Field, B::Field);
    type Walk = (A::Walk, B::Walk);
    type Rest = Both<A, B>;
    type Sample = (A::Sample, B::Sample);

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        [a, b, c]: [Self; 3],
    ) -> Self::Field {
        let one = A::plane(setup, quick, [a.0, b.0, c.0]);
        (one, B::plane(setup, quick, [a.1, b.1, c.1]))
    }

    #[inline(always)]
    fn whole(field: &Self::Field, at: [i32; 2], pixels: usize) -> Option<Piece<Self::Walk>> {
        let one = A::whole(&field.0, at, pixels)?;
        let other = B::whole(&field.1, at, pixels)?;
        Some(Piece { first: (one.first, other.first), step: (one.step, other.step), pixels })
    }

    #[inline(always)]
    fn walk(field: &Self::Field, at: [i32; 2], pixels: usize) -> (Piece<Self::Walk>, Both<A, B>) {
        let (one, one_rest) = A::walk(&field.0, at, pixels);
        let (other, other_rest) = B::walk(&field.1, at, pixels);
        let mut rest = Both { one, one_rest, other, other_rest };
        (rest.cut(), rest)
    }

    #[inline(always)]
    fn sample((one, other): Self::Walk) -> Self::Sample {
        (A::sample(one), B::sample(other))
    }

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        (self.0.at_corner(corner), self.1.at_corner(corner))
    }
}

/// The pieces of two numbers, cut where a piece of either one ends.
#[derive(Debug)]
pub struct Both<A: Interpolate, B: Interpolate> {
    one: Piece<A::Walk>,
    one_rest: A::Rest,
    other: Piece<B::Walk>,
    other_rest: B::Rest,
}

impl<A: Interpolate, B: Interpolate> Both<A, B> {
    /// Takes off the pixels that both pieces have in common.
    #[inline(always)]
    fn cut(&mut self) -> Piece<(A::Walk, B::Walk)> {
        let (one, other) = (self.one, self.other);
        let pixels = one.pixels.min(other.pixels);
        (self.one, self.other) = (one.skip(pixels), other.skip(pixels));
        Piece { first: (one.first, other.first), step: (one.step, other.step), pixels }
    }
}

impl<A: Interpolate, B: Interpolate> Iterator for Both<A, B> {
    type Item = Piece<(A::Walk, B::Walk)>;

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.one.pixels == 0 {
            self.one = self.one_rest.next()?;
        }
        if self.other.pixels == 0 {
            self.other = self.other_rest.next()?;
        }
        Some(self.cut())
    }
}
