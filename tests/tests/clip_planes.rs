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
    exact::{numbers, quantum, rotated},
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

fn half_space(plane: Plane) -> HalfSpace {
    HalfSpace { normal: numbers(plane.normal), offset: plane.offset.to_num() }
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
    let [forward, up] = [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]].map(|v| rotated(rotation, v));
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

/// A body in its pose, and where it is seen from.
struct Seen<'a> {
    name: &'a str,
    surface: &'a Surface,
    turn: Rotation,
    place: Vec3,
    /// The camera's.
    eye: Vec3,
    way: Rotation,
}

impl Seen<'_> {
    /// Compares with the reference, and returns how many pixels are covered.
    fn agrees<const N: usize>(&self, planes: [Plane; N], is_in_world: bool) -> usize {
        let Self { name, surface, turn, place, eye, way } = self;
        let mesh = surface.mesh();
        let pose = Pose::rotated(*turn).at(*place).scaled(Distance::lit("0.75"));
        let scale = quantum(surface.scale);
        let model: Vec<[f64; 3]> = (0..mesh.vertex_count())
            .map_while(|i| mesh.tables().positions.get(i))
            .map(|p| p.map(|c| f64::from(c) * scale))
            .collect();
        let t = numbers(pose.translation);
        let world: Vec<_> = model
            .iter()
            .map(|p| {
                let turned = rotated(turn, p.map(|c| c * 0.75));
                [0, 1, 2].map(|i| turned[i] + t[i])
            })
            .collect();
        // A plane of the object, in the world: n . p / s for R p + t.
        let sides = planes.map(|plane| {
            let HalfSpace { normal, offset } = half_space(plane);
            if is_in_world {
                return HalfSpace { normal, offset };
            }
            let normal = rotated(turn, normal).map(|c| c / 0.75);
            HalfSpace { normal, offset: offset - (0..3).map(|i| normal[i] * t[i]).sum::<f64>() }
        });
        let triangles: Vec<_> =
            (0..mesh.triangle_count()).map_while(|i| mesh.tables().triangles.get(i)).collect();
        let certain = certain(&world, &triangles, (*eye, way), &sides);
        let clipping =
            if is_in_world { ClipPlanes::in_world(planes) } else { ClipPlanes::in_object(planes) };
        let camera = camera(*eye, *way);
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
}

/// From 0.2 to 3 units away, in the direction in which the camera looks past the body.
fn eye(random: &mut Random, way: &Rotation) -> Vec3 {
    let back = [0.0, 0.0, 0.2 + f64::from(random.bits() as u8) / 90.0];
    let [x, y, z] = rotated(way, back).map(Scalar::from_num);
    Vec3::new(x, y, z)
}

fn agrees<const N: usize>(random: &mut Random, name: &str, surface: &Surface) -> usize {
    let (turn, place) = (rotation(random), vector(random, 0.3));
    let way = rotation(random);
    let seen = Seen { name, surface, turn, place, eye: eye(random, &way), way };
    let is_in_world = random.bits().is_multiple_of(2);
    // Of many planes each leaves the body's middle, or little would be left.
    let least = if N > 3 { 0.3 } else { -1.5 };
    let offset = |random: &mut Random| {
        let offset = scalar(random, 1.5);
        if offset < Scalar::from_num(least) { -offset } else { offset }
    };
    let planes: [Plane; N] = [(); N].map(|()| Plane::new(vector(random, 4.0), offset(random)));
    seen.agrees(planes, is_in_world)
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
            covered += agrees::<6>(&mut random, name, &surface);
        }
    }
    assert!(covered > 100_000, "{covered}");
}

