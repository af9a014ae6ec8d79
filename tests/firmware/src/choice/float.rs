//! Frames by a rasterizer in `f32`, for comparison: what one writes for a core that has an FPU.
//!
//! It draws the same tables in the same view by the same light. Vertices are placed in pixels,
//! depth is 1 / z, and a triangle is drawn span by span between its edges. A pixel belongs to the
//! triangle that its middle lies in; on an edge, to the one on the right. A pixel's colour is
//! computed from its level, taken from a table of 64 levels as the library does, or a texel's.
//!
//! All of it is sums, products, quotients and conversions, which IEEE 754 defines to the last bit
//! and Rust does not fuse: the pictures are the same on every core, with an FPU or without.

mod paint;
mod texture;
mod triangle;

use rasterizer::{
    geometry::Pose,
    mesh::{Material, Mesh, Tables},
    numbers::{Rotation, Scale, Vec3},
    output::Rgb565Be,
    shade::Light,
};

use paint::{Computed, Paint, Ramp};
use texture::{Covering, Every, EveryPixel, Skin};
use triangle::Triangle;

use super::{Choice, Memory, Shared, Shows};
use crate::{cost::timed, counter::Stage, stage::SIZE};

/// A vertex on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Vertex<const N: usize> {
    /// In pixels from the upper left corner.
    x: f32,
    y: f32,
    /// What is linear on the screen over a triangle. The first is nearness: 1 over the distance
    /// from the camera, along its view.
    values: [f32; N],
}

impl<const N: usize> Vertex<N> {
    const EMPTY: Self = Self { x: 0.0, y: 0.0, values: [0.0; N] };

    const fn nearness(&self) -> f32 {
        self.values[0]
    }
}

impl Choice<'_> {
    /// Draws whole frames with Gouraud shading in `f32`, and with depth in `f32`: with a colour
    /// computed for each pixel. `VERTICES` are those of the mesh.
    pub fn in_f32<const VERTICES: usize>(
        &self,
        light: &Light,
        background: Rgb565Be,
        memory: &Shared<Rgb565Be>,
    ) {
        let paint = |(_, material): (_, &Material)| Computed::of(material);
        self.floating::<_, _, VERTICES>(light, paint, background, memory);
    }

    /// The same with colours in `LEVELS` levels.
    pub fn in_f32_levels<const LEVELS: usize, const VERTICES: usize>(
        &self,
        light: &Light,
        background: Rgb565Be,
        memory: &Shared<Rgb565Be>,
    ) {
        let paint = |(_, material): (_, &Material)| Ramp::<LEVELS>::of(material);
        self.floating::<_, _, VERTICES>(light, paint, background, memory);
    }

    /// The same with the textures of the mesh's materials, and a division at each pixel.
    pub fn textured_in_f32<S: Covering, const VERTICES: usize>(
        &self,
        textures: &[S],
        light: &Light,
        background: Rgb565Be,
        memory: &Shared<Rgb565Be>,
    ) {
        let paint = |material: (_, &_)| EveryPixel(Skin::of(textures, material));
        self.floating::<_, _, VERTICES>(light, paint, background, memory);
    }

    /// The same with a division every `PIXELS` pixels.
    pub fn textured_in_f32_every<S: Covering, const PIXELS: usize, const VERTICES: usize>(
        &self,
        textures: &[S],
        light: &Light,
        background: Rgb565Be,
        memory: &Shared<Rgb565Be>,
    ) {
        let paint = |material: (_, &_)| Every::<_, PIXELS>(Skin::of(textures, material));
        self.floating::<_, _, VERTICES>(light, paint, background, memory);
    }

    /// Draws whole frames in `f32`. `paint` makes that of a material from its number and it.
    fn floating<P: Paint<N, Color = Rgb565Be>, const N: usize, const VERTICES: usize>(
        &self,
        light: &Light,
        paint: impl Fn((usize, &Material)) -> P,
        background: Rgb565Be,
        memory: &Shared<Rgb565Be>,
    ) {
        let mut vertices = [Vertex::<N>::EMPTY; VERTICES];
        let focal_length = self.scene.focal_length_px as f32;
        self.each(memory, |Pose { rotation, .. }, Memory { color, depth, .. }, ticks| {
            color.fill(background);
            let depth: &mut [f32] = bytemuck::must_cast_slice_mut(depth);
            timed(Stage::Clear, ticks, || clear(depth));
            let mesh = self.scene.mesh;
            timed(Stage::Vertices, ticks, || {
                let camera = Camera { rotation, eye: self.scene.eye(), focal_length };
                camera.project::<P, N>(mesh.tables(), light, &mut vertices);
            });
            timed(Stage::Draw, ticks, || draw(mesh, &vertices, color, depth, &paint));
            Shows::Frame
        });
    }
}

