//! Where the ends of lines and points belong: the exact segment between two vertices of the tables,
//! cut in view space by the near plane, the far plane, the guard band and the user's planes.
//!
//! Where a plane cuts a line, an end's place along the line depends on how steeply the line meets
//! the plane. So each plane has a margin within which the core may see a point on its other side:
//! [`AXIS`] units of clip space in each coordinate, with as much more for each plane that cuts. The
//! planes moved outwards by their margins leave the longest line that the core may draw, moved
//! inwards the shortest. Each end belongs between those of the two, within what the core promises
//! of a vertex ([`Placement::of_cut`]); so do its depth and its colour. A line of which the planes
//! leave nothing even if they lie farther outside must not be there, and one of which they leave a
//! part even if they lie farther inside must be.

use super::{
    LineEndError, LineOutcome, Subpixel, View,
    judged_lines::{End, worse},
    placement::{GUARD, Placement, along},
};
use crate::{
    model::Model,
    reference::{Camera, HalfSpace, Projection, part_inside},
};

/// In units of clip space: how far each coordinate of a vertex may be off, and how far a plane that
/// cuts a line may move it, by the documentation of [`ClipAll`](rasterizer::geometry::ClipAll).
const AXIS: f64 = 4.0;
/// In units of clip space: a plane lies at a whole unit, and whole units tell the sides.
const WHOLE: f64 = 2.0;
/// A unit is a 2^30th of the largest coordinate, which is rounded up to a power of two.
const UNIT: f64 = 2.0 / (1 << 30) as f64;
/// The relative error of a depth besides that of w, and the same of 1 in a parallel projection: by
/// the documentation of a depth of 32 bits.
const DEPTH: f64 = 1.0 / (1 << 27) as f64;
/// In units of 2^-32: a vertex on the near plane has two units less than 1.
const STORED: f64 = 2.0;
/// In 8-bit steps: a colour is rounded to a 256th of a step at a vertex, and once more by each
/// plane that cuts a line.
const COLOR: f64 = 1.0 / 256.0;
/// The side of a plane of the user's is certain from a 1,000th of a quantum and a 2^26th of the
/// distance from the mesh's origin on, by the documentation of
/// [`ClipPlanes`](rasterizer::geometry::ClipPlanes). The reference turns planes by exact angles,
/// and entries of the core's rotation are off by as much again.
const SIDE: [f64; 2] = [1e-3, 1.0 / (1 << 25) as f64];

/// A plane that may cut lines, with what makes its margin.
#[derive(Clone, Copy, Debug)]
struct LinePlane {
    side: HalfSpace,
    /// The part that is the same for all lines, in lengths of the normal.
    margin: f64,
    /// For each unit by which the coordinates of a point may be off.
    per_unit: f64,
}

impl LinePlane {
    /// In lengths of the normal, for a line that up to this number of planes cut.
    fn margin(&self, cuts: usize) -> f64 {
        self.margin + AXIS * (1 + cuts) as f64 * self.per_unit
    }
}

/// The exact ends of the lines and points of a model in a view.
pub(super) struct LineEnds {
    camera: Camera,
    placement: Placement,
    /// In the order in which the core cuts.
    planes: Vec<LinePlane>,
    /// A unit of z, in world units.
    unit: f64,
    subpixel_bits: u32,
    /// The vertices of the tables in view space, in the view's form.
    points: Vec<[f64; 3]>,
    /// Their colours, if they have some.
    colors: Vec<[f64; 3]>,
    /// Whether all of the object lies on the outer side of a plane of the picture, so that the core
    /// draws nothing of it.
    is_outside_picture: bool,
}

/// What the planes leave of a line: how far along it starts and ends.
struct Part {
    /// The longest that the core may draw.
    longest: [f64; 2],
    /// The shortest; `None` if it may draw none.
    shortest: Option<[f64; 2]>,
    /// How many planes may cut it.
    cuts: usize,
}

