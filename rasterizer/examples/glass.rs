//! A rocket of glass, which is seen through itself: its triangles from back to front,
//! `Projected::back_to_front`, in bands.
//!
//! `cargo run -p rasterizer --example glass`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    pixelcolor::Rgb565,
    prelude::*,
    primitives::{PrimitiveStyle, Rectangle},
};
use rasterizer::{color::Alpha, output::Over, prelude::*};
use rocket::ROCKET;

const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.3"), Level::lit("0.8"));
/// Rows of a band.
const ROWS: u32 = 24;
const NEEDS: Needs = Needs::of(&ROCKET, SCREEN.size, ROWS);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_z(-Turn::degrees(40)) * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.03", "0.13", "0") })
        .scaled(const { Distance::lit("1.25") });
    // Both sides of the glass are seen. `Over(MaterialOpacity::new())` would take the opacity of
    // each material from the model.
    let glass = Object::new(&ROCKET, Gouraud::new(LIGHT)).posed(pose).culled(CullNone);
    let glass = glass.blended(Over(const { Alpha::lit("0.45") }));

    let mut vertices = [ScreenVertex::<S4, NoDepth, _>::EMPTY; NEEDS.vertices];
    // A word for each triangle. The order needs no depth, of vertices or of pixels.
    let mut order = [0; NEEDS.sort_words];
    let seen = glass.project(&camera(SCREEN)?, &mut vertices)?.back_to_front(&mut order)?;

    let mut color = [Rgb565::BLACK; NEEDS.pixels];
    let mut bands = Bands::without_depth(SCREEN, &mut color[..])?;
    bands.show(screen, |band| tiles(band), |band| seen.draw(band))?;
    Ok(())
}

/// A floor of tiles, for something to see through the glass.
fn tiles(band: &mut impl DrawTarget<Color = Rgb565, Error = core::convert::Infallible>) {
    const LIGHT: Rgb565 = Rgb565::new(20, 40, 19);
    const DARK: Rgb565 = Rgb565::new(14, 30, 15);
    let Ok(()) = band.clear(LIGHT);
    for place in 0..64 {
        let (column, row) = (place % 8, place / 8);
        if (column + row) % 2 == 0 {
            let tile = Rectangle::new(Point::new(30 * column, 30 * row), Size::new_equal(30));
            let Ok(()) = tile.into_styled(PrimitiveStyle::with_fill(DARK)).draw(band);
        }
    }
}

fn main() -> Result {
    common::run(draw)
}
