//! A model as bytes: a file in external flash, or in a firmware by `include_bytes!`.
//!
//! `host-tools convert model.obj -o model.bin` writes it. [`Mesh::from_bytes`] checks it once, and
//! then reads its tables where they are, without a copy.
//!
//! # Format
//!
//! All numbers are little-endian. The file begins at an address that is a multiple of 4, and so do
//! its tables: each is followed by as many bytes as that takes, which are not read.
//!
//! | offset | bytes | |
//! |---|---|---|
//! | 0 | 4 | the letters `RMSH` |
//! | 4 | 2 | the version of the format: 1 |
//! | 6 | 2 | 0x1234, by which the order of bytes is known |
//! | 8 | 4 | the bytes of the whole file |
//! | 12 | 4 | V, the number of vertices |
//! | 16 | 4 | T, the number of triangles |
//! | 20 | 4 | M, the number of materials |
//! | 24 | 4 | a bit for each of the tables and formats below, counted from the least; others are 0 |
//! | 28 | 8 | mantissa (its top bit is set) and exponent of the [scale](super::Tables::scale) |
//! | 36 | 12 | x, y and z of the [offset](super::Tables::offset) in Q16.16 |
//! | 48 | | the tables, in this order |
//!
//! | table | bit | numbers |
//! |---|---|---|
//! | positions | | 3 V of 16 bits, signed |
//! | vertex normals | 0 | 3 V of 8 bits, signed |
//! | face normals | 1 | 3 T of 8 bits, signed |
//! | texture coordinates | 2 | 2 V of 16 bits, signed, in Q2.14 |
//! | the same, if bit 2 is 0 | 3 | 2 V of 32 bits, signed, in Q8.24 |
//! | vertex colours | 4 | 3 V of 8 bits |
//! | triangles | | 3 T of 8 bits, or of 16 if bit 5 is set |
//! | materials | | M times red, green, blue, a byte that is not read, and the triangles in 32 bits |
//! | finishes | 6 | M times the specular colour, a byte that is not read, the exponent in 16 bits, the emission, the opacity |
//!
//! Nothing of a file is trusted: any bytes give a mesh that is safe to draw, or an error. There is
//! no checksum.

use bytemuck::AnyBitPattern;

use super::{Mesh, MeshError, Normals, Positions, Tables, TextureCoordinates, Triangles};
use crate::numbers::{Scale, Vec3};

/// Why bytes are no mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BlobError {
    /// They do not begin at a multiple of 4: put them into an [`Aligned`].
    Alignment,
    /// They are not a model of `host-tools convert`.
    Magic,
    /// They are a model of another version of the format: convert it again.
    Version,
    /// The core stores numbers in another order of bytes.
    Endianness,
    /// There are fewer bytes than the model has, or more.
    Length,
    /// They have a table that this version does not know.
    Columns,
    /// The scale is not one of [`Scale::new`].
    Scale,
    /// The tables are faulty.
    Tables(MeshError),
}

impl BlobError {
    /// A line that says what is wrong and what to change.
    #[must_use]
    pub const fn message(self) -> &'static str {
        match self {
            Self::Alignment => "the model does not begin at a multiple of 4: use `Aligned`",
            Self::Magic => "this is no model of `host-tools convert -o model.bin`",
            Self::Version => "the model has another version of the format: convert it again",
            Self::Endianness => "the model's numbers have another order of bytes than the core's",
            Self::Length => "the model is longer or shorter than it says: is all of it there?",
            Self::Columns => "the model has a table that this version does not know",
            Self::Scale => "the model's scale is out of range",
            Self::Tables(error) => error.message(),
        }
    }
}

impl core::fmt::Display for BlobError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Tables(error) => error.fmt(f),
            _ => f.write_str(self.message()),
        }
    }
}

impl core::error::Error for BlobError {}

impl From<MeshError> for BlobError {
    fn from(error: MeshError) -> Self {
        Self::Tables(error)
    }
}

/// Bytes that begin at a multiple of 4, for `include_bytes!`, whose own begin anywhere.
///
/// ```no_run
/// # macro_rules! include_bytes { ($name:literal) => { &[0u8; 48] } }
/// use rasterizer::mesh::{Aligned, BlobError, Mesh};
///
/// static MODEL: &Aligned<[u8]> = &Aligned(*include_bytes!("model.bin"));
///
/// let mesh = Mesh::from_bytes(&MODEL.0)?;
/// # Ok::<(), BlobError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(C, align(4))]
pub struct Aligned<T: ?Sized>(pub T);

const MAGIC: [u8; 4] = *b"RMSH";
const VERSION: u16 = 1;
const ORDER: u16 = 0x1234;
/// What the file and each of its tables begin at a multiple of.
const ALIGNMENT: usize = 4;

