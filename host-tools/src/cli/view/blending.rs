//! How pixels are put onto the picture.

use clap::Args;
use host_tools::check::{BACKGROUND, Blending, View};

use super::names::{choice, name, within};

#[derive(Clone, Debug, Args)]
pub(super) struct BlendingOptions {
    /// How pixels are put onto the picture; all but replace draw every layer from back to front,
    /// with the opacity of the materials
    #[arg(
        long,
        value_name = "MODE",
        default_value = name(&Blending::NAMES, View::default().blending),
        value_parser = choice(&Blending::NAMES)
    )]
    blend: Blending,
    /// What the opacity of all materials is multiplied by with --blend, 0 to 1 in steps of 1/256
    #[arg(
        long,
        value_name = "PART",
        default_value_t = View::default().opacity,
        value_parser = within(0.0, 1.0),
        allow_negative_numbers = true
    )]
    opacity: f64,
}

impl BlendingOptions {
    pub(super) const fn over(&self, view: View) -> View {
        let Self { blend: blending, opacity } = *self;
        View { blending, opacity, background: BACKGROUND, ..view }
    }
}
