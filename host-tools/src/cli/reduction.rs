//! The option for fewer triangles.

use clap::Args;

/// How many triangles are left.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct Reduction {
    /// Reduce the model to at most this many triangles. The report of `convert` says how far its
    /// surface moves. Seams of textures, sharp edges and borders of materials are kept as long as
    /// that many can be reached with them
    #[arg(long, value_name = "TRIANGLES", value_parser = most)]
    pub(super) simplify: Option<usize>,
}

/// A number of triangles.
fn most(text: &str) -> Result<usize, &'static str> {
    text.parse().ok().filter(|&most| most > 0).ok_or("it must be a whole number from 1 on")
}
