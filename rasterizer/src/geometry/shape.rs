//! What an object's model goes through before its pose: nothing, or a matrix.

use super::{
    Pose,
    inverse::Inverse,
    placement::{Axis, Grid},
};
use crate::{
    mesh::{Changes, Mesh, Shaping},
    numbers::{Float, Matrix},
};

/// What changes an object's model before its pose places it: nothing ([`AsModelled`]), a matrix
/// ([`Shaped`]), another shape of its mesh ([`Morphed`](super::Morphed)), or what is chosen at run
/// time ([`AnyShape`](super::AnyShape)).
#[expect(private_bounds, reason = "it is sealed")]
pub trait Shape: Copy + Change {
    /// The same with a matrix.
    type WithMatrix: Shape;

    /// The same with this matrix in place of one that it has.
    fn with_matrix(self, matrix: &Matrix) -> Self::WithMatrix;
}

impl Shape for AsModelled {
    type WithMatrix = Shaped;

    fn with_matrix(self, matrix: &Matrix) -> Shaped {
        Shaped::new(matrix)
    }
}

impl Shape for Shaped {
    type WithMatrix = Self;

    fn with_matrix(self, matrix: &Matrix) -> Self {
        Self::new(matrix)
    }
}

/// The object has the shape that it was modelled in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct AsModelled;

/// A matrix changes the object's model: [`Object::shaped`](crate::scene::Object::shaped).
///
/// Vertices are placed as exactly as others, with the matrix as it is in Q16.16; the limit of
/// [`PoseError`](super::PoseError) is then for the largest sum of the magnitudes of a row or of a
/// column of the matrix, rounded up to a power of two (and to 2<sup>-12</sup> at least), times the
/// pose's scale; and what counts for its distance d is the less the thinner the matrix makes a body
/// that has a thickness, and the more it shears. A [`PlanarShadow`](super::PlanarShadow) of such an
/// object has the first of the limits with [`S8`](crate::numbers::S8).
///
/// A normal n becomes the unit vector along ±C n, with the matrix of cofactors C, the determinant
/// times the inverse transpose, and the determinant's sign. It is rounded to 127ths as those of
/// tables are, and within half a degree of the exact one for matrices that stretch up to 1,000
/// times more in one direction than in another. A matrix without an inverse flattens the model onto
/// a plane, whose normals it has; onto a line it has no normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shaped(Shaping);

impl Shaped {
    pub(crate) fn new(matrix: &Matrix) -> Self {
        Self(Shaping::new(matrix))
    }
}

/// What drawing needs of a shape. Without a matrix, nothing of it is linked.
pub(crate) trait Change: Copy {
    /// Whether there is a matrix.
    const CHANGES: bool;

    /// A pose of an object in this shape.
    type Posed<'a>: Posed
    where
        Self: 'a;

    /// A pose of an object in this shape.
    fn posed<'a>(&'a self, pose: &'a Pose) -> Self::Posed<'a>;

    /// What becomes of vertices and normals.
    fn changes(&self) -> Changes<'_>;

    /// The same for the vertices of a mesh.
    #[must_use]
    fn of_mesh(self, mesh: &Mesh<'_>) -> Self;

    /// The mesh as shaders see it.
    fn mesh<'a>(&self, mesh: &Mesh<'a>) -> Mesh<'a>;

    /// Whether triangles run the other way round.
    fn is_mirrored(&self) -> bool;
}

impl Change for AsModelled {
    const CHANGES: bool = false;

    type Posed<'a> = &'a Pose;

    #[inline(always)]
    fn posed<'a>(&'a self, pose: &'a Pose) -> &'a Pose {
        pose
    }

    #[inline(always)]
    fn changes(&self) -> Changes<'_> {
        Changes::NONE
    }

    #[inline(always)]
    fn of_mesh(self, _: &Mesh<'_>) -> Self {
        self
    }

    #[inline(always)]
    fn mesh<'a>(&self, mesh: &Mesh<'a>) -> Mesh<'a> {
        *mesh
    }

    #[inline(always)]
    fn is_mirrored(&self) -> bool {
        false
    }
}

