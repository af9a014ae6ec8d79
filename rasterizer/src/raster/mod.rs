//! From primitives on the screen to spans of covered pixels.
//!
//! Coverage is exact. A pixel is covered if its centre lies inside the triangle; a centre on an
//! edge belongs to the triangle whose top or left edge it is (Direct3D 11 functional specification
//! 3.4.1), so that triangles which share an edge share no pixel and leave none out. It is decided
//! on the snapped vertices by integer edge functions that are stepped from row to row without any
//! rounding (edge).
//!
//! Attributes are planes over the screen, set up from the snapped vertices, evaluated at covered
//! centres only. This module knows nothing of colours, buffers and displays: a [`Primitive`] visits
//! its [`Span`]s.

mod bias;
mod edge;
mod gradients;
mod line;
mod point;
mod primitive;
mod smooth_line;
mod square;
mod triangle;
mod window;

pub use bias::{Bias, DepthBias, NoBias};
pub use gradients::Gradients;
pub use line::Line;
pub use point::Point;
pub use primitive::{Fragment, FragmentOf, Primitive, Span};
pub use smooth_line::SmoothLine;
pub(crate) use square::Square;
pub use triangle::Triangle;
pub(crate) use triangle::{first_center, signed_area};
pub use window::{Layout, Window};
