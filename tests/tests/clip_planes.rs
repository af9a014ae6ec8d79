//! Objects that are cut at planes of the user's: what is left is what the reference leaves, the
//! parts on both sides of a plane fill the picture of the whole without a gap and without an
//! overlap, and every way of drawing draws the same.

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    primitives::Rectangle,
};
use host_tools::reference::{self, HalfSpace};
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Perspective},
    color::Alpha,
    geometry::{
        ClipPlanes, Clipping, CullBack, CullFront, CullNone, Culling, Plane, Pose, ScreenVertex,
    },
    mesh::{Lines, Mesh, Segments},
    numbers::{Rotation, S4, S8, Scalar, Subpixel, Turn, Vec3},
    output::{Add, BandAreas, Direct, Frame},
    scene::{Object, bin_words},
    shade::Unlit,
};
use rasterizer_tests::{
    Counter, Picture, Random, Surface, area,
    bands::{BACKGROUND, DISPLAY, EYES, Position, at, ball},
};

const VIEWPORT: Rectangle = area(0, 0, 96, 72);

/// A number from -`reach` to `reach`.
fn scalar(random: &mut Random, reach: f64) -> Scalar {
    Scalar::from_num((f64::from(random.bits() as i16) / 32_768.0) * reach)
}

fn vector(random: &mut Random, reach: f64) -> Vec3 {
    let mut coordinate = || scalar(random, reach);
    Vec3::new(coordinate(), coordinate(), coordinate())
}

fn rotation(random: &mut Random) -> Rotation {
    let mut angle = || Turn::from_bits(random.bits() as u32);
    Rotation::about_z(angle()) * Rotation::about_y(angle()) * Rotation::about_x(angle())
}

fn camera(eye: Vec3, rotation: Rotation) -> Camera<Perspective> {
    let [focal, near, far] = ["60", "0.25", "100"].map(|text| text.parse::<Distance>().unwrap());
    let lens = Perspective::with_focal_length(focal, near, far).unwrap();
    Camera::at(eye, rotation, lens, VIEWPORT).unwrap()
}

fn count<S: Subpixel>(
    mesh: &Mesh<'_>,
    pose: Pose,
    camera: &Camera<Perspective>,
    clipping: impl Clipping,
    culling: impl Culling,
) -> Vec<u32> {
    let mut counter = Counter::<Rgb888>::new(VIEWPORT);
    let object = Object::new(mesh, Unlit::new()).posed(pose).clipped(clipping).culled(culling);
    let mut storage = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; mesh.vertex_count()];
    assert_eq!(object.draw(camera, &mut storage, &mut Direct::new(&mut counter)), Ok(()));
    counter.counts().to_vec()
}

/// How many more front faces than back faces cover each pixel.
fn net<S: Subpixel>(
    mesh: &Mesh<'_>,
    pose: Pose,
    camera: &Camera<Perspective>,
    clipping: impl Clipping,
) -> Vec<i32> {
    let front = count::<S>(mesh, pose, camera, clipping, CullBack);
    let back = count::<S>(mesh, pose, camera, clipping, CullFront);
    front.iter().zip(back).map(|(&front, back)| front as i32 - back as i32).collect()
}

fn numbers(v: Vec3) -> [f64; 3] {
    v.to_bits().map(|c| f64::from(c) / 65_536.0)
}

fn half_space(plane: Plane) -> HalfSpace {
    HalfSpace { normal: numbers(plane.normal), offset: plane.offset.to_num() }
}

fn product(rotation: &Rotation, v: [f64; 3]) -> [f64; 3] {
    let rows = rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
    rows.map(|row| (0..3).map(|i| row[i] * v[i]).sum())
}

/// The net number of layers by the reference, where it is the same with the picture moved by a 16th
/// of a pixel in any direction: vertices are snapped by less.
fn certain(
    positions: &[[f64; 3]],
    triangles: &[[usize; 3]],
    (eye, rotation): (Vec3, &Rotation),
    sides: &[HalfSpace],
) -> Vec<Option<i32>> {
    let eye = numbers(eye);
    let [forward, up] = [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]].map(|v| product(rotation, v));
    let mesh = reference::Mesh { positions: positions.to_vec(), triangles: triangles.to_vec() };
    let net = |x: f64, y: f64| -> Vec<i32> {
        let camera = reference::Camera {
            eye,
            target: [0, 1, 2].map(|i| eye[i] + forward[i]),
            up,
            projection: reference::Projection::Perspective {
                focal_length_px: 60.0,
                near: 0.25,
                far: 100.0,
            },
            viewport: reference::Viewport { x, y, width: 96.0, height: 72.0 },
        };
        let [front, all] = [reference::Culling::Back, reference::Culling::None].map(|culling| {
            reference::draw_clipped_scene(
                &camera,
                &mesh,
                sides,
                culling,
                (96, 72),
                |_| [],
                |_| Some([0.0; 3]),
            )
        });
        let places = (0..72).flat_map(|y| (0..96).map(move |x| (x, y)));
        places.map(|(x, y)| 2 * front.layers(x, y) as i32 - all.layers(x, y) as i32).collect()
    };
    let by = [-0.0625, 0.0, 0.0625];
    let moved: Vec<_> = by.iter().flat_map(|&x| by.iter().map(move |&y| (x, y))).collect();
    let moved: Vec<_> = moved.into_iter().map(|(x, y)| net(x, y)).collect();
    (0..96 * 72)
        .map(|index| {
            let first = moved[0][index];
            moved.iter().all(|net| net[index] == first).then_some(first)
        })
        .collect()
}

