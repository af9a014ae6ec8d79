//! What the firmware prints, and the figures that are made of it.

use anyhow::{Context as _, Result};
use serde::{Deserialize, Serialize};

use crate::{cores::Core, cost::Cost, per_core::PerCore};

/// A line of the firmware: sums over the frames, in units of the core's counter.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub(super) struct Line {
    pub(super) scene: String,
    precision: String,
    mode: String,
    #[serde(flatten)]
    cost: Cost,
}

impl Line {
    /// All that a program has printed, but for the first line.
    pub(super) fn all(lines: &[String]) -> Result<Vec<Self>> {
        let parse = |line: &String| {
            let line: Self = serde_json::from_str(line)
                .with_context(|| format!("the firmware has printed `{line}`, no figures"))?;
            line.cost.check()?;
            Ok(line)
        };
        lines.iter().skip(1).map(parse).collect()
    }

    pub(super) fn is_same_scene(&self, other: &Self) -> bool {
        (&self.scene, &self.precision, &self.mode) == (&other.scene, &other.precision, &other.mode)
    }
}

/// What a frame of a scene costs on a core: means over its frames, in instructions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Scene {
    pub(super) scene: String,
    /// S4 or S8: binary digits behind the point of a vertex's place.
    pub(super) precision: String,
    /// How the frame is drawn: as a whole, or in bands.
    pub(super) mode: String,
    /// All of it.
    pub(super) frame: u64,
    /// Setting depth to the far end.
    pub(super) clear: u64,
    /// Transforming, lighting and projecting vertices.
    pub(super) vertices: u64,
    /// Culling triangles, setting them up, and walking down their rows.
    pub(super) set_up: u64,
    /// What is left: depth test, interpolation, colour.
    pub(super) pixels: u64,
    pub(super) pixels_drawn: u64,
    pub(super) triangles_drawn: u64,
    /// Of the smallest rectangle that holds what this frame and the one before it show.
    pub(super) pixels_changed: u64,
}

impl Scene {
    pub(super) fn new(core: Core, line: &Line, set_up: &Line) -> Self {
        let cost = line.cost;
        Self {
            scene: line.scene.clone(),
            precision: line.precision.clone(),
            mode: line.mode.clone(),
            frame: cost.frame(core),
            clear: cost.clear(core),
            vertices: cost.vertices(core),
            set_up: set_up.cost.triangles_and_pixels(core),
            pixels: (cost.triangles_and_pixels(core))
                .saturating_sub(set_up.cost.triangles_and_pixels(core)),
            pixels_drawn: cost.pixels_drawn(),
            triangles_drawn: cost.triangles_drawn(),
            pixels_changed: cost.pixels_changed(),
        }
    }

    /// What tells it from the other scenes of a core.
    pub(super) fn key(&self) -> [&str; 3] {
        [&self.scene, &self.precision, &self.mode]
    }
}

/// All scenes of a core.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Scenes {
    pub(super) scenes: Vec<Scene>,
}

/// What `results/speed.json` holds.
pub(crate) type Speed = PerCore<Scenes>;

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::per_core;

    const FRAMES: &str = r#"{"scene":"cube-flat","precision":"S8","mode":"whole","frames":8,"clear":80,"vertices":16,"draw":800,"pixels_drawn":804,"triangles_drawn":44,"pixels_changed":1600}"#;

    /// Figures of one scene on one core.
    pub(in crate::speed) fn speed(core: Core, scene: &str, frame: u64) -> Speed {
        let scene = Scene {
            scene: scene.into(),
            precision: "S4".into(),
            mode: "whole".into(),
            frame,
            clear: 0,
            vertices: 1_000,
            set_up: 2_000,
            pixels: frame - 3_000,
            pixels_drawn: 5_000,
            triangles_drawn: 10,
            pixels_changed: 6_000,
        };
        per_core::tests::of(core, Scenes { scenes: vec![scene] })
    }

    #[test]
    fn a_scene_is_the_mean_of_its_frames_in_instructions() {
        let frames = Line::all(&["opt-level 3".into(), FRAMES.into()]).unwrap();
        let set_up = Line::all(&["opt-level 3".into(), FRAMES.replace("800", "300")]).unwrap();
        assert!(frames[0].is_same_scene(&set_up[0]));
        let scene = Scene::new(Core::M33, &frames[0], &set_up[0]);
        assert_eq!((scene.frame, scene.clear, scene.vertices), (5_600, 500, 100));
        assert_eq!((scene.set_up, scene.pixels), (1_875, 3_125));
        assert_eq!(
            (scene.pixels_drawn, scene.triangles_drawn, scene.pixels_changed),
            (101, 6, 200)
        );
        assert_eq!(scene.key(), ["cube-flat", "S8", "whole"]);
    }

    #[test]
    fn what_are_no_figures_is_quoted() {
        let of =
            |line: &str| Line::all(&["opt-level 3".into(), line.into()]).unwrap_err().to_string();
        assert!(of("panicked at src").contains("`panicked at src`"));
        assert!(of(&FRAMES.replace(r#""frames":8"#, r#""frames":0"#)).contains("nothing"));
    }
}
