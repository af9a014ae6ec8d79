//! A model as constant tables that can stay in flash.
//!
//! [`Tables`] is the form in which the converter writes a model: plain slices and numbers.
//! [`Mesh::new`] checks all of them (every index in range, every length equal to its partner's), so
//! that drawing does not check again. [`Mesh::new_const`] is the same check for a `static`: a wrong
//! table does not compile.
//!
//! Object space is right-handed with y up, as in OBJ. A vertex is at `offset + scale * position` in
//! the model's own units, where `position` is three integers.

pub mod blob;
mod bounds;
mod card;
mod check;
mod columns;
mod finish;
mod keyframes;
mod lines;
mod material;
mod moving;
mod parts;
mod points;
pub mod shapes;
mod shaping;
mod vertex;

pub use blob::{Aligned, BlobError};
pub use bounds::BoundingBox;
pub use card::Card;
pub use check::MeshError;
pub use columns::{Normals, Positions, TextureCoordinates, Triangles};
use embedded_graphics_core::pixelcolor::Rgb888;
pub use finish::Finish;
pub(crate) use keyframes::Changes;
pub use keyframes::{Keyframe, Keyframes, Progress, Tween};
pub use lines::{Lines, Segments};
pub use material::MeshMaterial;
pub use moving::{Moving, MovingMesh};
pub use parts::{Parts, PartsError, SeparatingPlane};
pub use points::{PointIndices, Points};
pub(crate) use shaping::Shaping;
pub use vertex::{MeshFace, MeshVertex, RequiredTables};

use crate::numbers::{Scale, Vec3};

/// The tables of a model, before they are checked.
///
/// Name the tables that a model has and take the others from [`EMPTY`](Self::EMPTY): a later
/// version may have more of them. A shader that needs a table the model lacks is an error before
/// the first pixel.
///
/// ```
/// use rasterizer::mesh::{Material, Mesh, Positions, Tables, Triangles};
///
/// static TRIANGLE: Mesh<'static> = Mesh::new_const(Tables {
///     positions: Positions::I16(&[[0, 0, 0], [1, 0, 0], [0, 1, 0]]),
///     triangles: Triangles::U8(&[[0, 1, 2]]),
///     materials: &[Material::new([255, 160, 0], 1)],
///     ..Tables::EMPTY
/// });
/// assert_eq!(TRIANGLE.triangle_count(), 1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Tables<'a> {
    /// The vertices' positions in quanta.
    pub positions: Positions<'a>,
    /// The length of a quantum in model units, the same on all three axes.
    pub scale: Scale,
    /// Where position (0, 0, 0) is, in model units.
    pub offset: Vec3,
    /// The normal of each vertex: none, or as many as `positions`.
    pub vertex_normals: Normals<'a>,
    /// The normal of each triangle: none, or as many as `triangles`.
    pub face_normals: Normals<'a>,
    /// The texture coordinates of each vertex: none, or as many as `positions`.
    pub texture_coordinates: TextureCoordinates<'a>,
    /// The colour of each vertex: none, or as many as `positions`. Red, green and blue, 0 to 255,
    /// as stored in pictures (sRGB).
    pub vertex_colors: &'a [[u8; 3]],
    /// The vertices of each triangle.
    pub triangles: Triangles<'a>,
    /// The materials in the order of the triangles they cover.
    pub materials: &'a [Material],
    /// What the materials show besides their colours: none, or as many as `materials`.
    pub finishes: &'a [Finish],
}

impl Tables<'_> {
    /// No vertices, triangles or materials; a quantum is one unit, and the offset is zero.
    pub const EMPTY: Tables<'static> = Tables {
        positions: Positions::I16(&[]),
        scale: Scale::ONE,
        offset: Vec3::ZERO,
        vertex_normals: Normals::NONE,
        face_normals: Normals::NONE,
        texture_coordinates: TextureCoordinates::NONE,
        vertex_colors: &[],
        triangles: Triangles::U8(&[]),
        materials: &[],
        finishes: &[],
    };
}

/// A run of triangles of one colour.
// In the order of C, which is that of `blob`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, bytemuck::AnyBitPattern)]
#[repr(C)]
#[non_exhaustive]
pub struct Material {
    /// Diffuse colour: red, green, blue, 0 to 255, as stored in pictures (sRGB).
    pub color: [u8; 3],
    /// How many triangles it covers, from the first one after those of the material before it.
    pub triangle_count: u32,
}

