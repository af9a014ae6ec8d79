//! The points of the diagrams: a choice, its error and its cost.

use std::collections::HashMap;

use anyhow::{Context as _, Result};
use host_tools::check::{TrueModel, Truth};
use indicatif::ProgressBar;
use serde::{Deserialize, Serialize};

use super::{
    choices::{Arithmetic, Choice},
    errors::{self, Errors, Picture},
    front::front,
    narrow::{self, Narrow},
    run::{Drawn, Programs},
    scenes::Scene,
    split::{self, Split, Texels},
};
use crate::{conditions::Conditions, cores::Core, cost, cycles::timing::Timing, plugin::Plugin};

/// What a frame of a choice costs on a core: means over the frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Cost {
    pub(super) core: Core,
    pub(super) instructions: u64,
    /// By the core's timing table, if there is one that has all instructions: the least, the
    /// figure that is compared, and the most of its models in memory without waiting.
    pub(super) cycles: Option<[u64; 3]>,
}

impl Cost {
    /// What is compared: cycles, or instructions on a core without a timing table. `None` where
    /// there is one that lacks instructions of the program.
    pub(super) fn figure(&self) -> Option<u64> {
        match self.cycles {
            Some([_, cycles, _]) => Some(cycles),
            None => Timing::of(self.core).is_none().then_some(self.instructions),
        }
    }
}

/// A choice with its error and its cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Point {
    pub(super) choice: Choice,
    pub(super) errors: Errors,
    /// How it changes otherwise than exact pictures of as many samples a pixel while the scene
    /// moves by a 64th of a pixel, by [`errors::shimmer`].
    pub(super) shimmer: f64,
    /// FLIP's mean error over all pixels of all frames, from 0 to 1, by the feature `flip`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) flip: Option<f64>,
    /// Nanoseconds of a frame on the host: the least, the median and the most of several runs.
    pub(super) nanoseconds: [u64; 3],
    pub(super) costs: Vec<Cost>,
}

impl Point {
    pub(super) fn cost(&self, core: Core) -> Option<&Cost> {
        self.costs.iter().find(|cost| cost.core == core)
    }

    /// The cost on a core, or in nanoseconds on the host.
    pub(super) fn figure(&self, core: Option<Core>) -> Option<u64> {
        match core {
            Some(core) => self.cost(core)?.figure(),
            None => Some(self.nanoseconds[1]),
        }
    }
}

/// All that is known of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Measured {
    pub(super) scene: Scene,
    /// How far the true picture is off one of four times as many samples, in the same unit as the
    /// errors. A smaller error is not significant.
    pub(super) reference_rms: f64,
    pub(super) points: Vec<Point>,
    pub(super) splits: Vec<Split>,
    pub(super) texels: Vec<Texels>,
    #[serde(default)]
    pub(super) narrow: Vec<Narrow>,
}

/// Steps of progress for a scene: pictures, the reference, causes, and the choices on each core.
pub(super) fn steps(scene: &Scene, cores: usize) -> usize {
    3 + scene.choices().len() * cores
}

/// Samples along a side of a pixel of the true picture.
pub(super) const TRUE_SAMPLES: usize = 8;

impl Measured {
    /// The choices of the library that no other one beats on a core, or on the host: from the
    /// cheapest to the most exact.
    pub(super) fn front(&self, core: Option<Core>) -> Vec<&Point> {
        let place = |point: &Point| {
            let figure = point.figure(core).map_or(f64::INFINITY, |figure| figure as f64);
            [figure, point.errors.rms]
        };
        let is_of_library = |point: &&Point| point.choice.arithmetic == Arithmetic::Fixed;
        let points: Vec<_> = self.points.iter().filter(is_of_library).collect();
        let places: Vec<_> = points.iter().map(|&point| place(point)).collect();
        front(&places).into_iter().map(|place| points[place]).collect()
    }

