//! Textures.

mod coordinates;
mod wrap;

pub use coordinates::{CoordinateFormat, Coordinates, Place};
pub use wrap::{Clamp, MAX_SIDE, Mirror, Pair, Repeat, Side, Wrap};
