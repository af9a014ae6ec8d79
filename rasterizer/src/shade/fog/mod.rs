//! Fog: colours that fade into another one with the distance from the camera.

mod fogged;
mod law;
mod mode;

pub use fogged::{Fogged, FoggedFace};
pub use law::{Density, Fog};
pub use mode::{AtPixels, AtVertices, FogMode};
