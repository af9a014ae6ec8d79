//! The scenes of the report: a model, and how it is seen.

use std::{
    fs,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, ensure};
use host_tools::{
    check::{Look, Projection, View},
    model::{ColorFormat, Model, Options, TexelFormat, TextureOptions, emit, write_atomically},
};
use serde::{Deserialize, Serialize};

use super::choices::{self, Arithmetic, Choice, Method};
use crate::firmware;

/// A model as it is seen by all choices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Scene {
    pub(super) name: String,
    /// Not in the figures: it is a path of one machine.
    #[serde(skip)]
    pub(super) file: PathBuf,
    /// That file, its libraries and their pictures.
    #[serde(skip)]
    pub(super) inputs: Vec<PathBuf>,
    pub(super) is_textured: bool,
    /// On a display of 320 x 240.
    pub(super) focal_length_px: u32,
    /// Of the camera from the middle of the model, whose farthest vertex is 1 away.
    pub(super) distance: f64,
    /// Turned by an eighth of a turn each.
    pub(super) frames: u32,
}

/// The size of the display in pixels.
pub(super) const SIZE: [u32; 2] = [320, 240];

/// The distance of the near plane from the camera.
const NEAR: f64 = 0.1;

/// Steps of the core's coordinates in a unit of the model.
const STEPS: f64 = 65_536.0;

/// A microcontroller in QEMU has 4 MB: 1.9 MB for pictures, and on the stack up to 48 bytes for a
/// vertex and 4 for a triangle.
const MOST_VERTICES: usize = 16_384;
const MOST_TRIANGLES: usize = 32_768;

/// The models of the project that are scenes: smooth, with a texture, with flat colours.
const SHIPPED: [&str; 3] = ["torus_knot", "wooden_crate", "rocket"];

/// Those of the folder that `RASTERIZER_MODELS` names.
const FOREIGN: [&str; 2] = ["suzanne", "spot_textured"];

impl Scene {
    /// A model, seen as the bench scenes are.
    ///
    /// # Errors
    ///
    /// Returns an error if it cannot be converted, or has no faces, or too many.
    pub(super) fn of(file: &Path, frames: u32) -> Result<Self> {
        let model = Model::load(file, &options(TextureOptions::default()))?;
        let (vertices, triangles) = (model.report.vertices, model.report.triangles);
        ensure!(triangles > 0, "{} has no faces to draw", file.display());
        ensure!(
            vertices <= MOST_VERTICES && triangles <= MOST_TRIANGLES,
            "{} has {vertices} vertices and {triangles} triangles: the report's programs have \
             memory for {MOST_VERTICES} and {MOST_TRIANGLES}",
            file.display()
        );
        let name = file.file_stem().context("a model has a name")?.to_string_lossy().into_owned();
        Ok(Self {
            name,
            is_textured: model.textures.is_some(),
            file: file.to_path_buf(),
            inputs: model.inputs,
            focal_length_px: 400,
            distance: 2.4,
            frames,
        })
    }

    /// What is compared in it.
    pub(super) fn methods(&self) -> Vec<Method> {
        if self.is_textured { choices::of_texture() } else { choices::of_colors() }
    }

    /// All choices of the methods that can draw it, each once.
    pub(super) fn choices(&self) -> Vec<Choice> {
        let mut choices: Vec<Choice> = Vec::new();
        for choice in self.methods().into_iter().flat_map(|method| method.choices) {
            let is_drawn = choice.arithmetic == Arithmetic::Fixed || self.is_beyond_near();
            if is_drawn && !choices.contains(&choice) {
                choices.push(choice);
            }
        }
        choices
    }

    /// Whether all of it is beyond the near plane, however it is turned: the rasterizer in
    /// floating point clips nothing.
    fn is_beyond_near(&self) -> bool {
        self.distance - 1.0 > NEAR
    }

    /// The view of a frame in the host tools, as the bench scenes of the firmware have it.
    pub(super) fn view(&self, frame: u32) -> View {
        let turn = |steps: u32| f64::from(steps) / 512.0 * 360.0;
        let half_height = f64::from(SIZE[1]) / 2.0;
        let half_angle = (half_height / f64::from(self.focal_length_px)).atan();
        View {
            size: SIZE,
            distance: self.distance,
            projection: Projection::Perspective {
                field_of_view_degrees: 2.0 * half_angle.to_degrees(),
            },
            near: NEAR,
            far: 100.0,
            yaw_degrees: turn(64 * frame + 20),
            pitch_degrees: turn(30),
            roll_degrees: 0.0,
            background: [0; 3],
            ..View::default()
        }
    }

    /// How far the scene moves for its shifted pictures: a 64th of a pixel where the middle of the
    /// model is, to the nearest step of the core's numbers, in these steps.
    pub(super) fn shift_steps(&self) -> i32 {
        let pixel = self.distance / f64::from(self.focal_length_px);
        (pixel / 64.0 * STEPS).round() as i32
    }

