//! The area within the axes of a chart: where values lie on the canvas, and what lies beyond it.

use super::{
    Chart, Curve, Level, Point, Scale,
    axis::Range,
    canvas::{ARROW, Place},
};

/// The size of the area within the axes, in user units, unless its decades are equal.
pub(super) const SIZE: [f64; 2] = [290.0, 270.0];

/// The area within the axes.
#[derive(Clone, Debug)]
pub(super) struct Area {
    scales: [Scale; 2],
    /// Across and up.
    pub(super) ranges: [Range; 2],
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

/// Where the marker of a point stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seat {
    /// Within the area or on its edge.
    pub(super) at: Place,
    /// The direction, to the right and down, in which the point lies beyond the edge; 0 within.
    pub(super) beyond: [f64; 2],
}

impl Seat {
    /// The middle of what is drawn there: an arrow lies within the area, its tip on the edge.
    pub(super) fn middle(self) -> Place {
        [0, 1].map(|index| self.at[index] - ARROW / 2.0 * self.beyond[index])
    }
}

impl Area {
    /// The area of a chart, from its upper left corner.
    pub(super) fn new(chart: &Chart, [left, top]: Place) -> Self {
        let axes = [&chart.x, &chart.y];
        let scales = axes.map(|axis| axis.scale);
        let ranges = [0, 1].map(|index| {
            let curves = chart.curves.iter().flat_map(|curve| curve.values(scales, index));
            let lines = chart.references.iter().map(|reference| reference.at);
            let levels =
                lines.chain(chart.shaded.iter().copied()).filter_map(|level| match level {
                    Level::X(x) => (index == 0).then_some(x),
                    Level::Y(y) => (index == 1).then_some(y),
                });
            let levels = levels.filter(|&level| scales[index].has(level));
            Range::of(axes[index], curves.chain(levels))
        });
        let [width, height] = if chart.has_equal_decades && scales == [Scale::Log; 2] {
            let decades = [0, 1].map(|index| ranges[index].decades());
            let decade = (SIZE[0] / decades[0]).min(SIZE[1] / decades[1]);
            decades.map(|decades| (decade * decades).round())
        } else {
            SIZE
        };
        Self { scales, ranges, left, right: left + width, top, bottom: top + height }
    }

    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// The column of a value of x that has a place on the axis, also beyond the edge.
    pub(super) fn column(&self, x: f64) -> f64 {
        self.left + self.width() * self.ranges[0].place(x)
    }

    /// The height of a value of y that has a place on the axis, also beyond the edge.
    pub(super) fn line(&self, y: f64) -> f64 {
        self.bottom - self.height() * self.ranges[1].place(y)
    }

    /// Whether a place lies within the area. Rounding may move it off by a millionth of a unit.
    pub(super) fn has(&self, [x, y]: Place) -> bool {
        const ROUNDING: f64 = 1e-6;
        (self.left - ROUNDING..=self.right + ROUNDING).contains(&x)
            && (self.top - ROUNDING..=self.bottom + ROUNDING).contains(&y)
    }

    /// The places of the points that a curve's line leads through: those with a place on both
    /// axes.
    pub(super) fn places(&self, curve: &Curve) -> Vec<Place> {
        let points = curve.points.iter().filter(|point| point.has_place(self.scales));
        points.map(|point| [self.column(point.at[0]), self.line(point.at[1])]).collect()
    }

    /// Where a point stands: what has no place on an axis, at the end of that axis.
    pub(super) fn seat(&self, [x, y]: [f64; 2]) -> Seat {
        let part = |index: usize, value: f64| {
            if self.scales[index].has(value) {
                self.ranges[index].place(value)
            } else if value <= 0.0 {
                f64::NEG_INFINITY
            } else {
                f64::INFINITY // infinite, or no number
            }
        };
        let [across, up] = [part(0, x), part(1, y)];
        let beyond = |part: f64| match part {
            ..-1e-9 => -1.0,
            _ if part > 1.0 + 1e-9 => 1.0,
            _ => 0.0,
        };
        let at = [
            self.left + self.width() * across.clamp(0.0, 1.0),
            self.bottom - self.height() * up.clamp(0.0, 1.0),
        ];
        // Adding 0 turns a negative zero into a positive one.
        Seat { at, beyond: [beyond(across), 0.0 - beyond(up)] }
    }

    /// The parts of a line through these places that lie within the area.
    pub(super) fn clip(&self, places: Vec<Place>) -> Vec<Vec<Place>> {
        if places.iter().all(|&place| self.has(place)) {
            return vec![places];
        }
        let mut parts: Vec<Vec<Place>> = Vec::new();
        for pair in places.windows(2) {
            let Some([from, to]) = self.clip_segment(pair[0], pair[1]) else { continue };
            match parts.last_mut() {
                Some(part) if part.last() == Some(&from) => part.push(to),
                _ => parts.push(vec![from, to]),
            }
        }
        parts
    }

