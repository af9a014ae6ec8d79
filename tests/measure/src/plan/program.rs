//! The program of a plan: its Rust file, and a function that draws one of its frames by number.

use std::{ffi::OsStr, fs, path::Path};

use anyhow::{Context as _, Result, ensure};
use host_tools::plan::{Study, View, Views};

use crate::{
    cores::Core,
    cycles::Timing,
    firmware,
    plugin::{self, Plugin},
    size::{image::Image, stack},
};

/// What a program takes on a core.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Measured {
    /// Bytes of flash, with those of the runtime.
    pub(super) flash: u32,
    /// Bytes of statics.
    pub(super) statics: u32,
    /// Bytes of stack.
    pub(super) stack: u32,
    /// Cycles of each frame.
    pub(super) cycles: Vec<u64>,
    /// Of what the display was sent.
    pub(super) checksum: u32,
}

/// The frames of a plan that are measured: for a list of views all of them, for a turntable eight
/// steps, and for an orbit its first eight views, which are random.
pub(super) fn frames(study: &Study) -> Vec<usize> {
    match &study.request.views {
        Views::Turntable { steps, .. } => {
            let count = (*steps).min(8);
            (0..count).map(|frame| (frame * (steps / count)) as usize).collect()
        }
        Views::List(views) => (0..views.len()).collect(),
        Views::Orbit { count } => (0..(*count).min(8) as usize).collect(),
    }
}

/// The source of the program: that of the plan, and the function.
pub(super) fn source(study: &Study, planned: &str) -> Result<String> {
    let frames = frames(study);
    ensure!(!frames.is_empty(), "a plan without views cannot be measured");
    let (argument, rotations) = match &study.request.views {
        Views::Turntable { .. } => (format!("frame * (STEPS / {})", frames.len()), String::new()),
        Views::List(_) => ("frame as usize".into(), String::new()),
        views @ Views::Orbit { .. } => {
            ("rotation(frame)".into(), rotations(&views.listed()[..frames.len()]))
        }
    };
    Ok(format!(
        "{planned}{rotations}
pub const FRAMES: u32 = {};

pub fn frame<D: DrawTarget<Color = Rgb565>>(
    display: &mut D,
    memory: &mut Memory,
    frame: u32,
) -> Result<(), Error<D::Error>> {{
    draw(display, memory, {argument})
}}
",
        frames.len()
    ))
}

/// The function of a frame's rotation, for views that the plan's own file does not know.
fn rotations(views: &[View]) -> String {
    let turns: String = (views.iter())
        .map(|view| view.turns().map(|turn| format!("Turn::from_bits({:#x})", turn.to_bits())))
        .map(|[y, x, z]| format!("    [{y}, {x}, {z}],\n"))
        .collect();
    format!(
        "
const VIEWS: [[Turn; 3]; {}] = [
{turns}];

fn rotation(frame: u32) -> Rotation {{
    let [y, x, z] = VIEWS[frame as usize % VIEWS.len()];
    Rotation::about_z(z) * Rotation::about_x(x) * Rotation::about_y(y)
}}
",
        views.len()
    )
}

/// Builds and measures the program in a file.
pub(super) fn run(
    (core, plugin, timing): (Core, &Plugin, &Timing),
    file: &Path,
) -> Result<Measured> {
    let program = firmware::build_planned(Some(core), file)?;
    let image = fs::read(&program).with_context(|| program.display().to_string())?;
    let image = Image::parse(&image)?;
    let run = stack::run(core, &program, &image)?;
    let loaded = [OsStr::new("-kernel"), program.as_os_str(), OsStr::new("-no-reboot")];
    let output = plugin.run_with(&program, plugin::marks(&program)?, &loaded)?;
    let cycles = output.reports.iter().map(|stages| timing.range(&stages.draw)[1]);
    Ok(Measured {
        flash: image.flash,
        statics: image.static_bytes(),
        stack: run.stack,
        cycles: cycles.collect(),
        checksum: run.checksum,
    })
}
