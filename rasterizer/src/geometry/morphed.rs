//! An object between two shapes of its mesh.

use super::shape::{Change, Shape};
use crate::{
    geometry::{AsModelled, Pose},
    mesh::{Changes, Mesh, Tween},
    numbers::Matrix,
};

/// The object is between two shapes of its mesh
/// ([`Object::morphed`](crate::scene::Object::morphed)), which `G` then changes by a matrix, if it
/// is [`Shaped`](super::Shaped).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Morphed<'t, G = AsModelled> {
    pub(super) tween: &'t Tween<'t>,
    pub(super) shape: G,
}

impl<'t> Morphed<'t> {
    pub(crate) const fn new(tween: &'t Tween<'t>) -> Self {
        Self { tween, shape: AsModelled }
    }
}

impl<'t, G: Shape> Shape for Morphed<'t, G> {
    type WithMatrix = Morphed<'t, G::WithMatrix>;

    fn with_matrix(self, matrix: &Matrix) -> Self::WithMatrix {
        Morphed { tween: self.tween, shape: self.shape.with_matrix(matrix) }
    }
}

impl<G: Change> Change for Morphed<'_, G> {
    const CHANGES: bool = G::CHANGES;

    type Posed<'a>
        = G::Posed<'a>
    where
        Self: 'a;

    #[inline(always)]
    fn posed<'a>(&'a self, pose: &'a Pose) -> Self::Posed<'a> {
        self.shape.posed(pose)
    }

    #[inline(always)]
    fn changes(&self) -> Changes<'_> {
        Changes { tween: Some(self.tween), ..self.shape.changes() }
    }

    #[inline(always)]
    fn of_mesh(self, mesh: &Mesh<'_>) -> Self {
        Self { shape: self.shape.of_mesh(mesh), ..self }
    }

    #[inline(always)]
    fn mesh<'a>(&self, mesh: &Mesh<'a>) -> Mesh<'a> {
        self.shape.mesh(mesh)
    }

    #[inline(always)]
    fn is_mirrored(&self) -> bool {
        self.shape.is_mirrored()
    }
}
