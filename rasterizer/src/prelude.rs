//! The names that most programs use. None of them is in `embedded_graphics::prelude`.

pub use crate::{
    attribute::{FloatDepth, NoDepth},
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{ClipAll, ClipNone, CullBack, CullFront, CullNone, ObjectView, Pose, ScreenVertex},
    mesh::Mesh,
    numbers::{Rotation, S4, S8, Scalar, Turn, Vec3},
    output::{Bands, Direct, Frame, Rgb565Be},
    scene::{Needs, Object},
    shade::{Flat, Gouraud, Level, Light, Shader, Textured, TexturedFlat, TexturedGouraud, Unlit},
};
