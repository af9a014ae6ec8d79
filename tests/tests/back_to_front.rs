//! Triangles from back to front: the order is that of their exact distances, blended frames in
//! bands are the whole frame, and a sorted body without a depth buffer is that of one with it.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    attribute::NoDepth,
    color::Alpha,
    geometry::{CullBack, CullNone, Culling, Pose, ScreenVertex},
    mesh::{Mesh, Tables},
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
    output::{Frame, KeepDepth, Over},
    scene::{DrawError, Needs, Object, ProjectError},
    shade::{Gouraud, Unlit},
};
use rasterizer_tests::{
    Picture, Random,
    bands::{BACKGROUND, DISPLAY, EYES, MATERIALS, Position, ROWS, at, ball, light, picture},
};

/// Random poses of a ball; the middles of its triangles lie far enough apart for a test of their
/// order: a word's key has 22 bits.
#[test]
fn the_order_is_that_of_exact_distances() {
    fn check<S: Subpixel>() {
        let ball = ball();
        let mesh = ball.mesh();
        let tables = mesh.tables();
        let mut random = Random::new(31);
        for round in 0..40 {
            let camera = at(EYES[round % EYES.len()], DISPLAY);
            let mut turn = || Turn::from_bits(random.bits() as u32);
            let rotation =
                Rotation::about_z(turn()) * Rotation::about_x(turn()) * Rotation::about_y(turn());
            let pose = Pose::rotated(rotation).at(Vec3::lit("0.1", "-0.2", "0.05"));
            let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(pose).culled(CullNone);
            let seen = object.project_on_demand::<_, S, NoDepth>(&camera, S::default()).unwrap();
            let mut storage = vec![!0; mesh.triangle_count()];
            let sorted = seen.back_to_front(&mut storage).unwrap();
            let order: Vec<usize> = sorted.order().triangles().collect();
            assert!(order.len() > if round % EYES.len() == 0 { 400 } else { 60 });

            // The camera is tilted about x by -8 degrees: its axis in the world, and in object
            // space.
            let (sine, cosine) = 8f64.to_radians().sin_cos();
            let forward = [0.0, -sine, -cosine];
            let rows = pose.rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
            let axis: Vec<f64> =
                (0..3).map(|i| (0..3).map(|row| rows[row][i] * forward[row]).sum()).collect();
            let distance = |triangle: usize| {
                let corners = tables.triangles.get(triangle).unwrap();
                let positions = corners.map(|corner| tables.positions.get(corner).unwrap());
                let along = |p: [i16; 3]| (0..3).map(|i| axis[i] * f64::from(p[i])).sum::<f64>();
                positions.map(along).iter().sum::<f64>() / 3.0
            };
            // Quanta. A sum is rounded to 4/3 of them in each direction, the key has 22 bits of up
            // to 2^16.
            let bound = 4.0;
            for pair in order.windows(2) {
                let [first, next] = [distance(pair[0]), distance(pair[1])];
                assert!(first >= next - bound, "{pair:?}: {first} before {next}");
            }
            // All that are drawn, each once.
            let mut drawn = Vec::new();
            let Ok(()) = seen.for_each_triangle(|number, _| {
                drawn.push(number);
                Ok::<(), std::convert::Infallible>(())
            });
            let mut all = order;
            all.sort_unstable();
            assert!(all.windows(2).all(|pair| pair[0] < pair[1]));
            assert!(all.iter().all(|number| drawn.contains(number)));
        }
    }
    check::<S4>();
    check::<S8>();
}

