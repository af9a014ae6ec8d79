//! Objects that a matrix stretches, mirrors, shears or flattens, against f64: where their vertices
//! lie, which of their faces are seen, how they are lit, and where planes cut them.

use std::convert::Infallible;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{ClipPlanes, CullNone, PlanarShadow, Plane, Pose, Projection, ScreenVertex},
    mesh::{Material, Mesh, Normals, Positions, Tables, Triangles},
    numbers::{Matrix, Rotation, S4, S8, Scalar, Scale, Subpixel, Turn, Vec3},
    output::Frame,
    scene::Object,
    shade::{Flat, Gouraud, Lamp, Level, Light, Phong, Shader, Unlit},
};
use rasterizer_tests::{
    Placed, Random, Surface, area,
    ends::{self, Stage},
    exact::{Lens, changed, judge_placed, numbers, rotated},
    pixel_camera, places,
    vector::{Vector, cross, dot, minus, unit},
};

fn entries(matrix: &Matrix) -> [Vector; 3] {
    matrix.rows().map(|row| row.map(Scalar::to_num))
}

fn determinant(matrix: &Matrix) -> f64 {
    let [a, b, c] = entries(matrix);
    dot(a, cross(b, c))
}

/// The vector that the inverse transpose makes of another: the solution x of `M^T x = n`.
fn inverse_transpose(matrix: &Matrix, n: Vector) -> Vector {
    // By Cramer's rule: the columns of the transpose are the rows.
    let rows = entries(matrix);
    [0, 1, 2].map(|i| {
        let mut replaced = rows;
        replaced[i] = n;
        dot(replaced[0], cross(replaced[1], replaced[2])) / determinant(matrix)
    })
}

/// Entries of any magnitude, and of all kinds: of a stretch along the axes, a shear, a rotation
/// times a stretch, a projection, at the ends of the range.
fn any_matrix(random: &mut Random) -> Matrix {
    let range = random.within(0, 24);
    let mut entry = || Scalar::from_bits(random.bits() as i32 >> range);
    let [a, b, c, d] = [entry(), entry(), entry(), entry()];
    match random.within(0, 6) {
        0 => Matrix::scaling(a, b, c),
        1 => Matrix::scaling(Scalar::ONE, Scalar::from_bits(random.within(-9, 9)), Scalar::ONE),
        2 => Matrix::from_rows([[a, b, c], [Scalar::ZERO, a, d], [Scalar::ZERO, Scalar::ZERO, b]]),
        3 => Matrix::from_rows([[a, b, c], [a, b, c], [d, d, a]]),
        4 => Matrix::scaling(Scalar::MIN, Scalar::MAX, a),
        _ => Matrix::from_rows([(); 3].map(|()| [(); 3].map(|()| entry_of(random, range)))),
    }
}

const fn entry_of(random: &mut Random, range: i32) -> Scalar {
    Scalar::from_bits(random.bits() as i32 >> range)
}

/// One that stretches by no more than a few times as much in one direction as in another.
fn regular_matrix(random: &mut Random) -> Matrix {
    loop {
        let size = random.within(14, 18);
        let matrix =
            Matrix::from_rows([(); 3].map(|()| {
                [(); 3].map(|()| Scalar::from_bits(random.within(-(1 << size), 1 << size)))
            }));
        let [a, b, c] = entries(&matrix);
        let longest = [a, b, c].map(|row| dot(row, row)).into_iter().fold(0.0, f64::max).sqrt();
        if determinant(&matrix).abs() > 0.05 * longest.powi(3) {
            return matrix;
        }
    }
}

/// Checks the vertices of a stage in a shape; returns how many are on the screen.
fn placed<S: Subpixel, P: Projection>(
    stage: &Stage,
    shape: &Matrix,
    camera: Camera<P>,
    lens: &Lens,
) -> usize {
    let mesh = stage.surface.mesh();
    let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(stage.pose).shaped(shape);
    let mut storage = vec![Placed::<S>::EMPTY; mesh.vertex_count()];
    let Ok(projected) = object.project(&camera, &mut storage) else { return 0 };
    let placed = places(projected.vertices());
    judge_placed::<S, P>(stage, shape, (camera, lens), &placed).placed
}

