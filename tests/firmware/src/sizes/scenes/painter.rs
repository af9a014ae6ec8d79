//! The scene of the painter's algorithm.

use embedded_graphics_core::pixelcolor::Rgb565;
use rasterizer::{
    attribute::NoDepth,
    geometry::ScreenVertex,
    numbers::S4,
    output::Direct,
    scene::{Object, Painter},
    shade::Flat,
};

use super::{LIGHT, PERSPECTIVE, PICTURE, camera, frames::for_each_view};
use crate::models::{BALL, CUBE};
use crate::sizes::{Display, Scene};

type Vertex = ScreenVertex<S4, NoDepth, [u16; 0]>;

const VERTICES: usize = BALL.vertex_count() + CUBE.vertex_count();
const WORDS: usize = BALL.triangle_count() + CUBE.triangle_count();

/// A ball and a cube straight onto the display, from back to front.
#[derive(Clone, Copy, Debug)]
pub struct PainterDirect;

impl Scene for PainterDirect {
    type Memory = ([Vertex; VERTICES], [u32; WORDS]);

    const MEMORY: Self::Memory = ([ScreenVertex::EMPTY; VERTICES], [0; WORDS]);

    fn draw((vertices, words): &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let camera = camera(view, PERSPECTIVE, PICTURE)?;
            let (of_ball, of_cube) = vertices.split_at_mut(BALL.vertex_count());
            let shader = Flat::<Rgb565>::new(LIGHT);
            let ball = Object::new(&BALL, shader).posed(view.pose());
            let ball = ball.project(&camera, of_ball).ok()?;
            let cube = Object::new(&CUBE, shader).project(&camera, of_cube).ok()?;
            let painter = Painter::new((&ball, &cube), words).ok()?;
            painter.draw(&mut Direct::new(display)).ok()
        })
    }
}
