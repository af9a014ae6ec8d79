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
    /// Show what is between two files of one model in two shapes: 0 is the first, 1 the second. As
    /// in 0..1, the frames of a turn go from one place to another and back
    #[arg(
        long,
        value_name = "T|T..T",
        value_parser = between,
        conflicts_with_all = ["stretch", "matrix"]
    )]
    between: Option<Form>,
}

impl FormOptions {
    pub(super) fn over(&self, view: View) -> View {
        let shaped = self.stretch.or(self.matrix).map(Form::Shaped);
        View { form: shaped.or(self.between).unwrap_or_default(), ..view }
    }

    /// Refuses what is between shapes that there are not, and a form for several models.
    pub(super) fn check(&self, files: usize, frames: u32) -> anyhow::Result<()> {
        let Some(form) = self.between else {
            anyhow::ensure!(
                files == 1 || self.stretch.or(self.matrix).is_none(),
                "--stretch and --matrix are for a picture of one model"
            );
            return Ok(());
        };
        anyhow::ensure!(
            files == 2,
            "--between is for one model in two shapes: name the files of both, as in up.obj down.obj"
        );
        let is_moving = matches!(form, Form::Between { progress, halfway } if progress != halfway);
        anyhow::ensure!(
            frames > 1 || !is_moving,
            "--between with two places is a motion: choose how many frames a turn has, as in \
             --frames 36"
        );
        Ok(())
    }
}

/// Three factors, as in 1,0.5,-1.
fn stretch(text: &str) -> Result<LinearMap, &'static str> {
    match numbers(text).as_deref() {
        Some(&[x, y, z]) => Ok(LinearMap { rows: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]] }),
        _ => Err("write three factors up to 32000, as in 1,0.5,-1"),
    }
}

/// A place between shapes, as in 0.5, or two, as in 0..1.
fn between(text: &str) -> Result<Form, &'static str> {
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let place = |text: &str| text.parse().ok().filter(|t| (0.0..=1.0).contains(t));
    let both = place(from).zip(place(to));
    both.map(|(progress, halfway)| Form::Between { progress, halfway })
        .ok_or("write a number from 0 to 1, as in 0.5, or two, as in 0..1")
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
