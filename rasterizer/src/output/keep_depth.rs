//! Pixels that leave the stored depth.

use core::marker::PhantomData;

use super::{Blending, Target};
use crate::{
    color::Alpha,
    mesh::MeshMaterial,
    raster::{FragmentOf, Primitive, Window},
    shade::{CodeSize, Outcome},
};

/// Another blending that does not store depth: what is drawn later is hidden by what was drawn
/// before with its depth, not by these pixels. They are tested as others are.
///
/// For glow, smoke and glass, whose parts are all to be seen behind one another:
/// `KeepDepth(Add(..))` gives the same picture in any order of triangles, up to rounding;
/// `KeepDepth(Over(..))` needs them [from back to front](crate::scene::Projected::back_to_front).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct KeepDepth<B>(pub B);

impl<T: Target, B: Blending<T>> Blending<T> for KeepDepth<B> {
    #[inline(always)]
    fn of_material(self, material: &MeshMaterial<'_>) -> Self {
        Self(self.0.of_material(material))
    }

    #[inline(always)]
    fn shade<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        self,
        target: &mut T,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        self.0.shade(target, primitive, window, move |fragment| Unstored {
            outcome: pixel(fragment),
            color: PhantomData,
        })
    }
}

/// An outcome whose depth is not stored. That it names its colour tells it from a colour.
struct Unstored<C, O> {
    outcome: O,
    color: PhantomData<C>,
}

impl<C, O: Outcome<C>> Outcome<C> for Unstored<C, O> {
    const DISCARDS: bool = O::DISCARDS;
    const WRITES_DEPTH: bool = false;
    const CODE: CodeSize = O::CODE;
    const HAS_ALPHA: bool = O::HAS_ALPHA;

    #[inline(always)]
    fn color(self) -> Option<C> {
        self.outcome.color()
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        self.outcome.layer()
    }
}
