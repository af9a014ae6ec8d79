//! What is found out about a model before anything is chosen.

use std::path::{Path, PathBuf};

use rasterizer::camera::{Distance, Perspective};

use super::{
    Correction, Load, Paint, PlanError, Request, Shape, Types, Visibility, Work, band_rows, convex,
    divided::Coordinates,
    seen, source,
    texels::{Sampling, Texels},
    types,
    views::Placed,
};
use crate::{
    check::{ViewError, angle, checked},
    model::{ColorFormat, Contents, Model, Options, TexelFormat, TextureOptions},
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

/// How textures are sampled.
#[derive(Clone, Debug)]
pub(super) struct Sampled {
    /// What all views show of them.
    pub(super) seen: Sampling,
    /// The sides of the textures, before and after they are made as small as they are seen.
    pub(super) sizes: [[usize; 2]; 2],
    /// The largest error of linear interpolation in these texels.
    pub(super) affine_error: f64,
    /// The most colours of a texture.
    pub(super) colors: usize,
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
        let model = Model::load(path, &with_texels(&options, None, TexelFormat::Direct))?;
        if model.report.triangles == 0 {
            return Err(PlanError::NoFaces(path.display().to_string()));
        }
        let views = request.views.placed(request.distance);
        let radius = radius(&model);
        let lens = Lens::of(request, &views, radius)?;
        let mesh = model.mesh();
        let eye = seen::Eye { mesh: &mesh, lens: lens.perspective, size: request.display };
        let mut seen = look(&model, &eye, request, &views, &mut step)?;
        let sampling = match seen.sampling {
            Some(seen) => Some(Sampled::new(&model, path, &options, seen)?),
            None => None,
        };
        if let Some(sampling) = &sampling {
            let coordinates = Coordinates { size: sampling.sizes[1] };
            for (work, view) in seen.work.iter_mut().zip(&views) {
                work.divided = eye.divide(request.core.subpixel(), view, coordinates)?;
            }
        }
        Ok(Self {
            shape: convex::shape(&model),
            work: seen.work,
            worst: seen.worst,
            normal_degrees: normal_degrees(&model),
            depth_range: lens.range,
            clips: lens.reach_px >= GUARD_PX,
            reach_px: lens.reach_px,
            sampling,
            path: path.to_path_buf(),
            has_vertex_colors: !model.vertex_colors.is_empty(),
            has_holes: model.textures.as_ref().is_some_and(|textures| textures.alpha.is_some()),
            options,
            request: request.clone(),
        })
    }

    /// Whether light of triangles is as good as that of vertices.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.normal_degrees <= FLAT_DEGREES && !self.has_vertex_colors
    }

    /// The worst view of a way to decide visibility.
    #[must_use]
    pub fn worst(&self, visibility: Visibility) -> Worst {
        let place = Visibility::ALL.iter().position(|&other| other == visibility);
        self.worst[place.unwrap_or_default()]
    }

    /// Whether a way to decide visibility shows the right surfaces. A texture with holes shows what
    /// is behind, which only depth buffers know.
    #[must_use]
    pub fn is_right(&self, visibility: Visibility) -> bool {
        let is_convex = visibility == Visibility::MeshOrder && self.shape == Shape::Convex;
        let is_within = self.worst(visibility).part <= self.request.wrong_part;
        (is_convex || is_within) && !(self.has_holes && visibility.depth_bytes() == 0)
    }

    /// Where colours come from, for all ways that are right.
    pub(super) fn paints(&self) -> Vec<Paint> {
        let Some(sampling) = &self.sampling else {
            return vec![if self.has_vertex_colors { Paint::Vertices } else { Paint::Materials }];
        };
        let mut paints = Vec::new();
        for correction in [Correction::Affine, Correction::Adaptive] {
            let is_right =
                correction == Correction::Adaptive || sampling.affine_error <= self.request.texels;
            for texels in [types::Texels::Direct, types::Texels::Indexed8] {
                let is_exact = texels == types::Texels::Direct || sampling.colors <= 256;
                if is_right && is_exact {
                    paints.push(Paint::Textures(correction, texels));
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
        let format = match types.paint {
            Paint::Textures(_, types::Texels::Indexed8) => TexelFormat::Indexed8,
            _ => TexelFormat::Direct,
        };
        let size = self.sampling.as_ref().map(|sampling| sampling.sizes[1]);
        let mut options = with_texels(&self.options, size, format);
        options.contents = Contents {
            vertex_normals: types.is_smooth,
            face_normals: !types.is_smooth,
            texture_coordinates: false,
            vertex_colors: types.paint == Paint::Vertices,
        };
        options.edges_degrees = None;
        if !matches!(types.paint, Paint::Textures(..)) {
            options.textures = None;
        }
        let mut model = Model::load(&self.path, &options)?;
        // No shader of a plan reads them.
        model.finishes.clear();
        model.lines.clear();
        model.points.clear();
        Ok(model)
    }

    /// The frames' loads in bands of some rows, for the model with the tables that are drawn.
    #[must_use]
    pub fn loads(&self, model: &Model, types: &Types, rows: u32) -> Vec<Load> {
        let [width, height] = self.request.display;
        let place = band_rows(height).iter().position(|&other| other == rows).unwrap_or(0);
        let (pixels, bands) = (width * height, height.div_ceil(rows));
        // Tables for light of triangles have fewer vertices than those that were looked at.
        let vertices = model.positions.len() as u64;
        let load = |work: &Work| Load::of(work, types, vertices, [pixels, bands], place);
        self.work.iter().map(load).collect()
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

/// The options with textures of a size and a format.
fn with_texels(options: &Options, size: Option<[usize; 2]>, format: TexelFormat) -> Options {
    let textures = options.textures.as_ref().map(|textures| TextureOptions {
        size: size.or(textures.size),
        format,
        color: ColorFormat::Rgb565,
        mipmaps: false,
        ..*textures
    });
    Options { textures, ..options.clone() }
}

/// What all views show.
#[derive(Default)]
struct SeenInAll {
    work: Vec<Work>,
    worst: [Worst; Visibility::ALL.len()],
    sampling: Option<Sampling>,
}

/// Looks at a model in all views.
fn look(
    model: &Model,
    eye: &seen::Eye<'_>,
    request: &Request,
    views: &[Placed],
    step: &mut impl FnMut(usize),
) -> Result<SeenInAll, PlanError> {
    let coordinates = Texels::new(model, request.focal_length_px());
    let sampling = coordinates.as_ref().map(|_| Sampling::default());
    let mut all = SeenInAll { sampling, ..SeenInAll::default() };
    for (number, view) in views.iter().enumerate() {
        let seen = eye.look(request.core.subpixel(), view)?;
        for (worst, wrong) in all.worst.iter_mut().zip(seen.wrong) {
            let part = wrong as f64 / seen.shown.max(1) as f64;
            if part > worst.part {
                *worst = Worst { view: number, wrong, part };
            }
        }
        if let (Some(coordinates), Some(sampling)) = (&coordinates, &mut all.sampling) {
            let mut pixels = vec![0; model.report.triangles];
            for face in seen.faces.iter().filter(|&&face| face > 0) {
                pixels[*face as usize - 1] += 1;
            }
            coordinates.measure(view, &pixels, sampling);
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

impl Sampled {
    fn new(
        model: &Model,
        path: &Path,
        options: &Options,
        seen: Sampling,
    ) -> Result<Self, PlanError> {
        let textures = model.textures.as_ref();
        let size = textures.map_or([1; 2], |textures| textures.size);
        let chosen = options.textures.as_ref().and_then(|textures| textures.size);
        // A size that was asked for stays.
        let halvings = if chosen.is_some() { 0 } else { seen.halvings() };
        let smaller = size.map(|side| (side >> halvings).max(1));
        let colors = if halvings > 0 {
            let options = with_texels(options, Some(smaller), TexelFormat::Direct);
            most_colors(&Model::load(path, &options)?)
        } else {
            most_colors(model)
        };
        let scale = smaller[0] as f64 / size[0] as f64;
        let affine_error = seen.affine_error * scale;
        Ok(Self { seen, sizes: [size, smaller], affine_error, colors })
    }
}

/// The most different colours that a texture has.
fn most_colors(model: &Model) -> usize {
    let colors = |texels: &[u32]| {
        let mut colors = texels.to_vec();
        colors.sort_unstable();
        colors.dedup();
        colors.len()
    };
    let textures = model.textures.iter().flat_map(|textures| &textures.textures);
    textures.map(|texture| colors(&texture.texels)).max().unwrap_or(0)
}
