//! Converts OBJ files to const tables, and judges the fixed-point picture by an f64 reference.

pub mod check;
pub mod model;
pub mod reference;
