//! Where the colours of pixels come from.

use core::{array, iter};

use embedded_graphics_core::pixelcolor::Rgb565;
use rasterizer::{mesh::Material, output::Rgb565Be};

/// What colours the pixels of a material. It takes `N` values, which are linear on the screen over
/// a triangle: the first is nearness.
pub(super) trait Paint<const N: usize> {
    /// The type of a colour.
    type Color;

    /// The values of a vertex, from its level of light and its texture coordinates.
    fn vertex(nearness: f32, level: f32, coordinates: [f32; 2]) -> [f32; N];

    /// Returns the pieces of a span, each with its number of pixels: as one piece, unless what
    /// [`color`](Self::color) takes is linear in shorter ones.
    fn pieces(run: Run<N>, pixels: usize) -> impl Iterator<Item = (usize, Run<N>)> {
        iter::once((pixels, run))
    }

    /// The colour of a pixel; `None` where nothing is drawn.
    fn color(&self, values: [f32; N]) -> Option<Self::Color>;
}

/// Values at a pixel, and how they change to the next one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run<const N: usize> {
    pub(super) values: [f32; N],
    pub(super) steps: [f32; N],
}

impl<const N: usize> Run<N> {
    /// Goes on by some pixels.
    pub(super) fn advance(&mut self, pixels: f32) {
        for (value, step) in self.values.iter_mut().zip(self.steps) {
            *value += step * pixels;
        }
    }
}

/// A material's colour, multiplied by the level of light at each pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Computed {
    /// Its channels in steps of RGB565.
    brightest: [f32; 3],
}

impl Computed {
    pub(super) fn of(material: &Material) -> Self {
        let [red, green, blue] = material.color.map(|channel| f32::from(channel) / 255.0);
        Self { brightest: [red * 31.0, green * 63.0, blue * 31.0] }
    }

    /// Its colour in light from 0 to 1, to the nearest.
    pub(super) fn at(&self, level: f32) -> Rgb565Be {
        let [r, g, b] = self.brightest.map(|channel| (channel * level + 0.5) as i32 as u8);
        Rgb565Be::from(Rgb565::new(r, g, b))
    }
}

impl Paint<2> for Computed {
    type Color = Rgb565Be;

    fn vertex(nearness: f32, level: f32, _: [f32; 2]) -> [f32; 2] {
        [nearness, level]
    }

    fn color(&self, [_, level]: [f32; 2]) -> Option<Rgb565Be> {
        Some(self.at(level))
    }
}

/// A material's colour in some levels of light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ramp<const LEVELS: usize>([Rgb565Be; LEVELS]);

impl<const LEVELS: usize> Ramp<LEVELS> {
    const MOST: f32 = (LEVELS - 1) as f32;

    pub(super) fn of(material: &Material) -> Self {
        let color = Computed::of(material);
        Self(array::from_fn(|level| color.at(level as f32 / Self::MOST)))
    }
}

impl<const LEVELS: usize> Paint<2> for Ramp<LEVELS> {
    type Color = Rgb565Be;

    fn vertex(nearness: f32, level: f32, coordinates: [f32; 2]) -> [f32; 2] {
        Computed::vertex(nearness, level, coordinates)
    }

    fn color(&self, [_, level]: [f32; 2]) -> Option<Rgb565Be> {
        Some(self.0[(level * Self::MOST + 0.5) as usize % LEVELS])
    }
}
