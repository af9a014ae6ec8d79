//! Which side of a triangle is seen.

/// Which triangles are left out, by the side that they turn to the viewer.
///
/// The side is decided on the snapped vertices, by the sign of the area that is drawn (Direct3D 11
/// functional specification 15.6.1), so that a triangle that snapping turned over counts as what it
/// is on the screen.
pub trait Culling: Copy + Default {
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
