//! What can go wrong between a file and its tables, and what to do about it.

use std::{fmt, io, path::PathBuf};

use thiserror::Error;

use super::quote::shown;

/// Why a model cannot be converted.
#[derive(Debug, Error)]
pub enum ModelError {
    /// The file cannot be opened or read.
    #[error("{}: {source}: check the path and that the file may be read", shown(.path))]
    Read {
        /// The file.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// The path names a directory.
    #[error("{} is a directory: name the file in it", shown(.path))]
    Directory {
        /// The directory.
        path: PathBuf,
    },
    /// The path names a device, a pipe or a socket.
    #[error("{} is not an ordinary file: save the model to a file first", shown(.path))]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The file has no bytes.
    #[error("{} is empty: export the model again", shown(.path))]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The file is text of two bytes a character.
    #[error("{} is UTF-16 text: save it as UTF-8", shown(.path))]
    Utf16 {
        /// The file.
        path: PathBuf,
    },
    /// A line of the file is wrong.
    #[error("{}:{line}: {fault}", shown(.path))]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1; for a statement continued by `\`, its first.
        line: usize,
        /// What is wrong with it.
        fault: LineFault,
    },
    /// The file has no `v` line.
    #[error(
        "{} has no vertices (lines `v x y z`): is it an OBJ file, and was anything selected \
         for export?",
        shown(.path)
    )]
    NoVertices {
        /// The file.
        path: PathBuf,
    },
    /// The file has no `f`, `l` or `p` line.
    #[error(
        "{} has vertices but no faces (lines `f 1 2 3`), and no lines (`l 1 2`) or points (`p 1`): \
         export it as polygons, not as curves",
        shown(.path)
    )]
    NoFaces {
        /// The file.
        path: PathBuf,
    },
    /// All vertices of all faces, lines and points coincide.
    #[error(
        "{} has no size: all vertices of its faces, lines and points lie at one point: export it \
         again with more decimal places",
        shown(.path)
    )]
    NoSize {
        /// The file.
        path: PathBuf,
    },
    /// Every triangle is degenerate, and there are no lines and points.
    #[error(
        "{}: all {faces} faces have zero area: export it again with more decimal places",
        shown(.path)
    )]
    NoArea {
        /// The file.
        path: PathBuf,
        /// How many faces there are.
        faces: usize,
    },
    /// [`Options::simplify`](super::Options::simplify) is less than what can be reached.
    #[error(
        "{} cannot be simplified to {most} triangles: {least} are the fewest that keep its shape \
         and the borders of its materials: allow as many, or use fewer materials",
        shown(.path)
    )]
    TooFewTriangles {
        /// The file.
        path: PathBuf,
        /// The most that there may be.
        most: usize,
        /// The fewest that are reached.
        least: usize,
    },
    /// The vertices do not fit indices of 16 bits.
    #[error(
        "{} needs {count} vertices, more than the 65,536 that 16-bit indices can name: \
         simplify the model (`--simplify`), split it into several, raise the crease angle, or leave out normals \
         or texture coordinates",
        shown(.path)
    )]
    TooManyVertices {
        /// The file.
        path: PathBuf,
        /// How many there are after equal ones are merged.
        count: usize,
    },
    /// With [`Fit::Keep`](super::Fit::Keep), a coordinate is out of range.
    #[error(
        "{}: coordinate {value} does not fit Q16.16 (-32,768 to 32,767.99998): use the unit \
         fit, or scale or move the model",
        shown(.path)
    )]
    OutOfRange {
        /// The file.
        path: PathBuf,
        /// The coordinate.
        value: f64,
    },
    /// With [`Fit::Keep`](super::Fit::Keep), the model is too small for its steps.
    #[error(
        "{} measures {size} units, too few steps of 1/65,536 to show its shape: use the unit \
         fit, or scale the model",
        shown(.path)
    )]
    TooSmall {
        /// The file.
        path: PathBuf,
        /// Its largest extent along an axis.
        size: f64,
    },
    /// The contents include texture coordinates and the file has none.
    #[error(
        "{} has no texture coordinates (lines `vt u v`, faces `f 1/1 2/2 3/3`): export them, \
         or leave them out of the contents",
        shown(.path)
    )]
    NoTextureCoordinates {
        /// The file.
        path: PathBuf,
    },
    /// The texture coordinates cover more than the tables hold.
    #[error(
        "{}: texture coordinates reach {range} repeats of the texture, and the tables hold 64 on \
         either side: cut the faces that repeat it so often, or scale their coordinates down",
        shown(.path)
    )]
    TextureRange {
        /// The file.
        path: PathBuf,
        /// The farthest coordinate from 0, in repeats.
        range: f64,
    },
    /// The picture of a material's texture cannot be read.
    #[error(
        "{}:{line}: `map_Kd`: {fault} (or correct its name here, or convert without textures)",
        shown(.path)
    )]
    Picture {
        /// The material library.
        path: PathBuf,
        /// The line of the `map_Kd`.
        line: usize,
        /// What is wrong with the picture.
        fault: String,
    },
    /// Textures cannot have the size chosen.
    #[error(
        "{}: textures of {}x{}: {reason}: choose another size",
        shown(.path),
        .size[0],
        .size[1]
    )]
    TextureSize {
        /// The OBJ file.
        path: PathBuf,
        /// The size chosen.
        size: [usize; 2],
        /// Why not.
        reason: &'static str,
    },
    /// The crease angle is out of range.
    #[error(
        "a crease angle of {degrees} degrees is out of range: choose 0 (all edges hard) to 180 \
         (all smooth)"
    )]
    Crease {
        /// The angle given.
        degrees: f64,
    },
    /// The angle from which on edges are made is not from 0 to 180 degrees.
    #[error(
        "an angle of {degrees} degrees between faces is out of range: choose 0 (all edges) to 180"
    )]
    Edges {
        /// The angle given.
        degrees: f64,
    },
    /// The parser rejects a file that passes the line checks.
    #[error("{}: the OBJ parser fails: {source}", shown(.path))]
    Parse {
        /// The file.
        path: PathBuf,
        /// The parser's error.
        source: tobj::LoadError,
    },
    /// Two files of an animation differ in more than positions and normals.
    #[error(
        "{}:{line}: {difference} at {}:{first_line}: the files of an animation need the same faces, \
         texture coordinates and materials in the same order: export them from one model",
        shown(.path),
        shown(.first)
    )]
    Topology {
        /// The file that differs from the first.
        path: PathBuf,
        /// Its line.
        line: usize,
        /// The first file.
        first: PathBuf,
        /// The line of the first file that it differs from.
        first_line: usize,
        /// What differs.
        difference: Difference,
    },
    /// Several shapes of one model are to be simplified.
    #[error(
        "only a single file can be simplified: the shapes of an animation need the same triangles. \
         Simplify the model first, and then move it"
    )]
    SimplifiedKeyframes,
    /// The result cannot be written.
    #[error("{} cannot be written: {source}: {}", shown(.path), remedy(source))]
    Write {
        /// The file.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// There is no `OUT_DIR`.
    #[error(
        "OUT_DIR is not set: call this from a build script (build.rs), for which Cargo sets it"
    )]
    NoOutDir,
}

