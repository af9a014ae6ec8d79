//! The ends of every range: positions, scales, poses, cameras and viewports in all combinations.
//! Nothing panics, nothing is drawn outside the viewport, and every count of layers is right.

use embedded_graphics::{geometry::Point, pixelcolor::Rgb888, primitives::Rectangle};
use rasterizer::{
    camera::{Camera, Distance, MAX_VIEWPORT_OFFSET, Perspective},
    geometry::{CullBack, CullFront, CullNone, Pose, Projection, ScreenVertex},
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
    output::Frame,
    scene::{Object, ProjectError},
    shade::{Gouraud, Level, Light, Unlit},
};
use rasterizer_tests::{Picture, Placed, Random, Scene, Surface, area, ends, pixel_camera};

/// A small part of the display in or near the viewport.
fn part(random: &mut Random, viewport: Rectangle) -> Rectangle {
    let Point { x, y } = viewport.top_left;
    let [width, height] = [viewport.size.width, viewport.size.height].map(|side| side as i32);
    let middle = random.coin();
    let mut along = |from: i32, length: i32| {
        if middle { from + length / 2 - 20 } else { from + random.within(-50, length) }
    };
    area(along(x, width), along(y, height), 40, 40)
}

/// Checks that a random object is drawn as by the reference, also in bands, and adds its pixels to
/// `drawn`. Returns false if the object is rejected.
fn scene_is_right<S: Subpixel, P: Projection>(
    random: &mut Random,
    lens: P,
    drawn: &mut u64,
) -> bool {
    let stage = ends::stage(random);
    let camera = stage.camera(lens, ends::viewport(random));
    let mesh = stage.surface.mesh();
    let scene = Scene { pose: stage.pose, ..Scene::new(&mesh, camera) };
    let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(scene.pose);
    let mut storage = vec![Placed::<S>::EMPTY; mesh.vertex_count()];
    match object.project(&camera, &mut storage) {
        Ok(_) => {}
        Err(ProjectError::Pose(_)) => return false,
        Err(error) => panic!("{error}"),
    }
    let part = part(random, camera.viewport());
    let counts = scene.count::<S, CullNone>(part);
    let inside = |index: usize| {
        let place = part.top_left + Point::new(index as i32 % 40, index as i32 / 40);
        camera.viewport().contains(place)
    };
    let reference = scene.reference::<S, CullNone>(part);
    for (index, (&count, &layers)) in counts.counts().iter().zip(&reference).enumerate() {
        assert_eq!(count, if inside(index) { layers } else { 0 }, "{scene:#?} {part:?} {index}");
    }
    let front = scene.count::<S, CullBack>(part);
    let back = scene.count::<S, CullFront>(part);
    let sums = front.counts().iter().zip(back.counts()).map(|(front, back)| front + back);
    assert!(sums.eq(counts.counts().iter().copied()), "{scene:#?}");
    let rows = random.within(1, 39);
    for (top, height) in [(0, rows), (rows, 40 - rows)] {
        let band = scene.count::<S, CullNone>(area(
            part.top_left.x,
            part.top_left.y + top,
            40,
            height as u32,
        ));
        let start = top as usize * 40;
        assert_eq!(
            band.counts(),
            &counts.counts()[start..start + band.counts().len()],
            "{scene:#?}"
        );
    }
    *drawn += counts.counts().iter().map(|&count| u64::from(count)).sum::<u64>();
    true
}

#[test]
fn random_scenes_are_drawn_as_the_reference_does() {
    let mut random = Random::new(0x5CE7E);
    let (mut drawn, mut accepted) = (0, 0);
    for _ in 0..40_000 {
        let lens = ends::perspective(&mut random);
        accepted += u32::from(scene_is_right::<S4, _>(&mut random, lens, &mut drawn));
        accepted += u32::from(scene_is_right::<S8, _>(&mut random, lens, &mut drawn));
        let lens = ends::orthographic(&mut random);
        accepted += u32::from(scene_is_right::<S4, _>(&mut random, lens, &mut drawn));
        accepted += u32::from(scene_is_right::<S8, _>(&mut random, lens, &mut drawn));
    }
    println!("{accepted} of 160000 scenes accepted, {drawn} pixels");
    // The others are larger or nearer than what S4 and S8 place exactly.
    assert!(accepted > 80_000 && drawn > 400_000, "{accepted} {drawn}");
}

