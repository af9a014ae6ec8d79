//! The fixed-point picture judged by place: right or wrong at each pixel that lies farther from
//! every exact edge than the core may move it.
//!
//! * **Holes.** The outlines of the faces that show their front are added up as directed edges;
//!   edges that two faces run along in opposite directions cancel. What is left is the silhouette.
//!   It encloses each pixel a whole number of times, the same number wherever vertices are moved,
//!   unless the silhouette passes the pixel. Cutting faces into triangles doesn't change the sum
//!   either, and leaving out those turned over only raises it. So a pixel that the silhouette
//!   encloses, and is not close to, must be covered, also where it lies close to edges that faces
//!   share. This finds a lost triangle, and a crack between two faces.
//! * **Pixels too many.** A pixel that no face covers and that no edge is close to must be free.
//! * **Wrong faces.** A pixel that no edge is close to must have the depth of a face there that may
//!   be the nearest, and a colour of that face.
//!
//! A face that is not flat has no single picture: how it is cut decides. Its outline has one. So
//! holes are judged as for flat faces; for the rest, edges of the face, and the bound on its depth,
//! have its deviation from the mean plane on top. A face that crosses itself is not judged, nor one
//! whose texture has transparent texels.

use super::{
    object::{FixedPicture, Pixel},
    placement::{Piece, Placement},
    surface::{Surface, next},
    view::View,
};
use crate::{
    model::{Face, Faces, Model},
    reference::{Camera, Picture, Pixels, Plane, Projection, Winding},
};

/// What is wrong with a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "cli", derive(serde::Serialize), serde(rename_all = "lowercase"))]
pub enum Fault {
    /// The core leaves it free, but the model covers it.
    Hole,
    /// The core covers it, but the model doesn't.
    Extra,
    /// The core shows a surface that is not the nearest.
    Surface,
    /// The core shows a colour that the face doesn't have.
    Color,
}

/// A wrong pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Wrong {
    /// Column and row.
    pub pixel: [usize; 2],
    /// What is wrong.
    pub fault: Fault,
    /// The line of the OBJ file with the face that belongs there, if there is one.
    pub line: Option<usize>,
    /// The triangle of the tables that the core draws there, if it draws one.
    pub triangle: Option<usize>,
}

/// What is found in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Places {
    /// Pixels that are far enough from edges to be judged.
    pub judged: usize,
    /// How many of these are wrong.
    pub wrong: usize,
    /// The first of these, row by row.
    pub first: Option<Wrong>,
}

/// The colours that a face can have; see [`super::shading`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FaceColors {
    /// The least and the largest red, green and blue without light: the material's, or those of its
    /// texture.
    pub(super) range: [[f64; 3]; 2],
    /// The levels of light.
    pub(super) levels: [f64; 2],
}

/// A colour may be off by half a step in the picture, by half a level of 256, and by half a step of
/// the material's.
const COLOR: f64 = 1.5;

/// What a picture is judged by.
pub(super) struct Judge<'a> {
    pub(super) model: &'a Model,
    pub(super) surface: &'a Surface,
    /// The view in the core's numbers.
    pub(super) view: &'a View,
    /// The colours of each face; `None` for one that has holes, which is not judged.
    pub(super) colors: &'a [Option<FaceColors>],
    /// The reference from the faces.
    pub(super) exact: &'a Picture,
    /// The reference on the core's own vertices, which knows the triangles.
    pub(super) arithmetic: &'a Picture,
}

