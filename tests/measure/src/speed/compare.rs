//! What got slower or faster since the figures were saved.

use std::fmt::Write as _;

use super::scene::{Key, Scene, Speed};
use crate::{
    cores::Core,
    cycles::timing::{MISS, Timing},
    figures::count,
    table::{Column, Table},
};

/// The share of a frame in percent up to which a change is not reported. The figures are exact, but
/// another compiler lays out code differently.
pub(super) const THRESHOLD: f64 = 1.0;

/// A scene whose frames take more or fewer cycles than before.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Change {
    pub(super) core: Core,
    pub(super) key: Key,
    pub(super) before: u64,
    pub(super) now: u64,
}

impl Change {
    /// The change in percent of the earlier figure.
    pub(super) fn percent(&self) -> f64 {
        100.0 * (self.now as f64 - self.before as f64) / self.before.max(1) as f64
    }
}

/// Compares all scenes of `now` that were saved before, by their cycles, or by their instructions
/// on a core without a timing table. Returns how many these are, and those that changed by more
/// than a number of percent, the worst first.
pub(super) fn changes(before: &Speed, now: &Speed, percent: f64) -> (usize, Vec<Change>) {
    let saved = |core: Core, scene: &Scene| {
        let scenes = &before.of(core)?.figures.scenes;
        scenes.iter().find(|saved| saved.key == scene.key)
    };
    let mut changes = Vec::new();
    for speed in &now.cores {
        let core = speed.core;
        let cost = |scene: &Scene| match Timing::of(core) {
            Some(timing) => scene.cycles(&timing, 0, MISS).frame,
            None => scene.instructions().frame,
        };
        for scene in &speed.figures.scenes {
            let (key, now) = (scene.key.clone(), cost(scene));
            let before = saved(core, scene).map(cost);
            changes.extend(before.map(|before| Change { core, key, before, now }));
        }
    }
    let compared = changes.len();
    changes.retain(|change| change.percent().abs() > percent);
    changes.sort_by(|a, b| b.percent().total_cmp(&a.percent()));
    (compared, changes)
}

/// Describes the changes since the figures were saved. `compared` counts the scenes looked at.
pub(super) fn report(before: &Speed, now: &Speed, percent: f64) -> String {
    let (compared, changes) = changes(before, now, percent);
    if compared == 0 {
        return "There are no saved figures of these scenes to compare with.\n".into();
    }
    let mut text = String::new();
    // Writing to a string cannot fail.
    for speed in &now.cores {
        let before = before.of(speed.core).map(|before| before.conditions.to_string());
        if let Some(before) = before.filter(|before| *before != speed.conditions.to_string()) {
            let _ = writeln!(text, "{} was saved with {before}.", speed.core.title());
        }
    }
    let _ = writeln!(
        text,
        "{} of {compared} scenes changed by more than {percent} % of their cycles since the \
         figures were saved.",
        changes.len()
    );
    if changes.is_empty() {
        return text;
    }
    let columns: [Column<&Change>; 8] = [
        ("", |change| if change.percent() > 0.0 { "slower" } else { "faster" }.into()),
        ("core", |change| change.core.facts().name.into()),
        ("scene", |change| change.key.scene.clone()),
        ("bits", |change| change.key.precision.clone()),
        ("mode", |change| change.key.mode.clone()),
        ("before", |change| count(change.before)),
        ("now", |change| count(change.now)),
        ("change", |change| format!("{:+.1} %", change.percent())),
    ];
    format!("{text}\n{}", Table::of(5, &columns, &changes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::speed::scene::tests::{cells, speed};

    #[test]
    fn only_changes_beyond_the_threshold_count() {
        let before = speed(Core::M4, "cube", 100_000);
        let share = |frame: u64, percent| {
            let (compared, changes) = changes(&before, &speed(Core::M4, "cube", frame), percent);
            assert_eq!(compared, 1);
            changes.first().map(|change| (change.percent() * 100.0).round())
        };
        assert_eq!(share(101_000, 1.0), None);
        assert_eq!(share(99_000, 1.0), None);
        assert_eq!(share(101_100, 1.0), Some(110.0));
        assert_eq!(share(101_100, 2.0), None);
        assert_eq!(share(50_000, 1.0), Some(-5_000.0));
    }

    #[test]
    fn cycles_decide_where_there_is_a_table() {
        // The same instructions, but ten thousand of them are loads.
        let percent = |core| {
            let (before, mut now) = (speed(core, "cube", 100_000), speed(core, "cube", 100_000));
            now.cores[0].figures.scenes[0].draw.loads = 10_000;
            let (_, changes) = changes(&before, &now, 1.0);
            changes.first().map(|change| change.percent().round())
        };
        assert_eq!(percent(Core::M0plus), Some(10.0));
        assert_eq!(percent(Core::M7), None);
    }

    #[test]
    fn other_scenes_and_cores_are_not_compared() {
        let before = speed(Core::M4, "cube", 100_000);
        let nothing = (0, vec![]);
        assert_eq!(changes(&before, &speed(Core::M4, "sphere", 200_000), 1.0), nothing);
        assert_eq!(changes(&before, &speed(Core::M7, "cube", 200_000), 1.0), nothing);
        assert_eq!(changes(&Speed::default(), &before, 1.0), nothing);
    }

    #[test]
    fn the_worst_comes_first() {
        let [before, now] = [[5_000, 5_000], [4_000, 6_000]]
            .map(|[a, b]| speed(Core::M4, "cube", a).with(speed(Core::M7, "cube", b)));
        let (_, changes) = changes(&before, &now, 1.0);
        let cores: Vec<_> = changes.iter().map(|change| change.core).collect();
        assert_eq!(cores, [Core::M7, Core::M4]);
    }

    #[test]
    fn a_change_is_shown_with_its_direction_and_the_other_compiler() {
        let (before, mut now) = (speed(Core::M4, "cube", 10_000), speed(Core::M4, "cube", 12_000));
        now.cores[0].conditions.rustc = "rustc 2.0.0".into();
        let slower = report(&before, &now, 1.0);
        assert!(slower.starts_with("Cortex-M4 was saved with rustc 1.95.0"), "{slower}");
        let row = ["slower", "m4", "cube", "S4", "whole", "10,000", "12,000", "+20.0 %"];
        assert_eq!(cells(slower.lines().last().unwrap()), row);
        let same = report(&before, &before, 2.0);
        let expected = "0 of 1 scenes changed by more than 2 % of their cycles since the figures \
                        were saved.\n";
        assert_eq!(same, expected);
        assert!(report(&Speed::default(), &now, 1.0).contains("no saved figures"));
    }
}