impl Change for Shaped {
    const CHANGES: bool = true;

    type Posed<'a> = ShapedPose<'a>;

    fn posed<'a>(&'a self, pose: &'a Pose) -> ShapedPose<'a> {
        ShapedPose { pose, shaping: Some(&self.0) }
    }

    #[inline(always)]
    fn changes(&self) -> Changes<'_> {
        Changes { shaping: Some(&self.0), ..Changes::NONE }
    }

    fn of_mesh(self, mesh: &Mesh<'_>) -> Self {
        Self(self.0.of_mesh(mesh))
    }

    #[inline(never)]
    fn mesh<'a>(&self, mesh: &Mesh<'a>) -> Mesh<'a> {
        self.0.mesh(mesh)
    }

    #[inline(always)]
    fn is_mirrored(&self) -> bool {
        self.0.is_mirrored()
    }
}

/// A pose, and what is between it and the mesh.
pub(crate) trait Posed: Copy {
    /// The pose.
    fn pose(&self) -> &Pose;

    /// As modelled, at the origin.
    fn identity(&self) -> Self;

    /// A direction of the world, in Q30, as a linear function of the mesh's positions, in Q60. Its
    /// length is 2 to the power of [`exponent`](Self::exponent) less.
    fn turn_back_exactly(&self, vector: &[i32; 3]) -> [i64; 3];

    /// The binary exponent of the scale besides the pose's.
    fn exponent(&self) -> i32;

    /// The way from the anchor to the eye along one of the object's axes.
    fn way_to_eye(&self, axes: [&Axis; 3], column: usize) -> Float;

    /// The least distance of a vertex from the eye for which the matrix is as exact as without a
    /// shape, where that is `distance`. The anchor is near the eye.
    fn least_distance(
        &self,
        distance: Float,
        grid: &Grid,
        axes: [&Axis; 3],
        mesh: &Mesh<'_>,
    ) -> Float;
}

impl Posed for &Pose {
    #[inline(always)]
    fn pose(&self) -> &Pose {
        self
    }

    #[inline(always)]
    fn identity(&self) -> Self {
        &Pose::IDENTITY
    }

    #[inline(always)]
    fn turn_back_exactly(&self, vector: &[i32; 3]) -> [i64; 3] {
        self.rotation.turn_back_exactly(vector)
    }

    #[inline(always)]
    fn exponent(&self) -> i32 {
        0
    }

    #[inline(always)]
    fn way_to_eye(&self, axes: [&Axis; 3], column: usize) -> Float {
        Axis::way_to_eye(axes, column)
    }

    #[inline(always)]
    fn least_distance(&self, distance: Float, _: &Grid, _: [&Axis; 3], _: &Mesh<'_>) -> Float {
        distance
    }
}

/// A pose after a matrix, or alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShapedPose<'a> {
    pose: &'a Pose,
    shaping: Option<&'a Shaping>,
}

impl Posed for ShapedPose<'_> {
    fn pose(&self) -> &Pose {
        self.pose
    }

    fn identity(&self) -> Self {
        Self { pose: &Pose::IDENTITY, shaping: None }
    }

    fn turn_back_exactly(&self, vector: &[i32; 3]) -> [i64; 3] {
        let direction = self.pose.rotation.turn_back_exactly(vector);
        self.shaping.map_or(direction, |shaping| shaping.turn_back_exactly(direction))
    }

    fn exponent(&self) -> i32 {
        self.shaping.map_or(0, Shaping::exponent)
    }

    #[inline(never)]
    fn way_to_eye(&self, axes: [&Axis; 3], column: usize) -> Float {
        Inverse::of(axes).way_to_eye(axes, column)
    }

    #[inline(never)]
    fn least_distance(
        &self,
        distance: Float,
        grid: &Grid,
        axes: [&Axis; 3],
        mesh: &Mesh<'_>,
    ) -> Float {
        Inverse::of(axes).least_distance(distance, grid, axes, mesh)
    }
}
