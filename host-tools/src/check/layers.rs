//! A model blended with itself by the core, and the layers of each pixel.

use std::cell::RefCell;

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::{
    attribute::NoDepth,
    camera::Camera,
    geometry,
    numbers::{self, S4, S8},
    output::{Frame, MaterialOpacity},
    scene::Object,
    shade::Shader,
};

use super::{
    blending::{self, Layers, Recorder},
    fixed::ShownColor,
    view::{Projection, Subpixel, View, ViewError},
};
use crate::{model::Model, reference::Blend};

/// Draws a model blended with itself, from back to front, and keeps its layers.
///
/// Without depth: all of them are seen. The shader is one in fog, which may be none, so that the
/// code is compiled once for both.
pub(super) fn draw<Sh: Shader<Color: ShownColor>>(
    model: &Model,
    (view, blend): (&View, Blend),
    shader: &Sh,
) -> Result<Layers, ViewError> {
    match view.projection {
        Projection::Perspective { field_of_view_degrees } => {
            let camera = view.perspective(field_of_view_degrees)?;
            by_camera(model, (view, blend), &camera, shader)
        }
        Projection::Orthographic { height } => {
            let camera = view.orthographic(height)?;
            by_camera(model, (view, blend), &camera, shader)
        }
    }
}

fn by_camera<P: geometry::Projection, Sh: Shader<Color: ShownColor>>(
    model: &Model,
    what: (&View, Blend),
    camera: &Camera<P>,
    shader: &Sh,
) -> Result<Layers, ViewError> {
    match what.0.subpixel {
        Subpixel::S4 => by_precision::<S4, _, _>(model, what, camera, shader),
        Subpixel::S8 => by_precision::<S8, _, _>(model, what, camera, shader),
    }
}

fn by_precision<S, P, Sh>(
    model: &Model,
    (view, blend): (&View, Blend),
    camera: &Camera<P>,
    shader: &Sh,
) -> Result<Layers, ViewError>
where
    S: numbers::Subpixel,
    P: geometry::Projection,
    Sh: Shader<Color: ShownColor>,
{
    let (mesh, layers) = (model.mesh(), RefCell::default());
    let factor = MaterialOpacity::times(blending::alpha(view.opacity));
    let object = Object::new(&mesh, shader.clone()).posed(view.pose()).blended(Recorder {
        blend,
        factor,
        layers: &layers,
    });
    let mut order = vec![0; mesh.triangle_count()];
    let projected = object.project_on_demand::<P, S, NoDepth>(camera, S::default())?;
    let projected = projected.back_to_front(&mut order)?;
    let [red, green, blue] = view.background;
    let pixels = view.size.iter().map(|&side| side as usize).product();
    let mut colors = vec![Sh::Color::from(Rgb888::new(red, green, blue)); pixels];
    let Ok(()) = projected.draw(&mut Frame::without_depth(&mut colors, view.area())?);
    let colors = colors.into_iter().map(Into::into);
    let order = projected.order().triangles();
    Ok(Layers::new((view, blend), colors, &layers.borrow(), order, mesh.triangle_count()))
}
