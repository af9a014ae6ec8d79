//! The models, converted by the build script.

include!(concat!(env!("OUT_DIR"), "/gear.rs"));
include!(concat!(env!("OUT_DIR"), "/rocket.rs"));
include!(concat!(env!("OUT_DIR"), "/torus_knot.rs"));
include!(concat!(env!("OUT_DIR"), "/cube.rs"));
include!(concat!(env!("OUT_DIR"), "/sphere.rs"));
include!(concat!(env!("OUT_DIR"), "/ball.rs"));
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
