//! Curves, and how steep they are.

use serde::{Deserialize, Serialize};

use crate::{cost::Line, figures::PerCore};

/// What varies along a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Curve {
    /// Spheres of equal size and growing triangle counts.
    SphereTriangles,
    /// Squares that cover the same pixels, with growing triangle counts.
    SquareTriangles,
    /// A cube of growing width.
    CubeWidths,
    /// A sphere of 784 triangles and growing width.
    SphereWidths,
}

impl Curve {
    pub(super) const ALL: [Self; 4] =
        [Self::SphereTriangles, Self::SquareTriangles, Self::CubeWidths, Self::SphereWidths];

    /// Whether it grows by triangles, and not by pixels.
    pub(super) const fn is_of_triangles(self) -> bool {
        matches!(self, Self::SphereTriangles | Self::SquareTriangles)
    }

    pub(super) const fn title(self) -> &'static str {
        match self {
            Self::SphereTriangles => "Spheres, 220 pixels wide, with growing triangle counts",
            Self::SquareTriangles => "Squares of 27,800 pixels with growing triangle counts",
            Self::CubeWidths => "A cube of growing width",
            Self::SphereWidths => "A sphere of 784 triangles and growing width",
        }
    }
}

/// What a point of a curve measures.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Key {
    pub(super) curve: Curve,
    /// Triangles of the model, or its width in pixels.
    pub(super) at: u64,
    pub(super) precision: String,
}

/// A point of a curve: means over its frames.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Point {
    #[serde(flatten)]
    pub(super) key: Key,
    /// Instructions of a frame, without those that clear its depth: their number is constant.
    pub(super) instructions: u64,
    /// The part of them that is spent on vertices.
    pub(super) vertices: u64,
    pub(super) pixels_drawn: u64,
    pub(super) triangles_drawn: u64,
}

impl Point {
    pub(super) fn new(Line { key, cost, stages }: Line<Key>) -> Self {
        let vertices = cost.mean(stages.vertices.instructions);
        Self {
            key,
            instructions: vertices + cost.mean(stages.draw.instructions),
            vertices,
            pixels_drawn: cost.mean(cost.pixels_drawn),
            triangles_drawn: cost.mean(cost.triangles_drawn),
        }
    }

    /// The number of triangles of the model, or of pixels drawn.
    pub(super) const fn items(&self) -> u64 {
        if self.key.curve.is_of_triangles() { self.key.at } else { self.pixels_drawn }
    }

    /// Instructions for a triangle of the model, or for a pixel drawn.
    pub(super) fn per_item(&self) -> f64 {
        self.instructions as f64 / self.items().max(1) as f64
    }

    /// The exponent of the growth from an earlier point to this: 0 if more items cost nothing, 1 if
    /// the cost grows in proportion. None unless there are at least a tenth more items.
    pub(super) fn exponent(&self, earlier: &Self) -> Option<f64> {
        let growth = |now: u64, before: u64| now as f64 / before.max(1) as f64;
        let items = growth(self.items(), earlier.items());
        (items > 1.1).then(|| growth(self.instructions, earlier.instructions).ln() / items.ln())
    }
}

/// The curves of a core.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Points {
    pub(super) points: Vec<Point>,
}

/// The contents of `results/scaling.json`.
pub(crate) type Scaling = PerCore<Points>;

impl Points {
    /// The points of a curve in one precision, each with the exponent of the growth up to it.
    pub(super) fn curve(&self, curve: Curve, precision: &str) -> Vec<(&Point, Option<f64>)> {
        let is_on_it =
            |point: &&Point| point.key.curve == curve && point.key.precision == precision;
        let points: Vec<_> = self.points.iter().filter(is_on_it).collect();
        let before = [None].into_iter().chain(points.iter().copied().map(Some));
        let exponents = before.zip(&points).map(|(before, point)| point.exponent(before?));
        points.iter().copied().zip(exponents).collect()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use serde_json::json;

    use super::*;
    use crate::{
        cores::Core,
        cost::tests::output,
        figures::{self, Figures as _},
    };

    /// Points of a curve on the M4, from its items and instructions.
    pub(in crate::scaling) fn scaling(curve: Curve, points: &[(u64, u64)]) -> Scaling {
        let point = |&(at, instructions): &(u64, u64)| Point {
            key: Key { curve, at, precision: "S8".into() },
            instructions,
            vertices: instructions / 4,
            pixels_drawn: at,
            triangles_drawn: at / 2,
        };
        let points = points.iter().map(point).collect();
        figures::tests::of(Core::M4, Points { points })
    }

    #[test]
    fn a_point_is_made_of_a_line() {
        let key = |curve| json!({ "curve": curve, "at": 8, "precision": "S8" });
        let parse = |output| Points::parse(&[output]);
        let points = parse(output(key("cube-widths"), 99, 3_200, 32_000)).unwrap();
        let (point, exponent) = points.curve(Curve::CubeWidths, "S8")[0];
        assert_eq!((point.key.at, point.instructions, point.vertices), (8, 4_400, 400));
        assert_eq!((point.items(), exponent), (101, None));
        let fault = parse(output(key("cone-widths"), 99, 80, 800)).unwrap_err();
        assert!(format!("{fault:#}").contains("cone-widths"));
    }

    #[test]
    fn the_exponent_is_one_in_proportion_and_zero_for_nothing() {
        let exponent = |a: (u64, u64), b: (u64, u64)| {
            let scaling = scaling(Curve::SquareTriangles, &[a, b]);
            scaling.cores[0].figures.curve(Curve::SquareTriangles, "S8")[1].1
        };
        assert_eq!(exponent((100, 5_000), (200, 10_000)), Some(1.0));
        assert_eq!(exponent((100, 5_000), (300, 5_000)), Some(0.0));
        assert_eq!(exponent((100, 5_000), (400, 10_000)), Some(0.5));
        assert_eq!(exponent((100, 5_000), (105, 9_000)), None);
    }
}
