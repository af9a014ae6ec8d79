//! The curves as a picture: two charts with logarithmic axes, in SVG.

use std::fmt::Write as _;

use super::curve::{Curve, Points, Scaling};
use crate::{cores::Core, per_core::Measured};

/// Of the picture, and of the area within a chart's axes, in user units.
const PICTURE: [f64; 2] = [1000.0, 400.0];
const AREA: [f64; 2] = [300.0, 300.0];
/// The left upper corners of the charts' areas.
const CORNERS: [[f64; 2]; 2] = [[64.0, 44.0], [564.0, 44.0]];
/// Names at the ends of the lines keep this distance.
const LINE_HEIGHT: f64 = 15.0;

/// Colours that can be told apart on white and on black, and by those who see red and green alike
/// (Okabe and Ito, "Color Universal Design", 2008: blue, vermillion, bluish green, reddish purple,
/// orange).
const STYLE: &str = "\
text { font: 12px sans-serif; fill: #444; }
.title { font-size: 14px; fill: #222; }
.grid { stroke: #8886; stroke-width: 1; }
.line { fill: none; stroke-width: 2; stroke-linejoin: round; }
.second { stroke-dasharray: 6 3; }
.m0plus { stroke: #0072b2; } .m4 { stroke: #d55e00; } .m7 { stroke: #009e73; } .m33 { stroke: #cc79a7; }
.riscv { stroke: #e69f00; }
@media (prefers-color-scheme: dark) { text { fill: #bbb; } .title { fill: #eee; } .m0plus { stroke: #56b4e9; } }
";

/// A line of a chart.
struct Line {
    core: Core,
    name: &'static str,
    is_second: bool,
    /// Where, and how many instructions.
    points: Vec<[f64; 2]>,
}

struct Chart {
    title: &'static str,
    horizontal: &'static str,
    lines: Vec<Line>,
}

/// The picture of some cores' curves, each in the precision that suits the core.
pub(super) fn svg(scaling: &Scaling) -> String {
    let lines = |curves: [(Curve, &'static str); 2]| {
        let mut lines = Vec::new();
        for core in &scaling.cores {
            for (number, (curve, name)) in curves.into_iter().enumerate() {
                lines.push(Line {
                    core: core.core,
                    name,
                    is_second: number == 1,
                    points: points(core, curve),
                });
            }
        }
        lines
    };
    let charts = [
        Chart {
            title: "Instructions for a frame of more and more triangles",
            horizontal: "triangles of the model",
            lines: lines([(Curve::SphereTriangles, "sphere"), (Curve::SquareTriangles, "square")]),
        },
        Chart {
            title: "Instructions for a frame of a wider and wider model",
            horizontal: "its width in pixels (the display has 320 x 240)",
            lines: lines([(Curve::SphereWidths, "sphere"), (Curve::CubeWidths, "cube")]),
        },
    ];
    let [width, height] = PICTURE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\">\n\
         <style>\n{STYLE}</style>\n"
    );
    for (chart, corner) in charts.iter().zip(CORNERS) {
        chart.draw(&mut svg, corner);
    }
    svg + "</svg>\n"
}

fn points(core: &Measured<Points>, curve: Curve) -> Vec<[f64; 2]> {
    let precision = if core.core == Core::M0plus { "S4" } else { "S8" };
    let points = core.figures.curve(curve, precision);
    points.iter().map(|point| [point.at as f64, point.instructions as f64]).collect()
}

/// A logarithmic axis: the decimal logarithms of its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    first: f64,
    last: f64,
}

impl Axis {
    /// From the least of the values to the largest; at least a decade.
    fn over(values: impl Iterator<Item = f64>) -> Self {
        let range = |(first, last): (f64, f64), log: f64| (first.min(log), last.max(log));
        let (first, last) =
            values.map(|value| value.max(1.0).log10()).fold((f64::INFINITY, 0.0), range);
        let first = first.min(last);
        Self { first, last: last.max(first + 1.0) }
    }

    /// The whole decades that it touches.
    const fn of_whole_decades(self) -> Self {
        Self { first: self.first.floor(), last: self.last.ceil() }
    }

    /// Where a value lies, from 0 to 1.
    fn at(self, value: f64) -> f64 {
        (value.max(1.0).log10() - self.first) / (self.last - self.first)
    }

    /// The decades on it and their labels.
    fn decades(self) -> impl Iterator<Item = (f64, String)> {
        (self.first.ceil() as i32..=self.last.floor() as i32).map(|exponent| {
            let (power, unit) = [(6, "M"), (3, "k"), (0, "")]
                .into_iter()
                .find(|(power, _)| exponent >= *power)
                .unwrap_or((0, ""));
            (
                10f64.powi(exponent),
                format!("{}{unit}", 10u64.pow((exponent - power).unsigned_abs())),
            )
        })
    }
}

impl Chart {
    fn draw(&self, svg: &mut String, [left, top]: [f64; 2]) {
        let [width, height] = AREA;
        let values = |axis: usize| {
            self.lines.iter().flat_map(move |line| line.points.iter().map(move |point| point[axis]))
        };
        let (across, up) = (Axis::over(values(0)), Axis::over(values(1)).of_whole_decades());
        let place =
            |[x, y]: [f64; 2]| [left + width * across.at(x), top + height * (1.0 - up.at(y))];
        let bottom = top + height;

        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<text class=\"title\" x=\"{left}\" y=\"{}\">{}</text>",
            top - 18.0,
            self.title
        );
        let middle = left + width / 2.0;
        let _ = writeln!(
            svg,
            "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            bottom + 42.0,
            self.horizontal
        );
        for (value, label) in across.decades() {
            let x = left + width * across.at(value);
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{x:.1} {top}V{bottom}\"/><text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{label}</text>",
                bottom + 20.0
            );
        }
        for (value, label) in up.decades() {
            let y = top + height * (1.0 - up.at(value));
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{left} {y:.1}h{width}\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                left - 8.0,
                y + 4.0
            );
        }
        for line in &self.lines {
            let points = line.points.iter().map(|&point| place(point));
            let points: Vec<_> = points.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
            let _ = writeln!(
                svg,
                "<polyline class=\"line {}{}\" points=\"{}\"/>",
                line.core.name(),
                if line.is_second { " second" } else { "" },
                points.join(" ")
            );
        }
        let ends =
            self.lines.iter().map(|line| line.points.last().map_or(bottom, |&end| place(end)[1]));
        let ends: Vec<_> = ends.collect();
        for (line, y) in self.lines.iter().zip(spread(&ends)) {
            let (name, x) = (line.name, left + width + 8.0);
            let _ = writeln!(
                svg,
                "<text x=\"{x}\" y=\"{:.1}\">{name}, {}</text>",
                y + 4.0,
                line.core.title()
            );
        }
    }
}

/// Heights for names near these, none of them closer to another than a line.
fn spread(heights: &[f64]) -> Vec<f64> {
    let mut order: Vec<_> = (0..heights.len()).collect();
    order.sort_by(|&a, &b| heights[a].total_cmp(&heights[b]));
    let mut spread = heights.to_vec();
    for pair in 1..order.len() {
        let (above, below) = (order[pair - 1], order[pair]);
        spread[below] = spread[below].max(spread[above] + LINE_HEIGHT);
    }
    spread
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scaling::curve::tests::scaling;

    #[test]
    fn an_axis_has_its_values_in_proportion_to_their_logarithms() {
        let axis = Axis::over([100.0, 100_000.0, 500.0].into_iter());
        assert_eq!((axis.at(100.0), axis.at(100_000.0)), (0.0, 1.0));
        assert!((axis.at(1_000.0) - 1.0 / 3.0).abs() < 1e-9); // logarithms are rounded
        assert_eq!(Axis::over(std::iter::empty()), Axis { first: 0.0, last: 1.0 });
    }

    #[test]
    fn the_decades_on_an_axis_are_labelled() {
        let labels =
            |axis: Axis| axis.decades().map(|(_, label)| label).collect::<Vec<_>>().join(" ");
        let axis = Axis::over([98.0, 25_000_000.0].into_iter());
        assert_eq!(labels(axis), "100 1k 10k 100k 1M 10M");
        assert_eq!(labels(axis.of_whole_decades()), "10 100 1k 10k 100k 1M 10M 100M");
    }

    #[test]
    fn names_do_not_overlap() {
        assert_eq!(spread(&[10.0, 100.0, 12.0, 11.0]), [10.0, 100.0, 40.0, 25.0]);
    }

    #[test]
    fn every_curve_is_a_line_in_the_picture() {
        let mut two = scaling(Curve::SphereTriangles, &[(100, 10_000), (10_000, 1_000_000)]);
        two.cores[0].core = Core::M0plus;
        let text = svg(&two);
        // Both lie on the diagonal of an area of two decades by two.
        assert!(
            text.contains("<polyline class=\"line m0plus\" points=\"64.0,344.0 364.0,44.0\"/>"),
            "{text}"
        );
        assert_eq!(text.matches("<polyline").count(), 4);
        assert!(text.contains(">sphere, Cortex-M0+</text>"));
    }
}
