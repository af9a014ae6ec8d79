//! The command `stiffness`: how errors and cycles grow where a problem is ill-conditioned. Errors
//! are those of the host: frames are the same on all cores.

mod cycles;
mod program;

use anyhow::Result;
use clap::Args;
use host_tools::{
    model::{thousands, write_atomically},
    stiffness::{Curve, FAMILIES, Family, INSTANCES, Law, Point},
};

use self::cycles::Cycles;
use crate::{
    Done,
    chart::{self, Axis, Chart, Level, Reference, Scale},
    cores::Core,
    progress, report, results,
    table::Table,
};

const EXAMPLES: &str = "\
Examples:
  measure stiffness                 A table for each family of problems; target/report/stiffness.png
  measure stiffness m0plus m4       Cycles on these cores too; target/report/stiffness-cycles.png
  measure stiffness m0plus m4 --save
                                    Write tests/measure/STIFFNESS.md and its charts

Exit status: 0 if all errors are within their bounds and cycles grow as expected, 1 if not, 2 for
bad usage or if something is missing.";

/// Measure errors and cycles against stiffness
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores whose cycles are measured in QEMU [default: none]
    #[arg(value_name = "CORE")]
    cores: Vec<Core>,
    /// Write tests/measure/STIFFNESS.md and its charts in tests/measure/results
    #[arg(long, requires = "cores")]
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

A format can be exact and slow, so cycles stand beside errors: those of an instance, the mean of
eight, without wait states and with all that is set up for the object.

Written by `cargo run --quiet --release --package measure -- stiffness m0plus m4 --save`. The tests
of `host-tools` assert the slopes and the bounds of errors (`cargo test -p host-tools stiffness`),
and the command those of cycles.

![Error and bound of each family](results/stiffness.svg)

![Cycles of each family](results/stiffness-cycles.svg)
";

/// A family, and what was measured of it.
#[derive(Debug)]
struct Measured {
    family: &'static Family,
    curve: Curve,
    /// On each core.
    cycles: Vec<(Core, Cycles)>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let measured = measure(arguments)?;
    let text = measured.iter().map(section).collect::<Vec<_>>().join("\n");
    let errors: Vec<_> = measured.iter().map(error_chart).collect();
    let cycles: Vec<_> = measured.iter().map(cycle_chart).collect();
    let charts = [("stiffness", errors), ("stiffness-cycles", cycles)];
    let charts = charts.iter().take(if arguments.cores.is_empty() { 1 } else { 2 });
    if arguments.save {
        write_atomically(&results::file("../STIFFNESS.md"), format!("{TITLE}\n{text}"))?;
    }
    let folder = report::folder()?;
    for (name, charts) in charts {
        let svg = chart::svg(charts, COLUMNS);
        if arguments.save {
            write_atomically(&results::file(&format!("{name}.svg")), svg)?;
        } else {
            write_atomically(&folder.join(format!("{name}.svg")), svg)?;
            write_atomically(&folder.join(format!("{name}.png")), chart::png(charts, COLUMNS)?)?;
        }
    }
    Ok(Done { text, is_good: measured.iter().all(Measured::is_good) })
}

/// Measures all families.
fn measure(arguments: &Arguments) -> Result<Vec<Measured>> {
    let cores = &arguments.cores;
    let progress = progress::over(FAMILIES.len() + cores.len());
    let measure = |family: &'static Family| {
        progress.set_message(family.name);
        let curve = family.measure(INSTANCES);
        progress.inc(1);
        Measured { family, curve, cycles: Vec::new() }
    };
    let mut measured: Vec<_> = FAMILIES.into_iter().map(measure).collect();
    for &core in cores {
        progress.set_message(format!("cycles on {}", core.title()));
        let cycles = cycles::of(core, measured.iter().map(|of| (of.family, &of.curve)))?;
        for (of, cycles) in measured.iter_mut().zip(cycles) {
            of.cycles.push((core, cycles));
        }
        progress.inc(1);
    }
    Ok(measured)
}

impl Measured {
    /// Whether errors are within their bounds, and cycles grow as expected.
    fn is_good(&self) -> bool {
        let is_expected = |law: &Law, cycles: &Cycles| {
            let found = self.slope_of(law, cycles);
            found.is_some_and(|found| (found - law.slope).abs() <= law.tolerance)
        };
        let has_laws = |(_, cycles): &(Core, Cycles)| {
            self.family.cost.laws.iter().all(|law| is_expected(law, cycles))
        };
        self.curve.share_of_bound() <= 1.0 && self.cycles.iter().all(has_laws)
    }

    /// The parameters of the points that have cycles, and these.
    fn points_of(&self, cycles: &Cycles) -> Vec<[f64; 2]> {
        let points = self.curve.points.iter().zip(cycles);
        points.filter_map(|(point, cycles)| Some([point.parameter, (*cycles)?])).collect()
    }

    fn slope_of(&self, law: &Law, cycles: &Cycles) -> Option<f64> {
        law.slope_of(self.points_of(cycles).into_iter())
    }
}

