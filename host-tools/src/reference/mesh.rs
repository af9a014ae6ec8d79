//! What the end-to-end route draws.

/// Triangles in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertices.
    pub positions: Vec<[f64; 3]>,
    /// Unit normal of each vertex; only [`Shading::Gouraud`](super::Shading::Gouraud) reads them.
    pub vertex_normals: Vec<[f64; 3]>,
    /// Unit normal of each triangle; only [`Shading::Flat`](super::Shading::Flat) reads them.
    pub face_normals: Vec<[f64; 3]>,
    /// Three vertex numbers each, counter-clockwise for a viewer in front of the face.
    pub triangles: Vec<[usize; 3]>,
    /// Red, green, blue of each triangle at light level 1, in 0..=255.
    pub colors: Vec<[f64; 3]>,
}

/// Which faces are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Culling {
    /// Faces whose back is towards the viewer, and faces seen exactly edge-on.
    Back,
    /// None: both sides are drawn, both with the light level of the given normal.
    None,
}
