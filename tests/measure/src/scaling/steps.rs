//! Steps in the curves: each must have a known cause.

use super::curve::{Curve, Scaling};
use crate::cores::Core;

/// What an item costs may rise by this share from a point to the next, and what a frame costs may
/// fall by it: more triangles or pixels make a frame dearer, and each of them cheaper.
pub(super) const TOLERANCE: f64 = 0.05;

/// By how much the exponent of the growth may differ from one pair of neighbours to the next. Where
/// a fixed cost is overtaken by one in proportion it rises from 0 to 1, for points an octave apart
/// by at most log2(2 - 1/sqrt 2) - log2(sqrt 2) = 0.17 at a time; what grows by a lower power, such
/// as the rows of triangles, bends less.
pub(super) const BEND: f64 = 0.18;

/// Curve, first and last point, cause.
type Explained = (Curve, [u64; 2], &'static str);

/// The steps that are known, with their causes.
const EXPLAINED: [Explained; 4] = [
    (
        Curve::SquareTriangles,
        [100_352, 100_352],
        "The triangles are smaller than a pixel: a third of them, of the point before one in twenty, have no pixel centre \
         within their height and width, and end before they are set up",
    ),
    (
        Curve::SphereWidths,
        [16, 45],
        "The gradients of slivers are divided exactly, bit by bit on cores without a long multiply: three of 206 triangles \
         at 11 pixels, one at 16, nine at 45",
    ),
    (
        Curve::SphereWidths,
        [1_024, 1_024],
        "Triangles of over 128 pixels have gradients that S8 divides exactly, bit by bit on cores without a long multiply: \
         from here on 42 of 210",
    ),
    (
        Curve::SphereWidths,
        [2_896, 2_896],
        "It reaches out of the guard band: for triangles there three vertices are transformed again, to find whether they \
         show and to clip those that do",
    ),
];

/// Where a curve steps.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Step {
    pub(super) core: Core,
    pub(super) curve: Curve,
    pub(super) precision: String,
    /// The point it leads to.
    pub(super) at: u64,
    pub(super) kind: Kind,
}

/// What is unexpected about a point, compared with those before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// A triangle or a pixel costs so many times what it cost before.
    Dearer(f64),
    /// A frame costs so many times what it cost before.
    Cheaper(f64),
    /// The exponent of the growth has gone from one to another.
    Bent([f64; 2]),
}

/// The explanations of steps that are no longer there.
pub(super) fn outdated(steps: &[Step]) -> Vec<&'static str> {
    let is_used = |cause: &&str| steps.iter().any(|step| step.cause() == Some(*cause));
    let causes = EXPLAINED.iter().map(|(.., cause)| *cause);
    causes.filter(|cause| !is_used(cause)).collect()
}

impl Step {
    /// Why it is there, if that is known.
    pub(super) fn cause(&self) -> Option<&'static str> {
        let is_this = |(curve, [first, last], _): &&Explained| {
            *curve == self.curve && (*first..=*last).contains(&self.at)
        };
        EXPLAINED.iter().find(is_this).map(|(.., cause)| *cause)
    }
}

/// All steps of all curves.
pub(super) fn of(scaling: &Scaling) -> Vec<Step> {
    let mut steps = Vec::new();
    for core in &scaling.cores {
        for curve in Curve::ALL {
            for precision in ["S4", "S8"] {
                let points = core.figures.curve(curve, precision);
                let mut exponent_before = None;
                for pair in points.windows(2) {
                    let (before, now) = (pair[0], pair[1]);
                    let dearer = now.per_item() / before.per_item();
                    let frame = now.instructions as f64 / before.instructions as f64;
                    let exponent = now.exponent(before);
                    let bend = exponent_before.zip(exponent).map(|(a, b): (f64, f64)| [a, b]);
                    let bend = bend.filter(|[a, b]| (a - b).abs() > BEND).map(Kind::Bent);
                    let kinds = [
                        (dearer > 1.0 + TOLERANCE).then_some(Kind::Dearer(dearer)),
                        (frame < 1.0 - TOLERANCE).then_some(Kind::Cheaper(frame)),
                        bend,
                    ];
                    steps.extend(kinds.into_iter().flatten().map(|kind| Step {
                        core: core.core,
                        curve,
                        precision: precision.into(),
                        at: now.at,
                        kind,
                    }));
                    exponent_before = exponent;
                }
            }
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scaling::curve::tests::scaling;

    fn kinds(points: &[(u64, u64)]) -> Vec<(u64, Kind)> {
        let steps = of(&scaling(Curve::SquareTriangles, points));
        steps.iter().map(|step| (step.at, step.kind)).collect()
    }

    #[test]
    fn fixed_cost_and_cost_in_proportion_make_no_step() {
        let points: Vec<_> =
            (0..11).map(|octave| 100 << octave).map(|n| (n, 400_000 + 500 * n)).collect();
        assert_eq!(kinds(&points), []);
    }

    #[test]
    fn a_step_has_the_cause_of_its_place_or_none() {
        let doubled = [(50_176, 1_000), (100_352, 2_500)];
        let of = |curve| of(&scaling(curve, &doubled));
        let (known, unknown) = (of(Curve::SquareTriangles), of(Curve::SphereTriangles));
        assert!(known[0].cause().unwrap().contains("smaller than a pixel"));
        assert_eq!(unknown[0].cause(), None);
        assert_eq!(
            (outdated(&known).len(), outdated(&unknown).len()),
            (EXPLAINED.len() - 1, EXPLAINED.len())
        );
    }

    #[test]
    fn a_jump_a_fall_and_a_bend_are_steps() {
        assert_eq!(kinds(&[(100, 1_000), (200, 2_200)]), [(200, Kind::Dearer(1.1))]);
        assert_eq!(kinds(&[(100, 1_000), (200, 900)]), [(200, Kind::Cheaper(0.9))]);
        assert_eq!(
            kinds(&[(100, 1_000), (200, 1_000), (400, 2_000)]),
            [(400, Kind::Bent([0.0, 1.0]))]
        );
        assert_eq!(kinds(&[(100, 1_000), (200, 2_080), (400, 4_160)]), []);
    }
}
