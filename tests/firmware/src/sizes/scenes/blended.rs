//! The scenes with blending: the ball of [`GouraudS4`](super::GouraudS4) over a background.

use rasterizer::{
    attribute::NoDepth,
    color::Alpha,
    geometry::CullNone,
    numbers::S4,
    output::{KeepDepth, Over},
    scene::Object,
    shade::Gouraud,
};

use super::{
    LIGHT, NARROW, PERSPECTIVE, PICTURE, camera,
    frames::{Bands, for_each_view},
};
use crate::models::BALL;
use crate::sizes::{Display, Scene};

const PART: Alpha = Alpha::lit("0.4");

/// The ball put over what is behind it, in bands with depth.
#[derive(Clone, Copy, Debug)]
pub struct BlendedOver;

impl Scene for BlendedOver {
    type Memory = Bands<S4, u16, [u16; 1], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let ball = Object::new(&BALL, Gouraud::new(LIGHT)).posed(view.pose());
            let ball = ball.blended(KeepDepth(Over(PART)));
            memory.draw(&ball, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// The same from both sides, sorted from back to front, in bands without depth.
#[derive(Clone, Copy, Debug)]
pub struct BlendedSorted;

impl Scene for BlendedSorted {
    type Memory = (
        Bands<S4, NoDepth, [u16; 1], NARROW, { BALL.vertex_count() }>,
        [u32; BALL.triangle_count()],
    );

    const MEMORY: Self::Memory = (Bands::EMPTY, [0; BALL.triangle_count()]);

    fn draw((memory, order): &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let ball = Object::new(&BALL, Gouraud::new(LIGHT)).posed(view.pose());
            let ball = ball.culled(CullNone).blended(Over(PART));
            memory.draw_sorted(order, &ball, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}
