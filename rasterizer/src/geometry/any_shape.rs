//! A shape that is chosen at run time.

use super::{
    AsModelled, Morphed, Pose, Shape, Shaped,
    placement::{Axis, Grid},
    shape::{Change, Posed, ShapedPose},
};
use crate::{
    mesh::{Changes, Mesh, Tween},
    numbers::{Float, Matrix},
};

/// Any shape, chosen at run time
/// ([`Object::in_any_shape`](crate::scene::Object::in_any_shape)).
///
/// What draws is compiled for each type of shape. Objects of this one may have a matrix or none,
/// and be between two shapes of their mesh or not: an array holds them all, and what draws is
/// linked once, with what a matrix needs: 17 KB of flash on a Cortex-M0+ for three spheres of
/// different shapes, whose own types take 24 KB. The pixels are those of the shape's own type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AnyShape<'t> {
    tween: Option<&'t Tween<'t>>,
    matrix: Option<Shaped>,
}

impl From<AsModelled> for AnyShape<'_> {
    fn from(AsModelled: AsModelled) -> Self {
        Self { tween: None, matrix: None }
    }
}

impl From<Shaped> for AnyShape<'_> {
    fn from(matrix: Shaped) -> Self {
        Self { tween: None, matrix: Some(matrix) }
    }
}

impl<'t, G: Into<Self>> From<Morphed<'t, G>> for AnyShape<'t> {
    fn from(Morphed { tween, shape }: Morphed<'t, G>) -> Self {
        Self { tween: Some(tween), ..shape.into() }
    }
}

impl Shape for AnyShape<'_> {
    type WithMatrix = Self;

    fn with_matrix(self, matrix: &Matrix) -> Self {
        Self { matrix: Some(Shaped::new(matrix)), ..self }
    }
}

impl Change for AnyShape<'_> {
    const CHANGES: bool = true;

    type Posed<'a>
        = AnyPose<'a>
    where
        Self: 'a;

    fn posed<'a>(&'a self, pose: &'a Pose) -> AnyPose<'a> {
        match &self.matrix {
            None => AnyPose::AsModelled(pose),
            Some(matrix) => AnyPose::Shaped(matrix.posed(pose)),
        }
    }

    fn changes(&self) -> Changes<'_> {
        let changes = self.matrix.as_ref().map_or(Changes::NONE, Change::changes);
        Changes { tween: self.tween, ..changes }
    }

    fn of_mesh(self, mesh: &Mesh<'_>) -> Self {
        Self { matrix: self.matrix.map(|matrix| matrix.of_mesh(mesh)), ..self }
    }

    fn mesh<'a>(&self, mesh: &Mesh<'a>) -> Mesh<'a> {
        self.matrix.map_or(*mesh, |matrix| matrix.mesh(mesh))
    }

    fn is_mirrored(&self) -> bool {
        self.matrix.is_some_and(|matrix| matrix.is_mirrored())
    }
}

/// A pose, after a matrix or without one.
#[derive(Clone, Copy, Debug)]
pub(crate) enum AnyPose<'a> {
    AsModelled(&'a Pose),
    Shaped(ShapedPose<'a>),
}

impl Posed for AnyPose<'_> {
    fn pose(&self) -> &Pose {
        match self {
            Self::AsModelled(pose) => pose,
            Self::Shaped(shaped) => shaped.pose(),
        }
    }

    fn identity(&self) -> Self {
        match self {
            Self::AsModelled(pose) => Self::AsModelled(pose.identity()),
            Self::Shaped(shaped) => Self::Shaped(shaped.identity()),
        }
    }

    fn turn_back_exactly(&self, vector: &[i32; 3]) -> [i64; 3] {
        match self {
            Self::AsModelled(pose) => pose.turn_back_exactly(vector),
            Self::Shaped(shaped) => shaped.turn_back_exactly(vector),
        }
    }

    fn exponent(&self) -> i32 {
        match self {
            Self::AsModelled(pose) => pose.exponent(),
            Self::Shaped(shaped) => shaped.exponent(),
        }
    }

    fn way_to_eye(&self, axes: [&Axis; 3], column: usize) -> Float {
        match self {
            Self::AsModelled(pose) => pose.way_to_eye(axes, column),
            Self::Shaped(shaped) => shaped.way_to_eye(axes, column),
        }
    }

    fn least_distance(
        &self,
        distance: Float,
        grid: &Grid,
        axes: [&Axis; 3],
        mesh: &Mesh<'_>,
    ) -> Float {
        match self {
            Self::AsModelled(pose) => pose.least_distance(distance, grid, axes, mesh),
            Self::Shaped(shaped) => shaped.least_distance(distance, grid, axes, mesh),
        }
    }
}
