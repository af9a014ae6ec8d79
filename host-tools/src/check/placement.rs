//! How far from its exact place the core may draw a point, and how far from its exact depth.
//!
//! Three things move a vertex:
//!
//! * **Rounding to quanta** moves each coordinate of a position by half a quantum q at most. The
//!   view turns it by a matrix, and a [`Form`](super::Form) has another one before that, so a
//!   coordinate in view space is off by at most q / 2 times the sum of the magnitudes in the row of
//!   the product, plus what the matrix itself is rounded by: [`TURNING`] of the
//!   position. Call it a across the view, and d along the distance w.
//! * **Projection** divides by the distance. From f · X / w to f · (X + a) / (w - d) it is at most
//!   `f · (a + |X / w| · d) / (w - d)` pixels, with the focal length f in pixels; in a parallel
//!   projection it is a times the pixels of a unit.
//! * **The core** snaps to sub-pixels ([`SNAPPING`]) after computing ([`ARITHMETIC`]).
//!
//! Where a plane cuts an edge, the corner has the arithmetic of both ends and its own ([`CUT`]; one
//! more for each plane of the user's). Rounding to quanta also moves the cut along the edge. A
//! point of a triangle of the tables is a point of the exact one that is moved by half a quantum in
//! each coordinate, so what lies in the plane comes from points within n · q of it, for the sum of
//! the normal's coordinates times the half quanta: [`CutPlane::margin`] is twice that. The rest is
//! for the core's distances from the plane, which are within a 1,000th of a quantum and a
//! 2<sup>26</sup>th of the distance from the mesh's origin.

use super::view::View;
use crate::{
    model::Model,
    reference::{Camera, HalfSpace, Plane, Projection, part_inside},
};

/// In sub-pixels: rounding to the nearest.
const SNAPPING: f64 = 0.5;
/// In sub-pixels: what the core's documentation promises of a vertex.
const ARITHMETIC: f64 = 0.125;
/// By which a corner that is cut has more: the arithmetic of both ends and of the cut.
const CUT: f64 = 3.0;
/// In sub-pixels: a corner on the right or lower end of the guard band moves into its last one.
const GUARD_END: f64 = 1.0;
/// How far the guard band reaches from the middle, in pixels.
pub(super) const GUARD: f64 = 1024.0;
/// The most by which an entry of the view's matrix is off. Entries are in Q30: of six rotations,
/// three of the model and three of the world, each rounded, with five products; and of the camera's
/// axes, one of them a product of the others, with one more product.
const TURNING: f64 = 1.0 / (1 << 27) as f64;
/// The relative error of a depth before it is stored: 1/8 sub-pixel of 2^10 pixels with 8 bits is
/// 2^-21, which is also the error of w; doubled for the division and for interpolation.
const DEPTH: f64 = 1.0 / (1 << 20) as f64;
/// In units of the stored format: rounding of a vertex and of a pixel.
const STORED: f64 = 2.0;

/// The bounds for a model in a view.
#[derive(Clone, Debug)]
pub(super) struct Placement {
    camera: Camera,
    /// The near plane, the far plane, and those of the user's.
    planes: Vec<CutPlane>,
    /// Half a quantum along the axes of view space.
    quantum: [f64; 3],
    /// A sub-pixel in pixels.
    subpixel: f64,
    /// A unit of the stored depth.
    depth_unit: f64,
}

/// A piece of an edge, or of the line in which a plane cuts a face, in view space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) ends: [[f64; 3]; 2],
    /// Whether a plane may cut it.
    pub(super) is_cut: bool,
}

/// A plane that cuts the model, in view space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CutPlane {
    /// What is kept, with a normal of length 1.
    pub(super) side: HalfSpace,
    /// Half the thickness of the layer in which exact positions and those of the tables may lie on
    /// different sides.
    pub(super) margin: f64,
}

impl CutPlane {
    /// Of a half space in view space, where `quantum` has the half quanta along the axes.
    fn new(HalfSpace { normal, offset }: HalfSpace, quantum: [f64; 3]) -> Self {
        let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
        let normal = normal.map(|c| c / length);
        let across: f64 = (0..3).map(|i| normal[i].abs() * quantum[i]).sum();
        Self { side: HalfSpace { normal, offset: offset / length }, margin: 2.0 * across }
    }
}

