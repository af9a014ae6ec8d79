//! The command `stiffness`: how errors grow where a problem is ill-conditioned. It runs on the
//! host: frames are the same on all cores.

use anyhow::Result;
use clap::Args;
use host_tools::{
    model::write_atomically,
    stiffness::{Curve, FAMILIES, Family, INSTANCES, Law, Point},
};

use crate::{
    Done,
    chart::{self, Axis, Chart, Level, Reference, Scale},
    progress, report, results,
    table::{Column, Table},
};

const EXAMPLES: &str = "\
Examples:
  measure stiffness                 A table for each family of problems; target/report/stiffness.png
  measure stiffness --save          Write tests/measure/STIFFNESS.md and its chart

Exit status: 0 if all errors are within their bounds, 1 if one is not, 2 for bad usage.";

/// Measure errors against stiffness
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Write tests/measure/STIFFNESS.md and tests/measure/results/stiffness.svg
    #[arg(long)]
    save: bool,
}

const TITLE: &str = "\
# How errors grow with stiffness

A problem is stiff where a small error of a number becomes a large one of the picture, although
nothing in the picture looks difficult. Each family below has one parameter that makes its problem
stiffer in powers of two. The core solves random instances of it, with its own projection, clipping,
spans and depth; definitions in f64 or exact integers say what is right. On logarithmic axes the
error is a line with a slope that theory knows: 0 where stiffness does no harm, 1 where the error
grows in proportion to it. *bound* is what the documentation states.

Written by `cargo run --quiet --release --package measure -- stiffness --save`. The tests of
`host-tools` assert the slopes and the bounds (`cargo test -p host-tools stiffness`).

![Error and bound of each family](results/stiffness.svg)
";

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let progress = progress::over(FAMILIES.len());
    let measure = |family: &'static Family| {
        progress.set_message(family.name);
        let curve = family.measure(INSTANCES);
        progress.inc(1);
        (family, curve)
    };
    let measured: Vec<_> = FAMILIES.into_iter().map(measure).collect();
    drop(progress);
    let sections: Vec<_> = measured.iter().map(|(family, curve)| section(family, curve)).collect();
    let text = sections.join("\n");
    let charts: Vec<_> = measured.iter().map(|(family, curve)| chart(family, curve)).collect();
    let svg = chart::svg(&charts, COLUMNS);
    if arguments.save {
        write_atomically(&results::file("../STIFFNESS.md"), format!("{TITLE}\n{text}"))?;
        write_atomically(&results::file("stiffness.svg"), svg)?;
    } else {
        let folder = report::folder()?;
        write_atomically(&folder.join("stiffness.svg"), svg)?;
        write_atomically(&folder.join("stiffness.png"), chart::png(&charts, COLUMNS)?)?;
    }
    let is_good = measured.iter().all(|(_, curve)| curve.share_of_bound() <= 1.0);
    Ok(Done { text, is_good })
}

/// What a family is, and its table, in Markdown.
fn section(family: &Family, curve: &Curve) -> String {
    let mut lines = vec![format!("## {}\n\n{}\n", family.name, family.about)];
    lines.extend(family.laws.iter().map(|law| slope(law, curve)));
    lines.push(format!("* bound: {}", family.bound));
    lines.push(format!("* end: {}\n", family.end));
    let columns: [Column<Point>; 5] = [
        ("parameter", |point| power(point.parameter)),
        ("error", |point| point.error.map_or_else(String::new, figures)),
        ("bound", |point| point.bound.map_or_else(String::new, figures)),
        ("instances", |point| point.instances.to_string()),
        ("without result", |point| point.without.to_string()),
    ];
    let table = Table::of(0, &columns, curve.points.iter().copied());
    lines.push(format!("parameter: {}; error: {}\n\n{table}", family.parameter, family.error));
    lines.join("\n")
}

/// A law and the slope that is found.
fn slope(law: &Law, curve: &Curve) -> String {
    let [first, last] = law.segment.map(power);
    let found = curve.slope(law).map_or_else(String::new, |slope| format!("{slope:.2}"));
    let Law { slope, why, .. } = law;
    format!("* slope from {first} to {last}: {found}, expected {slope}: {why}")
}

/// A power of two.
fn power(value: f64) -> String {
    format!("2^{}", value.log2())
}

/// A positive number in three figures.
fn figures(value: f64) -> String {
    match value {
        1e-3..1e3 => {
            let decimals = (2.0 - value.log10().floor()).max(0.0) as usize;
            let text = format!("{value:.decimals$}");
            if text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').into()
            } else {
                text
            }
        }
        _ => format!("{value:.2e}"),
    }
}

/// Charts in a row.
const COLUMNS: usize = 3;

/// The error of a family, its bound as a dashed line, and where that ends.
fn chart(family: &Family, curve: &Curve) -> Chart {
    let line = |label: &str, color, height: fn(&Point) -> Option<f64>| {
        let place = |point: &Point| Some([point.parameter, height(point)?].into());
        chart::Curve {
            label: label.into(),
            points: curve.points.iter().filter_map(place).collect(),
            color,
            is_dashed: label == "bound",
            ..chart::Curve::default()
        }
    };
    let axis = |label| Axis::new(label, Scale::Log);
    let has_bound = |point: &&Point| point.bound.is_some();
    let last = curve.points.iter().rev().find(has_bound).map(|point| point.parameter);
    let end = last.filter(|&last| curve.points.iter().any(|point| point.parameter > last));
    let reference = |at| Reference { at: Level::X(at), label: "the bound ends".into() };
    Chart {
        title: family.name.into(),
        x: axis(family.parameter),
        y: axis(family.error),
        curves: vec![line("error", 0, |point| point.error), line("bound", 1, |point| point.bound)],
        references: end.map(reference).into_iter().collect(),
        ..Chart::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_figures() {
        let text =
            [0.125, 16_384.0, 1024.0, 512.0, 2f64.powi(-26), 4.0, 0.00375, 100.0].map(figures);
        let expected = ["0.125", "1.64e4", "1.02e3", "512", "1.49e-8", "4", "0.00375", "100"];
        assert_eq!(text, expected);
    }

    #[test]
    fn a_section_has_the_slopes_found_and_expected() {
        let is_quadratic = |family: &&&Family| family.laws.iter().any(|law| law.slope == 2.0);
        let family = FAMILIES.iter().find(is_quadratic).expect("divisions at every k-th pixel");
        let point = |parameter: f64, error| Point {
            parameter,
            error,
            bound: Some(9.0),
            instances: 7,
            without: 3,
        };
        let points = vec![point(2.0, Some(4.0)), point(4.0, Some(16.0)), point(1024.0, None)];
        let text = section(family, &Curve { points });
        assert!(text.contains("* slope from 2^1 to 2^4: 2.00, expected 2: "), "{text}");
        let row = text.lines().last().unwrap().split('|').map(str::trim);
        assert!(row.eq(["", "2^10", "", "9", "7", "3", ""]), "{text}");
    }
}