#[test]
fn vertices_in_perspective_lie_where_they_should() {
    let mut random = Random::new(41);
    let mut counts = [0; 2];
    for round in 0..100_000 {
        let stage = ends::stage(&mut random);
        let regular = round % 2 == 0;
        let shape = if regular { regular_matrix(&mut random) } else { any_matrix(&mut random) };
        let [near, far] = ends::depth_range(&mut random);
        let viewport = ends::viewport(&mut random);
        let focal = ends::distance(&mut random);
        let lens = Perspective::with_focal_length(focal, near, far).unwrap();
        let camera = stage.camera(lens, viewport);
        let exact = Lens::perspective(&lens, focal.to_num());
        counts[0] += placed::<S4, _>(&stage, &shape, camera, &exact);
        counts[1] += placed::<S8, _>(&stage, &shape, camera, &exact);
    }
    assert!(counts.iter().all(|&count| count > 5000), "{counts:?}");
}

#[test]
fn vertices_of_parallel_projections_lie_where_they_should() {
    let mut random = Random::new(42);
    let mut counts = [0; 2];
    for _ in 0..50_000 {
        let (stage, shape) = (ends::stage(&mut random), any_matrix(&mut random));
        let (lens, viewport): (Orthographic, _) =
            (ends::orthographic(&mut random), ends::viewport(&mut random));
        let camera = stage.camera(lens, viewport);
        let exact = Lens::orthographic(&lens, f64::from(viewport.size.height));
        counts[0] += placed::<S4, _>(&stage, &shape, camera, &exact);
        counts[1] += placed::<S8, _>(&stage, &shape, camera, &exact);
    }
    assert!(counts.iter().all(|&count| count > 5000), "{counts:?}");
}

/// A floor that a matrix makes of a square, with the eye close over it: much larger than the near
/// distance, so that its matrix is exact near the eye.
#[test]
fn large_floors_close_to_the_eye_are_not_refused() {
    let mut random = Random::new(43);
    let mut drawn = 0;
    for _ in 0..2000 {
        let surface = Surface::new(
            (0..30).map(|_| [random.bits() as i16, 0, random.bits() as i16]).collect(),
            vec![[0, 1, 2]],
        );
        let surface = surface.scaled(-15);
        let side = |random: &mut Random| Scalar::from_bits(random.within(20 << 16, 400 << 16));
        let (x, z) = (side(&mut random), side(&mut random));
        let mut shape = Matrix::scaling(x, Scalar::ONE, z);
        if random.coin() {
            // Sheared along the ground.
            let slant = Scalar::from_bits(random.within(-9 << 16, 9 << 16));
            shape = Matrix::from_rows([
                [x, Scalar::ZERO, slant],
                [Scalar::ZERO, Scalar::ONE, Scalar::ZERO],
                [slant, Scalar::ZERO, z],
            ]);
        }
        let turn = Turn::from_bits(random.bits() as u32);
        let stage = Stage {
            surface,
            pose: Pose::rotated(Rotation::about_y(turn)),
            eye: Vec3::from_bits([random.within(-9 << 16, 9 << 16), 2 << 16, 0]),
            rotation: Rotation::about_x(-Turn::degrees(random.within(0, 30) as u32)),
        };
        let [near, far] = [Distance::lit("0.5"), Distance::lit("600")];
        let lens = Perspective::with_focal_length(Distance::lit("240"), near, far).unwrap();
        let camera = stage.camera(lens, area(0, 0, 240, 240));
        drawn += placed::<S8, _>(&stage, &shape, camera, &Lens::perspective(&lens, 240.0));
    }
    assert!(drawn > 5000, "{drawn}");
}

