//! What the lit shaders share.

use core::marker::PhantomData;

use super::Light;
use crate::geometry::Pose;

/// A light on surfaces of colour `C`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Lit<C> {
    pub(super) light: Light,
    color: PhantomData<C>,
}

impl<C> Lit<C> {
    pub(super) const fn by(light: Light) -> Self {
        Self { light, color: PhantomData }
    }

    pub(super) fn in_object_space(&self, pose: &Pose) -> Self {
        Self::by(self.light.in_object_space(pose))
    }
}
