//! What becomes of triangles that reach beyond what can be drawn.

/// What becomes of triangles that reach beyond the near plane, the far plane or the guard band:
/// 1,024 pixels to each side of the viewport's middle.
///
/// Most scenes have none, and the code that cuts them is a fifth of a small renderer's. An object
/// that is known to stay in front of the camera and near the picture is drawn alike with either
/// choice.
pub trait Clipping: Copy + Default {
    /// Whether they are cut, and what is left of them drawn.
    const CUTS: bool;
}

/// They are cut at the planes: for objects that come anywhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ClipAll;

/// They are left out whole: for objects that stay between the planes. One that doesn't has holes
/// where triangles are missing, and it costs nothing else.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ClipNone;

impl Clipping for ClipAll {
    const CUTS: bool = true;
}

impl Clipping for ClipNone {
    const CUTS: bool = false;
}
