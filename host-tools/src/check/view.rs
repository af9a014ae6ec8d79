//! The view of a model, for both rasterizers.

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use rasterizer::{
    camera::{Camera, CameraError, Distance, Orthographic, Perspective},
    numbers::{Rotation, Scalar, Vec3},
    output::FrameError,
    scene::ProjectError,
    shade,
};

use super::{
    BACKGROUND, Blending, Correction, DepthFormat, Display, FadeAlong, Filter, Fog, Form, Look,
    Place, Shading, ViewLights, ViewPlanes,
    stand::{STEP, angle, rounded_degrees},
};
use crate::reference;

/// How finely vertices are placed on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Subpixel {
    /// Sixteenths of a pixel.
    S4,
    /// 256ths of a pixel.
    #[default]
    S8,
}

impl Subpixel {
    /// The binary digits behind the point of a pixel coordinate.
    #[must_use]
    pub const fn bits(self) -> u32 {
        match self {
            Self::S4 => 4,
            Self::S8 => 8,
        }
    }
}

/// How space becomes a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// By the vertical field of view in degrees.
    Perspective {
        /// Between the upper and the lower edge of the picture.
        field_of_view_degrees: f64,
    },
    /// By the height of the view in model units.
    Orthographic {
        /// Between the upper and the lower edge of the picture.
        height: f64,
    },
}

/// The camera stands on the z axis and looks at the origin, or [looks](Look) from anywhere to
/// anywhere; the world, in which the model has its [`Place`], is turned about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// How far the camera stands from the origin, in model units, if it does not [look](Self::look)
    /// from elsewhere.
    pub distance: f64,
    /// Where the camera stands and what it looks at; `None` for the z axis and the origin.
    pub look: Option<Look>,
    /// What the model goes through before it is placed.
    pub form: Form,
    /// Where the model stands.
    pub place: Place,
    /// The projection.
    pub projection: Projection,
    /// The distance of the near plane.
    pub near: f64,
    /// The distance of the far plane.
    pub far: f64,
    /// How far the model is turned about y, in degrees; this comes first.
    pub yaw_degrees: f64,
    /// How far it is turned about x, in degrees.
    pub pitch_degrees: f64,
    /// How far it is turned about z, in degrees; this comes last.
    pub roll_degrees: f64,
    /// Sub-pixel precision of the fixed-point picture.
    pub subpixel: Subpixel,
    /// Depth format of the fixed-point picture.
    pub depth: DepthFormat,
    /// How triangles are coloured.
    pub shading: Shading,
    /// How texture coordinates are interpolated.
    pub perspective: Correction,
    /// How a colour is taken from a texture.
    pub filter: Filter,
    /// The display that shows the picture; `None` for one with all of its colours.
    pub display: Option<Display>,
    /// What lights the model.
    pub lights: ViewLights,
    /// How pixels are put onto the picture.
    pub blending: Blending,
    /// What blended pixels lie on.
    pub background: [u8; 3],
    /// What the opacity of all materials is multiplied by where pixels are blended, from 0 to 1.
    pub opacity: f64,
    /// Along which axis of the model pixels fade where they are blended.
    pub fade: FadeAlong,
    /// What colours fade into with the distance.
    pub fog: Option<Fog>,
    /// Where the model is cut.
    pub planes: ViewPlanes,
}

impl Default for View {
    /// A model of unit fit fills most of a QVGA display.
    fn default() -> Self {
        Self {
            size: [320, 240],
            distance: 3.0,
            look: None,
            form: Form::default(),
            place: Place::default(),
            projection: Projection::Perspective { field_of_view_degrees: 40.0 },
            near: 0.1,
            far: 100.0,
            yaw_degrees: 30.0,
            pitch_degrees: 20.0,
            roll_degrees: 0.0,
            subpixel: Subpixel::default(),
            depth: DepthFormat::default(),
            shading: Shading::default(),
            perspective: Correction::default(),
            filter: Filter::default(),
            display: None,
            lights: ViewLights::default(),
            blending: Blending::default(),
            background: BACKGROUND,
            opacity: 1.0,
            fade: FadeAlong::None,
            fog: None,
            planes: ViewPlanes::default(),
        }
    }
}

