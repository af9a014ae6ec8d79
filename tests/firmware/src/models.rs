//! The models, converted by the build script.

include!(concat!(env!("OUT_DIR"), "/gear.rs"));
include!(concat!(env!("OUT_DIR"), "/rocket.rs"));
include!(concat!(env!("OUT_DIR"), "/torus_knot.rs"));
include!(concat!(env!("OUT_DIR"), "/cube.rs"));
include!(concat!(env!("OUT_DIR"), "/sphere.rs"));
include!(concat!(env!("OUT_DIR"), "/ball.rs"));
#[cfg(models)]
include!(concat!(env!("OUT_DIR"), "/spot.rs"));
#[cfg(models)]
include!(concat!(env!("OUT_DIR"), "/suzanne.rs"));
