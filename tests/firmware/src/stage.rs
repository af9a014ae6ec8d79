//! The display, the light, the cameras and the poses of the bench scenes.

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::Pose,
    numbers::{Rotation, Turn, Vec3},
    shade::{Lamp, Level, Light},
};

use crate::cost::fail;

/// The size of the display.
pub const SIZE: Size = Size::new(320, 240);
/// The display.
pub const AREA: Rectangle = Rectangle::new(Point::zero(), SIZE);
/// Its pixels.
pub const PIXELS: usize = (SIZE.width * SIZE.height) as usize;

/// One directional light.
pub const fn sun() -> Light {
    Light::new(Vec3::lit("-1", "2", "3"), Level::lit("0.2"), Level::lit("0.8"))
}

/// Beside the model.
pub const LAMP: Lamp =
    Lamp::new(Vec3::lit("0.8", "0.9", "1.2"), Distance::lit("1.5"), Level::lit("0.8"));

/// A camera that looks at the origin, with its focal length in pixels.
pub fn view(focal_length: &str, distance: &str) -> Camera {
    view_on(AREA, Distance::lit(focal_length), Vec3::lit("0", "0", distance))
}

/// The same in another viewport and from another place, along the z axis.
pub fn view_on(viewport: Rectangle, focal_length: Distance, eye: Vec3) -> Camera {
    let [near, far] = ["0.1", "100"].map(Distance::lit);
    let lens = Perspective::with_focal_length(focal_length, near, far);
    Camera::at(eye, Rotation::IDENTITY, lens.unwrap_or_else(fail), viewport).unwrap_or_else(fail)
}

/// How the model is turned in a frame.
pub fn pose(frame: u32) -> Pose {
    Pose::rotated(
        Rotation::about_x(Turn::fraction(30, 512))
            * Rotation::about_y(Turn::fraction(64 * frame + 20, 512)),
    )
}
