//! On which side of a plane the viewer is, against f64: right beyond a bound that grows with the
//! square of the distance and with how narrow the triangle of the plane's points is.

use embedded_graphics::pixelcolor::Rgb888;
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{Pose, Projection},
    mesh::{Parts, SeparatingPlane},
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{
    Random, Surface, area, ends,
    exact::{numbers, quantum, rotated},
    vector::{Vector, cross, dot, minus, unit},
};

/// Three points of a plane and what else the mesh has, in quanta, and all of them in the world.
struct Stage {
    surface: Surface,
    points: [[i16; 3]; 3],
    pose: Pose,
    world: Vec<Vector>,
}

impl Stage {
    /// Points over the whole range, or in a small part of it.
    fn new(random: &mut Random) -> Self {
        let ends::Stage { surface, pose, .. } = ends::stage(random);
        let (scale, offset) = (surface.scale, surface.offset);
        let (middles, size) = (random.within(0, 14), random.within(0, 13));
        let middle = [(); 3].map(|()| random.bits() as i16 >> 1 >> middles);
        let points = [(); 3].map(|()| middle.map(|c| c + (random.bits() as i16 >> 1 >> size)));
        let mut positions = points.to_vec();
        let others = random.within(0, 14);
        positions.extend(
            (0..random.within(0, 4)).map(|_| [(); 3].map(|()| random.bits() as i16 >> others)),
        );
        // Both lie in the plane, which lets them: the order of the two is the side.
        let mut surface = Surface::new(positions.clone(), vec![[0, 1, 2], [0, 2, 1]]);
        (surface.scale, surface.offset) = (scale, offset);
        let (size, offset) = (pose.scale.to_num::<f64>(), numbers(offset));
        let world = positions.iter().map(|p| {
            let p = [0, 1, 2].map(|i| (f64::from(p[i]) * quantum(scale) + offset[i]) * size);
            let (p, to) = (rotated(&pose.rotation, p), numbers(pose.translation));
            [0, 1, 2].map(|i| p[i] + to[i])
        });
        let world = world.collect();
        Self { surface, points, pose, world }
    }

    /// Which side the core finds, if it draws the object.
    fn is_in_front<S: Subpixel, P: Projection>(&self, camera: &Camera<P>) -> Option<bool> {
        let mesh = self.surface.mesh();
        let plane = [SeparatingPlane::new(self.points, [0, 1, 2])];
        let parts = Parts::new(&mesh, &[1, 2], &plane).ok()?;
        let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(self.pose);
        let seen = object.project_on_demand::<_, S, NoDepth>(camera, S::default()).ok()?;
        let is_outside = seen.is_outside_view();
        // The part in front is drawn last.
        (!is_outside).then(|| seen.in_parts(&parts).order().parts().last() == Some(0))
    }
}

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

fn sum(a: Vector, b: Vector, times: f64) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i] * times)
}

/// A number between 1 / 2^`bits` and 1, of any magnitude.
fn magnitude(random: &mut Random, bits: i32) -> f64 {
    (-f64::from(random.within(0, bits << 16)) / 65_536.0).exp2()
}

fn distance(length: f64) -> Distance {
    Distance::from_bits(((length * 65_536.0) as u32).clamp(1, 1 << 30))
}

/// A rotation from which a camera looks in this direction.
fn looking(to: Vector) -> Rotation {
    let turn =
        |angle: f64| Turn::from_bits((angle / std::f64::consts::TAU * 2f64.powi(32)) as i64 as u32);
    Rotation::about_y(turn((-to[0]).atan2(-to[2]))) * Rotation::about_x(turn(to[1].asin()))
}

