//! Holes: a shader that leaves pixels out, `Outcome = Option<..>`.
//!
//! A discarded pixel keeps its colour and its depth, so what lies behind it can be drawn before or
//! after.
//!
//! `cargo run -p rasterizer --example discard`

#[path = "models/ball.rs"]
mod ball;
mod common;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::pixelcolor::Rgb565;
use rasterizer::{
    fixed::types::U16F16,
    mesh::{Material, Mesh, MeshMaterial, MeshVertex, RequiredTables},
    prelude::*,
    raster::Fragment,
    shade::Ramp,
};
use static_cell::ConstStaticCell;

const NIGHT: Rgb565 = Rgb565::new(3, 5, 6);
/// The lamp shade is lit from outside by the moon, and from inside by its bulb.
const MOON: Light = Light::new(Vec3::lit("-2", "3", "4"), Level::lit("0.1"), Level::lit("0.8"));
const BULB: Light = Light::new(Vec3::lit("0", "0.5", "-1"), Level::lit("0.3"), Level::lit("0.7"));
static SHADE: Mesh<'static> = ball(&[Material::new([150, 90, 190], ball::TRIANGLES)]);
static LINING: Mesh<'static> = ball(&[Material::new([255, 150, 50], ball::TRIANGLES)]);
static LAMP: Mesh<'static> = ball(&[Material::new([255, 250, 200], ball::TRIANGLES)]);

static COLOR: ConstStaticCell<[Rgb565; 240 * 240]> = ConstStaticCell::new([NIGHT; 240 * 240]);
static DEPTH: ConstStaticCell<[u16; 240 * 240]> = ConstStaticCell::new([0; 240 * 240]);

/// Lit, with round holes in a grid of texture coordinates.
#[derive(Clone)]
struct Perforated(Light);

impl Shader for Perforated {
    type Color = Rgb565;
    /// The light level, and the texture coordinates.
    type Varyings = [u16; 3];
    type Surface = Ramp<Rgb565, 64>;
    type Face = ();
    /// `None` is a hole.
    type Outcome = Option<Rgb565>;

    const TABLES: RequiredTables =
        RequiredTables { vertex_normals: true, texture_coordinates: true, ..RequiredTables::NONE };

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self(self.0.for_object(view.pose()))
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        Ramp::between(NIGHT.into(), material.rgb())
    }

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 3] {
        // 15 bits behind the binary point: 1 fits 16 bits.
        let [u, v] = vertex.texture_coordinates().map(|c| (c >> 9) as u16);
        [Ramp::<Rgb565, 64>::varying(self.0.level(vertex.normal())), u, v]
    }

    fn pixel(
        &self,
        ramp: &Self::Surface,
        (): &(),
        fragment: Fragment<[U16F16; 3]>,
    ) -> Option<Rgb565> {
        let [level, u, v] = fragment.varyings;
        // 16 holes around and 8 from pole to pole: a cell has 2,048 by 4,096 units of 2^-15, which
        // is a square on the equator.
        let across = (u.to_num::<i32>() % 2048 - 1024) * 2;
        let down = v.to_num::<i32>() % 4096 - 2048;
        let is_hole = across * across + down * down < 1300 * 1300;
        (!is_hole).then(|| ramp.at(level))
    }
}

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let camera = camera(SCREEN)?;
    let tilted = Rotation::about_z(Turn::degrees(15)) * Rotation::about_x(Turn::degrees(20));
    let pose = Pose::rotated(tilted).scaled(const { Distance::lit("0.98") });
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), SCREEN)?;

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; SHADE.vertex_count()];
    let outside = Object::new(&SHADE, Perforated(MOON)).posed(pose);
    outside.draw(&camera, &mut vertices, &mut frame)?;
    // Through the holes its far side is seen from inside: the faces that are culled otherwise.
    let inside = Object::new(&LINING, Perforated(BULB)).posed(pose).culled(CullFront);
    inside.draw(&camera, &mut vertices, &mut frame)?;

    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; LAMP.vertex_count()];
    let bulb = Pose::IDENTITY.scaled(const { Distance::lit("0.45") });
    Object::new(&LAMP, Unlit::new()).posed(bulb).draw(&camera, &mut vertices, &mut frame)?;
    frame.present(screen)?;
    Ok(())
}

fn main() -> Result {
    common::run(draw)
}
