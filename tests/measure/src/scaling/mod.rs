//! The command `scaling`: how the cost of a frame grows with its triangles, and with its pixels.

mod curve;

use anyhow::Result;
use clap::Args;
pub(crate) use curve::Scaling;
use curve::{Curve, Point, Points};

use crate::{
    Done,
    chart::{self, Axis, Chart, Scale, Shape},
    cores::Core,
    cost,
    figures::{Figures, PerCore, count},
    plugin::Output,
    table::{Column, Table},
};

const EXAMPLES: &str = "\
Examples:
  measure scaling                   Cortex-M0+ and Cortex-M4
  measure scaling --save            Figures and chart for the repository: tests/measure/RESULTS.md

Exit status: 0 if all is well, 2 for bad usage or if something is missing.";

/// Count instructions against the number of triangles, and of pixels
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The cores [default: m0plus and m4]
    #[arg(value_name = "CORE", default_values = ["m0plus", "m4"], hide_default_value = true)]
    cores: Vec<Core>,
    /// Write the figures to tests/measure/results/scaling.json, and render tests/measure/RESULTS.md
    #[arg(long)]
    save: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Done> {
    let scaling: Scaling = PerCore::measure(&Core::or_all(&arguments.cores))?;
    let done = Done { text: scaling.tables(), is_good: true };
    if arguments.save {
        scaling.save()?;
    }
    Ok(done)
}

impl Figures for Points {
    const FILE: &str = "scaling.json";
    const TITLE: &str = "Scaling";
    const PROGRAMS: &[&str] = &["scaling"];

    const LEGEND: &str = "\
Instructions for a frame, the mean of four, without those that clear its depth; all with Gouraud
shading and depth test on 320 x 240 pixels. *drawn* counts triangles after culling and clipping.
*exponent* is that of the growth since the row above: 0 where more triangles or pixels cost nothing,
1 where the cost grows in proportion to them. The chart shows each core in the precision that suits
it: S4 on the Cortex-M0+, S8 on the others.

![Instructions against triangles and against pixels](results/scaling.svg)";

    fn parse(outputs: &[Output]) -> Result<Self> {
        let lines = cost::lines(&outputs[0])?.into_iter();
        Ok(Self { points: lines.map(Point::new).collect() })
    }

    fn tables(&self, _: Core) -> Vec<(&'static str, Table)> {
        Curve::ALL.into_iter().map(|curve| (curve.title(), table(self, curve))).collect()
    }
}

/// A curve in both precisions.
fn table(points: &Points, curve: Curve) -> Table {
    type Row<'a> = [(&'a Point, Option<f64>); 2];
    fn exponent((_, exponent): (&Point, Option<f64>)) -> String {
        exponent.map_or_else(String::new, |exponent| format!("{exponent:.2}"))
    }
    let [at, per_item] =
        if curve.is_of_triangles() { ["triangles", "/ triangle"] } else { ["width", "/ pixel"] };
    let columns: [Column<Row<'_>>; 10] = [
        (at, |row| count(row[0].0.key.at)),
        ("drawn", |row| count(row[0].0.triangles_drawn)),
        ("pixels", |row| count(row[0].0.pixels_drawn)),
        ("vertices", |row| count(row[0].0.vertices)),
        ("S4", |row| count(row[0].0.instructions)),
        (per_item, |row| format!("{:.1}", row[0].0.per_item())),
        ("exponent", |row| exponent(row[0])),
        ("S8", |row| count(row[1].0.instructions)),
        (per_item, |row| format!("{:.1}", row[1].0.per_item())),
        ("exponent", |row| exponent(row[1])),
    ];
    let [coarse, fine] = ["S4", "S8"].map(|precision| points.curve(curve, precision));
    Table::of(0, &columns, coarse.into_iter().zip(fine).map(|(coarse, fine)| [coarse, fine]))
}

