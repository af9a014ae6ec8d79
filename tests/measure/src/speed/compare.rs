//! What got slower or faster since the figures were saved.

use serde::Serialize;

use super::figures::{Scene, Speed};
use crate::cores::Core;

/// A change of up to this share is none. The counts are exact, but another compiler lays out code
/// otherwise.
pub(super) const THRESHOLD: f64 = 0.01;

/// A scene whose frames take more or fewer instructions than before.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Change {
    pub(super) core: Core,
    pub(super) scene: String,
    pub(super) precision: String,
    pub(super) mode: String,
    pub(super) before: u64,
    pub(super) now: u64,
}

impl Change {
    /// By which share of what it was: 0.1 is a tenth more.
    pub(super) fn share(&self) -> f64 {
        (self.now as f64 - self.before as f64) / self.before.max(1) as f64
    }

    pub(super) fn is_slower(&self) -> bool {
        self.share() > THRESHOLD
    }
}

/// The scenes of `now` that changed by more than the threshold, the worst first.
pub(super) fn changes(before: &Speed, now: &Speed) -> Vec<Change> {
    let mut changes = Vec::new();
    for speed in &now.cores {
        for scene in &speed.figures.scenes {
            changes.extend(saved(before, speed.core, scene).map(|saved| Change {
                core: speed.core,
                scene: scene.scene.clone(),
                precision: scene.precision.clone(),
                mode: scene.mode.clone(),
                before: saved.frame,
                now: scene.frame,
            }));
        }
    }
    changes.retain(|change| change.share().abs() > THRESHOLD);
    changes.sort_by(|a, b| b.share().total_cmp(&a.share()));
    changes
}

/// The same scene as it was saved.
pub(super) fn saved<'a>(before: &'a Speed, core: Core, scene: &Scene) -> Option<&'a Scene> {
    before.of(core)?.figures.scenes.iter().find(|saved| saved.key() == scene.key())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::speed::figures::tests::speed;

    #[test]
    fn only_changes_beyond_the_threshold_count() {
        let before = speed(Core::M4, "cube", 100_000);
        let share = |frame: u64| {
            let changes = changes(&before, &speed(Core::M4, "cube", frame));
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
        assert!(changes(&before, &speed(Core::M4, "sphere", 200_000)).is_empty());
        assert!(changes(&before, &speed(Core::M7, "cube", 200_000)).is_empty());
        assert!(changes(&Speed::default(), &before).is_empty());
    }

    #[test]
    fn the_worst_comes_first() {
        let [before, now] = [[5_000, 5_000], [4_000, 6_000]]
            .map(|[a, b]| speed(Core::M4, "cube", a).with(speed(Core::M7, "cube", b)));
        let cores: Vec<_> = changes(&before, &now).iter().map(|change| change.core).collect();
        assert_eq!(cores, [Core::M7, Core::M4]);
    }
}
