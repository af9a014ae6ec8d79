//! The layout of a chart: where its parts stand, and in which order they are drawn.

use super::{
    Chart, Curve, Level, Point, Shape,
    area::{Area, Seat},
    canvas::{Anchor, Canvas, Color, Glyph, Line, Place, Stroke, TextSize},
    labels::{self, Extent, LINE_HEIGHT, Room},
};

/// The least size of a chart with its labels, in user units.
const CELL: [f64; 2] = [520.0, 370.0];
/// The length of a curve's sample in the legend, the distance from it to the label, and that from
/// the label to the next chart.
const SAMPLE: f64 = 18.0;
const TO_LABEL: f64 = 6.0;
const GAP: f64 = 10.0;
/// The upper left corner of the area within the cell.
const CORNER: Place = [60.0, 48.0];
/// The half of an error bar's end, and of the square that labels leave to a marker.
const BAR_END: f64 = 3.0;
const MARKER: f64 = 6.0;

/// Draws all charts, `columns` of them in a row.
pub(super) fn charts(canvas: &mut impl Canvas, charts: &[Chart], columns: usize) {
    let [width, height] = cell(charts);
    for (index, chart) in charts.iter().enumerate() {
        let [column, row] = [index % columns, index / columns].map(|place| place as f64);
        let corner = [width * column + CORNER[0], height * row + CORNER[1]];
        Drawing { chart, area: Area::new(chart, corner), canvas }.draw();
    }
}

/// A chart that is being drawn.
struct Drawing<'a, C> {
    chart: &'a Chart,
    area: Area,
    canvas: &'a mut C,
}