    /// The view of a frame in which the scene has moved so.
    pub(super) fn shifted_view(&self, frame: u32) -> View {
        let (x, z) = (-f64::from(self.shift_steps()) / STEPS, self.distance);
        let look = Look { eye: [x, 0.0, z], target: [x, 0.0, z - 1.0], up: [0.0, 1.0, 0.0] };
        View { look: Some(look), ..self.view(frame) }
    }

    /// Where what is made of it lies: it can be removed at any time.
    ///
    /// # Errors
    ///
    /// Returns an error if the folder cannot be made.
    pub(super) fn folder(&self) -> Result<PathBuf> {
        let folder = super::folder()?.join(&self.name);
        fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        Ok(folder)
    }

    /// The model as it is converted for a firmware.
    ///
    /// # Errors
    ///
    /// Returns an error if it cannot be converted.
    pub(super) fn model(&self) -> Result<Model> {
        Ok(Model::load(&self.file, &options(TextureOptions::default()))?)
    }

    /// The model whose pictures are true: its textures are as large as their files, up to 1,024.
    ///
    /// # Errors
    ///
    /// Returns an error if it cannot be converted.
    pub(super) fn true_model(&self) -> Result<Model> {
        let texture = TextureOptions {
            size: Some([1024, 1024]),
            format: TexelFormat::Direct,
            color: ColorFormat::Rgb888,
            ..TextureOptions::default()
        };
        Ok(Model::load(&self.file, &options(texture))?)
    }
}

/// The files of the scenes that come with the project.
pub(super) fn shipped() -> Vec<PathBuf> {
    in_folder(&firmware::root().join("host-tools/models"), &SHIPPED)
}

/// The files of the scenes that do not.
pub(super) fn foreign(folder: &Path) -> Vec<PathBuf> {
    in_folder(folder, &FOREIGN)
}

fn in_folder(folder: &Path, names: &[&str]) -> Vec<PathBuf> {
    names.iter().map(|name| folder.join(name).with_extension("obj")).collect()
}

/// Those of `convert`, apart from the textures and the name.
fn options(textures: TextureOptions) -> Options {
    Options { textures: Some(textures), name: Some("model".into()), ..Options::default() }
}

/// The tables of a model in a file of Rust.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tables {
    has_mip_levels: bool,
    pub(super) path: PathBuf,
}

impl Tables {
    /// Writes the tables that some choices need into a folder.
    ///
    /// # Errors
    ///
    /// Returns an error if the model cannot be converted, or a file not be written.
    pub(super) fn write(scene: &Scene, choices: &[Choice], folder: &Path) -> Result<Vec<Self>> {
        let mut tables = Vec::new();
        for has_mip_levels in [false, true] {
            let path = folder.join(name(has_mip_levels)).with_extension("rs");
            let written = Self { has_mip_levels, path };
            if !choices.iter().any(|choice| written.are_of(choice)) {
                continue;
            }
            let texture = TextureOptions {
                format: TexelFormat::Direct,
                color: ColorFormat::Rgb565Be,
                mipmaps: has_mip_levels,
                ..TextureOptions::default()
            };
            let model = Model::load(&scene.file, &options(texture))?;
            let text = emit::source(&model);
            // An unchanged file is not written, so that the compiler need not run again.
            if fs::read(&written.path).ok().as_deref() != Some(text.as_bytes()) {
                write_atomically(&written.path, text)?;
            }
            tables.push(written);
        }
        Ok(tables)
    }

    pub(super) const fn module(&self) -> &'static str {
        name(self.has_mip_levels)
    }

    /// Whether a choice reads them.
    pub(super) fn are_of(&self, choice: &Choice) -> bool {
        choice.has_mip_levels() == self.has_mip_levels
    }

    /// The module with the tables of a choice.
    pub(super) fn module_of(choice: &Choice) -> &'static str {
        name(choice.has_mip_levels())
    }
}

const fn name(has_mip_levels: bool) -> &'static str {
    if has_mip_levels { "tables_with_mip_levels" } else { "tables" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_needs_clipping_is_not_drawn_in_floating_point() {
        let file = firmware::root().join("host-tools/models/wooden_crate.obj");
        let seen_from = |distance| Scene { distance, ..Scene::of(&file, 1).unwrap() };
        let floats = |scene: Scene| {
            let choices = scene.choices();
            choices.iter().filter(|choice| choice.arithmetic == Arithmetic::Float).count()
        };
        assert_eq!(
            [2.4, 1.11, 1.09, 0.8].map(|distance| floats(seen_from(distance))),
            [2, 2, 0, 0]
        );
    }

    #[test]
    fn a_shift_is_a_64th_of_a_pixel_to_the_nearest_step() {
        let file = firmware::root().join("host-tools/models/torus_knot.obj");
        let scene = Scene::of(&file, 1).unwrap();
        // 2.4 / 400 of a unit are a pixel, 393.2 steps.
        assert_eq!(scene.shift_steps(), 6);
        let Look { eye, target, .. } = scene.shifted_view(0).look.unwrap();
        assert_eq!(eye, [-6.0 / STEPS, 0.0, 2.4]);
        assert_eq!([eye[0], eye[1]], [target[0], target[1]]);
    }
}
