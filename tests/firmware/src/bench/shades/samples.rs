//! The sphere in bands with one or several samples a pixel, sent to a display.

use core::convert::Infallible;

use embedded_graphics_core::{
    Pixel, draw_target::DrawTarget, geometry::Dimensions, primitives::Rectangle,
};
use rasterizer::{
    camera::{Camera, Distance},
    numbers::Vec3,
    output::{Bands, Rgb565Be, Supersampled},
    scene::Object,
    shade::Gouraud,
};

use super::Scenes;
use crate::{
    bench::{AREA, SIZE, SUITED, Suited, sun, view_on},
    cost::fail,
    models,
};

/// The display's rows in a band.
const ROWS: u32 = 8;

/// A camera that sees the same as the others on a display of another size.
fn camera(viewport: Rectangle) -> Camera {
    let focal_length = Distance::from_num(400 * viewport.size.width / SIZE.width);
    view_on(viewport, focal_length, Vec3::lit("0", "0", "2.4"))
}

/// A display that counts the pixels that are no background.
struct Display {
    drawn: u64,
}

impl Dimensions for Display {
    fn bounding_box(&self) -> Rectangle {
        AREA
    }
}

impl DrawTarget for Display {
    type Color = Rgb565Be;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565Be>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        self.fill_contiguous(&AREA, pixels.into_iter().map(|Pixel(_, color)| color))
    }

    #[inline(always)]
    fn fill_contiguous<I: IntoIterator<Item = Rgb565Be>>(
        &mut self,
        _: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let drawn = colors.into_iter().filter(|&color| color != Rgb565Be::BLACK);
        self.drawn += drawn.count() as u64;
        Ok(())
    }
}

/// A scene of bands of `$side` by `$side` samples a pixel.
macro_rules! scene {
    ($scenes:ident, $name:literal, $side:literal, $area:expr, $bands:expr) => {
        let sphere = Object::new(&models::SPHERE, Gouraud::new(sun()));
        let mode = [$name, SUITED, "bands of 8"];
        $scenes.bench.measure::<Suited, u16, _, _>(
            mode,
            &sphere,
            |cost, object, vertices, words, memory| {
                const SAMPLES: usize = (ROWS * SIZE.width * $side * $side) as usize;
                let color = &mut memory.color[..SAMPLES];
                let depth = &mut memory.depth[..SAMPLES];
                cost.add_sent(object, &camera($area), vertices, |seen| {
                    let seen = seen.binned(ROWS * $side, words).unwrap_or_else(fail);
                    let mut display = Display { drawn: 0 };
                    let mut bands = $bands(AREA, color, depth).unwrap_or_else(fail);
                    let Ok(()) = bands.show(
                        &mut display,
                        |band| band.clear_color(Rgb565Be::BLACK),
                        |band| seen.draw(band),
                    );
                    display.drawn
                });
            },
        );
    };
}

impl<const SET_UP: bool> Scenes<'_, SET_UP> {
    pub(super) fn samples(&mut self) {
        scene!(self, "sphere-sent", 1, AREA, Bands::new);
        scene!(self, "sphere-2x2", 2, Supersampled::<2>::area(AREA), Bands::supersampled::<2>);
        scene!(self, "sphere-4x4", 4, Supersampled::<4>::area(AREA), Bands::supersampled::<4>);
    }
}