/// Depth and varyings at the ends of their ranges, in a frame of 32-bit depth and in its bands.
#[test]
fn random_scenes_are_the_same_in_bands() {
    let mut random = Random::new(77);
    let mut covered = 0;
    for _ in 0..40_000 {
        let mut stage = ends::stage(&mut random);
        stage.surface = stage.surface.with_vertex_normals();
        let mesh = stage.surface.mesh();
        let seen = stage.camera(ends::perspective(&mut random), ends::viewport(&mut random));
        let shader =
            Gouraud::<Rgb888>::new(Light::new(ends::place(&mut random), Level::ONE, Level::ONE));
        let mut storage = vec![ScreenVertex::<S8, u32, [u16; 1]>::EMPTY; mesh.vertex_count()];
        let object = Object::new(&mesh, shader).posed(stage.pose);
        let Ok(projected) = object.project(&seen, &mut storage) else {
            continue;
        };
        let part = part(&mut random, seen.viewport());
        let background = Rgb888::new(1, 2, 3);
        let draw = |area: Rectangle| {
            let mut picture = Picture::<_, u32>::empty(area, background);
            let mut frame = Frame::new(&mut picture.color, &mut picture.depth, area).unwrap();
            let Ok(()) = projected.draw(&mut frame);
            picture
        };
        let whole = draw(part);
        covered += whole.depth.iter().filter(|&&depth| depth != 0).count();
        let rows = random.within(1, 39);
        for (top, height) in [(0, rows), (rows, 40 - rows)] {
            let band = draw(area(part.top_left.x, part.top_left.y + top, 40, height as u32));
            assert!(band == whole.crop(band.area, background), "{projected:?} {part:?}");
        }
    }
    assert!(covered > 30_000, "{covered}");
}

/// The largest, the smallest and the thinnest viewports, at the ends of their offsets: no pixel is
/// left out, and none is drawn twice.
#[test]
fn viewports_of_all_shapes_are_filled_once() {
    let mut random = Random::new(4);
    for offset in [-MAX_VIEWPORT_OFFSET, 0, MAX_VIEWPORT_OFFSET] {
        for [width, height] in
            [[1, 1], [1, 2048], [2048, 1], [2, 2], [2048, 2048], [2047, 3], [3, 2047]]
        {
            let viewport = area(offset, -offset, width, height);
            let sheet = Surface::sheet([-1024, 1024], [-1024, 1024], [9, 7], &mut random);
            let mesh = sheet.mesh();
            let scene = Scene::new(&mesh, pixel_camera(viewport));
            for net in [scene.net::<S4>(viewport), scene.net::<S8>(viewport)] {
                // The right edge of a viewport of 2,048 columns lies on the guard band, whose last
                // sub-pixel is cut off.
                assert!(net.iter().all(|&layers| layers == 1), "{viewport:?}");
            }
        }
    }
}

/// Triangles with three equal corners, with two, and with all corners on a line, at the ends of the
/// range: no pixel is drawn from either side.
#[test]
fn triangles_without_area_draw_nothing() {
    let (low, high) = (i16::MIN, i16::MAX);
    let positions = vec![
        [low, low, 0],
        [0, 0, 0],
        [high, high, 0],
        [0, 0, 0],
        [-5, 7, 0],
        [-5, 9, 0],
        [-5, 8, 0],
    ];
    let triangles = vec![
        [0, 0, 0],
        [0, 0, 2],
        [2, 0, 0],
        [1, 3, 4],
        [0, 1, 2],
        [2, 1, 0],
        [4, 5, 6],
        [5, 5, 6],
    ];
    let viewport = area(0, 0, 300, 300);
    for exponent in [-12, -8, -4, 0, 4] {
        let surface = Surface::new(positions.clone(), triangles.clone()).scaled(exponent);
        let mesh = surface.mesh();
        let scene = Scene::new(&mesh, pixel_camera(viewport));
        // Half a million pixels are beyond the range of S8, and within that of S4.
        if exponent < 4 {
            assert!(scene.count::<S8, CullNone>(viewport).counts().iter().all(|&count| count == 0));
        }
        assert!(scene.count::<S4, CullNone>(viewport).counts().iter().all(|&count| count == 0));
    }
}