/// Draws the instructions, and below them the exponents, in the precision that suits each core.
pub(crate) fn chart(scaling: &Scaling) -> String {
    let triangles = [(Curve::SphereTriangles, "sphere"), (Curve::SquareTriangles, "square")];
    let widths = [(Curve::SphereWidths, "sphere"), (Curve::CubeWidths, "cube")];
    let instructions = || Axis::new("instructions", Scale::Log);
    let exponent = || Axis::new("exponent", Scale::Linear);
    let of_triangles = || Axis::new("triangles of the model", Scale::Log);
    let of_widths = || Axis::new("width in pixels (the display has 320 x 240)", Scale::Log);
    let charts = [
        ("Instructions by triangles", of_triangles(), instructions(), Shape::Line, triangles),
        ("Instructions by width", of_widths(), instructions(), Shape::Line, widths),
        ("Growth with the triangles", of_triangles(), exponent(), Shape::Steps, triangles),
        ("Growth with the pixels", of_widths(), exponent(), Shape::Steps, widths),
    ];
    let charts = charts.map(|(title, x, y, shape, curves)| {
        let mut lines = Vec::new();
        for core in &scaling.cores {
            for (number, (curve, name)) in curves.into_iter().enumerate() {
                let precision = if core.core == Core::M0plus { "S4" } else { "S8" };
                let points = core.figures.curve(curve, precision);
                let places = match shape {
                    Shape::Line => heights(&points),
                    _ => growth(&points),
                };
                lines.push(chart::Curve {
                    label: format!("{name}, {}", core.core.title()),
                    points: places.into_iter().map(chart::Point::from).collect(),
                    shape,
                    color: core.core as usize,
                    is_dashed: number == 1,
                    ..chart::Curve::default()
                });
            }
        }
        Chart { title: title.to_owned(), x, y, curves: lines, ..Chart::default() }
    });
    chart::svg(&charts, 2)
}

/// The instructions at each point.
fn heights(points: &[(&Point, Option<f64>)]) -> Vec<[f64; 2]> {
    points.iter().map(|(point, _)| [point.key.at as f64, point.instructions as f64]).collect()
}

/// The exponents, each from one point to the next, up to the first pair without one.
fn growth(points: &[(&Point, Option<f64>)]) -> Vec<[f64; 2]> {
    let start = |pair: &[(&Point, Option<f64>)]| Some([pair[0].0.key.at as f64, pair[1].1?]);
    let mut steps: Vec<_> = points.windows(2).map_while(start).collect();
    if let (Some(&[_, last]), Some(end)) = (steps.last(), points.get(steps.len())) {
        steps.push([end.0.key.at as f64, last]);
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::{curve::tests::scaling, *};

    const POINTS: [(u64, u64); 3] = [(100, 10_000), (10_000, 1_000_000), (10_000, 1_000_000)];

    #[test]
    fn a_table_has_both_precisions_and_exponents() {
        let mut points = scaling(Curve::SquareTriangles, &POINTS[..2]).cores.remove(0).figures;
        points.points.extend(points.points.clone());
        points.points[..2].iter_mut().for_each(|point| point.key.precision = "S4".into());
        points.points[1].instructions = 100_000;
        let text = table(&points, Curve::SquareTriangles).to_string();
        let row: Vec<_> = text.lines().last().unwrap().split('|').map(str::trim).collect();
        let expected =
            ["10,000", "5,000", "10,000", "250,000", "100,000", "10.0", "0.50", "1,000,000"];
        assert_eq!(row[1..9], expected);
        assert_eq!(row[9..11], ["100.0", "1.00"]);
    }

    #[test]
    fn the_chart_has_instructions_as_lines_and_exponents_as_steps() {
        let text = chart(&scaling(Curve::SphereTriangles, &POINTS));
        assert!(text.contains(r#"d="M60.0 318.0L350.0 48.0L350.0 48.0""#), "{text}");
        // The last pair of points has no exponent.
        assert_eq!(text.matches("H350.0V").count(), 1, "{text}");
        assert_eq!(text.matches(">sphere, Cortex-M4</text>").count(), 4);
    }
}