impl Placement {
    pub(super) fn new(model: &Model, view: &View) -> Self {
        let camera = view.reference_camera();
        let columns = view.pose_directions(&view.form.half_quanta(model));
        let columns: Vec<_> = columns.into_iter().map(|c| camera.turn_to_view(c)).collect();
        let (_, scale) = view.core_place();
        let reach = (model.exact.faces.positions.iter())
            .map(|p| p.iter().map(|c| c.abs()).sum())
            .fold(0.0, f64::max);
        let row = |i: usize| columns.iter().map(|column| column[i].abs()).sum::<f64>();
        let quantum = [0, 1, 2].map(|i| scale * (row(i) + reach * TURNING));
        let [near, far] = camera.projection.depth_range();
        let ends = [
            HalfSpace { normal: [0.0, 0.0, -1.0], offset: -near },
            HalfSpace { normal: [0.0, 0.0, 1.0], offset: far },
        ];
        let own = view.half_spaces().into_iter().map(|side| HalfSpace {
            normal: camera.turn_to_view(side.normal),
            offset: side.depth(camera.eye),
        });
        Self {
            planes: ends.into_iter().chain(own).map(|side| CutPlane::new(side, quantum)).collect(),
            camera,
            quantum,
            subpixel: 0.5f64.powi(view.subpixel.bits() as i32),
            depth_unit: view.depth.definition().largest_unit(),
        }
    }

    /// In pixels: how far a vertex of the tables may lie from where exact arithmetic puts it.
    pub(super) fn of_arithmetic(&self) -> f64 {
        self.of_cut(0)
    }

    /// In pixels: the same for an end of a line that up to this number of planes cut: of a vertex,
    /// and the error that the core's documentation allows each cut besides.
    pub(super) fn of_cut(&self, planes: usize) -> f64 {
        (SNAPPING + ARITHMETIC * (1 + planes) as f64) * self.subpixel
    }

    /// In pixels: how far a vertex at a place in view space may lie from there. Infinite at the
    /// eye.
    pub(super) fn of_vertex(&self, position: [f64; 3]) -> f64 {
        self.of_arithmetic() + self.moved(&[position], 0.0)
    }

    /// The exact place of a point that the core gives a place on the screen.
    pub(super) fn place(&self, position: [f64; 3]) -> [f64; 2] {
        let point = self.camera.to_screen(position);
        let middle = self.camera.viewport.center();
        // The guard band ends before its last sub-pixel does.
        let last = GUARD - self.subpixel;
        [point.x.min(middle[0] + last), point.y.min(middle[1] + last)]
    }

    /// The planes that cut the model.
    pub(super) fn planes(&self) -> &[CutPlane] {
        &self.planes
    }

    /// The piece of an edge that the planes leave if they lie farther outside by `outward` times
    /// their margins; `None` if they leave none.
    pub(super) fn between(&self, ends: [[f64; 3]; 2], outward: f64) -> Option<Piece> {
        let is_near =
            |plane: &CutPlane| ends.iter().any(|&end| plane.side.depth(end) <= plane.margin);
        let moved = |plane: &CutPlane| plane.side.widened(outward * plane.margin);
        let part = part_inside(ends, self.planes.iter().map(moved))?;
        Some(Piece { ends: part.map(|t| along(ends, t)), is_cut: self.planes.iter().any(is_near) })
    }

    /// In eighths of a sub-pixel: the arithmetic of a corner that planes may cut.
    fn cut(&self) -> f64 {
        CUT + self.planes[2..].len() as f64
    }

    /// In pixels, in x and in y: how far the core may draw a piece of an edge from its exact place.
    /// `deviation` is how far its faces lie off their planes. Infinite where a quantum is not much
    /// smaller than the distance from the eye.
    pub(super) fn of_piece(&self, piece: &Piece, deviation: f64) -> f64 {
        let middle = self.camera.viewport.center();
        let aside = |p: &[f64; 3]| {
            let point = self.camera.to_screen(*p);
            (point.x - middle[0]).abs().max((point.y - middle[1]).abs())
        };
        let reaches_guard = piece.ends.iter().map(aside).fold(0.0, f64::max) > GUARD - 1.0;
        let cut = if piece.is_cut || reaches_guard { self.cut() } else { 1.0 };
        let end = if reaches_guard { GUARD_END } else { 0.0 };
        // Only what lies in the picture or next to it is drawn.
        let seen = self.beside_picture(piece.ends);
        let moved = self.moved(&seen, deviation);
        (SNAPPING + ARITHMETIC * cut + end) * self.subpixel + moved
    }

