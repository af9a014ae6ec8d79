//! Varyings that are linear in space: interpolated in perspective on the screen.
//!
//! An attribute u is linear in space, so on the screen u / w and 1 / w are linear, and u is their
//! quotient (Blinn, *Hyperbolic Interpolation*, IEEE CG&A 12(4), 1992). The type of the mode says
//! at which pixels it is divided.

mod every_pixel;
mod linear;
mod pace;
mod quick;
mod quotient;
mod steps;

use core::{fmt::Debug, marker::PhantomData};

pub use pace::{Adaptive, Every, Pace};
use quotient::{AtPixel, Quotient};

use super::{Components, Interpolate, InverseW, Varyings};

/// A varying that is linear in space, interpolated on the screen as the mode `M` says: [`Affine`],
/// [`EveryPixel`], [`Every`] or [`Adaptive`].
///
/// The numbers `V` are `u16`, `i16`, arrays of one of them, or the
/// [coordinates of a texture](crate::texture::Coordinates). A vertex stores near / w beside them,
/// 4 bytes, except for `Affine`.
///
/// # Error
///
/// Let U be the range of u over a triangle and r the ratio of the largest 1 / w of its corners to
/// the least. Where u is divided, it is within U (r 2<sup>-27</sup> + 2<sup>-26</sup>) of the exact
/// value on the snapped corners, or within what 1/256 of a pixel changes, whichever is more; with
/// [`Adaptive`], within the tolerance, as between divisions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PerspectiveCorrect<V, M> {
    value: V,
    mode: PhantomData<M>,
}

impl<V, M> PerspectiveCorrect<V, M> {
    /// The value of a vertex.
    #[inline(always)]
    #[must_use]
    pub const fn new(value: V) -> Self {
        Self { value, mode: PhantomData }
    }
}

impl<V: Components + Varyings<OnScreen = V>, M: Correction> Varyings for PerspectiveCorrect<V, M> {
    type OnScreen = M::OnScreen<V>;

    fn lerp(self, other: Self, t: u32) -> Self {
        Self::new(self.value.lerp(other.value, t))
    }

    #[inline(always)]
    fn on_screen(self, inverse_w: InverseW) -> Self::OnScreen {
        M::on_screen(self.value, inverse_w)
    }

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        Self::new(Varyings::at_corner(self.value, corner))
    }
}

/// Where a varying is divided: [`Affine`], [`EveryPixel`], [`Every`] or [`Adaptive`].
pub trait Correction: Copy + Debug {
    /// Numbers as a vertex on the screen stores them.
    type OnScreen<V: Components>: Interpolate<Sample = Corrected<V::Sample>>;

    /// The numbers of a vertex with this 1 / w.
    fn on_screen<V: Components>(value: V, inverse_w: InverseW) -> Self::OnScreen<V>;

    /// The numbers of a vertex and its 1 / w; [`InverseW::ONE`] where that is not stored.
    fn parts<V: Components>(vertex: &Self::OnScreen<V>) -> (V, InverseW);
}

/// Nowhere: linear on the screen. It is right where the triangle's corners are equally far away.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Affine;

/// At every visible pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct EveryPixel;

/// What a shader sees of a varying in perspective.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corrected<S> {
    /// The numbers.
    pub value: S,
    /// near / w: [`InverseW::ONE`] with [`Affine`] and where the numbers'
    /// [`Components::READS_INVERSE_W`] is not set.
    pub inverse_w: InverseW,
}
