//! Random objects, lamps and eyes, for the tests of light.

use super::{Lamp, Level, textured::square::screen};
use crate::{
    camera::{Camera, Distance, Perspective},
    geometry::{ObjectView, Pose},
    mesh::{Material, Mesh, Positions, Tables, Triangles},
    numbers::{Rotation, Scale, Turn, Vec3, unit},
    random::Random,
};

/// A mesh somewhere, a lamp and an eye, by random numbers, with the same in `f64`.
pub(super) struct Scene {
    pub(super) positions: [[i16; 3]; 3],
    scale: Scale,
    offset: Vec3,
    pose: Pose,
    pub(super) camera: Camera,
    pub(super) lamp: Lamp,
}

pub(super) type V = [f64; 3];

pub(super) fn f64s(v: Vec3) -> V {
    v.to_bits().map(|c| f64::from(c) / 65_536.0)
}

pub(super) fn minus(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn unit_f64(v: V) -> V {
    let length = dot(v, v).sqrt();
    v.map(|c| c / length)
}

impl Scene {
    pub(super) fn new(random: &mut Random, near: bool) -> Self {
        let mut real = |reach: f64| ((random.bits() >> 11) as f64 / 2f64.powi(52) - 1.0) * reach;
        let bits = 4 + (real(5.999) + 6.0) as u32;
        let most = f64::from((1i32 << bits) - 1);
        let positions = [(); 3].map(|()| [(); 3].map(|()| real(most) as i16));
        // From a 50th of a unit to 200 units wide.
        let size = 2f64.powf(real(6.5) + 1.0);
        let quantum = size / most;
        let scale = Scale::new((quantum * 2f64.powi(40)) as u32, -40);
        let vector = |v: V| Vec3::from_bits(v.map(|c| (c * 65_536.0) as i32));
        let offset = vector([(); 3].map(|()| real(4.0 * size)));
        let pose_scale = 2f64.powf(real(4.0));
        let rotation = Rotation::about_x(Turn::from_bits(real(2e9) as i32 as u32))
            * Rotation::about_y(Turn::from_bits(real(2e9) as i32 as u32));
        let pose = Pose::rotated(rotation)
            .at(vector([(); 3].map(|()| real(300.0))))
            .scaled(Distance::from_num(pose_scale));
        let reach = if near { size * pose_scale } else { 15_000.0 };
        let lens = const {
            match Perspective::new(Turn::degrees(60), Distance::ONE, Distance::MAX) {
                Ok(lens) => lens,
                Err(_) => panic!(),
            }
        };
        let mut scene = Self {
            positions,
            scale,
            offset,
            pose,
            camera: Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, screen()).unwrap(),
            lamp: Lamp::new(Vec3::ZERO, Distance::ONE, Level::ONE),
        };
        let around = scene.world(positions[0]);
        let mut place = || {
            let place = vector(around.map(|c| c + real(reach)));
            Vec3::from_bits(place.to_bits())
        };
        let (lamp, eye) = (place(), place());
        let half = Distance::from_num((reach * 2f64.powf(real(4.0))).clamp(0.001, 60_000.0));
        scene.lamp = Lamp::new(lamp, half, Level::from_num(0.5 + real(0.5)));
        scene.camera = Camera::at(eye, Rotation::IDENTITY, lens, screen()).unwrap();
        scene
    }

    pub(super) fn size(&self) -> f64 {
        let scale = f64::from(self.scale.mantissa()) * 2f64.powi(self.scale.exponent());
        let most = self.positions.as_flattened().iter().map(|c| c.unsigned_abs()).max();
        scale * f64::from(most.unwrap()) * self.pose.scale.to_num::<f64>()
    }

    pub(super) fn turned(&self, v: V) -> V {
        let rows =
            self.pose.rotation.to_bits().map(|row| row.map(|c| f64::from(c) / 2f64.powi(30)));
        rows.map(|row| dot(row, v))
    }

    pub(super) fn world(&self, position: [i16; 3]) -> V {
        let scale = f64::from(self.scale.mantissa()) * 2f64.powi(self.scale.exponent());
        let offset = f64s(self.offset);
        let model = [0, 1, 2].map(|i| offset[i] + scale * f64::from(position[i]));
        let turned = self.turned(model.map(|c| c * self.pose.scale.to_num::<f64>()));
        let translation = f64s(self.pose.translation);
        [0, 1, 2].map(|i| turned[i] + translation[i])
    }

    /// Calls `check` with what the core sees.
    pub(super) fn seen(&self, check: impl FnOnce(&ObjectView<'_>)) {
        let mesh = Mesh::new(Tables {
            positions: Positions::I16(&self.positions),
            scale: self.scale,
            offset: self.offset,
            triangles: Triangles::U8(&[[0, 1, 2]]),
            materials: const { &[Material::new([1; 3], 1)] },
            ..Tables::EMPTY
        })
        .unwrap();
        check(&ObjectView::new(&mesh, &self.pose, &self.camera));
    }
}

pub(super) fn random_normal(random: &mut Random) -> [i8; 3] {
    let v = [(); 3].map(|()| (random.bits() >> 33) as i64 - (1 << 30));
    unit(v).unwrap().map(|c| ((i64::from(c) * 127 + (1 << 29)) >> 30) as i8)
}
