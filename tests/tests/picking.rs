//! Points of the world on the screen, and pixels as rays into the world, against f64 and against
//! the vertices that the rasterizer places.

use embedded_graphics::{geometry::Point, pixelcolor::Rgb888};
use rasterizer::{
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{Plane, Pose, Projection, ScreenVertex},
    numbers::{Rotation, S8, Scalar, Turn, Vec3},
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{
    Random, Surface, area,
    exact::{Lens, numbers, rotated},
    vector::{Vector, dot},
};

const NEAR: Distance = Distance::lit("0.5");
const FAR: Distance = Distance::lit("500");

fn place(random: &mut Random, reach: i32) -> Vec3 {
    Vec3::from_bits([(); 3].map(|()| random.within(-reach << 16, reach << 16)))
}

/// A camera anywhere, its rotation, and its lens in f64.
struct View<P> {
    camera: Camera<P>,
    rotation: Rotation,
    lens: Lens,
}

impl<P: Projection> View<P> {
    fn new(random: &mut Random, lens: P, exact: impl Fn(f64) -> Lens) -> Self {
        let mut angle = || Turn::from_bits(random.bits() as u32);
        let rotation = Rotation::about_y(angle()) * Rotation::about_x(angle());
        let rotation = rotation * Rotation::about_z(angle());
        let size = [random.within(1, 2000), random.within(100, 2000)].map(|c| c as u32);
        let viewport = area(random.within(-99, 99), random.within(-99, 99), size[0], size[1]);
        let camera = Camera::at(place(random, 100), rotation, lens, viewport).unwrap();
        Self { camera, rotation, lens: exact(f64::from(size[1])) }
    }

    /// Right, down and ahead of the camera, of a direction.
    fn along(&self, v: Vector) -> Vector {
        let [x, y, z] = rotated(&self.rotation.inverse(), v);
        [x, -y, -z]
    }

    fn middle(&self) -> [f64; 2] {
        let viewport = self.camera.viewport();
        let (corner, size) = (viewport.top_left, viewport.size);
        [
            f64::from(corner.x) + f64::from(size.width) / 2.0,
            f64::from(corner.y) + f64::from(size.height) / 2.0,
        ]
    }

    /// Checks where a point lies; returns whether it is on the screen.
    fn judge_place(&self, point: Vec3) -> bool {
        let (p, eye) = (numbers(point), numbers(self.camera.eye()));
        let [x, y, z] = self.along([0, 1, 2].map(|i| p[i] - eye[i]));
        let w = if self.lens.is_perspective { z } else { 1.0 };
        let [px, py] = [x, y].map(|c| c / w * self.lens.magnification);
        let inside = |margin: f64| {
            z > self.lens.near + margin
                && z < self.lens.far - margin
                && px.abs() < 1024.0 - margin
                && py.abs() < 1024.0 - margin
        };
        let Some(got) = self.camera.place_on_screen(point) else {
            assert!(!inside(1e-3), "{point:?} is on the screen: {px} {py} {z}");
            return false;
        };
        assert!(inside(-1e-3), "{point:?} is not on the screen: {px} {py} {z}");
        let middle = self.middle();
        for (got, want) in [(got.x, px + middle[0]), (got.y, py + middle[1])] {
            let got: f64 = got.to_num();
            assert!((got - want).abs() < 2f64.powi(-15), "{point:?}: {got} {want}");
        }
        let depth = if self.lens.is_perspective {
            self.lens.near / z
        } else {
            (self.lens.far - z) / (self.lens.far - self.lens.near)
        };
        assert!((got.depth.to_num::<f64>() - depth).abs() < 2f64.powi(-28), "{point:?}: {depth}");
        true
    }

    /// Checks the ray of a pixel.
    fn judge_ray(&self, pixel: Point) {
        let ray = self.camera.ray(pixel);
        let middle = self.middle();
        let [x, y] = [f64::from(pixel.x) + 0.5 - middle[0], f64::from(pixel.y) + 0.5 - middle[1]]
            .map(|c| c / self.lens.magnification);
        let direction = self.along(ray.direction.map(|c| c.to_num::<f64>()));
        let eye = numbers(self.camera.eye());
        let origin = numbers(ray.origin);
        let beside = self.along([0, 1, 2].map(|i| origin[i] - eye[i]));
        let (want, place) = if self.lens.is_perspective {
            let length = (x * x + y * y + 1.0).sqrt();
            ([x / length, y / length, 1.0 / length], [0.0; 3])
        } else {
            ([0.0, 0.0, 1.0], [x, y, 0.0])
        };
        for i in 0..3 {
            assert!((direction[i] - want[i]).abs() < 2f64.powi(-26), "{direction:?} {want:?}");
            let bound = 2f64.powi(-15) + 2f64.powi(-26) * (x.abs() + y.abs());
            assert!((beside[i] - place[i]).abs() < bound, "{beside:?} {place:?}");
        }
    }
}

fn perspective(random: &mut Random) -> View<Perspective> {
    let focal = Distance::from_bits(random.within(50 << 16, 3000 << 16) as u32);
    let lens = Perspective::with_focal_length(focal, NEAR, FAR).unwrap();
    View::new(random, lens, |_| Lens::perspective(&lens, focal.to_num()))
}

fn orthographic(random: &mut Random) -> View<Orthographic> {
    let height = Distance::from_bits(random.within(1 << 16, 300 << 16) as u32);
    let lens = Orthographic::new(height, NEAR, FAR).unwrap();
    View::new(random, lens, |height| Lens::orthographic(&lens, height))
}

#[test]
fn points_lie_where_they_should() {
    let mut random = Random::new(81);
    let mut seen = [0; 2];
    for _ in 0..50_000 {
        let (a, b) = (perspective(&mut random), orthographic(&mut random));
        let point = place(&mut random, 200);
        seen[0] += usize::from(a.judge_place(point));
        seen[1] += usize::from(b.judge_place(point));
    }
    assert!(seen.iter().all(|&count| count > 2000), "{seen:?}");
}

#[test]
fn rays_go_through_their_pixels() {
    let mut random = Random::new(82);
    for _ in 0..20_000 {
        let (a, b) = (perspective(&mut random), orthographic(&mut random));
        let pixel = Point::new(random.within(-999, 2999), random.within(-999, 2999));
        a.judge_ray(pixel);
        b.judge_ray(pixel);
        // A point of the ray lies on the pixel's centre, as exactly as it is rounded: along each of
        // the camera's axes by the root of 3 times half a 65,536th, and the ray's own error.
        let (ray, way) = (a.camera.ray(pixel), Scalar::lit("40"));
        if let Some(place) = a.camera.place_on_screen(ray.at(way)) {
            let z = 40.0 * a.along(ray.direction.map(|c| c.to_num::<f64>()))[2];
            let got = [place.x, place.y].map(|c| c.to_num::<f64>() - 0.5);
            let want = [pixel.x, pixel.y].map(f64::from);
            for i in 0..2 {
                let focal = a.lens.magnification;
                let slope = (want[i] + 0.5 - a.middle()[i]).abs() / focal;
                let bound = focal / z * (1.0 + slope) * 2f64.powi(-16) + 2f64.powi(-15);
                assert!((got[i] - want[i]).abs() < bound, "{got:?} {want:?} {z}");
            }
        }
    }
}

/// Where a vertex is drawn is where a label for it goes: within half a sub-pixel for snapping, and
/// an eighth.
#[test]
fn labels_lie_on_the_vertices_that_are_drawn() {
    let mut random = Random::new(83);
    let (mut judged, mut deep) = (0, 0);
    for _ in 0..5000 {
        let view = perspective(&mut random);
        let point = place(&mut random, 100);
        let surface = Surface::new(vec![[0, 0, 0]; 3], vec![[0, 1, 2]]);
        let mesh = surface.mesh();
        let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(Pose::IDENTITY.at(point));
        let mut storage = [ScreenVertex::<S8, u32, _>::EMPTY; 3];
        let projected = object.project(&view.camera, &mut storage).unwrap();
        let Some(vertex) = projected.vertices().first() else { continue };
        let Some(drawn) = vertex.position() else { continue };
        let place = view.camera.place_on_screen(point).expect("it is on the screen");
        for (got, drawn) in [place.x, place.y].into_iter().zip(drawn) {
            let apart = got.to_num::<f64>() * 256.0 - f64::from(drawn);
            assert!(apart.abs() < 0.625 + 0.01, "{got} {drawn}");
        }
        let apart = place.depth.to_num::<f64>() - f64::from(vertex.depth()) / 2f64.powi(32);
        assert!(apart.abs() < 2f64.powi(-24), "{apart}");
        judged += 1;
        deep += usize::from(vertex.depth() > 1 << 24);
    }
    assert!(judged > 200 && deep > 50, "{judged} {deep}");
}

#[test]
fn rays_meet_planes_where_they_should() {
    let mut random = Random::new(84);
    let (mut met, mut missed) = (0, 0);
    for _ in 0..20_000 {
        let view = perspective(&mut random);
        let ray = view.camera.ray(Point::new(random.within(0, 999), random.within(0, 999)));
        let normal = place(&mut random, 3);
        let plane = Plane::new(normal, Scalar::from_bits(random.within(-50 << 16, 50 << 16)));
        let (n, o) = (numbers(normal), numbers(ray.origin));
        let d = ray.direction.map(|c| c.to_num::<f64>());
        let length = dot(n, n).sqrt();
        let sine = dot(n, d) / length;
        if sine.abs() < 0.01 {
            continue;
        }
        let way = -(dot(n, o) + plane.offset.to_num::<f64>()) / dot(n, d);
        let want = [0, 1, 2].map(|i| o[i] + way * d[i]);
        let is_in_range = want.iter().all(|c| c.abs() < 32_000.0);
        match ray.meets(&plane) {
            None => {
                assert!(way < 1e-3 || !is_in_range, "{way} {want:?}");
                missed += 1;
            }
            Some(got) => {
                assert!(way > -1e-3, "{way}");
                let bound = (2f64.powi(-15) + 2f64.powi(-26) * (way + 200.0)) / sine.abs();
                for (got, want) in numbers(got).into_iter().zip(want) {
                    assert!((got - want).abs() < bound, "{got} {want} {sine}");
                }
                met += 1;
            }
        }
    }
    assert!(met > 5000 && missed > 5000, "{met} {missed}");
    let level = Plane::new(Vec3::Y, Scalar::ZERO);
    let camera = perspective(&mut random).camera;
    let along = rasterizer::geometry::Ray {
        direction: Rotation::IDENTITY.rows()[0],
        ..camera.ray(Point::zero())
    };
    assert_eq!(along.meets(&level), None);
}