    /// The part of a segment within the area, by the method of Liang and Barsky (1984).
    fn clip_segment(&self, from: Place, to: Place) -> Option<[Place; 2]> {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        // The part of the segment from `enter` to `leave`, where the whole is from 0 to 1.
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        let sides = [
            (dx, from[0] - self.left),
            (-dx, self.right - from[0]),
            (dy, from[1] - self.top),
            (-dy, self.bottom - from[1]),
        ];
        for (inwards, inside) in sides {
            if inwards > 0.0 {
                enter = enter.max(-inside / inwards);
            } else if inwards < 0.0 {
                leave = leave.min(inside / -inwards);
            } else if inside < 0.0 {
                return None;
            }
        }
        let at = |part: f64| match part {
            0.0 => from,
            1.0 => to,
            _ => [from[0] + part * dx, from[1] + part * dy],
        };
        (enter < leave).then(|| [at(enter), at(leave)])
    }
}

impl Curve {
    /// The values that an axis (0: x, 1: y) ranges over.
    fn values(&self, scales: [Scale; 2], index: usize) -> impl Iterator<Item = f64> {
        let points = self.points.iter();
        let values = points.filter(move |point| self.marker.is_some() || point.has_place(scales));
        let values = values.flat_map(move |point| {
            let range = if index == 0 { point.x_range } else { point.y_range };
            [point.at[index]].into_iter().chain(range.into_iter().flatten())
        });
        values.filter(move |&value| scales[index].has(value))
    }
}

impl Point {
    /// Whether a line can lead through it.
    fn has_place(&self, scales: [Scale; 2]) -> bool {
        scales[0].has(self.at[0]) && scales[1].has(self.at[1])
    }

    /// Whether it stands for a failure.
    pub(super) fn is_failure(&self) -> bool {
        !self.at.iter().all(|value| value.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Axis, Marker};

    /// From 1 to 1000 across, from 1 to 10 up; 0 to 290 and 270 to 0 in user units.
    fn area(has_equal_decades: bool) -> Area {
        let axis = |last| Axis { range: Some([1.0, last]), ..Axis::new("", Scale::Log) };
        let chart = Chart { x: axis(1e3), y: axis(10.0), has_equal_decades, ..Chart::default() };
        Area::new(&chart, [0.0; 2])
    }

    #[test]
    fn what_lies_beyond_an_axis_stands_at_its_end() {
        let area = area(false);
        let seat = |x, y| area.seat([x, y]);
        assert_eq!(seat(1e3, 1.0), Seat { at: [290.0, 270.0], beyond: [0.0; 2] });
        assert_eq!(seat(0.0, 10.0), Seat { at: [0.0, 0.0], beyond: [-1.0, 0.0] });
        assert_eq!(seat(1.0, 0.5), Seat { at: [0.0, 270.0], beyond: [0.0, 1.0] });
        assert_eq!(seat(f64::INFINITY, 1.0), Seat { at: [290.0, 270.0], beyond: [1.0, 0.0] });
        assert_eq!(seat(1.0, f64::NAN), Seat { at: [0.0, 0.0], beyond: [0.0, -1.0] });
    }

    #[test]
    fn lines_end_at_the_edge() {
        let area = area(false);
        let within = vec![[0.0, 0.0], [290.0, 270.0]];
        assert_eq!(area.clip(within.clone()), [within]);
        // In, out through the right side, back in, and past the upper left corner.
        let places = vec![[280.0, 100.0], [300.0, 120.0], [280.0, 140.0], [-280.0, -180.0]];
        let parts = area.clip(places);
        assert_eq!(parts[0], [[280.0, 100.0], [290.0, 110.0]]);
        assert_eq!(parts[1][..2], [[290.0, 130.0], [280.0, 140.0]]);
        // From (280, 140), 320 down over 560 to the left: y is 0 where x is 35.
        assert!((parts[1][2][0] - 35.0).abs() < 1e-9 && parts[1][2][1].abs() < 1e-9); // rounded
        assert_eq!((parts.len(), parts[1].len()), (2, 3));
        assert!(area.clip(vec![[-1.0, 10.0], [-1.0, 20.0]]).is_empty());
    }

    #[test]
    fn equal_decades_shorten_the_axis_with_fewer() {
        let area = area(true);
        assert_eq!((area.width(), area.height()), (290.0, 97.0)); // a third of 290, in whole units
    }

    #[test]
    fn axes_range_over_error_bars_levels_and_points_at_the_edge() {
        let point = Point { x_range: Some([3.0, 2_000.0]), ..Point::from([5.0, 0.0]) };
        let (points, marker) = (vec![point], Some(Marker::Circle));
        let marked = Curve { points, marker, ..Curve::default() };
        let axis = Axis::new("", Scale::Log);
        let chart = Chart {
            x: axis.clone(),
            y: axis,
            curves: vec![marked],
            shaded: vec![Level::Y(0.1), Level::Y(30.0)],
            ..Chart::default()
        };
        let ends = Area::new(&chart, [0.0; 2]).ranges.map(|range| [range.first, range.last]);
        assert_eq!(ends, [[2.0, 2_000.0], [0.1, 50.0]]);
    }
}
