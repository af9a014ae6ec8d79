//! Frames by a rasterizer in `f32`, for comparison: what one writes for a core that has an FPU.
//!
//! It draws the same tables in the same view by the same light. Vertices are placed in pixels,
//! depth is 1 / z, and a triangle is drawn span by span between its edges. A pixel belongs to the
//! triangle that its middle lies in; on an edge, to the one on the right. A pixel's colour is
//! computed from its level, or taken from a table of 64 levels as the library does.
//!
//! All of it is sums, products, quotients and conversions, which IEEE 754 defines to the last bit
//! and Rust does not fuse: the pictures are the same on every core, with an FPU or without.

use core::array;

use embedded_graphics_core::pixelcolor::Rgb565;
use rasterizer::{
    geometry::Pose,
    mesh::{Mesh, Tables},
    numbers::{Rotation, Scale, Vec3},
    output::Rgb565Be,
    shade::Light,
};

use super::{Choice, Memory, Shared, Shows};
use crate::{cost::timed, counter::Stage, stage::SIZE};

/// A vertex on the screen, and the light on it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Vertex {
    /// In pixels from the upper left corner.
    x: f32,
    y: f32,
    /// 1 over the distance from the camera, along its view.
    nearness: f32,
    /// From 0 to 1.
    level: f32,
}

