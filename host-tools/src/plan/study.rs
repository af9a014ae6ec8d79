//! What is found out about a model before anything is chosen.

use std::path::{Path, PathBuf};

use rasterizer::camera::{Distance, Perspective};

use super::{
    Correction, Filter, Load, Paint, PlanError, Request, Shape, Texels, Types, Visibility, Work,
    band_rows, convex,
    costs::SliverCost,
    divided::Coordinates,
    order::{FixedOrder, Orders, Search},
    sampled::{Sampled, with_texels},
    seen, source,
    texels::{Coverage, Sampling},
    views::Placed,
};
use crate::{
    check::{ViewError, angle, checked},
    model::{Contents, Model, Options, TexelFormat},
};

/// How far a corner's normal may lie from that of its triangle without anyone seeing the difference
/// in light, in degrees. Normals are stored in 127ths, which turns each by up to 0.4 degrees.
const FLAT_DEGREES: f64 = 1.0;

/// The guard band reaches this far from the middle of the display, in pixels: beyond it triangles
/// are clipped.
const GUARD_PX: f64 = 1_024.0;

/// A model in its views.
#[derive(Debug)]
pub struct Study {
    /// What the picture is wanted for.
    pub request: Request,
    /// The shape of its mesh.
    pub shape: Shape,
    /// The work of each view.
    pub work: Vec<Work>,
    /// For each of [`Visibility::ALL`] the view with most wrong pixels.
    worst: [Worst; Visibility::ALL.len()],
    /// Whether one order of the triangles is right in all views.
    pub(super) order: Search,
    /// An order within parts that planes keep apart, if one is sought and found.
    pub(super) part_order: Option<FixedOrder>,
    /// Whether light of vertices differs from that of triangles, and by how many degrees of their
    /// normals.
    pub normal_degrees: f64,
    /// The nearest and the farthest distance of the depth range.
    pub(super) depth_range: [f64; 2],
    /// Whether triangles may reach beyond the depth range or the guard band.
    pub clips: bool,
    /// The farthest that the model reaches from the middle of the display, in pixels.
    pub reach_px: f64,
    pub(super) sampling: Option<Sampled>,
    /// The path of the model, and how it is converted.
    path: PathBuf,
    options: Options,
    /// Whether the planned renderer has light of vertices.
    is_smooth: bool,
    has_vertex_colors: bool,
    has_holes: bool,
}

/// The view in which most pixels show another surface than the nearest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// Its number.
    pub view: usize,
    /// The wrong pixels.
    pub wrong: usize,
    /// The part that they are of those that show the model.
    pub part: f64,
}

impl Worst {
    /// A view by its number, with its wrong pixels and those that show the model.
    pub(super) fn new(view: usize, wrong: usize, shown: usize) -> Self {
        Self { view, wrong, part: wrong as f64 / shown.max(1) as f64 }
    }

    /// The worse of two; of equal ones this.
    pub(super) fn or_worse(self, other: Self) -> Self {
        if other.part > self.part { other } else { self }
    }
}

impl Study {
    /// Looks at a model in all views of a request. `step` is called after each, with their number.
    ///
    /// # Errors
    ///
    /// Returns an error if the model cannot be converted, has no faces, or cannot be seen so.
    pub fn new(
        path: &Path,
        options: &Options,
        request: &Request,
        mut step: impl FnMut(usize),
    ) -> Result<Self, PlanError> {
        let options = Options { name: None, ..options.clone() };
        let whole = Model::load(path, &with_texels(&options, None, TexelFormat::Direct, false))?;
        if whole.report.triangles == 0 {
            return Err(PlanError::NoFaces(path.display().to_string()));
        }
        let normal_degrees = normal_degrees(&whole);
        let is_smooth = is_smooth(request, normal_degrees, &whole);
        let paint = if whole.textures.is_some() {
            Paint::Textures(Correction::Adaptive, Texels::Direct, Filter::NEAREST)
        } else {
            plain_paint(&whole)
        };
        // The tables that are written: others may have other vertices, and so another order.
        let model = converted(path, &options, (is_smooth, paint), None)?;
        let views = request.views.placed(request.distance);
        let radius = radius(&model);
        let lens = Lens::of(request, &views, radius)?;
        let mesh = model.mesh();
        let eye = seen::Eye { mesh: &mesh, lens: lens.perspective, size: request.display };
        let shape = convex::shape(&model);
        let has_holes = model.textures.as_ref().is_some_and(|textures| textures.alpha.is_some());
        let orders = (shape != Shape::Convex && !has_holes).then(|| Orders::new(&model));
        let mut seen = look(&model, &eye, request, &views, orders, &mut step)?;
        let sampling = match seen.sampling {
            Some(seen) => Some(Sampled::new(&model, path, &options, (request, seen))?),
            None => None,
        };
        if let Some(sampling) = &sampling {
            let coordinates = Coordinates { size: sampling.sizes[1] };
            for (work, view) in seen.work.iter_mut().zip(&views) {
                work.divided = eye.divide(request.core.subpixel(), view, coordinates)?;
            }
        }
        let mut study = Self {
            shape,
            work: seen.work,
            worst: seen.worst,
            order: Search::Unneeded,
            part_order: None,
            normal_degrees,
            depth_range: lens.range,
            clips: lens.reach_px >= GUARD_PX,
            reach_px: lens.reach_px,
            sampling,
            path: path.to_path_buf(),
            is_smooth,
            has_vertex_colors: !whole.vertex_colors.is_empty(),
            has_holes,
            options,
            request: request.clone(),
        };
        if has_holes {
            study.order = Search::Holes;
        } else if let Some(orders) = seen.orders.filter(|_| !study.is_right(Visibility::MeshOrder))
        {
            study.find_order(&model, &eye, orders)?;
        }
        Ok(study)
    }

