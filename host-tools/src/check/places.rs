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
//! Planes cut faces, the near plane, the far plane and those of the user's alike. The silhouette is
//! then that of what is left. About each plane is a layer in which vertices of the tables may lie
//! on the other side: what a face has in it is close to an edge.
//!
//! A face that is not flat has no single picture: how it is cut decides. Its outline has one. So
//! holes are judged as for flat faces; for the rest, edges of the face, and the bound on its depth,
//! have its deviation from the mean plane on top. A face that crosses itself is not judged, nor one
//! whose texture has transparent texels.

use super::{
    object::{FixedPicture, Pixel},
    placement::{CutPlane, Piece, Placement},
    surface::Surface,
    view::View,
};
use crate::{
    model::{Faces, Model},
    reference::{Camera, HalfSpace, Picture, Pixels, Plane, Projection, Winding, clip_ring},
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
    /// World units for one model unit.
    scale: f64,
    size: (usize, usize),
}

impl<'a> Outlines<'a> {
    fn new(&Judge { model, surface, view, colors, .. }: &Judge<'a>) -> Self {
        let (camera, (_, scale)) = (view.reference_camera(), view.core_place());
        let faces = &model.exact.faces;
        let points: Vec<_> =
            view.pose_points(&faces.positions).into_iter().map(|p| camera.to_view(p)).collect();
        let areas: Vec<_> = surface.planes.iter().map(|plane| plane.area).collect();
        let middles: Vec<_> = surface.planes.iter().map(|plane| plane.middle).collect();
        let (areas, middles) = (view.pose_directions(&areas), view.pose_points(&middles));
        let planes = (surface.planes.iter().zip(areas.into_iter().zip(middles)))
            .map(|(plane, (area, middle))| Plane {
                area: camera.turn_to_view(area),
                middle: camera.to_view(middle),
                deviation: scale * plane.deviation,
            })
            .collect();
        let size = view.size.map(|side| side as usize).into();
        let placement = Placement::new(model, view);
        let is_judged = (surface.is_simple.iter().zip(colors))
            .map(|(is_simple, colors)| *is_simple && colors.is_some())
            .collect();
        Self { faces, surface, camera, placement, points, planes, is_judged, scale, size }
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
        let (mut winding, mut close) = (Winding::new(self.size), Pixels::none(self.size));
        let mut layers = Winding::new(self.size);
        let kept: Vec<_> = self.placement.planes().iter().map(|plane| plane.side).collect();
        // Of all faces, and of those that no plane cuts.
        let mut times = vec![[0; 2]; self.surface.edges.len()];
        for (number, face) in self.faces.faces.iter().enumerate() {
            if !(self.is_judged[number] && self.shows_front(number)) {
                continue;
            }
            let corners = self.corners(number);
            let is_outside = |side: &HalfSpace| corners.iter().any(|&p| side.depth(p) < 0.0);
            let is_cut = kept.iter().any(is_outside);
            for side in &self.surface.sides[face.corners.clone()] {
                let [all, whole] = &mut times[side.edge];
                *all += side.direction;
                *whole += if is_cut { 0 } else { side.direction };
            }
            if is_cut {
                self.wind(&clip_ring(&corners, &kept), 1, &mut winding);
            }
            self.mark_layers(number, &mut close, &mut layers);
        }
        for (edge, &[all, whole]) in self.surface.edges.iter().zip(&times) {
            let ends = edge.ends.map(|end| self.points[end]);
            if whole != 0 {
                let [from, to] = ends.map(|end| self.on_screen(end));
                winding.add(from, to, whole);
            }
            if all != 0 {
                // The outline of a face is exact even if the face isn't flat.
                self.mark(&mut close, ends, 0.0);
            }
        }
        close.add_enclosed(&layers);
        (winding.numbers(), close)
    }

    /// The pixels close to any edge, or within a face that is not judged.
    fn close_to_edges(&self) -> Pixels {
        let (mut close, mut layers) = (Pixels::none(self.size), Winding::new(self.size));
        for edge in &self.surface.edges {
            self.mark(
                &mut close,
                edge.ends.map(|end| self.points[end]),
                self.scale * edge.deviation,
            );
        }
        for number in 0..self.faces.faces.len() {
            if !self.is_judged[number] {
                self.mark_whole(&mut close, number);
            }
            self.mark_layers(number, &mut close, &mut layers);
        }
        close.add_enclosed(&layers);
        close
    }

    /// Marks the pixels close to an edge, and to what vertices of the tables may leave of it
    /// between the planes.
    fn mark(&self, close: &mut Pixels, ends: [[f64; 3]; 2], deviation: f64) {
        if let Some(piece) = self.placement.between(ends, 1.0) {
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
        let piece = |&p: &[f64; 3]| Piece { ends: [p; 2], is_cut: true };
        let reach = |p: &[f64; 3]| self.placement.of_piece(&piece(p), deviation);
        let reach = points.iter().map(reach).fold(0.0, f64::max);
        close.add_between([low(0) - reach, low(1) - reach], [high(0) + reach, high(1) + reach]);
    }

    /// Marks the pixels close to the outline of what a face has in the layer about each plane, and
    /// adds that outline to `layers`.
    fn mark_layers(&self, face: usize, close: &mut Pixels, layers: &mut Winding) {
        let (corners, deviation) = (self.corners(face), self.planes[face].deviation);
        // A point of the face lies within the deviation of the mean plane. So do the points of the
        // outline on both sides of it, at the distance that it has there.
        let layer = |plane: &CutPlane| plane.margin + 2.0 * deviation;
        let planes = self.placement.planes();
        for (number, plane) in planes.iter().enumerate() {
            let thickness = layer(plane);
            let is_within = |&p: &[f64; 3]| plane.side.depth(p) > thickness;
            if corners.iter().all(is_within) {
                continue;
            }
            let others = planes.iter().enumerate().filter(|(other, _)| *other != number);
            let mut sides: Vec<_> =
                others.map(|(_, plane)| plane.side.widened(layer(plane))).collect();
            let both = [plane.side, plane.side.flipped()];
            sides.extend(both.map(|side| side.widened(thickness)));
            let ring = clip_ring(&corners, &sides);
            for side in sides_of(&ring) {
                let piece = Piece { ends: side, is_cut: true };
                let [from, to] = side.map(|end| self.on_screen(end));
                close.add_close_to(from, to, self.placement.of_piece(&piece, deviation));
            }
            self.wind(&ring, if self.shows_front(face) { 1 } else { -1 }, layers);
        }
    }

    /// Adds the outline of a ring of corners in view space.
    fn wind(&self, ring: &[[f64; 3]], times: i32, winding: &mut Winding) {
        for side in sides_of(ring) {
            let [from, to] = side.map(|end| self.on_screen(end));
            winding.add(from, to, times);
        }
    }
}

/// The sides of a ring of corners, each from one to the next.
fn sides_of(ring: &[[f64; 3]]) -> impl Iterator<Item = [[f64; 3]; 2]> {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&from, &to)| [from, to])
}
