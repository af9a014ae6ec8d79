//! How much of an object's pixels a blending mode puts onto the target.

use crate::{color::Alpha, mesh::MeshMaterial};

/// The alpha of an object's pixels in a blending mode: an [`Alpha`] for all of them, or
/// [`MaterialOpacity`].
///
/// A shader whose pixels have an alpha ([`Layer`](crate::shade::Layer)) has the product of both.
pub trait Factor: Copy {
    /// Returns it for the triangles of a material.
    #[must_use]
    fn of_material(self, material: &MeshMaterial<'_>) -> Self;

    /// The factor of these triangles.
    fn alpha(self) -> Alpha;
}

impl Factor for Alpha {
    #[inline(always)]
    fn of_material(self, _: &MeshMaterial<'_>) -> Self {
        self
    }

    #[inline(always)]
    fn alpha(self) -> Alpha {
        self
    }
}

/// Each material's own [`opacity`](crate::mesh::Finish::opacity), `d` of a material library; opaque
/// in a mesh without finishes.
///
/// ```
/// use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{mesh::Mesh, prelude::*};
/// use rasterizer::output::{MaterialOpacity, Over};
///
/// # fn bottle<'a>(mesh: &'a Mesh<'a>, flat: Flat<Rgb565>) {
/// let bottle = Object::new(mesh, flat).blended(Over(MaterialOpacity::new()));
/// # let _ = bottle;
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct MaterialOpacity {
    times: Alpha,
    /// Of the material at hand.
    product: Alpha,
}

impl MaterialOpacity {
    /// As the materials have it.
    #[must_use]
    pub const fn new() -> Self {
        Self::times(Alpha::OPAQUE)
    }

    /// As the materials have it times a factor, such as that of an object that fades.
    #[must_use]
    pub const fn times(factor: Alpha) -> Self {
        Self { times: factor, product: factor }
    }
}

impl Factor for MaterialOpacity {
    #[inline(always)]
    fn of_material(self, material: &MeshMaterial<'_>) -> Self {
        let opacity = Alpha::from_u8(material.finish().opacity);
        Self { product: self.times.scaled(opacity), ..self }
    }

    #[inline(always)]
    fn alpha(self) -> Alpha {
        self.product
    }
}