/// A glass ball of several materials, cut by all planes, with and without depth.
#[test]
fn bands_of_sorted_glass_equal_the_whole_frame() {
    fn check<S: Subpixel>(culling: impl Culling) {
        let ball = ball();
        let mesh = Mesh::new(Tables { materials: &MATERIALS, ..*ball.mesh().tables() }).unwrap();
        let object = Object::new(&mesh, Position).culled(culling);
        let glass = object.blended(KeepDepth(Over(Alpha::lit("0.4"))));
        let lit = Object::new(&mesh, Gouraud::new(light())).culled(culling);
        let lit = lit.blended(Over(Alpha::lit("0.7")));
        let words = Needs::of(&mesh, DISPLAY.size, 8).sort_words;
        let (mut order, mut other, mut third) = (vec![1; words], vec![2; words], vec![3; words]);
        let mut stored = vec![ScreenVertex::<S, u16, _>::EMPTY; mesh.vertex_count()];
        for eye in EYES {
            let camera = at(eye, DISPLAY);
            let seen = glass.project(&camera, &mut stored).unwrap();
            let seen = seen.back_to_front(&mut order).unwrap();
            let walked = glass.project_on_demand::<_, S, u16>(&camera, S::default()).unwrap();
            let walked = walked.back_to_front(&mut other).unwrap();
            assert!(seen.order().triangles().eq(walked.order().triangles()), "from {eye}");
            let whole = picture::<u16>(ROWS, |frame| seen.draw(frame));
            assert!(whole.drawn(BACKGROUND).len() >= 400 || eye <= "1", "from {eye}");
            let bare = lit.project_on_demand::<_, S, NoDepth>(&camera, S::default()).unwrap();
            let bare = bare.back_to_front(&mut third).unwrap();
            let whole_bare = picture::<NoDepth>(ROWS, |frame| bare.draw(frame));
            for rows in [1, 5, 16, 46] {
                assert!(whole == picture::<u16>(rows, |band| seen.draw(band)), "{rows} from {eye}");
                let band = picture::<u16>(rows, |band| walked.draw(band));
                assert!(whole == band, "walked, {rows} rows from {eye}");
                let band = picture::<NoDepth>(rows, |band| bare.draw(band));
                assert!(whole_bare == band, "without depth, {rows} rows from {eye}");
            }
        }
    }
    check::<S4>(CullNone);
    check::<S8>(CullBack);
}

/// Both sides of a ball, opaque and without depth: the nearest surface is drawn last.
#[test]
fn the_nearest_comes_last() {
    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Position).culled(CullNone);
    let mut storage = vec![0; mesh.triangle_count()];
    let mut wrong_unsorted = 0;
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let tested = object.project_on_demand::<_, S8, u32>(&camera, S8).unwrap();
        let tested = picture::<u32>(ROWS, |frame| tested.draw(frame));
        let unsorted = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
        let sorted = unsorted.back_to_front(&mut storage).unwrap();
        let sorted = picture::<NoDepth>(ROWS, |frame| sorted.draw(frame));
        let unsorted = picture::<NoDepth>(ROWS, |frame| unsorted.draw(frame));
        let wrong = |got: &rasterizer_tests::bands::Screen<Rgb888>| {
            tested.pixels.iter().zip(&got.pixels).filter(|(a, b)| a != b).count()
        };
        wrong_unsorted += wrong(&unsorted);
        assert_eq!(wrong(&sorted), 0, "from {eye}");
    }
    assert!(wrong_unsorted > 200, "{wrong_unsorted}");
}

#[test]
fn too_little_storage_is_an_error_before_the_first_pixel() {
    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Position);
    let seen = object.project_on_demand::<_, S8, u16>(&at("3", DISPLAY), S8).unwrap();
    let mut storage = vec![0; mesh.triangle_count() - 1];
    let refused = seen.back_to_front(&mut storage).unwrap_err();
    assert_eq!(refused, ProjectError::SortStorage { needed: mesh.triangle_count() });
    assert!(refused.to_string().contains("588 words"), "{refused}");
    // An object that is out of the picture has nothing to sort.
    let far = object.posed(Pose::IDENTITY.at(Vec3::lit("0", "0", "90")));
    let hidden = far.project_on_demand::<_, S8, u16>(&at("3", DISPLAY), S8).unwrap();
    let mut storage = vec![0; mesh.triangle_count()];
    let hidden = hidden.back_to_front(&mut storage).unwrap();
    assert_eq!(hidden.order().triangles().count(), 0);
    let mut whole = Picture::<Rgb888, u16>::empty(DISPLAY, BACKGROUND);
    let mut frame = Frame::new(&mut whole.color, &mut whole.depth, DISPLAY).unwrap();
    let drawn: Result<(), DrawError<_>> = hidden.draw(&mut frame).map_err(DrawError::Target);
    assert_eq!(drawn, Ok(()));
    assert!(whole.color.iter().all(|&color| color == BACKGROUND && color != Rgb888::BLACK));
}
