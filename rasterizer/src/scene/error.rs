//! What can go wrong with drawing an object.

use crate::{
    geometry::PoseError,
    mesh::{RequiredTables, Tables, TextureCoordinates},
};

/// Why an object cannot be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProjectError {
    /// There is room for fewer vertices than the mesh has.
    VertexStorage {
        /// The number of vertices that the mesh has.
        needed: usize,
    },
    /// There are fewer words than the bands' bits take, as [`bin_words`](super::bin_words) counts
    /// them.
    BinStorage {
        /// The number of words that they take.
        needed: usize,
    },
    /// There are fewer words than the mesh has triangles, or the slice has particles, to sort from
    /// back to front.
    SortStorage {
        /// The number of words that they take.
        needed: usize,
    },
    /// There is room for the rows of fewer objects than a scene has.
    RowStorage {
        /// The number of its objects.
        needed: usize,
    },
    /// There is room for fewer particles on the screen than the slice has.
    ParticleStorage {
        /// The number of particles that the slice has.
        needed: usize,
    },
    /// The slice has over 65,536 particles: draw it in parts.
    TooManyParticles,
    /// The shader reads normals of vertices, and the mesh has none: convert the model with them.
    NoVertexNormals,
    /// The shader reads normals of triangles, and the mesh has none: convert the model with them.
    NoFaceNormals,
    /// The shader reads texture coordinates, and the mesh has none: convert the model with them.
    NoTextureCoordinates,
    /// The shader reads texture coordinates of 16 bits, and those of the mesh have more: give the
    /// shader `with_wide_coordinates()`.
    WideTextureCoordinates,
    /// The shader reads colours of vertices, and the mesh has none: convert a model that has them.
    NoVertexColors,
    /// The object is too large for how near it comes.
    Pose(PoseError),
}

impl From<PoseError> for ProjectError {
    fn from(error: PoseError) -> Self {
        Self::Pose(error)
    }
}

impl core::fmt::Display for ProjectError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::VertexStorage { needed } => {
                write!(f, "the mesh needs storage for {needed} vertices")
            }
            Self::BinStorage { needed } => {
                write!(f, "the bands need {needed} words for their triangles")
            }
            Self::SortStorage { needed } => {
                write!(f, "sorting from back to front takes {needed} words")
            }
            Self::RowStorage { needed } => {
                write!(f, "the scene needs storage for the rows of {needed} objects")
            }
            Self::ParticleStorage { needed } => {
                write!(f, "the slice needs storage for {needed} particles on the screen")
            }
            Self::TooManyParticles => f.write_str("a slice has at most 65,536 particles"),
            Self::NoVertexNormals => {
                f.write_str("the shader needs vertex normals, which the mesh was converted without")
            }
            Self::NoFaceNormals => {
                f.write_str("the shader needs face normals, which the mesh was converted without")
            }
            Self::NoTextureCoordinates => f.write_str(
                "the shader needs texture coordinates, which the mesh was converted without",
            ),
            Self::WideTextureCoordinates => f.write_str(
                "the shader reads texture coordinates of 16 bits, and those of the mesh have more: \
                 give it `with_wide_coordinates()`",
            ),
            Self::NoVertexColors => f.write_str(
                "the shader needs colours of vertices, which the mesh was converted without",
            ),
            Self::Pose(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for ProjectError {}

/// Why drawing an object failed; `E` is the target's error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DrawError<E> {
    /// The object cannot be drawn; none of it has been.
    Project(ProjectError),
    /// The target failed; some of the object may have been drawn.
    Target(E),
}

impl<E> From<ProjectError> for DrawError<E> {
    fn from(error: ProjectError) -> Self {
        Self::Project(error)
    }
}

impl<E: core::fmt::Display> core::fmt::Display for DrawError<E> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Project(error) => error.fmt(f),
            Self::Target(error) => error.fmt(f),
        }
    }
}

impl<E: core::error::Error> core::error::Error for DrawError<E> {}

/// Checks that the mesh has the tables that a shader reads.
pub(super) const fn check_tables(
    tables: &Tables<'_>,
    required: RequiredTables,
) -> Result<(), ProjectError> {
    if required.vertex_normals && tables.vertex_normals.is_empty() {
        Err(ProjectError::NoVertexNormals)
    } else if required.face_normals && tables.face_normals.is_empty() {
        Err(ProjectError::NoFaceNormals)
    } else if (required.texture_coordinates || required.narrow_texture_coordinates)
        && tables.texture_coordinates.is_empty()
    {
        Err(ProjectError::NoTextureCoordinates)
    } else if required.narrow_texture_coordinates
        && !matches!(tables.texture_coordinates, TextureCoordinates::I16(_))
    {
        Err(ProjectError::WideTextureCoordinates)
    } else if required.vertex_colors && tables.vertex_colors.is_empty() {
        Err(ProjectError::NoVertexColors)
    } else {
        Ok(())
    }
}
