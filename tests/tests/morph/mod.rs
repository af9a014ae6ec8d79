//! Meshes between two shapes, against f64: where their vertices lie, their normals, and that every
//! way to draw them shows what a mesh of that shape shows.

mod any_shape;
mod normals;

use std::cell::RefCell;

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::Rectangle,
};
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::{CullNone, Pose, Projection, ScreenVertex},
    mesh::{
        Keyframe, Keyframes, Material, Mesh, MeshError, MeshFace, MeshMaterial, MeshVertex,
        Normals, Positions, Progress, Tables, TextureCoordinates, Triangles, Tween,
        shapes::{Solid, UvSphere},
    },
    numbers::{Matrix, Rotation, S4, S8, Scalar, Subpixel, Turn, Vec3},
    output::{Frame, Replace},
    raster::{Fragment, Gradients},
    scene::{Mode, Object, Painter, Projected, Vertices},
    shade::{
        Face, Flat, Gouraud, Level, Light, OnScreen, Phong, Sample, Shader, TexturedGouraud, Unlit,
    },
    texture::{Colors, Texture},
};
use rasterizer_tests::{
    Placed, Random, Surface, area,
    ends::{self, Stage},
    exact::{Lens, judge_placed},
    places,
    vector::{Vector, angle, cross, dot, minus, unit},
};

fn degrees(a: Vector, b: Vector) -> f64 {
    angle(a, b).to_degrees()
}

fn part(progress: Progress) -> f64 {
    progress.to_num::<f64>().min(1.0)
}

/// A blend by its definition.
fn lerp<T: Into<f64> + Copy>(from: [T; 3], to: [T; 3], t: f64) -> Vector {
    [0, 1, 2].map(|i| from[i].into() * (1.0 - t) + to[i].into() * t)
}

fn any_progress(random: &mut Random) -> Progress {
    let bits = if random.coin() {
        random.pick(&[0, 1, 1 << 14, 0x7FFF, 1 << 15, u16::MAX])
    } else {
        random.within(0, 1 << 15) as u16
    };
    Progress::from_bits(bits)
}

/// Stages whose surface is a blend, rounded to the nearest quantum: within half of one of the exact
/// blend. A vertex is then within 5/8 of a sub-pixel, as that of a mesh is.
#[test]
fn vertices_between_two_shapes_lie_where_they_should() {
    fn placed<S: Subpixel, P: Projection>(
        stage: &Stage,
        tween: &Tween<'_>,
        camera: Camera<P>,
        lens: &Lens,
    ) -> usize {
        let object = Object::morphed(tween, Unlit::<Rgb888>::new()).posed(stage.pose);
        let mut storage = vec![Placed::<S>::EMPTY; tween.mesh().vertex_count()];
        let Ok(projected) = object.project(&camera, &mut storage) else {
            return 0;
        };
        let placed = places(projected.vertices());
        judge_placed::<S, P>(stage, &Matrix::IDENTITY, (camera, lens), &placed).placed
    }
    let mut random = Random::new(51);
    let mut counts = [0; 2];
    for _ in 0..60_000 {
        let stage = ends::stage(&mut random);
        let from = stage.surface.mesh();
        let count = from.vertex_count();
        let range = random.within(0, 15);
        let to: Vec<[i16; 3]> =
            (0..count).map(|_| [(); 3].map(|()| random.bits() as i16 >> range)).collect();
        let further = [Keyframe { positions: Positions::I16(&to), ..Keyframe::EMPTY }];
        let keyframes = Keyframes::new(&from, &further).unwrap();
        let progress = any_progress(&mut random);
        let tween = keyframes.between(0, 1, progress).unwrap();
        let mut blended = Vec::new();
        for (index, &to) in to.iter().enumerate() {
            let from = from.tables().positions.get(index).unwrap();
            let exact = lerp(from, to, part(progress));
            let got = tween.position(index).unwrap();
            let rounded = exact.map(|c| (c + 0.5).floor() as i16);
            assert_eq!(got, rounded, "{from:?} to {to:?} at {progress}");
            assert!((0..3).all(|i| (f64::from(got[i]) - exact[i]).abs() <= 0.5));
            let bounds = keyframes.mesh().bounds();
            assert!((0..3).all(|i| (bounds.min[i]..=bounds.max[i]).contains(&got[i])));
            blended.push(got);
        }
        let triangles = (0..from.triangle_count())
            .map(|index| from.tables().triangles.get(index).unwrap().map(|corner| corner as u16));
        let mut surface = Surface::new(blended, triangles.collect());
        (surface.scale, surface.offset) = (stage.surface.scale, stage.surface.offset);
        let shown = Stage { surface, ..stage.clone() };
        let [near, far] = ends::depth_range(&mut random);
        let focal = ends::distance(&mut random);
        let lens = Perspective::with_focal_length(focal, near, far).unwrap();
        let camera = stage.camera(lens, ends::viewport(&mut random));
        let exact = Lens::perspective(&lens, focal.to_num());
        counts[0] += placed::<S4, _>(&shown, &tween, camera, &exact);
        counts[1] += placed::<S8, _>(&shown, &tween, camera, &exact);
    }
    assert!(counts.iter().all(|&count| count > 3000), "{counts:?}");
}