/// Sets depth to the far plane, which is 100 units away. Eight stores at a time: a loop of one
/// takes seven times as many instructions.
fn clear(depth: &mut [f32]) {
    const FARTHEST: f32 = 1.0 / 100.0;
    let (chunks, rest) = depth.as_chunks_mut::<8>();
    chunks.iter_mut().for_each(|chunk| *chunk = [FARTHEST; 8]);
    rest.fill(FARTHEST);
}

/// How the model is turned and seen, along the z axis.
struct Camera {
    rotation: Rotation,
    eye: Vec3,
    /// In pixels.
    focal_length: f32,
}

impl Camera {
    /// Places and lights all vertices.
    fn project<P: Paint<N>, const N: usize>(
        &self,
        tables: &Tables<'_>,
        light: &Light,
        vertices: &mut [Vertex<N>],
    ) {
        let rows = self.rotation.rows().map(|row| row.map(|c| from_q(30, c.to_bits())));
        let offset = tables.offset.to_bits().map(|c| from_q(16, c));
        let eye = self.eye.to_bits().map(|c| from_q(16, c));
        let scale = scale(tables.scale);
        let matrix = rows.map(|row| row.map(|c| c * scale));
        let origin = [0, 1, 2].map(|i| dot(rows[i], offset) - eye[i]);
        // The light in the model's space, of a length that takes a normal of 127 to its level.
        let [ambient, diffuse] =
            [light.ambient(), light.diffuse()].map(|level| from_q(15, level.to_bits().into()));
        let toward = light.toward().map(|c| from_q(30, c));
        let toward =
            [0, 1, 2].map(|column| dot(rows.map(|row| row[column]), toward) * (diffuse / 127.0));
        let middle = [SIZE.width, SIZE.height].map(|size| size as f32 / 2.0);
        for (i, vertex) in vertices.iter_mut().enumerate() {
            let position = tables.positions.get(i).unwrap_or_default().map(f32::from);
            let normal = tables.vertex_normals.get(i).unwrap_or_default().map(f32::from);
            let coordinates = tables.texture_coordinates.get(i).unwrap_or_default();
            let [x, y, z] = [0, 1, 2].map(|i| dot(matrix[i], position) + origin[i]);
            let nearness = -1.0 / z;
            let slope = self.focal_length * nearness;
            let lambert = dot(toward, normal);
            let level = ambient + if lambert > 0.0 { lambert } else { 0.0 };
            let level = if level < 1.0 { level } else { 1.0 };
            *vertex = Vertex {
                x: middle[0] + x * slope,
                y: middle[1] - y * slope,
                values: P::vertex(nearness, level, coordinates.map(|c| c as f32)),
            };
        }
    }
}

/// A number with this many bits behind the binary point.
fn from_q(fraction_bits: i32, bits: i32) -> f32 {
    bits as f32 * power_of_two(-fraction_bits)
}

fn scale(scale: Scale) -> f32 {
    scale.mantissa() as f32 * power_of_two(scale.exponent())
}

/// For exponents from -126 to 127, which scales of models are far from.
const fn power_of_two(exponent: i32) -> f32 {
    f32::from_bits(((exponent + 127) as u32) << 23)
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Draws all triangles that face the camera.
fn draw<P: Paint<N>, const N: usize>(
    mesh: &Mesh<'_>,
    vertices: &[Vertex<N>],
    color: &mut [P::Color],
    depth: &mut [f32],
    paint: impl Fn((usize, &Material)) -> P,
) {
    let tables = mesh.tables();
    let mut next = 0;
    for (number, material) in tables.materials.iter().enumerate() {
        let paint = paint((number, material));
        let end = next + material.triangle_count as usize;
        (next..end)
            .map_while(|i| tables.triangles.get(i))
            .filter_map(|corners| Triangle::of(corners.map(|corner| vertices[corner])))
            .for_each(|triangle| triangle.draw(color, depth, &paint));
        next = end;
    }
}
