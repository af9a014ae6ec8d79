//! Ready-made shapes, whose tables the compiler computes: for a firmware without a model's file.
//!
//! A shape has its fineness; it tells how many vertices and triangles that takes, and makes a
//! [`Solid`] of them at compile time:
//!
//! ```
//! use rasterizer::mesh::{Material, Mesh, shapes::{Solid, UvSphere}};
//!
//! const SPHERE: UvSphere = UvSphere::new(24, 12);
//! static BALL: Solid<{ SPHERE.vertices() }, { SPHERE.triangles() }> = SPHERE.solid();
//! static MESH: Mesh<'static> = BALL.mesh(&[Material::new([226, 92, 60], 24 * 22)]);
//! # assert_eq!(MESH.triangle_count(), SPHERE.triangles());
//! ```
//!
//! | shape | vertices | triangles | closed | texture coordinates |
//! |---|---|---|---|---|
//! | [`Cube`] | 24 | 12 | yes | the whole of a texture on each side |
//! | [`Plane`], of c columns and r rows | (c + 1) (r + 1) | 2 c r | no | once |
//! | [`UvSphere`], of s sectors and r rings | (s + 1) (r - 1) + 2 s | 2 s (r - 1) | yes | once round it |
//! | [`Icosphere`], edges in n parts | 10 n² + 2 | 20 n² | yes | none |
//! | [`Torus`], of s sectors and r rings | (s + 1) (r + 1) | 2 s r | yes | once round each way |
//! | [`Cylinder`], of s sectors | 4 s + 4 | 4 s | yes | once round it; a disc of a texture on each end |
//! | [`Cone`], of s sectors | 3 s + 2 | 2 s | yes | the same |
//!
//! All of them reach from -1 to 1 along each axis (a plane has no height, a torus its tube's), with
//! their axis along y. [`Pose::scaled`](crate::geometry::Pose::scaled) gives them another size,
//! [`Object::shaped`](crate::scene::Object::shaped) one of its own along each axis.
//!
//! A quantum is 2<sup>-14</sup>: positions are within 2<sup>-14</sup> of the surface, with normals
//! to the nearest 127th in each coordinate, and texture coordinates in Q2.14. Front faces are
//! outside. Where a texture begins again, or where the surface has an edge, vertices with the same
//! position are there twice: so a closed shape is watertight by its positions.
//!
//! The compiler warns of constants that take it long (`long_running_const_eval`) for some thousand
//! vertices.

mod flat;
mod icosphere;
mod round;

pub use flat::{Cube, Plane};
pub use icosphere::Icosphere;
pub use round::{Cone, Cylinder, Torus, UvSphere};

use super::{Material, Mesh, Normals, Positions, Tables, TextureCoordinates, Triangles};
use crate::numbers::{Scale, unit};

/// The tables of a shape with `V` vertices and `T` triangles.
///
/// As a static it is in flash as a whole. As a constant only those of its tables are that a mesh
/// refers to: `Mesh::new_const(Tables { positions: Positions::I16(&BALL.positions), .. })`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Solid<const V: usize, const T: usize> {
    /// In 16,384ths of a unit.
    pub positions: [[i16; 3]; V],
    /// The normal of each vertex, 127 standing for 1.
    pub vertex_normals: [[i8; 3]; V],
    /// u and v of each vertex in Q2.14.
    pub texture_coordinates: [[i16; 2]; V],
    /// The vertices of each triangle.
    pub triangles: [[u16; 3]; T],
    /// The normal of each triangle, 127 standing for 1.
    pub face_normals: [[i8; 3]; T],
}

impl<const V: usize, const T: usize> Solid<V, T> {
    /// The length of a quantum of its positions.
    pub const SCALE: Scale = Scale::new(1, -14);

