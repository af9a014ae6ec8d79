//! From a mesh in flash to triangles on the screen.
//!
//! ```text
//!   object space      i16 quanta of the mesh
//!        |  one 3 x 4 matrix a frame: pose, camera and focal length together (transform)
//!   clip space        i32: |x| <= w and |y| <= w is the guard band, near <= z <= far
//!        |  one reciprocal a vertex
//!   screen            ScreenVertex: i32 sub-pixels from the display's top-left corner,
//!                     depth, varyings
//! ```
//!
//! A vertex outside the near plane, the far plane or the guard band has no place on the screen;
//! triangles that touch it go back to clip space and are cut there (clip). All other triangles are
//! never clipped: what lies beyond the viewport costs the rasterizer nothing.

mod any_shape;
mod clip;
mod clip_planes;
mod extent;
mod facing;
mod inverse;
mod lamp_shadow;
mod lens;
mod morphed;
mod particle;
mod picking;
mod placement;
mod planar_shadow;
mod plane;
mod pose;
mod row;
mod screen;
mod shape;
mod transform;
mod view;
mod visibility;

pub use any_shape::AnyShape;
pub(crate) use clip::{MAX_CORNERS, clip, clip_line};
pub use clip_planes::ClipPlanes;
pub(crate) use clip_planes::Corner;
pub use lamp_shadow::{LampShadow, LampShadowError};
pub use lens::Projection;
pub use morphed::Morphed;
pub(crate) use particle::ParticleView;
pub use particle::{AsParticle, Particle, ScreenParticle};
pub use picking::{Ray, ScreenPlace};
pub use planar_shadow::PlanarShadow;
pub use plane::Plane;
pub use pose::{Pose, PoseError};
pub use screen::ScreenVertex;
pub(crate) use shape::Change;
pub use shape::{AsModelled, Shape, Shaped};
pub(crate) use transform::{ClipVertex, Transform};
pub use view::{ObjectView, Viewer};
pub(crate) use visibility::UserPlanes;
pub use visibility::{ClipAll, ClipNone, Clipping, CullBack, CullFront, CullNone, Culling};
