//! What a scene needs, and what it can leave out.
//!
//! A [`Study`] looks at a model in the views that it will be seen from. It finds out which ways to
//! decide visibility show the right surfaces, whether perspective can be seen in textures, whether
//! light of triangles is enough, and whether anything is ever clipped. [`Study::plan`] then takes,
//! of all renderers that are right, the one with the least time that fits the memory, by the costs
//! that were [measured](Costs); and [`Plan::source`] is the Rust file of it.
//!
//! What is decided holds for the views of the [`Request`]. Some of it is proven for all views at
//! that distance, some of it in each view of a turntable or a list, and some in a random sample:
//! each [`Decision`] says which.

mod arcs;
mod choose;
mod convex;
mod costs;
mod decide;
mod divided;
mod order;
#[cfg(test)]
mod order_tests;
mod paint;
mod partition;
mod predict;
mod request;
mod sampled;
mod seen;
mod slivers;
mod source;
mod study;
#[cfg(test)]
mod tests;
mod texels;
mod types;
mod views;

pub use choose::Plan;
pub use convex::{Shape, shape};
pub use costs::{Cost, Costs, Load};
pub use decide::{Decision, Other};
pub use divided::Divided;
pub use paint::{Correction, Filter, LevelChoice, Paint, Texels};
pub use predict::{Candidate, Fault, Predicted};
pub use request::{Core, Request};
pub use seen::Work;
pub use slivers::Slivers;
pub use study::{Study, Worst};
pub use types::{Types, Vertices, Visibility};
pub use views::{View, Views};

use crate::{check::ViewError, model::ModelError};

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The model cannot be converted.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The model has no faces.
    #[error("{0} has no faces to plan for: lines and points alone need no depth and no light")]
    NoFaces(String),
    /// The camera is inside the sphere around the model.
    #[error(
        "the camera is {distance} from the origin, within the sphere of radius {radius:.3} around \
         the model: choose a larger distance"
    )]
    Inside {
        /// The camera's distance.
        distance: f64,
        /// The sphere's radius.
        radius: f64,
    },
    /// The core refuses the model in a view.
    #[error(transparent)]
    View(#[from] ViewError),
    /// No renderer fits.
    #[error(
        "no renderer fits {ram} bytes of RAM{}: the smallest takes {least_ram} bytes of RAM and \
         {least_flash} of flash{}",
        flash.map_or(String::new(), |flash| format!(" and {flash} bytes of flash")),
        if *has_mip_levels { "; textures without mip levels take less" } else { "" }
    )]
    TooLarge {
        /// The RAM that there is.
        ram: u32,
        /// The flash that there is.
        flash: Option<u32>,
        /// The RAM of the renderer with the least.
        least_ram: u32,
        /// The flash of the renderer with the least.
        least_flash: u32,
        /// Whether textures have mip levels.
        has_mip_levels: bool,
    },
}

/// The heights of bands that are considered for a display of this height, the largest first: those
/// that divide it into more and more bands, down to four rows.
#[must_use]
pub fn band_rows(height: u32) -> Vec<u32> {
    let mut rows: Vec<u32> = (1..=height.div_ceil(4)).map(|bands| height.div_ceil(bands)).collect();
    rows.dedup();
    rows
}
