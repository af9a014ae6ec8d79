//! The bench scenes with textures: the cube and the spotted cow in the ways to correct perspective,
//! to store, to filter and to light texels.

use rasterizer::{
    attribute::{Adaptive, Affine, Correction, Every, EveryPixel, NoDepth},
    camera::Camera,
    mesh::Mesh,
    output::Rgb565Be,
    scene::Object,
    shade::{Shader, Textured, TexturedFlat, TexturedGouraud},
    texture::{Bilinear, PerPixel, PerTriangle, Shaded, Texture, Trilinear},
};

use super::{Bench, MEMORY, MODES, PIXELS, SUITED, Suited, sun, view};
use crate::{console, cost::Depth, counter, models};

/// The largest model's vertices: the cow has more of them along the seams of its texture.
const VERTICES: usize = if cfg!(models) { 3300 } else { 24 };

/// The texture of the cube with a palette for each level of light.
type ShadedSides = Texture<
    Shaded<'static, Rgb565Be, 8, { models::SHADED_TEXELS.len() }, { models::SHADES[0].len() }>,
    128,
    128,
>;
static SHADED_SIDES: [ShadedSides; 1] =
    [Texture::new(Shaded::new(&models::SHADED_TEXELS, &models::SHADES))];

/// The program: starts the counter, says how it was compiled, and measures whole frames.
///
/// Its parameter has it compiled for its own program only, not for all that share this crate.
pub fn main<const SET_UP: bool>() {
    counter::start();
    console::build();
    Bench::within(&MEMORY, |bench| {
        let mut scenes = Scenes::<SET_UP> { bench, camera: view("400", "2.4") };
        scenes.cube_in_perspective();
        scenes.cube();
        #[cfg(models)]
        scenes.spot();
    });
}

struct Scenes<'a, const SET_UP: bool> {
    bench: Bench<'a, SET_UP, PIXELS, VERTICES>,
    camera: Camera,
}

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    /// The modes of correction, with depth and without.
    fn cube_in_perspective(&mut self) {
        self.cube_corrected(["cube-texture", "cube-texture-no-depth"], Adaptive::<8>);
        self.cube_corrected(
            ["cube-texture-every-pixel", "cube-texture-every-pixel-no-depth"],
            EveryPixel,
        );
        self.cube_corrected(["cube-texture-every-8", "cube-texture-every-8-no-depth"], Every::<8>);
        self.cube_corrected(
            ["cube-texture-every-16", "cube-texture-every-16-no-depth"],
            Every::<16>,
        );
        self.cube_corrected(
            ["cube-texture-every-32", "cube-texture-every-32-no-depth"],
            Every::<32>,
        );
        self.cube_corrected(["cube-texture-affine", "cube-texture-affine-no-depth"], Affine);
    }

    fn cube_corrected<M: Correction>(&mut self, [with, without]: [&str; 2], mode: M) {
        let shader = Textured::new(&models::CUBE_TEXTURE_TEXTURES).corrected(mode);
        self.scene::<u16, _>(with, &models::CUBE_TEXTURE, shader);
        self.scene::<NoDepth, _>(without, &models::CUBE_TEXTURE, shader);
    }

    /// Formats, filters and light, with depth, corrected within half a texel.
    fn cube(&mut self) {
        use models::{CUBE_TEXTURE_MIPS_TEXTURES as MIPS, CUBE_TEXTURE_TEXTURES as DIRECT};
        let indexed8 = Textured::new(&models::CUBE_TEXTURE_8_TEXTURES);
        let indexed4 = Textured::new(&models::CUBE_TEXTURE_4_TEXTURES);
        let (direct, mips) = (Textured::new(&DIRECT), Textured::new(&MIPS));
        self.cube_with("cube-texture-indexed8", indexed8);
        self.cube_with("cube-texture-indexed4", indexed4);
        self.cube_with("cube-texture-bilinear", direct.filtered(Bilinear));
        self.cube_with("cube-texture-trilinear", mips.filtered(Trilinear(PerTriangle)));
        self.cube_with("cube-texture-trilinear-pixel", mips.filtered(Trilinear(PerPixel)));
        self.cube_with("cube-texture-flat", TexturedFlat::new(&DIRECT, sun()));
        self.cube_with("cube-texture-flat-shaded", TexturedFlat::new(&SHADED_SIDES, sun()));
        self.cube_with("cube-texture-gouraud", TexturedGouraud::new(&DIRECT, sun()));
        self.cube_with("cube-texture-gouraud-shaded", TexturedGouraud::new(&SHADED_SIDES, sun()));
    }

    fn cube_with<Sh: Shader<Color = Rgb565Be>>(&mut self, name: &str, shader: Sh) {
        self.scene::<u16, _>(name, &models::CUBE_TEXTURE, shader);
    }

    #[cfg(models)]
    fn spot(&mut self) {
        use models::{SPOT_TEXTURE as SPOT, SPOT_TEXTURE_TEXTURES as DIRECT};
        let direct = Textured::new(&DIRECT);
        let indexed8 = Textured::new(&models::SPOT_TEXTURE_8_TEXTURES);
        self.scene::<u16, _>("spot-texture", &SPOT, direct);
        self.scene::<u16, _>("spot-texture-indexed8", &SPOT, indexed8);
        self.scene::<u16, _>("spot-texture-bilinear", &SPOT, direct.filtered(Bilinear));
        self.scene::<u16, _>("spot-texture-gouraud", &SPOT, TexturedGouraud::new(&DIRECT, sun()));
    }

    /// The whole frame.
    fn scene<D: Depth, Sh: Shader<Color = Rgb565Be>>(
        &mut self,
        name: &str,
        mesh: &Mesh<'_>,
        shader: Sh,
    ) {
        let object = Object::new(mesh, shader);
        self.bench.scene_in::<Suited, D, _>([name, SUITED], MODES[0], &object, &self.camera);
    }
}
