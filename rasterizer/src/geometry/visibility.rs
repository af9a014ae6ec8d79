//! Which triangles are drawn: by the side that they turn to the viewer, and by the planes that they
//! cross.

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
/// 1,024 pixels to each side of the viewport's middle.
///
/// Most scenes have none, and the code that cuts them is a fifth of a small renderer's. Both
/// choices draw the same picture of an object that stays in front of the camera and near the
/// picture.
pub trait Clipping: Copy {
    /// Whether they are cut and their remainder drawn.
    const CUTS: bool;
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
