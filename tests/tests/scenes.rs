//! Several objects by one call: the picture is that of one call for each, in bands of any height;
//! no object is left out of a band that it reaches.

use std::ptr;

use embedded_graphics::{geometry::Size, pixelcolor::Rgb888, primitives::Rectangle};
use rasterizer::{
    attribute::{FloatDepth, NoDepth},
    camera::{Camera, Distance, Perspective},
    color::Alpha,
    geometry::{
        ClipNone, CullNone, Particle, PlanarShadow, Plane, Pose, Projection, ScreenParticle,
        ScreenVertex,
    },
    mesh::{Mesh, Tables},
    numbers::{Matrix, Rotation, S4, S8, Scalar, Subpixel, Turn, Vec3},
    output::Add,
    scene::{Levels, Needs, Object, Painter, Particles, ProjectError, RowRange, Scene, each},
    shade::{Gouraud, Squares, Unlit},
};
use rasterizer_tests::{
    Placed, Random,
    bands::{BACKGROUND, DISPLAY, Depth, MATERIALS, ROWS, at, ball, light, picture},
    ends::{self, Stage},
};

/// The rows of the viewport that an object may reach hold all that it touches.
fn rows_hold<S: Subpixel, P: Projection>(stage: &Stage, camera: &Camera<P>) -> Option<bool> {
    let mesh = stage.surface.mesh();
    let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(stage.pose).culled(CullNone);
    let mut storage = vec![Placed::<S>::EMPTY; mesh.vertex_count()];
    let seen = object.project(camera, &mut storage).ok()?;
    let mut rows = [RowRange::EMPTY];
    let scene = Scene::<_, _, S, NoDepth>::new((object,), camera, S::default(), &mut rows).unwrap();
    let found = scene.rows()[0].rows();
    let viewport = camera.viewport();
    let height = viewport.size.height;
    assert!(u32::from(found.end) <= height);
    let touched = seen.bounds().map(|Rectangle { top_left, size }| {
        let top = (top_left.y - viewport.top_left.y) as u32;
        top..top + size.height
    });
    if let Some(touched) = touched.clone() {
        let found = u32::from(found.start)..u32::from(found.end);
        assert!(
            found.start <= touched.start && touched.end <= found.end,
            "{found:?} do not hold {touched:?} in {stage:#?} by {camera:#?}"
        );
    }
    // Whether the rows tell anything.
    Some(touched.is_some() && usize::from(found.end - found.start) < height as usize)
}

#[test]
fn the_rows_of_an_object_hold_all_that_it_touches() {
    let mut random = Random::new(31);
    let mut told = [0; 2];
    for case in 0..100_000 {
        let stage = ends::stage(&mut random);
        let viewport = ends::viewport(&mut random);
        let told = &mut told[case % 2];
        let (lens, parallel) = (ends::perspective(&mut random), ends::orthographic(&mut random));
        let (in_s4, in_s8) = if case % 2 == 0 {
            let camera = stage.camera(lens, viewport);
            (rows_hold::<S4, _>(&stage, &camera), rows_hold::<S8, _>(&stage, &camera))
        } else {
            let camera = stage.camera(parallel, viewport);
            (rows_hold::<S4, _>(&stage, &camera), rows_hold::<S8, _>(&stage, &camera))
        };
        *told += usize::from(in_s4 == Some(true)) + usize::from(in_s8 == Some(true));
    }
    assert!(told.iter().all(|&told| told > 300), "{told:?}");
}

/// Balls that are near and far, beside the picture, and behind the eye.
fn poses() -> Vec<Pose> {
    let mut random = Random::new(8);
    (0..30)
        .map(|_| {
            let [x, y] = [random.within(-90_000, 90_000), random.within(-90_000, 90_000)];
            let z = if random.within(0, 5) > 0 {
                random.within(-300_000, -30_000)
            } else {
                random.within(300_000, 400_000)
            };
            Pose::rotated(Rotation::about_x(Turn::degrees(20)))
                .at(Vec3::from_bits([x, y, z]))
                .scaled(Distance::from_bits(random.within(8_000, 60_000) as u32))
        })
        .collect()
}

/// The camera at this z, with a near plane that leaves stretched balls exact in S8.
fn before(z: &str) -> Camera {
    let [near, far] = ["0.4", "20"].map(Distance::lit);
    let lens = Perspective::new(Turn::degrees(50), near, far).unwrap();
    Camera::at(Vec3::lit("0", "0", z), Rotation::IDENTITY, lens, DISPLAY).unwrap()
}

