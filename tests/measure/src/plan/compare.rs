//! A plan beside what is measured of it.

use std::{fs, path::Path, process::Command};

use anyhow::{Context as _, Result, ensure};
use host_tools::{
    model::{Options, write_atomically},
    plan::{Candidate, Costs, Filter, Paint, Plan, Study, Vertices},
};
use serde::{Deserialize, Serialize};

use super::{program, scenes::Scene};
use crate::{cores::Core, cycles::Timing, firmware, plugin::Plugin};

/// What is compared of a renderer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Figures {
    /// Bytes of flash: code and tables.
    pub(super) flash: u32,
    /// Bytes of buffers and stack.
    pub(super) ram: u32,
    /// Cycles of a frame, the mean of those that are measured.
    pub(super) cycles: f64,
}

/// A scene's plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Compared {
    pub(super) scene: String,
    pub(super) core: host_tools::plan::Core,
    pub(super) display: [u32; 2],
    pub(super) ram_bytes: u32,
    pub(super) views: usize,
    /// The renderer in words.
    pub(super) renderer: String,
    pub(super) predicted: Figures,
    pub(super) measured: Figures,
    /// The one with everything on.
    pub(super) everything: Figures,
    /// Pixels that differ from those of that one, in the worst frame, as a part of those that show
    /// the model.
    pub(super) different: f64,
}

/// How far measured bytes may lie from predicted ones.
pub(super) const MOST_BYTES: f64 = 0.10;

/// How far measured cycles may lie from predicted ones.
pub(super) const MOST_CYCLES: f64 = 0.15;

impl Compared {
    /// How far flash, RAM and cycles are off what was predicted.
    pub(super) fn errors(&self) -> [f64; 3] {
        let off = |measured: f64, predicted: f64| measured / predicted - 1.0;
        let (measured, predicted) = (&self.measured, &self.predicted);
        [
            off(measured.flash.into(), predicted.flash.into()),
            off(measured.ram.into(), predicted.ram.into()),
            off(measured.cycles, predicted.cycles),
        ]
    }

    /// Whether figures and picture are those of the plan.
    pub(super) fn is_good(&self) -> bool {
        let [flash, ram, cycles] = self.errors().map(f64::abs);
        flash <= MOST_BYTES
            && ram <= MOST_BYTES
            && cycles <= MOST_CYCLES
            && self.different <= MOST_DIFFERENT
    }

    /// Plans a scene, and measures the plan and the renderer with everything on.
    pub(super) fn of(
        scene: &Scene,
        costs: &Costs,
        (core, plugin): (Core, &Plugin),
        runtime: [u32; 2],
        folder: &Path,
    ) -> Result<Self> {
        let study = Study::new(&scene.file, &Options::default(), &scene.request, |_| ())?;
        let plan = study.plan(costs)?;
        let timing = Timing::of(core).context("the core has no table of its timing")?;
        let measure = |name: &str, source: &str| {
            let file = folder.join(format!("{}_{name}.rs", scene.name));
            write_atomically(&file, program::source(&study, source)?)?;
            let measured = program::run((core, plugin, &timing), &file)?;
            let pictures = pictures(&file, folder, &study, measured.checksum)?;
            let cycles = measured.cycles.iter().sum::<u64>() as f64 / measured.cycles.len() as f64;
            let figures = Figures {
                flash: measured.flash - runtime[0],
                // The checksum of the harness and its marks are no part of the plan.
                ram: measured.statics - HARNESS_BYTES + measured.stack.saturating_sub(runtime[1]),
                cycles,
            };
            Ok::<_, anyhow::Error>((figures, pictures))
        };
        let (measured, drawn) = measure("planned", &plan.source)?;
        let (Candidate { types, rows }, _) = plan.everything;
        let (everything, expected) = measure("everything", &study.source(&types, rows)?)?;
        let width = study.request.display[0] as usize;
        let different = drawn.iter().zip(&expected).map(|(a, b)| different(a, b, width));
        Ok(Self {
            scene: scene.name.into(),
            core: study.request.core,
            display: study.request.display,
            ram_bytes: study.request.ram_bytes,
            views: study.work.len(),
            renderer: renderer(&plan),
            predicted: predicted(&plan, &study),
            measured,
            everything,
            different: different.fold(0.0, f64::max),
        })
    }
}

/// The statics of the program beside the memory of the plan: a checksum, and four marks.
const HARNESS_BYTES: u32 = 20;

