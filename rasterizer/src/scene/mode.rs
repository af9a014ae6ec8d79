//! How an object is drawn: its choices besides mesh, pose and shader.

use crate::{
    geometry::{AsModelled, ClipAll, Clipping, CullBack, Culling, Pose, Shape},
    mesh::Mesh,
    output::Replace,
    raster::{DepthBias, NoBias},
};

/// An object's choices, as one parameter: [`Modes`] of them.
pub trait Mode: Copy + private::Sealed {
    /// Which faces are left out.
    type Culling: Culling;
    /// How triangles are treated that reach beyond the near plane, the far plane or the guard band.
    type Clipping: Clipping;
    /// How pixels are put onto a target.
    type Blending: Copy;
    /// Whether the depth of triangles is moved.
    type Bias: DepthBias;
    /// Whether the object has a matrix besides its pose.
    type Shape: Shape;

    /// How triangles are treated that reach beyond the planes.
    fn clipping(&self) -> &Self::Clipping;

    /// The same for an object in its pose.
    #[must_use]
    fn placed(self, pose: &Pose, mesh: &Mesh<'_>) -> Self;

    /// How pixels are put onto a target.
    fn blending(&self) -> Self::Blending;

    /// How the depth of triangles is moved.
    fn bias(&self) -> Self::Bias;

    /// The matrix besides the pose.
    fn shape(&self) -> &Self::Shape;
}

/// The choices by their values: back faces are culled, triangles are clipped and pixels replaced
/// unless [`Object`](super::Object)'s methods `culled`, `clipped` and `blended` say otherwise; the
/// depth of triangles is theirs unless `biased` moves it, and the object is as it was modelled
/// unless `shaped` changes it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Modes<K = CullBack, L = ClipAll, B = Replace, Z = NoBias, G = AsModelled> {
    pub(super) culling: K,
    pub(super) clipping: L,
    pub(super) blending: B,
    pub(super) bias: Z,
    pub(super) shape: G,
}

impl Modes {
    /// Back faces culled, triangles clipped, pixels replaced.
    pub(super) const DEFAULT: Self = Self {
        culling: CullBack,
        clipping: ClipAll,
        blending: Replace,
        bias: NoBias,
        shape: AsModelled,
    };
}

impl<K: Culling, L: Clipping, B: Copy, Z: DepthBias, G: Shape> Mode for Modes<K, L, B, Z, G> {
    type Culling = K;
    type Clipping = L;
    type Blending = B;
    type Bias = Z;
    type Shape = G;

    #[inline(always)]
    fn clipping(&self) -> &L {
        &self.clipping
    }

    #[inline(always)]
    fn placed(self, pose: &Pose, mesh: &Mesh<'_>) -> Self {
        let clipping = self.clipping.placed(self.shape.posed(pose), mesh);
        Self { clipping, shape: self.shape.of_mesh(mesh), ..self }
    }

    #[inline(always)]
    fn blending(&self) -> B {
        self.blending
    }

    #[inline(always)]
    fn bias(&self) -> Z {
        self.bias
    }

    #[inline(always)]
    fn shape(&self) -> &G {
        &self.shape
    }
}

mod private {
    pub trait Sealed {}
    impl<K, L, B, Z, G> Sealed for super::Modes<K, L, B, Z, G> {}
}
