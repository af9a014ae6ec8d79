//! An f64 reference rasterizer that judges the fixed-point one: the definitions of the graphics
//! specifications, written down as directly as they can be evaluated.
//!
//! It shares no code and no table with the rasterizer it judges, and it has no dependency but
//! `std`. Two routes end in the same [`Picture`]:
//!
//! * [`draw_scene`], **end to end**: a world-space [`Mesh`] seen by a [`Camera`]. View transform,
//!   clipping against the near and the far plane, projection, culling, coverage,
//!   perspective-correct light. It measures what fixed-point arithmetic and every approximation
//!   cost in the final picture.
//! * [`draw_screen`], **arithmetic**: triangles that are already projected, culled, clipped and
//!   snapped to a sub-pixel grid. Coverage is then exact in f64, so two correct rasterizers agree
//!   on every pixel and the tolerance is zero.
//!
//! A [`Picture`] keeps *every* fragment of a pixel, not only the visible one, so that a
//! disagreement can be told apart: a wrong edge, or two layers whose depths lie closer together
//! than the depth buffer resolves.
//!
//! # Conventions
//!
//! | quantity | convention |
//! |---|---|
//! | world | right-handed, y up; column vectors |
//! | view space | the camera at the origin looks along -z, y up |
//! | screen | origin at the top left corner, y down, unit one pixel; centre of pixel (i, j) at (i + 0.5, j + 0.5) |
//! | front face | counter-clockwise for the viewer, hence negative area in screen coordinates (y points down) |
//! | depth | `near / w` (orthographic: see [`ScreenPoint`]): 1 at the near plane, less beyond; linear in screen space |
//! | coverage | the pixel centre decides; a centre exactly on an edge follows the top-left rule |
//! | color | real-valued red, green, blue in 0..=255, never quantised |
//!
//! # The chain
//!
//! | step | file | source |
//! |---|---|---|
//! | view transform, projection | `camera.rs` | similar triangles |
//! | light level of a normal | `shade.rs` | Lambert's cosine law |
//! | near and far plane | `clip.rs` | Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974 |
//! | which pixels | `coverage.rs` | Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988; Direct3D 11.3 functional specification, 3.4.2.1 |
//! | values between vertices | `interpolate.rs` | Vulkan specification, "Basic polygon rasterization" |
//! | all fragments of a pixel | `picture.rs` | Carpenter, "The A-buffer", SIGGRAPH 1984 |
//! | the two routes | `scene.rs`, `screen.rs` | |

mod camera;
mod clip;
mod coverage;
mod interpolate;
mod mesh;
mod picture;
#[cfg(test)]
mod random;
#[cfg(test)]
mod ray;
mod scene;
mod screen;
mod shade;

pub use camera::{Camera, Projection, ScreenPoint, Viewport};
pub use mesh::{Culling, Mesh};
pub use picture::{Fragment, Picture};
pub use scene::draw_scene;
pub use screen::{ScreenTriangle, ScreenVertex, draw_screen};
pub use shade::{Light, Shading};