/// Only the product of the mesh's scale and the pose's scale matters.
#[test]
fn scales_of_mesh_and_pose_multiply() {
    let ball = Surface::ball(30_000, 5);
    let viewport = area(0, 0, 100, 100);
    let seen = |exponent: i32, pose_scale: Distance| {
        let ball = ball.clone().scaled(exponent);
        let mesh = ball.mesh();
        let lens =
            Perspective::new(Turn::degrees(60), Distance::lit("0.1"), Distance::lit("9")).unwrap();
        let camera =
            Camera::at(Vec3::lit("0.1", "0", "2.5"), Rotation::IDENTITY, lens, viewport).unwrap();
        let scene = Scene { pose: Pose::IDENTITY.scaled(pose_scale), ..Scene::new(&mesh, camera) };
        scene.count::<S8, CullNone>(viewport)
    };
    let plain = seen(-15, Distance::ONE);
    assert!(plain.counts().iter().sum::<u32>() > 5000);
    for power in -16..16 {
        let bits = 1u32 << (16 + power);
        assert_eq!(seen(-15 - power, Distance::from_bits(bits)), plain, "2^{power}");
    }
    let none = seen(-15, Distance::ZERO);
    assert!(none.counts().iter().all(|&count| count == 0));
}

/// A triangle of two quanta, 1/65,536 of a unit long, that a lens of 0.01 degrees shows as large as
/// the picture: its legs are 104 and 208 pixels long.
#[test]
fn a_tiny_object_before_the_longest_lens_is_drawn() {
    let surface = Surface::new(vec![[-2, 0, 0], [-2, 1, 0], [-2, 0, -2]], vec![[0, 1, 2]]);
    let surface = surface.scaled(-17);
    let mesh = surface.mesh();
    let field = Turn::from_bits((2f64.powi(32) * 0.01 / 360.0) as u32);
    let lens = Perspective::new(field, Distance::lit("0.05"), Distance::lit("10")).unwrap();
    let viewport = area(0, 0, 480, 240);
    let eye = Vec3::lit("0.1", "0", "0");
    let camera = Camera::at(eye, Rotation::about_y(Turn::QUARTER), lens, viewport).unwrap();
    let scene = Scene::new(&mesh, camera);
    let expected = 104.9 * 209.7 / 2.0;
    for count in [scene.count::<S4, CullNone>(viewport), scene.count::<S8, CullNone>(viewport)] {
        let covered = f64::from(count.counts().iter().sum::<u32>());
        assert!((covered / expected - 1.0).abs() < 0.01, "{covered} pixels instead of {expected}");
    }
}

/// A floor of 60,000 units, seen from 0.01 above it: all of the lower half of the picture.
#[test]
fn a_vast_floor_reaches_from_the_feet_to_the_horizon() {
    let mut random = Random::new(3);
    let floor = Surface::sheet([-30_000, 30_000], [-30_000, 30_000], [8, 8], &mut random);
    let mesh = floor.mesh();
    let lens =
        Perspective::new(Turn::degrees(60), Distance::lit("0.1"), Distance::lit("65535")).unwrap();
    let viewport = area(0, 0, 320, 240);
    let eye = Vec3::lit("3.5", "0.01", "-2.25");
    let camera = Camera::at(eye, Rotation::IDENTITY, lens, viewport).unwrap();
    let lying = Pose::rotated(Rotation::about_x(-Turn::QUARTER));
    let scene = Scene { pose: lying, ..Scene::new(&mesh, camera) };
    let counts = scene.count::<S8, CullNone>(viewport);
    // At the near plane the floor is 0.01 * 207.8 / 0.1 = 20.8 rows below the middle.
    for y in 0..240 {
        let expected = u32::from((120..141).contains(&y));
        assert!((0..320).all(|x| counts.at(x, y) == expected), "row {y}");
    }
}

/// Objects in a world of 20,000 units with a near plane of 0.05: S4 has no range for those that
/// come near, and draws or leaves out all others, wherever the camera looks.
#[test]
fn what_is_out_of_view_is_not_refused() {
    let cube = Surface::cube(16_384, 1).scaled(-14);
    let mesh = cube.mesh();
    let lens =
        Perspective::new(Turn::degrees(60), Distance::lit("0.05"), Distance::lit("30000")).unwrap();
    let (mut drawn, mut left_out) = (0, 0);
    for yaw in (0..360).step_by(15) {
        let rotation = Rotation::about_y(Turn::degrees(yaw));
        let camera = Camera::at(Vec3::ZERO, rotation, lens, area(0, 0, 320, 240)).unwrap();
        for (x, z) in [(9000, 0), (-40, 7000), (300, -9999), (-5, -3), (0, 150), (9999, 9999)] {
            let at = Vec3::from_bits([x << 16, 0, z << 16]);
            let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(Pose::IDENTITY.at(at));
            let mut storage = vec![Placed::<S4>::EMPTY; mesh.vertex_count()];
            let seen = object.project(&camera, &mut storage).unwrap();
            let count = if seen.is_outside_view() { &mut left_out } else { &mut drawn };
            *count += 1;
        }
    }
    assert!(drawn > 20 && left_out > 80, "{drawn} {left_out}");
}