fn agrees<const N: usize>(random: &mut Random, name: &str, surface: &Surface) -> usize {
    let mesh = surface.mesh();
    let turn = rotation(random);
    let pose = Pose::rotated(turn).at(vector(random, 0.3)).scaled(Distance::lit("0.75"));
    let way = rotation(random);
    // From 0.2 to 3 units away, in the direction in which the camera looks past the body.
    let back = [0.0, 0.0, 0.2 + f64::from(random.bits() as u8) / 90.0];
    let back = product(&way, back).map(Scalar::from_num);
    let eye = Vec3::new(back[0], back[1], back[2]);
    let is_in_world = random.bits().is_multiple_of(2);
    let planes: [Plane; N] = [(); N].map(|()| Plane::new(vector(random, 4.0), scalar(random, 1.5)));
    let scale = f64::from(surface.scale.mantissa()) * 2f64.powi(surface.scale.exponent());
    let model: Vec<[f64; 3]> = (0..mesh.vertex_count())
        .map_while(|i| mesh.tables().positions.get(i))
        .map(|p| p.map(|c| f64::from(c) * scale))
        .collect();
    let t = numbers(pose.translation);
    let world: Vec<_> = model
        .iter()
        .map(|p| {
            let turned = product(&turn, p.map(|c| c * 0.75));
            [0, 1, 2].map(|i| turned[i] + t[i])
        })
        .collect();
    // A plane of the object, in the world: n . p / s for R p + t.
    let sides = planes.map(|plane| {
        let HalfSpace { normal, offset } = half_space(plane);
        if is_in_world {
            return HalfSpace { normal, offset };
        }
        let normal = product(&turn, normal).map(|c| c / 0.75);
        HalfSpace { normal, offset: offset - (0..3).map(|i| normal[i] * t[i]).sum::<f64>() }
    });
    let triangles: Vec<_> =
        (0..mesh.triangle_count()).map_while(|i| mesh.tables().triangles.get(i)).collect();
    let certain = certain(&world, &triangles, (eye, &way), &sides);
    let clipping =
        if is_in_world { ClipPlanes::in_world(planes) } else { ClipPlanes::in_object(planes) };
    let camera = camera(eye, way);
    for (precision, net) in [
        ("S4", net::<S4>(&mesh, pose, &camera, clipping)),
        ("S8", net::<S8>(&mesh, pose, &camera, clipping)),
    ] {
        for (index, (net, certain)) in net.iter().zip(&certain).enumerate() {
            if let Some(certain) = certain {
                assert_eq!(
                    net,
                    certain,
                    "{name} {precision}: ({}, {}), {planes:?}, in the world: {is_in_world}",
                    index % 96,
                    index / 96
                );
            }
        }
    }
    certain.iter().flatten().filter(|&&layers| layers != 0).count()
}

/// Bodies before the camera and round it, so that the near plane and the guard band cut them too.
#[test]
fn what_is_left_is_what_the_reference_leaves() {
    let mut random = Random::new(41);
    let mut covered = 0;
    for (name, surface) in [
        ("cube", Surface::cube(16_384, 1).scaled(-14)),
        ("fine cube", Surface::cube(16_384, 6).scaled(-14)),
        ("ball", Surface::ball(16_384, 6).scaled(-14)),
    ] {
        for _ in 0..15 {
            covered += agrees::<1>(&mut random, name, &surface);
            covered += agrees::<2>(&mut random, name, &surface);
            covered += agrees::<3>(&mut random, name, &surface);
        }
    }
    assert!(covered > 100_000, "{covered}");
}