    /// Its tables, with materials that cover its triangles.
    #[must_use]
    pub const fn tables(&self, materials: &'static [Material]) -> Tables<'_> {
        Tables {
            positions: Positions::I16(&self.positions),
            scale: Self::SCALE,
            vertex_normals: Normals::I8(&self.vertex_normals),
            face_normals: Normals::I8(&self.face_normals),
            texture_coordinates: TextureCoordinates::I16(&self.texture_coordinates),
            triangles: Triangles::U16(&self.triangles),
            materials,
            ..Tables::EMPTY
        }
    }

    /// The mesh of all of its tables, with materials that cover its triangles in their order.
    ///
    /// # Panics
    ///
    /// Panics if the counts of the materials do not add up to `T`. In a constant that is a compile
    /// error.
    #[must_use]
    pub const fn mesh(&self, materials: &'static [Material]) -> Mesh<'_> {
        Mesh::new_const(self.tables(materials))
    }
}

/// 1 in Q30.
const ONE: i32 = 1 << 30;

/// The tables of a shape, vertex by vertex.
struct Builder<const V: usize, const T: usize> {
    solid: Solid<V, T>,
    vertices: usize,
    triangles: usize,
}

impl<const V: usize, const T: usize> Builder<V, T> {
    /// Nothing of a shape that has these counts.
    const fn new(vertices: usize, triangles: usize) -> Self {
        assert!(V == vertices && T == triangles, "take the counts of `vertices` and `triangles`");
        assert!(V <= 1 << 16, "a mesh has up to 65,536 vertices");
        let solid = Solid {
            positions: [[0; 3]; V],
            vertex_normals: [[0; 3]; V],
            texture_coordinates: [[0; 2]; V],
            triangles: [[0; 3]; T],
            face_normals: [[0; 3]; T],
        };
        Self { solid, vertices: 0, triangles: 0 }
    }

    /// Adds a vertex: its position and its normal in Q30, and its texture coordinates in parts of a
    /// whole each.
    const fn vertex(&mut self, position: [i32; 3], normal: [i32; 3], uv: [[usize; 2]; 2]) {
        let mut axis = 0;
        while axis < 3 {
            self.solid.positions[self.vertices][axis] = ((position[axis] + (1 << 15)) >> 16) as i16;
            axis += 1;
        }
        self.solid.vertex_normals[self.vertices] = in_127ths(normal);
        let [[u, of_u], [v, of_v]] = uv;
        self.solid.texture_coordinates[self.vertices] =
            [(((u << 15) / of_u + 1) >> 1) as i16, (((v << 15) / of_v + 1) >> 1) as i16];
        self.vertices += 1;
    }

    /// Adds a triangle.
    const fn triangle(&mut self, corners: [usize; 3]) {
        let [a, b, c] = corners;
        self.solid.triangles[self.triangles] = [a as u16, b as u16, c as u16];
        let p = &self.solid.positions;
        let (u, v) = (difference(p[b], p[a]), difference(p[c], p[a]));
        let normal =
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        if let Some(normal) = unit(normal) {
            self.solid.face_normals[self.triangles] = in_127ths(normal);
        }
        self.triangles += 1;
    }

    /// Adds the triangles of a field of vertices, which have been added row by row from the upper
    /// left on, from the vertex `first` on: two for each cell.
    const fn field(&mut self, first: usize, columns: usize, rows: usize) {
        let mut cell = 0;
        while cell < columns * rows {
            let left = first + cell / columns * (columns + 1) + cell % columns;
            let below = left + columns + 1;
            self.triangle([left, below, below + 1]);
            self.triangle([left, below + 1, left + 1]);
            cell += 1;
        }
    }

    /// The whole shape.
    const fn finish(self) -> Solid<V, T> {
        assert!(self.vertices == V && self.triangles == T, "the counts are those of the shape");
        self.solid
    }
}

const fn difference(a: [i16; 3], b: [i16; 3]) -> [i64; 3] {
    [a[0] as i64 - b[0] as i64, a[1] as i64 - b[1] as i64, a[2] as i64 - b[2] as i64]
}

/// From Q30 to 127ths.
const fn in_127ths(normal: [i32; 3]) -> [i8; 3] {
    let (mut rounded, mut axis) = ([0; 3], 0);
    while axis < 3 {
        rounded[axis] = ((normal[axis] as i64 * 127 + (1 << 29)) >> 30) as i8;
        axis += 1;
    }
    rounded
}