    /// Draws a scene by all choices, and counts on the cores.
    ///
    /// # Errors
    ///
    /// Returns an error if something cannot be converted, built or run.
    pub(super) fn of(
        scene: Scene,
        cores: &[Core],
        progress: &ProgressBar,
    ) -> Result<(Self, Vec<(Core, Conditions)>)> {
        let step = |what: &str| {
            progress.inc(1);
            progress.set_message(format!("{what} of {}", scene.name));
        };
        step("pictures");
        let choices = scene.choices();
        let programs = Programs::new(&scene, &choices)?;
        let drawn = programs.on_host(&choices)?;
        step("reference");
        let model = scene.true_model()?;
        let exact = TrueModel::new(&model);
        let truth = |frame, side| exact.picture(&scene.view(frame), side);
        let truths: Vec<Truth> = (0..scene.frames).map(|i| truth(i, TRUE_SAMPLES)).collect();
        let moved = |side: u32| -> Vec<[Truth; 2]> {
            let views = (0..scene.frames).map(|i| [scene.view(i), scene.shifted_view(i)]);
            views.map(|views| views.map(|view| exact.picture(&view, side as usize))).collect()
        };
        let mut by_samples: HashMap<u32, Vec<[Truth; 2]>> = HashMap::new();
        for choice in &choices {
            by_samples.entry(choice.samples).or_insert_with(|| moved(choice.samples));
        }
        let reference_rms = errors::between(&truth(0, 2 * TRUE_SAMPLES), &truths[0]);
        let points = choices.into_iter().map(|choice| {
            let drawn = drawn.get(&choice.name()).context("a choice is not drawn")?;
            let errors = Errors::of(drawn.frames.iter().zip(&truths));
            let pictures = drawn.frames.iter().zip(&drawn.shifted).map(|(a, b)| [a, b]);
            let exact = by_samples[&choice.samples].iter().map(|[a, b]| [a, b]);
            let times = &drawn.nanoseconds;
            Ok(Point {
                choice,
                errors: errors.with_context(|| format!("{} shows nothing", scene.name))?,
                flip: flip(drawn.frames.iter().zip(&truths)),
                shimmer: errors::shimmer(pictures.zip(exact)),
                nanoseconds: [times[0], times[times.len() / 2], times[times.len() - 1]],
                costs: Vec::new(),
            })
        });
        let mut points = points.collect::<Result<Vec<_>>>()?;
        step("causes of errors");
        let tables = scene.model()?;
        let (splits, texels) = (split::geometry(&scene, &tables)?, split::texels(&scene, &tables)?);
        let narrow = narrow::of(&scene, &tables, &truths)?;
        let mut conditions = Vec::new();
        for &core in cores {
            conditions.push((core, count(&programs, core, &mut points, &drawn, progress)?));
        }
        Ok((Self { scene, reference_rms, points, splits, texels, narrow }, conditions))
    }
}

#[cfg(feature = "flip")]
fn flip<'a>(frames: impl IntoIterator<Item = (&'a Picture, &'a Truth)>) -> Option<f64> {
    Some(super::flip::mean(frames))
}

#[cfg(not(feature = "flip"))]
fn flip<'a>(_: impl IntoIterator<Item = (&'a Picture, &'a Truth)>) -> Option<f64> {
    None
}

/// Counts each choice in a program of its own. In one for all, the compiler inlines less of what
/// they share, and some take up to 30 % more.
fn count(
    programs: &Programs<'_>,
    core: Core,
    points: &mut [Point],
    drawn: &HashMap<String, Drawn>,
    progress: &ProgressBar,
) -> Result<Conditions> {
    let plugin = Plugin::build(core)?;
    let mut last = None;
    for point in points {
        let name = point.choice.name();
        progress.inc(1);
        progress.set_message(format!("{name} of {} on {}", programs.scene.name, core.title()));
        let counted = programs.on_core(&plugin, core, point.choice, drawn)?;
        let mean = |sum| cost::mean(sum, counted.frames);
        let timing = Timing::of(core).filter(|timing| timing.covers(&counted.counts));
        let cycles = timing.map(|timing| timing.range(&counted.counts).map(mean));
        point.costs.push(Cost { core, instructions: mean(counted.counts.instructions), cycles });
        last = Some(counted.conditions);
    }
    last.with_context(|| format!("{} has no choices", programs.scene.name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::scenes;

    #[test]
    fn instructions_stand_in_for_cycles_only_where_there_is_no_timing_table() {
        let figure = |core, cycles| Cost { core, instructions: 5, cycles }.figure();
        assert_eq!(figure(Core::M4, Some([6, 7, 8])), Some(7));
        assert_eq!(figure(Core::M7, None), Some(5));
        assert_eq!(figure(Core::M33, None), None);
    }

    #[test]
    fn what_is_drawn_for_comparison_is_not_on_the_front() {
        let scene = Scene::of(&scenes::shipped()[0], 1).unwrap();
        let point = |choice: Choice| {
            let rms = if choice.arithmetic == Arithmetic::Fixed { 2.0 } else { 1.0 };
            let errors = Errors { rms, rms_inside: rms, rms_squares: rms, p999: rms, max: rms };
            Point {
                choice,
                errors,
                shimmer: 0.0,
                flip: None,
                nanoseconds: [1; 3],
                costs: Vec::new(),
            }
        };
        let points: Vec<_> = scene.choices().into_iter().map(point).collect();
        assert!(points.iter().any(|point| point.errors.rms < 2.0));
        let (splits, texels, narrow) = (Vec::new(), Vec::new(), Vec::new());
        let measured = Measured { scene, reference_rms: 0.0, points, splits, texels, narrow };
        let front = measured.front(None);
        assert_eq!(front.len(), 1);
        assert_eq!(front[0].errors.rms, 2.0);
    }
}
