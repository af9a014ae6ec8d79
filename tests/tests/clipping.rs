//! Surfaces that cross the near plane, the far plane and the guard band: they are cut without a gap
//! and without an overlap, and what remains lies where geometry puts it.

use embedded_graphics::primitives::Rectangle;
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::{CullBack, CullFront, Pose},
    numbers::{Rotation, S4, S8, Scale, Subpixel, Turn, Vec3},
};
use rasterizer_tests::{
    Random, Scene, Surface, area,
    exact::{numbers, rotated},
    pixel_camera,
};

const VIEWPORT: Rectangle = area(0, 0, 160, 120);
const FOCAL: f64 = 100.0;

fn turned(degrees: [u32; 3]) -> Rotation {
    let [x, y, z] = degrees.map(Turn::degrees);
    Rotation::about_z(z) * Rotation::about_y(y) * Rotation::about_x(x)
}

fn camera(
    eye: Vec3,
    rotation: Rotation,
    near: &str,
    far: &str,
    viewport: Rectangle,
) -> Camera<Perspective> {
    let distance = |text: &str| text.parse::<Distance>().unwrap();
    let lens =
        Perspective::with_focal_length(Distance::from_num(FOCAL), distance(near), distance(far))
            .unwrap();
    Camera::at(eye, rotation, lens, viewport).unwrap()
}

/// The ray through a place of the picture, to z = 1, in view space (right, up, away).
fn ray(viewport: Rectangle, x: f64, y: f64) -> [f64; 3] {
    let [width, height] = [viewport.size.width, viewport.size.height].map(f64::from);
    [(x - width / 2.0) / FOCAL, (height / 2.0 - y) / FOCAL, 1.0]
}

/// A ray of view space in world space.
fn turn(rotation: &Rotation, [right, up, away]: [f64; 3]) -> [f64; 3] {
    rotated(rotation, [right, up, -away])
}

/// The net number of layers over each pixel where it is certain. `layers` returns the number for
/// the ray through a place, or `None` if it is too close to call. A pixel is certain if all places
/// within one and a half pixels agree.
fn certain(viewport: Rectangle, layers: impl Fn(f64, f64) -> Option<i32>) -> Vec<Option<i32>> {
    let [width, height] = [viewport.size.width, viewport.size.height];
    let places =
        (0..height).flat_map(|y| (0..width).map(move |x| (f64::from(x) + 0.5, f64::from(y) + 0.5)));
    places
        .map(|(x, y)| {
            let around = [(0.0, 0.0), (1.5, 0.0), (-1.5, 0.0), (0.0, 1.5), (0.0, -1.5)];
            let mut found = around.iter().map(|(dx, dy)| layers(x + dx, y + dy));
            let first = found.next()?;
            if found.all(|other| other == first) { first } else { None }
        })
        .collect()
}

/// Compares the net number of layers with the certain ones. Returns how many of these are not 0.
fn agree<S: Subpixel>(
    scene: &Scene<'_, Perspective>,
    certain: &[Option<i32>],
    name: &str,
) -> usize {
    let viewport = scene.camera.viewport();
    let net = scene.net::<S>(viewport);
    for (index, (net, certain)) in net.iter().zip(certain).enumerate() {
        let width = viewport.size.width as usize;
        if let Some(certain) = certain {
            assert_eq!(net, certain, "{name}: ({}, {})", index % width, index / width);
        }
    }
    certain.iter().flatten().filter(|&&layers| layers != 0).count()
}

/// The same for a surface whose layers all face the camera. Rounding turns no triangle over, so
/// each pixel is drawn once per layer.
fn draws<S: Subpixel>(
    scene: &Scene<'_, Perspective>,
    certain: &[Option<i32>],
    name: &str,
) -> usize {
    let back = scene.count::<S, CullFront>(scene.camera.viewport());
    let is_folded = |(&count, certain): (&u32, &Option<i32>)| certain.is_some() && count != 0;
    assert!(!back.counts().iter().zip(certain).any(is_folded), "{name}: back faces");
    agree::<S>(scene, certain, name)
}