    /// Looks for an order of the triangles that is right in all views, and judges it; if there is
    /// none, for one within parts.
    fn find_order(
        &mut self,
        model: &Model,
        eye: &seen::Eye<'_>,
        orders: Orders,
    ) -> Result<(), ViewError> {
        let (within_parts, whole) = orders.into_parts(model);
        match whole.arcs() {
            Err(cycle) => self.order = Search::Cycle(cycle),
            Ok(arcs) => {
                if let Some(order) = FixedOrder::new(model, &arcs, None) {
                    self.judge(model, eye, &order, Visibility::FixedOrder)?;
                    self.order = Search::Found(order);
                }
            }
        }
        if let Some(order) = within_parts.filter(|_| !self.is_right(Visibility::FixedOrder)) {
            self.judge(model, eye, &order, Visibility::PartOrder)?;
            self.part_order = Some(order);
        }
        Ok(())
    }

    /// Judges an order.
    fn judge(
        &mut self,
        model: &Model,
        eye: &seen::Eye<'_>,
        order: &FixedOrder,
        visibility: Visibility,
    ) -> Result<(), ViewError> {
        let request = &self.request;
        let views = request.views.judging(request.distance);
        self.worst[place(visibility)] = order.judge(model, eye, request.core.subpixel(), &views)?;
        Ok(())
    }

    /// The order of the tables that a way to decide visibility needs, if it is another one than the
    /// converter's and there is one.
    pub(super) const fn order_of(&self, visibility: Visibility) -> Option<&FixedOrder> {
        match (visibility, &self.order) {
            (Visibility::FixedOrder, Search::Found(order)) => Some(order),
            (Visibility::PartOrder, _) => self.part_order.as_ref(),
            _ => None,
        }
    }

    /// Whether a way to decide visibility is right from wherever the model is seen.
    pub(super) fn is_proven(&self, visibility: Visibility) -> bool {
        match visibility {
            Visibility::MeshOrder => self.shape == Shape::Convex,
            _ => self.order_of(visibility).is_some_and(FixedOrder::is_proven),
        }
    }

    /// Whether the planned renderer has light of vertices: as asked for, or because that of
    /// triangles is not as good. Colours of vertices need it.
    #[must_use]
    pub const fn is_smooth(&self) -> bool {
        self.is_smooth
    }

    /// Whether textures have mip levels.
    pub(super) fn has_mip_levels(&self) -> bool {
        self.sampling.as_ref().is_some_and(|sampling| sampling.filter.mip_levels.is_some())
    }

    /// The worst view of a way to decide visibility.
    #[must_use]
    pub fn worst(&self, visibility: Visibility) -> Worst {
        self.worst[place(visibility)]
    }

    /// Whether a way to decide visibility shows the right surfaces. A texture with holes shows what
    /// is behind, which only depth buffers know.
    #[must_use]
    pub fn is_right(&self, visibility: Visibility) -> bool {
        let is_within = self.worst(visibility).part <= self.request.wrong_part;
        let exists = match visibility {
            Visibility::FixedOrder | Visibility::PartOrder => self.order_of(visibility).is_some(),
            _ => true,
        };
        (self.is_proven(visibility) || is_within && exists)
            && !(self.has_holes && visibility.depth_bytes() == 0)
    }

