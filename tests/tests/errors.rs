//! Objects that cannot be drawn are rejected before the first pixel, and several objects share one
//! frame.

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::Rectangle,
};
use fixed::types::U16F16;
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{Pose, PoseError, Projection, ScreenVertex},
    mesh::{Mesh, MeshMaterial, MeshVertex, Normals, RequiredTables, Tables, TextureCoordinates},
    numbers::{Rotation, S4, S8, Scale, Turn, Vec3},
    output::{Direct, Frame},
    raster::Fragment,
    scene::{DrawError, Object, ProjectError},
    shade::{Flat, Gouraud, Level, Light, OnScreen, Shader, Unlit},
};
use rasterizer_tests::{Picture, Recorder, Surface, area};

const DISPLAY: Rectangle = area(0, 0, 40, 30);
const BACKGROUND: Rgb888 = Rgb888::new(1, 2, 3);

/// A shader that reads texture coordinates.
#[derive(Clone, Debug)]
struct Textured;

impl Shader for Textured {
    type Color = Rgb888;
    type Varyings = [u16; 2];
    type Surface = ();
    type Face = ();
    type Outcome = Rgb888;
    const TABLES: RequiredTables =
        RequiredTables { texture_coordinates: true, ..RequiredTables::NONE };

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 2] {
        vertex.texture_coordinates().map(|c| c as u16)
    }

    fn pixel(&self, (): &(), (): &(), _: Fragment<[U16F16; 2]>) -> Rgb888 {
        Rgb888::new(9, 9, 9)
    }
}

const fn light() -> Light {
    Light::new(Vec3::Z, Level::ONE, Level::ZERO)
}

fn perspective() -> Camera {
    let lens =
        Perspective::new(Turn::degrees(60), Distance::lit("0.1"), Distance::lit("100")).unwrap();
    Camera::at(Vec3::lit("0", "0", "4"), Rotation::IDENTITY, lens, DISPLAY).unwrap()
}

