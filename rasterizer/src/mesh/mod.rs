//! A model as constant tables that can stay in flash.
//!
//! [`Tables`] is what the converter writes: plain slices and numbers. [`Mesh::new`] checks all of
//! them at once (every index in range, every length equal to its partner's), so that nothing that
//! draws a mesh has to check again. [`Mesh::new_const`] is the same check for a `static`: a wrong
//! table does not compile.
//!
//! Object space is right-handed with y up, as in OBJ. A vertex lies at `offset + scale * position`
//! in the model's own units, where `position` holds three integers of 16 bits.

mod bounds;
mod check;
mod material;

pub use bounds::{BoundingBox, BoundingSphere, Bounds};
pub use check::MeshError;
use embedded_graphics_core::pixelcolor::Rgb888;
pub use material::MeshMaterial;

use crate::numbers::{Scale, Vec3};

/// The tables of a model, before they are checked.
///
/// Tables that a scene does not use may be empty; a shader that needs one says so before the first
/// pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Tables<'a> {
    /// The vertices' positions in quanta.
    pub positions: &'a [[i16; 3]],
    /// The length of a quantum in model units, the same on all three axes.
    pub scale: Scale,
    /// Where position (0, 0, 0) lies, in model units.
    pub offset: Vec3,
    /// The unit normal of each vertex, 127 standing for 1. Empty, or as long as `positions`.
    pub vertex_normals: &'a [[i8; 3]],
    /// The unit normal of each triangle, 127 standing for 1. Empty, or as long as `triangles`.
    pub face_normals: &'a [[i8; 3]],
    /// Texture coordinates of each vertex, in units of 2<sup>-`texture_fraction_bits`</sup>; u
    /// runs to the right and v downwards from the texture's top-left corner. Empty, or as long
    /// as `positions`.
    pub texture_coordinates: &'a [[u16; 2]],
    /// How many of the 16 bits of a texture coordinate lie behind the binary point: 0 to 16.
    pub texture_fraction_bits: u8,
    /// Three vertex indices a triangle, counter-clockwise when seen from its front.
    pub triangles: Triangles<'a>,
    /// The materials in the order of the triangles they cover.
    pub materials: &'a [Material],
}

/// Vertex indices, in the smallest type that holds them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Triangles<'a> {
    /// For meshes of up to 256 vertices.
    U8(&'a [[u8; 3]]),
    /// For meshes of up to 65,536 vertices.
    U16(&'a [[u16; 3]]),
}

impl Triangles<'_> {
    /// The number of triangles.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::U8(triangles) => triangles.len(),
            Self::U16(triangles) => triangles.len(),
        }
    }

    /// Whether there is no triangle.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The vertex indices of triangle `index`, or nothing past the end.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<[usize; 3]> {
        match self {
            Self::U8(triangles) => triangles.get(index).map(|t| t.map(usize::from)),
            Self::U16(triangles) => triangles.get(index).map(|t| t.map(usize::from)),
        }
    }
}

/// A run of triangles of one colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Material {
    /// Diffuse colour: red, green, blue, 0 to 255, as stored in pictures (sRGB).
    pub color: [u8; 3],
    /// How many triangles it covers, counted on from where the material before it ends.
    pub triangle_count: u32,
}

impl Material {
    /// Its colour.
    #[must_use]
    pub const fn rgb(&self) -> Rgb888 {
        let [red, green, blue] = self.color;
        Rgb888::new(red, green, blue)
    }
}

/// A model whose tables have been checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Mesh<'a> {
    tables: Tables<'a>,
    bounds: Bounds,
}

impl<'a> Mesh<'a> {
    /// Checks the tables and measures their bounds.
    ///
    /// # Errors
    ///
    /// The first fault found, with the place it is at.
    pub const fn new(tables: Tables<'a>) -> Result<Self, MeshError> {
        if let Err(error) = check::tables(&tables) {
            return Err(error);
        }
        Ok(Self { tables, bounds: Bounds::of(tables.positions) })
    }

