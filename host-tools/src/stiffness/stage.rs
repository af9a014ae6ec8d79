//! A mesh before a camera: where the core places its vertices, and where they are by definition.

use std::convert::Infallible;

use embedded_graphics_core::{
    geometry::{Point, Size},
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{CullNone, Pose, ScreenVertex},
    mesh::{Material, Mesh, Positions, Tables, Triangles},
    numbers::{Rotation, S8, Scale, Subpixel, Turn, Vec3},
    output::{Frame, StoredDepth},
    scene::{Modes, Object},
    shade::Unlit,
};

use super::work::{Scene, Work};
use crate::reference::{Camera as Definition, Projection, Viewport, random::Random};

/// Width and height of the picture in pixels.
pub(super) const SIZE: [u32; 2] = [320, 240];

/// A mesh, its pose, and a camera that looks along -z.
#[derive(Clone, Debug)]
pub(super) struct Stage<P = Perspective> {
    pub(super) positions: Vec<[i16; 3]>,
    pub(super) triangles: Vec<[u16; 3]>,
    /// The length of a quantum.
    pub(super) scale: Scale,
    pub(super) pose: Pose,
    pub(super) eye: Vec3,
    pub(super) lens: Lens<P>,
}

/// A projection of the core, and its definition.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens<P> {
    core: P,
    pub(super) definition: Projection,
}

impl Lens<Perspective> {
    /// With a focal length in pixels, and the distances of the near and the far plane.
    pub(super) fn perspective(focal_length: Distance, near: Distance, far: Distance) -> Self {
        let core = Perspective::with_focal_length(focal_length, near, far);
        Self {
            core: core.expect("the distances are in order"),
            definition: Projection::Perspective {
                focal_length_px: focal_length.to_num(),
                near: near.to_num(),
                far: far.to_num(),
            },
        }
    }
}

impl Lens<Orthographic> {
    /// With one pixel for a unit, and the distances of the near and the far plane.
    pub(super) fn orthographic(near: Distance, far: Distance) -> Self {
        let core = Orthographic::new(Distance::from_num(SIZE[1]), near, far);
        Self {
            core: core.expect("the distances are in order"),
            definition: Projection::Orthographic {
                pixels_per_unit: 1.0,
                near: near.to_num(),
                far: far.to_num(),
            },
        }
    }
}

impl Stage<Orthographic> {
    /// A triangle in the middle of the picture, whose corners are in sub-pixels of S8, or up to a
    /// sub-pixel beside these if it is more than 127 pixels from there. Their depths are random.
    pub(super) fn of_triangle(corners: [[i32; 2]; 3], random: &mut Random) -> Self {
        // In quanta of a sub-pixel, or of more.
        let reach = corners.as_flattened().iter().map(|c| c.abs()).max().unwrap_or(0);
        let exponent = (0..).find(|&exponent| reach >> exponent < i32::from(i16::MAX)).unwrap_or(0);
        // y points up in space.
        let position = |[x, y]: [i32; 2]| {
            let z = random.real(-32_000.0, 32_000.0);
            [(x >> exponent) as i16, (-y >> exponent) as i16, z as i16]
        };
        let half = Distance::from_num(128 << exponent);
        Self {
            positions: corners.map(position).to_vec(),
            triangles: vec![[0, 1, 2]],
            scale: Scale::new(1 << 31, exponent - 31 - S8::BITS as i32),
            pose: Pose::IDENTITY,
            eye: Vec3::from_bits([0, 0, half.to_bits() as i32 + 65_536]),
            lens: Lens::orthographic(Distance::ONE, half + half + Distance::ONE),
        }
    }
}

impl<P> Stage<P> {
    /// Draws it into a part of the picture, with a type of depth.
    pub(super) fn draw<S: Subpixel>(&self, part: Rectangle, depth: &'static str) -> Work {
        Work::Draw { scene: self.scene::<S>(), part: area(part), depth }
    }

