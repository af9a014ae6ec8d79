//! The numbers everything else is made of.

mod scale;
mod vector;

pub use scale::Scale;
pub use vector::{Scalar, Vec3};