/// A ball of radius 1, sheared by up to a quarter, seen by an eye 2.5 to 4 away with the near
/// plane at 0.05: the finest precision is kept there as it is without a shear.
#[test]
fn sheared_balls_close_to_the_eye_are_not_refused() {
    let mut random = Random::new(45);
    for _ in 0..2000 {
        let points = (0..40).map(|_| unit([(); 3].map(|()| random.within(-999, 999).into())));
        let points = points.map(|point| point.map(|c| (c * 32_767.0) as i16)).collect();
        let surface = Surface::new(points, vec![[0, 1, 2]]).scaled(-15);
        let shears = [(); 3].map(|()| Scalar::from_bits(random.within(-(1 << 14), 1 << 14)));
        let shape = Matrix::from_rows([
            [Scalar::ONE, shears[0], shears[1]],
            [Scalar::ZERO, Scalar::ONE, shears[2]],
            [Scalar::ZERO, Scalar::ZERO, Scalar::ONE],
        ]);
        let stage = Stage {
            surface,
            pose: Pose::rotated(ends::rotation(&mut random)),
            eye: Vec3::from_bits([0, 0, random.within(5 << 15, 4 << 16)]),
            rotation: Rotation::IDENTITY,
        };
        let [near, far] = [Distance::lit("0.05"), Distance::lit("100")];
        let lens = Perspective::with_focal_length(Distance::lit("240"), near, far).unwrap();
        let camera = stage.camera(lens, area(0, 0, 240, 240));
        assert!(placed::<S8, _>(&stage, &shape, camera, &Lens::perspective(&lens, 240.0)) > 0);
    }
}

/// The faces of a cube that are seen are those whose outward side the eye is on, also in a mirror.
#[test]
fn faces_seen_are_those_turned_to_the_eye() {
    const CORNERS: [[i16; 3]; 8] = [
        [-1, -1, -1],
        [1, -1, -1],
        [-1, 1, -1],
        [1, 1, -1],
        [-1, -1, 1],
        [1, -1, 1],
        [-1, 1, 1],
        [1, 1, 1],
    ];
    let faces: Vec<[u16; 3]> =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect();
    let surface = Surface::new(CORNERS.to_vec(), faces.clone());
    let mesh = surface.mesh();
    let (mut mirrored, mut judged) = (0, 0);
    let mut random = Random::new(44);
    for _ in 0..3000 {
        let shape = regular_matrix(&mut random);
        mirrored += usize::from(determinant(&shape) < 0.0);
        let turn = Rotation::about_y(Turn::from_bits(random.bits() as u32));
        let pose = Pose::rotated(turn).at(Vec3::lit("0", "0", "-400"));
        let (near, far) = (Distance::ONE, Distance::lit("900"));
        let lens = Perspective::with_focal_length(Distance::lit("6000"), near, far).unwrap();
        let camera =
            Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, area(0, 0, 2000, 2000)).unwrap();
        let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(pose).shaped(&shape);
        let mut storage = vec![Placed::<S8>::EMPTY; 8];
        let projected = object.project(&camera, &mut storage).unwrap();
        let mut seen = [false; 12];
        let Ok(()) = projected.for_each_triangle(|index, _| {
            seen[index] = true;
            Ok::<(), Infallible>(())
        });
        let world = |corner: u16| {
            let model = CORNERS[usize::from(corner)].map(f64::from);
            let turned = rotated(&turn, changed(&shape, model));
            [turned[0], turned[1], turned[2] - 400.0]
        };
        for (triangle, seen) in faces.iter().zip(seen) {
            let [a, b, c] = triangle.map(world);
            let normal = cross(minus(b, a), minus(c, a));
            // The cube's middle is inside, whichever way the corners run.
            let outside = if dot(normal, minus(a, [0.0, 0.0, -400.0])) < 0.0 { -1.0 } else { 1.0 };
            let towards = -outside * dot(unit(normal), unit(a));
            if towards.abs() > 0.02 {
                assert_eq!(seen, towards > 0.0, "{shape:?} {triangle:?}");
                judged += 1;
            }
        }
    }
    assert!((1000..2000).contains(&mirrored) && judged > 30_000, "{mirrored} {judged}");
}

/// The brightness of a triangle in white, of one normal, that fills the picture's middle.
fn brightness<Sh: Shader<Color = Rgb888>>(
    shader: Sh,
    mesh: &Mesh<'_>,
    (shape, pose): (&Matrix, Pose),
    eye: Vec3,
) -> f64 {
    let lens = Orthographic::new(Distance::lit("0.01"), Distance::ONE, Distance::MAX).unwrap();
    let camera = Camera::at(eye, Rotation::IDENTITY, lens, area(0, 0, 3, 3)).unwrap();
    let (mut color, mut depth) = ([Rgb888::BLACK; 9], [0u16; 9]);
    let mut frame = Frame::new(&mut color, &mut depth, area(0, 0, 3, 3)).unwrap();
    let mut storage = [ScreenVertex::<S4, _, _>::EMPTY; 3];
    let object = Object::new(mesh, shader).posed(pose).culled(CullNone).shaped(shape);
    object.draw(&camera, &mut storage, &mut frame).unwrap();
    f64::from(color[4].r()) / 255.0
}

