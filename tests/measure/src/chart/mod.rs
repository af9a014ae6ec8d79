//! Charts as SVG and as PNG: lines, staircases and scattered points, on linear or logarithmic axes.
//!
//! This file has what a chart consists of. [`axis`] and [`area`] say where values lie, [`labels`]
//! finds room for text, [`draw`] puts the parts onto a [`canvas`]: [`mod@svg`] or [`mod@png`].

mod area;
mod axis;
mod canvas;
mod draw;
mod labels;
mod png;
mod svg;

use anyhow::{Context as _, Result};

/// A chart. Its axes range over all that it shows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    /// Later ones are drawn over earlier ones.
    pub(crate) curves: Vec<Curve>,
    pub(crate) references: Vec<Reference>,
    /// Regions with a light background: what is left of an x, or below a y.
    pub(crate) shaded: Vec<Level>,
    /// Makes a decade as long on one axis as on the other, so that slopes can be compared by eye.
    /// It counts where both are logarithmic; the area is then lower or narrower than otherwise.
    pub(crate) has_equal_decades: bool,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Axis {
    pub(crate) label: String,
    pub(crate) scale: Scale,
    /// The values at the ends, the lesser one first; on a logarithmic axis both are above 0. What
    /// lies beyond is cut off, and markers stand at the edge as arrows. Without a range, the ends
    /// are round numbers around all values.
    pub(crate) range: Option<[f64; 2]>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Scale {
    #[default]
    Linear,
    /// Points at 0 or below have no place on it: markers stand at its lower end as arrows, and
    /// lines leave them out.
    Log,
}

/// A curve, or points that belong together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Curve {
    /// Stands to the right of the chart, as near to the curve's last point as there is room. A
    /// curve without a label is left out there.
    pub(crate) label: String,
    pub(crate) points: Vec<Point>,
    pub(crate) shape: Shape,
    /// Without a marker, points have neither error bars nor labels, and those without a place on
    /// the axes are left out.
    pub(crate) marker: Option<Marker>,
    /// An index into the palette of six colours; larger ones wrap around.
    pub(crate) color: usize,
    pub(crate) is_dashed: bool,
}

/// A point of a curve.
#[derive(Clone, Debug, Default)]
pub(crate) struct Point {
    /// Its x and y. A point with a coordinate that is infinite or no number has failed: it stands
    /// as a cross at the end of that axis.
    pub(crate) at: [f64; 2],
    /// The ends of a level error bar: values of x.
    pub(crate) x_range: Option<[f64; 2]>,
    /// The ends of an upright error bar: values of y.
    pub(crate) y_range: Option<[f64; 2]>,
    /// A few characters beside the point, where they overlap least.
    pub(crate) label: String,
}

/// How a curve leads from point to point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Straight from point to point.
    #[default]
    Line,
    /// Keeps the height of each point up to the column of the next.
    Steps,
    /// Not at all: only the markers are drawn.
    Markers,
}

/// The sign at each point of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
}

/// A dashed line across the area, with a label. It is left out where it is outside a stated range.
#[derive(Clone, Debug)]
pub(crate) struct Reference {
    pub(crate) at: Level,
    pub(crate) label: String,
}

/// A value on one of the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Level {
    X(f64),
    Y(f64),
}

impl Axis {
    /// An axis that ranges over all values.
    pub(crate) fn new(label: impl Into<String>, scale: Scale) -> Self {
        Self { label: label.into(), scale, range: None }
    }
}

/// A point without error bars and without a label.
impl From<[f64; 2]> for Point {
    fn from(at: [f64; 2]) -> Self {
        Self { at, ..Self::default() }
    }
}

/// Returns a picture of the charts as SVG, `columns` of them in a row.
pub(crate) fn svg(charts: &[Chart], columns: usize) -> String {
    let mut canvas = svg::Svg::new(draw::size(charts, columns));
    draw::charts(&mut canvas, charts, columns);
    canvas.finish()
}

/// Returns the picture of [`svg()`] as a PNG file, with two dots to a user unit.
///
/// # Errors
///
/// If there is no chart.
pub(crate) fn png(charts: &[Chart], columns: usize) -> Result<Vec<u8>> {
    let mut canvas = png::Dots::new(draw::size(charts, columns));
    draw::charts(&mut canvas, charts, columns);
    canvas.finish().context("a picture of the charts could not be written")
}

#[cfg(test)]
mod tests;
