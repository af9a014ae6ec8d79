//! What got slower or faster since the figures were saved.

use std::fmt::Write as _;

use super::scene::{Key, Scene, Speed};
use crate::{
    cores::Core,
    figures::count,
    table::{Column, Table},
};

/// The share of a frame up to which a change does not count. The figures are exact, but another
/// compiler lays out code differently.
const THRESHOLD: f64 = 0.01;

/// A scene whose frames take more or fewer instructions than before.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Change {
    pub(super) core: Core,
    pub(super) key: Key,
    pub(super) before: u64,
    pub(super) now: u64,
}

impl Change {
    /// The change as a share of the earlier figure: 0.1 is a tenth more.
    pub(super) fn share(&self) -> f64 {
        (self.now as f64 - self.before as f64) / self.before.max(1) as f64
    }

    pub(super) fn is_slower(&self) -> bool {
        self.share() > THRESHOLD
    }
}

/// Compares all scenes of `now` that were saved before. Returns how many these are, and those that
/// changed by more than the threshold, the worst first.
pub(super) fn changes(before: &Speed, now: &Speed) -> (usize, Vec<Change>) {
    let saved = |core: Core, scene: &Scene| {
        let scenes = &before.of(core)?.figures.scenes;
        scenes.iter().find(|saved| saved.key == scene.key).map(|saved| saved.frame)
    };
    let mut changes = Vec::new();
    for speed in &now.cores {
        for scene in &speed.figures.scenes {
            let (core, key, now) = (speed.core, scene.key.clone(), scene.frame);
            changes.extend(saved(core, scene).map(|before| Change { core, key, before, now }));
        }
    }
    let compared = changes.len();
    changes.retain(|change| change.share().abs() > THRESHOLD);
    changes.sort_by(|a, b| b.share().total_cmp(&a.share()));
    (compared, changes)
}

/// Describes the changes since the figures were saved. `compared` counts the scenes looked at.
pub(super) fn report(before: &Speed, now: &Speed, compared: usize, changes: &[Change]) -> String {
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
    let percent = 100.0 * THRESHOLD;
    let _ = writeln!(
        text,
        "{} of {compared} scenes changed by more than {percent} % since the figures were saved.",
        changes.len()
    );
    if changes.is_empty() {
        return text;
    }
    let columns: [Column<&Change>; 8] = [
        ("", |change| if change.is_slower() { "slower" } else { "faster" }.into()),
        ("core", |change| change.core.facts().name.into()),
        ("scene", |change| change.key.scene.clone()),
        ("bits", |change| change.key.precision.clone()),
        ("mode", |change| change.key.mode.clone()),
        ("before", |change| count(change.before)),
        ("now", |change| count(change.now)),
        ("change", |change| format!("{:+.1} %", 100.0 * change.share())),
    ];
    format!("{text}\n{}", Table::of(5, &columns, changes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::speed::scene::tests::{cells, speed};

    #[test]
    fn only_changes_beyond_the_threshold_count() {
        let before = speed(Core::M4, "cube", 100_000);
        let share = |frame: u64| {
            let (compared, changes) = changes(&before, &speed(Core::M4, "cube", frame));
            assert_eq!(compared, 1);
            changes.first().map(|change| (change.is_slower(), (change.share() * 1e4).round()))
        };
        assert_eq!(share(101_000), None);
        assert_eq!(share(99_000), None);
        assert_eq!(share(101_100), Some((true, 110.0)));
        assert_eq!(share(50_000), Some((false, -5_000.0)));
    }

    #[test]
    fn other_scenes_and_cores_are_not_compared() {
        let before = speed(Core::M4, "cube", 100_000);
        let nothing = (0, vec![]);
        assert_eq!(changes(&before, &speed(Core::M4, "sphere", 200_000)), nothing);
        assert_eq!(changes(&before, &speed(Core::M7, "cube", 200_000)), nothing);
        assert_eq!(changes(&Speed::default(), &before), nothing);
    }

    #[test]
    fn the_worst_comes_first() {
        let [before, now] = [[5_000, 5_000], [4_000, 6_000]]
            .map(|[a, b]| speed(Core::M4, "cube", a).with(speed(Core::M7, "cube", b)));
        let (_, changes) = changes(&before, &now);
        let cores: Vec<_> = changes.iter().map(|change| change.core).collect();
        assert_eq!(cores, [Core::M7, Core::M4]);
    }

    #[test]
    fn a_change_is_shown_with_its_direction_and_the_other_compiler() {
        let (before, mut now) = (speed(Core::M4, "cube", 10_000), speed(Core::M4, "cube", 12_000));
        now.cores[0].conditions.rustc = "rustc 2.0.0".into();
        let text = |before, now| {
            let (compared, changes) = changes(before, now);
            report(before, now, compared, &changes)
        };
        let slower = text(&before, &now);
        assert!(slower.starts_with("Cortex-M4 was saved with rustc 1.95.0"), "{slower}");
        let row = ["slower", "m4", "cube", "S4", "whole", "10,000", "12,000", "+20.0 %"];
        assert_eq!(cells(slower.lines().last().unwrap()), row);
        let same = text(&before, &before);
        let expected = "0 of 1 scenes changed by more than 1 % since the figures were saved.\n";
        assert_eq!(same, expected);
        assert!(text(&Speed::default(), &now).contains("no saved figures"));
    }
}
