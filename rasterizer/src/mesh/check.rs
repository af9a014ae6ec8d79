//! The checks that make a mesh safe to draw.

use super::{Finish, Tables, TextureCoordinates, Triangles};

/// What is wrong with a model's tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshError {
    /// There are no vertices.
    NoVertices,
    /// There are more vertices than 16-bit indices can name.
    TooManyVertices,
    /// A triangle has the index of a vertex that does not exist.
    IndexOutOfRange {
        /// The triangle's place in the table, from 0.
        triangle: usize,
    },
    /// A line has the index of a vertex that does not exist.
    LineOutOfRange {
        /// The line's place in the table, from 0.
        line: usize,
    },
    /// A point has the index of a vertex that does not exist.
    PointOutOfRange {
        /// The point's place in the table, from 0.
        point: usize,
    },
    /// `vertex_normals` is neither empty nor as long as `positions`.
    VertexNormalCount,
    /// `face_normals` is neither empty nor as long as `triangles`.
    FaceNormalCount,
    /// `texture_coordinates` is neither empty nor as long as `positions`.
    TextureCoordinateCount,
    /// A vertex has texture coordinates beyond the limit.
    TextureRange {
        /// The vertex's place in the table, from 0.
        vertex: usize,
    },
    /// The `fraction_bits` of `texture_coordinates` are below 10 or over 16.
    TextureFractionBits,
    /// `vertex_colors` is neither empty nor as long as `positions`.
    VertexColorCount,
    /// `finishes` is neither empty nor as long as `materials`.
    FinishCount,
    /// The exponent of a finish is 0 or over 1,000.
    FinishExponent {
        /// The material's place in the table, from 0.
        material: usize,
    },
    /// A keyframe has a column that is not as long as the mesh's.
    KeyframeLength {
        /// The keyframe's place in the table, from 0.
        keyframe: usize,
    },
    /// The materials' triangle counts do not add up to the number of triangles.
    MaterialCoverage,
}

impl MeshError {
    /// A line that says what is wrong and what to change.
    #[must_use]
    pub const fn message(self) -> &'static str {
        match self {
            Self::NoVertices => "the mesh has no vertices",
            Self::TooManyVertices => {
                "the mesh has more than 65,536 vertices: split it into several"
            }
            Self::IndexOutOfRange { .. } => "a triangle names a vertex past the end of `positions`",
            Self::LineOutOfRange { .. } => "a line names a vertex that the mesh does not have",
            Self::PointOutOfRange { .. } => "a point names a vertex that the mesh does not have",
            Self::VertexNormalCount => "`vertex_normals` must be empty or as long as `positions`",
            Self::FaceNormalCount => "`face_normals` must be empty or as long as `triangles`",
            Self::TextureCoordinateCount => {
                "`texture_coordinates` must be empty or as long as `positions`"
            }
            Self::TextureRange { .. } => {
                "texture coordinates must lie between -64 and 64 repeats of the texture"
            }
            Self::TextureFractionBits => {
                "the `fraction_bits` of `texture_coordinates` must be 10 to 16"
            }
            Self::VertexColorCount => "`vertex_colors` must be empty or as long as `positions`",
            Self::FinishCount => "`finishes` must be empty or as long as `materials`",
            Self::FinishExponent { .. } => "the `exponent` of a finish must be 1 to 1,000",
            Self::KeyframeLength { .. } => {
                "a keyframe must have as many positions and normals as the mesh"
            }
            Self::MaterialCoverage => {
                "the materials' `triangle_count`s must add up to the number of triangles"
            }
        }
    }
}

impl core::fmt::Display for MeshError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.message())?;
        match self {
            Self::IndexOutOfRange { triangle } => write!(f, " (triangle {triangle})"),
            Self::LineOutOfRange { line } => write!(f, " (line {line})"),
            Self::PointOutOfRange { point } => write!(f, " (point {point})"),
            Self::FinishExponent { material } => write!(f, " (material {material})"),
            Self::KeyframeLength { keyframe } => write!(f, " (keyframe {keyframe})"),
            Self::TextureRange { vertex } => write!(f, " (vertex {vertex})"),
            _ => Ok(()),
        }
    }
}