impl Judge<'_> {
    /// Judges a picture. Also returns all wrong pixels.
    pub(super) fn judge(&self, fixed: &FixedPicture) -> (Places, Vec<Wrong>) {
        let outlines = Outlines::new(self);
        let (winding, close_to_silhouette) = outlines.silhouette();
        let close_to_edge = outlines.close_to_edges();
        let faces = 0..self.surface.planes.len();
        let bounds: Vec<f64> = faces.map(|face| outlines.depth_bound(face)).collect();
        let mut places = Places::default();
        let mut wrong = Vec::new();
        let width = self.exact.width();
        for (index, &pixel) in fixed.pixels.iter().enumerate() {
            let [x, y] = [index % width, index / width];
            let must_be_covered = winding[index] > 0 && !close_to_silhouette.contain(index);
            let is_clear = !close_to_edge.contain(index);
            places.judged += usize::from(must_be_covered || is_clear);
            let fault = if pixel.depth == 0 {
                must_be_covered.then_some(Fault::Hole)
            } else if is_clear {
                self.seen(&bounds, [x, y], pixel)
            } else {
                None
            };
            if let Some(fault) = fault {
                let face = self.exact.nearest(x, y).map(|f| self.surface.faces[f.triangle]);
                wrong.push(Wrong {
                    pixel: [x, y],
                    fault,
                    line: face.map(|face| self.faces().faces[face].line),
                    triangle: self.arithmetic.nearest(x, y).map(|fragment| fragment.triangle),
                });
            }
        }
        (Places { wrong: wrong.len(), first: wrong.first().copied(), ..places }, wrong)
    }

    const fn faces(&self) -> &Faces {
        &self.model.exact.faces
    }

    /// What is wrong with a covered pixel that is far from edges. `bounds` has how far the depth of
    /// each face may be off.
    fn seen(&self, bounds: &[f64], [x, y]: [usize; 2], pixel: Pixel) -> Option<Fault> {
        let fragments = self.exact.fragments(x, y).iter().map(|fragment| {
            let face = self.surface.faces[fragment.triangle];
            (face, fragment.depth, bounds[face])
        });
        let Some(nearest) =
            fragments.clone().map(|(_, depth, bound)| depth - bound).reduce(f64::max)
        else {
            return Some(Fault::Extra);
        };
        let depth = self.view.depth.definition().depth(pixel.depth);
        let mut fault = Fault::Surface;
        for (face, exact, bound) in fragments {
            if exact + bound >= nearest && (exact - depth).abs() <= bound {
                if self.colors[face].is_none_or(|colors| colors.contain(pixel.color)) {
                    return None;
                }
                fault = Fault::Color;
            }
        }
        Some(fault)
    }
}

impl FaceColors {
    /// Whether a colour is one of the range at one of the levels.
    fn contain(&self, color: [u8; 3]) -> bool {
        let [mut low, mut high] = self.levels;
        let [least, most] = self.range;
        for (channel, color) in color.map(f64::from).into_iter().enumerate() {
            if most[channel] > 0.0 {
                low = low.max((color - COLOR) / most[channel]);
            } else if color > COLOR {
                return false;
            }
            if least[channel] > 0.0 {
                high = high.min((color + COLOR) / least[channel]);
            }
        }
        low <= high
    }
}

/// The faces in a view.
struct Outlines<'a> {
    faces: &'a Faces,
    surface: &'a Surface,
    camera: Camera,
    placement: Placement,
    /// All positions in view space.
    points: Vec<[f64; 3]>,
    /// The mean planes in view space.
    planes: Vec<Plane>,
    /// Whether each face has a single picture.
    is_judged: Vec<bool>,
    size: (usize, usize),
}

impl<'a> Outlines<'a> {
    fn new(&Judge { model, surface, view, colors, .. }: &Judge<'a>) -> Self {
        let camera = view.reference_camera();
        let faces = &model.exact.faces;
        let points: Vec<_> =
            view.pose_points(&faces.positions).into_iter().map(|p| camera.to_view(p)).collect();
        let areas: Vec<_> = surface.planes.iter().map(|plane| plane.area).collect();
        let middles: Vec<_> = surface.planes.iter().map(|plane| plane.middle).collect();
        // The camera's axes are those of the world.
        let (areas, middles) = (view.pose_points(&areas), view.pose_points(&middles));
        let planes = (surface.planes.iter().zip(areas.into_iter().zip(middles)))
            .map(|(plane, (area, middle))| Plane { area, middle: camera.to_view(middle), ..*plane })
            .collect();
        let size = view.size.map(|side| side as usize).into();
        let placement = Placement::new(model, view);
        let is_judged = (surface.is_simple.iter().zip(colors))
            .map(|(is_simple, colors)| *is_simple && colors.is_some())
            .collect();
        Self { faces, surface, camera, placement, points, planes, is_judged, size }
    }

