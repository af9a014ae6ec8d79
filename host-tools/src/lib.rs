//! From an OBJ file to const tables, and the f64 reference that judges the fixed-point picture.

pub mod check;
pub mod model;
pub mod reference;
