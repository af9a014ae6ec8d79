//! Ear clipping of a polygon in the plane.
//!
//! An ear is a convex corner whose triangle holds no other part of the polygon. Cutting n - 2 ears
//! leaves nothing, and each side of the polygon is a side of one triangle, also if the polygon is
//! degenerate: without an ear, a corner is cut all the same.
//!
//! Only corners that are not convex can lie in an ear; a grid finds them. A corner is tried again
//! only after a neighbour or the corner in its way has gone. In a large polygon every other corner
//! is cut, so that ears stay small and meet few cells of the grid. So the time is near-linear, and
//! grows as n^1.5 if most ears are as long as the polygon.

use std::collections::VecDeque;

pub(super) type Point = [f64; 2];

/// Polygons of more corners are cut at every other corner; others in a fan from each.
const LARGE: usize = 32;

/// How many corners are compared if there is no ear.
const COMPARED: usize = 16;

/// More than the rounding of coordinates of up to 2.
const ROUNDING: f64 = 1e-12;

const NONE: u32 = u32::MAX;

/// Twice the area of a triangle, positive if it is counter-clockwise. An area within the rounding
/// of coordinates of up to 2 is 0: see `has_area` in the module `triangulate`.
fn area(a: Point, b: Point, c: Point) -> f64 {
    let (ab, ac) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let area = ab[0] * ac[1] - ab[1] * ac[0];
    let longest = [ab[0], ab[1], ac[0], ac[1], ac[0] - ab[0], ac[1] - ab[1]]
        .into_iter()
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    if area.abs() > 8.0 * f64::EPSILON * longest { area } else { 0.0 }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    Convex,
    Flat,
    Reflex,
    /// Cut.
    Gone,
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    point: Point,
    previous: u32,
    next: u32,
    turn: Turn,
    /// The ticket of its place in the queue; 0 without one.
    ticket: u32,
    /// The place in [`EarClipper::waiting`] of the first corner that this one keeps from being an
    /// ear.
    first_waiting: u32,
    /// The next corner in the same cell of the grid.
    next_in_cell: u32,
}

/// Cuts polygons into triangles. Keeps its memory from one polygon to the next.
#[derive(Debug, Default)]
pub(super) struct EarClipper {
    corners: Vec<Corner>,
    /// The corners to try, each with the ticket of its place.
    queue: VecDeque<(u32, u32)>,
    /// The last ticket.
    tickets: u32,
    /// Corners that wait for another to go, each with the place of the next one that does.
    waiting: Vec<(u32, u32)>,
    grid: Grid,
    /// A corner that is not cut.
    cursor: u32,
}

impl EarClipper {
    /// Cuts a polygon of at least three corners that is counter-clockwise, and appends the corners'
    /// numbers to `triangles`.
    pub(super) fn clip(&mut self, ring: &[Point], triangles: &mut Vec<[u32; 3]>) {
        self.start(ring);
        let is_large = ring.len() > LARGE;
        let mut left = ring.len();
        while left >= 3 {
            let Some(corner) = self.next_ear() else { continue };
            let Corner { previous, next, .. } = self.corners[corner as usize];
            triangles.push([previous, corner, next]);
            left -= 1;
            self.cut(corner);
            self.queue_last(previous);
            if is_large {
                self.queue_last(next);
            } else if self.corners[next as usize].ticket == 0 {
                let ticket = self.new_ticket(next);
                self.queue.push_front((next, ticket));
            }
        }
    }

    fn start(&mut self, ring: &[Point]) {
        let n = ring.len() as u32;
        self.corners.clear();
        self.corners.extend((0..n).zip(ring).map(|(i, &point)| Corner {
            point,
            previous: (i + n - 1) % n,
            next: (i + 1) % n,
            turn: Turn::Reflex,
            ticket: 0,
            first_waiting: NONE,
            next_in_cell: NONE,
        }));
        self.queue.clear();
        self.waiting.clear();
        self.tickets = 0;
        self.cursor = 0;
        for corner in 0..n {
            self.corners[corner as usize].turn = self.turn(corner);
        }
        self.grid.fill(&mut self.corners);
        self.queue_last(n - 1);
        (0..n - 1).for_each(|corner| self.queue_last(corner));
    }

    fn points(&self, corner: u32) -> [Point; 3] {
        let Corner { previous, next, .. } = self.corners[corner as usize];
        [previous, corner, next].map(|i| self.corners[i as usize].point)
    }

    fn turn(&self, corner: u32) -> Turn {
        let [a, b, c] = self.points(corner);
        match area(a, b, c) {
            0.0 => Turn::Flat,
            area if area > 0.0 => Turn::Convex,
            _ => Turn::Reflex,
        }
    }

