//! From a mesh in flash to triangles on the screen.
//!
//! ```text
//!   object space      i16 quanta of the mesh
//!        |  one 3 x 4 matrix a frame: pose, camera and focal length at once (transform)
//!   clip space        i32: |x| <= w and |y| <= w is the guard band, near <= z <= far
//!        |  one reciprocal a vertex
//!   screen            i32 sub-pixels from the display's top-left corner, depth, varyings (ScreenVertex)
//! ```
//!
//! A vertex outside the near plane, the far plane or the guard band has no place on the screen;
//! triangles that touch it go back to clip space and are cut there (clip). All other triangles are
//! never clipped: what lies beyond the viewport costs the rasterizer nothing.

mod attribute;
mod clip;
mod clipping;
mod cull;
mod pose;
mod projection;
mod row;
mod screen;
mod transform;

pub use attribute::{Attribute, DepthFormat, NoDepth, Varyings};
pub(crate) use clip::{MAX_CORNERS, clip};
pub use clipping::{ClipAll, ClipNone, Clipping};
pub use cull::{CullBack, CullFront, CullNone, Culling};
pub use pose::{Pose, PoseError};
pub use projection::Projection;
pub use screen::{S4, S8, ScreenVertex, Subpixel};
pub(crate) use transform::{ClipVertex, Transform};
