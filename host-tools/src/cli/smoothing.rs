//! The option for computed normals.

use clap::Args;
use host_tools::model::Options;

use super::view::within;

/// How normals are computed where the file has none.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct Smoothing {
    /// Up to this angle between two faces, a computed normal is smooth across their edge [default:
    /// the file's smoothing groups decide (`s 1` is smooth, `s off` is flat); 60 where no `s`
    /// precedes a face]
    #[arg(
        long,
        value_name = "DEGREES",
        value_parser = within(0.0, 180.0),
        allow_negative_numbers = true
    )]
    crease: Option<f64>,
}

impl Smoothing {
    /// The options of a conversion.
    pub(super) fn options(self) -> Options {
        self.crease.map_or_else(Options::default, |crease_degrees| Options {
            crease_degrees,
            smoothing_groups: false,
            ..Options::default()
        })
    }
}
