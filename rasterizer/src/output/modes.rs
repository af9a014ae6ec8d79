//! Blending modes by formulas of [`Composite`].

use super::{Blending, Factor, Readable};
use crate::{
    color::{Alpha, Composite},
    mesh::MeshMaterial,
    raster::{FragmentOf, Primitive, Window},
    shade::{CodeSize, Outcome},
};

/// [`Blending`] by a method of [`Composite`].
macro_rules! blending {
    ($mode:ident, $method:ident) => {
        impl<T: Readable<Color: Composite>, F: Factor> Blending<T> for $mode<F> {
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
                let factor = self.0.alpha();
                target.blend(primitive, window, move |stored, fragment| Composed {
                    stored,
                    new: pixel(fragment),
                    factor,
                    by: T::Color::$method,
                })
            }
        }
    };
}

/// A pixel hides the stored colour by its alpha ([`Composite::over`]): glass, smoke, a fading
/// object.
///
/// What lies behind is drawn before. With an alpha of each pixel or a depth that is stored, an
/// object's own parts come in the order of its triangles: see
/// [`Projected::back_to_front`](crate::scene::Projected::back_to_front) and
/// [`KeepDepth`](super::KeepDepth).
///
/// ```
/// use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{mesh::Mesh, prelude::*};
/// use rasterizer::{color::Alpha, output::Over};
///
/// # fn ghost<'a>(mesh: &'a Mesh<'a>, flat: Flat<Rgb565>) {
/// let ghost = Object::new(mesh, flat).blended(Over(Alpha::lit("0.4")));
/// # let _ = ghost;
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Over<F = Alpha>(pub F);

/// A pixel is added to the stored colour ([`Composite::add`]): light, fire, a beam.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Add<F = Alpha>(pub F);

/// The stored colour is seen through a pixel's ([`Composite::multiply`]): coloured glass, a shadow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Multiply<F = Alpha>(pub F);

/// A pixel lights the stored colour, the less the brighter that is ([`Composite::screen`]): glow,
/// mist and reflections that keep their shape where [`Add`] would be white all over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Screen<F = Alpha>(pub F);

blending!(Over, over);
blending!(Add, add);
blending!(Multiply, multiply);
blending!(Screen, screen);

/// An outcome that a formula puts onto the stored colour, unless it is discarded.
struct Composed<C, O, F> {
    stored: C,
    new: O,
    factor: Alpha,
    by: F,
}

impl<C, O: Outcome<C>, F: Fn(C, C, Alpha) -> C> Outcome<C> for Composed<C, O, F> {
    const DISCARDS: bool = O::DISCARDS;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;
    const CODE: CodeSize = O::CODE.max(CodeSize::Medium);

    #[inline(always)]
    fn color(self) -> Option<C> {
        self.new.layer().map(|(new, alpha)| {
            let alpha = if O::HAS_ALPHA { alpha.scaled(self.factor) } else { self.factor };
            (self.by)(new, self.stored, alpha)
        })
    }
}
