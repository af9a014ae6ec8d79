//! Converts OBJ files to const tables, and judges the fixed-point picture by an f64 reference.

#[cfg(feature = "check")]
pub mod check;
pub mod model;
#[cfg(feature = "plan")]
pub mod plan;
#[cfg(any(feature = "check", test))]
pub mod reference;
#[cfg(feature = "check")]
pub mod stiffness;
