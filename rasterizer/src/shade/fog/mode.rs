//! Where fog is computed: at the vertices, or at the pixels.

use core::fmt::Debug;

use super::Fog;
use crate::{
    attribute::{DepthFormat, FloatDepth, Interpolate, InverseW, Varyings},
    camera::Distance,
    color::Alpha,
    numbers::{Reciprocal, mul_high_unsigned},
};

/// Where fog is computed: [`AtPixels`] or [`AtVertices`].
pub trait FogMode: Copy + Debug {
    /// What a vertex carries for it.
    #[doc(hidden)]
    type Varying<'f>: Varyings<OnScreen = Self::OnScreen>;

    /// The same on the screen.
    #[doc(hidden)]
    type OnScreen: Interpolate;

    /// What all vertices of an object carry.
    #[doc(hidden)]
    fn varying<'f>(seen: &SeenFog<'f>) -> Self::Varying<'f>;

    /// How much of a pixel the fog hides.
    #[doc(hidden)]
    fn at_pixel(sample: <Self::OnScreen as Interpolate>::Sample, seen: &SeenFog<'_>) -> Alpha;

    /// How much of a vertex the fog hides.
    #[doc(hidden)]
    fn at_vertex(vertex: Self::OnScreen, seen: &SeenFog<'_>) -> Alpha;
}

/// At every visible pixel, from its own 1 / w: right on triangles of any size.
///
/// A vertex carries its 1 / w in two bytes, as [`FloatDepth`] stores it: within 2<sup>-12</sup>,
/// and as much again for the pixel. The amount of fog is then off by e<sup>-1</sup> or, for a
/// linear fog, end / (end - start) times that, beside the error of [`Fog`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct AtPixels;

/// At the vertices, and linear on the screen between them: the least work for a pixel.
///
/// It is right where fog is even over a triangle. A large triangle loses fog in its middle, and a
/// triangle that runs from near to far has it in wrong places: cut such meshes into smaller ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct AtVertices;

/// Fog as a camera sees it.
#[derive(Clone, Copy, Debug)]
pub struct SeenFog<'f> {
    fog: &'f Fog,
    /// What makes 2^k / w of near / w, where 2^k is the near distance rounded down.
    scale: u32,
    /// The code of the table's first entry for 2^k / w.
    first: i32,
}

impl<'f> SeenFog<'f> {
    /// By a camera whose 1 / w is counted in this near distance.
    pub(super) const fn new(fog: &'f Fog, near: Distance) -> Self {
        let bits = if near.to_bits() == 0 { 1 } else { near.to_bits() };
        let normalised = bits << bits.leading_zeros();
        let inverse = Reciprocal::of(normalised).refined_mantissa(normalised);
        let octaves = 15 - bits.leading_zeros() as i32;
        Self { fog, scale: (inverse as u32) << 1, first: fog.first() + (octaves << 11) }
    }

    /// 2^k / w.
    #[inline(always)]
    const fn scaled(&self, inverse_w: InverseW) -> u32 {
        mul_high_unsigned(inverse_w.to_bits(), self.scale)
    }

    /// The amount in 2^-14 for 2^k / w.
    #[inline(always)]
    const fn amount(&self, scaled: FloatDepth) -> u32 {
        self.fog.amount(scaled.to_bits() as i32 - self.first)
    }
}

/// Half a step of an alpha.
const HALF: u32 = 32;

/// From 2^-14, with half a step, to steps.
#[inline(always)]
const fn alpha(amount_and_half: u32) -> Alpha {
    Alpha::of((amount_and_half >> 6) as u16)
}

impl FogMode for AtPixels {
    type Varying<'f> = ScaledInverseW;
    type OnScreen = FloatDepth;

    #[inline(always)]
    fn varying(seen: &SeenFog<'_>) -> ScaledInverseW {
        ScaledInverseW(seen.scale)
    }

    #[inline(always)]
    fn at_pixel(sample: FloatDepth, seen: &SeenFog<'_>) -> Alpha {
        alpha(seen.amount(sample) + HALF)
    }

    #[inline(always)]
    fn at_vertex(vertex: FloatDepth, seen: &SeenFog<'_>) -> Alpha {
        alpha(seen.amount(vertex) + HALF)
    }
}

/// near / w times a factor.
#[derive(Clone, Copy, Debug)]
pub struct ScaledInverseW(u32);

impl Varyings for ScaledInverseW {
    type OnScreen = FloatDepth;

    #[inline(always)]
    fn lerp(self, _: Self, _: u32) -> Self {
        self
    }

    #[inline(always)]
    fn on_screen(self, inverse_w: InverseW) -> FloatDepth {
        FloatDepth::from_fraction(mul_high_unsigned(inverse_w.to_bits(), self.0))
    }
}

impl FogMode for AtVertices {
    type Varying<'f> = SeenFog<'f>;
    type OnScreen = u16;

    #[inline(always)]
    fn varying<'f>(seen: &SeenFog<'f>) -> SeenFog<'f> {
        *seen
    }

    #[inline(always)]
    fn at_pixel(sample: <u16 as Interpolate>::Sample, _: &SeenFog<'_>) -> Alpha {
        alpha(sample.to_bits() >> 16)
    }

    #[inline(always)]
    fn at_vertex(vertex: u16, _: &SeenFog<'_>) -> Alpha {
        alpha(vertex.into())
    }
}

/// On the screen, the amount in 2^-14 with half a step of an alpha.
impl Varyings for SeenFog<'_> {
    type OnScreen = u16;

    #[inline(always)]
    fn lerp(self, _: Self, _: u32) -> Self {
        self
    }

    #[inline(always)]
    fn on_screen(self, inverse_w: InverseW) -> u16 {
        (self.amount(FloatDepth::from_fraction(self.scaled(inverse_w))) + HALF) as u16
    }
}