    /// Its numbers, with positions on the screen of a precision.
    pub(super) fn scene<S: Subpixel>(&self) -> Scene {
        let bits = |length: f64| Distance::saturating_from_num(length).to_bits();
        let (focal_length, [near, far]) = match self.lens.definition {
            Projection::Perspective { focal_length_px, near, far } => {
                (Some(bits(focal_length_px)), [near, far])
            }
            Projection::Orthographic { near, far, .. } => (None, [near, far]),
        };
        Scene {
            subpixel: if S::BITS == S8::BITS { "S8" } else { "S4" },
            positions: self.positions.clone(),
            texture_coordinates: Vec::new(),
            triangles: self.triangles.clone(),
            scale: (self.scale.mantissa(), self.scale.exponent()),
            rotation: self.pose.rotation.rows().map(|row| row.map(|entry| entry.to_bits())),
            translation: self.pose.translation.to_bits(),
            eye: self.eye.to_bits(),
            focal_length,
            range: [near, far].map(bits),
            size: SIZE,
        }
    }
}

impl<P: rasterizer::geometry::Projection> Stage<P> {
    /// Where positions are that the pose has turned, scaled and moved, in world space.
    pub(super) fn in_world(&self) -> Vec<[f64; 3]> {
        let quantum = f64::from(self.scale.mantissa()) * 2f64.powi(self.scale.exponent());
        let quantum = quantum * self.pose.scale.to_num::<f64>();
        let [x, y, z] = numbers(self.pose.translation);
        let place = |position: &[i16; 3]| {
            let [dx, dy, dz] =
                turned(&self.pose.rotation, position.map(|c| f64::from(c) * quantum));
            [x + dx, y + dy, z + dz]
        };
        self.positions.iter().map(place).collect()
    }

    /// The camera in `f64`.
    pub(super) fn definition(&self) -> Definition {
        let [x, y, z] = numbers(self.eye);
        let [width, height] = SIZE.map(f64::from);
        Definition {
            eye: [x, y, z],
            target: [x, y, z - 1.0],
            up: [0.0, 1.0, 0.0],
            projection: self.lens.definition,
            viewport: Viewport { x: 0.0, y: 0.0, width, height },
        }
    }

    /// Where the core places the vertices, in sub-pixels: `None` for those that are clipped. None
    /// at all if it refuses the object.
    pub(super) fn vertices<S: Subpixel>(&self) -> Option<Vec<Option<[i32; 2]>>> {
        self.projected(|object, camera| {
            let mut storage = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; self.positions.len()];
            let projected = object.project(camera, &mut storage).ok()?;
            Some(projected.vertices().iter().map(ScreenVertex::position).collect())
        })
    }

    /// Where the corners lie of what the core draws, in sub-pixels. `None` if it refuses the
    /// object.
    pub(super) fn corners<S: Subpixel>(&self) -> Option<Vec<[i32; 2]>> {
        self.projected(|object, camera| {
            let mut storage = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; self.positions.len()];
            let projected = object.project(camera, &mut storage).ok()?;
            let mut corners = Vec::new();
            let Ok(()) = projected.for_each_triangle(|_, triangle| {
                corners.extend(triangle.iter().filter_map(|corner| corner.position()));
                Ok::<(), Infallible>(())
            });
            Some(corners)
        })
    }

    /// The depths that the core stores in a part of the picture; 0 where nothing is drawn. `None`
    /// if it refuses the object.
    pub(super) fn depths<S: Subpixel, D: StoredDepth>(&self, part: Rectangle) -> Option<Vec<D>> {
        self.projected(|object, camera| {
            let mut storage = vec![ScreenVertex::<S, D, _>::EMPTY; self.positions.len()];
            let projected = object.project(camera, &mut storage).ok()?;
            let pixels = (part.size.width * part.size.height) as usize;
            let (mut color, mut depth) = (vec![Rgb888::BLACK; pixels], vec![D::ZERO; pixels]);
            let frame = Frame::new(&mut color, &mut depth, part);
            let Ok(()) = projected.draw(&mut frame.expect("its buffers have its size"));
            Some(depth)
        })
    }

    fn projected<T>(
        &self,
        with: impl FnOnce(Object<'_, Unlit<Rgb888>, Modes<CullNone>>, &Camera<P>) -> T,
    ) -> T {
        let materials = [Material::new([255; 3], self.triangles.len() as u32)];
        let mesh = Mesh::new_const(Tables {
            positions: Positions::I16(&self.positions),
            scale: self.scale,
            triangles: Triangles::U16(&self.triangles),
            materials: &materials,
            ..Tables::EMPTY
        });
        let viewport = Rectangle::new(Point::zero(), Size::new(SIZE[0], SIZE[1]));
        let camera = Camera::at(self.eye, Rotation::IDENTITY, self.lens.core, viewport);
        let object = Object::new(&mesh, Unlit::new());
        with(
            object.posed(self.pose).culled(CullNone),
            &camera.expect("the viewport is not too large"),
        )
    }
}