impl<C: Canvas> Drawing<'_, C> {
    fn draw(&mut self) {
        let mut room = Room::new(&self.area);
        self.shade();
        self.titles();
        self.grid();
        for reference in &self.chart.references {
            self.reference(reference.at, &mut room);
        }
        for curve in &self.chart.curves {
            self.curve(curve, &mut room);
        }
        for curve in &self.chart.curves {
            self.points(curve, &mut room);
        }
        self.labels(&mut room);
        self.legend();
    }

    fn shade(&mut self) {
        for &level in &self.chart.shaded {
            let Area { left, right, top, bottom, .. } = self.area;
            let [x, y] = self.edge(level);
            let (corner, size) = match level {
                Level::X(_) => ([left, top], [x - left, bottom - top]),
                Level::Y(_) => ([left, y], [right - left, bottom - y]),
            };
            self.canvas.rectangle(corner, size, Color::SHADE);
        }
    }

    fn titles(&mut self) {
        let chart = self.chart;
        let Area { left, top, bottom, .. } = self.area;
        self.text(&chart.title, [left, top - 28.0], TextSize::Title, Anchor::Start);
        self.text(&chart.y.label, [left, top - 8.0], TextSize::Normal, Anchor::Start);
        // Below a narrow area a long label begins at the left border of the cell.
        let half = TextSize::Normal.width_of(&chart.x.label) / 2.0;
        let middle = (left + self.area.width() / 2.0).max(left - CORNER[0] + half);
        self.text(&chart.x.label, [middle, bottom + 40.0], TextSize::Normal, Anchor::Middle);
    }

    fn grid(&mut self) {
        let Area { left, right, top, bottom, .. } = self.area;
        let [across, up] = self.area.ranges.clone();
        let gap = 4.0;
        let width = self.area.width();
        let labels = across.labels(|text| (TextSize::Normal.width_of(text) + gap) / width);
        for (&tick, label) in across.ticks.iter().zip(labels) {
            let x = self.area.column(tick);
            self.canvas.line(&Line::Upright { x, top, bottom }, Stroke::thin(Color::GRID));
            self.text(
                &label.unwrap_or_default(),
                [x, bottom + 18.0],
                TextSize::Normal,
                Anchor::Middle,
            );
        }
        let height = self.area.height();
        let labels = up.labels(|_| TextSize::Normal.units() / height);
        for (&tick, label) in up.ticks.iter().zip(labels) {
            let y = self.area.line(tick);
            self.canvas.line(&Line::Level { y, left, right }, Stroke::thin(Color::GRID));
            self.text(
                &label.unwrap_or_default(),
                [left - 8.0, y + 4.0],
                TextSize::Normal,
                Anchor::End,
            );
        }
        let axes = [&self.chart.x, &self.chart.y];
        if is_marked(self.chart) || axes.iter().any(|axis| axis.range.is_some()) {
            // Something may stand at the edge or end there, so the edge has to be seen.
            for x in [left, right] {
                self.canvas.line(&Line::Upright { x, top, bottom }, Stroke::thin(Color::GRID));
            }
            for y in [top, bottom] {
                self.canvas.line(&Line::Level { y, left, right }, Stroke::thin(Color::GRID));
            }
        }
    }

    fn reference(&mut self, level: Level, room: &mut Room) {
        if !self.is_within(level) {
            return;
        }
        let Area { left, right, top, bottom, .. } = self.area;
        let [x, y] = self.edge(level);
        let line = match level {
            Level::X(_) => Line::Upright { x, top, bottom },
            Level::Y(_) => Line::Level { y, left, right },
        };
        room.take_line(&line.corners());
        self.canvas.line(&line, Stroke { is_dashed: true, ..Stroke::thin(Color::REFERENCE) });
    }

    /// Draws the line of a curve.
    fn curve(&mut self, curve: &Curve, room: &mut Room) {
        let places = self.area.places(curve);
        let is_within = places.iter().all(|&place| self.area.has(place));
        let lines: Vec<_> = match curve.shape {
            Shape::Markers => return,
            Shape::Steps if is_within => vec![Line::Steps(places)],
            Shape::Steps => {
                let corners = Line::Steps(places).corners();
                self.area.clip(corners).into_iter().map(Line::Straight).collect()
            }
            Shape::Line => self.area.clip(places).into_iter().map(Line::Straight).collect(),
        };
        for line in lines {
            room.take_line(&line.corners());
            self.canvas.line(&line, curve.stroke());
        }
    }

    /// Draws the error bars and the markers of a curve.
    fn points(&mut self, curve: &Curve, room: &mut Room) {
        let Some(marker) = curve.marker else { return };
        let color = Color::of_palette(curve.color);
        for point in &curve.points {
            if !point.is_failure() {
                self.error_bars(point, color, room);
            }
            let seat = self.area.seat(point.at);
            let glyph = match seat.beyond {
                _ if point.is_failure() => Glyph::Failure,
                [0.0, 0.0] => Glyph::Marker(marker),
                beyond => Glyph::Arrow(beyond),
            };
            self.canvas.glyph(glyph, seat.at, color);
            room.take(Extent::around(middle(point, seat), MARKER));
        }
    }

    fn error_bars(&mut self, point: &Point, color: Color, room: &mut Room) {
        let [x, y] = point.at;
        let ends = [
            point.x_range.map(|range| range.map(|x| self.area.seat([x, y]))),
            point.y_range.map(|range| range.map(|y| self.area.seat([x, y]))),
        ];
        for (index, ends) in ends.into_iter().enumerate() {
            let Some(ends) = ends else { continue };
            // A bar that is wholly beyond the edge has no length.
            let bar = ends.map(|end| end.at);
            if bar[0] == bar[1] || ends[0].beyond[1 - index] != 0.0 {
                continue;
            }
            let mut lines = vec![bar];
            // A bar that continues beyond the edge has no end there.
            for end in ends.iter().filter(|end| end.beyond[index] == 0.0) {
                let side = |offset: f64| {
                    let mut place = end.at;
                    place[1 - index] += offset;
                    place
                };
                lines.push([side(-BAR_END), side(BAR_END)]);
            }
            for line in lines {
                self.canvas.line(&Line::Straight(line.to_vec()), Stroke::thin(color));
            }
            room.take_line(&bar);
        }
    }

    /// Writes the labels of points, then those of references.
    fn labels(&mut self, room: &mut Room) {
        let curves = self.chart.curves.iter().filter(|curve| curve.marker.is_some());
        for point in curves.flat_map(|curve| &curve.points) {
            let middle = middle(point, self.area.seat(point.at));
            self.small_label(&point.label, &labels::beside_point(middle), room);
        }
        for reference in &self.chart.references {
            if !self.is_within(reference.at) {
                continue;
            }
            let [x, y] = self.edge(reference.at);
            let candidates = match reference.at {
                Level::X(_) => labels::beside_upright(x, &self.area),
                Level::Y(_) => labels::beside_level(y, &self.area),
            };
            self.small_label(&reference.label, &candidates, room);
        }
    }

    fn small_label(&mut self, text: &str, candidates: &[labels::Candidate], room: &mut Room) {
        if text.is_empty() {
            return;
        }
        if let Some((at, anchor)) = room.place(text, candidates) {
            self.text(text, at, TextSize::Small, anchor);
        }
    }

    fn legend(&mut self) {
        let Area { right, top, bottom, .. } = self.area;
        let curves: Vec<_> =
            self.chart.curves.iter().filter(|curve| !curve.label.is_empty()).collect();
        let ends: Vec<_> = curves
            .iter()
            .map(|curve| self.area.places(curve).last().map_or(bottom, |end| end[1]))
            .map(|y| y.clamp(top, bottom))
            .collect();
        // A low area may have less height than the legend.
        let limit = bottom.max(top + LINE_HEIGHT * curves.len().saturating_sub(1) as f64);
        let left = right + to_samples(self.chart);
        for (curve, y) in curves.into_iter().zip(labels::spread(&ends, limit)) {
            if curve.shape != Shape::Markers {
                let sample = Line::Sample { at: [left, y], width: SAMPLE };
                self.canvas.line(&sample, curve.stroke());
            }
            if let Some(marker) = curve.marker {
                let at = [left + SAMPLE / 2.0, y];
                self.canvas.glyph(Glyph::Marker(marker), at, Color::of_palette(curve.color));
            }
            let at = [left + SAMPLE + TO_LABEL, y + 4.0];
            self.text(&curve.label, at, TextSize::Normal, Anchor::Start);
        }
    }

    /// Where a level meets the axis that it belongs to; the other coordinate has no meaning.
    fn edge(&self, level: Level) -> Place {
        self.seat_of(level).at
    }

    fn is_within(&self, level: Level) -> bool {
        let [x, y] = self.seat_of(level).beyond;
        match level {
            Level::X(_) => x == 0.0,
            Level::Y(_) => y == 0.0,
        }
    }

    fn seat_of(&self, level: Level) -> Seat {
        let [x, y] = self.area.ranges.each_ref().map(|range| range.first);
        self.area.seat(match level {
            Level::X(x) => [x, y],
            Level::Y(y) => [x, y],
        })
    }

    /// Writes a text, if it has characters.
    fn text(&mut self, text: &str, at: Place, size: TextSize, anchor: Anchor) {
        if !text.is_empty() {
            self.canvas.text(text, at, size, anchor);
        }
    }
}