/// From inside a body each ray leaves it once, through one of the parts on both sides of a plane.
#[test]
fn the_parts_on_both_sides_of_a_plane_fill_the_whole() {
    let mut random = Random::new(42);
    let mut parts = 0;
    for surface in [
        Surface::cube(10_000, 1).scaled(-13),
        Surface::cube(10_000, 9).scaled(-13),
        Surface::ball(10_000, 9).scaled(-13),
    ] {
        let mesh = surface.mesh();
        for case in 0..60 {
            let pose = Pose::rotated(rotation(&mut random)).at(vector(&mut random, 0.2));
            let camera = camera(vector(&mut random, 0.2), rotation(&mut random));
            let plane = match case % 3 {
                // Through corners and middles of edges, where it meets vertices exactly.
                0 => Plane::new(Vec3::X, Scalar::ZERO),
                1 => Plane::new(Vec3::from_bits([1 << 16, -1 << 16, 0]), Scalar::ZERO),
                _ => Plane::new(vector(&mut random, 900.0), scalar(&mut random, 500.0)),
            };
            let other = ClipPlanes::in_object([plane.flipped()]);
            let clipping = ClipPlanes::in_object([plane]);
            let sum = |[a, b]: [Vec<i32>; 2]| -> Vec<i32> {
                a.iter().zip(b).map(|(a, b)| a + b).collect()
            };
            let of = |clipping| net::<S4>(&mesh, pose, &camera, clipping);
            let part = of(clipping).iter().filter(|&&layers| layers != 0).count();
            parts += usize::from(part > 0 && part < 96 * 72);
            assert!(sum([of(clipping), of(other)]).iter().all(|&n| n == -1), "S4 {plane:?}");
            let of = |clipping| net::<S8>(&mesh, pose, &camera, clipping);
            assert!(sum([of(clipping), of(other)]).iter().all(|&n| n == -1), "S8 {plane:?}");
        }
    }
    assert!(parts > 60, "{parts} planes cross the picture");
}

/// Added to black, the parts of a cube that surrounds the camera are one step everywhere. No
/// triangle of it is turned over by snapping.
#[test]
fn each_pixel_is_added_once() {
    let cube = Surface::cube(10_000, 1).scaled(-13).colored([1, 1, 1]);
    let mesh = cube.mesh();
    let mut random = Random::new(43);
    for _ in 0..40 {
        let camera = camera(Vec3::ZERO, rotation(&mut random));
        let plane = Plane::new(vector(&mut random, 900.0), scalar(&mut random, 300.0));
        let mut color = vec![Rgb888::BLACK; 96 * 72];
        let mut frame = Frame::without_depth(&mut color, VIEWPORT).unwrap();
        for plane in [plane, plane.flipped()] {
            let object = Object::new(&mesh, Unlit::new())
                .culled(CullNone)
                .clipped(ClipPlanes::in_world([plane]))
                .blended(Add(Alpha::OPAQUE));
            let mut storage = vec![ScreenVertex::<S8, _, _>::EMPTY; mesh.vertex_count()];
            object.draw(&camera, &mut storage, &mut frame).unwrap();
        }
        assert!(color.iter().all(|&color| color == Rgb888::new(1, 1, 1)), "{plane:?}");
    }
}

/// The colour of a pixel is its place in the object, which lies inside the half space.
#[test]
fn varyings_are_those_of_the_part_that_is_kept() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut random = Random::new(44);
    let mut seen = 0;
    for eye in EYES {
        for _ in 0..20 {
            let plane = Plane::new(vector(&mut random, 1.0), scalar(&mut random, 0.3));
            let mut picture = Picture::<Rgb888, u32>::empty(DISPLAY, BACKGROUND);
            let mut frame =
                Frame::new(&mut picture.color, &mut picture.depth, picture.area).unwrap();
            let object = Object::new(&mesh, Position)
                .culled(CullNone)
                .clipped(ClipPlanes::in_object([plane]));
            let mut storage = vec![ScreenVertex::<S8, u32, _>::EMPTY; mesh.vertex_count()];
            object.draw(&at(eye, DISPLAY), &mut storage, &mut frame).unwrap();
            let side = half_space(plane);
            // Linear on the screen: all corners of what is left are inside, and so is what lies
            // between them. A step of a colour is a 64th of the ball's radius; it is rounded down.
            let bound = 1.5 / 64.0 * side.normal.iter().map(|c| c.abs()).sum::<f64>();
            for (color, &depth) in picture.color.iter().zip(&picture.depth) {
                if depth != 0 {
                    seen += 1;
                    let place =
                        [color.r(), color.g(), color.b()].map(|c| (f64::from(c) - 127.5) / 64.0);
                    assert!(side.depth(place) > -bound, "{place:?} {plane:?}");
                }
            }
        }
    }
    assert!(seen > 50_000, "{seen}");
}

