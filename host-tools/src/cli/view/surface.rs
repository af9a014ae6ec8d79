//! How triangles are coloured, and what they take from their textures.

use clap::Args;
use host_tools::check::{Correction, Filter, Shading, View};

use super::names::{choice, name};

#[derive(Clone, Debug, Args)]
pub(super) struct SurfaceOptions {
    /// How triangles are coloured [default: textured-gouraud if the model has textures,
    /// colored-gouraud if its vertices have colours, otherwise gouraud]
    #[arg(long, value_parser = choice(&Shading::NAMES))]
    shading: Option<Shading>,
    /// Where texture coordinates are divided: nowhere, at every pixel, at every N-th, or as often
    /// as half a texel needs it
    #[arg(
        long,
        value_name = "MODE",
        default_value = name(&Correction::NAMES, View::default().perspective),
        value_parser = choice(&Correction::NAMES)
    )]
    perspective: Correction,
    /// How a colour is taken from a texture; mipmap and trilinear make its mip levels
    #[arg(
        long,
        default_value = name(&Filter::NAMES, View::default().filter),
        value_parser = choice(&Filter::NAMES)
    )]
    pub(super) filter: Filter,
}

impl SurfaceOptions {
    /// In the shading `otherwise` unless one is chosen.
    pub(super) fn over(&self, view: View, otherwise: Shading) -> View {
        let Self { shading, perspective, filter } = *self;
        View { shading: shading.unwrap_or(otherwise), perspective, filter, ..view }
    }
}