/// The middle of what stands for a point.
fn middle(point: &Point, seat: Seat) -> Place {
    if point.is_failure() { seat.at } else { seat.middle() }
}

impl Curve {
    const fn stroke(&self) -> Stroke {
        let color = Color::of_palette(self.color);
        Stroke { color, width: 2.0, is_dashed: self.is_dashed }
    }
}

/// The size of a picture of charts, in user units.
pub(super) fn size(charts: &[Chart], columns: usize) -> [f64; 2] {
    let [width, height] = cell(charts);
    [width * columns as f64, height * charts.len().div_ceil(columns) as f64]
}

/// The size of each chart of a picture: as wide as the one with the longest legend needs it.
fn cell(charts: &[Chart]) -> [f64; 2] {
    let width = |chart: &Chart| {
        let labels = chart.curves.iter().map(|curve| TextSize::Normal.width_of(&curve.label));
        let to_labels = Area::new(chart, CORNER).right + to_samples(chart) + SAMPLE + TO_LABEL;
        to_labels + labels.fold(0.0, f64::max) + GAP
    };
    [charts.iter().map(width).fold(CELL[0], f64::max).ceil(), CELL[1]]
}

/// From the area to the legend. A marker at the edge takes some of the gap.
fn to_samples(chart: &Chart) -> f64 {
    if is_marked(chart) { 14.0 } else { 8.0 }
}

fn is_marked(chart: &Chart) -> bool {
    chart.curves.iter().any(|curve| curve.marker.is_some())
}
