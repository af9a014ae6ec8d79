//! A view as the programs report it.

use host_tools::{
    check::{
        Blending, Colors, Correction, DepthFormat, FadeAlong, Filter, FogBy, Form, Lamp,
        PlaneSpace, Projection, Shading, Sun, View,
    },
    model::Model,
    reference::{Blend, HalfSpace},
};
use serde::Serialize;

use super::{fog::law, names::name};

/// A view in the names and units of the command line.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli) struct Settings {
    size: [u32; 2],
    subpixel: u32,
    depth: &'static str,
    shading: &'static str,
    perspective: &'static str,
    filter: &'static str,
    lights: Vec<[f64; 4]>,
    lamps: Vec<[f64; 4]>,
    ambient: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    colors: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    dither: Option<u32>,
    blend: &'static str,
    opacity: f64,
    fade: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    fog: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fog_by: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    matrix: Option<[[f64; 3]; 3]>,
    /// The way between two shapes: how far it is, and how far in the middle of a turn.
    #[serde(skip_serializing_if = "Option::is_none")]
    between: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    clip: Vec<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    clip_in: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    eye: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    up: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fov: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    height: Option<f64>,
    near: f64,
    far: f64,
    yaw: f64,
    pitch: f64,
    roll: f64,
    crease: f64,
}

impl Settings {
    pub(in crate::cli) fn of(model: &Model, view: &View) -> Self {
        let (fov, height) = match view.projection {
            Projection::Perspective { field_of_view_degrees } => {
                (Some(field_of_view_degrees), None)
            }
            Projection::Orthographic { height } => (None, Some(height)),
        };
        let clip: Vec<_> = (view.planes.sides.iter().flatten())
            .map(|&HalfSpace { normal: [x, y, z], offset }| [x, y, z, offset])
            .collect();
        Self {
            size: view.size,
            subpixel: view.subpixel.bits(),
            depth: name(&DepthFormat::NAMES, view.depth),
            shading: name(&Shading::NAMES, view.shading),
            perspective: name(&Correction::NAMES, view.perspective),
            filter: name(&Filter::NAMES, view.filter),
            colors: view.display.map(|display| name(&Colors::NAMES, display.colors)),
            dither: view.display.and_then(|display| display.dither.rows()),
            lights: (view.lights.suns.iter().flatten())
                .map(|&Sun { toward: [x, y, z], level }| [x, y, z, level])
                .collect(),
            lamps: (view.lights.lamps.iter().flatten())
                .map(|&Lamp { position: [x, y, z], half }| [x, y, z, half])
                .collect(),
            ambient: view.lights.ambient,
            blend: name(&Blending::NAMES, view.blending),
            opacity: view.opacity,
            fade: name(&FadeAlong::NAMES, view.fade),
            fog: view.fog.map(|fog| law(fog.law)),
            fog_by: view.fog.map(|fog| name(&FogBy::NAMES, fog.by)),
            matrix: match view.form {
                Form::Shaped(map) => Some(map.rows),
                Form::AsModelled | Form::Between { .. } => None,
            },
            between: match view.form {
                Form::Between { progress, halfway } => Some([progress, halfway]),
                Form::AsModelled | Form::Shaped(_) => None,
            },
            clip_in: (!clip.is_empty()).then(|| name(&PlaneSpace::NAMES, view.planes.space)),
            clip,
            distance: view.look.is_none().then_some(view.distance),
            eye: view.look.map(|look| look.eye),
            target: view.look.map(|look| look.target),
            up: view.look.map(|look| look.up),
            fov,
            height,
            near: view.near,
            far: view.far,
            yaw: view.yaw_degrees,
            pitch: view.pitch_degrees,
            roll: view.roll_degrees,
            crease: model.options.crease_degrees,
        }
    }

    /// The settings in a line.
    pub(in crate::cli) fn summary(&self) -> String {
        let [width, height] = self.size;
        let textures = if self.shading.starts_with("textured") {
            format!(", {} filter, {} perspective", self.filter, self.perspective)
        } else {
            String::new()
        };
        let blend = if self.blend == name(&Blending::NAMES, Blending::Replace) {
            String::new()
        } else if self.blend == name(&Blending::NAMES, Blending::By(Blend::Replace)) {
            ", from back to front without a depth buffer".to_owned()
        } else {
            let fade = if self.fade == name(&FadeAlong::NAMES, FadeAlong::None) {
                String::new()
            } else {
                format!(", fading along {}", self.fade)
            };
            format!(", blended by {} at {} of its opacity{fade}", self.blend, self.opacity)
        };
        let fog = match (&self.fog, self.fog_by) {
            (Some(fog), Some(by)) => format!(", fog {fog} by {by}"),
            _ => String::new(),
        };
        let form = match (self.matrix, self.between) {
            (Some(_), _) => ", shaped by a matrix".to_owned(),
            (_, Some([from, to])) if from == to => format!(", at {from} between two shapes"),
            (_, Some([from, to])) => format!(", from {from} to {to} between two shapes and back"),
            _ => String::new(),
        };
        let planes = match (self.clip.len(), self.clip_in) {
            (count, Some(space)) => format!(", clip planes: {count} of the {space}"),
            _ => String::new(),
        };
        let dither =
            self.dither.map_or_else(String::new, |rows| format!(" dithered {rows}x{rows}"));
        let colors =
            self.colors.map_or_else(String::new, |name| format!(", {name} colours{dither}"));
        format!(
            "{width}x{height} pixels, {} sub-pixel bits, {} depth, {} shading{textures}{form}{fog}{blend}{planes}{colors}",
            self.subpixel, self.depth, self.shading
        )
    }
}
