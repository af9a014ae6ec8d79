//! A texture: `Textured`.
//!
//! `host-tools convert` makes one of the picture of each material, beside the mesh. By default a
//! pixel has the texel that its centre lies on, and texture coordinates are divided as often as
//! half a texel needs it.
//!
//! `cargo run -p rasterizer --example textured`

mod common;
/// What `host-tools convert --texture-format indexed4 --mipmaps` makes of `wooden_crate.obj`.
#[path = "models/wooden_crate.rs"]
pub mod wooden_crate;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::prelude::*;
use static_cell::ConstStaticCell;
use wooden_crate::{WOODEN_CRATE, WOODEN_CRATE_TEXTURES};

const NIGHT: Rgb565 = Rgb565::new(4, 10, 8);

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let turned = Rotation::about_x(Turn::degrees(28)) * Rotation::about_y(Turn::degrees(35));
    let wooden_crate = Object::new(&WOODEN_CRATE, Textured::new(&WOODEN_CRATE_TEXTURES))
        .posed(Pose::rotated(turned));

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; WOODEN_CRATE.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    wooden_crate.draw(&camera(SCREEN)?, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
