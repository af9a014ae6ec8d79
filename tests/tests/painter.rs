//! Several objects from back to front: the order is that of their exact distances, a frame in bands
//! and one straight onto the display are the whole frame, and how far the picture is from that of
//! a depth buffer.

use std::convert::Infallible;

use embedded_graphics::{
    geometry::{Point, Size},
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::Rectangle,
};
use host_tools::model::{Model, Options};
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Perspective},
    color::Alpha,
    geometry::{CullNone, Pose, ScreenVertex},
    mesh::{Mesh, Tables},
    numbers::{Rotation, S4, S8, Scalar, Subpixel, Turn, Vec3},
    output::{Direct, Frame, Over},
    scene::{Object, Painter, ProjectError},
    shade::{Gouraud, Unlit, Visibility, VisibleTriangle},
};
use rasterizer_tests::{
    Surface,
    bands::{
        BACKGROUND, DISPLAY, EYES, MATERIALS, Position, ROWS, Screen, at, ball, light, picture,
    },
    exact::quantum,
    other_models, shipped_models,
};

/// Balls of very different sizes and scales, one behind the other and one in another.
fn places() -> [(Surface, Pose); 3] {
    let pose = |place: [&str; 3], size: &str, degrees: u32| {
        let [x, y, z] = place.map(Scalar::lit);
        let turned =
            Rotation::about_y(Turn::degrees(degrees)) * Rotation::about_x(Turn::degrees(9));
        Pose::rotated(turned).at(Vec3::new(x, y, z)).scaled(Distance::lit(size))
    };
    [
        (ball(), pose(["0.2", "0", "-0.5"], "1", 20)),
        (Surface::ball(90, 3).scaled(-5).colored([9, 9, 90]), pose(["0", "0.1", "-1"], "0.5", 70)),
        (Surface::ball(30_000, 5).scaled(-18), pose(["-0.5", "0.3", "0.4"], "3", 200)),
    ]
}

#[test]
fn the_order_of_all_objects_is_that_of_exact_distances() {
    fn check<S: Subpixel>() {
        let places = places();
        let meshes = places.each_ref().map(|(surface, _)| surface.mesh());
        let needed = meshes.iter().map(Mesh::triangle_count).sum();
        let mut storage = vec![!0; needed];
        // With 4 bits, the objects are too large for how near the last places are.
        for eye in EYES.into_iter().filter(|&eye| S::BITS > 4 || eye >= "1") {
            let camera = at(eye, DISPLAY);
            let objects: Vec<_> = (meshes.iter().zip(&places))
                .map(|(mesh, &(_, pose))| {
                    Object::new(mesh, Unlit::<Rgb888>::new()).posed(pose).culled(CullNone)
                })
                .map(|object| object.project_on_demand::<_, S, NoDepth>(&camera, S::default()))
                .map(Result::unwrap)
                .collect();
            let [a, b, c] = objects.as_slice() else { unreachable!() };
            // A tuple in a tuple is the same as one.
            let nested = ((a, b), (c,));
            let order: Vec<_> = Painter::new(nested, &mut storage).unwrap().triangles().collect();
            let painter = Painter::new((a, b, c), &mut storage).unwrap();
            assert!(painter.triangles().eq(order.iter().copied()), "from {eye}");

            // The camera is tilted about x by -8 degrees.
            let (sine, cosine) = 8f64.to_radians().sin_cos();
            let distance = |&(object, triangle): &(usize, usize)| {
                let (tables, pose) = (meshes[object].tables(), &places[object].1);
                let corners = tables.triangles.get(triangle).unwrap();
                let sum = corners.iter().fold([0.0; 3], |sum, &corner| {
                    let p = tables.positions.get(corner).unwrap();
                    [0, 1, 2].map(|axis| sum[axis] + f64::from(p[axis]))
                });
                let quantum = quantum(tables.scale) * pose.scale.to_num::<f64>() / 3.0;
                let rows = pose.rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
                let place = [pose.translation.y, pose.translation.z].map(|c| c.to_num::<f64>());
                let along = |axis: usize| {
                    let turned: f64 = (0..3).map(|i| rows[axis][i] * sum[i]).sum();
                    turned * quantum + place[axis - 1]
                };
                -sine * along(1) - cosine * along(2)
            };
            // Quanta of the coarsest mesh, 2^-6: half of one for the middle, and a key of 22 bits
            // of a range of less than 8.
            let bound = 0.5 / 64.0 * 1.01 + 0.001;
            for pair in order.windows(2) {
                let [first, next] = [distance(&pair[0]), distance(&pair[1])];
                assert!(first >= next - bound, "{pair:?} from {eye}: {first} before {next}");
            }
            // All that each object draws, each once.
            for (place, object) in objects.iter().enumerate() {
                let mut drawn = Vec::new();
                let Ok(()) = object.for_each_triangle(|number, _| {
                    drawn.push(number);
                    Ok::<(), Infallible>(())
                });
                let of_object = order.iter().filter(|at| at.0 == place).map(|at| at.1);
                let mut own: Vec<_> = of_object.collect();
                own.sort_unstable();
                assert!(own.windows(2).all(|pair| pair[0] < pair[1]));
                assert!(own.iter().all(|number| drawn.contains(number)));
                assert!(!own.is_empty() || eye <= "1", "object {place} from {eye}");
            }
            let changes = order.windows(2).filter(|pair| pair[0].0 != pair[1].0).count();
            assert!(changes > 8, "the objects take turns {changes} times from {eye}");
        }
    }
    check::<S4>();
    check::<S8>();
}

