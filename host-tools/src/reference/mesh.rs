//! What the end-to-end route draws.

/// Triangles in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertices.
    pub positions: Vec<[f64; 3]>,
    /// Three vertex numbers each, counter-clockwise for a viewer in front of the face.
    pub triangles: Vec<[usize; 3]>,
}

/// A corner of a triangle of a [`Mesh`], for which [`draw_scene`](super::draw_scene) asks the
/// varyings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Index into [`Mesh::triangles`].
    pub triangle: usize,
    /// Index into [`Mesh::positions`].
    pub vertex: usize,
    /// That position.
    pub position: [f64; 3],
}

/// Which faces are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Culling {
    /// Faces whose back is towards the viewer, and faces seen exactly edge-on.
    Back,
    /// None: both sides are drawn, both with the same varyings.
    None,
}
