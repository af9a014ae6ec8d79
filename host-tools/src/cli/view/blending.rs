//! How pixels are put onto the picture.

use clap::Args;
use host_tools::{
    check::{BACKGROUND, Blending, FadeAlong, View},
    reference::Blend,
};

use super::names::{choice, name, within};

#[derive(Clone, Debug, Args)]
pub(super) struct BlendingOptions {
    /// How pixels are put onto the picture; all but replace draw every layer from back to front,
    /// with the opacity of the materials, or by painter without it
    #[arg(
        long,
        value_name = "MODE",
        default_value = name(&Blending::NAMES, View::default().blending),
        value_parser = choice(&Blending::NAMES)
    )]
    blend: Blending,
    /// The same as --blend painter: triangles from back to front in place of a depth buffer, with
    /// the faults that this order has
    #[arg(long, conflicts_with = "blend")]
    painter: bool,
    /// What the opacity of all materials is multiplied by with --blend, 0 to 1 in steps of 1/256
    #[arg(
        long,
        value_name = "PART",
        default_value_t = View::default().opacity,
        value_parser = within(0.0, 1.0),
        allow_negative_numbers = true
    )]
    opacity: f64,
    /// Along which axis of the model pixels fade with --blend: opaque at its lower end, clear at
    /// the upper one, by an alpha of each vertex
    #[arg(
        long,
        value_name = "AXIS",
        default_value = name(&FadeAlong::NAMES, View::default().fade),
        value_parser = choice(&FadeAlong::NAMES)
    )]
    fade: FadeAlong,
}

impl BlendingOptions {
    pub(super) const fn over(&self, view: View) -> View {
        let Self { blend, painter, opacity, fade } = *self;
        let blending = if painter { Blending::By(Blend::Replace) } else { blend };
        View { blending, opacity, fade, background: BACKGROUND, ..view }
    }
}