/// Bands, bins and vertices on demand: in every clipping case.
#[test]
fn every_way_of_drawing_draws_the_same() {
    let ball = ball();
    let mesh = ball.mesh();
    let planes = [
        Plane::new(Vec3::lit("1", "0.3", "0"), Scalar::lit("0.1")),
        Plane::new(Vec3::lit("0", "-1", "0.5"), Scalar::lit("0.4")),
    ];
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let object =
            Object::new(&mesh, Position).culled(CullNone).clipped(ClipPlanes::in_world(planes));
        let mut storage = vec![ScreenVertex::<S4, u16, _>::EMPTY; mesh.vertex_count()];
        let mut bins = vec![0; bin_words(mesh.triangle_count(), DISPLAY.size.height, 5)];
        let seen = object.project(&camera, &mut storage).unwrap();
        let bounds = seen.bounds().unwrap();
        let demanded = object.project_on_demand::<_, S4, u16>(&camera, S4).unwrap();
        let mut whole = Picture::<Rgb888, u16>::empty(DISPLAY, BACKGROUND);
        let mut frame = Frame::new(&mut whole.color, &mut whole.depth, DISPLAY).unwrap();
        let Ok(()) = seen.draw(&mut frame);
        let drawn = whole.crop(bounds, BACKGROUND).depth;
        let drawn = drawn.iter().filter(|&&depth| depth != 0).count();
        let all = whole.depth.iter().filter(|&&depth| depth != 0).count();
        assert!(drawn == all && all > 200, "{drawn} of {all} pixels within the bounds, {eye}");
        let binned = seen.binned(5, &mut bins).unwrap();
        for area in BandAreas::new(DISPLAY, 5) {
            let want = whole.crop(area, BACKGROUND);
            let mut band = Picture::<Rgb888, u16>::empty(area, BACKGROUND);
            let mut frame = Frame::new(&mut band.color, &mut band.depth, area).unwrap();
            let Ok(()) = binned.draw(&mut frame);
            assert!(band == want, "bins, {area:?} from {eye}");
            let mut band = Picture::<Rgb888, u16>::empty(area, BACKGROUND);
            let mut frame = Frame::new(&mut band.color, &mut band.depth, area).unwrap();
            let Ok(()) = demanded.draw(&mut frame);
            assert!(band == want, "on demand, {area:?} from {eye}");
        }
    }
}

/// The parts of a line on both sides of a plane share at most the pixel of their joint, where the
/// second begins to run along it, and leave out none.
#[test]
fn lines_are_cut_too() {
    let mut random = Random::new(45);
    let mut cut = 0;
    for _ in 0..200 {
        let mut end = || [0; 3].map(|_| random.bits() as i16 / 2);
        let fan = Surface::fan(end(), &[end(), end()]).scaled(-14);
        let mesh = fan.mesh();
        let lines = Lines::new(&mesh, Segments::U8(&[[0, 1]])).unwrap();
        let plane = Plane::new(vector(&mut random, 9.0), scalar(&mut random, 3.0));
        let camera = camera(Vec3::lit("0", "0", "1.6"), Rotation::IDENTITY);
        let count = |planes: &[Plane]| {
            let mut counter = Counter::<Rgb888>::new(VIEWPORT);
            let object = Object::new(&mesh, Unlit::new());
            let mut storage = vec![ScreenVertex::<S8, NoDepth, _>::EMPTY; mesh.vertex_count()];
            let mut target = Direct::new(&mut counter);
            match planes {
                [plane] => {
                    let object = object.clipped(ClipPlanes::in_world([*plane]));
                    let seen = object.project(&camera, &mut storage).unwrap();
                    seen.lines(&lines).fill(Rgb888::RED, &mut target).unwrap();
                }
                _ => {
                    let seen = object.project(&camera, &mut storage).unwrap();
                    seen.lines(&lines).fill(Rgb888::RED, &mut target).unwrap();
                }
            }
            counter.counts().to_vec()
        };
        let (whole, a, b) = (count(&[]), count(&[plane]), count(&[plane.flipped()]));
        let pixels = |counts: &[u32]| counts.iter().sum::<u32>();
        cut += usize::from(pixels(&a) > 0 && pixels(&b) > 0);
        // The joint is snapped, so that a part may change rows one pixel earlier or later.
        assert!(
            (pixels(&a) + pixels(&b)).abs_diff(pixels(&whole)) <= 1,
            "{} + {} of {}: {plane:?}",
            pixels(&a),
            pixels(&b),
            pixels(&whole)
        );
    }
    assert!(cut > 40, "{cut} lines were cut");
}