impl Material {
    /// A material of this colour that covers `triangle_count` triangles.
    #[must_use]
    pub const fn new(color: [u8; 3], triangle_count: u32) -> Self {
        Self { color, triangle_count }
    }

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
    bounds: BoundingBox,
    /// By how many bits positions can be shifted up and still fit 16.
    spare_bits: u32,
}

impl<'a> Mesh<'a> {
    /// Checks the tables and measures their bounds.
    ///
    /// # Errors
    ///
    /// Returns the first fault, with its place.
    pub const fn new(tables: Tables<'a>) -> Result<Self, MeshError> {
        if let Err(error) = check::tables(&tables) {
            return Err(error);
        }
        let bounds = BoundingBox::of(tables.positions.as_slice());
        Ok(Self { tables, bounds, spare_bits: bounds.spare_bits() })
    }

    /// The same with other bounds, which must hold all vertices.
    const fn within(self, bounds: BoundingBox) -> Self {
        Self { tables: self.tables, bounds, spare_bits: bounds.spare_bits() }
    }

    /// [`Mesh::new`] for a `static` or a `const`, where a fault stops the compiler.
    ///
    /// # Panics
    ///
    /// Panics if the tables are faulty. In a constant that is a compile error which names the
    /// fault.
    #[must_use]
    pub const fn new_const(tables: Tables<'a>) -> Self {
        match Self::new(tables) {
            Ok(mesh) => mesh,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// The same mesh with its vertices elsewhere, as many as it has, and without normals.
    pub(crate) const fn with_positions(&self, positions: &'a [[i16; 3]], scale: Scale) -> Self {
        let bounds = BoundingBox::of(positions);
        let tables = Tables {
            positions: Positions::I16(positions),
            scale,
            offset: Vec3::ZERO,
            vertex_normals: Normals::NONE,
            face_normals: Normals::NONE,
            ..self.tables
        };
        Self { tables, bounds, spare_bits: bounds.spare_bits() }
    }

    /// The checked tables.
    #[must_use]
    pub const fn tables(&self) -> &Tables<'a> {
        &self.tables
    }

    /// The smallest box that holds all vertices.
    #[must_use]
    pub const fn bounds(&self) -> &BoundingBox {
        &self.bounds
    }

    /// By how many bits positions can be shifted up and still fit 16.
    pub(crate) const fn spare_bits(&self) -> u32 {
        self.spare_bits
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
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSITIONS: [[i16; 3]; 4] = [[-3, 0, 4], [3, 0, 4], [0, 5, -4], [1, 1, 1]];
    const TETRAHEDRON: Tables<'static> = Tables {
        positions: Positions::I16(&POSITIONS),
        triangles: Triangles::U8(&[[0, 1, 2], [0, 3, 1]]),
        materials: &[Material::new([255, 0, 0], 2)],
        ..Tables::EMPTY
    };
    static MESH: Mesh<'static> = Mesh::new_const(TETRAHEDRON);

    #[test]
    fn good_tables_become_a_mesh_at_compile_time() {
        assert_eq!(MESH.vertex_count(), 4);
        assert_eq!(MESH.triangle_count(), 2);
        assert_eq!(MESH.bounds().min, [-3, 0, -4]);
        assert_eq!(MESH.bounds().max, [3, 5, 4]);
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
        assert_eq!(fault(|t| t.positions = Positions::I16(&[])), MeshError::NoVertices);
        assert_eq!(fault(|t| t.triangles = Triangles::U8(&[])), MeshError::MaterialCoverage);
        assert_eq!(
            fault(|t| t.triangles = Triangles::U16(&[[0, 1, 2], [0, 4, 1]])),
            MeshError::IndexOutOfRange { triangle: 1 }
        );
        assert_eq!(
            fault(|t| t.vertex_normals = Normals::I8(&[[0, 0, 127]])),
            MeshError::VertexNormalCount
        );
        assert_eq!(
            fault(|t| t.face_normals = Normals::I8(&[[0, 0, 127]])),
            MeshError::FaceNormalCount
        );
        assert_eq!(fault(|t| t.vertex_colors = &[[0; 3]]), MeshError::VertexColorCount);
        assert_eq!(fault(|t| t.vertex_colors = &[[0; 3]; 5]), MeshError::VertexColorCount);
        assert_eq!(fault(|t| t.materials = &[]), MeshError::MaterialCoverage);
    }

    #[test]
    fn finishes_are_as_many_as_materials_and_have_exponents() {
        let finished = |finishes| Mesh::new(Tables { finishes, ..TETRAHEDRON }).map(|_| ());
        assert_eq!(finished(&[Finish::MATTE; 1]), Ok(()));
        assert_eq!(finished(&[Finish::MATTE; 2]), Err(MeshError::FinishCount));
        let materials = &[Material::new([1; 3], 1), Material::new([2; 3], 1)];
        for (exponent, fits) in [(0, false), (1, true), (1000, true), (1001, false)] {
            let shiny = Finish::MATTE.with_specular([255; 3], exponent);
            let finishes = &[Finish::MATTE, shiny];
            let got = Mesh::new(Tables { materials, finishes, ..TETRAHEDRON }).map(|_| ());
            let fault = MeshError::FinishExponent { material: 1 };
            assert_eq!(got, if fits { Ok(()) } else { Err(fault) }, "{exponent}");
            assert!(std::format!("{fault}").ends_with("(material 1)"), "{fault}");
        }
        let finish = Finish::MATTE.with_specular([1, 2, 3], 4).with_emission([5, 6, 7]);
        let tables = Tables { finishes: &[finish.with_opacity(8)], ..TETRAHEDRON };
        let material = MeshMaterial::new(&tables, (0, &tables.materials[0]));
        assert_eq!(material.finish(), finish.with_opacity(8));
        assert_eq!(material.rgb(), Rgb888::new(255, 0, 0));
        assert_eq!(
            MeshMaterial::new(&TETRAHEDRON, (0, &TETRAHEDRON.materials[0])).finish(),
            Finish::MATTE
        );
    }

    #[test]
    fn texture_coordinates_are_at_most_64_repeats_from_zero() {
        const LIMIT: i32 = 64 << 24;
        let textured = |texture_coordinates| {
            Mesh::new(Tables { texture_coordinates, ..TETRAHEDRON }).map(|_| ())
        };
        let count = Err(MeshError::TextureCoordinateCount);
        assert_eq!(textured(TextureCoordinates::I16(&[[0; 2]])), count);
        assert_eq!(textured(TextureCoordinates::I32(&[[0; 2]; 5])), count);
        assert_eq!(textured(TextureCoordinates::I16(&[[i16::MIN, i16::MAX]; 4])), Ok(()));
        let wide = |last: [i32; 2]| {
            let table = [[LIMIT, -LIMIT], [-LIMIT, LIMIT], [0; 2], last];
            let texture_coordinates = TextureCoordinates::I32(&table);
            Mesh::new(Tables { texture_coordinates, ..TETRAHEDRON }).map(|_| ())
        };
        assert_eq!(wide([LIMIT, -LIMIT]), Ok(()));
        let range = MeshError::TextureRange { vertex: 3 };
        for last in [[0, -LIMIT - 1], [LIMIT + 1, 0], [i32::MIN, 0], [0, i32::MAX]] {
            assert_eq!(wide(last), Err(range));
        }
        assert!(std::format!("{range}").ends_with("(vertex 3)"), "{range}");
        let bits = |fraction_bits| {
            textured(TextureCoordinates::U16 { table: &[[0; 2]; 4], fraction_bits })
        };
        for fraction_bits in [0, 9, 17, 255] {
            assert_eq!(bits(fraction_bits), Err(MeshError::TextureFractionBits));
        }
        assert_eq!((bits(10), bits(16)), (Ok(()), Ok(())));
    }

    #[test]
    fn texture_coordinates_of_every_format_have_24_bits() {
        let both = |column: TextureCoordinates<'_>| (column.get(0), column.get_q14(0));
        let q14 = [i16::MIN, 3];
        let wide = Some([-2 << 24, 3 << 10]);
        assert_eq!(both(TextureCoordinates::I16(&[q14])), (wide, Some(q14)));
        assert_eq!(both(TextureCoordinates::I32(&[[-7, 64 << 24]])), (Some([-7, 64 << 24]), None));
        let old =
            |fraction_bits| both(TextureCoordinates::U16 { table: &[[65_535, 1]], fraction_bits });
        assert_eq!(old(16), (Some([65_535 << 8, 1 << 8]), None));
        assert_eq!(old(10), (Some([65_535 << 14, 1 << 14]), None));
        assert_eq!(both(TextureCoordinates::NONE), (None, None));
    }
}