    /// The ways to decide visibility that are worth a thought: another order than that of the mesh
    /// is not, if that is right or none helps; and parts only if there are some.
    pub(super) fn considered(&self) -> impl Iterator<Item = Visibility> {
        let is_sought = matches!(self.order, Search::Found(_) | Search::Cycle(_));
        let has_parts = self.part_order.is_some();
        Visibility::ALL.into_iter().filter(move |visibility| match visibility {
            Visibility::FixedOrder => is_sought,
            Visibility::PartOrder => has_parts,
            _ => true,
        })
    }

    /// Where colours come from, for all ways that are right.
    pub(super) fn paints(&self) -> Vec<Paint> {
        let Some(sampling) = &self.sampling else {
            return vec![if self.has_vertex_colors { Paint::Vertices } else { Paint::Materials }];
        };
        let mut paints = Vec::new();
        let filter = sampling.filter;
        for correction in [Correction::Affine, Correction::Adaptive] {
            let is_right =
                correction == Correction::Adaptive || sampling.affine_error <= self.request.texels;
            let has_filter = Filter::all(correction).any(|other| other == filter);
            for (texels, psnr_db) in Texels::ALL.into_iter().zip(sampling.psnr_db) {
                if is_right && has_filter && psnr_db >= self.request.palette_db {
                    paints.push(Paint::Textures(correction, texels, filter));
                }
            }
        }
        paints
    }

    /// The model with the tables that types read.
    ///
    /// # Errors
    ///
    /// Returns an error if the file has changed and cannot be converted any more.
    pub fn model(&self, types: &Types) -> Result<Model, PlanError> {
        let size = self.sampling.as_ref().map(|sampling| sampling.sizes[1]);
        let columns = (types.is_smooth, types.paint);
        let model = converted(&self.path, &self.options, columns, size)?;
        Ok(match self.order_of(types.visibility) {
            Some(order) => order.applied(model),
            None => model,
        })
    }

    /// The frames' loads in bands of some rows, for the model with the tables that are drawn.
    #[must_use]
    pub fn loads(&self, model: &Model, types: &Types, rows: u32) -> Vec<Load> {
        let [width, height] = self.request.display;
        let (pixels, (bands, place)) = (width * height, bands(height, rows));
        // Tables for light of triangles have fewer vertices than those that were looked at.
        let vertices = model.positions.len() as u64;
        let load = |work: &Work| Load::of(work, types, vertices, [pixels, bands], place);
        self.work.iter().map(load).collect()
    }

    /// The cycles that slivers take more than other triangles do, for each view.
    pub(super) fn sliver_cycles(&self, types: &Types, rows: u32) -> Vec<f64> {
        let (_, place) = bands(self.request.display[1], rows);
        let cost = SliverCost::of(self.request.core, types);
        self.work.iter().map(|work| cost.cycles_of(&work.slivers, place)).collect()
    }

    /// The Rust file of a renderer.
    ///
    /// # Errors
    ///
    /// Returns an error if the model cannot be converted any more.
    pub fn source(&self, types: &Types, rows: u32) -> Result<String, PlanError> {
        Ok(source::source(self, &self.model(types)?, types, rows))
    }
}

/// The number of bands of some rows on a display, and the place of that height in [`band_rows`].
fn bands(height: u32, rows: u32) -> (u32, usize) {
    let place = band_rows(height).iter().position(|&other| other == rows);
    (height.div_ceil(rows), place.unwrap_or(0))
}

/// The place of a way to decide visibility among all.
fn place(visibility: Visibility) -> usize {
    Visibility::ALL.iter().position(|&other| other == visibility).unwrap_or_default()
}

/// Whether light is that of vertices.
fn is_smooth(request: &Request, normal_degrees: f64, model: &Model) -> bool {
    let has_colors = !model.vertex_colors.is_empty();
    request.is_smooth.unwrap_or(normal_degrees > FLAT_DEGREES || has_colors)
        || model.textures.is_none() && has_colors
}

/// Where colours come from without textures.
const fn plain_paint(model: &Model) -> Paint {
    if model.vertex_colors.is_empty() { Paint::Materials } else { Paint::Vertices }
}

/// The model with the tables that are read, given whether light is that of vertices and where
/// colours come from.
fn converted(
    path: &Path,
    options: &Options,
    (is_smooth, paint): (bool, Paint),
    size: Option<[usize; 2]>,
) -> Result<Model, PlanError> {
    let (format, has_mip_levels) = match paint {
        Paint::Textures(_, texels, filter) => (texels.format(), filter.mip_levels.is_some()),
        Paint::Materials | Paint::Vertices => (TexelFormat::Direct, false),
    };
    let mut options = with_texels(options, size, format, has_mip_levels);
    options.contents = Contents {
        vertex_normals: is_smooth,
        face_normals: !is_smooth,
        texture_coordinates: false,
        vertex_colors: paint == Paint::Vertices,
    };
    options.edges_degrees = None;
    if !matches!(paint, Paint::Textures(..)) {
        options.textures = None;
    }
    let mut model = Model::load(path, &options)?;
    // No shader of a plan reads them.
    model.finishes.clear();
    model.lines.clear();
    model.points.clear();
    Ok(model)
}