/// A plane in a face of a cube keeps the face, on either side of it. One that meets it in a narrow
/// angle cuts it, and its neighbours by less than a sub-pixel. Positions and planes are exact.
#[test]
fn planes_in_faces_and_beside_them_are_exact() {
    let (cube, fine) = (Surface::cube(16_384, 1).scaled(-14), Surface::cube(16_384, 6).scaled(-14));
    let mut random = Random::new(46);
    let (mut in_face, mut beside) = (0, 0);
    for (name, surface) in [("cube", &cube), ("fine cube", &fine)] {
        for _ in 0..12 {
            let way = rotation(&mut random);
            let eye = eye(&mut random, &way);
            let (turn, place) = (Rotation::IDENTITY, Vec3::ZERO);
            let seen = Seen { name, surface, turn, place, eye, way };
            // The faces lie at 1 in the object, and at 0.75 in the world.
            for (is_in_world, at) in [(true, "0.75"), (false, "1")] {
                let at: Scalar = at.parse().unwrap();
                for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
                    let plane = Plane::new(-axis, at);
                    in_face += seen.agrees([plane], is_in_world);
                    in_face += seen.agrees([plane.flipped()], is_in_world);
                    in_face += seen.agrees([plane, Plane::new(axis, at)], is_in_world);
                }
                // The angle is a 4,000th, and a 60th of that.
                let thousands = Scalar::from_num(4_000) * at;
                for aside in ["1", "0.016"] {
                    let [aside, half] = [aside, "-0.5"].map(|text| text.parse::<Scalar>().unwrap());
                    let normal = Vec3::new(-Scalar::from_num(4_000), aside, half * aside);
                    let plane = Plane::new(normal, thousands);
                    beside += seen.agrees([plane], is_in_world);
                    beside += seen.agrees([plane.flipped()], is_in_world);
                }
            }
        }
    }
    assert!(in_face > 100_000 && beside > 50_000, "{in_face} {beside}");
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

type Target<'a> = Frame<'a, Rgb888, &'a mut [u16]>;

/// Whole, in bands, with bins and with vertices on demand.
fn every_way<const N: usize>(planes: [Plane; N]) {
    let ball = ball();
    let mesh = ball.mesh();
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
        assert!(drawn == all && all > 200, "{drawn} of {all} pixels within the bounds, {eye} {N}");
        let mut again = Picture::<Rgb888, u16>::empty(DISPLAY, BACKGROUND);
        let mut frame = Frame::new(&mut again.color, &mut again.depth, DISPLAY).unwrap();
        let Ok(()) = demanded.draw(&mut frame);
        assert!(again == whole, "on demand, whole, from {eye} {N}");
        let binned = seen.binned(5, &mut bins).unwrap();
        for area in BandAreas::new(DISPLAY, 5) {
            let want = whole.crop(area, BACKGROUND);
            let band = |draw: &dyn Fn(&mut Target<'_>)| {
                let mut band = Picture::<Rgb888, u16>::empty(area, BACKGROUND);
                draw(&mut Frame::new(&mut band.color, &mut band.depth, area).unwrap());
                band
            };
            let stored = band(&|frame| {
                let Ok(()) = seen.draw(frame);
            });
            let in_bins = band(&|frame| {
                let Ok(()) = binned.draw(frame);
            });
            let on_demand = band(&|frame| {
                let Ok(()) = demanded.draw(frame);
            });
            for (way, band) in [("stored", stored), ("bins", in_bins), ("on demand", on_demand)] {
                assert!(band == want, "{way}, {area:?} from {eye} {N}");
            }
        }
    }
}

/// In every clipping case, with one plane, with two and with the most.
#[test]
fn every_way_of_drawing_draws_the_same() {
    let plane = |[x, y, z]: [&str; 3], offset: &str| {
        let [x, y, z, offset] = [x, y, z, offset].map(|text| text.parse::<Scalar>().unwrap());
        Plane::new(Vec3::new(x, y, z), offset)
    };
    let one = plane(["1", "0.3", "0"], "0.1");
    let other = plane(["0", "-1", "0.5"], "0.4");
    every_way([one]);
    every_way([one, other]);
    // A box in the ball.
    every_way([
        plane(["1", "0.3", "0"], "0.8"),
        plane(["0", "-1", "0.2"], "0.75"),
        plane(["0.2", "1", "0.1"], "0.75"),
        plane(["-1", "0.1", "0.3"], "0.8"),
        plane(["-0.1", "0.2", "1"], "0.8"),
        plane(["0.3", "0.1", "-1"], "0.8"),
    ]);
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