/// The square of `side` pixels in the middle of the picture.
pub(super) fn middle(side: u32) -> Rectangle {
    let [x, y] = SIZE.map(|whole| (whole as i32 - side as i32) / 2);
    Rectangle::new(Point::new(x, y), Size::new(side, side))
}

/// The first column and row of a part of the picture, its width and its height.
pub(super) const fn area(part: Rectangle) -> [i32; 4] {
    let Rectangle { top_left, size } = part;
    [top_left.x, top_left.y, size.width as i32, size.height as i32]
}

/// The coordinates of a vector.
pub(super) fn numbers(vector: Vec3) -> [f64; 3] {
    vector.to_bits().map(|c| f64::from(c) / 65_536.0)
}

/// The vector of these coordinates, rounded.
pub(super) fn vector(coordinates: [f64; 3]) -> Vec3 {
    Vec3::from_bits(coordinates.map(|c| (c * 65_536.0).round() as i32))
}

/// A vector turned by a rotation's entries.
pub(super) fn turned(rotation: &Rotation, v: [f64; 3]) -> [f64; 3] {
    let rows = rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
    rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// A random angle.
pub(super) fn angle(random: &mut Random) -> Turn {
    Turn::from_bits(random.real(0.0, 4_294_967_296.0) as u32)
}

/// A rotation about three axes by random angles.
pub(super) fn rotation(random: &mut Random) -> Rotation {
    let [x, y, z] = [(); 3].map(|()| angle(random));
    Rotation::about_z(z) * Rotation::about_x(x) * Rotation::about_y(y)
}

/// A random place that the picture shows at a distance along the axis, in view space: less than
/// `part` of the way from the middle to the sides.
pub(super) fn shown(random: &mut Random, focal_length: f64, distance: f64, part: f64) -> [f64; 3] {
    let [x, y] = SIZE.map(|side| f64::from(side) / 2.0 * part / focal_length * distance);
    [random.real(-x, x), random.real(-y, y), -distance]
}

/// How far a place in sub-pixels lies from an exact one in pixels, in sub-pixels along x or y.
pub(super) fn distance<S: Subpixel>(place: [i32; 2], exact: [f64; 2]) -> f64 {
    let unit = f64::from(1 << S::BITS);
    (0..2).map(|i| (f64::from(place[i]) - exact[i] * unit).abs()).fold(0.0, f64::max)
}

/// A quantum of this length, to 32 bits.
pub(super) fn scale(length: f64) -> Scale {
    let exponent = length.log2().floor() as i32 - 31;
    Scale::new((length * 2f64.powi(-exponent)).round() as u32, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_has_its_corners_on_the_screen() {
        let corners = [[-7_000, 12], [3, -9_111], [256, 8_000]];
        let placed = Stage::of_triangle(corners, &mut Random(1)).vertices::<S8>().unwrap();
        let middle = SIZE.map(|side| side as i32 / 2 * 256);
        let expected = corners.map(|[x, y]| Some([middle[0] + x, middle[1] + y]));
        assert_eq!(placed, expected);
        // In quanta of two sub-pixels.
        let wide = [[-40_000, 1], [3, -9_111], [256, 8_001]];
        let placed = Stage::of_triangle(wide, &mut Random(1)).vertices::<S8>().unwrap();
        for (place, [x, y]) in placed.into_iter().zip(wide) {
            let [dx, dy] =
                place.map(|place| [place[0] - middle[0] - x, place[1] - middle[1] - y]).unwrap();
            assert!(dx.abs() <= 1 && dy.abs() <= 1, "{dx} {dy}");
        }
    }
}
