//! How errors grow with stiffness.
//!
//! A problem is stiff where a small error of a number becomes a large one of the picture although
//! the picture itself is harmless: the error of a fixed format is multiplied by a condition number,
//! such as the distance over that of the near plane. A [`Family`] is a problem with one parameter
//! that sweeps the condition number in powers of two. The core solves random instances of it with
//! its own projection, clipping, spans and depth, and definitions in `f64` judge the results.
//!
//! On logarithmic axes the error is a line whose slope is known from theory: the family's [`Law`].
//! Each family also has the bound that the documentation states, and says where it ends and what
//! happens beyond. The tests assert slopes and bounds.
//!
//! A format can be exact and slow: each family also tells what the core does in some of its
//! instances ([`Cost`]), so that cycles are measured beside errors.

mod curve;
mod cut_edge;
mod fragments;
mod minified;
mod near_vertex;
mod planes;
mod sliver;
mod small;
mod span;
mod square;
mod stage;
mod tilt;
mod turns;
mod uneven;
mod wall;
mod work;

pub use curve::{Curve, Family, Law, Point};
pub use work::{Cost, Scene, Work};

/// How many random instances a point has in the tests and in the published figures; where each of
/// them has many pixels or results, a part of these.
pub const INSTANCES: usize = 1000;

/// All families.
pub const FAMILIES: [&Family; 23] = [
    &planes::U16,
    &planes::FLOAT,
    &planes::U32,
    &planes::U32_FACING,
    &planes::U32_PLACED,
    &tilt::S8_DEPTH,
    &sliver::U16,
    &sliver::U32,
    &near_vertex::S4,
    &near_vertex::S8,
    &cut_edge::S4,
    &cut_edge::S8,
    &span::U16,
    &span::U32,
    &turns::RANDOM,
    &turns::REPEATED,
    &turns::COMPOSED,
    &small::SIZE,
    &small::PLACE,
    &wall::STEPS,
    &minified::NEAREST,
    &minified::MIPMAPS,
    &uneven::TRILINEAR,
];