impl core::error::Error for MeshError {}

/// Checks all that drawing relies on.
pub(super) const fn tables(tables: &Tables<'_>) -> Result<(), MeshError> {
    let vertices = tables.positions.len();
    if vertices == 0 {
        return Err(MeshError::NoVertices);
    }
    if vertices > 1 << 16 {
        return Err(MeshError::TooManyVertices);
    }
    if let Err(error) = indices(&tables.triangles, vertices) {
        return Err(error);
    }
    if !is_empty_or(tables.vertex_normals.len(), vertices) {
        return Err(MeshError::VertexNormalCount);
    }
    if !is_empty_or(tables.face_normals.len(), tables.triangles.len()) {
        return Err(MeshError::FaceNormalCount);
    }
    if !is_empty_or(tables.texture_coordinates.len(), vertices) {
        return Err(MeshError::TextureCoordinateCount);
    }
    if let Err(error) = texture_coordinates(&tables.texture_coordinates) {
        return Err(error);
    }
    if !is_empty_or(tables.vertex_colors.len(), vertices) {
        return Err(MeshError::VertexColorCount);
    }
    if let Err(error) = finishes(tables) {
        return Err(error);
    }
    materials(tables)
}

const fn is_empty_or(length: usize, partner: usize) -> bool {
    length == 0 || length == partner
}

/// The loops count because a `const fn` may not have `for`.
const fn indices(triangles: &Triangles<'_>, vertices: usize) -> Result<(), MeshError> {
    let mut triangle = 0;
    while triangle < triangles.len() {
        let in_range = match triangles {
            Triangles::U8(t) => {
                let [a, b, c] = t[triangle];
                (a as usize) < vertices && (b as usize) < vertices && (c as usize) < vertices
            }
            Triangles::U16(t) => {
                let [a, b, c] = t[triangle];
                (a as usize) < vertices && (b as usize) < vertices && (c as usize) < vertices
            }
        };
        if !in_range {
            return Err(MeshError::IndexOutOfRange { triangle });
        }
        triangle += 1;
    }
    Ok(())
}

/// 16 bits hold less than the limit, so only a table of 32 is searched.
const fn texture_coordinates(coordinates: &TextureCoordinates<'_>) -> Result<(), MeshError> {
    const LIMIT: u32 = (TextureCoordinates::LIMIT as u32) << 24;
    match coordinates {
        TextureCoordinates::I16(_) => {}
        TextureCoordinates::I32(table) => {
            let mut vertex = 0;
            while vertex < table.len() {
                let [u, v] = table[vertex];
                if u.unsigned_abs() > LIMIT || v.unsigned_abs() > LIMIT {
                    return Err(MeshError::TextureRange { vertex });
                }
                vertex += 1;
            }
        }
        TextureCoordinates::U16 { fraction_bits, .. } => {
            if !matches!(*fraction_bits, 10..=16) {
                return Err(MeshError::TextureFractionBits);
            }
        }
    }
    Ok(())
}

const fn finishes(tables: &Tables<'_>) -> Result<(), MeshError> {
    let finishes = tables.finishes;
    if !is_empty_or(finishes.len(), tables.materials.len()) {
        return Err(MeshError::FinishCount);
    }
    let mut material = 0;
    while material < finishes.len() {
        let exponent = finishes[material].exponent;
        if exponent == 0 || exponent > Finish::MOST_EXPONENT {
            return Err(MeshError::FinishExponent { material });
        }
        material += 1;
    }
    Ok(())
}

const fn materials(tables: &Tables<'_>) -> Result<(), MeshError> {
    let mut covered: u64 = 0;
    let mut material = 0;
    while material < tables.materials.len() {
        covered += tables.materials[material].triangle_count as u64;
        material += 1;
    }
    if covered == tables.triangles.len() as u64 { Ok(()) } else { Err(MeshError::MaterialCoverage) }
}
