//! How a model is converted: what a program or a build script may choose.

use std::fmt;

use super::TextureOptions;

/// How to convert a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Where it lies and how large it is.
    pub fit: Fit,
    /// Up to this angle between two faces, in degrees from 0 to 180, a computed normal is smooth
    /// across their edge.
    pub crease_degrees: f64,
    /// Whether faces that run against their neighbours, and closed parts that are inside out, are
    /// turned over. Without it they are only told.
    pub fix_winding: bool,
    /// Whether computed normals follow the file's smoothing groups (`s 1`, `s off`) in place of the
    /// crease angle: faces of a group are smooth, those of none flat. Faces that no `s` precedes
    /// follow the crease angle.
    pub smoothing_groups: bool,
    /// The most triangles; `None` for all that the file has. Fewer are chosen so that the surface,
    /// its normals, texture coordinates and colours change little, and the model keeps its place
    /// and its size: [`Report::simplification`](super::Report::simplification) has how far the
    /// surface moves. Normals are computed before.
    pub simplify: Option<usize>,
    /// Whether edges become lines: those in which faces meet at this angle in degrees or more, from
    /// 0 for all to 180, and those of one face alone.
    pub edges_degrees: Option<f64>,
    /// Which tables to make.
    pub contents: Contents,
    /// How the pictures of materials become textures, whose coordinates are then made too; `None`
    /// leaves them out.
    pub textures: Option<TextureOptions>,
    /// The name of the static; `None` for that of the file.
    pub name: Option<String>,
}

impl Default for Options {
    /// Unit fit, smoothing groups, a crease angle of 60 degrees, winding as it is, all triangles,
    /// the default contents, no edges, textures, the name of the file.
    fn default() -> Self {
        Self {
            fit: Fit::default(),
            crease_degrees: 60.0,
            fix_winding: false,
            smoothing_groups: true,
            simplify: None,
            edges_degrees: None,
            contents: Contents::default(),
            textures: Some(TextureOptions::default()),
            name: None,
        }
    }
}

/// Where a model lies and how large it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fit {
    /// The middle of its bounding box at the origin, its farthest vertex at a distance of 1.
    #[default]
    Unit,
    /// The file's own coordinates, which must lie in Q16.16.
    Keep,
}

impl fmt::Display for Fit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unit => "unit fit",
            Self::Keep => "coordinates kept",
        })
    }
}

/// Which of the optional tables to make.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Contents {
    /// For smooth shading; hard edges take more vertices.
    pub vertex_normals: bool,
    /// For flat shading.
    pub face_normals: bool,
    /// Texture coordinates even without a texture, for other shaders; seams take more vertices.
    pub texture_coordinates: bool,
    /// The colours of vertices, if the file has any (`v x y z r g b`).
    pub vertex_colors: bool,
}

impl Default for Contents {
    /// Both kinds of normals, no texture coordinates but for textures, and colours of vertices.
    fn default() -> Self {
        Self {
            vertex_normals: true,
            face_normals: true,
            texture_coordinates: false,
            vertex_colors: true,
        }
    }
}