/// A square of 10,000 units in the plane y = 0, in 2 and in 512 triangles. The camera stands on it,
/// hovers over it, and looks along it.
#[test]
fn ground_is_covered_once_up_to_the_horizon() {
    const HALF: f64 = 5000.0;
    let mut covered = 0;
    for cells in [1, 16] {
        let mut random = Random::new(7);
        let half = 1 << 14;
        // Built in the plane z = 0, and laid down by the pose.
        let mut ground = Surface::sheet([-half, half], [-half, half], [cells; 2], &mut random);
        ground.scale = Scale::new(5000, -14);
        let mesh = ground.mesh();
        let lie = Pose::rotated(Rotation::about_x(-Turn::QUARTER));
        for (height, near) in
            [("1.5", "0.1"), ("0.04", "0.032"), ("300", "1"), ("1.5", "20"), ("4000", "0.1")]
        {
            for degrees in [
                [0, 0, 0],
                [0, 33, 0],
                [0, 0, 17],
                [345, 120, 0],
                [20, 200, 45],
                [270, 10, 0],
                [0, 0, 180],
            ] {
                let rotation = turned(degrees);
                let eye = Vec3::lit("12.5", height, "-7");
                let [x, y, z] = numbers(eye);
                let near_distance: f64 = near.parse().unwrap();
                let certain = certain(VIEWPORT, |px, py| {
                    let way = turn(&rotation, ray(VIEWPORT, px, py));
                    let depth = -y / way[1];
                    let [across, along] = [x + depth * way[0], z + depth * way[2]];
                    let is_met = depth > near_distance && across.abs() < HALF && along.abs() < HALF;
                    Some(i32::from(is_met))
                });
                let scene = Scene {
                    pose: lie,
                    ..Scene::new(&mesh, camera(eye, rotation, near, "65535", VIEWPORT))
                };
                let name = format!("{cells} cells, height {height}, {degrees:?}");
                // Too large for S4 in most of these views.
                if scene.is_accepted::<S4>() {
                    covered += draws::<S4>(&scene, &certain, &name);
                }
                covered += draws::<S8>(&scene, &certain, &name);
            }
        }
    }
    assert!(covered > 400_000, "{covered}");
}

/// A plane seen exactly edge-on has no area.
#[test]
fn ground_at_eye_level_draws_nothing() {
    let mut random = Random::new(8);
    let ground =
        Surface::sheet([-16_000, 16_000], [-16_000, 16_000], [16, 16], &mut random).scaled(-1);
    let mesh = ground.mesh();
    let pose = Pose::rotated(Rotation::about_x(-Turn::QUARTER));
    for degrees in [[0, 0, 0], [0, 90, 0], [0, 33, 0]] {
        let scene = Scene {
            pose,
            ..Scene::new(&mesh, camera(Vec3::ZERO, turned(degrees), "0.1", "65535", VIEWPORT))
        };
        for counts in
            [scene.count::<S8, CullBack>(VIEWPORT), scene.count::<S8, CullFront>(VIEWPORT)]
        {
            assert!(counts.counts().iter().all(|&count| count == 0), "{degrees:?}");
        }
    }
}

/// The scene of `dEQP-GLES2.functional.clipping.polygon_edge.poly_fan`: 240 triangles whose rim
/// lies far outside all six planes. Every ray meets each plane through the picture's middle unless
/// it points away from it.
#[test]
fn fans_through_all_planes_are_covered_once() {
    let at = |i: i32| {
        let angle = f64::from(i) / 240.0 * std::f64::consts::TAU;
        [(30_000.0 * angle.cos()) as i16, (30_000.0 * angle.sin()) as i16, 0]
    };
    let rim: Vec<_> = (0..240).map(at).collect();
    let mut covered = 0;
    for hub in [[0, 0, 0], [11, -7, 0], [9000, 100, 0]] {
        let fan = Surface::fan(hub, &rim);
        let mesh = fan.mesh();
        for degrees in [[0, 0, 0], [60, 0, 0], [0, 89, 3], [271, 5, 9], [45, 45, 45]] {
            for (near, far) in [("0.1", "65535"), ("3.9", "65535"), ("1", "9")] {
                let rotation = turned(degrees);
                let certain = certain(VIEWPORT, |px, py| {
                    // The camera stands 4 units before the plane z = 0.
                    let way = turn(&rotation, ray(VIEWPORT, px, py));
                    let depth = -4.0 / way[2];
                    let reach = (depth * way[0]).hypot(depth * way[1]);
                    let planes = [near, far].map(|text| text.parse::<f64>().unwrap());
                    // The rim's chords come within 3 units of the circle.
                    Some(i32::from(depth > planes[0] && depth < planes[1] && reach < 29_990.0))
                });
                let eye = Vec3::lit("0", "0", "4");
                let scene = Scene::new(&mesh, camera(eye, rotation, near, far, VIEWPORT));
                let name = format!("{hub:?} {degrees:?} {near} {far}");
                // Too large for S4 in most of these views.
                if scene.is_accepted::<S4>() {
                    covered += draws::<S4>(&scene, &certain, &name);
                }
                covered += draws::<S8>(&scene, &certain, &name);
            }
        }
    }
    assert!(covered > 400_000, "{covered}");
}