impl Choice<'_> {
    /// Draws whole frames with Gouraud shading in `f32`, and with depth in `f32`: with colours in
    /// `LEVELS` levels, or if that is 0 with one computed for each pixel. `VERTICES` are those of
    /// the mesh.
    pub fn in_f32<const LEVELS: usize, const VERTICES: usize>(
        &self,
        light: &Light,
        background: Rgb565Be,
        memory: &Shared<Rgb565Be>,
    ) {
        let mut vertices = [Vertex::default(); VERTICES];
        let focal_length = self.scene.focal_length_px as f32;
        self.each(memory, |Pose { rotation, .. }, Memory { color, depth, .. }, ticks| {
            color.fill(background);
            let depth: &mut [f32] = bytemuck::must_cast_slice_mut(depth);
            timed(Stage::Clear, ticks, || clear(depth));
            let mesh = self.scene.mesh;
            timed(Stage::Vertices, ticks, || {
                let camera = Camera { rotation, eye: self.scene.eye(), focal_length };
                camera.project(mesh.tables(), light, &mut vertices);
            });
            timed(Stage::Draw, ticks, || draw::<LEVELS>(mesh, &vertices, color, depth));
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
    fn project(&self, tables: &Tables<'_>, light: &Light, vertices: &mut [Vertex]) {
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
            let [x, y, z] = [0, 1, 2].map(|i| dot(matrix[i], position) + origin[i]);
            let nearness = -1.0 / z;
            let slope = self.focal_length * nearness;
            let lambert = dot(toward, normal);
            let level = ambient + if lambert > 0.0 { lambert } else { 0.0 };
            *vertex = Vertex {
                x: middle[0] + x * slope,
                y: middle[1] - y * slope,
                nearness,
                level: if level < 1.0 { level } else { 1.0 },
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
fn draw<const LEVELS: usize>(
    mesh: &Mesh<'_>,
    vertices: &[Vertex],
    color: &mut [Rgb565Be],
    depth: &mut [f32],
) {
    let tables = mesh.tables();
    let mut next = 0;
    for material in tables.materials {
        let [red, green, blue] = material.color.map(|channel| f32::from(channel) / 255.0);
        let brightest = [red * 31.0, green * 63.0, blue * 31.0];
        let at = |level: f32| {
            // To the nearest.
            let [r, g, b] = brightest.map(|channel| (channel * level + 0.5) as i32 as u8);
            Rgb565Be::from(Rgb565::new(r, g, b))
        };
        let end = next + material.triangle_count as usize;
        let seen = (next..end)
            .map_while(|i| tables.triangles.get(i))
            .filter_map(|corners| Triangle::of(corners.map(|corner| vertices[corner])));
        if LEVELS == 0 {
            seen.for_each(|triangle| triangle.draw(color, depth, at));
        } else {
            let most = (LEVELS - 1) as f32;
            let ramp: [Rgb565Be; LEVELS] = array::from_fn(|level| at(level as f32 / most));
            let at = |level: f32| ramp[(level * most + 0.5) as usize % LEVELS];
            seen.for_each(|triangle| triangle.draw(color, depth, at));
        }
        next = end;
    }
}

/// A triangle from its upper to its lower corner, with what changes over it.
struct Triangle {
    corners: [Vertex; 3],
    nearness: Plane,
    level: Plane,
}

/// A value that changes linearly over the screen.
#[derive(Clone, Copy)]
struct Plane {
    /// At a corner.
    at: [f32; 2],
    value: f32,
    /// From one pixel to the next.
    per_x: f32,
    per_y: f32,
}

impl Plane {
    fn value(&self, x: f32, y: f32) -> f32 {
        self.value + self.per_x * (x - self.at[0]) + self.per_y * (y - self.at[1])
    }
}

impl Triangle {
    /// `None` for one that is seen from behind, or that is behind the camera in part: nothing is
    /// clipped.
    fn of([a, b, c]: [Vertex; 3]) -> Option<Self> {
        let (ab, ac) = ([b.x - a.x, b.y - a.y], [c.x - a.x, c.y - a.y]);
        let area = ab[0] * ac[1] - ab[1] * ac[0];
        let is_ahead = a.nearness > 0.0 && b.nearness > 0.0 && c.nearness > 0.0;
        // Corners run anticlockwise, and y downwards.
        if !(is_ahead && area < 0.0) {
            return None;
        }
        let per_area = 1.0 / area;
        let plane = |value: fn(&Vertex) -> f32| {
            let (to_b, to_c) = (value(&b) - value(&a), value(&c) - value(&a));
            Plane {
                at: [a.x, a.y],
                value: value(&a),
                per_x: (to_b * ac[1] - to_c * ab[1]) * per_area,
                per_y: (to_c * ab[0] - to_b * ac[0]) * per_area,
            }
        };
        let mut corners = [a, b, c];
        for (upper, lower) in [(0, 1), (1, 2), (0, 1)] {
            if corners[lower].y < corners[upper].y {
                corners.swap(upper, lower);
            }
        }
        Some(Self { corners, nearness: plane(|v| v.nearness), level: plane(|v| v.level) })
    }

    /// `at` returns the colour of a level.
    fn draw<C: Copy>(&self, color: &mut [C], depth: &mut [f32], at: impl Fn(f32) -> C + Copy) {
        let [top, middle, bottom] = &self.corners;
        let long = Edge::between(top, bottom);
        let is_left = long.x(middle.y) < middle.x;
        for (upper, lower) in [(top, middle), (middle, bottom)] {
            let short = Edge::between(upper, lower);
            let [from, to] = [upper.y, lower.y].map(|y| first(y, SIZE.height));
            for row in from..to {
                let y = row as f32 + 0.5;
                let (a, b) = (long.x(y), short.x(y));
                let ends = if is_left { [a, b] } else { [b, a] };
                let [left, right] = ends.map(|x| first(x, SIZE.width));
                if left < right {
                    let first = row * SIZE.width as usize;
                    let pixels = first + left..first + right;
                    let x = left as f32 + 0.5;
                    let start = [self.nearness.value(x, y), self.level.value(x, y)];
                    self.span(start, &mut color[pixels.clone()], &mut depth[pixels], at);
                }
            }
        }
    }

    /// Draws the pixels of a row, from the values at the first one.
    fn span<C>(
        &self,
        [mut nearness, mut level]: [f32; 2],
        color: &mut [C],
        depth: &mut [f32],
        at: impl Fn(f32) -> C,
    ) {
        for (color, depth) in color.iter_mut().zip(depth) {
            if nearness > *depth {
                *depth = nearness;
                *color = at(level);
            }
            nearness += self.nearness.per_x;
            level += self.level.per_x;
        }
    }
}

/// An edge that is not level. Both triangles beside it compute the same places.
struct Edge {
    upper: [f32; 2],
    slope: f32,
}

impl Edge {
    fn between(upper: &Vertex, lower: &Vertex) -> Self {
        let slope = (lower.x - upper.x) / (lower.y - upper.y);
        Self { upper: [upper.x, upper.y], slope }
    }

    fn x(&self, y: f32) -> f32 {
        self.upper[0] + (y - self.upper[1]) * self.slope
    }
}

/// The first of `count` pixels whose middle is not before a place; `count` if there is none.
fn first(place: f32, count: u32) -> usize {
    let place = place - 0.5;
    let whole = place as i32;
    let next = whole + i32::from((whole as f32) < place);
    next.clamp(0, count as i32) as usize
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::{vec, vec::Vec};

    use super::*;
    use crate::stage::PIXELS;

    const fn vertex(x: f32, y: f32, nearness: f32) -> Vertex {
        Vertex { x, y, nearness, level: x / 320.0 }
    }

    /// The pixels after some triangles: 1 and the column that the level is of, or 0; and depth.
    fn drawn(triangles: &[[Vertex; 3]]) -> (Vec<u32>, Vec<f32>) {
        let (mut color, mut depth) = (vec![0; PIXELS], vec![0.0; PIXELS]);
        for &corners in triangles {
            let triangle = Triangle::of(corners).unwrap();
            triangle.draw(&mut color, &mut depth, |level| (level * 320.0) as u32 + 1);
        }
        (color, depth)
    }

    #[test]
    fn triangles_beside_each_other_draw_each_pixel_once() {
        // A fan around a corner that is in no pixel's middle, over the whole display. Each is drawn
        // into memory of its own, and all pixels are in one.
        let middle = vertex(133.3, 77.7, 1.0);
        let rim: [[f32; 2]; 7] = [
            [-9.0, -7.0],
            [-5.0, 111.0],
            [-30.0, 300.0],
            [150.5, 260.5],
            [400.0, 290.0],
            [330.0, 99.9],
            [350.0, -60.0],
        ];
        let mut count = vec![0; PIXELS];
        for (i, &[x, y]) in rim.iter().enumerate() {
            let [next_x, next_y] = rim[(i + 1) % rim.len()];
            let corners = [middle, vertex(x, y, 1.0), vertex(next_x, next_y, 1.0)];
            let (color, _) = drawn(&[corners]);
            let pixels = color.iter().zip(&mut count);
            pixels.for_each(|(color, count)| *count += u32::from(*color > 0));
            // The other way round it is seen from behind.
            assert!(Triangle::of([corners[0], corners[2], corners[1]]).is_none());
        }
        assert!(count.iter().all(|&count| count == 1));
    }

    #[test]
    fn a_middle_on_an_edge_is_to_the_right_of_it() {
        let places = [-9.0, 0.5, 0.75, 1.5, 7.5, 8.5, 900.0];
        assert_eq!(places.map(|place| first(place, 8)), [0, 0, 1, 1, 7, 8, 8]);
    }

    #[test]
    fn values_are_those_of_the_middles_of_pixels_and_the_nearest_is_seen() {
        let corners = |nearness: [f32; 3]| {
            [
                vertex(10.0, 20.0, nearness[0]),
                vertex(10.0, 120.0, nearness[1]),
                vertex(210.0, 20.0, nearness[2]),
            ]
        };
        let (near, far) = (corners([0.5, 0.25, 0.75]), corners([0.3; 3]));
        for order in [[near, far], [far, near]] {
            let (color, depth) = drawn(&order);
            let place = 50 * SIZE.width as usize + 60;
            // From (10, 20) to (60.5, 50.5) by the gradients 0.25 / 200 and -0.25 / 100.
            let exact = 0.5 + 50.5 * 0.00125 - 30.5 * 0.0025;
            assert!((depth[place] - exact).abs() < 1e-6);
            assert_eq!(color[place], 61);
            // There the far one is nearer: 0.5 + 5.5 * 0.00125 - 95.5 * 0.0025 is 0.268.
            assert!((depth[115 * SIZE.width as usize + 15] - 0.3).abs() < 1e-6);
        }
    }
}
