//! The scenes with textures: a wooden crate, whose picture has 128 x 128 texels of 8 bits. All but
//! the first differ from [`TexturedDepth`] in one choice.

use embedded_graphics_core::pixelcolor::Rgb565;
use rasterizer::{
    attribute::NoDepth,
    geometry::ClipNone,
    numbers::S4,
    scene::Object,
    shade::{self, OnScreen, Shader, Textured},
    texture::{Bilinear, PerTriangle, Trilinear},
};

use super::{
    LIGHT, NARROW, PERSPECTIVE, PICTURE, camera,
    frames::{Bands, for_each_view},
};
use crate::models::{
    WOODEN_CRATE as CRATE, WOODEN_CRATE_MIPS_TEXTURES as MIPS, WOODEN_CRATE_TEXTURES as TEXTURES,
    WoodenCrateMipsTexture, WoodenCrateTexture,
};
use crate::sizes::{Display, Scene};

/// The crate's vertices and a band for them, with depth.
type WithDepth<Sh> = Bands<S4, u16, OnScreen<Sh>, NARROW, { CRATE.vertex_count() }>;

/// The crate in bands.
fn textured<Sh: Shader<Color = Rgb565>>(
    shader: Sh,
    memory: &mut WithDepth<Sh>,
    display: &mut Display,
) -> Option<()> {
    for_each_view(|view| {
        let object = Object::new(&CRATE, shader.clone()).posed(view.pose());
        memory.draw(&object, &camera(view, PERSPECTIVE, PICTURE)?, display)
    })
}

/// The nearest texels without depth, straight onto the display. The crate is a small display's only
/// object, which its author keeps before the camera: nothing is clipped.
#[derive(Clone, Copy, Debug)]
pub struct TexturedDirect;

impl Scene for TexturedDirect {
    type Memory = Bands<
        S4,
        NoDepth,
        OnScreen<Textured<'static, WoodenCrateTexture>>,
        0,
        { CRATE.vertex_count() },
    >;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        let shader = Textured::new(&TEXTURES);
        for_each_view(|view| {
            let object = Object::new(&CRATE, shader).posed(view.pose()).clipped(ClipNone);
            memory.draw_directly(&object, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// The nearest texels with depth, in bands.
#[derive(Clone, Copy, Debug)]
pub struct TexturedDepth;

impl Scene for TexturedDepth {
    type Memory = WithDepth<Textured<'static, WoodenCrateTexture>>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        textured(Textured::new(&TEXTURES), memory, display)
    }
}

/// The same with the mean of four texels.
#[derive(Clone, Copy, Debug)]
pub struct TexturedBilinear;

impl Scene for TexturedBilinear {
    type Memory = WithDepth<Textured<'static, WoodenCrateTexture, Bilinear>>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        textured(Textured::new(&TEXTURES).filtered(Bilinear), memory, display)
    }
}

/// The same with the mean of two mip levels.
#[derive(Clone, Copy, Debug)]
pub struct TexturedTrilinear;

impl Scene for TexturedTrilinear {
    type Memory = WithDepth<Textured<'static, WoodenCrateMipsTexture, Trilinear>>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        let shader = Textured::new(&MIPS).filtered(Trilinear(PerTriangle));
        textured(shader, memory, display)
    }
}

/// The nearest texels with light at the vertices.
#[derive(Clone, Copy, Debug)]
pub struct TexturedGouraud;

impl Scene for TexturedGouraud {
    type Memory = WithDepth<shade::TexturedGouraud<'static, WoodenCrateTexture>>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        textured(shade::TexturedGouraud::new(&TEXTURES, LIGHT), memory, display)
    }
}
