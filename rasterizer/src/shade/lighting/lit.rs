//! What the lit shaders share.

use core::marker::PhantomData;

use super::{Lighting, level, place::Place as _};
use crate::{
    geometry::ObjectView,
    mesh::{MeshFace, MeshVertex},
};

/// Lights on surfaces of colour `C`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::shade) struct Lit<C, L> {
    pub(in crate::shade) light: L,
    color: PhantomData<C>,
}

impl<C, L> Lit<C, L> {
    pub(in crate::shade) const fn by(light: L) -> Self {
        Self { light, color: PhantomData }
    }
}

impl<C, L: Lighting> Lit<C, L> {
    // codegen: inlined, so that nobody builds the parts of the view that no light reads.
    #[inline(always)]
    pub(in crate::shade) fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self::by(self.light.for_view(view))
    }
}

/// The brightness of a vertex in Q16, from 0 to 65,536.
#[inline(always)]
pub(in crate::shade) fn vertex_level<L: Lighting>(light: &L, vertex: &MeshVertex<'_>) -> u32 {
    let position = if L::Place::IS_HERE { vertex.position() } else { [0; 3] };
    level(light, vertex.normal(), position)
}

/// The brightness of a triangle in Q16, from 0 to 65,536.
#[inline(always)]
pub(in crate::shade) fn face_level<L: Lighting>(light: &L, face: &MeshFace<'_>) -> u32 {
    // codegen: at some levels of optimisation what nobody reads is computed.
    let center = if L::Place::IS_HERE { face.center() } else { [0; 3] };
    level(light, face.normal(), center)
}