/// Returns why an object is not drawn. Nothing reaches the target.
fn refused<P: Projection, Sh: Shader<Color = Rgb888>>(
    object: &Object<'_, Sh>,
    camera: &Camera<P>,
    room: usize,
) -> ProjectError {
    let mut storage = vec![ScreenVertex::<S8, NoDepth, OnScreen<Sh>>::EMPTY; room];
    let mut display = Recorder::new(DISPLAY);
    let drawn = object.draw(camera, &mut storage, &mut Direct::new(&mut display));
    assert_eq!(display.calls(), []);
    match drawn {
        Err(DrawError::Project(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn storage_must_hold_every_vertex() {
    let cube = Surface::cube(10_000, 2).scaled(-14);
    let mesh = cube.mesh();
    let needed = mesh.vertex_count();
    let object = Object::new(&mesh, Unlit::new());
    for room in [0, 1, needed - 1] {
        let error = refused(&object, &perspective(), room);
        assert_eq!(error, ProjectError::VertexStorage { needed });
        assert_eq!(error.to_string(), format!("the mesh needs storage for {needed} vertices"));
    }
    for room in [needed, needed + 7] {
        let mut storage = vec![ScreenVertex::<S4, NoDepth, [u16; 0]>::EMPTY; room];
        let mut display = Recorder::new(DISPLAY);
        assert_eq!(
            object.draw(&perspective(), &mut storage, &mut Direct::new(&mut display)),
            Ok(())
        );
        assert!(!display.calls().is_empty());
        assert_eq!(object.project(&perspective(), &mut storage).unwrap().vertices().len(), needed);
    }
}

#[test]
fn shaders_need_their_tables() {
    let cube = Surface::cube(10_000, 2).scaled(-14);
    let mesh = cube.mesh();
    let room = mesh.vertex_count();
    let smooth = Object::new(&mesh, Gouraud::new(light()));
    assert_eq!(refused(&smooth, &perspective(), room), ProjectError::NoVertexNormals);
    let flat = Object::new(&mesh, Flat::new(light()));
    assert_eq!(refused(&flat, &perspective(), room), ProjectError::NoFaceNormals);
    let textured = Object::new(&mesh, Textured);
    assert_eq!(refused(&textured, &perspective(), room), ProjectError::NoTextureCoordinates);

    let normals = vec![[0, 0, 127]; mesh.triangle_count()];
    let coordinates = vec![[7, 7]; room];
    let tables = Tables {
        face_normals: Normals::I8(&normals),
        texture_coordinates: TextureCoordinates::I16(&coordinates),
        ..*mesh.tables()
    };
    let mesh = Mesh::new(tables).unwrap();
    let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
    picture.draw(&mesh, Flat::new(light()), &perspective());
    assert!(picture.color.iter().any(|&color| color != BACKGROUND));
    let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
    picture.draw(&mesh, Textured, &perspective());
    assert!(picture.color.contains(&Rgb888::new(9, 9, 9)));
    // One table is still missing.
    let smooth = Object::new(&mesh, Gouraud::new(light()));
    assert_eq!(refused(&smooth, &perspective(), room), ProjectError::NoVertexNormals);
}

/// A model 2^100 units wide is refused, and so is one that the scale of its pose carries 2^31 units
/// away, in perspective too.
#[test]
fn objects_beyond_all_numbers_are_refused() {
    let far_off = ProjectError::Pose(PoseError);
    let huge = Distance::MAX;
    let mut cube = Surface::cube(10_000, 2).scaled(100);
    let lens = Orthographic::new(Distance::ONE, Distance::ONE, huge).unwrap();
    let parallel = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, DISPLAY).unwrap();
    {
        let mesh = cube.mesh();
        assert_eq!(refused(&Object::new(&mesh, Unlit::new()), &parallel, 100), far_off);
        assert_eq!(refused(&Object::new(&mesh, Unlit::new()), &perspective(), 100), far_off);
    }
    cube.scale = Scale::ONE;
    cube.offset = Vec3::lit("32767", "-32768", "32767");
    let mesh = cube.mesh();
    let eighth = Pose::rotated(Rotation::about_z(Turn::degrees(45)));
    let carried_off = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(eighth.scaled(huge));
    assert_eq!(refused(&carried_off, &perspective(), 100), far_off);
    assert_eq!(refused(&carried_off, &parallel, 100), far_off);
    assert_eq!(
        far_off.to_string(),
        "the object is too large for how near it comes: move the near plane away, use S8, split the \
         mesh, or make its scale or its offset smaller"
    );
}

/// An unlit ball, a smooth one that cuts into it, and one with a user's shader. In every order of
/// drawing each pixel shows the nearest.
#[test]
fn objects_with_different_shaders_hide_each_other() {
    let ball = |offset: Vec3, color: [u8; 3]| {
        let mut ball = Surface::ball(10_000, 8).scaled(-13).with_vertex_normals().colored(color);
        ball.offset = offset;
        ball
    };
    let balls = [
        ball(Vec3::lit("-0.7", "0", "0"), [255, 0, 0]),
        ball(Vec3::lit("0.7", "0.2", "0.3"), [0, 255, 0]),
        ball(Vec3::lit("0", "-0.4", "-0.5"), [0, 0, 255]),
    ];
    let draw = |picture: &mut Picture<Rgb888, u16>, index: usize| {
        let mesh = balls[index].mesh();
        match index {
            0 => picture.draw(&mesh, Unlit::new(), &perspective()),
            // Ambient light only: the material's colour everywhere.
            1 => picture.draw(&mesh, Gouraud::new(light()), &perspective()),
            _ => picture.draw(&mesh, Blue, &perspective()),
        }
    };
    let alone = [0, 1, 2].map(|index| {
        let mut picture = Picture::empty(DISPLAY, BACKGROUND);
        draw(&mut picture, index);
        picture
    });
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let mut together = Picture::empty(DISPLAY, BACKGROUND);
        order.into_iter().for_each(|index| draw(&mut together, index));
        let mut seen = [0; 3];
        for pixel in 0..together.color.len() {
            // The first drawn wins a tie.
            let winner = order.into_iter().reduce(|best, next| {
                if alone[next].depth[pixel] > alone[best].depth[pixel] { next } else { best }
            });
            let winner = &alone[winner.unwrap()];
            assert_eq!(together.color[pixel], winner.color[pixel], "{order:?}, pixel {pixel}");
            assert_eq!(together.depth[pixel], winner.depth[pixel], "{order:?}, pixel {pixel}");
            for (index, seen) in seen.iter_mut().enumerate() {
                *seen +=
                    usize::from(winner.depth[pixel] != 0 && winner.color == alone[index].color);
            }
        }
        assert!(seen.iter().all(|&pixels| pixels > 20), "{seen:?}");
    }
}

/// A shader that shows only the blue of a material.
#[derive(Clone, Debug)]
struct Blue;

impl Shader for Blue {
    type Color = Rgb888;
    type Varyings = [u16; 1];
    type Surface = Rgb888;
    type Face = ();
    type Outcome = Rgb888;

    fn surface(&self, material: &MeshMaterial<'_>) -> Rgb888 {
        let blue = material.rgb().b();
        Rgb888::new(0, 0, blue)
    }

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 1] {
        [vertex.position()[1] as u16 ^ 0x8000]
    }

    fn pixel(&self, surface: &Rgb888, (): &(), _: Fragment<[U16F16; 1]>) -> Rgb888 {
        *surface
    }
}

/// The same surface twice, in two colours: depths are equal, and the second changes no pixel.
#[test]
fn what_is_drawn_first_wins_a_tie() {
    let [first, second] =
        [[255, 0, 0], [0, 255, 0]].map(|color| Surface::ball(10_000, 8).scaled(-13).colored(color));
    let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
    picture.draw(&first.mesh(), Unlit::new(), &perspective());
    let once = picture.clone();
    picture.draw(&second.mesh(), Unlit::new(), &perspective());
    assert!(picture == once);
    assert!(once.color.contains(&Rgb888::new(255, 0, 0)));
    // Without depth the last one wins.
    let mut colors = once.color.clone();
    let mut frame = Frame::without_depth(&mut colors, DISPLAY).unwrap();
    let mesh = second.mesh();
    let mut storage = vec![ScreenVertex::<S8, NoDepth, [u16; 0]>::EMPTY; mesh.vertex_count()];
    Object::new(&mesh, Unlit::new()).draw(&perspective(), &mut storage, &mut frame).unwrap();
    assert!(!colors.contains(&Rgb888::new(255, 0, 0)) && colors.contains(&Rgb888::new(0, 255, 0)));
}
