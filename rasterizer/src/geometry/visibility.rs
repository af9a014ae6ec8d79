//! Which triangles are drawn: by the side that they turn to the viewer, and by the planes that they
//! cross.

use heapless::Vec;

use super::{
    ClipPlanes,
    clip::MAX_CORNERS,
    clip_planes::Corner,
    shape::Posed,
    transform::{Axes, CameraAxes, ClipVertex},
};
use crate::{attribute::Varyings, mesh::Mesh, numbers::Coordinate};

/// Which triangles are left out, by the side that they turn to the viewer.
///
/// The side is decided on the snapped vertices, by the sign of the area that is drawn (Direct3D 11
/// functional specification 15.6.1), so a triangle that snapping turned over counts by the side
/// that it shows on the screen.
pub trait Culling: Copy {
    /// Whether triangles whose corners run counter-clockwise on the screen are drawn.
    const FRONT: bool;
    /// Whether triangles whose corners run clockwise on the screen are drawn.
    const BACK: bool;
}

/// Back faces are left out: for closed models.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CullBack;

/// Front faces are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CullFront;

/// Both sides are drawn: for open surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CullNone;

impl Culling for CullBack {
    const FRONT: bool = true;
    const BACK: bool = false;
}

impl Culling for CullFront {
    const FRONT: bool = false;
    const BACK: bool = true;
}

impl Culling for CullNone {
    const FRONT: bool = true;
    const BACK: bool = true;
}

/// How triangles are treated that reach beyond the near plane, the far plane or the guard band:
/// 1,024 pixels to each side of the viewport's middle. [`ClipAll`] and [`ClipNone`] are for these
/// planes alone, [`ClipPlanes`] has others besides.
///
/// Most scenes have none, and the code that cuts them is a fifth of a small renderer's. Both
/// choices draw the same picture of an object that stays in front of the camera and near the
/// picture.
#[expect(private_bounds, reason = "it is sealed")]
pub trait Clipping: Copy + UserPlanes {
    /// Whether they are cut and their remainder drawn.
    const CUTS: bool;
}

/// Planes of the user's own. Without any, nothing of it is linked.
pub(crate) trait UserPlanes: Copy {
    /// Whether there are any.
    const EXIST: bool = false;

    /// The axes along which the object is seen.
    type Axes: Axes;

    /// The axes along which the object is seen.
    fn axes(&self) -> Self::Axes;

    /// The same for an object in its pose.
    #[inline(always)]
    fn placed(self, _: impl Posed, _: &Mesh<'_>) -> Self {
        self
    }

    /// Whether a position of the mesh is kept.
    #[inline(always)]
    fn keeps(&self, _: [i16; 3]) -> bool {
        true
    }

    /// Whether all of some positions are outside one and the same plane.
    #[inline(always)]
    fn excludes(&self, _: impl Iterator<Item = [i16; 3]> + Clone) -> bool {
        false
    }

    /// The part of a triangle that is kept: a convex polygon in the triangle's order, or none.
    #[inline(always)]
    fn cut<C: Coordinate, V: Varyings>(
        &self,
        triangle: &[Corner<C, V>; 3],
        kept: &mut Vec<ClipVertex<C, V>, MAX_CORNERS>,
    ) {
        for (_, corner) in triangle {
            let _ = kept.push(*corner);
        }
    }

    /// The part of a line that is kept.
    #[inline(always)]
    fn cut_line<C: Coordinate, V: Varyings>(
        &self,
        ends: &[Corner<C, V>; 2],
    ) -> Option<[ClipVertex<C, V>; 2]> {
        Some([ends[0].1, ends[1].1])
    }
}

/// Cuts them at the planes: for objects that can be anywhere.
///
/// A corner that a plane cuts with [`S8`](crate::numbers::S8) is as exact as the edge that it is
/// on. With [`S4`](crate::numbers::S4) it is within 4 units of clip space of that along each axis,
/// for each of the planes that cut it; a unit is a 2<sup>30</sup>th of the largest coordinate m of
/// [`PoseError`](super::PoseError). On the screen that is m / w 2<sup>-13</sup> sub-pixels: an
/// eighth at the limit of m = 1,024 w. Triangles that share an edge share its corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ClipAll;

/// Leaves them out whole: for objects that stay between the planes. An object that crosses one has
/// holes where its triangles are missing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ClipNone;

impl Clipping for ClipAll {
    const CUTS: bool = true;
}

impl Clipping for ClipNone {
    const CUTS: bool = false;
}

impl<const N: usize> Clipping for ClipPlanes<N> {
    const CUTS: bool = true;
}

impl UserPlanes for ClipAll {
    type Axes = CameraAxes;

    #[inline(always)]
    fn axes(&self) -> CameraAxes {
        CameraAxes
    }
}

impl UserPlanes for ClipNone {
    type Axes = CameraAxes;

    #[inline(always)]
    fn axes(&self) -> CameraAxes {
        CameraAxes
    }
}

impl<const N: usize> UserPlanes for ClipPlanes<N> {
    const EXIST: bool = N > 0;
    type Axes = CameraAxes;

    #[inline(always)]
    fn axes(&self) -> CameraAxes {
        CameraAxes
    }

    #[inline(always)]
    fn placed(self, posed: impl Posed, mesh: &Mesh<'_>) -> Self {
        self.placed(posed, mesh)
    }

    #[inline(always)]
    fn keeps(&self, position: [i16; 3]) -> bool {
        self.keeps(position)
    }

    #[inline(always)]
    fn excludes(&self, positions: impl Iterator<Item = [i16; 3]> + Clone) -> bool {
        self.excludes(positions)
    }

    #[inline(always)]
    fn cut<C: Coordinate, V: Varyings>(
        &self,
        triangle: &[Corner<C, V>; 3],
        kept: &mut Vec<ClipVertex<C, V>, MAX_CORNERS>,
    ) {
        self.cut(triangle, kept);
    }

    #[inline(always)]
    fn cut_line<C: Coordinate, V: Varyings>(
        &self,
        ends: &[Corner<C, V>; 2],
    ) -> Option<[ClipVertex<C, V>; 2]> {
        self.cut_line(ends)
    }
}