    fn corners(&self, face: usize) -> Vec<[f64; 3]> {
        let corners = &self.faces.corners[self.faces.faces[face].corners.clone()];
        corners.iter().map(|&position| self.points[position as usize]).collect()
    }

    fn depth_bound(&self, face: usize) -> f64 {
        self.placement.of_depth(&self.corners(face), &self.planes[face])
    }

    /// Whether the mean plane of a face shows its front. A face without area may count as one that
    /// does: it closes gaps between others.
    fn shows_front(&self, face: usize) -> bool {
        let Plane { area, middle, .. } = self.planes[face];
        let toward_eye = match self.camera.projection {
            Projection::Perspective { .. } => -(0..3).map(|i| area[i] * middle[i]).sum::<f64>(),
            Projection::Orthographic { .. } => area[2],
        };
        toward_eye >= 0.0
    }

    fn on_screen(&self, point: [f64; 3]) -> [f64; 2] {
        let point = self.camera.to_screen(point);
        [point.x, point.y]
    }

    /// How often the silhouette of the fronts encloses each pixel, and the pixels close to it.
    fn silhouette(&self) -> (Vec<i32>, Pixels) {
        let range = self.camera.projection.depth_range();
        let (mut winding, mut close) = (Winding::new(self.size), Pixels::none(self.size));
        let mut times = vec![0; self.surface.edges.len()];
        for (number, face) in self.faces.faces.iter().enumerate() {
            if !(self.is_judged[number] && self.shows_front(number)) {
                continue;
            }
            for side in &self.surface.sides[face.corners.clone()] {
                times[side.edge] += side.direction;
            }
            self.mark_cuts(number, &mut close, Some(&mut winding));
        }
        for (edge, &times) in
            self.surface.edges.iter().zip(&times).filter(|(_, times)| **times != 0)
        {
            let ends = edge.ends.map(|end| self.points[end]);
            if let Some(piece) = self.placement.between(ends, range) {
                let [from, to] = piece.ends.map(|end| self.on_screen(end));
                winding.add(from, to, times);
            }
            // The outline of a face is exact even if the face isn't flat.
            self.mark(&mut close, ends, 0.0);
        }
        (winding.numbers(), close)
    }

    /// The pixels close to any edge, or within a face that is not judged.
    fn close_to_edges(&self) -> Pixels {
        let mut close = Pixels::none(self.size);
        for edge in &self.surface.edges {
            self.mark(&mut close, edge.ends.map(|end| self.points[end]), edge.deviation);
        }
        for number in 0..self.faces.faces.len() {
            if !self.is_judged[number] {
                self.mark_whole(&mut close, number);
            }
            self.mark_cuts(number, &mut close, None);
        }
        close
    }

    /// Marks the pixels close to an edge, and to what vertices of the tables may leave of it
    /// between the planes.
    fn mark(&self, close: &mut Pixels, ends: [[f64; 3]; 2], deviation: f64) {
        let [near, far] = self.camera.projection.depth_range();
        let margin = self.placement.margin();
        if let Some(piece) = self.placement.between(ends, [near - margin, far + margin]) {
            let [from, to] = piece.ends.map(|end| self.on_screen(end));
            close.add_close_to(from, to, self.placement.of_piece(&piece, deviation));
        }
    }

    /// Marks the rectangle about a face, or all pixels if the face reaches behind the near plane.
    fn mark_whole(&self, close: &mut Pixels, face: usize) {
        let [near, _] = self.camera.projection.depth_range();
        let corners = self.corners(face);
        if corners.iter().any(|p| -p[2] < near) {
            close.add_all();
        } else {
            self.mark_rectangle(close, &corners, self.planes[face].deviation);
        }
    }

