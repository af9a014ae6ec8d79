//! What the lit shaders share: a light, and the ramp of colours that a material has in it.

use core::marker::PhantomData;

use embedded_graphics_core::pixelcolor::{PixelColor, Rgb888};

use super::{Light, Ramp};
use crate::{geometry::Pose, mesh::Material};

/// A light that shows materials in `LEVELS` brightnesses of colour `C`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Lit<C, const LEVELS: usize> {
    pub(super) light: Light,
    color: PhantomData<C>,
}

impl<C, const LEVELS: usize> Lit<C, LEVELS> {
    pub(super) const fn by(light: Light) -> Self {
        Self {
            light,
            color: PhantomData,
        }
    }

    pub(super) fn in_object_space(&self, pose: &Pose) -> Self {
        Self::by(self.light.in_object_space(pose))
    }
}

impl<C: PixelColor + From<Rgb888>, const LEVELS: usize> Lit<C, LEVELS> {
    /// From black to the material's colour.
    pub(super) fn ramp(material: &Material) -> Ramp<C, LEVELS> {
        Ramp::between(Rgb888::new(0, 0, 0), material.rgb())
    }
}
