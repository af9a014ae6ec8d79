//! Texture coordinates as varyings of a shader that is written for any texture.

use super::{CoordinateFormat, Coordinates, Wrap};
use crate::{
    attribute::{
        Components, Interpolate, InverseW, Piece, Plane, QuickGradients, TriangleSetup, Varyings,
    },
    numbers::Subpixel,
};

/// Texture coordinates that [`PerspectiveCorrect`](crate::attribute::PerspectiveCorrect) takes.
pub trait TextureVarying: Components + Varyings<OnScreen = Self> {
    /// Returns u and v in Q8.24 repeats.
    fn uv(self) -> [i32; 2];
}

impl<T: CoordinateFormat, const W: usize, const H: usize, X: Wrap, Y: Wrap> TextureVarying
    for Coordinates<T, W, H, X, Y>
{
    #[inline(always)]
    fn uv(self) -> [i32; 2] {
        self.vertex_uv().map(T::to_q24)
    }
}

/// Coordinates beside which a pixel gets near / w, for filters that choose a mip level by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct WithInverseW<V>(V);

impl<V> From<V> for WithInverseW<V> {
    #[inline(always)]
    fn from(coordinates: V) -> Self {
        Self(coordinates)
    }
}

impl<V: TextureVarying> TextureVarying for WithInverseW<V> {
    #[inline(always)]
    fn uv(self) -> [i32; 2] {
        self.0.uv()
    }
}

impl<V: TextureVarying> Varyings for WithInverseW<V> {
    type OnScreen = Self;

    fn lerp(self, other: Self, t: u32) -> Self {
        Self(self.0.lerp(other.0, t))
    }

    #[inline(always)]
    fn on_screen(self, _: InverseW) -> Self {
        self
    }
}

impl<V: TextureVarying> Interpolate for WithInverseW<V> {
    const ZERO: Self = Self(V::ZERO);

    type Field = V::Field;
    type Walk = V::Walk;
    type Rest = V::Rest;
    type Sample = V::Sample;

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
    fn sample(value: V::Walk) -> V::Sample {
        V::sample(value)
    }
}

impl<V: TextureVarying> Components for WithInverseW<V> {
    type Each<T: Copy + core::fmt::Debug> = V::Each<T>;

    const UNIT_BITS: V::Each<u32> = V::UNIT_BITS;
    const STEP_DIGITS: u32 = V::STEP_DIGITS;
    const ZEROS: V::Each<i32> = V::ZEROS;
    const WIDE_ZEROS: V::Each<u64> = V::WIDE_ZEROS;
    const READS_INVERSE_W: bool = true;

    #[inline(always)]
    fn each<T: Copy + core::fmt::Debug>(value: T) -> V::Each<T> {
        V::each(value)
    }

    #[inline(always)]
    fn components(self) -> V::Each<i32> {
        self.0.components()
    }

    #[inline(always)]
    fn walk_from(components: V::Each<i32>) -> V::Walk {
        V::walk_from(components)
    }

    #[inline(always)]
    fn step_from(changes: V::Each<i32>) -> V::Walk {
        V::step_from(changes)
    }

    #[inline(always)]
    fn short_plane(field: &V::Field, reach: u32) -> Option<Plane<V::Walk>> {
        V::short_plane(field, reach)
    }
}
