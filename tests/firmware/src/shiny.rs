//! Models with highlights.

use rasterizer::mesh::{Finish, Mesh, Tables};

use crate::models;

const FINISHES: &[Finish; 1] = &[Finish::MATTE.with_specular([200, 220, 255], 30)];

/// The sphere of the bench scenes.
pub static SPHERE: Mesh<'static> =
    Mesh::new_const(Tables { finishes: FINISHES, ..*models::SPHERE.tables() });

/// The ball of the size scenes.
pub static BALL: Mesh<'static> =
    Mesh::new_const(Tables { finishes: FINISHES, ..*models::BALL.tables() });
