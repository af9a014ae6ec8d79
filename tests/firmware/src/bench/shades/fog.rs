//! The scenes of fog, vertex colours and matcap. The camera is 2.4 units from bodies of radius 1 to
//! 1.7, so that fog begins before them and ends within.

use rasterizer::{
    attribute::NoDepth,
    camera::Distance,
    fixed::types::I8F24,
    output::Rgb565Be,
    shade::{
        AtVertices, Colored, ColoredGouraud, Flat, Fog, Fogged, Gouraud, Matcap, Shader, Textured,
    },
    texture::Offset,
};

use super::Scenes;
use crate::{bench::sun, models};

static FOG: Fog = Fog::linear(Distance::lit("1"), Distance::lit("4")).unwrap();
const MIST: Rgb565Be = Rgb565Be::new(20, 44, 24);

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    /// All of them.
    pub(super) fn fog(&mut self) {
        use models::{COLORED_SPHERE, CUBE_TEXTURE_TEXTURES as SIDES, SPHERE};
        self.fog_over(["sphere-gouraud-fog", "sphere-gouraud-fog-vertex"], Gouraud::new(sun()));
        self.cube_in_fog();
        self.scene::<u16, _>("sphere-vertex-colors", &COLORED_SPHERE, Colored::new());
        let lit = ColoredGouraud::new(sun());
        self.scene::<u16, _>("sphere-vertex-colors-gouraud", &COLORED_SPHERE, lit);
        self.scene::<u16, _>("sphere-matcap", &SPHERE, Matcap::new(&SIDES));
    }

    fn fog_over<Sh: Shader<Color = Rgb565Be, Outcome = Rgb565Be>>(
        &mut self,
        [by_pixel, by_vertex]: [&str; 2],
        shader: Sh,
    ) {
        let fogged = Fogged::new(shader, &FOG, MIST);
        self.scene::<u16, _>(by_pixel, &models::SPHERE, fogged.clone());
        self.scene::<u16, _>(by_vertex, &models::SPHERE, fogged.computed(AtVertices));
    }

    /// Large triangles: over a texture, with an offset of its coordinates, and over flat sides.
    fn cube_in_fog(&mut self) {
        use models::{CUBE, CUBE_TEXTURE, CUBE_TEXTURE_TEXTURES as SIDES};
        let textured = Fogged::new(Textured::new(&SIDES), &FOG, MIST);
        self.scene::<u16, _>("cube-texture-fog", &CUBE_TEXTURE, textured);
        self.scene::<u16, _>(
            "cube-texture-fog-vertex",
            &CUBE_TEXTURE,
            textured.computed(AtVertices),
        );
        let [side] = SIDES;
        let moved = [Offset::new(side, [I8F24::lit("0.25"); 2])];
        self.scene::<u16, _>("cube-texture-offset", &CUBE_TEXTURE, Textured::new(&moved));
        let flat = Fogged::new(Flat::new(sun()), &FOG, MIST);
        self.scene::<NoDepth, _>("cube-flat-fog", &CUBE, flat);
        self.scene::<NoDepth, _>("cube-flat-fog-vertex", &CUBE, flat.computed(AtVertices));
    }
}