fn scene_is_like_its_objects<S: Subpixel, D: Depth>() {
    let ball = ball();
    let mesh = Mesh::new(Tables { materials: &MATERIALS, ..*ball.mesh().tables() }).unwrap();
    let poses = poses();
    let (few, many) = poses.split_at(2);
    let lit = |pose: &Pose| Object::new(&mesh, Gouraud::<Rgb888>::new(light())).posed(*pose);
    let bare = |pose: &Pose| {
        Object::new(&mesh, Unlit::<Rgb888>::new()).posed(*pose).blended(Add(Alpha::OPAQUE))
    };
    let (two, half) = (Scalar::from_num(2), Scalar::lit("0.5"));
    let shadow = |pose: &Pose| {
        let floor = Plane::new(Vec3::Y, Scalar::ONE);
        let sun = Vec3::lit("-1", "2", "0.5");
        bare(pose).clipped(PlanarShadow::new(floor, sun))
    };
    let stretched = |pose: &Pose| bare(pose).shaped(&Matrix::scaling(two, half, -two));
    for eye in ["3", "0.9"] {
        let camera = before(eye);
        let (first, absent, second) = (lit(&few[0]), None, Some(bare(&few[1]).culled(CullNone)));
        let mut storage = vec![ScreenVertex::<S, D, [u16; 1]>::EMPTY; mesh.vertex_count()];
        let stored = first.project(&camera, &mut storage).unwrap();
        let whole = picture::<D>(ROWS, |frame| {
            stored.draw(frame)?;
            for pose in many {
                let one = lit(pose).project_on_demand(&camera, S::default()).unwrap();
                one.draw(frame)?;
            }
            for object in
                second.iter().copied().chain(many.iter().map(|pose| bare(pose).culled(CullNone)))
            {
                object.project_on_demand(&camera, S::default()).unwrap().draw(frame)?;
            }
            for pose in many {
                shadow(pose).project_on_demand(&camera, S::default()).unwrap().draw(frame)?;
                stretched(pose).project_on_demand(&camera, S::default()).unwrap().draw(frame)?;
            }
            Ok(())
        });
        let drawn = whole.drawn(BACKGROUND).len();
        assert!(drawn > 500, "{drawn}");

        let contents = (
            &stored,
            each(many, lit),
            (absent.map(|pose: Pose| lit(&pose)), second),
            each(many, |pose| bare(pose).culled(CullNone)),
            each(many, |pose| (shadow(pose), stretched(pose))),
        );
        let mut rows = vec![RowRange::EMPTY; 4 * many.len() + 1];
        let scene = Scene::new(contents, &camera, S::default(), &mut rows).unwrap();
        assert_eq!(scene.rows().len(), 4 * many.len() + 1);
        let out = scene.rows().iter().filter(|rows| rows.rows().is_empty()).count();
        assert!(out >= 2, "{out} objects are out of the picture");
        for rows in 1..=ROWS + 1 {
            assert!(whole == picture::<D>(rows, |band| scene.draw(band)), "{rows} rows, {eye}");
        }
        let small = scene.with_cache::<4>();
        assert!(whole == picture::<D>(7, |band| small.draw(band)), "{eye}");
    }
}

#[test]
fn a_scene_is_like_its_objects() {
    scene_is_like_its_objects::<S4, u16>();
    scene_is_like_its_objects::<S8, u32>();
    scene_is_like_its_objects::<S4, FloatDepth>();
    scene_is_like_its_objects::<S8, NoDepth>();
}

#[test]
fn what_is_sorted_is_drawn_among_others() {
    let ball = ball();
    let mesh = Mesh::new(Tables { materials: &MATERIALS, ..*ball.mesh().tables() }).unwrap();
    let camera = at("3", DISPLAY);
    let object = |x: i32| {
        let pose = Pose::IDENTITY.at(Vec3::from_bits([x << 12, 0, x << 13]));
        Object::new(&mesh, Unlit::<Rgb888>::new()).posed(pose)
    };
    let first = object(-3).project_on_demand::<_, S4, NoDepth>(&camera, S4).unwrap();
    let second = object(3).project_on_demand::<_, S4, NoDepth>(&camera, S4).unwrap();
    let mut order = vec![0; 2 * Needs::of(&mesh, DISPLAY.size, 16).sort_words];
    let painter = Painter::new((&first, &second), &mut order).unwrap();
    let whole = picture::<NoDepth>(ROWS, |frame| painter.draw(frame));
    let scene = Scene::new((&painter,), &camera, S4, &mut []).unwrap();
    assert!(whole == picture::<NoDepth>(7, |band| scene.draw(band)));

    let sparks = [-9, 0, 9].map(|x| {
        let place = Vec3::from_bits([x << 12, 0, x << 13]);
        Particle::new(place, Distance::lit("0.3"), Rgb888::new(200, 100, (x + 9) as u8))
    });
    let mut places = [ScreenParticle::EMPTY; 3];
    let mut order = [0; 3];
    let sparks = Particles::new(&sparks, Squares).project(&camera, &mut places).unwrap();
    let sparks = sparks.back_to_front(&mut order).unwrap();
    let with_sparks = picture::<NoDepth>(ROWS, |frame| {
        painter.draw(frame)?;
        sparks.draw(frame)
    });
    assert!(with_sparks != whole);
    let scene = Scene::new((&painter, &sparks), &camera, S4, &mut []).unwrap();
    assert!(with_sparks == picture::<NoDepth>(7, |band| scene.draw(band)));
}

