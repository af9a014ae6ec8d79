//! The names that most programs use. None of them is in `embedded_graphics::prelude`.

pub use crate::{
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{
        ClipAll, ClipNone, CullBack, CullFront, CullNone, NoDepth, Pose, S4, S8, ScreenVertex,
    },
    mesh::Mesh,
    numbers::{Rotation, Scalar, Turn, Vec3},
    scene::{Needs, Object},
    shade::{Flat, Gouraud, Level, Light, Shader, Unlit},
    target::{Bands, Direct, Frame, Rgb565Be},
};