/// What is predicted of the frames that are measured.
fn predicted(plan: &Plan, study: &Study) -> Figures {
    let frames = program::frames(study);
    let sum: f64 = frames.iter().map(|&frame| plan.cycles[frame]).sum();
    Figures {
        flash: plan.predicted.flash_bytes(),
        ram: plan.predicted.ram_bytes(),
        cycles: sum / frames.len() as f64,
    }
}

/// The choices in a few words.
fn renderer(plan: &Plan) -> String {
    let choice = |about: &str| {
        let found = plan.decisions.iter().find(|decision| decision.about == about);
        found.map(|decision| decision.choice.clone())
    };
    let light = choice("light").map(|light| format!("light {light}"));
    let is_stored = plan.chosen.types.vertices == Vertices::Stored;
    let vertices = choice("vertices").filter(|_| !is_stored);
    // Of textures the palette, and another filter than the simplest.
    let (texels, filter) = match plan.chosen.types.paint {
        Paint::Textures(_, texels, filter) => (
            Some(texels.title().to_owned()),
            (filter != Filter::NEAREST).then(|| filter.title().to_owned()),
        ),
        Paint::Materials | Paint::Vertices => (None, None),
    };
    let (visibility, perspective) = (choice("visibility"), choice("perspective"));
    let parts = [visibility, light, perspective, texels, filter, choice("memory"), vertices];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// Draws the frames on the host.
fn pictures(file: &Path, folder: &Path, study: &Study, checksum: u32) -> Result<Vec<Vec<u8>>> {
    let program = firmware::build_planned(None, file)?;
    let printed = firmware::output_of(Command::new(program).env("PICTURES", folder))?;
    ensure!(
        printed == format!("{checksum:08x}"),
        "{}: the host shows other pictures than the core: {printed} and {checksum:08x}",
        file.display()
    );
    let read = |frame: usize| {
        let path = folder.join(format!("planned-{frame}.rgb"));
        fs::read(&path).with_context(|| path.display().to_string())
    };
    (0..program::frames(study).len()).map(read).collect()
}

/// A channel of a pixel may be off by two steps of five bits: light is rounded to 64 levels in both
/// pictures, and in one of them may be that of triangles.
const MOST_STEPS: u8 = 17;

/// The part of the pixels that may be off by more: as many as may show a wrong surface, and those
/// where an edge of a sixteenth of a pixel is another one than of a 256th.
pub(super) const MOST_DIFFERENT: f64 = 0.005;

/// The pixels that have another colour than the model has anywhere in the square of 3 by 3 around
/// them, as a part of those that show it. Edges may move by a part of a pixel, and textures by half
/// a texel.
fn different(drawn: &[u8], expected: &[u8], width: usize) -> f64 {
    let height = expected.len() / 3 / width;
    let (mut different, mut shown) = (0_usize, 0_usize);
    for (place, pixel) in drawn.chunks_exact(3).enumerate() {
        let [x, y] = [place % width, place / width];
        let at = |x: usize, y: usize| &expected[3 * (y * width + x)..][..3];
        shown += usize::from(at(x, y).iter().any(|&channel| channel > 0));
        let around = (y.saturating_sub(1)..(y + 2).min(height))
            .flat_map(|y| (x.saturating_sub(1)..(x + 2).min(width)).map(move |x| (x, y)));
        let is_within = (0..3).all(|channel| {
            let values = around.clone().map(|(x, y)| at(x, y)[channel]);
            let [least, most] = values.fold([u8::MAX, 0], |[a, b], v| [a.min(v), b.max(v)]);
            (least.saturating_sub(MOST_STEPS)..=most.saturating_add(MOST_STEPS))
                .contains(&pixel[channel])
        });
        different += usize::from(!is_within);
    }
    different as f64 / shown.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_may_have_a_colour_of_its_neighbours() {
        // A white square of 4 by 4 on 8 by 8 pixels.
        let square = |left: usize| -> Vec<u8> {
            let is_white = |place: usize| {
                (left..left + 4).contains(&(place % 8)) && (2..6).contains(&(place / 8))
            };
            (0..64).flat_map(|place| [if is_white(place) { 255 } else { 0 }; 3]).collect()
        };
        assert_eq!(different(&square(2), &square(2), 8), 0.0);
        assert_eq!(different(&square(3), &square(2), 8), 0.0);
        // Two columns farther, the middle of a column is black in the middle of white, and the last
        // one is white before nothing but black.
        assert_eq!(different(&square(4), &square(2), 8), (2.0 + 4.0) / 16.0);
    }
}