/// Objects of other shaders, materials and blendings, cut by all planes.
#[test]
fn bands_and_the_display_itself_equal_the_whole_frame() {
    let places = places();
    let ball = Mesh::new(Tables { materials: &MATERIALS, ..*places[0].0.mesh().tables() }).unwrap();
    let other = places[2].0.mesh();
    let mut stored = vec![ScreenVertex::<S8, NoDepth, _>::EMPTY; ball.vertex_count()];
    let mut storage = vec![3; ball.triangle_count() + other.triangle_count()];
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let first = Object::new(&ball, Gouraud::new(light())).posed(places[0].1).culled(CullNone);
        let second = Object::new(&other, Position).posed(places[2].1);
        let second = second.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();

        let glass = first.blended(Over(Alpha::lit("0.6")));
        let glass = glass.project(&camera, &mut stored).unwrap();
        let painter = Painter::new((&glass, &second), &mut storage).unwrap();
        let whole = picture::<NoDepth>(ROWS, |frame| painter.draw(frame));
        assert!(whole.drawn(BACKGROUND).len() > 300, "from {eye}");
        for rows in [1, 5, 16] {
            let bands = picture::<NoDepth>(rows, |band| painter.draw(band));
            assert!(whole == bands, "{rows} rows from {eye}");
        }

        let opaque = first.project(&camera, &mut stored).unwrap();
        let painter = Painter::new((&opaque, &second), &mut storage).unwrap();
        let whole = picture::<NoDepth>(ROWS, |frame| painter.draw(frame));
        let mut screen = Screen::new(DISPLAY);
        screen.pixels.fill(Some(BACKGROUND));
        painter.draw(&mut Direct::new(&mut screen)).unwrap();
        assert!(whole == screen, "direct from {eye}");
    }
}

#[test]
fn too_little_storage_is_an_error_before_the_first_pixel() {
    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Position);
    let camera = at("3", DISPLAY);
    let seen = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
    let far = object.posed(Pose::IDENTITY.at(Vec3::lit("0", "0", "90")));
    let hidden = far.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
    let needed = 2 * mesh.triangle_count();
    let mut storage = vec![0; needed];
    let refused = Painter::new((&seen, &hidden), &mut storage[1..]).unwrap_err();
    assert_eq!(refused, ProjectError::SortStorage { needed });
    // An object that is out of the picture has nothing to sort.
    let mut more = vec![0; 3 * needed];
    let painter = Painter::new((&hidden, &seen, &hidden), &mut more).unwrap();
    assert!(painter.triangles().count() > 200 && painter.triangles().all(|at| at.0 == 1));
    let nothing = Painter::new((&hidden,), &mut storage).unwrap();
    assert_eq!(nothing.triangles().count(), 0);
    let whole = picture::<NoDepth>(ROWS, |frame| nothing.draw(frame));
    assert!(whole.drawn(BACKGROUND).is_empty() && BACKGROUND != Rgb888::BLACK);
}