    fn new_ticket(&mut self, corner: u32) -> u32 {
        self.tickets += 1;
        self.corners[corner as usize].ticket = self.tickets;
        self.tickets
    }

    /// Puts a corner at the end of the queue, also if it has a place further ahead.
    fn queue_last(&mut self, corner: u32) {
        let ticket = self.new_ticket(corner);
        self.queue.push_back((corner, ticket));
    }

    /// Tries the next corner. Returns it if it is an ear, or any one if the queue is empty.
    fn next_ear(&mut self) -> Option<u32> {
        let Some((corner, ticket)) = self.queue.pop_front() else {
            return Some(self.least_bad());
        };
        let Corner { turn, ticket: valid, .. } = self.corners[corner as usize];
        if turn == Turn::Gone || ticket != valid {
            return None;
        }
        self.corners[corner as usize].ticket = 0;
        if turn != Turn::Convex {
            return None;
        }
        let Some(blocker) = self.blocker(corner) else {
            return Some(corner);
        };
        let first = &mut self.corners[blocker as usize].first_waiting;
        let place = self.waiting.len() as u32;
        self.waiting.push((corner, std::mem::replace(first, place)));
        None
    }

    /// The corner to cut if there is no ear: the rest has no area, or the polygon crosses itself. A
    /// flat corner does no harm.
    fn least_bad(&self) -> u32 {
        let next = |&corner: &u32| Some(self.corners[corner as usize].next);
        let candidates = std::iter::successors(Some(self.cursor), next).take(COMPARED);
        let rank = |corner: &u32| match self.corners[*corner as usize].turn {
            Turn::Flat => 0,
            Turn::Convex => 1,
            Turn::Reflex | Turn::Gone => 2,
        };
        candidates.min_by_key(rank).unwrap_or(self.cursor)
    }

    /// Takes a corner out of the polygon, and queues those that may have become ears.
    fn cut(&mut self, corner: u32) {
        let Corner { previous, next, .. } = self.corners[corner as usize];
        self.corners[previous as usize].next = next;
        self.corners[next as usize].previous = previous;
        if self.corners[corner as usize].turn != Turn::Convex {
            self.grid.remove(corner, &mut self.corners);
        }
        self.corners[corner as usize].turn = Turn::Gone;
        self.cursor = next;
        self.wake(corner);
        for neighbour in [previous, next] {
            let turn = self.turn(neighbour);
            let before = std::mem::replace(&mut self.corners[neighbour as usize].turn, turn);
            match (before == Turn::Convex, turn == Turn::Convex) {
                (false, true) => {
                    self.grid.remove(neighbour, &mut self.corners);
                    self.wake(neighbour);
                }
                (true, false) => self.grid.insert(neighbour, &mut self.corners),
                _ => {}
            }
        }
    }

    /// Queues the corners that wait for this one.
    fn wake(&mut self, corner: u32) {
        let first = &mut self.corners[corner as usize].first_waiting;
        let mut place = std::mem::replace(first, NONE);
        while place != NONE {
            let (waiting, next) = self.waiting[place as usize];
            self.queue_last(waiting);
            place = next;
        }
    }

    /// A corner that keeps a convex one from being an ear.
    fn blocker(&self, ear: u32) -> Option<u32> {
        let Corner { previous, next, .. } = self.corners[ear as usize];
        let triangle = self.points(ear);
        let corner = |index: u32| (index != NONE).then_some(index);
        let in_cell = |cell: usize| {
            let following = move |&index: &u32| corner(self.corners[index as usize].next_in_cell);
            std::iter::successors(corner(self.grid.first[cell]), following)
        };
        let mut candidates = self.grid.cells(triangle).flat_map(in_cell);
        candidates.find(|&corner| {
            ![previous, ear, next].contains(&corner) && self.is_in(corner, triangle)
        })
    }

    /// Whether a corner lies in a counter-clockwise triangle, or within its third side. One on
    /// another side or at a corner of the triangle is in it if it has a neighbour in there.
    fn is_in(&self, corner: u32, [a, b, c]: [Point; 3]) -> bool {
        let Corner { point, previous, next, .. } = self.corners[corner as usize];
        let sides = [(a, b), (b, c), (c, a)];
        let areas = sides.map(|(from, to)| area(from, to, point));
        if areas.iter().any(|&area| area < 0.0) {
            return false;
        }
        let leads_inside = |neighbour: u32| {
            let point = self.corners[neighbour as usize].point;
            let is_left = |(from, to)| area(from, to, point) > 0.0;
            sides.into_iter().zip(areas).all(|(side, area)| area > 0.0 || is_left(side))
        };
        areas[0] > 0.0 && areas[1] > 0.0 || leads_inside(previous) || leads_inside(next)
    }
}

