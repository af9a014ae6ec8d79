//! An f64 reference rasterizer that judges the fixed-point one. It evaluates the definitions of the
//! graphics specifications as directly as possible.
//!
//! It shares no code and no table with the rasterizer it judges, and it depends on `std` alone. Two
//! routes draw a [`Picture`]:
//!
//! * [`draw_scene`], **end to end**: a world-space [`Mesh`] seen by a [`Camera`]. View transform,
//!   clipping against the near and the far plane, projection, culling, coverage,
//!   perspective-correct varyings. It measures what fixed-point arithmetic and every approximation
//!   cost in the final picture.
//! * [`draw_screen`], **arithmetic**: triangles that are already projected, culled, clipped and
//!   snapped to a sub-pixel grid. Coverage is then exact in f64, so two correct rasterizers agree
//!   on every pixel: the tolerance is zero.
//!
//! Both interpolate any number of varyings and leave the colour to a closure, which gets a
//! [`Sample`] and may also discard the fragment. So the reference judges any shader whose
//! definition is written as closures. A sample also has the exact derivatives of its varyings.
//!
//! Texture coordinates are varyings. [`draw_scene`] interpolates them in perspective. For
//! [`draw_screen`], which is linear, each corner has them over w ([`Footprint::over_w`]) and the
//! closure divides ([`Footprint::in_perspective`]); left as they are, they are affine. The closure
//! samples a [`Texture`] or [`Mipmaps`].
//!
//! A [`Picture`] keeps *every* fragment of a pixel, not only the visible one. This separates two
//! causes of a difference: a wrong edge, and two layers whose depths lie closer together than the
//! depth buffer resolves.
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
//! | texture coordinates | u right, v down from the corner of the first texel; 1 is the width, the height |
//! | colour | real-valued red, green, blue in 0..=255, never quantised |
//!
//! # The chain
//!
//! | step | file | source |
//! |---|---|---|
//! | what lies between two shapes of a model | `between.rs` | linear interpolation |
//! | what a matrix makes of a model and its normals | `linear_map.rs` | Turkowski, "Properties of surface-normal transformations", Graphics Gems, 1990 |
//! | view transform, projection | `camera.rs` | similar triangles |
//! | levels of lights, highlights | `lights.rs` | Lambert's cosine law; Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977 |
//! | amount of fog at a distance | `fog.rs` | OpenGL 2.1 specification, section 3.10 |
//! | near and far plane, planes of the user's | `clip.rs` | Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974 |
//! | the same for lines | `clip.rs` | Liang and Barsky, "A new concept and method for line clipping", ACM Transactions on Graphics 3(1), 1984 |
//! | which pixels | `coverage.rs` | Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988; Direct3D 11.3 functional specification, 3.4.2.1 |
//! | which pixels of a line | `line.rs` | Vulkan specification, "Bresenham line segment rasterization" |
//! | how much of a pixel an antialiased line covers | `smooth_line.rs` | derived there |
//! | which pixels of a point | `point.rs` | Vulkan specification, "Basic point rasterization" |
//! | which pixels of a particle, and which part of its picture | `sprite.rs` | Direct3D 11.3 functional specification, 3.4.2.1 |
//! | triangles of a polygon | `polygon.rs` | Meisters, "Polygons have ears", American Mathematical Monthly 82(6), 1975 |
//! | what outlines enclose | `winding.rs` | Shimrat, "Algorithm 112: Position of point relative to polygon", CACM 5(8), 1962 |
//! | values between vertices | `interpolate.rs` | Vulkan specification, "Basic polygon rasterization" |
//! | error of linear steps | `chord.rs` | derived there |
//! | texture coordinate and level of detail of a pixel | `footprint.rs` | Vulkan specification, "Image sample operations" |
//! | texels beyond the edges | `wrap.rs` | OpenGL 4.6 core profile, table 8.21 |
//! | texels at a coordinate | `texture.rs` | OpenGL 4.6 core profile, section 8.14 |
//! | mip levels | `mipmaps.rs` | Williams, "Pyramidal parametrics", SIGGRAPH 1983 |
//! | stored depth | `depth.rs` | IEEE 754, without a sign |
//! | colours of a display, dithering | `display.rs` | Bayer, "An optimum method for two-level rendition of continuous-tone pictures", ICC 1973; IEC 61966-2-1 |
//! | an alpha along an axis | `fade.rs` | |
//! | layers over a background, alphas of several causes | `blend.rs` | W3C, Compositing and Blending Level 1 |
//! | all fragments of a pixel | `picture.rs` | Carpenter, "The A-buffer", SIGGRAPH 1984 |
//! | the two routes | `scene.rs`, `screen.rs` | |

mod between;
mod blend;
mod camera;
mod chord;
mod clip;
mod coverage;
mod depth;
mod display;
mod fade;
mod fog;
mod footprint;
mod interpolate;
mod lights;
mod line;
mod linear_map;
mod mesh;
mod mipmaps;
mod picture;
mod point;
mod polygon;
pub(crate) mod random;
#[cfg(test)]
mod ray;
mod sample;
mod scene;
mod screen;
mod smooth_line;
mod sprite;
mod texture;
mod winding;
mod wrap;

pub use between::Between;
pub use blend::{Blend, Layer, combined_alpha};
pub use camera::{Camera, Projection, ScreenPoint, Viewport};
pub use chord::{chord_error, chord_error_in_steps};
pub use clip::{HalfSpace, clip_ring, part_inside};
pub use depth::DepthFormat;
pub use display::{Display, Steps, luma};
pub use fade::Fade;
pub use fog::{Fog, fogged};
pub use footprint::Footprint;
pub use lights::{Finish, Lamp, Lights, Sun, Viewer};
pub use line::Line;
pub use linear_map::LinearMap;
pub use mesh::{Corner, Culling, Mesh};
pub use mipmaps::Mipmaps;
pub use picture::{Fragment, Picture};
pub use point::Point;
pub use polygon::{Plane, triangulate};
pub use sample::Sample;
pub use scene::{draw_clipped_scene, draw_scene};
pub use screen::{ScreenTriangle, ScreenVertex, draw_screen};
pub use smooth_line::SmoothLine;
pub use sprite::Sprite;
pub use texture::{Texel, Texture, is_opaque, lit};
pub use winding::{Pixels, Winding};
pub use wrap::Wrap;