const SPHERE: UvSphere = UvSphere::new(20, 10);
const VERTICES: usize = SPHERE.vertices();
const TRIANGLES: usize = SPHERE.triangles();
static BALL: Solid<VERTICES, TRIANGLES> = SPHERE.solid();
const MATERIALS: [Material; 2] =
    [Material::new([230, 180, 60], 100), Material::new([60, 180, 230], TRIANGLES as u32 - 100)];

/// Positions and normals of a mesh.
#[derive(Clone, Debug)]
struct Shape {
    positions: Vec<[i16; 3]>,
    vertex_normals: Vec<[i8; 3]>,
    face_normals: Vec<[i8; 3]>,
}

fn normal(v: Vector) -> [i8; 3] {
    unit(v).map(|c| (c * 127.0).round() as i8)
}

impl Shape {
    fn ball() -> Self {
        Self {
            positions: BALL.positions.into(),
            vertex_normals: BALL.vertex_normals.into(),
            face_normals: BALL.face_normals.into(),
        }
    }

    /// The ball twisted round its axis and drawn out along it, and moved.
    fn twisted() -> Self {
        let twist = |v: [f64; 3], height: f64| {
            let (sin, cos) = (height / 16_384.0 * 0.9).sin_cos();
            [v[0] * cos + v[2] * sin, v[1], v[2] * cos - v[0] * sin]
        };
        let positions: Vec<_> = (BALL.positions.iter())
            .map(|p| {
                let [x, y, z] = twist(p.map(f64::from), p[1].into());
                [x * 0.7 + 900.0, y * 1.6, z * 0.8].map(|c| c.round() as i16)
            })
            .collect();
        let normals = BALL.vertex_normals.iter().zip(&BALL.positions);
        let vertex_normals =
            normals.map(|(n, p)| normal(twist(n.map(f64::from), p[1].into()))).collect();
        let face_normals = BALL.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|corner| positions[usize::from(corner)].map(f64::from));
            let across = cross(minus(b, a), minus(c, a));
            if dot(across, across) == 0.0 { [0, 127, 0] } else { normal(across) }
        });
        Self { face_normals: face_normals.collect(), vertex_normals, positions }
    }

    fn keyframe(&self) -> Keyframe<'_> {
        Keyframe {
            positions: Positions::I16(&self.positions),
            vertex_normals: Normals::I8(&self.vertex_normals),
            face_normals: Normals::I8(&self.face_normals),
        }
    }

    fn mesh(&self) -> Mesh<'_> {
        let Keyframe { positions, vertex_normals, face_normals } = self.keyframe();
        Mesh::new_const(Tables {
            positions,
            scale: Solid::<VERTICES, TRIANGLES>::SCALE,
            vertex_normals,
            face_normals,
            texture_coordinates: TextureCoordinates::I16(&BALL.texture_coordinates),
            triangles: Triangles::U16(&BALL.triangles),
            materials: &MATERIALS,
            ..Tables::EMPTY
        })
    }

    /// What the core makes of a tween: the tables of a mesh of that shape.
    fn of(tween: &Tween<'_>) -> Self {
        let recorder = Recorder::default();
        // Far enough away that all of it is in the picture.
        let camera = camera("9");
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 0]>::EMPTY; VERTICES];
        let mut pixels = (vec![Rgb888::default(); PIXELS], vec![0; PIXELS]);
        let mut frame = Frame::new(&mut pixels.0, &mut pixels.1, DISPLAY).unwrap();
        // Both sides, so that the shader sees every face.
        let object = Object::morphed(tween, &recorder).culled(CullNone);
        object.draw(&camera, &mut storage, &mut frame).unwrap();
        let faces = recorder.faces.into_inner();
        Self {
            positions: (0..VERTICES).map(|index| tween.position(index).unwrap()).collect(),
            vertex_normals: recorder.vertices.into_inner(),
            face_normals: (0..TRIANGLES)
                .map(|index| {
                    let face = faces.iter().find(|(face, _)| *face == index);
                    // Only a triangle without area is not drawn.
                    face.map_or([0, 127, 0], |(_, normal)| *normal)
                })
                .collect(),
        }
    }
}

/// Notes the normals that a shader gets.
#[derive(Debug, Default)]
struct Recorder {
    vertices: RefCell<Vec<[i8; 3]>>,
    faces: RefCell<Vec<(usize, [i8; 3])>>,
}