/// Two cameras on two parts of the display, in bands.
#[test]
fn scenes_of_several_cameras_share_bands() {
    let ball = ball();
    let mesh = Mesh::new(Tables { materials: &MATERIALS, ..*ball.mesh().tables() }).unwrap();
    let Rectangle { top_left, size } = DISPLAY;
    let half = Size::new(size.width, size.height / 2);
    let lower = top_left + Size::new(0, half.height);
    let cameras = [top_left, lower].map(|corner| at("1.7", Rectangle::new(corner, half)));
    let poses = poses();
    let balls = || each(&poses, |pose| Object::new(&mesh, Unlit::<Rgb888>::new()).posed(*pose));
    let mut rows = [[RowRange::EMPTY; 30]; 2];
    let [upper, lower] = rows.each_mut();
    let upper = Scene::new(balls(), &cameras[0], S4, upper).unwrap();
    let lower = Scene::new(balls(), &cameras[1], S4, lower).unwrap();
    let draw = |rows| {
        picture::<u16>(rows, |band| {
            upper.draw(band)?;
            lower.draw(band)
        })
    };
    let whole = draw(ROWS);
    assert!(whole.drawn(BACKGROUND).iter().any(|place| place.y < cameras[1].viewport().top_left.y));
    for rows in [1, 5, 20] {
        assert!(whole == draw(rows), "{rows}");
    }
}

#[test]
fn errors_come_before_the_first_pixel() {
    let ball = ball();
    let mesh = ball.mesh();
    let camera = at("3", DISPLAY);
    let object = Object::new(&mesh, Unlit::<Rgb888>::new());
    let scene = |count: usize| {
        let mut rows = vec![RowRange::EMPTY; count];
        let contents = (object, Some(object), object.clipped(ClipNone));
        Scene::<_, _, S4, u16>::new(contents, &camera, S4, &mut rows).map(|_| ())
    };
    assert_eq!(scene(2), Err(ProjectError::RowStorage { needed: 3 }));
    assert_eq!(scene(3), Ok(()));
    let bare = Tables { vertex_normals: Tables::EMPTY.vertex_normals, ..*mesh.tables() };
    let bare = Mesh::new(bare).unwrap();
    let lit = Object::new(&bare, Gouraud::<Rgb888>::new(light()));
    let error = Scene::<_, _, S4, u16>::new((object, lit), &camera, S4, &mut []).unwrap_err();
    assert_eq!(error, ProjectError::NoVertexNormals);
}

/// The levels by the definition in f64, for places on both sides of each border.
#[test]
fn levels_of_detail_go_by_distance() {
    let ball = ball();
    let meshes = [0, 1, 2].map(|_| ball.mesh());
    let limits = ["0.5", "8.25", "3000"].map(|limit| Distance::from_str(limit).unwrap());
    let levels = Levels::new([0, 1, 2].map(|level| (limits[level], &meshes[level])));
    let lens = Perspective::new(Turn::degrees(40), Distance::from_num(1), Distance::from_num(9));
    let mut random = Random::new(77);
    let mut seen = [0; 4];
    for _ in 0..200_000 {
        let range = random.within(0, 14);
        let mut place = || Vec3::from_bits([(); 3].map(|()| random.bits() as i32 >> range));
        let (eye, at) = (place(), place());
        let scale = Distance::from_bits(random.bits() as u32 >> random.within(0, 31) | 1);
        let camera = Camera::at(eye, Rotation::IDENTITY, lens.unwrap(), DISPLAY).unwrap();
        let pose = Pose::IDENTITY.at(at).scaled(scale);
        let numbers = |v: Vec3| v.to_bits().map(|c| f64::from(c) / 65536.0);
        let [from, to] = [eye, at].map(numbers);
        let way = (0..3).map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt();
        let level = |way: f64| {
            let limits = limits.map(|limit| limit.to_num::<f64>() * scale.to_num::<f64>());
            limits.iter().position(|&limit| way <= limit)
        };
        let bound = 2f64.powi(-12);
        let got = levels.level(&pose, &camera);
        let mesh = got.map(|level| ptr::from_ref(&meshes[level]));
        assert!(levels.mesh(&pose, &camera).map(ptr::from_ref) == mesh);
        assert!(got == level(way - bound) || got == level(way + bound), "{way} {scale}: {got:?}");
        seen[got.unwrap_or(3)] += 1;
    }
    assert!(seen.iter().all(|&count| count > 1_000), "{seen:?}");
}
