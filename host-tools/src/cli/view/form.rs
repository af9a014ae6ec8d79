//! What the model goes through before it is placed.

use clap::Args;
use host_tools::{
    check::{Form, View},
    reference::LinearMap,
};

use super::names::numbers;

#[derive(Clone, Debug, Args)]
pub(super) struct FormOptions {
    /// Stretch the model by a factor along each of its axes before it is turned; a negative one
    /// mirrors
    #[arg(long, value_name = "X,Y,Z", value_parser = stretch, allow_hyphen_values = true)]
    stretch: Option<LinearMap>,
    /// The same by the rows of a matrix, which may also shear
    #[arg(
        long,
        value_name = "A,B,C,D,E,F,G,H,I",
        value_parser = matrix,
        allow_hyphen_values = true,
        conflicts_with = "stretch"
    )]
    matrix: Option<LinearMap>,
}

impl FormOptions {
    pub(super) fn over(&self, view: View) -> View {
        let form = self.stretch.or(self.matrix).map_or(Form::AsModelled, Form::Shaped);
        View { form, ..view }
    }
}

/// Three factors, as in 1,0.5,-1.
fn stretch(text: &str) -> Result<LinearMap, &'static str> {
    match numbers(text).as_deref() {
        Some(&[x, y, z]) => Ok(LinearMap { rows: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]] }),
        _ => Err("write three factors up to 32000, as in 1,0.5,-1"),
    }
}

/// Nine entries, row by row.
fn matrix(text: &str) -> Result<LinearMap, &'static str> {
    match numbers(text).as_deref() {
        Some(&[a, b, c, d, e, f, g, h, i]) => {
            Ok(LinearMap { rows: [[a, b, c], [d, e, f], [g, h, i]] })
        }
        _ => Err("write the nine entries row by row, up to 32000, as in 1,0.5,0,0,1,0,0,0,1"),
    }
}
