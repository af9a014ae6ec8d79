//! An output of the program: it counts how often each pixel is covered, instead of colouring it.
//!
//! With all faces drawn and none hidden, that is the number of surfaces one behind the other: an
//! X-ray picture. With back faces culled, it shows where a scene costs more than one layer.
//!
//! `cargo run -p rasterizer --example own_output`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use std::convert::Infallible;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use rasterizer::{
    output::Target,
    prelude::*,
    raster::{FragmentOf, Layout, Primitive, Window},
    shade::Outcome,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

/// The layers of each pixel of the display, a byte each.
struct Layers<'a>(&'a mut [u8; 240 * 240]);

static LAYERS: ConstStaticCell<[u8; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

impl Target for Layers<'_> {
    /// It takes objects whose shader has this colour.
    type Color = Rgb565;
    /// It keeps no depth, so vertices have none either.
    type Depth = NoDepth;
    type Error = Infallible;

    fn window(&self) -> Window {
        Window::new(&SCREEN)
    }

    fn shade<Q: Primitive<Depth = NoDepth>, O: Outcome<Rgb565>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        _: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        // A pixel's address is its index: row * 240 + column.
        let layout = Layout { pitch: 240, origin: 0 };
        primitive.for_each_span(window, layout, |span| {
            self.0[span.start..span.end].iter_mut().for_each(|layers| *layers += 1);
            Ok(())
        })
    }
}

/// The colours of 0, 1, 2 ... layers.
const HEAT: [Rgb565; 9] = [
    Rgb565::new(0, 2, 3),
    Rgb565::new(1, 9, 10),
    Rgb565::new(2, 18, 17),
    Rgb565::new(2, 28, 24),
    Rgb565::new(4, 42, 29),
    Rgb565::new(12, 54, 28),
    Rgb565::new(24, 60, 18),
    Rgb565::new(31, 50, 8),
    Rgb565::WHITE,
];

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.03", "0.13", "0") })
        .scaled(const { Distance::lit("1.25") });
    let rocket = Object::new(&ROCKET, Unlit::new()).posed(pose).culled(CullNone);

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut layers = Layers(LAYERS.take());
    rocket.draw(&camera(SCREEN)?, &mut vertices, &mut layers)?;

    let heat = layers.0.iter().map(|&count| HEAT[usize::from(count).min(HEAT.len() - 1)]);
    screen.fill_contiguous(&SCREEN, heat)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
