//! Where the camera stands, how it projects, and how the model is turned.

use clap::Args;
use host_tools::check::{Look, Projection, View};

use super::names::{numbers, within};

#[derive(Clone, Debug, Args)]
pub(super) struct CameraOptions {
    /// Where the camera stands in the world. It looks at --target, models are as they are made, and
    /// --frames turns them about y
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_parser = point,
        allow_hyphen_values = true,
        conflicts_with_all = ["distance", "yaw", "pitch", "roll"]
    )]
    eye: Option<[f64; 3]>,
    /// What the camera looks at [default: the origin]
    #[arg(
        long,
        value_name = "X,Y,Z",
        requires = "eye",
        value_parser = point,
        allow_hyphen_values = true
    )]
    target: Option<[f64; 3]>,
    /// The direction that points upwards in the picture [default: 0,1,0]
    #[arg(
        long,
        value_name = "X,Y,Z",
        requires = "eye",
        value_parser = point,
        allow_hyphen_values = true
    )]
    up: Option<[f64; 3]>,
    /// Distance of the camera from the origin; a model is fitted into a sphere of radius 1
    #[arg(
        long,
        value_name = "UNITS",
        default_value_t = View::default().distance,
        value_parser = within(0.0, 32_000.0),
        allow_negative_numbers = true
    )]
    distance: f64,
    /// Vertical field of view of a perspective camera
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 40.0,
        value_parser = within(0.01, 179.9),
        allow_negative_numbers = true
    )]
    fov: f64,
    /// Use an orthographic camera instead; the picture shows this many units from top to bottom
    #[arg(
        long,
        value_name = "HEIGHT",
        conflicts_with = "fov",
        value_parser = within(1.0 / 65_536.0, 32_000.0),
        allow_negative_numbers = true
    )]
    orthographic: Option<f64>,
    /// Distance of the near plane from the camera
    #[arg(
        long,
        value_name = "UNITS",
        default_value_t = View::default().near,
        value_parser = within(1.0 / 65_536.0, 65_535.0),
        allow_negative_numbers = true
    )]
    near: f64,
    /// Distance of the far plane
    #[arg(
        long,
        value_name = "UNITS",
        default_value_t = View::default().far,
        value_parser = within(1.0 / 65_536.0, 65_535.0),
        allow_negative_numbers = true
    )]
    far: f64,
    /// Turn of the model about y (up), the first of three turns
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = View::default().yaw_degrees,
        value_parser = within(-3_600.0, 3_600.0),
        allow_negative_numbers = true
    )]
    yaw: f64,
    /// Turn about x (right)
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = View::default().pitch_degrees,
        value_parser = within(-3_600.0, 3_600.0),
        allow_negative_numbers = true
    )]
    pitch: f64,
    /// Turn about z (toward the viewer), the last turn
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = View::default().roll_degrees,
        value_parser = within(-3_600.0, 3_600.0),
        allow_negative_numbers = true
    )]
    roll: f64,
}

impl CameraOptions {
    pub(super) fn over(&self, view: View) -> View {
        let look = self.eye.map(|eye| Look {
            eye,
            target: self.target.unwrap_or_default(),
            up: self.up.unwrap_or([0.0, 1.0, 0.0]),
        });
        let [yaw, pitch, roll] =
            if look.is_some() { [0.0; 3] } else { [self.yaw, self.pitch, self.roll] };
        let perspective = Projection::Perspective { field_of_view_degrees: self.fov };
        View {
            distance: self.distance,
            look,
            projection: self
                .orthographic
                .map_or(perspective, |height| Projection::Orthographic { height }),
            near: self.near,
            far: self.far,
            yaw_degrees: yaw,
            pitch_degrees: pitch,
            roll_degrees: roll,
            ..view
        }
    }
}

/// A point or a direction, as in 1,2,0.5.
fn point(text: &str) -> Result<[f64; 3], &'static str> {
    let found = numbers(text).and_then(|numbers| numbers.try_into().ok());
    found.ok_or("write three numbers up to 32000, as in 1,2,0.5")
}
