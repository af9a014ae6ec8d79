//! The bench scenes of lights and highlights.

use rasterizer::{
    attribute::Affine,
    numbers::Vec3,
    shade::{GlossyGouraud, Gouraud, Level, Light, Phong, TexturedFlat, TexturedGouraud},
};

use super::{Scenes, sun};
use crate::{models, shiny, stage::LAMP};

/// A light from the other side.
const FILL: Light = Light::new(Vec3::lit("2", "-1", "1"), Level::ZERO, Level::lit("0.4"));

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    /// By vertex, by pixel, and light times texture.
    pub(super) fn light(&mut self) {
        let (sun, suns, near) = (sun(), [sun(), FILL], (sun(), LAMP));
        self.scene::<u16, _>("sphere-gouraud-2-lights", &models::SPHERE, Gouraud::new(suns));
        self.scene::<u16, _>("sphere-gouraud-lamp", &models::SPHERE, Gouraud::new(near));
        self.scene::<u16, _>("sphere-glossy-gouraud", &shiny::SPHERE, GlossyGouraud::new(sun));
        let phong = Phong::new(sun);
        self.scene::<u16, _>("sphere-phong-matte", &models::SPHERE, phong);
        self.scene::<u16, _>("sphere-phong", &shiny::SPHERE, phong);
        self.scene::<u16, _>("sphere-phong-affine", &shiny::SPHERE, phong.corrected(Affine));
        self.scene::<u16, _>("sphere-phong-2-lights", &shiny::SPHERE, Phong::new(suns));
        self.scene::<u16, _>("sphere-phong-near-viewer", &shiny::SPHERE, phong.with_near_viewer());
        self.scene::<u16, _>("sphere-phong-lamp", &shiny::SPHERE, Phong::new(near));
        let textures = &models::CUBE_TEXTURE_8_TEXTURES;
        let (flat, gouraud) =
            (TexturedFlat::new(textures, suns), TexturedGouraud::new(textures, suns));
        self.scene::<u16, _>("cube-textured-flat-2-lights", &models::CUBE_TEXTURE, flat);
        self.scene::<u16, _>("cube-textured-gouraud-2-lights", &models::CUBE_TEXTURE, gouraud);
        let (flat, gouraud) =
            (TexturedFlat::new(textures, near), TexturedGouraud::new(textures, near));
        self.scene::<u16, _>("cube-textured-flat-lamp", &models::CUBE_TEXTURE, flat);
        self.scene::<u16, _>("cube-textured-gouraud-lamp", &models::CUBE_TEXTURE, gouraud);
    }
}