impl LineEnds {
    /// Of a model in a view whose numbers are the core's.
    pub(super) fn new(model: &Model, view: &View) -> Self {
        let camera = view.reference_camera();
        let placement = Placement::new(model, view);
        let posed = |points: &[[f64; 3]]| -> Vec<[f64; 3]> {
            view.core_pose_points(points).into_iter().map(|p| camera.to_view(p)).collect()
        };
        let (origin, size) = view.form.extent(model);
        let (_, scale) = view.core_place();
        // A point of the box is within the root of 3 of this; with a fraction the core's limit is
        // twice as far.
        let reach = scale * size * if view.subpixel == Subpixel::S8 { 3.5 } else { 1.75 };
        let origin = posed(&[origin])[0].map(f64::abs);
        let aside = origin[0].max(origin[1]) + reach;
        let away = origin[2] + reach;
        // The lengths of a unit, of z in world units and of x, y and w in pixels times w; and how
        // many of these three the distance from a side of the guard band depends on.
        let (unit, unit_aside, axes_aside) = match camera.projection {
            Projection::Perspective { focal_length_px, .. } => {
                let unit = UNIT * away.max(aside * focal_length_px / GUARD);
                (unit, GUARD * unit, 2.0)
            }
            // w is 1, exactly.
            Projection::Orthographic { pixels_per_unit, far, .. } => {
                let across = (aside * pixels_per_unit / GUARD).max(1.0);
                (UNIT * away.max(far), GUARD * UNIT * across, 1.0)
            }
        };
        let (near_and_far, own) = placement.planes().split_at(2);
        let near_and_far = near_and_far.iter().map(|plane| plane.side);
        let of_view = near_and_far.clone().map(|side| LinePlane {
            side,
            margin: WHOLE * unit,
            per_unit: unit,
        });
        let of_guard = placement.aside([GUARD; 2]).map(|side| LinePlane {
            side,
            margin: WHOLE * unit_aside,
            per_unit: axes_aside * unit_aside,
        });
        let own = own.iter().map(|plane| LinePlane {
            side: plane.side,
            margin: SIDE[0] * plane.margin + SIDE[1] * reach,
            per_unit: 0.0,
        });
        let planes = own.chain(of_view).chain(of_guard).collect();
        let corners = posed(&view.form.box_corners(model));
        let half = [camera.viewport.width, camera.viewport.height].map(|side| side / 2.0);
        let is_outside = |side: HalfSpace| corners.iter().all(|&c| side.depth(c) < 0.0);
        Self {
            points: posed(&view.form.table_positions(model)),
            colors: model.vertex_colors.iter().map(|c| c.map(f64::from)).collect(),
            is_outside_picture: near_and_far.chain(placement.aside(half)).any(is_outside),
            camera,
            placement,
            planes,
            unit,
            subpixel_bits: view.subpixel.bits(),
        }
    }

    /// Judges a line between two vertices of the tables, or a point at one of them twice. `drawn`
    /// has the ends as the core places them, or none if it leaves the line out; their colours count
    /// if they are those of vertices.
    pub(super) fn judge(
        &self,
        vertices: [usize; 2],
        drawn: &[End],
        has_colors: bool,
    ) -> LineOutcome {
        let mut found = LineOutcome::default();
        let ends = vertices.map(|vertex| self.points[vertex]);
        let Some(Part { longest, shortest, cuts }) = self.part(ends) else {
            found.lines_extra = usize::from(!drawn.is_empty());
            return found;
        };
        let is_certain = shortest.is_some() && !self.is_outside_picture;
        found.lines_missing = usize::from(drawn.is_empty() && is_certain);
        for (number, end) in drawn.iter().enumerate() {
            let range = shortest.map_or(longest, |shortest| [longest[number], shortest[number]]);
            // Between the planes even if these lie farther inside, it is the vertex.
            let cuts = if range == [number as f64; 2] { 0 } else { cuts };
            found.line_ends += 1;
            found.line_ends_cut += usize::from(longest[number] != number as f64);
            let between = range.map(|part| along(ends, part));
            let record = |(error, bound)| Some(LineEndError { vertices, error, bound });
            found.line_end_place =
                worse(found.line_end_place, record(self.place_error(end, between, cuts)));
            found.line_end_depth =
                worse(found.line_end_depth, record(self.depth_error(end, between, cuts)));
            if has_colors {
                let colors = vertices.map(|vertex| self.colors[vertex]);
                let between = range.map(|part| along(colors, part));
                let error = (0..3).map(|i| outside(end.color[i], between.map(|color| color[i])));
                let error = error.fold(0.0, f64::max);
                let bound = COLOR * (1 + cuts) as f64;
                found.line_end_color = worse(found.line_end_color, record((error, bound)));
            }
        }
        found
    }

