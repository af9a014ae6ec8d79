//! Every pixel centre of a surface is drawn exactly once: no gap and no overlap at shared edges,
//! for all places of the vertices, orders of the corners, and planes that cut triangles.
//!
//! Coverage is decided in integers, so the number of draws has no tolerance in these tests.

use std::path::Path;

use embedded_graphics::primitives::Rectangle;
use host_tools::model::{Model, Options};
use rasterizer::{
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{CullBack, CullFront, CullNone, Pose, Projection},
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
};
use rasterizer_tests::{
    Random, Scene, Surface, area, is_closed, other_models, pixel_camera, shipped_models,
};

const VIEWPORT: Rectangle = area(0, 0, 256, 256);

fn turned(degrees: [u32; 3]) -> Rotation {
    let [x, y, z] = degrees.map(Turn::degrees);
    Rotation::about_z(z) * Rotation::about_x(x) * Rotation::about_y(y)
}

/// Rays leave a closed body as often as they enter it. The scene must not be clipped.
fn rays_leave<S: Subpixel, P: Projection>(scene: &Scene<'_, P>, name: &str) -> u32 {
    let viewport = scene.camera.viewport();
    assert!(scene.vertices::<S>().iter().all(Option::is_some), "{name}: clipped");
    let front = scene.count::<S, CullBack>(viewport);
    let back = scene.count::<S, CullFront>(viewport);
    assert_eq!(front.counts(), back.counts(), "{name}");
    assert_eq!(front.counts(), scene.reference::<S, CullBack>(viewport), "{name}: reference");
    front.counts().iter().sum()
}

