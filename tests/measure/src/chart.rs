//! Line charts as SVG, with linear or logarithmic axes.

use std::fmt::Write as _;

/// A chart. Its axes range over all points of its curves.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    pub(crate) title: &'static str,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) curves: Vec<Curve>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub(crate) label: &'static str,
    pub(crate) scale: Scale,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    Linear,
    /// Points at 0 or below have no place on it and are left out.
    Log,
}

/// A curve. Two points make a horizontal line across the chart.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    /// Stands to the right of the chart, as near to the curve's last point as there is room.
    pub(crate) label: String,
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) shape: Shape,
    /// An index into the palette of six colours; larger ones wrap around.
    pub(crate) color: usize,
    pub(crate) is_dashed: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Straight from point to point.
    Line,
    /// Keeps the height of each point up to the column of the next.
    Steps,
}

/// The size of a chart with its labels, and of the area within its axes, in user units.
const CELL: [f64; 2] = [520.0, 370.0];
const AREA: [f64; 2] = [290.0, 270.0];
/// The upper left corner of the area within the cell.
const CORNER: [f64; 2] = [60.0, 48.0];
const LINE_HEIGHT: f64 = 15.0;

/// Colours that people who see red and green alike can tell apart (Okabe and Ito, "Color Universal
/// Design", 2008: blue, vermillion, bluish green, reddish purple, orange), and a grey.
const PALETTE: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#777777"];

/// Returns a picture of the charts, `columns` of them in a row.
pub(crate) fn svg(charts: &[Chart], columns: usize) -> String {
    let [width, height] = [columns, charts.len().div_ceil(columns)];
    let [width, height] = [CELL[0] * width as f64, CELL[1] * height as f64];
    let mut svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"
 width="{width}" height="{height}" font-family="sans-serif" font-size="12">
<rect width="100%" height="100%" fill="white"/>
"#
    );
    for (index, chart) in charts.iter().enumerate() {
        let [column, row] = [index % columns, index / columns].map(|place| place as f64);
        chart.draw(&mut svg, [CELL[0] * column + CORNER[0], CELL[1] * row + CORNER[1]]);
    }
    svg + "</svg>\n"
}

