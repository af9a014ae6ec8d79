//! The figures of bench scenes, and their table.

use anyhow::{Context as _, Result};
use serde::{Deserialize, Serialize};

use super::goals::{self, Goal};
use crate::{
    cores::Core,
    cost::{self, Line},
    counts::{Counts, Stages},
    cycles::timing::{MISS, Timing},
    figures::{Figures, PerCore, count},
    plugin::Output,
    table::{Column, Table},
};

/// Tells a scene from the others of a core.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Key {
    pub(crate) scene: String,
    /// S4 or S8: the number of fraction bits of a vertex's place.
    pub(crate) precision: String,
    /// How the frame is drawn: as a whole, or in bands.
    pub(crate) mode: String,
}

/// What frames of a scene take on a core: sums over the frames, but for what is drawn.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Scene {
    #[serde(flatten)]
    pub(crate) key: Key,
    pub(crate) frames: u64,
    pub(crate) clear: Counts,
    pub(crate) vertices: Counts,
    /// Culling triangles, setting them up, and walking down their rows, if it was measured alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) set_up: Option<Counts>,
    /// That, and the pixels: depth test, interpolation, colour.
    pub(crate) draw: Counts,
    /// Means over the frames.
    pub(crate) pixels_drawn: u64,
    pub(crate) triangles_drawn: u64,
    pub(crate) pixels_changed: u64,
}

/// The cost of a frame and of its parts, in instructions or in cycles: means over the frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Parts {
    pub(crate) frame: u64,
    pub(crate) clear: u64,
    pub(crate) vertices: u64,
    /// If it was measured alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) set_up: Option<u64>,
    /// With the set-up unless that was measured alone.
    pub(crate) pixels: u64,
}

impl Scene {
    fn new(line: Line<Key>, set_up: Option<&Line<Key>>) -> Self {
        let Line { key, cost, stages } = line;
        let Stages { clear, vertices, draw } = stages;
        Self {
            key,
            frames: cost.frames,
            clear,
            vertices,
            set_up: set_up.map(|set_up| set_up.stages.draw),
            draw,
            pixels_drawn: cost.mean(cost.pixels_drawn),
            triangles_drawn: cost.mean(cost.triangles_drawn),
            pixels_changed: cost.mean(cost.pixels_changed),
        }
    }

    /// Joins the scenes of a program with their set-up, if another one measures it alone.
    pub(super) fn all(frames: &Output, set_up: Option<&Output>) -> Result<Vec<Self>> {
        let set_ups: Option<Vec<Line<Key>>> = set_up.map(cost::lines).transpose()?;
        let scene = |line: Line<Key>| {
            let Some(set_ups) = &set_ups else { return Ok(Self::new(line, None)) };
            let set_up = set_ups.iter().find(|set_up| set_up.key == line.key);
            let set_up = set_up.with_context(|| format!("there is no set-up of {:?}", line.key))?;
            Ok(Self::new(line, Some(set_up)))
        };
        cost::lines(frames)?.into_iter().map(scene).collect()
    }

    /// What a whole frame counts: a sum over the frames.
    pub(crate) fn counts(&self) -> Counts {
        self.clear + self.vertices + self.draw
    }

    /// The cost of the parts, by what counts cost.
    fn parts(&self, cost: impl Fn(&Counts) -> u64) -> Parts {
        let mean = |counts: &Counts| cost::mean(cost(counts), self.frames);
        let set_up = self.set_up.as_ref().map(mean);
        Parts {
            frame: mean(&self.counts()),
            clear: mean(&self.clear),
            vertices: mean(&self.vertices),
            set_up,
            pixels: mean(&self.draw).saturating_sub(set_up.unwrap_or(0)),
        }
    }

    pub(crate) fn instructions(&self) -> Parts {
        self.parts(|counts| counts.instructions)
    }

    /// The cycles in a model of a core's timing.
    pub(crate) fn cycles(&self, timing: &Timing, model: usize, miss: u64) -> Parts {
        self.parts(|counts| timing.cycles(model, counts, miss))
    }
}

/// The scenes of a core.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Scenes {
    pub(crate) scenes: Vec<Scene>,
}

/// The contents of `results/speed.json`.
pub(crate) type Speed = PerCore<Scenes>;

/// A scene for the table.
struct Row<'a> {
    scene: &'a Scene,
    instructions: Parts,
    /// If there is a timing table of the core.
    cycles: Option<u64>,
    goal: Option<Goal>,
}

impl Row<'_> {
    /// Instructions for each of the things drawn, if they are counted.
    fn share(&self, drawn: u64) -> Option<f64> {
        (drawn > 0).then(|| self.instructions.frame as f64 / drawn as f64)
    }
}

