//! What a vertex carries besides its place: depth and varyings, and how they are interpolated.
//!
//! ```text
//!   clip space    Varyings: what a shader gives a vertex; linear in space, cut by clipping
//!        |  on_screen(1 / w), the one hook on the way to the screen
//!   screen        Interpolate: what ScreenVertex stores
//!        |  plane, once a triangle: a value at an anchor pixel, its change a column and a row
//!   span          walk: pieces of equal steps from pixel to pixel
//!        |  sample, at each visible pixel
//!   Fragment      what a shader sees
//! ```
//!
//! The type of a number decides how it is interpolated: 16 bits, signed or unsigned, in steps of 32
//! bits; 32 bits in steps of 64. Arrays are of one type, tuples of several. [`Weights`] are
//! barycentric coordinates, the one kind that a vertex has for each of its triangles.

mod clear;
mod components;
mod depth;
mod float;
mod integers;
mod interpolate;
mod perspective;
mod plane;
mod varyings;
mod weights;

pub use components::Components;
pub use depth::{DepthFormat, NoDepth};
pub use float::FloatDepth;
pub use interpolate::{Interpolate, Piece, Step, Whole};
pub use perspective::{
    Adaptive, Affine, Corrected, Correction, Every, EveryPixel, Pace, PerspectiveCorrect,
};
pub use plane::{Field, Plane, QuickGradients, TriangleSetup};
pub(crate) use varyings::lerp;
pub use varyings::{InverseW, Varyings};
pub use weights::Weights;