/// What a family is, and its table, in Markdown.
fn section(measured: &Measured) -> String {
    let Measured { family, curve, cycles } = measured;
    let mut lines = vec![format!("## {}\n\n{}\n", family.name, family.about)];
    lines.extend(family.laws.iter().map(|law| slope("slope", law, &[curve.slope(law)])));
    lines.push(format!("* bound: {}", family.bound));
    lines.push(format!("* end: {}", family.end));
    let cost = &family.cost;
    if !cycles.is_empty() {
        lines.push(format!("* cycles: {}", cost.of));
        lines.extend(cost.laws.iter().map(|law| {
            let found: Vec<_> =
                cycles.iter().map(|(_, cycles)| measured.slope_of(law, cycles)).collect();
            slope("slope of cycles", law, &found)
        }));
    }
    let headings = cycles.iter().map(|(core, _)| format!("{} cycles", core.title()));
    let headings: Vec<String> = HEADINGS.map(str::to_owned).into_iter().chain(headings).collect();
    let headings: Vec<_> = headings.iter().map(String::as_str).collect();
    let mut table = Table::new(0, &headings);
    let text = |value: Option<f64>| value.map_or_else(String::new, figures);
    for (number, point) in curve.points.iter().enumerate() {
        let cells = [
            power(point.parameter),
            text(point.error),
            text(point.bound),
            point.instances.to_string(),
            point.without.to_string(),
        ];
        let cycles = cycles.iter().map(|(_, cycles)| {
            cycles[number].map_or_else(String::new, |cycles| thousands(cycles.round() as usize))
        });
        table.row(cells.into_iter().chain(cycles));
    }
    lines.push(format!("\nparameter: {}; error: {}\n\n{table}", family.parameter, family.error));
    lines.join("\n")
}

const HEADINGS: [&str; 5] = ["parameter", "error", "bound", "instances", "without result"];

/// A law of something, and the slopes that are found.
fn slope(what: &str, law: &Law, found: &[Option<f64>]) -> String {
    let [first, last] = law.segment.map(power);
    let text =
        |slope: &Option<f64>| slope.map_or_else(|| "none".into(), |slope| format!("{slope:.2}"));
    let found = found.iter().map(text).collect::<Vec<_>>().join(" and ");
    let Law { slope, why, .. } = law;
    format!("* {what} from {first} to {last}: {found}, expected {slope}: {why}")
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
fn error_chart(Measured { family, curve, .. }: &Measured) -> Chart {
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

/// The cycles of a family, a curve for each core.
fn cycle_chart(measured: &Measured) -> Chart {
    let curve = |(color, (core, cycles)): (usize, &(Core, Cycles))| chart::Curve {
        label: core.title().into(),
        points: measured.points_of(cycles).into_iter().map(Into::into).collect(),
        color,
        ..chart::Curve::default()
    };
    Chart {
        title: measured.family.name.into(),
        x: Axis::new(measured.family.parameter, Scale::Log),
        y: Axis::new(format!("cycles {}", measured.family.cost.of), Scale::Log),
        curves: measured.cycles.iter().enumerate().map(curve).collect(),
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

    /// A family whose error has slope 2, with three points, the last without an error.
    fn quadratic() -> Measured {
        let is_quadratic = |family: &&Family| family.laws.iter().any(|law| law.slope == 2.0);
        let family =
            FAMILIES.into_iter().find(is_quadratic).expect("divisions at every k-th pixel");
        let point = |parameter: f64, error| Point {
            parameter,
            error,
            bound: Some(17.0),
            instances: 7,
            without: 3,
        };
        let points = vec![point(2.0, Some(4.0)), point(4.0, Some(16.0)), point(1024.0, None)];
        Measured { family, curve: Curve { points }, cycles: Vec::new() }
    }

    #[test]
    fn a_section_has_the_slopes_found_and_expected() {
        let text = section(&quadratic());
        assert!(text.contains("* slope from 2^1 to 2^4: 2.00, expected 2: "), "{text}");
        assert!(!text.contains("cycles"), "{text}");
        let row = text.lines().last().unwrap().split('|').map(str::trim);
        assert!(row.eq(["", "2^10", "", "17", "7", "3", ""]), "{text}");
    }

    #[test]
    fn a_section_has_the_cycles_of_cores() {
        let mut measured = quadratic();
        measured.cycles.push((Core::M4, vec![Some(2_000.4), Some(1_000.2), None]));
        let text = section(&measured);
        assert!(text.contains("* slope of cycles from 2^1 to 2^4: -1.00, expected "), "{text}");
        let rows: Vec<Vec<_>> =
            text.lines().map(|line| line.split('|').map(str::trim).collect()).collect();
        let [.., first, second, last] = &rows[..] else { panic!("{text}") };
        assert_eq!([first, second, last].map(|row| row[6]), ["2,000", "1,000", ""]);
        assert_eq!(cycle_chart(&measured).curves[0].points.len(), 2);
    }

    #[test]
    fn errors_beyond_bounds_and_cycles_off_their_slope_are_faults() {
        let mut measured = quadratic();
        assert!(measured.is_good());
        let [law] = measured.family.cost.laws else { panic!("it has one law") };
        let cycles = |slope: f64| vec![Some(1e4), Some(1e4 * 2f64.powf(slope)), None];
        for (slope, is_good) in [(law.slope, true), (law.slope + 1.1 * law.tolerance, false)] {
            measured.cycles = vec![(Core::M4, cycles(slope))];
            assert_eq!(measured.is_good(), is_good, "{slope}");
        }
        measured.cycles.clear();
        measured.curve.points[1].error = Some(18.0);
        assert!(!measured.is_good());
    }
}