const VERTEX_NORMALS: u32 = 1 << 0;
const FACE_NORMALS: u32 = 1 << 1;
const NARROW_TEXTURE: u32 = 1 << 2;
const WIDE_TEXTURE: u32 = 1 << 3;
const VERTEX_COLORS: u32 = 1 << 4;
const WIDE_TRIANGLES: u32 = 1 << 5;
const FINISHES: u32 = 1 << 6;
const ALL: u32 = (1 << 7) - 1;

impl<'a> Mesh<'a> {
    /// A mesh whose tables are in these bytes, in the format of [`mesh::blob`](crate::mesh::blob).
    /// It takes a visit of each index and of each position; drawing checks nothing again.
    ///
    /// # Errors
    ///
    /// Returns the first thing that is wrong. No bytes make it panic.
    pub fn from_bytes(bytes: &'a [u8]) -> Result<Self, BlobError> {
        Ok(Self::new(tables(bytes)?)?)
    }
}

/// The tables of a file, whose indices and lengths are not yet checked.
fn tables(bytes: &[u8]) -> Result<Tables<'_>, BlobError> {
    let mut rest = Rest(bytes);
    if bytemuck::try_cast_slice::<u8, u32>(bytes.get(..ALIGNMENT).ok_or(BlobError::Length)?)
        .is_err()
    {
        return Err(BlobError::Alignment);
    }
    if rest.array()? != MAGIC {
        return Err(BlobError::Magic);
    }
    let [version, order] = [rest.array()?, rest.array()?];
    if u16::from_ne_bytes(order) != ORDER {
        return Err(BlobError::Endianness);
    }
    if u16::from_le_bytes(version) != VERSION {
        return Err(BlobError::Version);
    }
    if rest.word()? as usize != bytes.len() {
        return Err(BlobError::Length);
    }
    let [vertices, triangles, materials] = [rest.word()?, rest.word()?, rest.word()?];
    let [vertices, triangles, materials] = [vertices, triangles, materials].map(|n| n as usize);
    let columns = rest.word()?;
    if columns & !ALL != 0
        || columns & (NARROW_TEXTURE | WIDE_TEXTURE) == NARROW_TEXTURE | WIDE_TEXTURE
    {
        return Err(BlobError::Columns);
    }
    let has = |column, count| if columns & column != 0 { count } else { 0 };
    let (mantissa, exponent) = (rest.word()?, rest.word()?.cast_signed());
    if mantissa >> 31 == 0 || exponent.unsigned_abs() > 1000 {
        return Err(BlobError::Scale);
    }
    let offset = [rest.word()?, rest.word()?, rest.word()?].map(u32::cast_signed);
    let tables = Tables {
        scale: Scale::new(mantissa, exponent),
        offset: Vec3::from_bits(offset),
        positions: Positions::I16(rest.column(vertices)?),
        vertex_normals: Normals::I8(rest.column(has(VERTEX_NORMALS, vertices))?),
        face_normals: Normals::I8(rest.column(has(FACE_NORMALS, triangles))?),
        texture_coordinates: if columns & WIDE_TEXTURE == 0 {
            TextureCoordinates::I16(rest.column(has(NARROW_TEXTURE, vertices))?)
        } else {
            TextureCoordinates::I32(rest.column(vertices)?)
        },
        vertex_colors: rest.column(has(VERTEX_COLORS, vertices))?,
        triangles: if columns & WIDE_TRIANGLES == 0 {
            Triangles::U8(rest.column(triangles)?)
        } else {
            Triangles::U16(rest.column(triangles)?)
        },
        materials: rest.column(materials)?,
        finishes: rest.column(has(FINISHES, materials))?,
    };
    if rest.0.is_empty() { Ok(tables) } else { Err(BlobError::Length) }
}

/// What has not been read of a file.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn array<const N: usize>(&mut self) -> Result<[u8; N], BlobError> {
        let (array, rest) = self.0.split_first_chunk().ok_or(BlobError::Length)?;
        self.0 = rest;
        Ok(*array)
    }

    fn word(&mut self) -> Result<u32, BlobError> {
        self.array().map(u32::from_le_bytes)
    }

    /// The next table, which begins at a multiple of 4 as the file does.
    fn column<T: AnyBitPattern>(&mut self, count: usize) -> Result<&'a [T], BlobError> {
        let bytes = count.checked_mul(size_of::<T>());
        let padded = bytes.and_then(|bytes| bytes.checked_next_multiple_of(ALIGNMENT));
        let split = padded.and_then(|padded| self.0.split_at_checked(padded));
        let (column, rest) = split.ok_or(BlobError::Length)?;
        self.0 = rest;
        let column = column.get(..bytes.unwrap_or_default()).unwrap_or_default();
        bytemuck::try_cast_slice(column).map_err(|_| BlobError::Alignment)
    }
}