    /// [`Mesh::new`] for a `static` or a `const`, where a fault stops the compiler.
    ///
    /// # Panics
    ///
    /// If the tables are faulty, which in a constant is a compile error that names the fault.
    #[must_use]
    pub const fn new_const(tables: Tables<'a>) -> Self {
        match Self::new(tables) {
            Ok(mesh) => mesh,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// The checked tables.
    #[must_use]
    pub const fn tables(&self) -> &Tables<'a> {
        &self.tables
    }

    /// The smallest box, and a sphere, that hold all vertices.
    #[must_use]
    pub const fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// The number of vertices.
    #[must_use]
    pub const fn vertex_count(&self) -> usize {
        self.tables.positions.len()
    }

    /// The number of triangles.
    #[must_use]
    pub const fn triangle_count(&self) -> usize {
        self.tables.triangles.len()
    }

    /// The bytes that the tables take in flash.
    #[must_use]
    pub const fn flash_bytes(&self) -> usize {
        let tables = &self.tables;
        let indices = match tables.triangles {
            Triangles::U8(triangles) => size_of_val(triangles),
            Triangles::U16(triangles) => size_of_val(triangles),
        };
        size_of_val(tables.positions)
            + size_of_val(tables.vertex_normals)
            + size_of_val(tables.face_normals)
            + size_of_val(tables.texture_coordinates)
            + size_of_val(tables.materials)
            + indices
            + size_of::<Self>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSITIONS: [[i16; 3]; 4] = [[-3, 0, 4], [3, 0, 4], [0, 5, -4], [1, 1, 1]];
    const TETRAHEDRON: Tables<'static> = Tables {
        positions: &POSITIONS,
        scale: Scale::ONE,
        offset: Vec3::ZERO,
        vertex_normals: &[],
        face_normals: &[],
        texture_coordinates: &[],
        texture_fraction_bits: 16,
        triangles: Triangles::U8(&[[0, 1, 2], [0, 3, 1]]),
        materials: &[Material { color: [255, 0, 0], triangle_count: 2 }],
    };
    static MESH: Mesh<'static> = Mesh::new_const(TETRAHEDRON);

    #[test]
    fn good_tables_become_a_mesh_at_compile_time() {
        assert_eq!(MESH.vertex_count(), 4);
        assert_eq!(MESH.triangle_count(), 2);
        assert_eq!(MESH.bounds().cuboid.min, [-3, 0, -4]);
        assert_eq!(MESH.bounds().cuboid.max, [3, 5, 4]);
        assert_eq!(MESH.tables().triangles.get(1), Some([0, 3, 1]));
        assert_eq!(MESH.tables().triangles.get(2), None);
    }

    #[test]
    fn each_fault_is_named() {
        let fault = |change: fn(&mut Tables<'static>)| {
            let mut tables = TETRAHEDRON;
            change(&mut tables);
            Mesh::new(tables).unwrap_err()
        };
        assert_eq!(fault(|t| t.positions = &[]), MeshError::NoVertices);
        assert_eq!(fault(|t| t.triangles = Triangles::U8(&[])), MeshError::NoTriangles);
        assert_eq!(
            fault(|t| t.triangles = Triangles::U16(&[[0, 1, 2], [0, 4, 1]])),
            MeshError::IndexOutOfRange { triangle: 1 }
        );
        assert_eq!(fault(|t| t.vertex_normals = &[[0, 0, 127]]), MeshError::VertexNormalCount);
        assert_eq!(fault(|t| t.face_normals = &[[0, 0, 127]]), MeshError::FaceNormalCount);
        assert_eq!(fault(|t| t.texture_coordinates = &[[0, 0]]), MeshError::TextureCoordinateCount);
        assert_eq!(fault(|t| t.texture_fraction_bits = 17), MeshError::TextureFractionBits);
        assert_eq!(fault(|t| t.materials = &[]), MeshError::MaterialCoverage);
    }
}