/// Light on a triangle by all ways to shade it, by the definition: the normal by the inverse
/// transpose, Lambert's law, and the lamp's distance.
#[test]
fn light_is_that_of_a_model_made_in_the_shape() {
    const SUN: Vec3 = Vec3::lit("-2", "3", "4");
    let mut random = Random::new(45);
    let (mut lit, mut near) = (0, 0);
    for _ in 0..4000 {
        let shape = regular_matrix(&mut random);
        let turn = Rotation::about_y(Turn::from_bits(random.bits() as u32))
            * Rotation::about_x(Turn::from_bits(random.bits() as u32));
        let pose = Pose::rotated(turn).at(Vec3::lit("1", "-2", "-70"));
        let positions = [(); 3].map(|()| [(); 3].map(|()| random.bits() as i16));
        let sides = [1, 2].map(|i| minus(positions[i].map(f64::from), positions[0].map(f64::from)));
        let normal = unit(cross(sides[0], sides[1])).map(|c| (c * 127.0).round() as i8);
        let (of_vertices, of_faces) = ([normal; 3], [normal]);
        let mesh = Mesh::new(Tables {
            positions: Positions::I16(&positions),
            scale: Scale::new(1, -12),
            offset: Vec3::lit("0.5", "1", "-0.25"),
            vertex_normals: Normals::I8(&of_vertices),
            face_normals: Normals::I8(&of_faces),
            triangles: Triangles::U8(&[[0, 1, 2]]),
            materials: const { &[Material::new([255; 3], 1)] },
            ..Tables::EMPTY
        })
        .unwrap();

        let world = |p: Vector| {
            let offset = [0.5, 1.0, -0.25];
            let turned =
                rotated(&turn, changed(&shape, [0, 1, 2].map(|i| p[i] / 4096.0 + offset[i])));
            [turned[0] + 1.0, turned[1] - 2.0, turned[2] - 70.0]
        };
        let middle =
            [0, 1, 2].map(|i| positions.iter().map(|p| f64::from(p[i])).sum::<f64>() / 3.0);
        let place = world(middle);
        let corners = positions.map(|p| world(p.map(f64::from)));
        // Wide enough on the screen that the middle pixel is inside.
        let area = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))[2];
        if area.abs() < 0.5 {
            continue;
        }
        let bits = place.map(|c| (c * 65_536.0).round() as i32);
        let eye = Vec3::from_bits([bits[0], bits[1], 0]);
        let posed = (&shape, pose);
        let n = unit(rotated(&turn, inverse_transpose(&shape, normal.map(f64::from))));
        let sun = Light::new(SUN, Level::lit("0.1"), Level::lit("0.9"));
        let want = 0.1 + 0.9 * dot(n, unit(numbers(SUN))).max(0.0);
        // Half a 127th in each coordinate of the normal; a step of light, half of one for rounding
        // to a colour, and the levels' own error. The normal of a pixel is off by half a degree
        // more.
        let bound = |level: f64| level * 3f64.sqrt() / 254.0 + 1.5 / 255.0 + 2f64.powi(-11);
        let check = |got: f64, want: f64, bound: f64, name: &str| {
            assert!((got - want).abs() < bound, "{name}: {got} {want} {shape:?}");
        };
        check(brightness(Flat::new(sun), &mesh, posed, eye), want, bound(0.9), "flat");
        check(brightness(Gouraud::new(sun), &mesh, posed, eye), want, bound(0.9), "gouraud");
        let pixel = bound(0.9) + 0.9 * 0.5f64.to_radians();
        check(brightness(Phong::new(sun), &mesh, posed, eye), want, pixel, "phong");
        lit += usize::from(want > 0.2);

        // A lamp above the triangle's middle, somewhat to the side.
        let side = |random: &mut Random| f64::from(random.within(-4 << 16, 4 << 16)) / 65_536.0;
        let away = [0, 1, 2].map(|i| place[i] + 4.0 * n[i] + side(&mut random));
        let lamp = Vec3::from_bits(away.map(|c| (c * 65_536.0).round() as i32));
        let (half, level) = (Distance::lit("6"), Level::lit("0.9"));
        let way = minus(numbers(lamp), place);
        if dot(way, way) < 1.0 {
            continue;
        }
        let shone = 0.9 / (1.0 + dot(way, way) / 36.0) * dot(n, unit(way)).max(0.0);
        let got = brightness(Flat::new(Lamp::new(lamp, half, level)), &mesh, posed, eye);
        // The positions of a shape of some ten units are off by a 2^12th of one, the middle by one
        // of the table's.
        check(got, shone, bound(0.9), "lamp");
        near += usize::from(shone > 0.2);
    }
    assert!(lit > 800 && near > 800, "{lit} {near}");
}

