//! The scenes with fog, vertex colours and a matcap. The first two differ from [`super`]'
//! `GouraudS4` in their fog, and in their model, a sphere.

use embedded_graphics_core::pixelcolor::Rgb565;
use rasterizer::{
    camera::Distance,
    mesh::Mesh,
    numbers::S4,
    scene::Object,
    shade::{self, AtVertices, ColoredGouraud, Fog, Fogged, Gouraud, OnScreen, Shader},
};

use super::{
    LIGHT, NARROW, PERSPECTIVE, PICTURE, camera,
    frames::{Bands, for_each_view},
};
use crate::models::{COLORED_SPHERE, SPHERE, WOODEN_CRATE_TEXTURES, WoodenCrateTexture};
use crate::sizes::{Display, Scene};

static FOG: Fog = Fog::linear(Distance::lit("1"), Distance::lit("5")).unwrap();
const MIST: Rgb565 = Rgb565::new(20, 44, 24);

/// The model's vertices and a band for them, with depth.
type WithDepth<Sh, const VERTICES: usize> = Bands<S4, u16, OnScreen<Sh>, NARROW, VERTICES>;

/// A model in bands.
fn drawn<Sh: Shader<Color = Rgb565>, const VERTICES: usize>(
    mesh: &Mesh<'_>,
    shader: Sh,
    memory: &mut WithDepth<Sh, VERTICES>,
    display: &mut Display,
) -> Option<()> {
    for_each_view(|view| {
        let object = Object::new(mesh, shader.clone()).posed(view.pose());
        memory.draw(&object, &camera(view, PERSPECTIVE, PICTURE)?, display)
    })
}

type Pixels = Fogged<'static, Gouraud<Rgb565>>;
type Vertices = Fogged<'static, Gouraud<Rgb565>, AtVertices>;
type Crate = shade::Matcap<'static, WoodenCrateTexture>;

/// Fog at the pixels over light at the vertices.
#[derive(Clone, Copy, Debug)]
pub struct FogPixels;

impl Scene for FogPixels {
    type Memory = WithDepth<Pixels, { SPHERE.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        drawn(&SPHERE, Fogged::new(Gouraud::new(LIGHT), &FOG, MIST), memory, display)
    }
}

/// Fog at the vertices.
#[derive(Clone, Copy, Debug)]
pub struct FogVertices;

impl Scene for FogVertices {
    type Memory = WithDepth<Vertices, { SPHERE.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        let shader = Fogged::new(Gouraud::new(LIGHT), &FOG, MIST).computed(AtVertices);
        drawn(&SPHERE, shader, memory, display)
    }
}

/// The colours of vertices, lit there.
#[derive(Clone, Copy, Debug)]
pub struct VertexColors;

impl Scene for VertexColors {
    type Memory = WithDepth<ColoredGouraud<Rgb565>, { COLORED_SPHERE.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        drawn(&COLORED_SPHERE, ColoredGouraud::new(LIGHT), memory, display)
    }
}

/// A texture by the normal.
#[derive(Clone, Copy, Debug)]
pub struct Matcap;

impl Scene for Matcap {
    type Memory = WithDepth<Crate, { SPHERE.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        drawn(&SPHERE, shade::Matcap::new(&WOODEN_CRATE_TEXTURES), memory, display)
    }
}