impl Figures for Scenes {
    const FILE: &str = "speed.json";
    const TITLE: &str = "Speed";
    /// Each bench program before the one that measures its set-up alone. The set-up of the last
    /// three is not measured alone: compiling their many scenes once more takes too long.
    const PROGRAMS: &[&str] = &[
        "bench",
        "bench_set_up",
        "bench_frugal",
        "bench_frugal_set_up",
        "bench_textures",
        "bench_shades",
        "bench_walk",
    ];

    const LEGEND: &str = "\
Instructions for a frame of 320 x 240 in `Rgb565Be`, the mean of eight: *clear* sets depth to the
far end, *vertices* transforms, lights and projects them, *set-up* culls triangles, sets them up
and walks down their rows, *pixels* is the rest: depth test, interpolation, colour. Where *set-up*
is empty, *pixels* has it too. *cycles* is what the frame takes by the core's timing table, see
[Cycles](#cycles). *drawn* counts the pixels that the finished frame covers. *changed* counts those
of the rectangle that holds what this frame and the one before it show: of 76,800, only they have to
be sent to a display that shows the frame before. *bits* is the precision of vertices: S4 is a sixteenth of a pixel, S8 a
256th. Bands keep vertices, and bins of triangles, from the first band to the last; with *alone*
only one of the two is kept. Vertices that are not kept are computed in *set-up*, when a triangle
needs them. *small3dlib* 0.905d was measured in the same way, in instructions, as is the *target*;
it has no sub-pixels and no light.

Textures have 128 x 128 texels in `Rgb565Be`. Unless the name of a scene tells otherwise, the
nearest texels are shown, corrected within half a texel, with depth. *every-16* is corrected every
16 pixels; *trilinear* has its mip level from the triangle, *trilinear-pixel* from the pixel;
*shaded* texels have a palette for each level of light. Black texels are not *drawn* pixels. Written
by hand the pixels of cube-texture would take 16.5 instructions each on the Cortex-M0+ and 13 on the
Cortex-M4; the whole frame with depth about 21.5 and 16.5 a pixel.

The sphere in other ways is compared with *sphere-gouraud*: *over*, *add*, *multiply* and *screen*
blend it with a grey, by one alpha, by that of the material, of vertices (*over-vertex*) or of
texels; *back-to-front* sorts its triangles and draws both sides without depth. *phong* has a
highlight from a viewer far away, unless it is *matte*; *lamp* is a light at a point. *fog* is
exponential, at each pixel or at each *vertex*. *dither* is that of 8 x 8 thresholds, and *pages*
are those of an OLED. *lines* are the edges of its faces, and *drawn* counts their pixels: with
*hidden* those that the sphere does not hide, after its depth has been drawn. *smooth* ones are
antialiased, one pixel wide. *points* are its vertices, 3 x 3 pixels each. *scissored* draws in the
right half of the picture. *painter* draws from back to front, without depth. *shaped* is the sphere
stretched, mirrored and sheared by a matrix, *morph* the sphere between two shapes. *sent* is drawn
in bands and sent to a display, *2x2* and *4x4* with as many samples a pixel.

*layers* are six spheres one behind the other, the farthest drawn first; *deferred*, a visibility
buffer is drawn, and each visible pixel is shaded once. Their *pixels* have their vertices too.
*walk* is the world of `rasterizer/examples/walk.rs` on 240 x 240 pixels, with all that is sent, the
mean of 24 frames; its triangles are not counted.";

    fn parse(outputs: &[Output]) -> Result<Self> {
        let mut scenes = Vec::new();
        let mut programs = Self::PROGRAMS.iter().zip(outputs).peekable();
        while let Some((_, frames)) = programs.next() {
            let set_up = programs.next_if(|(name, _)| name.ends_with("_set_up"));
            scenes.extend(Scene::all(frames, set_up.map(|(_, output)| output))?);
        }
        Ok(Self { scenes })
    }

    fn tables(&self, core: Core) -> Vec<(&'static str, Table)> {
        let columns: [Column<Row<'_>>; 16] = [
            ("scene", |row| row.scene.key.scene.clone()),
            ("bits", |row| row.scene.key.precision.clone()),
            ("mode", |row| row.scene.key.mode.clone()),
            ("frame", |row| count(row.instructions.frame)),
            ("cycles", |row| optional(row.cycles)),
            ("/ pixel", |row| {
                let share = row.share(row.scene.pixels_drawn);
                share.map_or_else(String::new, |share| format!("{share:.1}"))
            }),
            ("/ triangle", |row| {
                optional(row.share(row.scene.triangles_drawn).map(|share| share.round() as u64))
            }),
            ("clear", |row| count(row.instructions.clear)),
            ("vertices", |row| count(row.instructions.vertices)),
            ("set-up", |row| optional(row.instructions.set_up)),
            ("pixels", |row| count(row.instructions.pixels)),
            ("drawn", |row| count(row.scene.pixels_drawn)),
            ("changed", |row| count(row.scene.pixels_changed)),
            ("small3dlib", |row| optional(row.goal.and_then(|goal| goal.rival))),
            ("target", |row| optional(row.goal.and_then(|goal| goal.target))),
            ("met", |row| match row.goal.and_then(|goal| goal.is_met(row.instructions.frame)) {
                Some(true) => "yes".into(),
                Some(false) => "no".into(),
                None => String::new(),
            }),
        ];
        let timing = Timing::of(core);
        let rows = self.scenes.iter().map(|scene| Row {
            scene,
            instructions: scene.instructions(),
            cycles: timing.map(|timing| scene.cycles(&timing, 0, MISS).frame),
            goal: goals::of(core, &scene.key),
        });
        vec![("", Table::of(3, &columns, rows))]
    }
}

/// A figure, or nothing.
fn optional(figure: Option<u64>) -> String {
    figure.map_or_else(String::new, count)
}

#[cfg(test)]
pub(crate) mod tests {
    use serde_json::json;