    /// By how many pixels rounding to quanta moves points of a line.
    fn moved(&self, points: &[[f64; 3]], deviation: f64) -> f64 {
        let [x, y, z] = self.quantum.map(|quantum| quantum + 2.0 * deviation);
        let across = x.max(y);
        match self.camera.projection {
            Projection::Perspective { focal_length_px, .. } => {
                let distance = points.iter().map(|p| -p[2]).fold(f64::INFINITY, f64::min) - z;
                let aside = |p: &[f64; 3]| p[0].abs().max(p[1].abs()) / -p[2];
                let aside = points.iter().map(aside).fold(0.0, f64::max);
                if distance > 0.0 {
                    focal_length_px * (across + aside * z) / distance
                } else {
                    f64::INFINITY
                }
            }
            Projection::Orthographic { pixels_per_unit, .. } => pixels_per_unit * across,
        }
    }

    /// The part of a piece within 64 pixels of the picture, or all of it if there is none.
    fn beside_picture(&self, ends: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
        const BESIDE: f64 = 64.0;
        let viewport = self.camera.viewport;
        let half = [viewport.width, viewport.height].map(|side| side / 2.0 + BESIDE);
        let [mut a, mut b] = ends;
        for side in self.aside(half) {
            let (at_a, at_b) = (side.depth(a), side.depth(b));
            if at_a <= 0.0 && at_b <= 0.0 {
                // Beside the picture: its nearest point is as good as any.
                continue;
            }
            let crossing = along([a, b], at_a / (at_a - at_b));
            if at_a < 0.0 {
                a = crossing;
            } else if at_b < 0.0 {
                b = crossing;
            }
        }
        [a, b]
    }

    /// What lies in front of the eye within some pixels of the view axis, across and up: four
    /// half spaces of view space, in pixels times w.
    pub(super) fn aside(&self, half: [f64; 2]) -> [HalfSpace; 4] {
        [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)].map(|(axis, sign): (usize, f64)| {
            let (scale, back, offset) = match self.camera.projection {
                Projection::Perspective { focal_length_px, .. } => {
                    (focal_length_px, -half[axis], 0.0)
                }
                Projection::Orthographic { pixels_per_unit, .. } => {
                    (pixels_per_unit, 0.0, half[axis])
                }
            };
            let mut normal = [0.0, 0.0, back];
            normal[axis] = -sign * scale;
            HalfSpace { normal, offset }
        })
    }

    /// How far the depth of a pixel may be off that of a face's plane, from the places of the
    /// face's corners and its plane in view space.
    ///
    /// Depth is linear on the screen. A corner that is moved by d has a depth that is off by its
    /// own error and by d times the gradient of depth; a pixel within a triangle has a mean of its
    /// corners' errors.
    pub(super) fn of_depth(&self, corners: &[[f64; 3]], plane: &Plane) -> f64 {
        let [near, far] = self.camera.projection.depth_range();
        let Some([x, y, z]) = plane.normal() else { return f64::INFINITY };
        let nearest = corners.iter().map(|p| -p[2]).fold(f64::INFINITY, f64::min);
        let is_beyond = |plane: &CutPlane| {
            corners.iter().any(|&corner| plane.side.depth(corner) < plane.margin)
        };
        let is_cut = self.planes.iter().any(is_beyond);
        let nearest = nearest.max(near);
        let away = self.quantum[2] + 2.0 * plane.deviation;
        // A corner that is cut elsewhere along its edge stays on the plane of the edge.
        let cut = if is_cut { self.cut() } else { 1.0 };
        let front: Vec<[f64; 3]> =
            corners.iter().map(|&[x, y, z]| [x, y, z.min(-nearest)]).collect();
        let moved =
            self.moved(&front, plane.deviation) + (SNAPPING + ARITHMETIC * cut) * self.subpixel;
        let off = match self.camera.projection {
            Projection::Perspective { focal_length_px, .. } => {
                // near / w = near (x X / w + y Y / w + z) / distance, for the plane of points P
                // with normal . P = distance from the eye.
                let [a, b, c] = plane.middle;
                let distance = (x * a + y * b + z * c).abs();
                let gradient = near * (x.abs() + y.abs()) / (distance * focal_length_px);
                gradient * moved + near * away / (nearest * (nearest - away))
            }
            Projection::Orthographic { pixels_per_unit, .. } => {
                let gradient = (x.abs() + y.abs()) / z.abs() / pixels_per_unit;
                (gradient * moved + away) / (far - near)
            }
        };
        let off = off + DEPTH + STORED * self.depth_unit;
        if off.is_nan() { f64::INFINITY } else { off }
    }
}