/// What to do about a file that cannot be written.
fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "make room on the disk, or write to another"
        }
        io::ErrorKind::InvalidFilename => "choose another name",
        _ => "check that its directory exists and is writable",
    }
}

/// What a file of an animation has, and then what the first file has.
#[derive(Clone, Debug, PartialEq)]
pub enum Difference {
    /// Faces.
    FaceCount {
        /// How many.
        counts: [usize; 2],
    },
    /// Corners of a face.
    CornerCount {
        /// How many.
        counts: [usize; 2],
    },
    /// A corner of a face has another vertex.
    Vertex {
        /// Which corner, from 1.
        corner: usize,
        /// The numbers of the vertices, from 1.
        vertices: [usize; 2],
    },
    /// A corner of a face has other texture coordinates.
    Texture {
        /// Which corner, from 1.
        corner: usize,
        /// The texture coordinates, if it has any.
        textures: [Option<[f64; 2]>; 2],
    },
    /// A face has another material.
    Material {
        /// The names, if there are any.
        names: [Option<String>; 2],
    },
    /// Lines (`l`) or points (`p`).
    Elements,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FaceCount { counts: [count, first] } => {
                write!(f, "there are {count} faces and not {first} as")
            }
            Self::CornerCount { counts: [count, first] } => {
                write!(f, "the face has {count} corners and not {first} as")
            }
            Self::Vertex { corner, vertices: [vertex, first] } => {
                write!(f, "corner {corner} of the face is vertex {vertex} and not {first} as")
            }
            Self::Texture { corner, textures: [own, first] } => {
                let text = |texture: &Option<[f64; 2]>| {
                    texture.map_or_else(|| "none".into(), |[u, v]| format!("({u}, {v})"))
                };
                let (own, first) = (text(own), text(first));
                write!(
                    f,
                    "corner {corner} of the face has texture coordinates {own} and not {first} as"
                )
            }
            Self::Material { names: [own, first] } => {
                let text = |name: &Option<String>| {
                    name.as_ref()
                        .map_or_else(|| "no material".into(), |n| format!("material `{n}`"))
                };
                write!(f, "{} and not {} as", text(own), text(first))
            }
            Self::Elements => f.write_str("lines (`l`) or points (`p`) are not those"),
        }
    }
}

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LineFault {
    /// Fewer numbers than the statement needs.
    #[error(
        "`{keyword}` needs {needed} numbers and has {found}: complete the line or export the model \
         again"
    )]
    TooFewNumbers {
        /// `v`, `vn` or `vt`.
        keyword: &'static str,
        /// How many it needs.
        needed: usize,
        /// How many it has.
        found: usize,
    },
    /// A word that is not a number.
    #[error("`{word}` is not a number: write it like 1.5 or -2e-3, with a point and no comma")]
    NotANumber {
        /// The word.
        word: String,
    },
    /// NaN or infinity.
    #[error(
        "`{word}` is not a finite number: repair the model (a division by zero in the exporter?)"
    )]
    NotFinite {
        /// The word.
        word: String,
    },
    /// A face of one or two corners.
    #[error(
        "a face needs 3 corners or more and has {found}: remove the line, or make it a line \
         element `l`"
    )]
    TooFewCorners {
        /// How many it has.
        found: usize,
    },
    /// A face corner of another form than `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    #[error("`{corner}` is not a face corner: write whole numbers as in 1, 1/2, 1//3 or 1/2/3")]
    BadCorner {
        /// The corner.
        corner: String,
    },
    /// Fewer vertices than a line or a point needs.
    #[error(
        "`{keyword}` needs {needed} vertices or more and has {found}: complete the line or remove it"
    )]
    TooFewVertices {
        /// `l` or `p`.
        keyword: &'static str,
        /// How many it needs.
        needed: usize,
        /// How many it has.
        found: usize,
    },
    /// A vertex of a line or a point of another form than `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    #[error("`{vertex}` is not a vertex of `{keyword}`: write whole numbers as in 1 or 1/2")]
    BadVertex {
        /// `l` or `p`.
        keyword: &'static str,
        /// The vertex.
        vertex: String,
    },
    /// Index 0.
    #[error("index 0 in `{corner}`: OBJ counts from 1 (or from -1 backwards)")]
    IndexZero {
        /// The corner.
        corner: String,
    },
    /// An index beyond the table.
    #[error(
        "`{corner}` names {kind} {index}, but there are {count}: check the export, or that no \
         lines are missing"
    )]
    IndexOutOfRange {
        /// The corner.
        corner: String,
        /// `vertex`, `texture coordinate` or `normal`.
        kind: &'static str,
        /// The index as written.
        index: i64,
        /// How many it can choose from.
        count: usize,
    },
}
