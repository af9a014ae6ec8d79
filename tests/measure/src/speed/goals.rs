//! Where the figures should be, and where the best other renderer is.

use super::figures::Scene;
use crate::cores::Core;

/// For a frame, in instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Goal {
    /// At most this.
    pub(super) target: u64,
    /// What small3dlib 0.905d takes (gcc 12 -O3, in QEMU as here): no sub-pixels, no vertex reuse,
    /// no light.
    pub(super) rival: u64,
}

/// Scene, core, precision. Small3dlib's sphere-flat on the M4 is from a Cortex-M3.
const GOALS: [(&str, Core, &str, Goal); 10] = [
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
];

const fn goal(target: u64, rival: u64) -> Goal {
    Goal { target, rival }
}

/// The goal for a scene on a core, if there is one: for the precision that suits the core, whole
/// frames.
pub(super) fn of(core: Core, scene: &Scene) -> Option<Goal> {
    let is_meant = |(name, of, precision, _): &&(&str, Core, &str, Goal)| {
        scene.key() == [*name, *precision, "whole"] && *of == core
    };
    GOALS.iter().find(is_meant).map(|(.., goal)| *goal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::speed::figures::tests::speed;

    #[test]
    fn a_goal_is_for_one_core_and_precision() {
        let scene = speed(Core::M0plus, "cube-flat", 9_000).cores[0].figures.scenes[0].clone();
        assert_eq!(of(Core::M0plus, &scene), Some(goal(110_000, 160_000)));
        assert_eq!(of(Core::M4, &scene), None);
        assert_eq!(of(Core::M0plus, &Scene { mode: "bands".into(), ..scene }), None);
    }
}
