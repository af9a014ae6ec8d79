//! What is drawn with the camera and in the precision of a view: they are types of the core, and a
//! view chooses them at run time.

use rasterizer::{
    camera::Camera,
    geometry,
    numbers::{self, S4, S8},
};

use super::view::{Projection, Subpixel, View, ViewError};

/// Draws something in any precision and with any camera.
pub(super) trait Drawing {
    /// The result.
    type Drawn;

    /// Draws it.
    fn draw<S: numbers::Subpixel, P: geometry::Projection>(
        self,
        camera: &Camera<P>,
    ) -> Result<Self::Drawn, ViewError>;
}

/// Draws something in those of a view.
pub(super) fn draw<D: Drawing>(view: &View, drawing: D) -> Result<D::Drawn, ViewError> {
    match view.projection {
        Projection::Perspective { field_of_view_degrees } => {
            by_camera(view, drawing, &view.perspective(field_of_view_degrees)?)
        }
        Projection::Orthographic { height } => {
            by_camera(view, drawing, &view.orthographic(height)?)
        }
    }
}

fn by_camera<D: Drawing, P: geometry::Projection>(
    view: &View,
    drawing: D,
    camera: &Camera<P>,
) -> Result<D::Drawn, ViewError> {
    match view.subpixel {
        Subpixel::S4 => drawing.draw::<S4, P>(camera),
        Subpixel::S8 => drawing.draw::<S8, P>(camera),
    }
}