    /// Marks the rectangle about points of a face in view space, and what the core may move there.
    fn mark_rectangle(&self, close: &mut Pixels, points: &[[f64; 3]], deviation: f64) {
        let places: Vec<_> = points.iter().map(|&p| self.on_screen(p)).collect();
        let low = |axis: usize| places.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let high = |axis: usize| places.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        let reach = |&p: &[f64; 3]| {
            self.placement.of_piece(&Piece { ends: [p; 2], is_cut: true, tilt: 0.0 }, deviation)
        };
        let reach = points.iter().map(reach).fold(0.0, f64::max);
        close.add_between([low(0) - reach, low(1) - reach], [high(0) + reach, high(1) + reach]);
    }

    /// Marks the pixels close to where the near and the far plane cut a face: in the layer about
    /// each in which vertices of the tables may lie on the other side. Adds the cut to `winding`.
    fn mark_cuts(&self, face: usize, close: &mut Pixels, mut winding: Option<&mut Winding>) {
        /// A line that may be moved by more pixels is marked by the rectangle about its layer.
        const NARROW: f64 = 1.0;
        let [near, far] = self.camera.projection.depth_range();
        let deviation = self.planes[face].deviation;
        // A point of the face lies within the deviation of the mean plane. So do the points of the
        // outline on both sides of it, at the distance that it has there.
        let layer = self.placement.margin() + 2.0 * deviation;
        let corners = self.corners(face);
        let nearest = corners.iter().map(|p| -p[2]).fold(f64::INFINITY, f64::min);
        let farthest = corners.iter().map(|p| -p[2]).fold(f64::NEG_INFINITY, f64::max);
        if nearest > near + layer && farthest < far - layer {
            return;
        }
        for (plane, side) in [(near, 1.0), (far, -1.0)] {
            let mut points: Vec<_> =
                corners.iter().copied().filter(|p| (-p[2] - plane).abs() <= layer).collect();
            let mut is_narrow = points.len() < corners.len();
            for offset in [-layer, 0.0, layer] {
                for piece in self.cuts(face, plane + offset, side) {
                    let [from, to] = piece.ends.map(|end| self.on_screen(end));
                    if let Some(winding) = winding.as_deref_mut().filter(|_| offset == 0.0) {
                        winding.add(from, to, 1);
                    }
                    points.extend(piece.ends);
                    let reach = self.placement.of_piece(&piece, deviation);
                    is_narrow &= reach <= NARROW;
                    if is_narrow {
                        close.add_close_to(from, to, reach);
                    }
                }
            }
            // Nearly parallel to the plane, or far from flat.
            if !is_narrow {
                self.mark_rectangle(close, &points, deviation);
            }
        }
    }

    /// The lines in which the plane at a distance cuts a face, in the face's winding. What lies
    /// beyond it is kept if `side` is 1, what lies before it if that is -1.
    fn cuts(&self, face: usize, plane: f64, side: f64) -> Vec<Piece> {
        let Face { corners, .. } = &self.faces.faces[face];
        let point = |corner: usize| self.points[self.faces.corners[corner] as usize];
        let is_kept = |p: [f64; 3]| side * (-p[2] - plane) >= 0.0;
        // Where the outline leaves what is kept, and where it comes back, in turn.
        let mut crossings = Vec::new();
        for corner in corners.clone() {
            let (from, to) = (point(corner), point(next(&self.faces.faces[face], corner)));
            if is_kept(from) != is_kept(to) {
                let t = (-plane - from[2]) / (to[2] - from[2]);
                let [x, y] = [0, 1].map(|i| from[i] + t * (to[i] - from[i]));
                crossings.push((is_kept(from), [x, y, -plane]));
            }
        }
        if crossings.first().is_some_and(|&(leaves, _)| !leaves) {
            crossings.rotate_left(1);
        }
        let [x, y, z] = self.planes[face].area;
        let tilt = z.abs() / x.hypot(y);
        let tilt = if tilt.is_nan() { f64::INFINITY } else { tilt };
        let piece =
            |pair: &[(bool, [f64; 3])]| Piece { ends: [pair[0].1, pair[1].1], is_cut: true, tilt };
        crossings.chunks_exact(2).map(piece).collect()
    }
}
