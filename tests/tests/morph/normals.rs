//! Normals between two shapes, and the light on them, against f64.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    camera::{Camera, Perspective},
    geometry::ScreenVertex,
    mesh::{
        Keyframe, Keyframes, Material, Mesh, Normals, Positions, Progress, Tables, Triangles,
        Tween, shapes::Solid,
    },
    numbers::S4,
    output::Frame,
    scene::Object,
    shade::{Flat, Gouraud, Phong, Shader},
};
use rasterizer_tests::{
    Random,
    vector::{dot, unit},
};

use super::{
    DISPLAY, LIGHT, PIXELS, Shape, TRIANGLES, VERTICES, any_progress, camera, degrees, lerp,
    normal, part,
};

/// The level of light on a triangle, by the definition: the direction of the blend of both normals,
/// and Lambert's law.
#[test]
fn light_is_that_of_the_blended_normal() {
    let mut random = Random::new(52);
    let camera = camera("4");
    let (mut lit, mut wide) = (0, 0);
    for _ in 0..6000 {
        let mut any = || unit([(); 3].map(|()| f64::from(random.within(-999, 999)) + 0.5));
        let (from, to) = (normal(any()), normal(any()));
        let progress = any_progress(&mut random);
        let blend = lerp(from, to, part(progress));
        // Of nearly opposite normals the core and this have other roundings of a short vector; the
        // blend is exact in both while it is a normal of some length.
        if dot(blend, blend).sqrt() < 1.0 {
            continue;
        }
        let (of_vertices, of_faces) = ([from; 3], [from]);
        let positions = [[-9000, -9000, 0], [9000, -9000, 0], [0, 15_000, 0]];
        let mesh = Mesh::new(Tables {
            positions: Positions::I16(&positions),
            scale: Solid::<VERTICES, TRIANGLES>::SCALE,
            vertex_normals: Normals::I8(&of_vertices),
            face_normals: Normals::I8(&of_faces),
            triangles: Triangles::U8(&[[0, 1, 2]]),
            materials: const { &[Material::new([255; 3], 1)] },
            ..Tables::EMPTY
        })
        .unwrap();
        let further = [Keyframe {
            positions: Positions::I16(&positions),
            vertex_normals: Normals::I8(&[to; 3]),
            face_normals: Normals::I8(&[to]),
        }];
        let keyframes = Keyframes::new(&mesh, &further).unwrap();
        let tween = keyframes.between(0, 1, progress).unwrap();
        let n = unit(blend);
        let want = 0.1 + 0.9 * dot(n, unit([-1.0, 2.0, 3.0])).max(0.0);
        // Half a 127th in each coordinate of the normal, and its direction within 2^-13; a step of
        // light, half of one for rounding to a colour, and the levels' own error. The normal of a
        // pixel is off by half a degree more.
        let bound = 0.9 * (3f64.sqrt() / 254.0 + 2f64.powi(-13)) + 1.5 / 255.0 + 2f64.powi(-11);
        fn middle<Sh: Shader<Color = Rgb888>>(
            tween: &Tween<'_>,
            shader: Sh,
            camera: &Camera<Perspective>,
        ) -> f64 {
            let (mut color, mut depth) = (vec![Rgb888::BLACK; PIXELS], vec![0_u16; PIXELS]);
            let mut frame = Frame::new(&mut color, &mut depth, DISPLAY).unwrap();
            let mut storage = [ScreenVertex::<S4, _, _>::EMPTY; 3];
            Object::morphed(tween, shader).draw(camera, &mut storage, &mut frame).unwrap();
            f64::from(color[PIXELS / 2 + 80].r()) / 255.0
        }
        let check = |got: f64, bound: f64, name: &str| {
            assert!((got - want).abs() < bound, "{name}: {got} {want}, {from:?} {to:?} {progress}");
        };
        check(middle(&tween, Flat::new(LIGHT), &camera), bound, "flat");
        let gouraud = Gouraud::<_, 256>::with_levels(LIGHT);
        check(middle(&tween, gouraud, &camera), bound, "gouraud");
        let pixel = bound + 0.9 * 0.5f64.to_radians();
        let phong = Phong::new(LIGHT).with_levels::<256>();
        check(middle(&tween, phong, &camera), pixel, "phong");
        lit += usize::from(want > 0.2);
        wide += usize::from(degrees(from.map(f64::from), to.map(f64::from)) > 90.0);
    }
    assert!(lit > 1500 && wide > 1500, "{lit} {wide}");
}

/// The normals that shaders get, against f64: 127 long, in the direction of the blend, and between
/// opposite ones none in the middle.
#[test]
fn normals_are_as_long_as_those_of_tables() {
    let (from, to) = (Shape::ball(), Shape::twisted());
    let (first, further) = (from.mesh(), [to.keyframe()]);
    let ball = Keyframes::new(&first, &further).unwrap();
    let mut worst = 0.0_f64;
    for step in 1..32 {
        let progress = Progress::from_bits(step << 10);
        let tween = ball.between(0, 1, progress).unwrap();
        let shape = Shape::of(&tween);
        let pairs = from.vertex_normals.iter().zip(&to.vertex_normals).zip(&shape.vertex_normals);
        for ((&from, &to), &got) in pairs {
            let blend = lerp(from, to, part(progress));
            let length = dot(got.map(f64::from), got.map(f64::from)).sqrt();
            // Half the diagonal of a cube of side 1, and 2^-13 of the length.
            assert!((length - 127.0).abs() < 0.75f64.sqrt() + 0.02, "{got:?}");
            worst = worst.max(degrees(got.map(f64::from), blend));
        }
    }
    assert!((0.2..0.4).contains(&worst), "{worst} degrees");

    let opposite = |progress| {
        let (up, down) = ([[0, 127, 0]; VERTICES], [[0, -127, 0]; VERTICES]);
        let shape = |normals: &[[i8; 3]; VERTICES]| Shape {
            vertex_normals: normals.to_vec(),
            ..Shape::ball()
        };
        let (from, to) = (shape(&up), shape(&down));
        let (first, further) = (from.mesh(), [to.keyframe()]);
        let keyframes = Keyframes::new(&first, &further).unwrap();
        Shape::of(&keyframes.between(0, 1, progress).unwrap()).vertex_normals[0]
    };
    assert_eq!(opposite(Progress::lit("0.4999")), [0, 127, 0]);
    assert_eq!(opposite(Progress::lit("0.5")), [0; 3]);
    assert_eq!(opposite(Progress::lit("0.5001")), [0, -127, 0]);
}

/// How far the direction of a blend is from one that turns at an even speed: the figures of the
/// documentation.
#[test]
fn blended_normals_turn_nearly_evenly() {
    for (apart, most) in [(30.0, 0.14), (60.0, 1.12), (90.0, 4.08), (120.0, 10.95)] {
        let (sin, cos) = f64::to_radians(apart).sin_cos();
        let off = (0..=1000).map(|step| {
            let t = f64::from(step) / 1000.0;
            let blend = lerp([1.0, 0.0, 0.0], [cos, sin, 0.0], t);
            (degrees([1.0, 0.0, 0.0], blend) - t * apart).abs()
        });
        let worst = off.fold(0.0, f64::max);
        assert!((0.95 * most..most).contains(&worst), "{apart}: {worst}");
    }
}
