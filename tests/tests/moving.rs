//! Meshes whose vertices move in RAM: drawn as meshes of these tables, and safe with any position
//! that they are given.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    camera::{Camera, Perspective},
    geometry::ScreenVertex,
    mesh::{
        BoundingBox, Keyframe, Keyframes, Material, Mesh, MeshError, Moving, MovingMesh, Normals,
        Positions, Tables, Triangles,
    },
    numbers::{S4, S8, Subpixel},
    output::Frame,
    scene::Object,
    shade::{Flat, Gouraud, Level, Light, OnScreen, Shader},
};
use rasterizer_tests::{
    Random, Surface, area,
    ends::{self, Stage},
    exact::{self, Lens},
    places,
};

const LIGHT: Light = Light::new(rasterizer::numbers::Vec3::Y, Level::lit("0.1"), Level::lit("0.9"));

fn picture<S: Subpixel, Sh: Shader<Color = Rgb888>>(
    mesh: &Mesh<'_>,
    stage: &Stage,
    camera: &Camera<Perspective>,
    shader: Sh,
) -> Option<Vec<Rgb888>> {
    let mut storage = vec![ScreenVertex::<S, u16, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
    let (mut color, mut depth) = (vec![Rgb888::BLACK; 1200], vec![0_u16; 1200]);
    let mut frame = Frame::new(&mut color, &mut depth, area(0, 0, 40, 30)).unwrap();
    let object = Object::new(mesh, shader).posed(stage.pose);
    object.draw(camera, &mut storage, &mut frame).ok()?;
    Some(color)
}

/// Stages whose vertices are set anew: any value within the range or beyond it. Vertices lie where
/// those of a mesh of these positions must, within 5/8 of a sub-pixel, and pictures are those of
/// such a mesh with the range as its bounds.
#[test]
fn moved_vertices_lie_where_they_should() {
    let mut random = Random::new(71);
    let (mut placed, mut drawn, mut cut) = (0, 0, 0);
    for _ in 0..20_000 {
        let stage = ends::stage(&mut random);
        let mesh = stage.surface.mesh();
        let count = mesh.vertex_count();
        let mut positions: Vec<[i16; 3]> = vec![[0; 3]; count];
        let (mut vertex_normals, mut face_normals) =
            (vec![[0; 3]; count], vec![[0; 3]; mesh.triangle_count()]);
        let range = random.within(0, 12);
        let mut any = || [(); 3].map(|()| random.bits() as i16 >> range);
        let limits = BoundingBox::of(&[any(), any()]);
        let moving = Moving {
            positions: &mut positions,
            vertex_normals: &mut vertex_normals,
            face_normals: &mut face_normals,
        };
        let mut moved = MovingMesh::new(*mesh.tables(), moving, limits).unwrap();
        let mut set = Vec::new();
        for vertex in 0..count {
            let position = [(); 3].map(|()| random.bits() as i16 >> (range - 1).max(0));
            let inside = [0, 1, 2].map(|i| position[i].clamp(limits.min[i], limits.max[i]));
            cut += usize::from(inside != position);
            assert!(moved.set_position(vertex, position));
            assert!(moved.set_vertex_normal(vertex, position.map(i32::from)));
            set.push(inside);
        }
        assert!(!moved.set_position(count, [0; 3]) && !moved.set_vertex_normal(count, [1; 3]));
        moved.update_face_normals();
        let now = moved.mesh();
        assert_eq!(now.tables().positions, Positions::I16(&set));
        assert_eq!(now.bounds(), &limits);

        let [near, far] = ends::depth_range(&mut random);
        let focal = ends::distance(&mut random);
        let lens = Perspective::with_focal_length(focal, near, far).unwrap();
        let viewport = area(0, 0, 40, 30);
        let camera = stage.camera(lens, viewport);
        // A mesh of these positions with the same bounds.
        let tables = Tables { positions: Positions::I16(&set), ..*now.tables() };
        let made = Mesh::new(tables).unwrap();
        let around = [limits.min, limits.max].map(|corner| vec![corner; count]);
        let around = around.each_ref().map(|positions| Keyframe {
            positions: Positions::I16(positions),
            vertex_normals: now.tables().vertex_normals,
            face_normals: now.tables().face_normals,
        });
        let made = *Keyframes::new(&made, &around).unwrap().mesh();
        let shown = picture::<S8, _>(&now, &stage, &camera, Gouraud::new(LIGHT));
        assert!(shown == picture::<S8, _>(&made, &stage, &camera, Gouraud::new(LIGHT)));
        drawn += usize::from(shown.is_some());

        let triangles = (0..now.triangle_count())
            .map(|index| now.tables().triangles.get(index).unwrap().map(|corner| corner as u16));
        let mut surface = Surface::new(set.clone(), triangles.collect());
        (surface.scale, surface.offset) = (stage.surface.scale, stage.surface.offset);
        let exact = Lens::perspective(&lens, focal.to_num());
        let shown = Stage { surface, ..stage.clone() };
        let white = rasterizer::shade::Unlit::<Rgb888>::new();
        let object = Object::new(&now, white).posed(stage.pose);
        let mut storage = vec![rasterizer_tests::Placed::<S4>::EMPTY; count];
        if let Ok(projected) = object.project(&camera, &mut storage) {
            let vertices = places(projected.vertices());
            let identity = rasterizer::numbers::Matrix::IDENTITY;
            let judged =
                exact::judge_placed::<S4, _>(&shown, &identity, (camera, &exact), &vertices);
            placed += judged.placed;
        }
    }
    assert!(placed > 500 && drawn > 2000 && cut > 10_000, "{placed} {drawn} {cut}");
}

/// Normals of faces and vertices against f64: within 0.4 degrees, half the diagonal of a cube of
/// side 1 at a distance of 127 and 2^-13.
#[test]
fn computed_normals_are_those_of_the_triangles() {
    let mut random = Random::new(72);
    let mut judged = 0;
    for _ in 0..20_000 {
        let range = random.within(0, 14);
        let mut positions = [(); 3].map(|()| [(); 3].map(|()| random.bits() as i16 >> range));
        if random.within(0, 9) == 0 {
            positions = [[i16::MIN; 3], [i16::MAX, i16::MIN, i16::MAX], [i16::MIN, i16::MAX, 0]];
        }
        let [a, b, c] = positions.map(|p| p.map(f64::from));
        let side = |to: [f64; 3]| [0, 1, 2].map(|i| to[i] - a[i]);
        let (u, v) = (side(b), side(c));
        let exact =
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let (mut vertex_normals, mut face_normals) = ([[0; 3]; 3], [[5; 3]]);
        let moving = Moving {
            positions: &mut positions,
            vertex_normals: &mut vertex_normals,
            face_normals: &mut face_normals,
        };
        let tables = Tables {
            triangles: Triangles::U8(&[[0, 1, 2]]),
            materials: const { &[Material::new([255; 3], 1)] },
            ..Tables::EMPTY
        };
        let all = BoundingBox { min: [i16::MIN; 3], max: [i16::MAX; 3] };
        let mut mesh = MovingMesh::new(tables, moving, all).unwrap();
        mesh.update_face_normals();
        let direction = [(); 3].map(|()| random.bits() as i32 >> random.within(1, 31));
        mesh.set_vertex_normal(0, direction);
        let mesh = mesh.mesh();
        let normals = [mesh.tables().face_normals, mesh.tables().vertex_normals];
        for (got, exact) in
            normals.map(|n| n.get(0).unwrap()).into_iter().zip([exact, direction.map(f64::from)])
        {
            let length = exact.iter().map(|c| c * c).sum::<f64>().sqrt();
            if length == 0.0 {
                assert_eq!(got, [0; 3]);
                continue;
            }
            for i in 0..3 {
                let error = f64::from(got[i]) - exact[i] / length * 127.0;
                assert!(error.abs() < 0.5 + 127.0 * 2f64.powi(-13), "{got:?} {exact:?}");
            }
            judged += 1;
        }
    }
    assert!(judged > 30_000, "{judged}");
}

#[test]
fn faults_of_what_stays_are_found_once() {
    let materials = [Material::new([255; 3], 1)];
    let tables = Tables {
        triangles: Triangles::U8(&[[0, 1, 2]]),
        materials: &materials,
        // Not read.
        vertex_normals: Normals::I8(&[[0; 3]; 7]),
        ..Tables::EMPTY
    };
    // The ends of the range in any order.
    let range = BoundingBox { min: [9, -5, 0], max: [-9, 5, 0] };
    let fault = |vertices: usize, normals: usize, faces: usize| {
        let (mut positions, mut vertex_normals, mut face_normals) =
            (vec![[1000; 3]; vertices], vec![[0; 3]; normals], vec![[0; 3]; faces]);
        let moving = Moving {
            positions: &mut positions,
            vertex_normals: &mut vertex_normals,
            face_normals: &mut face_normals,
        };
        MovingMesh::new(tables, moving, range).map(|mesh| {
            assert_eq!(mesh.mesh().tables().positions.get(0), Some([9, 5, 0]));
            assert_eq!(*mesh.range(), BoundingBox { min: [-9, -5, 0], max: [9, 5, 0] });
            let stage = ends::stage(&mut Random::new(1));
            let lens = Perspective::new(
                rasterizer::numbers::Turn::degrees(40),
                rasterizer::camera::Distance::ONE,
                rasterizer::camera::Distance::lit("9"),
            );
            let camera = stage.camera(lens.unwrap(), area(0, 0, 40, 30));
            let _ = picture::<S4, _>(&mesh.mesh(), &stage, &camera, Flat::new(LIGHT));
        })
    };
    assert_eq!(fault(3, 3, 1), Ok(()));
    assert_eq!(fault(3, 0, 0), Ok(()));
    assert_eq!(fault(0, 0, 0), Err(MeshError::NoVertices));
    assert_eq!(fault(2, 0, 0), Err(MeshError::IndexOutOfRange { triangle: 0 }));
    assert_eq!(fault(3, 2, 0), Err(MeshError::VertexNormalCount));
    assert_eq!(fault(3, 0, 2), Err(MeshError::FaceNormalCount));
}
