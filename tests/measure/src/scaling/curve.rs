//! Curves, and how steep they are.

use anyhow::{Context as _, Result};
use serde::{Deserialize, Serialize};

use crate::{cores::Core, cost::Cost, per_core::PerCore};

/// What is drawn at each point of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Curve {
    /// Spheres of the same size, of more and more triangles.
    SphereTriangles,
    /// Squares that cover the same pixels, of more and more triangles.
    SquareTriangles,
    /// A cube, wider and wider.
    CubeWidths,
    /// A sphere of 784 triangles, wider and wider.
    SphereWidths,
}

/// What a curve has more and more of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Item {
    Triangle,
    Pixel,
}

impl Curve {
    pub(super) const ALL: [Self; 4] =
        [Self::SphereTriangles, Self::SquareTriangles, Self::CubeWidths, Self::SphereWidths];

    pub(super) const fn item(self) -> Item {
        match self {
            Self::SphereTriangles | Self::SquareTriangles => Item::Triangle,
            Self::CubeWidths | Self::SphereWidths => Item::Pixel,
        }
    }

    /// In a few words.
    pub(super) const fn title(self) -> &'static str {
        match self {
            Self::SphereTriangles => "spheres, 220 pixels wide, of more and more triangles",
            Self::SquareTriangles => "squares of 27,800 pixels, of more and more triangles",
            Self::CubeWidths => "a cube, wider and wider",
            Self::SphereWidths => "a sphere of 784 triangles, wider and wider",
        }
    }
}

/// A line of the firmware.
#[derive(Debug, Deserialize)]
struct Line {
    curve: Curve,
    at: u64,
    precision: String,
    #[serde(flatten)]
    cost: Cost,
}

/// A point of a curve: means over its frames.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Point {
    pub(super) curve: Curve,
    /// Triangles of the model, or the width in pixels.
    pub(super) at: u64,
    pub(super) precision: String,
    /// Instructions of a frame, without those that clear its depth: they are always the same.
    pub(super) instructions: u64,
    /// Of these, those for vertices.
    pub(super) vertices: u64,
    pub(super) pixels_drawn: u64,
    pub(super) triangles_drawn: u64,
}

impl Point {
    /// All that the firmware has printed, but for the first line.
    pub(super) fn all(core: Core, lines: &[String]) -> Result<Vec<Self>> {
        let point = |line: &String| {
            let Line { curve, at, precision, cost } = serde_json::from_str(line)
                .with_context(|| format!("the firmware has printed `{line}`, no figures"))?;
            cost.check()?;
            Ok(Self {
                curve,
                at,
                precision,
                instructions: cost.vertices(core) + cost.triangles_and_pixels(core),
                vertices: cost.vertices(core),
                pixels_drawn: cost.pixels_drawn(),
                triangles_drawn: cost.triangles_drawn(),
            })
        };
        lines.iter().skip(1).map(point).collect()
    }

    /// How many triangles the model has, or how many pixels are drawn.
    pub(super) const fn items(&self) -> u64 {
        match self.curve.item() {
            Item::Triangle => self.at,
            Item::Pixel => self.pixels_drawn,
        }
    }

    /// Instructions for a triangle of the model, or for a pixel that is drawn.
    pub(super) fn per_item(&self) -> f64 {
        self.instructions as f64 / self.items().max(1) as f64
    }

    /// The exponent of the growth from an earlier point to this: 0 if more items cost nothing, 1 if
    /// the cost grows in proportion. None if there are not at least a tenth more of them.
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

/// What `results/scaling.json` holds.
pub(crate) type Scaling = PerCore<Points>;

impl Points {
    /// The points of a curve in one precision, in order.
    pub(super) fn curve(&self, curve: Curve, precision: &str) -> Vec<&Point> {
        let is_on_it = |point: &&Point| point.curve == curve && point.precision == precision;
        self.points.iter().filter(is_on_it).collect()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::per_core;

    /// Points of a curve on the M4, from its items and instructions.
    pub(in crate::scaling) fn scaling(curve: Curve, points: &[(u64, u64)]) -> Scaling {
        let point = |&(at, instructions): &(u64, u64)| Point {
            curve,
            at,
            precision: "S4".into(),
            instructions,
            vertices: instructions / 4,
            pixels_drawn: at,
            triangles_drawn: at / 2,
        };
        let points = points.iter().map(point).collect();
        per_core::tests::of(Core::M4, Points { points })
    }

    #[test]
    fn a_point_is_made_of_a_line() {
        let line = r#"{"curve":"cube-widths","at":8,"precision":"S8","frames":4,"clear":99,"vertices":40,"draw":400,"pixels_drawn":104,"triangles_drawn":20,"pixels_changed":400}"#;
        let points = Point::all(Core::M4, &["opt-level 3".into(), line.into()]).unwrap();
        let point = &points[0];
        assert_eq!((point.curve, point.at, point.precision.as_str()), (Curve::CubeWidths, 8, "S8"));
        assert_eq!((point.instructions, point.vertices, point.items()), (4_400, 400, 26));
        let broken = ["opt-level 3".into(), line.replace("cube", "cone")];
        assert!(
            format!("{:#}", Point::all(Core::M4, &broken).unwrap_err()).contains("cone-widths")
        );
    }

    #[test]
    fn the_exponent_is_one_in_proportion_and_zero_for_nothing() {
        let exponent = |a: (u64, u64), b: (u64, u64)| {
            let scaling = scaling(Curve::SquareTriangles, &[a, b]);
            let points = &scaling.cores[0].figures.points;
            points[1].exponent(&points[0])
        };
        assert_eq!(exponent((100, 5_000), (200, 10_000)), Some(1.0));
        assert_eq!(exponent((100, 5_000), (300, 5_000)), Some(0.0));
        assert_eq!(exponent((100, 5_000), (400, 10_000)), Some(0.5));
        assert_eq!(exponent((100, 5_000), (105, 9_000)), None);
    }
}
