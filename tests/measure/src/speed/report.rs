//! The figures as tables.

use std::fmt::Write as _;

use host_tools::model::thousands;

use super::{
    compare::{self, Change, THRESHOLD},
    figures::{Scenes, Speed},
    goals,
};
use crate::{per_core::Measured, table::Table};

const HEADINGS: [&str; 15] = [
    "scene",
    "bits",
    "mode",
    "frame",
    "/ pixel",
    "/ triangle",
    "clear",
    "vertices",
    "set-up",
    "pixels",
    "drawn",
    "changed",
    "small3dlib",
    "target",
    "met",
];

fn table(speed: &Measured<Scenes>) -> Table {
    let mut table = Table::new(3, &HEADINGS);
    for scene in &speed.figures.scenes {
        let of = |drawn: u64| scene.frame as f64 / drawn.max(1) as f64;
        let count = |count: u64| thousands(count as usize);
        let goal = goals::of(speed.core, scene);
        let goal = goal.map(|goal| {
            let is_met = scene.frame <= goal.target;
            [count(goal.rival), count(goal.target), if is_met { "yes" } else { "no" }.into()]
        });
        let [scene_name, precision, mode] = scene.key().map(str::to_owned);
        let figures = [
            scene_name,
            precision,
            mode,
            count(scene.frame),
            format!("{:.1}", of(scene.pixels_drawn)),
            count(of(scene.triangles_drawn).round() as u64),
            count(scene.clear),
            count(scene.vertices),
            count(scene.set_up),
            count(scene.pixels),
            count(scene.pixels_drawn),
            count(scene.pixels_changed),
        ];
        table.row(figures.into_iter().chain(goal.into_iter().flatten()));
    }
    table
}

/// For a terminal.
pub(super) fn tables(speed: &Speed) -> String {
    let mut text = String::new();
    for speed in &speed.cores {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{}: instructions a frame ({})\n{}",
            speed.core.title(),
            speed.conditions,
            table(speed).aligned()
        );
    }
    text
}

/// What changed since the figures were saved, in words.
pub(super) fn changes(before: &Speed, now: &Speed, changes: &[Change]) -> String {
    let scenes = || {
        now.cores
            .iter()
            .flat_map(|speed| speed.figures.scenes.iter().map(|scene| (speed.core, scene)))
    };
    let compared =
        scenes().filter(|(core, scene)| compare::saved(before, *core, scene).is_some()).count();
    if compared == 0 {
        return "There are no saved figures of these to compare with.\n".into();
    }
    let mut text = String::new();
    for speed in &now.cores {
        if let Some(before) = before.of(speed.core)
            && before.conditions.to_string() != speed.conditions.to_string()
        {
            let _ = writeln!(text, "{} was saved with {}.", speed.core.title(), before.conditions);
        }
    }
    let percent = 100.0 * THRESHOLD;
    if changes.is_empty() {
        let _ = writeln!(
            text,
            "No scene of {compared} changed by more than {percent} % since the figures were saved."
        );
        return text;
    }
    let _ = writeln!(
        text,
        "Changes of more than {percent} % since the figures were saved, of {compared} scenes:"
    );
    let mut table =
        Table::new(5, &["", "core", "scene", "bits", "mode", "before", "now", "change"]);
    for change in changes {
        table.row([
            if change.is_slower() { "slower" } else { "faster" }.to_owned(),
            change.core.name().into(),
            change.scene.clone(),
            change.precision.clone(),
            change.mode.clone(),
            thousands(change.before as usize),
            thousands(change.now as usize),
            format!("{:+.1} %", 100.0 * change.share()),
        ]);
    }
    text + &table.aligned()
}

/// For `RESULTS.md`.
pub(crate) fn section(speed: &Speed) -> String {
    let mut text = String::from(
        "## Speed\n\nInstructions for a frame of 320 x 240 in `Rgb565Be`, the mean of eight: *clear* sets depth to the far end, \
         *vertices* transforms, lights and projects them, *set-up* culls triangles, sets them up and walks down their \
         rows, *pixels* is the rest: depth test, interpolation, colour. *drawn* counts the pixels that are covered in the \
         end, *changed* those of the rectangle that holds what this frame and the last one show: of 76,800, they are all \
         that has to be sent to a display that shows the last one. *bits* is the precision of vertices: S4 sixteenths of a pixel, S8 256ths. Bands keep vertices, and \
         bins of triangles, from the first to the last; *alone* the other is not kept, and vertices that are not kept are \
         worked out in *set-up*, when a triangle needs them. They are instructions, not \
         cycles: wait states, divisions and taken branches count as one each. *small3dlib* 0.905d was measured alike; it \
         has no sub-pixels and no light.\n",
    );
    for speed in &speed.cores {
        let _ = write!(
            text,
            "\n### {}\n\n{}, {}.\n\n{}",
            speed.core.title(),
            speed.conditions.date,
            speed.conditions,
            table(speed).markdown()
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cores::Core, speed::figures::tests::speed};

    #[test]
    fn a_table_says_whether_the_target_is_met() {
        let of = |frame| tables(&speed(Core::M0plus, "cube-flat", frame));
        let (good, bad) = (of(110_000), of(110_001));
        assert!(good.contains("110,000     22.0      11,000"), "{good}");
        assert!(good.contains("160,000  110,000  yes\n"), "{good}");
        assert!(bad.contains("160,000  110,000   no\n"), "{bad}");
        assert!(
            tables(&speed(Core::M7, "cube-flat", 5_000))
                .lines()
                .nth(2)
                .unwrap()
                .ends_with("5,000    6,000")
        );
    }

    #[test]
    fn a_change_is_told_with_its_direction_and_the_compiler_s() {
        let (before, mut now) = (speed(Core::M4, "cube", 10_000), speed(Core::M4, "cube", 12_000));
        now.cores[0].conditions.rustc = "rustc 2.0.0".into();
        let text = changes(&before, &now, &compare::changes(&before, &now));
        assert!(text.starts_with("Cortex-M4 was saved with rustc 1.95.0"), "{text}");
        assert!(
            text.contains("slower  m4    cube   S4    whole  10,000  12,000  +20.0 %"),
            "{text}"
        );
        let same = changes(&before, &before, &[]);
        assert_eq!(same, "No scene of 1 changed by more than 1 % since the figures were saved.\n");
        assert!(changes(&Speed::default(), &now, &[]).contains("no saved figures"));
    }
}