    use super::*;
    use crate::{cost::tests::output, figures};

    fn key(scene: &str) -> Key {
        Key { scene: scene.into(), precision: "S4".into(), mode: "whole".into() }
    }

    /// Counts of instructions that all take one cycle.
    fn plain(instructions: u64) -> Counts {
        Counts { instructions, ..Counts::default() }
    }

    /// Figures of one scene on one core, whose instructions all take one cycle.
    pub(crate) fn speed(core: Core, scene: &str, frame: u64) -> Speed {
        let scene = Scene {
            key: key(scene),
            frames: 1,
            clear: plain(0),
            vertices: plain(1_000),
            set_up: Some(plain(2_000)),
            draw: plain(frame - 1_000),
            pixels_drawn: 5_000,
            triangles_drawn: 10,
            pixels_changed: 6_000,
        };
        figures::tests::of(core, Scenes { scenes: vec![scene] })
    }

    #[test]
    fn a_scene_is_the_mean_of_its_frames() {
        let output = |scene, draw| output(json!(key(scene)), 4_000, 800, draw);
        let frames = output("cube", 40_000);
        let all = |set_up| Scene::all(&frames, Some(&output(set_up, 15_000)));
        let mut scene = all("cube").unwrap().remove(0);
        assert_eq!(scene.key, key("cube"));
        let set_up = Some(1_875);
        let parts = Parts { frame: 5_600, clear: 500, vertices: 100, set_up, pixels: 3_125 };
        assert_eq!(scene.instructions(), parts);
        let without_set_up = Scene::all(&frames, None).unwrap().remove(0);
        let together = Parts { set_up: None, pixels: 5_000, ..parts };
        assert_eq!(without_set_up.instructions(), together);
        assert_eq!(
            (scene.pixels_drawn, scene.triangles_drawn, scene.pixels_changed),
            (101, 6, 200)
        );
        assert!(all("ball").unwrap_err().to_string().contains("cube"));
        // A load takes two cycles, and 800 are a hundred a frame.
        scene.draw.loads = 800;
        let cycles = scene.cycles(&Timing::of(Core::M0plus).unwrap(), 0, MISS);
        assert_eq!(cycles, Parts { frame: 5_700, pixels: 3_225, ..parts });
    }

    /// The cells of a table's row.
    pub(crate) fn cells(line: &str) -> Vec<&str> {
        line.trim_matches('|').split('|').map(str::trim).collect()
    }

    #[test]
    fn the_table_shows_cycles_and_whether_the_target_is_met() {
        let last = |core, frame| {
            let text = speed(core, "cube-flat", frame).tables();
            cells(text.lines().last().unwrap()).join(" ")
        };
        let expected = "cube-flat S4 whole 110,000 110,000 22.0 11,000 0 1,000 2,000 107,000 5,000 \
                        6,000 160,000 110,000 yes";
        assert_eq!(last(Core::M0plus, 110_000), expected);
        assert!(last(Core::M0plus, 110_001).ends_with(" 110,000 no"));
        let without_timing = "cube-flat S4 whole 5,000  1.0";
        assert!(last(Core::M7, 5_000).starts_with(without_timing));
        assert!(last(Core::M7, 5_000).ends_with(" 5,000 6,000   "));
    }
}
