//! The columns of a model's tables, each in one of the formats that it may have.
//!
//! A column is an enum, so that a format can be added without a change to the files that use
//! another.

/// Where the vertices are, in quanta of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Positions<'a> {
    /// 16 bits a coordinate: x, y and z.
    I16(&'a [[i16; 3]]),
}

impl<'a> Positions<'a> {
    /// The number of vertices.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.as_slice().len()
    }

    /// Whether there is no vertex.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The position of vertex `index`, or `None` past the end.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<[i16; 3]> {
        self.as_slice().get(index).copied()
    }

    #[inline(always)]
    pub(super) const fn as_slice(&self) -> &'a [[i16; 3]] {
        let Self::I16(table) = *self;
        table
    }
}

/// Unit normals of vertices or of triangles, in object space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Normals<'a> {
    /// 8 bits a coordinate, 127 standing for 1: x, y and z. An empty table stands for none.
    I8(&'a [[i8; 3]]),
}

impl<'a> Normals<'a> {
    /// No normals.
    pub const NONE: Self = Self::I8(&[]);

    /// The number of normals.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.as_slice().len()
    }

    /// Whether there are no normals.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Normal `index` with 127 standing for 1, or `None` past the end.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<[i8; 3]> {
        self.as_slice().get(index).copied()
    }

    #[inline(always)]
    pub(super) const fn as_slice(&self) -> &'a [[i8; 3]] {
        let Self::I8(table) = *self;
        table
    }
}

/// Texture coordinates of vertices: u runs to the right and v downwards from the texture's top-left
/// corner, and 1 is the width or the height of the texture.
///
/// None of them is over [`LIMIT`](Self::LIMIT) repeats of the texture from 0. An empty table stands
/// for none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TextureCoordinates<'a> {
    /// 16 bits a coordinate, 14 of them behind the binary point: from -2 to 2 in steps of 1/16
    /// texel of a texture of 1,024.
    I16(&'a [[i16; 2]]),
    /// 32 bits a coordinate, 24 of them behind the binary point.
    I32(&'a [[i32; 2]]),
    /// The format of older model files. A model that is converted again has one of the others.
    U16 {
        /// u and v in units of 2<sup>-`fraction_bits`</sup>.
        table: &'a [[u16; 2]],
        /// How many of the 16 bits are behind the binary point: 10 to 16.
        fraction_bits: u8,
    },
}

impl TextureCoordinates<'_> {
    /// No texture coordinates.
    pub const NONE: Self = Self::I16(&[]);

    /// The most repeats of a texture that a coordinate may be from 0, on either side.
    pub const LIMIT: i32 = 64;

    /// The number of vertices that have texture coordinates.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::I16(table) => table.len(),
            Self::I32(table) => table.len(),
            Self::U16 { table, .. } => table.len(),
        }
    }

    /// Whether there are no texture coordinates.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The texture coordinates of vertex `index` with 24 bits behind the binary point, exact for
    /// every format, or `None` past the end.
    #[inline(always)]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<[i32; 2]> {
        match *self {
            Self::I16(table) => Some(table.get(index)?.map(|c| i32::from(c) << 10)),
            Self::I32(table) => table.get(index).copied(),
            // A mesh has at least 10 bits: the coordinate is below 2^6 repeats.
            Self::U16 { table, fraction_bits } => {
                let up = 24 - u32::from(fraction_bits).min(24);
                Some(table.get(index)?.map(|c| i32::from(c) << up))
            }
        }
    }

    /// The texture coordinates of vertex `index` with 14 bits behind the binary point, if they have
    /// 16 bits ([`I16`](Self::I16)).
    #[inline(always)]
    #[must_use]
    pub fn get_q14(&self, index: usize) -> Option<[i16; 2]> {
        match self {
            Self::I16(table) => table.get(index).copied(),
            _ => None,
        }
    }
}

/// Three vertex indices per triangle, counter-clockwise when seen from its front.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
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

    /// The vertex indices of a triangle, for constants: one that does not exist panics.
    pub(super) const fn corners(&self, index: usize) -> [usize; 3] {
        match self {
            Self::U8(triangles) => {
                let [a, b, c] = triangles[index];
                [a as usize, b as usize, c as usize]
            }
            Self::U16(triangles) => {
                let [a, b, c] = triangles[index];
                [a as usize, b as usize, c as usize]
            }
        }
    }

    /// The vertex indices of triangle `index`, or `None` past the end.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<[usize; 3]> {
        match self {
            Self::U8(triangles) => triangles.get(index).map(|t| t.map(usize::from)),
            Self::U16(triangles) => triangles.get(index).map(|t| t.map(usize::from)),
        }
    }
}
