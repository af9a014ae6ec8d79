//! The targets of the project, and the figures of the best other renderer.

use super::scene::Key;
use crate::cores::Core;

/// Instructions for a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Goal {
    /// The most that a frame should take.
    pub(super) target: Option<u64>,
    /// What small3dlib 0.905d takes (gcc 12 -O3, in QEMU as here): no sub-pixels, no vertex reuse,
    /// no light.
    pub(super) rival: Option<u64>,
}

impl Goal {
    /// Whether a frame takes no more than the target; `None` without one.
    pub(super) fn is_met(self, frame: u64) -> Option<bool> {
        Some(frame <= self.target?)
    }
}

/// Scene, core, precision. Small3dlib's sphere-flat on the M4 is from a Cortex-M3. Its textures
/// that are corrected every 16 pixels stand beside the target too.
///
/// A pixel's targets are 28 and 20 instructions for cube-texture, 19 and 13 without depth, and 55
/// for bilinear samples on the M4, times the 54,617 pixels that small3dlib draws.
const GOALS: [(&str, Core, &str, Goal); 21] = [
    ("spot-gouraud", Core::M0plus, "S4", goal(4_700_000, 18_850_000)),
    ("spot-gouraud", Core::M4, "S8", goal(1_600_000, 6_610_000)),
    ("suzanne-gouraud", Core::M0plus, "S4", goal(1_900_000, 7_660_000)),
    ("suzanne-gouraud", Core::M4, "S8", goal(800_000, 3_230_000)),
    ("cube-gouraud", Core::M0plus, "S4", goal(1_000_000, 3_960_000)),
    ("cube-gouraud", Core::M4, "S8", goal(650_000, 2_780_000)),
    ("sphere-flat", Core::M0plus, "S4", goal(360_000, 1_420_000)),
    ("sphere-flat", Core::M4, "S8", goal(180_000, 700_000)),
    ("cube-flat", Core::M0plus, "S4", goal(110_000, 160_000)),
    ("cube-flat", Core::M4, "S8", goal(60_000, 110_000)),
    ("cube-texture", Core::M0plus, "S4", goal(1_550_000, 5_380_000)),
    ("cube-texture", Core::M4, "S8", goal(1_100_000, 3_240_000)),
    ("cube-texture-no-depth", Core::M0plus, "S4", target(1_040_000)),
    ("cube-texture-no-depth", Core::M4, "S8", target(710_000)),
    ("cube-texture-every-pixel", Core::M0plus, "S4", rival(25_140_000)),
    ("cube-texture-every-pixel", Core::M4, "S8", rival(4_050_000)),
    ("cube-texture-every-16", Core::M0plus, "S4", rival(5_380_000)),
    ("cube-texture-every-16", Core::M4, "S8", rival(3_240_000)),
    ("cube-texture-bilinear", Core::M4, "S8", target(3_000_000)),
    ("spot-texture", Core::M0plus, "S4", goal(4_800_000, 20_720_000)),
    ("spot-texture", Core::M4, "S8", goal(2_400_000, 7_740_000)),
];

const fn goal(target: u64, rival: u64) -> Goal {
    Goal { target: Some(target), rival: Some(rival) }
}

const fn target(target: u64) -> Goal {
    Goal { target: Some(target), rival: None }
}

const fn rival(rival: u64) -> Goal {
    Goal { target: None, rival: Some(rival) }
}

/// Returns the goal of a scene on a core. Only whole frames in the precision that suits the core
/// have one.
pub(super) fn of(core: Core, key: &Key) -> Option<Goal> {
    let is_of = |(scene, goal_core, precision, _): &&(&str, Core, &str, Goal)| {
        (key.scene.as_str(), core, key.precision.as_str()) == (*scene, *goal_core, *precision)
    };
    let goal = GOALS.iter().find(is_of).map(|(.., goal)| *goal);
    goal.filter(|_| key.mode == "whole")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::speed::scene::tests::speed;

    #[test]
    fn a_goal_is_for_one_core_and_precision() {
        let key = speed(Core::M0plus, "cube-flat", 9_000).cores[0].figures.scenes[0].key.clone();
        assert_eq!(of(Core::M0plus, &key), Some(goal(110_000, 160_000)));
        assert_eq!(of(Core::M4, &key), None);
        let met = |target| Goal { target, rival: None }.is_met(9_000);
        assert_eq!([None, Some(8_999), Some(9_000)].map(met), [None, Some(false), Some(true)]);
        assert_eq!(of(Core::M0plus, &Key { mode: "bands".into(), ..key }), None);
    }
}
