//! The fixed-point picture of a model in a view, by the same tables and the same calls as on a
//! microcontroller.

use std::time::{Duration, Instant};

use embedded_graphics_core::{geometry::Point, pixelcolor::Rgb888};
use rasterizer::{
    camera::Camera,
    color::Composite,
    geometry::{self, ClipPlanes, ScreenVertex},
    numbers,
    output::{Replace, StoredColor},
    scene::{Mode, Object},
    shade::{self, Density, Fogged, OnScreen, Shader},
    texture::Texel,
};

use super::{
    Blending, Fog, MOST_PLANES, NormalErrors, Texels,
    any_depth::{self, AnyDepth},
    blending::Layers,
    drawing::{self, Drawing},
    fog::{self, AnyFog, SeenPicture},
    form::{Form, Formed, UseObject, in_form},
    layers,
    object::{self, FixedPicture, screen_triangles, to_pixels},
    surface::Surface,
    view::{View, ViewError},
};
use crate::{
    model::Model,
    reference::{self, Corner, Picture, Sample, ScreenTriangle},
};

/// A frame by the core, and how the reference draws it.
pub(super) struct Drawn<'a> {
    pub(super) picture: FixedPicture,
    /// Where the core places each vertex, in pixels; `None` for those outside near plane, far plane
    /// and guard band.
    pub(super) vertices: Vec<Option<[f64; 2]>>,
    /// How long the core takes for vertices and triangles.
    pub(super) time: Duration,
    /// The model blended with itself, if the view blends.
    pub(super) blended: Option<Layers>,
    /// Draws the reference on the core's own vertices, with depth from 0 to 1, and judges texture
    /// coordinates. It is given the core's picture, because some pixels have several right colours.
    pub(super) arithmetic: Box<dyn FnOnce(&FixedPicture) -> Arithmetic + 'a>,
    /// Draws the reference from the faces of the OBJ file, with depth from 0 to 1.
    pub(super) end_to_end: Box<dyn FnOnce() -> Picture + 'a>,
}

/// The reference on the core's own vertices, how far texture coordinates and normals are off, and
/// the alphas of textures.
pub(super) type Arithmetic = (Picture, Option<Texels>, Option<NormalErrors>, Option<TexelAlphas>);

/// The least and the greatest alpha that a texel may have, from 0 to 1, of every fragment.
pub(super) type TexelAlphas = Picture<[f64; 2]>;

/// Draws a model by the core.
///
/// The reference interpolates what `placed` returns for a triangle and the stored varyings of a
/// corner, and `shade` colours it. From the faces of the file it interpolates what `exact` returns
/// for a corner of [`Surface`], and `shade_exact` colours that.
pub(super) fn draw<'a, const N: usize, Sh: Shader<Color = Rgb888, Outcome = Rgb888>>(
    (model, surface): (&'a Model, &'a Surface),
    view: &View,
    shader: &Sh,
    placed: impl Fn(usize, OnScreen<Sh>) -> [f64; N],
    shade: impl Fn(Sample<N>) -> Option<[f64; 3]> + 'a,
    exact: impl Fn(Corner) -> [f64; N] + 'a,
    shade_exact: impl Fn(Sample<N>) -> Option<[f64; 3]> + 'a,
) -> Result<Drawn<'a>, ViewError> {
    let Placed { picture, triangles, vertices, time, blended, fog, .. } =
        place(model, view, shader, placed)?;
    let size = view.size.map(|c| c as usize).into();
    let arithmetic = move |fixed: &FixedPicture| {
        let bare = reference::draw_screen(&triangles, size, shade);
        let picture = match fog {
            Some(fog) => fog.over(&bare, |pixel| fixed.color(pixel)),
            None => bare,
        };
        (picture, None, None, None)
    };
    Ok(Drawn {
        picture,
        vertices,
        time,
        blended,
        arithmetic: Box::new(arithmetic),
        end_to_end: end_to_end((model, surface), view, exact, shade_exact),
    })
}

/// Draws the reference from the faces of the OBJ file.
pub(super) fn end_to_end<'a, const N: usize>(
    (model, surface): (&'a Model, &'a Surface),
    view: &View,
    varyings: impl Fn(Corner) -> [f64; N] + 'a,
    shade: impl Fn(Sample<N>) -> Option<[f64; 3]> + 'a,
) -> Box<dyn FnOnce() -> Picture + 'a> {
    let view = view.rounded();
    Box::new(move || {
        let (camera, mesh) = (view.reference_camera(), surface.mesh(model, &view));
        let size = view.size.map(|c| c as usize).into();
        let bare = reference::draw_clipped_scene(
            &camera,
            &mesh,
            &view.half_spaces(),
            reference::Culling::Back,
            size,
            varyings,
            shade,
        );
        match view.fog {
            Some(fog) => fog.over(&bare, |depth| view.fog_distance(depth)),
            None => bare,
        }
    })
}

/// A frame by the core, and its triangles on the screen.
pub(super) struct Placed<const N: usize, C> {
    pub(super) picture: FixedPicture,
    pub(super) triangles: Vec<ScreenTriangle<N>>,
    pub(super) vertices: Vec<Option<[f64; 2]>>,
    pub(super) time: Duration,
    /// The colours of the picture, row by row.
    pub(super) colors: Vec<C>,
    pub(super) blended: Option<Layers>,
    /// Fog on the same triangles, if there is any.
    pub(super) fog: Option<SeenPicture>,
}

