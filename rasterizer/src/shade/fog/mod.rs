//! Fog: colours that fade into another one with the distance from the camera.

mod fogged;
mod law;
mod mode;

pub use fogged::Fogged;
pub use law::{Density, Fog};
#[doc(hidden)]
pub use mode::SeenFog;
pub use mode::{AtPixels, AtVertices, FogMode};