impl Shader for &Recorder {
    type Color = Rgb888;
    type Varyings = [u16; 0];
    type Surface = ();
    type Face = ();
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 0] {
        self.vertices.borrow_mut().push(vertex.normal());
        []
    }

    fn face(&self, (): &(), face: &MeshFace<'_>, _: &Gradients<'_, [u16; 0]>) -> Face<Rgb888, ()> {
        self.faces.borrow_mut().push((face.index(), face.normal()));
        Face::Solid(Rgb888::default())
    }

    fn pixel(&self, (): &(), (): &(), _: Fragment<Sample<Self>>) -> Rgb888 {
        Rgb888::default()
    }
}

const DISPLAY: Rectangle = area(0, 0, 160, 120);
const PIXELS: usize = 160 * 120;

fn camera(distance: &str) -> Camera<Perspective> {
    let lens = Perspective::new(Turn::degrees(40), Distance::lit("0.5"), Distance::lit("100"));
    let eye = Vec3::lit("0.2", "0.3", distance);
    Camera::at(eye, Rotation::IDENTITY, lens.unwrap(), DISPLAY).unwrap()
}

const LIGHT: Light = Light::new(Vec3::lit("-1", "2", "3"), Level::lit("0.1"), Level::lit("0.9"));
static TEXTURES: [Texture<Colors<'static, Rgb888, 8>, 4, 2>; 2] =
    [Texture::new(Colors::new(&TEXELS)), Texture::new(Colors::new(&TEXELS))];
static TEXELS: [Rgb888; 8] = {
    let mut texels = [Rgb888::BLACK; 8];
    let mut i = 0;
    while i < 8 {
        texels[i] = Rgb888::new(30 * i as u8, 255 - 20 * i as u8, 90 * (i as u8 & 1));
        i += 1;
    }
    texels
};

/// The pixels that an object draws, in its storage's order of triangles, and their depth.
fn pixels<V, P, Sh, M>(projected: &Projected<'_, V, P, Sh, M>) -> (Vec<Rgb888>, Vec<u16>)
where
    V: Vertices<OnScreen<Sh>, Depth = u16>,
    P: Projection,
    Sh: Shader<Color = Rgb888>,
    M: Mode<Blending = Replace>,
{
    let (mut color, mut depth) = (vec![Rgb888::BLACK; PIXELS], vec![0; PIXELS]);
    // In two bands, so that bounds of rows are used too.
    for (half, (color, depth)) in
        color.chunks_mut(PIXELS / 2).zip(depth.chunks_mut(PIXELS / 2)).enumerate()
    {
        let part = area(0, 60 * half as i32, 160, 60);
        projected.draw(&mut Frame::new(color, depth, part).unwrap()).unwrap();
    }
    (color, depth)
}

/// Draws an object in all ways, of which each must show the same. Returns the pixels; `None` if it
/// is refused.
fn drawn<S, Sh, M>(object: &Object<'_, Sh, M>, camera: &Camera<Perspective>) -> Option<Vec<Rgb888>>
where
    S: Subpixel + Default,
    Sh: Shader<Color = Rgb888>,
    M: Mode<Blending = Replace>,
{
    let mut storage = vec![ScreenVertex::<S, u16, OnScreen<Sh>>::EMPTY; VERTICES];
    let stored = object.project(camera, &mut storage).ok()?;
    let (color, depth) = pixels(&stored);
    let on_demand = object.project_on_demand(camera, S::default()).unwrap();
    assert!(pixels(&on_demand) == (color.clone(), depth), "on demand");
    let mut words = [0; TRIANGLES];
    let mut sorted = vec![Rgb888::BLACK; PIXELS];
    let mut depth = vec![0_u16; PIXELS];
    let mut frame = Frame::new(&mut sorted, &mut depth, DISPLAY).unwrap();
    Painter::new((&stored,), &mut words).unwrap().draw(&mut frame).unwrap();
    let covered = |color: &[Rgb888]| -> Vec<bool> {
        color.iter().map(|&pixel| pixel != Rgb888::BLACK).collect()
    };
    assert!(covered(&sorted) == covered(&color), "sorted");
    Some(color)
}

/// Pictures of a tween are those of a mesh with the tables that it stands for, near and far, cut
/// at the near plane, stored and on demand, and changed by a matrix.
#[test]
fn pictures_are_those_of_a_mesh_of_that_shape() {
    let (from, to) = (Shape::ball(), Shape::twisted());
    let (first, further) = (from.mesh(), [to.keyframe()]);
    let ball = Keyframes::new(&first, &further).unwrap();
    let pose = Pose::rotated(Rotation::about_y(Turn::degrees(25)));
    let shear = Matrix::from_rows([
        [Scalar::lit("0.8"), Scalar::lit("0.4"), Scalar::ZERO],
        [Scalar::ZERO, Scalar::lit("-0.9"), Scalar::ZERO],
        [Scalar::ZERO, Scalar::ZERO, Scalar::lit("0.6")],
    ]);
    let (mut differ, mut drawn_in_all) = (0, [0; 2]);
    for progress in ["0", "0.13", "0.5", "0.9", "1", "1.5"] {
        let tween = ball.between(0, 1, Progress::lit(progress)).unwrap();
        let shape = Shape::of(&tween);
        // The bounds of a converted animation: those of all its shapes.
        let (mesh, around) = (shape.mesh(), [from.keyframe(), to.keyframe()]);
        let shown = *Keyframes::new(&mesh, &around).unwrap().mesh();
        match progress {
            "0" => assert_eq!(shown.tables().positions, first.tables().positions),
            "1" | "1.5" => assert_eq!(shape.vertex_normals, to.vertex_normals),
            _ => {}
        }
        fn compare<Sh: Shader<Color = Rgb888>>(
            (name, shader): (&str, Sh),
            (tween, shown): (&Tween<'_>, &Mesh<'_>),
            (pose, shear): (Pose, &Matrix),
            camera: &Camera<Perspective>,
        ) -> [Option<Vec<Rgb888>>; 2] {
            let morphed = Object::morphed(tween, shader.clone()).posed(pose);
            let plain = Object::new(shown, shader).posed(pose);
            let picture = drawn::<S4, _, _>(&morphed, camera);
            assert!(picture == drawn::<S4, _, _>(&plain, camera), "{name}");
            let (a, b) = (morphed.shaped(shear), plain.shaped(shear));
            let sheared = drawn::<S8, _, _>(&a, camera);
            assert!(sheared == drawn::<S8, _, _>(&b, camera), "{name}, sheared");
            [picture, sheared]
        }
        let (both, place) = ((&tween, &shown), (pose, &shear));
        for distance in ["5", "1.6", "1.25"] {
            let camera = &camera(distance);
            compare(("unlit", Unlit::new()), both, place, camera);
            compare(("flat", Flat::new(LIGHT)), both, place, camera);
            compare(("gouraud", Gouraud::new(LIGHT)), both, place, camera);
            let textured = TexturedGouraud::new(&TEXTURES, LIGHT);
            compare(("textured", textured), both, place, camera);
            let shown = compare(("phong", Phong::new(LIGHT)), both, place, camera);
            let object = Object::new(&first, Phong::new(LIGHT)).posed(pose);
            differ += usize::from(drawn::<S4, _, _>(&object, camera) != shown[0]);
            drawn_in_all.iter_mut().zip(&shown).for_each(|(n, p)| *n += usize::from(p.is_some()));
        }
    }
    // All but those of the first shape, and none is refused.
    assert!(
        differ >= 14 && drawn_in_all[0] == 18 && drawn_in_all[1] == 18,
        "{differ} {drawn_in_all:?}"
    );
}

#[test]
fn an_animation_visits_its_shapes_in_turn() {
    let positions: [[[i16; 3]; 3]; 3] = [0, 100, 300].map(|x| [[x, 0, 0], [x, 1, 0], [x, 0, 1]]);
    let mesh = Mesh::new_const(Tables {
        positions: Positions::I16(&positions[0]),
        triangles: Triangles::U8(&[[0, 1, 2]]),
        materials: const { &[Material::new([255; 3], 1)] },
        ..Tables::EMPTY
    });
    let further =
        [1, 2].map(|i| Keyframe { positions: Positions::I16(&positions[i]), ..Keyframe::EMPTY });
    let keyframes = Keyframes::new(&mesh, &further).unwrap();
    assert_eq!(keyframes.count(), 3);
    for (time, x) in [
        ("0", 0),
        ("0.25", 25),
        ("1", 100),
        ("1.5", 200),
        ("2", 300),
        ("2.5", 150),
        ("3", 0),
        ("65535.5", 50),
    ] {
        let tween = keyframes.at(Distance::lit(time));
        assert_eq!(tween.position(0), Some([x, 0, 0]), "{time}");
    }
    assert!(keyframes.between(3, 0, Progress::ZERO).is_none());
    assert!(keyframes.between(0, 3, Progress::ZERO).is_none());
    assert_eq!(keyframes.between(2, 1, Progress::ZERO).unwrap().position(3), None);

    for wrong in [
        Keyframe::EMPTY,
        Keyframe { vertex_normals: Normals::I8(&[[0; 3]; 3]), ..further[0] },
        Keyframe { face_normals: Normals::I8(&[[0; 3]]), ..further[0] },
    ] {
        let error = Keyframes::new(&mesh, &[further[0], wrong]).map(|_| ()).unwrap_err();
        assert_eq!(error, MeshError::KeyframeLength { keyframe: 1 });
        assert!(error.to_string().ends_with("(keyframe 1)"), "{error}");
    }
}
