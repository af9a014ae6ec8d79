//! From an OBJ file to const tables.
//!
//! [`Model::load`] checks the file line by line, cuts its polygons into triangles, computes the
//! normals it lacks, merges equal vertices, fits and quantises them, and orders the triangles for
//! vertex reuse. [`emit::source`] writes the result as Rust, [`blob::bytes`] as a binary file;
//! [`convert_for_build`] does all of it from a build script; [`Model::mesh`] gives the same tables
//! at run time. [`Exact`] keeps their values before rounding. With [`Options::simplify`] fewer
//! triangles are left. [`Model::load_keyframes`] converts several files, the shapes of one model.
//!
//! The converter reads positions, normals, texture coordinates, faces, lines, points, diffuse
//! colours, textures and finishes of an OBJ file, the colours of its vertices (`v x y z r g b`),
//! and its smoothing groups where it has no normals. What else a file shows and the tables cannot
//! hold, such as curves and textures of opacity, it leaves out with a warning for each kind.

pub mod blob;
mod cap;
mod convert;
mod ears;
mod edges;
mod elements;
pub mod emit;
mod emit_keyframes;
mod emit_lines;
mod emit_textures;
mod error;
mod faces;
mod fit;
mod flattening;
mod ignored;
mod indices;
mod keyframes;
mod libraries;
mod library_path;
mod measure;
mod mtl;
mod normals;
mod options;
mod order;
mod polygons;
mod provenance;
mod quantize;
mod quote;
#[cfg(feature = "plan")]
mod reorder;
mod report;
mod simplify;
mod slivers;
mod smoothing;
mod source;
#[cfg(test)]
mod tests;
mod texture_coordinates;
mod texture_map;
mod textures;
mod topology;
mod triangulate;
mod validate;
mod vector;
mod vertex_colors;
mod warnings;
mod weld;
mod winding;
mod write;

use std::path::{Path, PathBuf};

use rasterizer::{
    mesh::{Finish, Keyframe, Material, Mesh, Normals, Positions, Tables},
    numbers::{Scale, Vec3},
};

pub use error::{Difference, LineFault, ModelError};
pub use faces::{Face, Faces};
pub use indices::Indices;
pub use keyframes::Shape;
pub use options::{Contents, Fit, Options};
pub use provenance::Provenance;
pub use quote::printable;
pub use report::{Flash, Report, Simplification, thousands};
pub use texture_coordinates::TextureTable;
pub use textures::{
    AlphaFormat, ColorFormat, Picture, TexelFormat, Texture, TextureOptions, TextureWrap, Textures,
    choose_palette,
};
pub use write::{convert_for_build, write_atomically};

/// A converted model.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The name of the static, in capitals.
    pub name: String,
    /// How it is converted. The contents are those that it has.
    pub options: Options,
    /// The files it is made from: the OBJ, its material libraries, and pictures.
    pub provenance: Vec<Provenance>,
    /// The paths of these, and of libraries that cannot be read.
    pub inputs: Vec<PathBuf>,
    /// Positions in quanta.
    pub positions: Vec<[i16; 3]>,
    /// The length of a quantum in model units.
    pub scale: Scale,
    /// Where position (0, 0, 0) lies, in model units.
    pub offset: Vec3,
    /// Unit normals of the vertices in 127ths, or none.
    pub vertex_normals: Vec<[i8; 3]>,
    /// Unit normals of the triangles in 127ths, or none.
    pub face_normals: Vec<[i8; 3]>,
    /// Texture coordinates of the vertices, or none.
    pub texture_coordinates: TextureTable,
    /// Colours of the vertices, or none.
    pub vertex_colors: Vec<[u8; 3]>,
    /// Vertex indices, sorted by material.
    pub triangles: Indices,
    /// The edges as lines between vertices, if they are made.
    pub edges: Vec<[u32; 2]>,
    /// The lines of the file (`l`) between vertices, for each material; none if it has none.
    pub lines: Vec<Vec<[u32; 2]>>,
    /// The vertices that are points of the file (`p`), for each material; none if it has none.
    pub points: Vec<Vec<u32>>,
    /// The colours and how many triangles each covers.
    pub materials: Vec<Material>,
    /// What the materials show besides, or none if all are matte and opaque.
    pub finishes: Vec<Finish>,
    /// The textures of the materials, if any of them has one.
    pub textures: Option<Textures>,
    /// Further shapes of the model, each of another file.
    pub keyframes: Vec<Shape>,
    /// The tables before rounding.
    pub exact: Exact,
    /// What the conversion changes.
    pub report: Report,
    /// What the conversion ignores.
    pub warnings: Vec<String>,
}

