//! The figures of bench scenes, and their table.

use anyhow::{Context as _, Result};
use serde::{Deserialize, Serialize};

use super::goals::{self, Goal};
use crate::{
    cores::Core,
    cost::{self, Line},
    figures::{Figures, PerCore, count},
    table::{Column, Table},
};

/// Tells a scene from the others of a core.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Key {
    pub(super) scene: String,
    /// S4 or S8: the number of fraction bits of a vertex's place.
    pub(super) precision: String,
    /// How the frame is drawn: as a whole, or in bands.
    pub(super) mode: String,
}

/// The cost of a frame of a scene on a core: means over its frames, in instructions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Scene {
    #[serde(flatten)]
    pub(super) key: Key,
    /// The whole frame.
    pub(super) frame: u64,
    pub(super) clear: u64,
    pub(super) vertices: u64,
    /// Culling triangles, setting them up, and walking down their rows.
    pub(super) set_up: u64,
    /// The remainder: depth test, interpolation, colour.
    pub(super) pixels: u64,
    pub(super) pixels_drawn: u64,
    pub(super) triangles_drawn: u64,
    pub(super) pixels_changed: u64,
}

impl Scene {
    fn new(core: Core, line: Line<Key>, set_up: &Line<Key>) -> Self {
        let Line { key, cost } = line;
        let set_up = set_up.cost.instructions(core, set_up.cost.draw);
        Self {
            key,
            frame: cost.instructions(core, cost.clear + cost.vertices + cost.draw),
            clear: cost.instructions(core, cost.clear),
            vertices: cost.instructions(core, cost.vertices),
            set_up,
            pixels: cost.instructions(core, cost.draw).saturating_sub(set_up),
            pixels_drawn: cost.mean(cost.pixels_drawn),
            triangles_drawn: cost.mean(cost.triangles_drawn),
            pixels_changed: cost.mean(cost.pixels_changed),
        }
    }

    /// Parses the lines of a program and of the one that measures its set-up alone.
    pub(super) fn all(core: Core, frames: &[String], set_up: &[String]) -> Result<Vec<Self>> {
        let set_ups: Vec<Line<Key>> = cost::lines(set_up)?;
        let scene = |line: Line<Key>| {
            let set_up = set_ups.iter().find(|set_up| set_up.key == line.key);
            let set_up = set_up.with_context(|| format!("there is no set-up of {:?}", line.key))?;
            Ok(Self::new(core, line, set_up))
        };
        cost::lines(frames)?.into_iter().map(scene).collect()
    }
}

/// The scenes of a core.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Scenes {
    pub(super) scenes: Vec<Scene>,
}

/// The contents of `results/speed.json`.
pub(crate) type Speed = PerCore<Scenes>;

/// A scene, and its goal if it has one.
type Row<'a> = (&'a Scene, Option<Goal>);

impl Figures for Scenes {
    const FILE: &str = "speed.json";
    const TITLE: &str = "Speed";
    /// Each bench program before the one that measures its set-up alone.
    const PROGRAMS: &[&str] = &["bench", "bench_set_up", "bench_frugal", "bench_frugal_set_up"];

    const LEGEND: &str = "\
Instructions for a frame of 320 x 240 in `Rgb565Be`, the mean of eight: *clear* sets depth to the
far end, *vertices* transforms, lights and projects them, *set-up* culls triangles, sets them up
and walks down their rows, *pixels* is the rest: depth test, interpolation, colour. *drawn* counts
the pixels that the finished frame covers. *changed* counts those of the rectangle that holds what
this frame and the one before it show: of 76,800, only they have to be sent to a display that
shows the frame before. *bits* is the precision of vertices: S4 is a sixteenth of a pixel, S8 a
256th. Bands keep vertices, and bins of triangles, from the first band to the last; with *alone*
only one of the two is kept. Vertices that are not kept are computed in *set-up*, when a triangle
needs them. The figures are instructions, not cycles: wait states, divisions and taken branches
count as one each. *small3dlib* 0.905d was measured in the same way; it has no sub-pixels and no
light.";

    fn parse(core: Core, outputs: &[Vec<String>]) -> Result<Self> {
        let mut scenes = Vec::new();
        for pair in outputs.chunks_exact(2) {
            scenes.extend(Scene::all(core, &pair[0], &pair[1])?);
        }
        Ok(Self { scenes })
    }

