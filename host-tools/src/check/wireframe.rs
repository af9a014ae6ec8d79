//! The edges of a model, by the same calls as on a microcontroller.

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::{
    camera::Camera,
    fixed::types::{I0F32, I8F8},
    geometry::{self, ScreenVertex},
    mesh::{Lines, Segments},
    numbers,
    output::Frame,
    raster::Bias,
    scene::Object,
    shade::Unlit,
};

use super::{
    FixedPicture,
    drawing::{self, Drawing},
    view::{View, ViewError},
};
use crate::model::Model;

/// The colour of lines.
const LINE: Rgb888 = Rgb888::new(230, 236, 232);

/// Moves surfaces behind the lines that lie in them: a line's pixels are up to half a pixel away
/// from it, and depth is rounded.
const BEHIND: Bias = Bias { slope: I8F8::lit("-1"), constant: I0F32::from_bits(-1 << 10) };

/// Draws the [edges](Model::edges) of a model, all of them or those that it does not hide, in the
/// view's precision and with 32 bits of depth. The view's shading is not used.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw the model in
/// it.
pub fn wireframe(model: &Model, view: &View, hides_lines: bool) -> Result<FixedPicture, ViewError> {
    drawing::draw(view, Edges { model, view, hides_lines })
}

struct Edges<'a> {
    model: &'a Model,
    view: &'a View,
    hides_lines: bool,
}

impl Drawing for Edges<'_> {
    type Drawn = FixedPicture;

    fn draw<S: numbers::Subpixel, P: geometry::Projection>(
        self,
        camera: &Camera<P>,
    ) -> Result<FixedPicture, ViewError> {
        let Self { model, view, hides_lines } = self;
        let mesh = model.mesh();
        let edges: Vec<_> = model.edges.iter().map(|edge| edge.map(|i| i as u16)).collect();
        let lines = Lines::new_const(&mesh, Segments::U16(&edges));
        let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(view.pose()).biased(BEHIND);
        let mut storage = vec![ScreenVertex::<S, u32, _>::EMPTY; mesh.vertex_count()];
        let seen = object.project(camera, &mut storage)?;

        let [red, green, blue] = view.background;
        let pixels = view.size.iter().map(|&side| side as usize).product();
        let mut colors = vec![Rgb888::new(red, green, blue); pixels];
        let mut depth = vec![0u32; pixels];
        let mut frame = Frame::new(&mut colors, &mut depth, view.area())?;
        if hides_lines {
            let Ok(()) = seen.draw_depth(&mut frame);
        }
        let Ok(()) = seen.lines(&lines).fill(LINE, &mut frame);
        Ok(FixedPicture::new(view.size, &colors, &depth))
    }
}