/// The largest number of pixels of 320 x 240 in which the painter shows another triangle than a
/// depth buffer of 32 bits, in 100 views from all sides (Fibonacci's sphere), of a mesh that fills
/// most of the picture's height.
fn worst_of_100_views(mesh: &Mesh<'_>) -> usize {
    const SIDES: [u32; 2] = [320, 240];
    let display = Rectangle::new(Point::zero(), Size::new(SIDES[0], SIDES[1]));
    let tables = mesh.tables();
    let quantum = quantum(tables.scale);
    let positions: Vec<[f64; 3]> = (0..mesh.vertex_count())
        .map(|vertex| tables.positions.get(vertex).unwrap().map(|c| f64::from(c) * quantum))
        .collect();
    let middle = [0, 1, 2].map(|axis| {
        let along = positions.iter().map(|p| p[axis]);
        (along.clone().fold(f64::MAX, f64::min) + along.fold(f64::MIN, f64::max)) / 2.0
    });
    let from_middle = |p: &[f64; 3]| (0..3).map(|i| (p[i] - middle[i]).powi(2)).sum::<f64>();
    let radius = positions.iter().map(from_middle).fold(0.0, f64::max).sqrt();
    let distance = 2.5 * radius;
    let focal_length = 110.0 * (distance * distance - radius * radius).sqrt() / radius;
    let [near, far, focal_length] =
        [distance - radius, distance + 2.0 * radius, focal_length].map(Distance::from_num);
    let lens = Perspective::with_focal_length(focal_length, near, far).unwrap();
    let vector = |v: [f64; 3]| {
        let [x, y, z] = v.map(Scalar::from_num);
        Vec3::new(x, y, z)
    };
    let object = Object::new(mesh, Visibility::of_object(0).without_weights())
        .posed(Pose::IDENTITY.at(vector(middle.map(|c| -c))));
    let mut storage = vec![0; mesh.triangle_count()];
    let pixels = (SIDES[0] * SIDES[1]) as usize;
    (0..100)
        .map(|view| {
            let z = 1.0 - (2.0 * f64::from(view) + 1.0) / 100.0;
            let angle = f64::from(view) * 2.399_963_229_728_653;
            let across = (1.0 - z * z).sqrt();
            let back = [across * angle.cos(), z, across * angle.sin()];
            let up = if z.abs() > 0.99 { Vec3::X } else { Vec3::Y };
            let eye = vector(back.map(|c| c * distance));
            let camera = Camera::look_at(eye, Vec3::ZERO, up, lens, display).unwrap();
            let mut tested = vec![VisibleTriangle::NONE; pixels];
            let mut depth = vec![0u32; pixels];
            let by_depth = object.project_on_demand::<_, S4, u32>(&camera, S4).unwrap();
            by_depth.draw(&mut Frame::new(&mut tested, &mut depth, display).unwrap()).unwrap();
            let mut painted = vec![VisibleTriangle::NONE; pixels];
            let sorted = object.project_on_demand::<_, S4, NoDepth>(&camera, S4).unwrap();
            let painter = Painter::new((&sorted,), &mut storage).unwrap();
            painter.draw(&mut Frame::without_depth(&mut painted, display).unwrap()).unwrap();
            let drawn = tested.iter().filter(|pixel| pixel.object().is_some()).count();
            // A flat one is seen from its edge too.
            assert!(drawn > 1_000, "{drawn} pixels in view {view}");
            tested.iter().zip(&painted).filter(|(a, b)| a != b).count()
        })
        .max()
        .unwrap()
}

/// A bound for each model that is known here: what sorting by exact middles reaches. No test for
/// others, as nothing bounds their faults.
#[test]
fn few_pixels_differ_from_those_of_a_depth_buffer() {
    let cube = Surface::cube(100, 1);
    assert_eq!(worst_of_100_views(&cube.mesh()), 0);
    let bounds = [
        ("gear", 1),
        ("torus_knot", 0),
        ("spot", 1),
        ("cow", 16),
        ("teapot", 73),
        ("suzanne", 235),
        ("rocket", 383),
    ];
    let models = [shipped_models(), other_models()].concat();
    let mut judged = 0;
    for path in models {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let Some(&(_, bound)) = bounds.iter().find(|(known, _)| *known == name) else { continue };
        let model = Model::load(&path, &Options::default()).unwrap();
        let worst = worst_of_100_views(&model.mesh());
        println!("{name}: {worst} wrong pixels in the worst of 100 views, at most {bound}");
        assert!(worst <= bound, "{name}: {worst} wrong pixels");
        judged += 1;
    }
    assert!(judged >= 3, "{judged} models");
}