/// What all views show.
#[derive(Default)]
struct SeenInAll {
    work: Vec<Work>,
    worst: [Worst; Visibility::ALL.len()],
    sampling: Option<Sampling>,
    orders: Option<Orders>,
}

/// Looks at a model in all views. Without `orders` no order of the triangles is sought.
fn look(
    model: &Model,
    eye: &seen::Eye<'_>,
    request: &Request,
    views: &[Placed],
    orders: Option<Orders>,
    step: &mut impl FnMut(usize),
) -> Result<SeenInAll, PlanError> {
    let coordinates = Coverage::new(model, request);
    let sampling = coordinates.as_ref().map(|_| Sampling::default());
    let mut all = SeenInAll { sampling, orders, ..SeenInAll::default() };
    let precision = request.core.subpixel();
    for (number, view) in views.iter().enumerate() {
        let seen = eye.look(precision, view)?;
        for (worst, wrong) in all.worst.iter_mut().zip(seen.wrong) {
            *worst = worst.or_worse(Worst::new(number, wrong, seen.shown));
        }
        if let Some(orders) = all.orders.as_mut().filter(|orders| !orders.are_refused()) {
            eye.add_arcs(precision, (number as u32, view), &seen.faces, orders)?;
            // What has a cycle has it in few views: arcs of all of them take time and memory.
            let count = number + 1;
            if count.is_power_of_two() || count == views.len() {
                orders.check();
            }
        }
        if let (Some(coordinates), Some(sampling)) = (&coordinates, &mut all.sampling) {
            coordinates.measure(view, &seen.faces, sampling);
        }
        all.work.push(seen.work);
        step(number + 1);
    }
    Ok(all)
}

/// The lens of a request.
struct Lens {
    perspective: Perspective,
    range: [f64; 2],
    reach_px: f64,
}

impl Lens {
    /// One whose depth range holds the sphere around the model in all views: the closer its ends,
    /// the finer is depth.
    fn of(request: &Request, views: &[Placed], radius: f64) -> Result<Self, PlanError> {
        checked("the field of view", request.field_of_view_degrees, 1.0, 179.0)?;
        let distances = || views.iter().map(|view| view.distance);
        let nearest = distances().fold(f64::INFINITY, f64::min);
        let farthest = distances().fold(0.0, f64::max);
        checked("the camera's distance", farthest, 0.0, 16_000.0)?;
        // A Q16.16 has 2^-16; a hundredth of the radius keeps what rounding moves inside.
        let gap = nearest - radius;
        if gap < 0.02 * radius {
            return Err(PlanError::Inside { distance: nearest, radius });
        }
        let range = [gap - 0.01 * radius, farthest + 1.01 * radius];
        let range = [(range[0] * 1e4).floor() / 1e4, (range[1] * 1e4).ceil() / 1e4];
        let [near, far] = range.map(|end| Distance::from_num(end));
        let perspective = Perspective::new(angle(request.field_of_view_degrees), near, far)
            .map_err(ViewError::from)?;
        // The farthest point on the screen of a sphere is no farther than its radius at its nearest
        // distance.
        let reach_px = request.focal_length_px() * radius / gap;
        Ok(Self { perspective, range, reach_px })
    }
}

/// The distance of the farthest vertex from the origin.
fn radius(model: &Model) -> f64 {
    let square = |point: &[f64; 3]| point.iter().map(|c| c * c).sum::<f64>();
    model.exact.positions.iter().map(square).fold(0.0, f64::max).sqrt()
}

/// The largest angle between a corner's normal and that of its triangle.
fn normal_degrees(model: &Model) -> f64 {
    let (table, normals) = (model.triangles.as_triangles(), &model.exact);
    let mut least_cosine = 1.0_f64;
    for (number, face) in normals.face_normals.iter().enumerate() {
        for corner in table.get(number).unwrap_or_default() {
            let Some(normal) = normals.vertex_normals.get(corner) else { continue };
            let cosine = (0..3).map(|i| normal[i] * face[i]).sum::<f64>();
            // A triangle of no area has no normal.
            if face.iter().any(|&c| c != 0.0) {
                least_cosine = least_cosine.min(cosine);
            }
        }
    }
    least_cosine.clamp(-1.0, 1.0).acos().to_degrees()
}
