//! The scenes of meshes that move, are shaped by a matrix, or come as bytes. They differ from
//! [`super`]' `GouraudS4` in that, and in their model, a sphere.

use core::hint::black_box;

use rasterizer::{
    mesh::{Aligned, BoundingBox, Mesh, Moving, MovingMesh, Progress},
    numbers::{Matrix, S4, Scalar},
    scene::Object,
    shade::Gouraud,
};

use super::{
    LIGHT, NARROW, PERSPECTIVE, PICTURE, camera,
    frames::{Bands, for_each_view},
};
use crate::models::{PULSE_KEYFRAMES, SPHERE};
use crate::sizes::{Display, Scene};

/// The sphere's vertices.
const VERTICES: usize = SPHERE.vertex_count();
/// Those of the sphere that has further shapes.
const PULSE_VERTICES: usize = PULSE_KEYFRAMES.mesh().vertex_count();
const PROGRESS: Progress = Progress::lit("0.3");
const FLAT: Matrix = Matrix::scaling(Scalar::ONE, Scalar::lit("0.5"), Scalar::NEG_ONE);

type Smooth<const VERTICES: usize> = Bands<S4, u16, [u16; 1], NARROW, VERTICES>;

/// A sphere between two shapes.
#[derive(Clone, Copy, Debug)]
pub struct GouraudMorph;

impl Scene for GouraudMorph {
    type Memory = Smooth<PULSE_VERTICES>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let tween = PULSE_KEYFRAMES.between(0, 1, black_box(PROGRESS))?;
            let object = Object::morphed(&tween, Gouraud::new(LIGHT)).posed(view.pose());
            memory.draw(&object, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// A sphere in a matrix.
#[derive(Clone, Copy, Debug)]
pub struct GouraudShaped;

impl Scene for GouraudShaped {
    type Memory = Smooth<VERTICES>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let object = Object::new(&SPHERE, Gouraud::new(LIGHT)).shaped(black_box(&FLAT));
            let object = object.posed(view.pose());
            memory.draw(&object, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// A sphere as it was modelled, one in a matrix, and one between two shapes: each of a type of its
/// shape, so that what draws is there three times.
#[derive(Clone, Copy, Debug)]
pub struct GouraudShapes;

impl Scene for GouraudShapes {
    type Memory = Smooth<PULSE_VERTICES>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let (shader, camera) = (Gouraud::new(LIGHT), camera(view, PERSPECTIVE, PICTURE)?);
            let tween = PULSE_KEYFRAMES.between(0, 1, black_box(PROGRESS))?;
            let modelled = Object::new(PULSE_KEYFRAMES.mesh(), shader).posed(view.pose());
            memory.draw(&modelled, &camera, display)?;
            memory.draw(&modelled.shaped(black_box(&FLAT)), &camera, display)?;
            memory.draw(&Object::morphed(&tween, shader).posed(view.pose()), &camera, display)
        })
    }
}

/// The same spheres in [one type](rasterizer::geometry::AnyShape).
#[derive(Clone, Copy, Debug)]
pub struct GouraudAnyShape;

impl Scene for GouraudAnyShape {
    type Memory = Smooth<PULSE_VERTICES>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let (shader, camera) = (Gouraud::new(LIGHT), camera(view, PERSPECTIVE, PICTURE)?);
            let tween = PULSE_KEYFRAMES.between(0, 1, black_box(PROGRESS))?;
            let modelled = Object::new(PULSE_KEYFRAMES.mesh(), shader);
            for sphere in [
                modelled.in_any_shape(),
                modelled.shaped(black_box(&FLAT)).in_any_shape(),
                Object::morphed(&tween, shader).in_any_shape(),
            ] {
                memory.draw(&sphere.posed(view.pose()), &camera, display)?;
            }
            Some(())
        })
    }
}

/// The sphere's bytes.
static FILE: &Aligned<[u8]> = &Aligned(*include_bytes!(concat!(env!("OUT_DIR"), "/sphere.bin")));

/// A sphere from its bytes.
#[derive(Clone, Copy, Debug)]
pub struct GouraudFile;

impl Scene for GouraudFile {
    type Memory = Smooth<VERTICES>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        let sphere = Mesh::from_bytes(&black_box(FILE).0).ok()?;
        for_each_view(|view| {
            let object = Object::new(&sphere, Gouraud::new(LIGHT)).posed(view.pose());
            memory.draw(&object, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// A sphere whose vertices move in RAM.
#[derive(Clone, Copy, Debug)]
pub struct GouraudMoving;

/// What [`GouraudMoving`] draws with.
#[derive(Debug)]
pub struct InMemory {
    bands: Smooth<VERTICES>,
    positions: [[i16; 3]; VERTICES],
    normals: [[i8; 3]; VERTICES],
}

impl Scene for GouraudMoving {
    type Memory = InMemory;

    const MEMORY: InMemory = InMemory {
        bands: Bands::EMPTY,
        positions: [[0; 3]; VERTICES],
        normals: [[0; 3]; VERTICES],
    };

    fn draw(memory: &mut InMemory, display: &mut Display) -> Option<()> {
        let InMemory { bands, positions, normals } = memory;
        let moving = Moving { positions, vertex_normals: normals, ..Moving::default() };
        let tables = SPHERE.tables();
        let range = BoundingBox { min: [-32_767; 3], max: [32_767; 3] };
        let mut sphere = MovingMesh::new(*tables, moving, range).ok()?;
        for_each_view(|view| {
            sphere.update(|vertex, _| {
                let [x, y, z] = tables.positions.get(vertex).unwrap_or_default();
                [x, y - (y >> 2), z]
            });
            for vertex in 0..VERTICES {
                let normal = tables.vertex_normals.get(vertex).unwrap_or_default();
                sphere.set_vertex_normal(vertex, normal.map(i32::from));
            }
            let mesh = sphere.mesh();
            let object = Object::new(&mesh, Gouraud::new(LIGHT)).posed(view.pose());
            bands.draw(&object, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}
