//! The bench scenes of colour types: frames of other colours than RGB565, packed ones, and
//! dithering to each.

use embedded_graphics_core::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb888};
use rasterizer::{
    color::Rgb332,
    scene::Object,
    shade::{Dithered, Gouraud, Shader},
};

use super::{SUITED, Scenes, Suited, sun};
use crate::{
    cost::{InMemory, OfBytes, OfPages, OfRows},
    models,
};

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    /// A lit sphere in each format, by its own colours and dithered from those of eight bits.
    pub(super) fn colors(&mut self) {
        let (color, gray) = (Gouraud::<Rgb888>::new(sun()), Gouraud::<Gray8>::new(sun()));
        self.scene::<u16, _>("sphere-gouraud-565-dither", &models::SPHERE, Dithered::new(color));
        self.sphere::<OfBytes, _>("sphere-gouraud-332", Gouraud::<Rgb332>::new(sun()));
        self.sphere::<OfBytes, _>("sphere-gouraud-332-dither", Dithered::new(color));
        self.sphere::<OfRows<Gray4>, _>("sphere-gouraud-gray4", Gouraud::new(sun()));
        self.sphere::<OfRows<Gray4>, _>("sphere-gouraud-gray4-dither", Dithered::new(gray));
        self.sphere::<OfRows<Gray2>, _>("sphere-gouraud-gray2", Gouraud::new(sun()));
        self.sphere::<OfRows<Gray2>, _>("sphere-gouraud-gray2-dither", Dithered::new(gray));
        self.sphere::<OfRows<BinaryColor>, _>("sphere-gouraud-binary", Gouraud::new(sun()));
        self.sphere::<OfRows<BinaryColor>, _>("sphere-gouraud-binary-dither", Dithered::new(gray));
        self.sphere::<OfPages, _>("sphere-gouraud-binary-pages", Gouraud::new(sun()));
        self.sphere::<OfPages, _>("sphere-gouraud-binary-pages-dither", Dithered::new(gray));
    }

    /// The sphere in a frame of other colours.
    fn sphere<F: InMemory, Sh: Shader<Color = F::Color>>(&mut self, name: &str, shader: Sh) {
        let object = Object::new(&models::SPHERE, shader);
        let camera = &self.camera;
        self.bench.measure::<Suited, u16, _, _>(
            [name, SUITED, "whole"],
            &object,
            |cost, object, vertices, _, memory| {
                cost.add_frame::<F, _, _, _>(object, camera, vertices, memory);
            },
        );
    }
}