/// Checks the sides on which random viewers are, most of them nearly in the plane.
fn sides_are_exact<S: Subpixel>(seed: u64, is_perspective: bool) {
    let mut random = Random::new(seed);
    let (mut worst, mut close) = (0f64, 0);
    for _ in 0..200_000 {
        let stage = Stage::new(&mut random);
        let [a, b, c] = [0, 1, 2].map(|i| stage.world[i]);
        let normal = cross(minus(b, a), minus(c, a));
        let longest = [minus(b, a), minus(c, b), minus(a, c)].map(length);
        let longest = longest.into_iter().fold(0.0, f64::max);
        // On a line, for f64.
        if length(normal) <= longest * longest * 1e-9 {
            continue;
        }
        let (height, normal) = (length(normal) / longest, unit(normal));
        let farthest_from =
            |eye: Vector| stage.world.iter().map(|&p| length(minus(p, eye))).fold(0.0, f64::max);
        let size = farthest_from(a);
        let along = unit(cross(normal, unit([(); 3].map(|()| f64::from(random.bits() as i32)))));
        let away = size * 4.0 * magnitude(&mut random, 10);
        let tilt = magnitude(&mut random, 30) * if random.coin() { 1.0 } else { -1.0 };
        let eye = sum(sum(a, along, away), normal, away * tilt);
        if eye.iter().any(|c| c.abs() > 32_000.0) {
            continue;
        }
        let eye = Vec3::from_bits(eye.map(|c| (c * 65_536.0).round() as i32));
        let (from, farthest) = (numbers(eye), farthest_from(numbers(eye)));
        // Nearer, f64 is not much better than the core: its world coordinates have 2^-38.
        if farthest < 1.0 / 16.0 || length(minus(a, from)) == 0.0 {
            continue;
        }
        let rotation = looking(unit(minus(a, from)));
        let rows = random.pick(&[47, 240, 1024]);
        let viewport = area(0, 0, rows, rows);
        let [near, far] = [distance(farthest * magnitude(&mut random, 12)), Distance::MAX];
        let (side, found, bound) = if is_perspective {
            let degrees = random.within(20, 100) as u32;
            let lens = Perspective::new(Turn::degrees(degrees), near, far).unwrap();
            let camera = Camera::at(eye, rotation, lens, viewport).unwrap();
            let focal = f64::from(rows) / 2.0 / (f64::from(degrees).to_radians() / 2.0).tan();
            // A coordinate is off by 4 of its units, an edge of the triangle by 8 in each: with
            // edges up to l, the normal by 28 l, and the plane at a distance of d by 28 d / h. All
            // that is in clip space, where d is 2^28 units or more, as no coordinate reaches 2^30,
            // and where x and y, and so h, are f / 1,024 of what they are in the world; what is
            // measured along them is as much more there. 28 x 2^-28 is 2^-23, and a plane that
            // leans both ways has up to four times that.
            let squeezed = (1024.0 / focal).max(1.0);
            let bound = 2f64.powi(-21) * farthest.powi(2) / height * squeezed.powi(2);
            (dot(normal, minus(from, a)), stage.is_in_front::<S, _>(&camera), bound)
        } else {
            let high = distance(size * 4.0 * magnitude(&mut random, 8));
            let lens = Orthographic::new(high, near, far).unwrap();
            let camera = Camera::at(eye, rotation, lens, viewport).unwrap();
            let band = 1024.0 / f64::from(rows) * high.to_num::<f64>();
            // In the same way, with the guard band for w.
            let bound = 2f64.powi(-21) * band.max(size) / height;
            let back = rotated(&rotation, [0.0, 0.0, 1.0]);
            (dot(normal, back), stage.is_in_front::<S, _>(&camera), bound)
        };
        let Some(found) = found else { continue };
        let ratio = side.abs() / bound;
        close += i32::from((1.0..16.0).contains(&ratio));
        if found != (side > 0.0) {
            worst = worst.max(ratio);
        }
    }
    assert!(worst < 1.0, "wrong at {worst} of the bound");
    // Nearer, some are wrong, and enough viewers are near the bound.
    assert!(worst > 0.001 && close > 2000, "{worst} {close}");
}

#[test]
fn sides_in_perspective_are_exact() {
    sides_are_exact::<S4>(61, true);
    sides_are_exact::<S8>(62, true);
}

#[test]
fn sides_in_parallel_are_exact() {
    sides_are_exact::<S4>(63, false);
    sides_are_exact::<S8>(64, false);
}
