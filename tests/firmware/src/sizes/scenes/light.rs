//! The scenes of lights and highlights: a ball of 500 triangles with light at its vertices or at
//! each pixel. Each differs from [`GouraudS4`](super::GouraudS4) in its shader.

use embedded_graphics_core::pixelcolor::Rgb565;
use rasterizer::{
    mesh::Mesh,
    numbers::S4,
    scene::Object,
    shade::{self, Gouraud, Lamp, Light, OnScreen, Shader},
};

use super::{
    LIGHT, NARROW, PERSPECTIVE, PICTURE, camera,
    frames::{Bands, for_each_view},
};
use crate::sizes::{Display, Scene};
use crate::{models, shiny, stage::LAMP};

/// The ball's vertices and a band for them, with depth.
type Memory<Sh> = Bands<S4, u16, OnScreen<Sh>, NARROW, { models::BALL.vertex_count() }>;

/// The ball in bands.
fn lit<Sh: Shader<Color = Rgb565>>(
    mesh: &'static Mesh<'static>,
    shader: Sh,
    memory: &mut Memory<Sh>,
    display: &mut Display,
) -> Option<()> {
    for_each_view(|view| {
        let object = Object::new(mesh, shader.clone()).posed(view.pose());
        memory.draw(&object, &camera(view, PERSPECTIVE, PICTURE)?, display)
    })
}

/// A lamp beside a distant light.
type Near = (Light, Lamp);

macro_rules! scenes {
    ($($(#[$text:meta])* $name:ident: $shader:ty = $make:expr, $mesh:expr;)*) => {
        $(
            $(#[$text])*
            #[derive(Clone, Copy, Debug)]
            pub struct $name;

            impl Scene for $name {
                type Memory = Memory<$shader>;

                const MEMORY: Self::Memory = Bands::EMPTY;

                fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
                    lit(&$mesh, $make, memory, display)
                }
            }
        )*
    };
}

scenes! {
    /// With a lamp too.
    GouraudLamp: Gouraud<Rgb565, 64, Near> = Gouraud::new((LIGHT, LAMP)), models::BALL;
    /// With highlights at the vertices.
    GlossyGouraud: shade::GlossyGouraud<Rgb565> = shade::GlossyGouraud::new(LIGHT), shiny::BALL;
    /// With light and highlights at each pixel.
    Phong: shade::Phong<Rgb565> = shade::Phong::new(LIGHT), shiny::BALL;
    /// The same with a lamp too.
    PhongLamp: shade::Phong<Rgb565, Near> = shade::Phong::new((LIGHT, LAMP)), shiny::BALL;
}