/// A shape that stretches by whole numbers is that of a mesh with such positions: planes cut it,
/// and it casts its shadow, in the same places.
#[test]
fn planes_and_shadows_are_those_of_a_mesh_in_the_shape() {
    let mut random = Random::new(46);
    let (mut kept, mut cast) = (0, 0);
    for _ in 0..3000 {
        let factors = [(); 3].map(|()| random.pick(&[-3i16, -2, -1, 1, 2, 3]));
        let positions: Vec<[i16; 3]> =
            (0..9).map(|_| [(); 3].map(|()| random.within(-9000, 9000) as i16)).collect();
        let stretched =
            positions.iter().map(|p| [0, 1, 2].map(|i| p[i] * factors[i])).collect::<Vec<_>>();
        let triangles: Vec<[u16; 3]> = vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]];
        let surface = Surface::new(positions, triangles.clone()).scaled(-13);
        let made = Surface::new(stretched, triangles).scaled(-13);
        let (mesh, made) = (surface.mesh(), made.mesh());
        let [x, y, z] = factors.map(|c| Scalar::from_num(c));
        let shape = Matrix::scaling(x, y, z);
        let turn = Rotation::about_y(Turn::from_bits(random.bits() as u32))
            * Rotation::about_x(Turn::from_bits(random.bits() as u32));
        let pose =
            Pose::rotated(turn).at(Vec3::lit("0.3", "-0.2", "0.1")).scaled(Distance::lit("7"));
        let camera = pixel_camera(area(0, 0, 300, 300));
        let white = Unlit::<Rgb888>::new();
        let plane = Plane::new(Vec3::lit("1", "2", "0.5"), Scalar::from_num(random.within(-9, 9)));
        let same = |a: &[Placed<S8>], b: &[Placed<S8>]| {
            let pairs = a.iter().zip(b).filter_map(|(a, b)| Some((a.position()?, b.position()?)));
            for (a, b) in pairs.clone() {
                let apart = (0..2).map(|i| a[i].abs_diff(b[i])).max();
                // Each is within 5/8 of the exact place.
                assert!(apart <= Some(1), "{a:?} {b:?}");
            }
            let is_placed = |v: &Placed<S8>| v.position().is_some();
            assert!(a.iter().map(is_placed).eq(b.iter().map(is_placed)));
            pairs.count()
        };
        let mut storage = [[Placed::<S8>::EMPTY; 9]; 2];
        let [a, b] = &mut storage;
        let cut = ClipPlanes::in_world([plane]);
        let a =
            Object::new(&mesh, white).posed(pose).clipped(cut).shaped(&shape).project(&camera, a);
        let b = Object::new(&made, white).posed(pose).clipped(cut).project(&camera, b);
        kept += same(a.unwrap().vertices(), b.unwrap().vertices());
        let mut storage = [[Placed::<S8>::EMPTY; 9]; 2];
        let [a, b] = &mut storage;
        let shadow = PlanarShadow::new(plane, Vec3::lit("0.5", "2", "1"));
        let a = Object::new(&mesh, white)
            .posed(pose)
            .clipped(shadow)
            .shaped(&shape)
            .project(&camera, a);
        let b = Object::new(&made, white).posed(pose).clipped(shadow).project(&camera, b);
        if let (Ok(a), Ok(b)) = (a, b) {
            cast += same(a.vertices(), b.vertices());
        }
    }
    assert!(kept > 8000 && cast > 8000, "{kept} {cast}");
}
