//! A shader of the program: a light in eight steps, and contour lines at equal heights.
//!
//! `cargo run -p rasterizer --example own_shader`

mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    pixelcolor::{Rgb565, Rgb888},
    prelude::*,
};
use rasterizer::{
    fixed::types::U16F16,
    mesh::{MeshMaterial, MeshVertex, RequiredTables},
    prelude::*,
    raster::Fragment,
    shade::{CodeSize, Ramp},
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

const PAPER: Rgb565 = Rgb565::new(29, 57, 25);
const LIGHT: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.45"), Level::lit("0.6"));

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([PAPER; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

/// A light, and lines as on a map.
#[derive(Clone)]
struct Contours(Light);

impl Shader for Contours {
    type Color = Rgb565;
    /// The light level, and the height above the model's lowest point.
    type Varyings = [u16; 2];
    /// A material becomes a ramp from dark to bright, and a line's colour.
    type Surface = (Ramp<Rgb565, 8>, Rgb565);
    type Face = ();
    type Outcome = Rgb565;

    /// Drawing a mesh without these is an error before the first pixel.
    const TABLES: RequiredTables = RequiredTables { vertex_normals: true, ..RequiredTables::NONE };

    /// A pixel takes some twenty instructions, of which there may be several copies.
    const CODE: CodeSize = CodeSize::Medium;

    /// Once a frame: with the light as the turned object sees it, normals need not be turned.
    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self(self.0.for_object(view.pose()))
    }

    /// Once for each material.
    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        let color = material.rgb();
        let ink = Rgb888::new(color.r() / 3, color.g() / 3, color.b() / 3);
        (Ramp::between(Rgb888::BLACK, color), ink.into())
    }

    /// Once for each vertex.
    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 2] {
        let [_, height, _] = vertex.position();
        let level = self.0.level(vertex.normal());
        [Ramp::<Rgb565, 8>::varying(level), height as u16 ^ 0x8000]
    }

    /// For each pixel that is not hidden.
    fn pixel(&self, surface: &Self::Surface, (): &(), fragment: Fragment<[U16F16; 2]>) -> Rgb565 {
        let (ramp, ink) = surface;
        let [level, height] = fragment.varyings;
        // The lowest sixth of each of 32 slices is a line.
        let in_slice = height.to_num::<u32>() % 2048;
        if in_slice < 340 { *ink } else { ramp.at(level) }
    }
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let tilted = Rotation::about_x(Turn::degrees(25))
        * Rotation::about_z(-Turn::degrees(40))
        * Rotation::about_y(Turn::degrees(50));
    let pose = Pose::rotated(tilted)
        .at(const { Vec3::lit("0.03", "0.13", "0") })
        .scaled(const { Distance::lit("1.25") });
    let rocket = Object::new(&ROCKET, Contours(LIGHT)).posed(pose);

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;
    rocket.draw(&camera(SCREEN)?, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
