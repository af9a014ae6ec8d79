//! Further files of a model's faces: the shapes of an animation.
//!
//! The files have the same faces, texture coordinates and materials ([`topology`](super::topology)
//! checks it). Positions get common numbers: corners share one if they share it in all files. So
//! what is cut, merged and ordered after that has the same result for each of them, and vertices
//! are merged only if they agree in all files.

use std::{collections::HashMap, path::Path};

use rasterizer::mesh::{Keyframe, Normals, Positions};

use super::{
    Contents, ModelError,
    elements::End,
    fit,
    libraries::Libraries,
    normals::face_normal,
    polygons::{self, Polygons},
    quantize, source,
    topology::Topology,
    triangulate::has_area,
    validate::{self, Checked},
    vector::{Vector, key},
};

/// A further shape of a model: positions and normals in the order of the model's tables, and in
/// its quantum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shape {
    /// Positions in quanta.
    pub positions: Vec<[i16; 3]>,
    /// Unit normals of the vertices in 127ths, or none.
    pub vertex_normals: Vec<[i8; 3]>,
    /// Unit normals of the triangles in 127ths, or none.
    pub face_normals: Vec<[i8; 3]>,
    /// Positions in model units, before rounding.
    pub exact_positions: Vec<[f64; 3]>,
    /// Unit normals of the vertices, before rounding.
    pub exact_vertex_normals: Vec<[f64; 3]>,
    /// Unit normals of the triangles, before rounding.
    pub exact_face_normals: Vec<[f64; 3]>,
    /// The positions that the faces of its file use, in the order of
    /// [`Faces::positions`](super::Faces::positions).
    pub face_positions: Vec<[f64; 3]>,
}

impl Shape {
    /// The bytes of its tables.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.positions[..])
            + size_of_val(&self.vertex_normals[..])
            + size_of_val(&self.face_normals[..])
    }

    /// Borrows it for a mesh.
    pub(super) fn keyframe(&self) -> Keyframe<'_> {
        Keyframe {
            positions: Positions::I16(&self.positions),
            vertex_normals: Normals::I8(&self.vertex_normals),
            face_normals: Normals::I8(&self.face_normals),
        }
    }

    /// The normals with their exact values.
    pub(super) fn normals(&self) -> impl Iterator<Item = (&[i8; 3], &Vector)> {
        let vertices = self.vertex_normals.iter().zip(&self.exact_vertex_normals);
        vertices.chain(self.face_normals.iter().zip(&self.exact_face_normals))
    }

    /// Rounds the normals.
    pub(super) fn new(
        positions: Vec<[i16; 3]>,
        exact_positions: Vec<Vector>,
        exact_vertex_normals: Vec<Vector>,
        exact_face_normals: Vec<Vector>,
        face_positions: Vec<Vector>,
    ) -> Self {
        let rounded = |normals: &[Vector]| normals.iter().map(|&n| quantize::normal(n)).collect();
        Self {
            positions,
            vertex_normals: rounded(&exact_vertex_normals),
            face_normals: rounded(&exact_face_normals),
            exact_positions,
            exact_vertex_normals,
            exact_face_normals,
            face_positions,
        }
    }
}

/// Reads further files, and gives the positions of all files common numbers.
pub(super) fn read(
    first: (&Path, &Checked, &mut Polygons),
    further: &[(&Path, &[u8])],
    libraries: &Libraries,
    contents: Contents,
) -> Result<Vec<Polygons>, ModelError> {
    let (path, checked, polygons) = first;
    if further.is_empty() {
        return Ok(Vec::new());
    }
    let topology = Topology::of(path, checked);
    let mut others = Vec::new();
    for &(path, bytes) in further {
        if bytes.is_empty() {
            return Err(ModelError::Empty { path: path.into() });
        }
        let statements = source::statements(source::text(path, bytes)?);
        let other = validate::check(path, &statements, contents)?;
        topology.compare(&Topology::of(path, &other))?;
        others.push(polygons::read(path, &other, libraries)?);
    }
    let mut all: Vec<&mut Polygons> = std::iter::once(polygons).chain(&mut others).collect();
    share_numbers(&mut all);
    Ok(others)
}

