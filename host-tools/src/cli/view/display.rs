//! The picture: its size, its precision, its depth and the colours that a display shows of it.

use clap::Args;
use host_tools::check::{Colors, DepthFormat, Display, Matrix, Subpixel, View};

use super::names::{choice, name};

/// The largest width and height of a picture: the core's own limit.
pub(in crate::cli) const MAX_SIZE: u32 = 2048;

const SUBPIXELS: [(&str, Subpixel); 2] = [("4", Subpixel::S4), ("8", Subpixel::S8)];

#[derive(Clone, Debug, Args)]
pub(super) struct DisplayOptions {
    /// Width and height of the picture in pixels, 1x1 to 2048x2048
    #[arg(long, value_name = "WxH", default_value = "320x240", value_parser = size)]
    size: [u32; 2],
    /// Fraction bits of a pixel coordinate
    #[arg(
        long,
        value_name = "BITS",
        default_value = name(&SUBPIXELS, View::default().subpixel),
        value_parser = choice(&SUBPIXELS)
    )]
    subpixel: Subpixel,
    /// Format of the depth buffer
    #[arg(
        long,
        value_name = "FORMAT",
        default_value = name(&DepthFormat::NAMES, View::default().depth),
        value_parser = choice(&DepthFormat::NAMES)
    )]
    depth: DepthFormat,
    /// The colours of the display, which shows the nearest of them
    #[arg(long, value_name = "FORMAT", value_parser = choice(&Colors::NAMES))]
    colors: Option<Colors>,
    /// Dither to them instead, by a matrix of this many rows
    #[arg(long, value_name = "ROWS", requires = "colors", value_parser = choice(&Matrix::NAMES))]
    dither: Option<Matrix>,
}

impl DisplayOptions {
    pub(super) fn over(&self, view: View) -> View {
        let Self { size, subpixel, depth, colors, dither } = *self;
        let display = colors.map(|colors| Display { colors, dither: dither.unwrap_or_default() });
        View { size, subpixel, depth, display, ..view }
    }
}

/// Width and height, as in 320x240.
pub(in crate::cli) fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse().ok().filter(|n| (1..=MAX_SIZE).contains(n));
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some([side(w)?, side(h)?]));
    sides.ok_or_else(|| {
        format!("write width x height in pixels, each from 1 to {MAX_SIZE}, as in 320x240")
    })
}