/// Draws a model by the core, in the form and the fog of the view and cut at its planes. `placed`
/// returns the reference's varyings of a corner.
///
/// A view with fog, planes or a form has one type for fog and planes, with a fog that may be none
/// and planes that may be far away: a copy of the code for each would take another minute to
/// compile.
pub(super) fn place<const N: usize, Sh>(
    model: &Model,
    view: &View,
    shader: &Sh,
    placed: impl Fn(usize, OnScreen<Sh>) -> [f64; N],
) -> Result<Placed<N, Sh::Color>, ViewError>
where
    Sh: Shader<Color: ShownColor + Composite, Outcome: Texel<<Sh as Shader>::Color>>,
{
    let chosen = view.fog.unwrap_or(Fog::NONE);
    let core = view.core_fog()?.unwrap_or(shade::Fog::exponential(Density::ZERO));
    let in_fog = Fogged::new(shader.clone(), &core, chosen.core_color().into()).computed(AnyFog);
    let near = view.rounded().near;
    fog::with(chosen.by, || {
        let planes = view.planes.core()?;
        let is_plain = view.fog.is_none() && !view.planes.exist() && view.form == Form::AsModelled;
        let drawn = if is_plain {
            let placed = |triangle, corner| (placed(triangle, corner), 1.0);
            any_depth::with(view.depth, || {
                drawing::draw(view, Plain { model, view, shader, placed })
            })
        } else {
            let placed =
                |triangle, (corner, seen)| (placed(triangle, corner), fog::inverse_w(seen, near));
            any_depth::with(view.depth, || {
                in_form(model, view, in_fog.clone(), Cut { view, planes, placed })
            })
        }?;
        let blended = match view.blending {
            Blending::Replace => None,
            Blending::By(blend) => Some(layers::blended(model, view, blend, &in_fog)?),
        };
        Ok(Placed { blended, ..drawn })
    })
}

/// A colour type of pictures that can be compared.
pub(super) trait ShownColor: StoredColor + From<Rgb888> + Into<Rgb888> {}

impl<C: StoredColor + From<Rgb888> + Into<Rgb888>> ShownColor for C {}

/// A model as it was modelled, without planes, and what the reference has at its corners.
struct Plain<'a, Sh, F> {
    model: &'a Model,
    view: &'a View,
    shader: &'a Sh,
    /// The varyings and 1 / w of a corner of a triangle.
    placed: F,
}

impl<const N: usize, Sh, F> Drawing for Plain<'_, Sh, F>
where
    Sh: Shader<Color: ShownColor>,
    F: Fn(usize, OnScreen<Sh>) -> ([f64; N], f64),
{
    type Drawn = Placed<N, Sh::Color>;

    fn draw<S: numbers::Subpixel, P: geometry::Projection>(
        self,
        camera: &Camera<P>,
    ) -> Result<Self::Drawn, ViewError> {
        let Self { model, view, shader, placed } = self;
        let mesh = model.mesh();
        let object = Object::new(&mesh, shader.clone()).posed(view.pose()?);
        draw_object(&object, view, (camera, S::default()), placed)
    }
}

/// Planes that cut a model, and what the reference has at its corners.
struct Cut<'a, F> {
    view: &'a View,
    planes: ClipPlanes<MOST_PLANES>,
    /// The varyings and 1 / w of a corner of a triangle.
    placed: F,
}

impl<const N: usize, Sh, F> UseObject<Sh> for Cut<'_, F>
where
    Sh: Shader<Color: ShownColor>,
    F: Fn(usize, OnScreen<Sh>) -> ([f64; N], f64),
{
    type Done = Placed<N, Sh::Color>;

    fn use_object<S: numbers::Subpixel, P: geometry::Projection>(
        self,
        object: Formed<'_, Sh>,
        camera: &Camera<P>,
    ) -> Result<Self::Done, ViewError> {
        let Self { view, planes, placed } = self;
        draw_object(&object.clipped(planes), view, (camera, S::default()), placed)
    }
}

/// Draws an object, with a camera and in a precision. `placed` returns the varyings and 1 / w of a
/// corner of a triangle.
fn draw_object<const N: usize, Sh, M, P, S>(
    object: &Object<'_, Sh, M>,
    view: &View,
    (camera, _): (&Camera<P>, S),
    placed: impl Fn(usize, OnScreen<Sh>) -> ([f64; N], f64),
) -> Result<Placed<N, Sh::Color>, ViewError>
where
    Sh: Shader<Color: ShownColor>,
    M: Mode<Blending = Replace>,
    P: geometry::Projection,
    S: numbers::Subpixel,
{
    let mut storage =
        vec![ScreenVertex::<S, AnyDepth, OnScreen<Sh>>::EMPTY; object.mesh().vertex_count()];
    let start = Instant::now();
    let projected = object.project(camera, &mut storage)?;
    let projecting = start.elapsed();
    let drawn = object::draw_colors(&projected, view.area())?;
    let (depth, mut inverses) = (view.depth.definition(), Vec::new());
    let triangles = screen_triangles(&projected, Point::zero(), |triangle, corner| {
        let (varyings, inverse_w) = placed(triangle, corner.varyings());
        inverses.push(inverse_w);
        (depth.depth(corner.depth().into()), varyings)
    });
    let fog = view.rounded().fog.map(|fog| {
        let size = view.size.map(|c| c as usize).into();
        SeenPicture::new(fog, &fog::triangles(&triangles, &inverses), size)
    });
    let vertices =
        projected.vertices().iter().map(|vertex| vertex.position().map(to_pixels::<S>)).collect();
    Ok(Placed {
        picture: drawn.picture(view.area()),
        triangles,
        vertices,
        time: projecting + drawn.time,
        colors: drawn.color,
        blended: None,
        fog,
    })
}