/// The values of the tables before rounding, in the same order and units. A table that is left out
/// is empty here too.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exact {
    /// Positions in model units.
    pub positions: Vec<[f64; 3]>,
    /// Unit normals of the vertices.
    pub vertex_normals: Vec<[f64; 3]>,
    /// Unit normals of the triangles.
    pub face_normals: Vec<[f64; 3]>,
    /// Texture coordinates in repeats of the texture, v running down. Where textures repeat, they
    /// may be moved by whole repeats.
    pub texture_coordinates: Vec<[f64; 2]>,
    /// The faces of the file, not yet cut into triangles.
    pub faces: Faces,
}

impl Model {
    /// Converts the OBJ file at `path`.
    ///
    /// # Errors
    ///
    /// Returns an error if the file cannot be read, a line of it is wrong, or the model does not
    /// fit the tables. Each error names the file, the line if there is one, and what to do. Faults
    /// of material libraries are only [warnings](Self::warnings).
    pub fn load(path: impl AsRef<Path>, options: &Options) -> Result<Self, ModelError> {
        let path = path.as_ref();
        Self::from_bytes(path, &source::read(path)?, options)
    }

    /// Converts the contents of an OBJ file. Its material libraries lie beside `path`, which names
    /// it in messages.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Self::load`], except those of reading the file.
    pub fn from_bytes(path: &Path, bytes: &[u8], options: &Options) -> Result<Self, ModelError> {
        Self::keyframes_from_bytes((path, bytes), &[], options)
    }

    /// Converts OBJ files of one model in several shapes: the first one, and as its
    /// [keyframes](Self::keyframes) what vertices and normals are in the others. Faces, texture
    /// coordinates and materials are the same in all of them; colours, textures and what else they
    /// show is that of the first one. All have one scale and one offset.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Self::load`] for each of the files, and
    /// [`Topology`](ModelError::Topology) for the first difference between two of them.
    pub fn load_keyframes(
        first: impl AsRef<Path>,
        further: &[PathBuf],
        options: &Options,
    ) -> Result<Self, ModelError> {
        let path = first.as_ref();
        let bytes = source::read(path)?;
        let further: Vec<(&Path, Vec<u8>)> = further
            .iter()
            .map(|path| Ok((path.as_path(), source::read(path)?)))
            .collect::<Result<_, ModelError>>()?;
        let further: Vec<_> = further.iter().map(|(path, bytes)| (*path, &bytes[..])).collect();
        Self::keyframes_from_bytes((path, &bytes), &further, options)
    }

    /// Returns the tables as a mesh that can be drawn.
    ///
    /// # Panics
    ///
    /// Panics if the fields have been changed and are no valid mesh.
    #[must_use]
    pub fn mesh(&self) -> Mesh<'_> {
        Mesh::new_const(Tables {
            positions: Positions::I16(&self.positions),
            scale: self.scale,
            offset: self.offset,
            vertex_normals: Normals::I8(&self.vertex_normals),
            face_normals: Normals::I8(&self.face_normals),
            texture_coordinates: self.texture_coordinates.as_column(),
            vertex_colors: &self.vertex_colors,
            triangles: self.triangles.as_triangles(),
            materials: &self.materials,
            finishes: &self.finishes,
        })
    }

    /// Returns its further shapes, for [`Keyframes::new`](rasterizer::mesh::Keyframes::new).
    #[must_use]
    pub fn further_shapes(&self) -> Vec<Keyframe<'_>> {
        self.keyframes.iter().map(Shape::keyframe).collect()
    }
}
