//! The options of the view, one file for each group of them.

mod blending;
mod camera;
mod display;
mod fog;
mod form;
mod lights;
mod names;
mod planes;
mod settings;
mod surface;
#[cfg(test)]
mod tests;

use clap::Args;
use host_tools::{
    check::{Shading, View},
    model::{Fit, Options},
};

use self::{
    blending::BlendingOptions, camera::CameraOptions, display::DisplayOptions, fog::FogOptions,
    form::FormOptions, lights::LightOptions, planes::PlaneOptions, surface::SurfaceOptions,
};
pub(super) use self::{
    display::{MAX_SIZE, size},
    names::{choice, numbers, within},
    settings::Settings,
};
use super::{reduction::Reduction, smoothing::Smoothing, textures::TextureArguments};

/// The view: from a point on the z axis toward the origin, about which the model is turned, or from
/// any point to any other.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "View")]
pub(super) struct ViewOptions {
    #[command(flatten)]
    display: DisplayOptions,
    #[command(flatten)]
    surface: SurfaceOptions,
    #[command(flatten)]
    blending: BlendingOptions,
    #[command(flatten)]
    fog: FogOptions,
    #[command(flatten)]
    camera: CameraOptions,
    #[command(flatten)]
    form: FormOptions,
    #[command(flatten)]
    planes: PlaneOptions,
    #[command(flatten)]
    lights: LightOptions,
    #[command(flatten)]
    smoothing: Smoothing,
    #[command(flatten)]
    reduction: Reduction,
    /// Turn over faces that run against their neighbours, and closed parts that are inside out
    #[arg(long)]
    fix_winding: bool,
    /// Keep the units of the file, instead of fitting the model into a sphere of radius 1 about the
    /// origin: --eye and --distance are in them
    #[arg(long)]
    keep_units: bool,
    /// Frames of a full turn about y, 1 to 360 [default: 1, of a GIF file 36]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=360))]
    pub(super) frames: Option<u32>,
    #[command(flatten)]
    textures: TextureArguments,
}

impl ViewOptions {
    /// The view of frame 0, in the shading `otherwise` unless one is chosen.
    pub(super) fn view(&self, otherwise: Shading) -> View {
        let view = self.display.over(View::default());
        let view = self.surface.over(view, otherwise);
        let view = self.blending.over(view);
        let view = self.form.over(self.planes.over(self.fog.over(view)));
        self.lights.over(self.camera.over(view))
    }

    /// Refuses more lights and planes than a view has, and forms that the models do not have.
    pub(super) fn check(&self, files: usize, frames: u32) -> anyhow::Result<()> {
        self.lights.check()?;
        self.form.check(files, frames)?;
        self.planes.check()
    }

    /// The conversion of the model for it.
    pub(super) fn conversion(&self) -> Options {
        let mut textures = self.textures.options();
        if let Some(textures) = &mut textures {
            textures.mipmaps |= self.surface.filter.reads_levels();
        }
        Options {
            fit: if self.keep_units { Fit::Keep } else { Fit::Unit },
            fix_winding: self.fix_winding,
            simplify: self.reduction.simplify,
            textures,
            ..self.smoothing.options()
        }
    }
}