/// Numbers the positions of files by what corners have in all of them.
fn share_numbers(all: &mut [&mut Polygons]) {
    let mut known = HashMap::new();
    let mut positions: Vec<Vec<Vector>> = vec![Vec::new(); all.len()];
    let mut number = |all: &mut [&mut Polygons], place: &dyn Fn(&mut Polygons) -> &mut u32| {
        let own: Vec<u32> = all.iter_mut().map(|polygons| *place(polygons)).collect();
        let next = known.len() as u32;
        let number = *known.entry(own.clone()).or_insert_with(|| {
            for ((positions, polygons), &own) in positions.iter_mut().zip(all.iter()).zip(&own) {
                positions.push(polygons.positions[own as usize]);
            }
            next
        });
        all.iter_mut().for_each(|polygons| *place(polygons) = number);
    };
    for corner in 0..all[0].corners.len() {
        number(all, &|polygons| &mut polygons.corners[corner].position);
    }
    for line in 0..all[0].lines.len() {
        for end in 0..2 {
            number(all, &|polygons| place_of(&mut polygons.lines[line].vertices[end]));
        }
    }
    for point in 0..all[0].points.len() {
        number(all, &|polygons| place_of(&mut polygons.points[point].vertices[0]));
    }
    for (polygons, positions) in all.iter_mut().zip(positions) {
        polygons.positions = positions;
    }
}

const fn place_of(end: &mut End) -> &mut u32 {
    &mut end.position
}

/// The positions of all files, in a common size.
pub(super) fn shapes(polygons: &Polygons, further: &[Polygons]) -> Vec<Vec<Vector>> {
    let count = polygons.positions.len().max(1);
    let all = std::iter::once(polygons).chain(further).flat_map(|polygons| &polygons.positions);
    let all: Vec<Vector> = all.copied().collect();
    fit::to_common_size(&all).chunks(count).map(<[Vector]>::to_vec).collect()
}

/// The normals that corners have in the further files.
#[derive(Clone, Debug, Default)]
pub(super) struct CornerNormals {
    /// For each corner of each triangle the number of what it has; empty without further files.
    pub numbers: Vec<[u32; 3]>,
    /// For each number the normal in each file.
    distinct: Vec<Vec<Vector>>,
}

/// The number of a vertex without a normal.
pub(super) const NONE: u32 = u32::MAX;

impl CornerNormals {
    /// Numbers the normals of files, each with three for each triangle.
    pub(super) fn new(files: &[Vec<[Vector; 3]>]) -> Self {
        let mut known = HashMap::new();
        let mut distinct = Vec::new();
        let triangles = files.first().map_or(0, Vec::len);
        let numbers = (0..triangles).map(|triangle| {
            [0, 1, 2].map(|corner| {
                let own: Vec<Vector> = files.iter().map(|file| file[triangle][corner]).collect();
                let name: Vec<_> = own.iter().map(|&normal| key(normal)).collect();
                *known.entry(name).or_insert_with(|| {
                    distinct.push(own);
                    distinct.len() as u32 - 1
                })
            })
        });
        Self { numbers: numbers.collect(), distinct }
    }

    /// The normals in one of the files by their numbers.
    pub(super) fn of_file(&self, file: usize, numbers: &[u32]) -> Vec<Vector> {
        let normal = |&number: &u32| self.distinct.get(number as usize).map(|own| own[file]);
        numbers.iter().map(|number| normal(number).unwrap_or_default()).collect()
    }
}

/// The normal of a triangle in the first of these shapes; where it has no area, that of another
/// in which it has one.
pub(super) fn normal_of_face<'a>(
    shapes: impl Iterator<Item = &'a [Vector]> + Clone,
    triangle: &[u32; 3],
) -> Vector {
    let places = |shape: &[Vector]| triangle.map(|vertex| shape[vertex as usize]);
    let own = shapes.clone().next().map(places).unwrap_or_default();
    face_normal(shapes.map(places).find(|&places| has_area(places)).unwrap_or(own))
}