/// Why a model cannot be drawn in a view.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ViewError {
    /// A number is outside what the fixed-point types hold.
    #[error("{what} is {value}, but must lie from {least} to {most}")]
    OutOfRange {
        /// What the number is for.
        what: &'static str,
        /// The number.
        value: f64,
        /// The least that is allowed.
        least: f64,
        /// The most that is allowed.
        most: f64,
    },
    /// The camera's numbers contradict each other.
    #[error("{0}")]
    Camera(#[from] CameraError),
    /// The fog has no law.
    #[error("the fog ends at {end}, but must end beyond its start at {start}")]
    Fog {
        /// Where it starts.
        start: f64,
        /// Where it ends.
        end: f64,
    },
    /// The model has one shape alone, so nothing is between two.
    #[error("the model has one shape: a second file of it has another")]
    OneShape,
    /// The matrix has no inverse, so no normals follow from it.
    #[error("the matrix flattens the model: `render` draws that, but it is not judged")]
    Flat,
    /// The matrix is nearly flat.
    #[error(
        "the matrix stretches {unevenness:.0} times more in one direction than in another, but \
         normals have a bound up to {most} times only"
    )]
    Uneven {
        /// The largest stretch over the least.
        unevenness: f64,
        /// The most that is judged.
        most: f64,
    },
    /// The core refuses the model in this view.
    #[error("{0}")]
    Project(#[from] ProjectError),
    /// The buffers do not fit the picture, which is a mistake of this program.
    #[error("{0}")]
    Frame(#[from] FrameError),
}

impl View {
    /// Returns the view with the model turned further about y: step `frame` of `frames` in a full
    /// turn. A model between two shapes goes to the one of the middle of the turn and back.
    #[must_use]
    pub fn turned(self, frame: u32, frames: u32) -> Self {
        let part = f64::from(frame) / f64::from(frames);
        Self { yaw_degrees: self.yaw_degrees + 360.0 * part, form: self.form.turned(part), ..self }
    }

    /// The view rounded to the fixed-point numbers of the core.
    pub(super) fn rounded(self) -> Self {
        let turn = rounded_degrees;
        let length = |length: f64| (length / STEP).round() * STEP;
        Self {
            distance: length(self.distance),
            look: self.look.map(Look::rounded),
            form: self.form.rounded(),
            place: self.place.rounded(),
            projection: match self.projection {
                Projection::Perspective { field_of_view_degrees } => {
                    Projection::Perspective { field_of_view_degrees: turn(field_of_view_degrees) }
                }
                Projection::Orthographic { height } => {
                    Projection::Orthographic { height: length(height) }
                }
            },
            near: length(self.near),
            far: length(self.far),
            yaw_degrees: turn(self.yaw_degrees),
            pitch_degrees: turn(self.pitch_degrees),
            roll_degrees: turn(self.roll_degrees),
            fog: self.fog.map(Fog::rounded),
            planes: self.planes.rounded(),
            ..self
        }
    }

    /// How many pixels the picture has.
    pub(super) const fn pixel_count(&self) -> usize {
        let [width, height] = self.size;
        width as usize * height as usize
    }

    /// The rectangle of the display that the picture fills.
    pub(super) const fn area(&self) -> Rectangle {
        let [width, height] = self.size;
        Rectangle::new(Point::zero(), Size::new(width, height))
    }

    fn fixed_camera<P>(&self, projection: P) -> Result<Camera<P>, ViewError> {
        if let Some(look) = self.look {
            let [eye, target, up] = look.core()?;
            return Ok(Camera::look_at(eye, target, up, projection, self.area())?);
        }
        let eye = checked("the camera's distance", self.distance, -32_000.0, 32_000.0)?;
        let eye = Vec3::new(Scalar::ZERO, Scalar::ZERO, Scalar::from_num(eye));
        Ok(Camera::at(eye, Rotation::IDENTITY, projection, self.area())?)
    }

    pub(super) fn perspective(
        &self,
        field_of_view_degrees: f64,
    ) -> Result<Camera<Perspective>, ViewError> {
        let degrees = checked("the field of view", field_of_view_degrees, 0.01, 179.9)?;
        let [near, far] = self.depth_range()?;
        self.fixed_camera(Perspective::new(angle(degrees), near, far)?)
    }

    pub(super) fn orthographic(&self, height: f64) -> Result<Camera<Orthographic>, ViewError> {
        let height = distance("the height of the view", height)?;
        let [near, far] = self.depth_range()?;
        self.fixed_camera(Orthographic::new(height, near, far)?)
    }

    /// The fog of the fixed-point core.
    pub(super) fn core_fog(&self) -> Result<Option<shade::Fog>, ViewError> {
        let Some(fog) = self.fog else { return Ok(None) };
        match fog.law {
            reference::Fog::Linear { start, end } => {
                checked("the start of the fog", start, 0.0, 65_535.0)?;
                checked("the end of the fog", end, 0.0, 65_535.0)?;
                fog.core().map(Some).ok_or(ViewError::Fog { start, end })
            }
            reference::Fog::Exponential { density } => {
                checked("the density of the fog", density, 0.0, 255.0)?;
                Ok(fog.core())
            }
        }
    }

    /// The distance of a pixel in the reference from its depth. In a parallel projection fog sees
    /// all of them at the near plane.
    pub(super) const fn fog_distance(&self, depth: f64) -> f64 {
        match self.projection {
            Projection::Perspective { .. } => self.near / depth,
            Projection::Orthographic { .. } => self.near,
        }
    }

    fn depth_range(&self) -> Result<[Distance; 2], ViewError> {
        Ok([
            distance("the near plane's distance", self.near)?,
            distance("the far plane's distance", self.far)?,
        ])
    }

    /// Where the viewer is.
    pub(super) fn reference_viewer(&self) -> reference::Viewer {
        match self.projection {
            Projection::Perspective { .. } => reference::Viewer::At(self.reference_look().eye),
            Projection::Orthographic { .. } => {
                let [_, _, backward] = self.reference_camera().axes();
                reference::Viewer::Toward(backward)
            }
        }
    }

    pub(super) fn reference_camera(&self) -> reference::Camera {
        let [width, height] = self.size.map(f64::from);
        let (near, far) = (self.near, self.far);
        let Look { eye, target, up } = self.reference_look();
        reference::Camera {
            eye,
            target,
            up,
            projection: match self.projection {
                Projection::Perspective { field_of_view_degrees } => {
                    reference::Projection::Perspective {
                        focal_length_px: reference::Projection::focal_length_px(
                            field_of_view_degrees.to_radians(),
                            height,
                        ),
                        near,
                        far,
                    }
                }
                Projection::Orthographic { height: view_height } => {
                    reference::Projection::Orthographic {
                        pixels_per_unit: height / view_height,
                        near,
                        far,
                    }
                }
            },
            viewport: reference::Viewport { x: 0.0, y: 0.0, width, height },
        }
    }
}

pub(crate) fn checked(
    what: &'static str,
    value: f64,
    least: f64,
    most: f64,
) -> Result<f64, ViewError> {
    if value >= least && value <= most {
        Ok(value)
    } else {
        Err(ViewError::OutOfRange { what, value, least, most })
    }
}

fn distance(what: &'static str, value: f64) -> Result<Distance, ViewError> {
    // The smallest Q16.16 above 0, and its largest whole number.
    checked(what, value, 1.0 / 65_536.0, 65_535.0).map(Distance::from_num)
}