/// The point at a part of the way between two.
pub(super) fn along([from, to]: [[f64; 3]; 2], part: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| from[i] + part * (to[i] - from[i]))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::{
        check::{Place, Projection as Kind, Subpixel},
        model::Options,
        reference::random::Random,
    };

    fn gear() -> Model {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/gear.obj");
        Model::load(path, &Options::default()).unwrap()
    }

    fn view(random: &mut Random, number: usize) -> View {
        let near = random.real(0.05, 1.5);
        View {
            distance: random.real(1.2, 6.0),
            projection: if number.is_multiple_of(3) {
                Kind::Orthographic { height: random.real(0.2, 4.0) }
            } else {
                Kind::Perspective { field_of_view_degrees: random.real(1.0, 120.0) }
            },
            near,
            far: near + random.real(1.0, 9.0),
            yaw_degrees: random.real(-360.0, 360.0),
            pitch_degrees: random.real(-360.0, 360.0),
            roll_degrees: random.real(-360.0, 360.0),
            subpixel: if number.is_multiple_of(2) { Subpixel::S4 } else { Subpixel::S8 },
            ..View::default()
        }
        .rounded()
    }

    /// A point moved by half a quantum in each coordinate, in the direction of a corner of a cube.
    fn moved(model: &Model, p: [f64; 3], corner: usize) -> [f64; 3] {
        let half = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent()) / 2.0;
        [0, 1, 2].map(|i| p[i] + half * [1.0, -1.0][corner >> i & 1])
    }

    #[test]
    fn a_vertex_moves_by_its_bound_at_most_and_by_half_of_it_at_times() {
        let (model, mut random) = (gear(), Random(41));
        let (mut most, mut judged) = (0f64, 0);
        for number in 0..200 {
            let view = view(&mut random, number);
            let placement = Placement::new(&model, &view);
            let (camera, rounding) = (view.reference_camera(), placement.of_arithmetic());
            assert_eq!(rounding * 2f64.powi(view.subpixel.bits() as i32), 0.625);
            for &p in model.exact.positions.iter().step_by(50) {
                let in_view = |p| camera.to_view(view.pose_points(&[p])[0]);
                let exact = in_view(p);
                if -exact[2] < 0.05 {
                    continue;
                }
                let bound = placement.of_vertex(exact) - rounding;
                let at = camera.to_screen(exact);
                for corner in 0..8 {
                    let point = camera.to_screen(in_view(moved(&model, p, corner)));
                    let error = (point.x - at.x).abs().max((point.y - at.y).abs());
                    assert!(error <= bound, "{error} of {bound}: {p:?} {view:?}");
                    most = most.max(error / bound);
                    judged += 1;
                }
            }
        }
        assert!(judged > 10_000 && most > 0.5, "{judged} {most}");
    }

    /// The least distance in x and y of a point from a segment. It is a convex function along it.
    fn distance(point: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
        let at = |t: f64| {
            let off = |i: usize| (a[i] + t * (b[i] - a[i]) - point[i]).abs();
            off(0).max(off(1))
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..200 {
            let third = (high - low) / 3.0;
            if at(low + third) < at(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        at((low + high) / 2.0)
    }

    /// What is left of a moved edge between the planes lies within the bound of what is left of the
    /// exact one between planes farther apart.
    #[test]
    fn an_edge_moves_by_its_bound_at_most() {
        let (model, mut random) = (gear(), Random(42));
        let (mut most, mut cut) = (0f64, 0);
        for number in 0..20_000 {
            let view = view(&mut random, number);
            let placement = Placement::new(&model, &view);
            let camera = view.reference_camera();
            let in_view = |p| camera.to_view(view.pose_points(&[p])[0]);
            let ends = [(); 2].map(|()| [(); 3].map(|()| random.real(-0.577, 0.577)));
            let corners = [(); 2].map(|()| random.real(0.0, 8.0) as usize);
            let other = [0, 1].map(|i| in_view(moved(&model, ends[i], corners[i])));
            let Some(other) = placement.between(other, 0.0) else { continue };
            let exact = placement.between(ends.map(in_view), 1.0);
            let exact = exact.expect("it reaches beyond the moved one");
            let bound = placement.of_piece(&exact, 0.0) - placement.of_arithmetic();
            let points = |piece: Piece| {
                piece.ends.map(|end| {
                    let point = camera.to_screen(end);
                    [point.x, point.y]
                })
            };
            for point in points(other) {
                // Beside the picture the bound doesn't hold.
                if (0.0..320.0).contains(&point[0]) && (0.0..240.0).contains(&point[1]) {
                    let error = distance(point, points(exact));
                    assert!(error <= bound, "{error} of {bound}: {ends:?} {view:?}");
                    most = most.max(error / bound);
                    cut += usize::from(exact.is_cut);
                }
            }
        }
        assert!(cut > 1_000 && most > 0.3, "{cut} {most}");
    }

    #[test]
    fn the_matrix_is_rounded_by_less_than_stated() {
        let mut random = Random(43);
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut most = 0f64;
        for number in 0..20_000 {
            let turn_degrees = [0; 3].map(|_| random.real(-360.0, 360.0));
            let place = Place { turn_degrees, ..Place::default() };
            let view = View { place, ..view(&mut random, number) }.rounded();
            let (exact, core) = (view.pose_points(&axes), view.core_pose_points(&axes));
            for (a, b) in exact.as_flattened().iter().zip(core.as_flattened()) {
                most = most.max((a - b).abs());
            }
        }
        assert!(most < TURNING && most > TURNING / 8.0, "{}", most / TURNING);
    }

    #[test]
    fn nothing_is_bounded_at_the_eye() {
        let model = gear();
        let placement = Placement::new(&model, &View::default());
        assert_eq!(placement.of_vertex([0.0, 0.0, -1e-6]), f64::INFINITY);
        assert_eq!(placement.of_vertex([0.0, 0.0, 1.0]), f64::INFINITY);
    }

    /// The plane of a triangle through moved corners, seen at the same pixels, has depths within
    /// the bound of the exact plane's.
    #[test]
    fn the_depth_of_a_plane_moves_by_its_bound_at_most() {
        let (model, mut random) = (gear(), Random(44));
        let (mut most, mut judged) = (0f64, 0);
        for number in 0..20_000 {
            let view = view(&mut random, number);
            let placement = Placement::new(&model, &view);
            let camera = view.reference_camera();
            let in_view = |p| camera.to_view(view.pose_points(&[p])[0]);
            let corners = [(); 3].map(|()| [(); 3].map(|()| random.real(-0.577, 0.577)));
            let exact = corners.map(in_view);
            let other = [0, 1, 2]
                .map(|i| in_view(moved(&model, corners[i], random.real(0.0, 8.0) as usize)));
            let [near, _] = camera.projection.depth_range();
            if exact.iter().any(|p| -p[2] < near + 0.01) {
                continue;
            }
            let bound = placement.of_depth(&exact, &Plane::of(&exact));
            let bound = bound - DEPTH - STORED * placement.depth_unit;
            let points = other.map(|p| camera.to_screen(p));
            let middle =
                [0, 1].map(|axis| points.iter().map(|p| [p.x, p.y][axis]).sum::<f64>() / 3.0);
            let depth = points.iter().map(|p| p.depth).sum::<f64>() / 3.0;
            // Of the exact plane at the same place: by Cramer's rule.
            let [a, b, c] = exact.map(|p| camera.to_screen(p));
            let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            let [x, y] = [middle[0] - a.x, middle[1] - a.y];
            let at_b = (x * (c.y - a.y) - y * (c.x - a.x)) / area;
            let at_c = ((b.x - a.x) * y - (b.y - a.y) * x) / area;
            let want = a.depth + at_b * (b.depth - a.depth) + at_c * (c.depth - a.depth);
            if area.abs() > 1e-3 {
                let error = (depth - want).abs();
                assert!(error <= bound, "{error} of {bound}: {corners:?} {view:?}");
                most = most.max(error / bound);
                judged += 1;
            }
        }
        assert!(judged > 5_000 && most > 0.1, "{judged} {most}");
    }
}
