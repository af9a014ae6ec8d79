//! The curves as tables, and their steps in words.

use std::fmt::Write as _;

use host_tools::model::thousands;

use super::{
    curve::{Curve, Item, Points, Scaling},
    steps::{BEND, Kind, Step, TOLERANCE},
};
use crate::table::Table;

fn table(scaling: &Points, curve: Curve) -> Table {
    let (at, per_item) = match curve.item() {
        Item::Triangle => ("triangles", "/ triangle"),
        Item::Pixel => ("width", "/ pixel"),
    };
    let headings =
        [at, "drawn", "pixels", "vertices", "S4", per_item, "exponent", "S8", per_item, "exponent"];
    let mut table = Table::new(0, &headings);
    let (coarse, fine) = (scaling.curve(curve, "S4"), scaling.curve(curve, "S8"));
    let count = |count: u64| thousands(count as usize);
    for (index, point) in coarse.iter().enumerate() {
        let mut row = vec![
            count(point.at),
            count(point.triangles_drawn),
            count(point.pixels_drawn),
            count(point.vertices),
        ];
        for points in [&coarse, &fine] {
            let Some(point) = points.get(index) else { continue };
            let before = index.checked_sub(1).and_then(|before| points.get(before));
            let exponent = before.and_then(|before| point.exponent(before));
            row.extend([
                count(point.instructions),
                format!("{:.1}", point.per_item()),
                exponent.map_or_else(String::new, |exponent| format!("{exponent:.2}")),
            ]);
        }
        table.row(row);
    }
    table
}

/// For a terminal.
pub(super) fn tables(scaling: &Scaling) -> String {
    let mut text = String::new();
    for scaling in &scaling.cores {
        for curve in Curve::ALL {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{}, {} ({})\n{}",
                scaling.core.title(),
                curve.title(),
                scaling.conditions,
                table(&scaling.figures, curve).aligned()
            );
        }
    }
    text
}

/// The steps, those without a known cause last.
pub(super) fn steps(steps: &[Step]) -> String {
    let mut text = format!(
        "A step is where a triangle or pixel gets dearer by more than {} % from a point to the next, a frame cheaper by as \
         much, or where the exponent of the growth changes by more than {BEND}.\n",
        100.0 * TOLERANCE
    );
    let mut causes: Vec<_> = steps.iter().map(Step::cause).collect();
    causes.sort_by_key(|cause| {
        (cause.is_none(), steps.iter().position(|step| step.cause() == *cause))
    });
    causes.dedup();
    for cause in causes {
        let _ = writeln!(text, "\n{}:", cause.unwrap_or("NOT EXPLAINED"));
        for step in steps.iter().filter(|step| step.cause() == cause) {
            let _ = writeln!(text, "  {}", what(step));
        }
    }
    for cause in super::steps::outdated(steps) {
        let _ = writeln!(
            text,
            "\n{cause}:\n  no longer so on these cores; if on no other either, remove it from tests/measure/src/scaling/steps.rs"
        );
    }
    let _ = match steps.iter().filter(|step| step.cause().is_none()).count() {
        0 => writeln!(text, "\nNo step is without an explanation."),
        count => writeln!(
            text,
            "\n{count} without an explanation: find the cause, and remove it or add it to tests/measure/src/scaling/steps.rs."
        ),
    };
    text
}

fn what(step: &Step) -> String {
    let Step { core, curve, precision, at, kind } = step;
    let item = match curve.item() {
        Item::Triangle => "triangle",
        Item::Pixel => "pixel",
    };
    let at = thousands(*at as usize);
    let place = match curve {
        Curve::SphereTriangles => format!("sphere of {at} triangles"),
        Curve::SquareTriangles => format!("square of {at} triangles"),
        Curve::CubeWidths => format!("cube {at} pixels wide"),
        Curve::SphereWidths => format!("sphere {at} pixels wide"),
    };
    let change = match kind {
        Kind::Dearer(times) => format!("a {item} costs {times:.2} times as much"),
        Kind::Cheaper(times) => format!("a frame costs {times:.2} times as much"),
        Kind::Bent([before, now]) => format!("the exponent goes from {before:.2} to {now:.2}"),
    };
    format!("{} {precision}, {place}, {change}", core.title())
}

/// For `RESULTS.md`.
pub(crate) fn section(scaling: &Scaling) -> String {
    let mut text = String::from(
        "## Scaling\n\nInstructions for a frame, the mean of four, without those that clear its depth; all with Gouraud \
         shading and depth test on 320 x 240 pixels. *drawn* counts triangles after culling and clipping, *exponent* is \
         that of the growth from the line before: 0 where more triangles or pixels cost nothing, 1 where the cost grows \
         in proportion to them.\n\n![Instructions against triangles and against pixels](results/scaling.svg)\n",
    );
    for core in &scaling.cores {
        let _ = write!(
            text,
            "\n### {}\n\n{}, {}.\n",
            core.core.title(),
            core.conditions.date,
            core.conditions
        );
        for curve in Curve::ALL {
            let _ = write!(
                text,
                "\nOf {}:\n\n{}",
                curve.title(),
                table(&core.figures, curve).markdown()
            );
        }
    }
    let _ = write!(
        text,
        "\n### Steps\n\n{}",
        steps(&super::steps::of(scaling)).replace(":\n  ", ":\n\n  ").replace("\n  ", "\n- ")
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scaling::{curve::tests::scaling, steps::of};

    #[test]
    fn a_table_has_the_exponents() {
        let text = tables(&scaling(Curve::SquareTriangles, &[(100, 5_000), (400, 10_000)]));
        assert!(
            text.contains("      400    200     400     2,500  10,000        25.0      0.50\n"),
            "{text}"
        );
    }

    #[test]
    fn a_step_without_a_cause_is_told() {
        let told = |points: &[(u64, u64)]| steps(&of(&scaling(Curve::SphereTriangles, points)));
        let text = told(&[(100, 1_000), (200, 2_200)]);
        assert!(
            text.contains(
                "NOT EXPLAINED:\n  Cortex-M4 S4, sphere of 200 triangles, a triangle costs 1.10 times as much\n"
            ),
            "{text}"
        );
        assert!(text.contains("1 without an explanation"), "{text}");
        assert!(
            told(&[(100, 1_000), (200, 1_900)]).ends_with("No step is without an explanation.\n")
        );
    }
}
