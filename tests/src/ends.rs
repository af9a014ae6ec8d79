//! Random scenes from the ends of every range: positions, scales, poses, cameras and viewports.

use embedded_graphics::primitives::Rectangle;
use rasterizer::{
    camera::{Camera, Distance, MAX_VIEWPORT_OFFSET, Orthographic, Perspective},
    geometry::Pose,
    numbers::{Rotation, Scale, Turn, Vec3},
};

use crate::{Random, Surface, area};

const COORDINATES: [i16; 11] =
    [i16::MIN, i16::MIN + 1, -16_384, -255, -1, 0, 1, 2, 4096, i16::MAX - 1, i16::MAX];
/// In 65,536ths.
const PLACES: [i32; 11] =
    [i32::MIN, i32::MIN + 1, -(1 << 30), -(3 << 16), -1, 0, 1, 1 << 15, 5 << 16, 1 << 24, i32::MAX];
/// In 65,536ths.
const DISTANCES: [u32; 10] =
    [1, 2, 3, 700, 6553, 1 << 16, 3 << 16, 1000 << 16, u32::MAX - 1, u32::MAX];

const fn coordinate(random: &mut Random) -> i16 {
    if random.coin() { random.pick(&COORDINATES) } else { random.bits() as i16 }
}

/// A point at an end of the range, on an axis, or of any magnitude.
#[must_use]
pub fn place(random: &mut Random) -> Vec3 {
    let range = random.within(0, 31);
    Vec3::from_bits([(); 3].map(|()| match random.within(0, 3) {
        0 => random.pick(&PLACES),
        1 => 0,
        _ => random.bits() as i32 >> range,
    }))
}

const fn angle(random: &mut Random) -> Turn {
    if random.coin() {
        Turn::from_bits((random.bits() as u32 >> 29) << 29)
    } else {
        Turn::from_bits(random.bits() as u32)
    }
}

/// Any rotation.
pub fn rotation(random: &mut Random) -> Rotation {
    Rotation::about_z(angle(random))
        * Rotation::about_x(angle(random))
        * Rotation::about_y(angle(random))
}

/// A few triangles on a few vertices, some of them without area.
fn surface(random: &mut Random) -> Surface {
    let vertices = random.within(1, 7);
    let (is_flat, range) = (random.coin(), random.within(0, 15));
    let positions = (0..vertices).map(|_| {
        let z = if is_flat { 0 } else { coordinate(random) };
        [coordinate(random), coordinate(random), z].map(|c| c >> range)
    });
    let positions = positions.collect();
    let triangles =
        (0..random.within(1, 5)).map(|_| [(); 3].map(|()| random.within(0, vertices - 1) as u16));
    let mut surface = Surface::new(positions, triangles.collect());
    let mantissa = random.pick(&[1, 1 << 31, u32::MAX, 0xABCD_EF01]);
    let exponent = if random.coin() { random.within(-40, 15) } else { random.within(-16, 0) };
    // A quantum of 2^-40 to nearly 2^16 units.
    surface.scale = Scale::new(mantissa | 1 << 31, exponent - 31);
    surface.offset = place(random);
    surface
}

fn pose(random: &mut Random) -> Pose {
    let scale = match random.within(0, 3) {
        0 => random.pick(&[0, 1, 2, 65_535, 1 << 16, u32::MAX]),
        1 => random.bits() as u32,
        _ => 1 << 16,
    };
    let pose = Pose::rotated(rotation(random)).scaled(Distance::from_bits(scale));
    pose.at(place(random))
}

/// A viewport of any shape, at the origin, at an end of the offsets or anywhere in between.
#[must_use]
pub fn viewport(random: &mut Random) -> Rectangle {
    let mut side = || random.pick(&[1u32, 2, 3, 17, 64, 240, 320, 2047, 2048]);
    let [width, height] = [side(), side()];
    let mut corner = || match random.within(0, 3) {
        0 => random.pick(&[-MAX_VIEWPORT_OFFSET, -1, 1, MAX_VIEWPORT_OFFSET]),
        1 => random.within(-MAX_VIEWPORT_OFFSET, MAX_VIEWPORT_OFFSET),
        _ => 0,
    };
    area(corner(), corner(), width, height)
}

/// A distance over 0, at an end of the range or of any magnitude.
#[must_use]
pub fn distance(random: &mut Random) -> Distance {
    let bits = if random.coin() {
        random.pick(&DISTANCES)
    } else {
        random.bits() as u32 >> random.within(0, 31)
    };
    Distance::from_bits(bits.max(1))
}

/// The distances of a near plane and of a far plane beyond it.
#[must_use]
pub fn depth_range(random: &mut Random) -> [Distance; 2] {
    loop {
        let [near, far] = [distance(random), distance(random)];
        if near < far {
            return [near, far];
        }
    }
}

/// A lens with a field of view from a thousandth of a degree to just under half a turn, or with any
/// focal length from 1 / 65,536 to 65,535.
///
/// # Panics
///
/// Never panics: all of these values are valid.
#[must_use]
pub fn perspective(random: &mut Random) -> Perspective {
    let [near, far] = depth_range(random);
    if random.coin() {
        let degree = u32::MAX / 360;
        let field = random.pick(&[
            degree / 1000,
            degree,
            40 * degree,
            90 * degree,
            179 * degree,
            (1 << 31) - 2,
        ]);
        Perspective::new(Turn::from_bits(field), near, far).unwrap()
    } else {
        Perspective::with_focal_length(distance(random), near, far).unwrap()
    }
}

/// A lens for a parallel projection, of any height.
///
/// # Panics
///
/// Never panics: all of these values are valid.
#[must_use]
pub fn orthographic(random: &mut Random) -> Orthographic {
    let [near, far] = depth_range(random);
    Orthographic::new(distance(random), near, far).unwrap()
}

/// An object, and the place of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// The object's surface.
    pub surface: Surface,
    /// The object's pose.
    pub pose: Pose,
    /// The camera's position.
    pub eye: Vec3,
    /// The camera's rotation.
    pub rotation: Rotation,
}

/// A random stage. In half of them the camera stands in front of the object, so that something is
/// visible.
#[must_use]
pub fn stage(random: &mut Random) -> Stage {
    let (mut surface, pose, rotation) = (surface(random), pose(random), rotation(random));
    let eye = if random.coin() {
        place(random)
    } else {
        surface.offset = Vec3::ZERO;
        let away = (random.bits() as u32 >> random.within(1, 20)) as i32;
        pose.translation + rotation.apply(Vec3::from_bits([0, 0, away]))
    };
    Stage { surface, pose, eye, rotation }
}

impl Stage {
    /// The camera with this lens and viewport.
    ///
    /// # Panics
    ///
    /// Panics if the viewport is invalid.
    #[must_use]
    pub fn camera<P>(&self, lens: P, viewport: Rectangle) -> Camera<P> {
        Camera::at(self.eye, self.rotation, lens, viewport).unwrap()
    }
}
