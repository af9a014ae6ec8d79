//! Room for labels: beside points, where they overlap as little as possible, and in the legend.

use super::{
    area::Area,
    canvas::{Anchor, Place, TextSize},
};

/// The distance from one line of text to the next, in user units.
pub(super) const LINE_HEIGHT: f64 = 15.0;

/// Where a text can stand: the place of its base line, and which part of it stands there.
pub(super) type Candidate = (Place, Anchor);

/// A rectangle by its least and its greatest coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    from: Place,
    to: Place,
}

impl Extent {
    /// A square around a place.
    pub(super) const fn around([x, y]: Place, half: f64) -> Self {
        Self { from: [x - half, y - half], to: [x + half, y + half] }
    }

    fn of_text(text: &str, ([x, y], anchor): Candidate, size: TextSize) -> Self {
        let width = size.width_of(text);
        let left = match anchor {
            Anchor::Start => x,
            Anchor::Middle => x - width / 2.0,
            Anchor::End => x - width,
        };
        // Letters rise above the base line by about eight tenths of the size.
        let [above, below] = [0.8, 0.2].map(|part| part * size.units());
        Self { from: [left, y - above], to: [left + width, y + below] }
    }

    fn area(self) -> f64 {
        (self.to[0] - self.from[0]).max(0.0) * (self.to[1] - self.from[1]).max(0.0)
    }

    fn overlap(self, other: Self) -> f64 {
        let from = [0, 1].map(|index| self.from[index].max(other.from[index]));
        let to = [0, 1].map(|index| self.to[index].min(other.to[index]));
        Self { from, to }.area()
    }
}

/// What labels within the axes keep clear of.
#[derive(Clone, Debug)]
pub(super) struct Room {
    frame: Extent,
    taken: Vec<Extent>,
}

impl Room {
    pub(super) const fn new(area: &Area) -> Self {
        let frame = Extent { from: [area.left, area.top], to: [area.right, area.bottom] };
        Self { frame, taken: Vec::new() }
    }

    pub(super) fn take(&mut self, taken: Extent) {
        self.taken.push(taken);
    }

    /// Takes small squares along a line. A label across it costs less than one across another.
    pub(super) fn take_line(&mut self, corners: &[Place]) {
        const STEP: f64 = 4.0;
        for pair in corners.windows(2) {
            let [dx, dy] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let count = (dx.hypot(dy) / STEP).ceil();
            for step in 0..count as usize {
                let part = step as f64 / count;
                self.take(Extent::around([pair[0][0] + part * dx, pair[0][1] + part * dy], 1.5));
            }
        }
    }

    /// Takes the best of some places for a small text: the first of those that overlap least. What
    /// is outside the frame counts several times, as it may meet the labels of the axes.
    pub(super) fn place(&mut self, text: &str, candidates: &[Candidate]) -> Option<Candidate> {
        const OUTSIDE: f64 = 4.0;
        let bounds = |&candidate: &Candidate| Extent::of_text(text, candidate, TextSize::Small);
        let cost = |candidate: &Candidate| {
            let bounds = bounds(candidate);
            let outside = bounds.area() - bounds.overlap(self.frame);
            let overlap: f64 = self.taken.iter().map(|&taken| bounds.overlap(taken)).sum();
            overlap + OUTSIDE * outside
        };
        let best = candidates.iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).copied();
        self.taken.extend(best.as_ref().map(bounds));
        best
    }
}

/// Where the label of a point can stand: on eight sides of it, the right one first.
pub(super) fn beside_point([x, y]: Place) -> [Candidate; 8] {
    [
        ([x + 8.0, y + 3.5], Anchor::Start),
        ([x - 8.0, y + 3.5], Anchor::End),
        ([x, y - 8.0], Anchor::Middle),
        ([x, y + 15.0], Anchor::Middle),
        ([x + 6.0, y - 6.0], Anchor::Start),
        ([x + 6.0, y + 13.0], Anchor::Start),
        ([x - 6.0, y - 6.0], Anchor::End),
        ([x - 6.0, y + 13.0], Anchor::End),
    ]
}

/// Where the label of an upright line across the area can stand.
pub(super) fn beside_upright(x: f64, area: &Area) -> [Candidate; 6] {
    let middle = (area.top + area.bottom) / 2.0;
    let heights = [area.top + 12.0, area.bottom - 6.0, middle];
    let at = |side: f64, y: f64| {
        ([x + 4.0 * side, y], if side > 0.0 { Anchor::Start } else { Anchor::End })
    };
    let [high, low, middle] = heights.map(|y| [at(1.0, y), at(-1.0, y)]);
    [high[0], high[1], low[0], low[1], middle[0], middle[1]]
}

/// Where the label of a level line across the area can stand.
pub(super) fn beside_level(y: f64, area: &Area) -> [Candidate; 6] {
    let columns = [
        (area.right - 4.0, Anchor::End),
        (area.left + 4.0, Anchor::Start),
        ((area.left + area.right) / 2.0, Anchor::Middle),
    ];
    let [right, left, middle] =
        columns.map(|(x, anchor)| [([x, y - 4.0], anchor), ([x, y + 11.0], anchor)]);
    [right[0], right[1], left[0], left[1], middle[0], middle[1]]
}

/// Heights near these, at least a line apart and none below `bottom`.
pub(super) fn spread(heights: &[f64], bottom: f64) -> Vec<f64> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::Chart;

    #[test]
    fn labels_neither_overlap_nor_fall_below_the_chart() {
        assert_eq!(spread(&[10.0, 100.0, 12.0, 11.0], 300.0), [10.0, 100.0, 40.0, 25.0]);
        assert_eq!(spread(&[299.0, 300.0], 300.0), [285.0, 300.0]);
    }

    #[test]
    fn a_label_moves_to_the_side_that_is_free() {
        let mut room = Room::new(&Area::new(&Chart::default(), [0.0; 2])); // 290 by 270 units
        let mut side = |at: Place| {
            let sides = beside_point(at);
            let best = room.place("abc", &sides).unwrap();
            sides.iter().position(|&side| side == best).unwrap()
        };
        assert_eq!(side([100.0, 100.0]), 0);
        // On the right stands the label of the point before; it is 18 units wide.
        assert_eq!(side([98.0, 104.0]), 1);
        // On the right is the edge, too.
        assert_eq!(side([285.0, 200.0]), 1);
        room.take_line(&[[0.0, 50.0], [290.0, 50.0]]);
        // The line passes on the right and on the left.
        let best = room.place("abc", &beside_point([100.0, 50.0])).unwrap();
        assert_eq!(best, ([100.0, 42.0], Anchor::Middle));
    }
}