    fn tables(&self, core: Core) -> Vec<(&'static str, Table)> {
        let columns: [Column<Row<'_>>; 15] = [
            ("scene", |(scene, _)| scene.key.scene.clone()),
            ("bits", |(scene, _)| scene.key.precision.clone()),
            ("mode", |(scene, _)| scene.key.mode.clone()),
            ("frame", |(scene, _)| count(scene.frame)),
            ("/ pixel", |(scene, _)| format!("{:.1}", share(scene, scene.pixels_drawn))),
            ("/ triangle", |(scene, _)| count(share(scene, scene.triangles_drawn).round() as u64)),
            ("clear", |(scene, _)| count(scene.clear)),
            ("vertices", |(scene, _)| count(scene.vertices)),
            ("set-up", |(scene, _)| count(scene.set_up)),
            ("pixels", |(scene, _)| count(scene.pixels)),
            ("drawn", |(scene, _)| count(scene.pixels_drawn)),
            ("changed", |(scene, _)| count(scene.pixels_changed)),
            ("small3dlib", |(_, goal)| goal.map_or_else(String::new, |goal| count(goal.rival))),
            ("target", |(_, goal)| goal.map_or_else(String::new, |goal| count(goal.target))),
            ("met", |(scene, goal)| match goal.map(|goal| goal.is_met(scene)) {
                Some(true) => "yes".into(),
                Some(false) => "no".into(),
                None => String::new(),
            }),
        ];
        let rows = self.scenes.iter().map(|scene| (scene, goals::of(core, &scene.key)));
        vec![("", Table::of(3, &columns, rows))]
    }
}

/// Instructions for each of the things drawn.
fn share(scene: &Scene, drawn: u64) -> f64 {
    scene.frame as f64 / drawn.max(1) as f64
}

#[cfg(test)]
pub(super) mod tests {
    use serde_json::json;

    use super::*;
    use crate::{cost::tests::line, figures};

    fn key(scene: &str) -> Key {
        Key { scene: scene.into(), precision: "S4".into(), mode: "whole".into() }
    }

    /// Figures of one scene on one core.
    pub(in crate::speed) fn speed(core: Core, scene: &str, frame: u64) -> Speed {
        let scene = Scene {
            key: key(scene),
            frame,
            clear: 0,
            vertices: 1_000,
            set_up: 2_000,
            pixels: frame - 3_000,
            pixels_drawn: 5_000,
            triangles_drawn: 10,
            pixels_changed: 6_000,
        };
        figures::tests::of(core, Scenes { scenes: vec![scene] })
    }

    #[test]
    fn a_scene_is_the_mean_of_its_frames_in_instructions() {
        let line = |scene, draw| vec![String::new(), line(json!(key(scene)), 80, 16, draw)];
        let parse = |set_up| Scene::all(Core::M33, &line("cube", 800), &line(set_up, 300));
        let scene = parse("cube").unwrap().remove(0);
        assert_eq!(scene.key, key("cube"));
        assert_eq!((scene.frame, scene.clear, scene.vertices), (5_600, 500, 100));
        assert_eq!((scene.set_up, scene.pixels), (1_875, 3_125));
        assert_eq!(
            (scene.pixels_drawn, scene.triangles_drawn, scene.pixels_changed),
            (101, 6, 200)
        );
        assert!(parse("ball").unwrap_err().to_string().contains("cube"));
    }

    /// The cells of a table's row.
    pub(in crate::speed) fn cells(line: &str) -> Vec<&str> {
        line.trim_matches('|').split('|').map(str::trim).collect()
    }

    #[test]
    fn the_table_shows_whether_the_target_is_met() {
        let last = |core, frame| {
            let text = speed(core, "cube-flat", frame).tables();
            cells(text.lines().last().unwrap()).join(" ")
        };
        let expected = "cube-flat S4 whole 110,000 22.0 11,000 0 1,000 2,000 107,000 5,000 6,000 \
                        160,000 110,000 yes";
        assert_eq!(last(Core::M0plus, 110_000), expected);
        assert!(last(Core::M0plus, 110_001).ends_with(" 110,000 no"));
        assert!(last(Core::M7, 5_000).ends_with(" 5,000 6,000   "));
    }
}