/// From inside a convex body every ray leaves it once, through a back face. The bodies are cubes
/// 20,000 units wide of 12 and of 3,072 triangles, and balls.
#[test]
fn bodies_surround_the_camera() {
    for (name, body) in [
        ("coarse cube", Surface::cube(10_000, 1)),
        ("fine cube", Surface::cube(10_000, 16)),
        ("coarse ball", Surface::ball(10_000, 3)),
        ("fine ball", Surface::ball(10_000, 16)),
        ("small ball", Surface::ball(10_000, 16).scaled(-13)),
    ] {
        let is_small = name == "small ball";
        let mesh = body.mesh();
        for degrees in [[0, 0, 0], [45, 45, 0], [90, 0, 0], [10, 123, 77]] {
            for eye in [["0", "0", "0"], ["0.3", "-0.2", "0.4"], ["3000", "-2999", "1234.5"]] {
                let [x, y, z] = eye;
                let eye = Vec3::lit(x, y, z);
                if is_small && x == "3000" {
                    continue;
                }
                let scene =
                    Scene::new(&mesh, camera(eye, turned(degrees), "0.05", "40000", VIEWPORT));
                let name = format!("{name} {degrees:?} {x}");
                // S4 has the range for the small ball alone.
                if is_small {
                    assert!(scene.net::<S4>(VIEWPORT).iter().all(|&layers| layers == -1), "{name}");
                }
                assert!(scene.net::<S8>(VIEWPORT).iter().all(|&layers| layers == -1), "{name}");
            }
        }
    }
}

/// The near plane and the far plane cut balls open. A ray that is inside the ball at the near plane
/// only meets a back face, one that is inside at the far plane only meets a front face.
#[test]
fn planes_cut_balls_open() {
    let ball = Surface::ball(16_384, 24).scaled(-14);
    let mesh = ball.mesh();
    let mut open = 0;
    for (distance, near, far) in [
        ("1.2", "0.9", "100"),
        ("1.2", "1.2", "100"),
        ("3", "0.1", "2.9"),
        ("3", "2.8", "3.3"),
        ("0.5", "0.01", "1"),
        ("3", "0.1", "1.9"),
        ("3", "4.1", "9"),
    ] {
        let [eye, near_distance, far_distance] =
            [distance, near, far].map(|text| text.parse::<f64>().unwrap());
        let certain = certain(VIEWPORT, |px, py| {
            let way = ray(VIEWPORT, px, py);
            // Whether the ray is inside the ball at a plane's depth. The facets, an eighteenth
            // across from edge to edge, lie within half a per cent of the sphere.
            let is_inside = |depth: f64| {
                let radius = (way[0] * depth).hypot(way[1] * depth).hypot(eye - depth);
                (!(0.995..=1.0).contains(&radius)).then_some(radius < 1.0)
            };
            match (is_inside(near_distance)?, is_inside(far_distance)?) {
                (true, false) => Some(-1),
                (false, true) => Some(1),
                _ => Some(0),
            }
        });
        let scene = Scene::new(
            &mesh,
            camera(Vec3::lit("0", "0", distance), Rotation::IDENTITY, near, far, VIEWPORT),
        );
        let name = format!("from {distance}, {near} to {far}");
        open += agree::<S4>(&scene, &certain, &name);
        open += agree::<S8>(&scene, &certain, &name);
    }
    assert!(open > 20_000, "{open}");
}

/// Sheets 65,535 pixels wide: the guard band cuts them on all sides, and the whole of the largest
/// viewport is covered.
#[test]
fn sheets_beyond_the_guard_band_are_covered_once() {
    let mut random = Random::new(9);
    for cells in [1, 3, 31, 64] {
        let sheet =
            Surface::sheet([i16::MIN, i16::MAX], [i16::MIN, i16::MAX], [cells; 2], &mut random);
        let mesh = sheet.mesh();
        for viewport in
            [area(0, 0, 2048, 2048), area(-3, 7, 1, 2048), area(0, 0, 320, 240), area(5, 5, 1, 1)]
        {
            let scene = Scene::new(&mesh, pixel_camera(viewport));
            assert!(
                scene.net::<S4>(viewport).iter().all(|&layers| layers == 1),
                "{cells} {viewport:?}"
            );
            assert!(
                scene.net::<S8>(viewport).iter().all(|&layers| layers == 1),
                "{cells} {viewport:?}"
            );
        }
    }
}
