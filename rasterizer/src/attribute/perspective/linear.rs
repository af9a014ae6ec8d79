//! The mode without a division.

use super::{Affine, Corrected, Correction};
use crate::{
    attribute::{Components, Interpolate, InverseW, Piece, QuickGradients, TriangleSetup},
    numbers::Subpixel,
};

/// Numbers that are linear on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OnPlane<V>(V);

impl Correction for Affine {
    type OnScreen<V: Components> = OnPlane<V>;

    #[inline(always)]
    fn on_screen<V: Components>(value: V, _: InverseW) -> OnPlane<V> {
        OnPlane(value)
    }

    #[inline(always)]
    fn parts<V: Components>(&OnPlane(value): &OnPlane<V>) -> (V, InverseW) {
        (value, InverseW::ONE)
    }
}

impl<V: Components> Interpolate for OnPlane<V> {
    const ZERO: Self = Self(V::ZERO);
    const DIFFERS_BY_TRIANGLE: bool = V::DIFFERS_BY_TRIANGLE;

    type Field = V::Field;
    type Walk = V::Walk;
    type Rest = V::Rest;
    type Sample = Corrected<V::Sample>;

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        [a, b, c]: [Self; 3],
    ) -> V::Field {
        V::plane(setup, quick, [a.0, b.0, c.0])
    }

    #[inline(always)]
    fn whole(field: &V::Field, at: [i32; 2], pixels: usize) -> Option<Piece<V::Walk>> {
        V::whole(field, at, pixels)
    }

    #[inline(always)]
    fn walk(field: &V::Field, at: [i32; 2], pixels: usize) -> (Piece<V::Walk>, V::Rest) {
        V::walk(field, at, pixels)
    }

    #[inline(always)]
    fn sample(value: V::Walk) -> Corrected<V::Sample> {
        Corrected { value: V::sample(value), inverse_w: InverseW::ONE }
    }

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        Self(self.0.at_corner(corner))
    }
}
