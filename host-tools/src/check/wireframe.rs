//! The edges of a model, by the same calls as on a microcontroller.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    camera::Camera,
    fixed::types::{I0F32, I8F8},
    geometry,
    geometry::ScreenVertex,
    mesh::{Lines, Segments},
    numbers::{self, S4, S8},
    output::Frame,
    raster::Bias,
    scene::Object,
    shade::Unlit,
};

use super::{
    FixedPicture, Pixel,
    view::{Projection, Subpixel, View, ViewError},
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
    match view.projection {
        Projection::Perspective { field_of_view_degrees } => {
            by_camera(model, view, &view.perspective(field_of_view_degrees)?, hides_lines)
        }
        Projection::Orthographic { height } => {
            by_camera(model, view, &view.orthographic(height)?, hides_lines)
        }
    }
}

fn by_camera<P: geometry::Projection>(
    model: &Model,
    view: &View,
    camera: &Camera<P>,
    hides_lines: bool,
) -> Result<FixedPicture, ViewError> {
    match view.subpixel {
        Subpixel::S4 => by_precision::<S4, P>(model, view, camera, hides_lines),
        Subpixel::S8 => by_precision::<S8, P>(model, view, camera, hides_lines),
    }
}

fn by_precision<S: numbers::Subpixel, P: geometry::Projection>(
    model: &Model,
    view: &View,
    camera: &Camera<P>,
    hides_lines: bool,
) -> Result<FixedPicture, ViewError> {
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
    let pixel = |(color, depth): (&Rgb888, &u32)| Pixel {
        color: [color.r(), color.g(), color.b()],
        depth: *depth,
    };
    Ok(FixedPicture { size: view.size, pixels: colors.iter().zip(&depth).map(pixel).collect() })
}
