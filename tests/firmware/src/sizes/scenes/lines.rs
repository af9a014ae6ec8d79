//! The scenes of lines and points: the edges of the ball, and its vertices.

use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use rasterizer::{
    attribute::NoDepth, fixed::types::U8F8, geometry::ScreenVertex, numbers::S4, output::Direct,
    raster::Bias, scene::Object, shade::Unlit,
};

use super::{
    NARROW, PERSPECTIVE, PICTURE, camera,
    frames::{Bands, for_each_view},
};
use crate::models::{BALL, BALL_EDGES, BALL_POINTS};
use crate::sizes::{Display, Scene};

type Vertex<D> = ScreenVertex<S4, D, [u16; 0]>;

/// All edges straight onto the display, without depth.
#[derive(Clone, Copy, Debug)]
pub struct LinesDirect;

impl Scene for LinesDirect {
    type Memory = [Vertex<NoDepth>; BALL.vertex_count()];

    const MEMORY: Self::Memory = [ScreenVertex::EMPTY; BALL.vertex_count()];

    fn draw(vertices: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let ball = Object::new(&BALL, Unlit::<Rgb565>::new()).posed(view.pose());
            let camera = camera(view, PERSPECTIVE, PICTURE)?;
            let seen = ball.project(&camera, &mut vertices[..]).ok()?;
            seen.lines(&BALL_EDGES).fill(Rgb565::WHITE, &mut Direct::new(display)).ok()
        })
    }
}

/// The edges that the ball does not hide, in bands with depth.
#[derive(Clone, Copy, Debug)]
pub struct LinesHidden;

impl Scene for LinesHidden {
    type Memory = Bands<S4, u16, [u16; 0], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let ball =
                Object::new(&BALL, Unlit::new()).posed(view.pose()).biased(Bias::BEHIND_LINES);
            let camera = camera(view, PERSPECTIVE, PICTURE)?;
            memory.draw_lines(&BALL_EDGES, &ball, &camera, display, |lines, band| {
                lines.fill(Rgb565::WHITE, band)
            })
        })
    }
}

/// The same antialiased.
#[derive(Clone, Copy, Debug)]
pub struct LinesSmooth;

impl Scene for LinesSmooth {
    type Memory = Bands<S4, u16, [u16; 0], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let ball =
                Object::new(&BALL, Unlit::new()).posed(view.pose()).biased(Bias::BEHIND_LINES);
            let camera = camera(view, PERSPECTIVE, PICTURE)?;
            memory.draw_lines(&BALL_EDGES, &ball, &camera, display, |lines, band| {
                lines.smooth(U8F8::ONE).fill(Rgb565::WHITE, band)
            })
        })
    }
}

/// All vertices straight onto the display, without depth.
#[derive(Clone, Copy, Debug)]
pub struct PointsDirect;

impl Scene for PointsDirect {
    type Memory = [Vertex<NoDepth>; BALL.vertex_count()];

    const MEMORY: Self::Memory = [ScreenVertex::EMPTY; BALL.vertex_count()];

    fn draw(vertices: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let ball = Object::new(&BALL, Unlit::<Rgb565>::new()).posed(view.pose());
            let camera = camera(view, PERSPECTIVE, PICTURE)?;
            let seen = ball.project(&camera, &mut vertices[..]).ok()?;
            let points = seen.points(&BALL_POINTS).sized(3);
            points.fill(Rgb565::WHITE, &mut Direct::new(display)).ok()
        })
    }
}
