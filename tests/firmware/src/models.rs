//! The models, converted by the build script.

use rasterizer::mesh::{PointIndices, Points};

include!(concat!(env!("OUT_DIR"), "/gear.rs"));
include!(concat!(env!("OUT_DIR"), "/rocket.rs"));
include!(concat!(env!("OUT_DIR"), "/torus_knot.rs"));
include!(concat!(env!("OUT_DIR"), "/cube.rs"));
include!(concat!(env!("OUT_DIR"), "/sphere.rs"));
include!(concat!(env!("OUT_DIR"), "/ball.rs"));
include!(concat!(env!("OUT_DIR"), "/pulse.rs"));
include!(concat!(env!("OUT_DIR"), "/colored_sphere.rs"));
include!(concat!(env!("OUT_DIR"), "/wooden_crate.rs"));
include!(concat!(env!("OUT_DIR"), "/wooden_crate_mips.rs"));
include!(concat!(env!("OUT_DIR"), "/cube_texture.rs"));
include!(concat!(env!("OUT_DIR"), "/cube_texture_8.rs"));
include!(concat!(env!("OUT_DIR"), "/cube_texture_4.rs"));
include!(concat!(env!("OUT_DIR"), "/cube_texture_mips.rs"));
include!(concat!(env!("OUT_DIR"), "/shaded.rs"));
#[cfg(models)]
include!(concat!(env!("OUT_DIR"), "/spot.rs"));
#[cfg(models)]
include!(concat!(env!("OUT_DIR"), "/suzanne.rs"));
#[cfg(models)]
include!(concat!(env!("OUT_DIR"), "/spot_texture.rs"));
#[cfg(models)]
include!(concat!(env!("OUT_DIR"), "/spot_texture_8.rs"));

/// All vertices of the sphere as points.
pub static SPHERE_POINTS: Points<'static> =
    Points::new_const(&SPHERE, PointIndices::U16(&all::<{ SPHERE.vertex_count() }>()));

/// All vertices of the ball as points.
pub static BALL_POINTS: Points<'static> =
    Points::new_const(&BALL, PointIndices::U16(&all::<{ BALL.vertex_count() }>()));

/// The numbers from 0 on.
const fn all<const N: usize>() -> [u16; N] {
    let (mut indices, mut vertex) = ([0; N], 0);
    while vertex < N {
        indices[vertex] = vertex as u16;
        vertex += 1;
    }
    indices
}