impl Chart {
    fn draw(&self, svg: &mut String, [left, top]: [f64; 2]) {
        let [right, bottom] = [left + AREA[0], top + AREA[1]];
        let has_place = |&&[x, y]: &&[f64; 2]| self.x.scale.has(x) && self.y.scale.has(y);
        let range = |axis: Axis, index: usize| {
            let points = self.curves.iter().flat_map(|curve| &curve.points).filter(has_place);
            Range::over(axis.scale, points.map(|point| point[index]))
        };
        let (across, up) = (range(self.x, 0), range(self.y, 1));
        let column = |x| left + AREA[0] * across.place(x);
        let line = |y| bottom - AREA[1] * up.place(y);

        text(svg, [left, top - 28.0], r#"font-size="14""#, self.title);
        text(svg, [left, top - 8.0], "", self.y.label);
        let middle = r#"text-anchor="middle""#;
        text(svg, [left + AREA[0] / 2.0, bottom + 40.0], middle, self.x.label);
        for &tick in &across.ticks {
            path(svg, &format!("M{:.1} {top}V{bottom}", column(tick)), r##"stroke="#ddd""##);
            text(svg, [column(tick), bottom + 18.0], middle, &label(tick));
        }
        for &tick in &up.ticks {
            path(svg, &format!("M{left} {:.1}H{right}", line(tick)), r##"stroke="#ddd""##);
            text(svg, [left - 8.0, line(tick) + 4.0], r#"text-anchor="end""#, &label(tick));
        }
        let mut ends = Vec::new();
        for curve in &self.curves {
            let points = curve.points.iter().filter(has_place);
            let points: Vec<_> = points.map(|&[x, y]| [column(x), line(y)]).collect();
            let mut data = String::new();
            for (number, [x, y]) in points.iter().enumerate() {
                // Writing to a string cannot fail.
                let _ = match curve.shape {
                    _ if number == 0 => write!(data, "M{x:.1} {y:.1}"),
                    Shape::Line => write!(data, "L{x:.1} {y:.1}"),
                    Shape::Steps => write!(data, "H{x:.1}V{y:.1}"),
                };
            }
            path(svg, &data, &curve.stroke());
            ends.push(points.last().map_or(bottom, |end| end[1]));
        }
        for (curve, y) in self.curves.iter().zip(spread(&ends, bottom)) {
            path(svg, &format!("M{} {y:.1}h18", right + 8.0), &curve.stroke());
            text(svg, [right + 32.0, y + 4.0], "", &curve.label);
        }
    }
}

impl Curve {
    fn stroke(&self) -> String {
        let color = PALETTE[self.color % PALETTE.len()];
        let dashes = if self.is_dashed { "6 3" } else { "none" };
        format!(r#"stroke="{color}" stroke-width="2" stroke-dasharray="{dashes}""#)
    }
}

impl Scale {
    fn has(self, value: f64) -> bool {
        self == Self::Linear || value > 0.0
    }
}

/// The values from one end of an axis to the other, and those that are marked on it.
#[derive(Clone, Debug, PartialEq)]
struct Range {
    scale: Scale,
    first: f64,
    last: f64,
    ticks: Vec<f64>,
}

impl Range {
    /// From the least value to the greatest, both moved outwards to a round number.
    fn over(scale: Scale, values: impl Iterator<Item = f64>) -> Self {
        let (first, last) = values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (value.min(a), value.max(b)));
        let (first, last) = if first <= last { (first, last) } else { (1.0, 1.0) };
        if scale == Scale::Linear {
            let last = if last > first { last } else { first + 1.0 };
            let step = round_up((last - first) / 5.0);
            let (first, last) = ((first / step).floor(), (last / step).ceil());
            let ticks = (first as i32..=last as i32).map(|tick| step * f64::from(tick)).collect();
            return Self { scale, first: first * step, last: last * step, ticks };
        }
        let (first, last) = (1.0 / round_up(1.0 / first), round_up(last));
        let last = if last > first { last } else { 10.0 * first };
        // Beyond three decades there is no room for labels between them.
        let factors = if last < 999.0 * first { &[1.0, 2.0, 5.0][..] } else { &[1.0] };
        let exponents = first.log10().floor() as i32..=last.log10().ceil() as i32;
        let ticks = exponents.flat_map(|exponent| factors.iter().map(move |f| f * power(exponent)));
        let is_between = |tick: &f64| (0.999 * first..1.001 * last).contains(tick);
        Self { scale, first, last, ticks: ticks.filter(is_between).collect() }
    }

    /// Where a value lies: 0 at the first, 1 at the last.
    fn place(&self, value: f64) -> f64 {
        let [value, first, last] = [value, self.first, self.last]
            .map(|value| if self.scale == Scale::Log { value.log10() } else { value });
        (value - first) / (last - first)
    }
}

/// The least of 1, 2, 5 and 10 times a power of ten that is not below a positive value.
fn round_up(value: f64) -> f64 {
    let decade = power(value.log10().floor() as i32);
    let is_enough = |factor: &f64| factor * decade >= 0.999_999 * value;
    decade * [1.0, 2.0, 5.0].into_iter().find(is_enough).unwrap_or(10.0)
}

fn power(exponent: i32) -> f64 {
    10f64.powi(exponent)
}

/// A tick's label, as in 0.2, 100, 20k, 3M.
fn label(value: f64) -> String {
    let units = [(1e9, "G"), (1e6, "M"), (1e3, "k")];
    let unit = units.into_iter().find(|(unit, _)| value.abs() >= 0.999 * unit);
    let (unit, name) = unit.unwrap_or((1.0, ""));
    format!("{}{name}", (value / unit * 1e6).round() / 1e6)
}

/// Heights near these, at least a line apart and none below `bottom`.
fn spread(heights: &[f64], bottom: f64) -> Vec<f64> {
    let mut order: Vec<_> = (0..heights.len()).collect();
    order.sort_by(|&a, &b| heights[a].total_cmp(&heights[b]));
    let mut spread = heights.to_vec();
    for pair in order.windows(2) {
        spread[pair[1]] = spread[pair[1]].max(spread[pair[0]] + LINE_HEIGHT);
    }
    let mut limit = bottom;
    for &index in order.iter().rev() {
        spread[index] = spread[index].min(limit);
        limit = spread[index] - LINE_HEIGHT;
    }
    spread
}

fn path(svg: &mut String, data: &str, attributes: &str) {
    *svg += &format!("<path d=\"{data}\" fill=\"none\" {attributes}/>\n");
}

fn text(svg: &mut String, [x, y]: [f64; 2], attributes: &str, text: &str) {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    *svg += &format!("<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"#333\" {attributes}>{text}</text>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: Scale, values: &[f64]) -> String {
        let range = Range::over(scale, values.iter().copied());
        range.ticks.iter().map(|&tick| label(tick)).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn axes_end_and_are_marked_at_round_numbers() {
        assert_eq!(labels(Scale::Log, &[98.0, 25_000_000.0]), "100 1k 10k 100k 1M 10M");
        assert_eq!(labels(Scale::Log, &[0.3, 8.0]), "0.2 0.5 1 2 5 10");
        assert_eq!(labels(Scale::Log, &[100.0]), "100 200 500 1k");
        assert_eq!(labels(Scale::Linear, &[-0.1, 0.93]), "-0.5 0 0.5 1");
        assert_eq!(labels(Scale::Linear, &[12_000.0, 20_500.0]), "12k 14k 16k 18k 20k 22k");
        assert_eq!(labels(Scale::Linear, &[]), "1 1.2 1.4 1.6 1.8 2");
    }

    #[test]
    fn places_are_in_proportion_to_values_or_to_their_logarithms() {
        let place = |scale, value| Range::over(scale, [100.0, 100_000.0].into_iter()).place(value);
        for (scale, middle) in [(Scale::Log, 1_000.0), (Scale::Linear, 33_333.333_333)] {
            assert!((place(scale, 100_000.0) - 1.0).abs() < 1e-9);
            assert!((place(scale, middle) - 1.0 / 3.0).abs() < 1e-9); // logarithms are rounded
        }
    }

    #[test]
    fn labels_neither_overlap_nor_fall_below_the_chart() {
        assert_eq!(spread(&[10.0, 100.0, 12.0, 11.0], 300.0), [10.0, 100.0, 40.0, 25.0]);
        assert_eq!(spread(&[299.0, 300.0], 300.0), [285.0, 300.0]);
    }

    #[test]
    fn lines_lead_from_point_to_point_and_steps_by_a_corner() {
        let points = vec![[100.0, 10_000.0], [0.0, 500.0], [10_000.0, 1_000_000.0]];
        let curve = |shape| {
            let label = "a < b".to_owned();
            Curve { label, points: points.clone(), shape, color: 7, is_dashed: true }
        };
        let axis = Axis { label: "", scale: Scale::Log };
        let curves = vec![curve(Shape::Line), curve(Shape::Steps)];
        let text = svg(&[Chart { title: "", x: axis, y: axis, curves }], 1);
        let stroke = r##"fill="none" stroke="#d55e00" stroke-width="2" stroke-dasharray="6 3"/>"##;
        for data in ["M60.0 318.0L350.0 48.0", "M60.0 318.0H350.0V48.0"] {
            assert!(text.contains(&format!("<path d=\"{data}\" {stroke}")), "{text}");
        }
        assert_eq!(text.matches(">a &lt; b</text>").count(), 2);
    }
}