    /// The part of a line that the planes leave, or none if they leave nothing.
    fn part(&self, ends: [[f64; 3]; 2]) -> Option<Part> {
        let cuts = self.cuts(ends) + self.cuts([ends[1], ends[0]]);
        let part = |sign: f64| {
            let moved = |plane: &LinePlane| plane.side.widened(sign * plane.margin(cuts));
            part_inside(ends, self.planes.iter().map(moved))
        };
        Some(Part { longest: part(1.0)?, shortest: part(-1.0), cuts })
    }

    /// How many planes may cut the first end of a line, one after the other.
    fn cuts(&self, [mut end, other]: [[f64; 3]; 2]) -> usize {
        let mut cuts = 0;
        for plane in &self.planes {
            let [depth, inside] = [end, other].map(|point| plane.side.depth(point));
            cuts += usize::from(depth <= plane.margin(self.planes.len()));
            if depth < 0.0 && inside > 0.0 {
                end = along([end, other], depth / (depth - inside));
            }
        }
        cuts
    }

    /// How far an end is from the line between two points on the screen, in x or y, and how far it
    /// may be, in pixels.
    fn place_error(&self, end: &End, between: [[f64; 3]; 2], cuts: usize) -> (f64, f64) {
        let subpixels = f64::from(1 << self.subpixel_bits);
        let place = end.place.map(|c| c as f64 / subpixels);
        let error = distance(place, between.map(|point| self.placement.place(point)));
        (error, self.placement.of_cut(cuts))
    }

    /// How far the depth of an end is outside that of two points, and how far it may be, in units
    /// of 2^-32.
    fn depth_error(&self, end: &End, between: [[f64; 3]; 2], cuts: usize) -> (f64, f64) {
        let one = 2f64.powi(32);
        let depths = between.map(|point| self.camera.to_screen(point).depth.min(1.0));
        let along_axis = AXIS * (1 + cuts) as f64 * self.unit;
        let bound = match self.camera.projection {
            Projection::Perspective { near, .. } => {
                let depth = depths[0].max(depths[1]);
                depth * (DEPTH + along_axis * depth / near)
            }
            Projection::Orthographic { near, far, .. } => {
                DEPTH + (along_axis + WHOLE * self.unit) / (far - near)
            }
        };
        (outside(end.depth, depths.map(|depth| depth * one)), bound * one + STORED)
    }
}

/// How far a value lies outside the range of two others.
fn outside(value: f64, [a, b]: [f64; 2]) -> f64 {
    (a.min(b) - value).max(value - a.max(b)).max(0.0)
}

/// How far a place lies from a line between two others: the larger distance in x and y.
fn distance(place: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let ([x, y], [dx, dy]) = ([0, 1].map(|i| from[i] - place[i]), [0, 1].map(|i| to[i] - from[i]));
    let at = |part: f64| (x + part * dx).abs().max((y + part * dy).abs());
    // The larger of two magnitudes is the least at an end, where one of them is 0, or where both
    // are equal.
    [-x / dx, -y / dy, (y - x) / (dx - dy), -(x + y) / (dx + dy)]
        .into_iter()
        .filter(|part| (0.0..=1.0).contains(part))
        .chain([0.0, 1.0])
        .map(at)
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_as_far_from_a_line_as_from_its_nearest_point() {
        let line = [[0.0, 0.0], [8.0, 4.0]];
        assert_eq!(distance([4.0, 2.0], line), 0.0);
        // Where x and y are off by as much: at (4, 2) from (3, 3), at (6, 3) from (7.5, 1.5).
        assert_eq!(distance([3.0, 3.0], line), 1.0);
        assert_eq!(distance([7.5, 1.5], line), 1.5);
        // Beyond an end, beside a level line, and from a point.
        assert_eq!(distance([10.0, 5.0], line), 2.0);
        assert_eq!(distance([3.0, 0.5], [[0.0, 0.0], [8.0, 0.0]]), 0.5);
        assert_eq!(distance([3.0, -4.0], [[1.0, 0.0]; 2]), 4.0);
    }

    #[test]
    fn a_value_is_outside_a_range_on_either_side() {
        assert_eq!(
            [1.0, 3.0, 4.0, 6.5].map(|value| outside(value, [4.0, 2.0])),
            [1.0, 0.0, 0.0, 2.5]
        );
    }
}
