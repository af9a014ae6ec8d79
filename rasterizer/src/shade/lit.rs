//! What the lit shaders share.

use core::marker::PhantomData;

use super::Light;
use crate::geometry::ObjectView;

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

    pub(super) fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self::by(self.light.for_object(view.pose()))
    }
}