/// Tests a closed model. Returns false for one that is not closed.
fn closed_model_is_watertight(path: &Path) -> bool {
    let model = Model::load(path, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    let mesh = model.mesh();
    if !is_closed(&mesh) {
        return false;
    }
    let mut layers = 0;
    for (distance, degrees) in
        [("3", [20, 30, 0]), ("1.5", [90, 0, 0]), ("1.5", [181, 77, 13]), ("30", [0, 0, 45])]
    {
        for viewport in [area(0, 0, 320, 240), area(-7, 5, 101, 333)] {
            let lens =
                Perspective::new(Turn::degrees(60), Distance::lit("0.05"), Distance::lit("100"))
                    .unwrap();
            let parallel = Orthographic::new(
                Distance::lit("2.1"),
                Distance::lit("0.05"),
                Distance::lit("100"),
            )
            .unwrap();
            let eye = Vec3::lit("0", "0", distance);
            let perspective = Camera::at(eye, Rotation::IDENTITY, lens, viewport).unwrap();
            let parallel = Camera::at(eye, Rotation::IDENTITY, parallel, viewport).unwrap();
            let pose = Pose::rotated(turned(degrees));
            let scene = Scene { pose, ..Scene::new(&mesh, perspective) };
            layers += rays_leave::<S4, _>(&scene, &model.name);
            layers += rays_leave::<S8, _>(&scene, &model.name);
            let scene = Scene { pose, ..Scene::new(&mesh, parallel) };
            layers += rays_leave::<S4, _>(&scene, &model.name);
            layers += rays_leave::<S8, _>(&scene, &model.name);
        }
    }
    assert!(layers > 100_000, "{}: only {layers} pixels were drawn", model.name);
    true
}

#[test]
fn shipped_models_are_watertight() {
    for path in shipped_models() {
        assert!(closed_model_is_watertight(&path), "{} is not closed", path.display());
    }
}

#[test]
fn other_closed_models_are_watertight() {
    let models = other_models();
    let closed = models.iter().filter(|path| closed_model_is_watertight(path)).count();
    println!("{closed} of {} models are closed", models.len());
}

/// Checks that a surface of sub-pixel positions covers the rectangle from `low` to `high` (x and y
/// in sub-pixels from the middle, y upwards) and no pixel outside it.
fn covers_rectangle<S: Subpixel>(surface: Surface, low: [i32; 2], high: [i32; 2], name: &str) {
    let surface = surface.scaled(-(S::BITS as i32));
    let mesh = surface.mesh();
    let scene = Scene::new(&mesh, pixel_camera(VIEWPORT));
    let counts = scene.count::<S, CullBack>(VIEWPORT);
    let (pixel, middle) = (1 << S::BITS, 128 << S::BITS);
    for y in 0..256 {
        for x in 0..256 {
            let center = [x, y].map(|c| c * pixel + pixel / 2 - middle);
            // Left and upper edge included, right and lower edge not; y downwards.
            let inside = low[0] <= center[0]
                && center[0] < high[0]
                && -high[1] <= center[1]
                && center[1] < -low[1];
            assert_eq!(counts.at(x, y), u32::from(inside), "{name}: ({x}, {y})");
        }
    }
    let back = scene.count::<S, CullFront>(VIEWPORT);
    assert!(back.counts().iter().all(|&count| count == 0), "{name}: back faces");
}

/// Cells of 16 pixels down to a few sub-pixels, with borders on and off pixel centres.
#[test]
fn sheets_cover_their_rectangle_once() {
    fn sheets<S: Subpixel>(seed: u64) {
        let mut random = Random::new(seed);
        let pixel = 1 << S::BITS;
        for [width, height, columns, rows] in [
            [100 * pixel, 90 * pixel, 7, 5],
            [100 * pixel, 90 * pixel, 90, 100],
            [2 * pixel, 3 * pixel, pixel / 4, pixel / 4],
            [2 * pixel, 100 * pixel, pixel / 2, 1],
            [100 * pixel, pixel, 3, pixel],
            [120 * pixel, 5, 2, 1],
            [5, 120 * pixel, 1, 2],
        ] {
            for border in [0, pixel / 2, 3] {
                let low =
                    [border - width / 2, border - height / 2].map(|c| c & !(pixel - 1) | border);
                let high = [low[0] + width, low[1] + height];
                let range = |axis: usize| [low[axis] as i16, high[axis] as i16];
                let sheet = Surface::sheet(
                    range(0),
                    range(1),
                    [columns as usize, rows as usize],
                    &mut random,
                );
                let name = format!("{width} x {height} in {columns} x {rows} from {low:?}");
                covers_rectangle::<S>(sheet, low, high, &name);
            }
        }
    }
    sheets::<S4>(1);
    sheets::<S8>(2);
}

/// Long slivers of every direction, many of which meet in one vertex.
#[test]
fn shattered_squares_are_covered_once() {
    for seed in 0..8 {
        let mut random = Random::new(seed);
        let shattered = Surface::shattered(1000, 400, &mut random);
        covers_rectangle::<S4>(
            shattered.clone(),
            [-1000; 2],
            [1000; 2],
            &format!("{seed}, sixteenths"),
        );
        covers_rectangle::<S8>(shattered, [-1000; 2], [1000; 2], &format!("{seed}, 256ths"));
    }
}

/// The hub lies on a pixel centre: it belongs to exactly one of the triangles round it.
#[test]
fn fans_round_a_pixel_centre_draw_it_once() {
    fn fans<S: Subpixel>(pixel_radius: f64) {
        let pixel = f64::from(1 << S::BITS);
        let half = (1 << (S::BITS - 1)) as i16;
        for corners in 3..=64 {
            for turn in 0..8 {
                let angle = |i: i32| {
                    f64::from(i) / f64::from(corners) * std::f64::consts::TAU
                        + f64::from(turn) / 8.0
                };
                let at = |c: f64| half + (pixel_radius * pixel * c).round() as i16;
                let rim: Vec<_> =
                    (0..corners).map(|i| [at(angle(i).cos()), at(angle(i).sin()), 0]).collect();
                let fan = Surface::fan([half, half, 0], &rim).scaled(-(S::BITS as i32));
                let mesh = fan.mesh();
                let scene = Scene::new(&mesh, pixel_camera(VIEWPORT));
                let counts = scene.count::<S, CullNone>(VIEWPORT);
                // The hub (half, half) with y upwards is the centre of pixel (128, 127).
                assert_eq!(counts.at(128, 127), 1, "{corners} corners, turn {turn}");
                // Rounding moves the rim by less than a pixel. The rim's chords come as near to the
                // hub as the cosine of half their angle.
                let inner = pixel_radius * (std::f64::consts::PI / f64::from(corners)).cos() - 1.0;
                for (index, &count) in counts.counts().iter().enumerate() {
                    let [dx, dy] = [index % 256, index / 256].map(|c| c as f64);
                    let distance = (dx - 128.0).hypot(dy - 127.0);
                    assert!(
                        count <= 1 && (count == 1 || distance > inner),
                        "{corners} corners, turn {turn}"
                    );
                    assert!(count == 0 || distance < pixel_radius + 1.0);
                }
            }
        }
    }
    fans::<S4>(60.0);
    fans::<S8>(60.0);
    fans::<S8>(2.0);
}

/// Two triangles on the two sides of an edge through a pixel centre, the edge in all directions,
/// the corners in all orders, and both sides drawn.
#[test]
fn a_centre_on_a_shared_edge_has_one_owner() {
    fn edges<S: Subpixel>() {
        let half = 1 << (S::BITS - 1);
        let viewport = area(0, 0, 64, 64);
        for (dx, dy) in (-5..=5).flat_map(|dx| (-5..=5).map(move |dy| (dx, dy))) {
            if (dx, dy) == (0, 0) {
                continue;
            }
            for (back, on) in [(1, 1), (7, 3), (half, half / 2)] {
                let along = |n: i32| [(half + n * dx) as i16, (half + n * dy) as i16, 0];
                let beside = |n: i32| [(half - n * dy) as i16, (half + n * dx) as i16, 0];
                let positions = vec![along(-back), along(on), beside(5), beside(-9)];
                let (left, right) = ([0u16, 1, 2], [1u16, 0, 3]);
                for order in 0..36 {
                    let mut triangles = vec![left, right];
                    for (triangle, order) in triangles.iter_mut().zip([order % 6, order / 6]) {
                        triangle.rotate_left(order % 3);
                        if order >= 3 {
                            triangle.reverse();
                        }
                    }
                    let pair = Surface::new(positions.clone(), triangles).scaled(-(S::BITS as i32));
                    let mesh = pair.mesh();
                    let counts =
                        Scene::new(&mesh, pixel_camera(viewport)).count::<S, CullNone>(viewport);
                    assert_eq!(counts.at(32, 31), 1, "({dx}, {dy}) {back} {on} {order}");
                    assert!(counts.counts().iter().all(|&count| count <= 1));
                }
            }
        }
    }
    edges::<S4>();
    edges::<S8>();
}

/// The picture is the same for all places of the viewport, also to the left of the display and
/// above it.
#[test]
fn pictures_move_by_whole_pixels() {
    let ball = Surface::ball(20_000, 9).scaled(-14);
    let mesh = ball.mesh();
    let seen = |x: i32, y: i32| {
        let lens =
            Perspective::new(Turn::degrees(50), Distance::lit("0.1"), Distance::lit("50")).unwrap();
        let viewport = area(x, y, 131, 90);
        let camera =
            Camera::at(Vec3::lit("0.3", "0.1", "2.5"), Rotation::IDENTITY, lens, viewport).unwrap();
        let scene = Scene::new(&mesh, camera);
        [
            scene.count::<S4, CullNone>(viewport).counts().to_vec(),
            scene.count::<S8, CullNone>(viewport).counts().to_vec(),
        ]
    };
    let here = seen(0, 0);
    assert!(here[0].iter().sum::<u32>() > 1000);
    for (x, y) in [(1, 0), (-1, -1), (1000, -3000), (-16_384, 16_384), (16_384, -16_384)] {
        assert_eq!(seen(x, y), here, "({x}, {y})");
    }
}

/// The first corner does not matter; the direction of the corners decides only the side.
#[test]
fn order_of_corners_changes_no_pixel() {
    let mut random = Random::new(3);
    let ball = Surface::ball(20_000, 9).scaled(-14);
    let views = [ball.clone(), ball.clone().rotated(&mut random), ball.reversed()].map(|surface| {
        let mesh = surface.mesh();
        let lens =
            Perspective::new(Turn::degrees(50), Distance::lit("0.1"), Distance::lit("50")).unwrap();
        let camera =
            Camera::at(Vec3::lit("0.3", "0.1", "2.5"), turned([2, 3, 4]), lens, VIEWPORT).unwrap();
        let scene = Scene::new(&mesh, camera);
        let none = scene.count::<S8, CullNone>(VIEWPORT);
        let back = scene.count::<S8, CullBack>(VIEWPORT);
        let front = scene.count::<S8, CullFront>(VIEWPORT);
        [none, back, front]
    });
    assert!(views[0][0].counts().iter().sum::<u32>() > 10_000);
    assert_eq!(views[0], views[1]);
    let [none, back, front] = &views[0];
    assert_eq!(views[2], [none.clone(), front.clone(), back.clone()]);
}