/// The corners that are not convex, by place.
#[derive(Debug, Default)]
struct Grid {
    /// The first corner in each cell, row by row; no cells without corners.
    first: Vec<u32>,
    /// How many cells are in a row, and in a column.
    side: usize,
    /// The least coordinates.
    least: Point,
    /// Cells per unit along each axis.
    density: Point,
}

impl Grid {
    fn fill(&mut self, corners: &mut [Corner]) {
        let (mut count, mut most) = (0_usize, [f64::NEG_INFINITY; 2]);
        self.least = [f64::INFINITY; 2];
        for corner in corners.iter().filter(|corner| corner.turn != Turn::Convex) {
            count += 1;
            for (axis, x) in corner.point.into_iter().enumerate() {
                self.least[axis] = self.least[axis].min(x);
                most[axis] = most[axis].max(x);
            }
        }
        self.side = count.isqrt();
        self.density = [0, 1].map(|axis| match most[axis] - self.least[axis] {
            extent if extent > 0.0 => self.side as f64 / extent,
            _ => 0.0,
        });
        self.first.clear();
        self.first.resize(self.side * self.side, NONE);
        for index in 0..corners.len() as u32 {
            if corners[index as usize].turn != Turn::Convex {
                self.insert(index, corners);
            }
        }
    }

    fn cell(&self, [x, y]: Point) -> usize {
        self.place(y, 1) * self.side + self.place(x, 0)
    }

    fn insert(&mut self, index: u32, corners: &mut [Corner]) {
        if self.side > 0 {
            let corner = &mut corners[index as usize];
            let cell = self.cell(corner.point);
            corner.next_in_cell = std::mem::replace(&mut self.first[cell], index);
        }
    }

    fn remove(&mut self, index: u32, corners: &mut [Corner]) {
        if self.side == 0 {
            return;
        }
        let Corner { point, next_in_cell, .. } = corners[index as usize];
        let cell = self.cell(point);
        if self.first[cell] == index {
            self.first[cell] = next_in_cell;
            return;
        }
        let mut before = self.first[cell];
        while before != NONE && corners[before as usize].next_in_cell != index {
            before = corners[before as usize].next_in_cell;
        }
        if before != NONE {
            corners[before as usize].next_in_cell = next_in_cell;
        }
    }

    /// The column or row of a coordinate. One beyond the grid has the nearest.
    fn place(&self, x: f64, axis: usize) -> usize {
        let place = (x - self.least[axis]) * self.density[axis];
        // A cast of a negative number gives 0.
        (place as usize).min(self.side - 1)
    }

    /// The cells that a triangle meets.
    fn cells(&self, triangle: [Point; 3]) -> impl Iterator<Item = usize> + use<'_> {
        let [low, high] = range(triangle.map(|[_, y]| y));
        let rows = if self.side == 0 { 0..0 } else { self.place(low, 1)..self.place(high, 1) + 1 };
        rows.flat_map(move |row| {
            let [left, right] = self.width(triangle, row);
            let columns = self.place(left - ROUNDING, 0)..=self.place(right + ROUNDING, 0);
            columns.map(move |column| row * self.side + column)
        })
    }

    /// From where to where a triangle goes within a row. A long side would otherwise meet all the
    /// cells of its bounding box.
    fn width(&self, triangle: [Point; 3], row: usize) -> [f64; 2] {
        // What lies beyond the grid counts as in its outer rows.
        let at = |row: usize| self.least[1] + row as f64 / self.density[1];
        let bottom = if row == 0 { f64::NEG_INFINITY } else { at(row) - ROUNDING };
        let top = if row + 1 == self.side { f64::INFINITY } else { at(row + 1) + ROUNDING };
        let [a, b, c] = triangle;
        let mut width = [f64::INFINITY, f64::NEG_INFINITY];
        for [p, q] in [[a, b], [b, c], [c, a]] {
            let [low, high] = if p[1] <= q[1] { [p, q] } else { [q, p] };
            if high[1] < bottom || low[1] > top {
                continue;
            }
            let rise = high[1] - low[1];
            for y in [low[1].max(bottom), high[1].min(top)] {
                let step = if rise > 0.0 { (y - low[1]) / rise } else { 0.0 };
                let x = low[0] + step * (high[0] - low[0]);
                width = [width[0].min(x), width[1].max(x)];
            }
            if rise == 0.0 {
                width = [width[0].min(high[0]), width[1].max(high[0])];
            }
        }
        width
    }
}

/// The least and the most of three numbers.
const fn range([a, b, c]: [f64; 3]) -> [f64; 2] {
    [a.min(b).min(c), a.max(b).max(c)]
}
