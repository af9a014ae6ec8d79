//! A user's shader: contour lines on a cube, printed as text.
//!
//! `cargo run -p rasterizer --example own_shader`

use embedded_graphics::{
    geometry::{Point, Size},
    pixelcolor::{Gray8, GrayColor, RgbColor},
    primitives::Rectangle,
};
use fixed::types::U16F16;
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::{Pose, ScreenVertex},
    mesh::{Material, Mesh, MeshMaterial, MeshVertex, Positions, Tables, Triangles},
    numbers::{Rotation, S4, Scale, Turn, Vec3},
    output::Frame,
    raster::Fragment,
    scene::Object,
    shade::Shader,
};

/// Paints every other horizontal slice of the model black, the others in a grey as bright as the
/// material's red.
#[derive(Clone)]
struct Contours;

impl Shader for Contours {
    type Color = Gray8;
    type Varyings = [u16; 1];
    type Surface = Gray8;
    type Face = ();
    type Outcome = Gray8;
    fn surface(&self, material: &MeshMaterial<'_>) -> Gray8 {
        Gray8::new(material.rgb().r())
    }
    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 1] {
        [vertex.position()[1] as u16 ^ 0x8000]
    }
    fn pixel(&self, surface: &Gray8, (): &(), fragment: Fragment<[U16F16; 1]>) -> Gray8 {
        let [height] = fragment.varyings;
        if height.to_bits() >> 28 & 1 == 0 { *surface } else { Gray8::BLACK }
    }
}

const END: i16 = 32_767;

/// A cube two units wide. Bits 0, 1 and 2 of a vertex's index are its side in x, y and z.
static CUBE: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[
        [-END, -END, -END],
        [END, -END, -END],
        [-END, END, -END],
        [END, END, -END],
        [-END, -END, END],
        [END, -END, END],
        [-END, END, END],
        [END, END, END],
    ]),
    scale: Scale::new(1, -15),
    triangles: Triangles::U8(&[
        [4, 5, 7],
        [4, 7, 6],
        [1, 0, 2],
        [1, 2, 3],
        [5, 1, 3],
        [5, 3, 7],
        [0, 4, 6],
        [0, 6, 2],
        [6, 7, 3],
        [6, 3, 2],
        [0, 1, 5],
        [0, 5, 4],
    ]),
    materials: &[Material::new([255, 0, 0], 4), Material::new([120, 0, 0], 8)],
    ..Tables::EMPTY
});

const WIDTH: u32 = 64;
const HEIGHT: u32 = 48;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
const NEAR: Distance = Distance::lit("0.1");
const FAR: Distance = Distance::lit("10");
const EYE: Vec3 = Vec3::lit("0", "0", "4");

/// Draws the cube as text, one line for two rows of pixels.
pub(crate) fn picture() -> Result<String, Box<dyn std::error::Error>> {
    let screen = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));
    let lens = Perspective::new(Turn::degrees(50), NEAR, FAR)?;
    let camera = Camera::at(EYE, Rotation::IDENTITY, lens, screen)?;
    let pose =
        Pose::rotated(Rotation::about_x(Turn::degrees(25)) * Rotation::about_y(Turn::degrees(30)));

    let (mut color, mut depth) = ([Gray8::new(40); PIXELS], [0u16; PIXELS]);
    let mut storage = [ScreenVertex::<S4, _, _>::EMPTY; 8];
    let mut frame = Frame::new(&mut color, &mut depth, screen)?;
    Object::new(&CUBE, Contours).posed(pose).draw(&camera, &mut storage, &mut frame)?;

    let text = |row: &[Gray8]| -> String {
        let shade = |pixel: &Gray8| match pixel.luma() {
            0 => ' ',
            1..=40 => '.',
            41..=120 => '+',
            _ => '#',
        };
        row.iter().map(shade).chain(['\n']).collect()
    };
    Ok(frame.pixels().chunks(WIDTH as usize).step_by(2).map(text).collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    print!("{}", picture()?);
    Ok(())
}
