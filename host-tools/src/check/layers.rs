//! A model blended with itself by the core, and the layers of each pixel.

use std::cell::RefCell;

use embedded_graphics_core::{geometry::Point, pixelcolor::Rgb888};
use rasterizer::{
    attribute::NoDepth,
    camera::Camera,
    color::Alpha,
    geometry,
    mesh::MeshVertex,
    numbers,
    output::{Frame, MaterialOpacity},
    shade::{Faded, Shader},
};

use super::{
    alphas::Fading,
    blending::{self, Layers, Recorder},
    display::rgb888,
    fixed::ShownColor,
    form::{Formed, UseObject, in_form},
    object::screen_triangles,
    view::{View, ViewError},
};
use crate::{
    model::Model,
    reference::{Blend, Picture, Sample, ScreenTriangle, draw_screen},
};

/// Blends a model with itself, from back to front.
///
/// Without depth: all of its layers are seen. The shader is one in fog, which may be none, and
/// planes may be far away, so that the code is compiled once.
pub(super) fn blended<Sh: Shader<Color: ShownColor>>(
    model: &Model,
    view: &View,
    blend: Blend,
    shader: &Sh,
) -> Result<Layers, ViewError> {
    let fading = Fading::of(model, view)?;
    let shader = Faded::new(shader.clone(), fading.of_vertices());
    in_form(model, view, shader, Blended { model, view, blend })
}

/// What blends an object with itself.
struct Blended<'a> {
    model: &'a Model,
    view: &'a View,
    blend: Blend,
}

impl<Sh, F> UseObject<Faded<Sh, F>> for Blended<'_>
where
    Sh: Shader<Color: ShownColor>,
    F: Fn(&MeshVertex<'_>) -> Alpha + Clone,
{
    type Done = Layers;

    fn use_object<S: numbers::Subpixel, P: geometry::Projection>(
        self,
        object: Formed<'_, Faded<Sh, F>>,
        camera: &Camera<P>,
    ) -> Result<Layers, ViewError> {
        let Self { model, view, blend } = self;
        let layers = RefCell::default();
        let factor = MaterialOpacity::times(blending::alpha(view.opacity));
        let object = object.clipped(view.planes.core()?).blended(Recorder {
            blend,
            factor,
            layers: &layers,
        });
        let mut order = vec![0; model.mesh().triangle_count()];
        let projected = object.project_on_demand::<P, S, NoDepth>(camera, S::default())?;
        // Varyings of alphas have 15 bits behind the point; depth is not compared here.
        let triangles = screen_triangles(&projected, Point::zero(), |_, corner| {
            let (_, [alpha]) = corner.varyings();
            (0.5, [f64::from(alpha) / 32_768.0])
        });
        let size = view.size.map(|side| side as usize).into();
        let alphas = alphas(&triangles, size);
        let projected = projected.back_to_front(&mut order)?;
        let background = Sh::Color::from(rgb888(view.background));
        let mut colors = vec![background; view.pixel_count()];
        let Ok(()) = projected.draw(&mut Frame::without_depth(&mut colors, view.area())?);
        let colors: Vec<Rgb888> = colors.into_iter().map(Into::into).collect();
        let order: Vec<usize> = projected.order().triangles().collect();
        Ok(Layers::new((model, view, blend), &colors, &layers.borrow(), &order, alphas))
    }
}

/// The alphas of the layers of each pixel.
fn alphas(triangles: &[ScreenTriangle<1>], size: (usize, usize)) -> Picture<f64> {
    draw_screen(triangles, size, |sample: Sample<1>| Some(sample.varyings[0]))
}
