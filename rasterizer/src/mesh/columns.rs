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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TextureCoordinates<'a> {
    /// 16 bits a coordinate.
    U16 {
        /// u and v in units of 2<sup>-`fraction_bits`</sup>. An empty table stands for none.
        table: &'a [[u16; 2]],
        /// How many of the 16 bits are behind the binary point: 0 to 16.
        fraction_bits: u8,
    },
}

impl<'a> TextureCoordinates<'a> {
    /// No texture coordinates.
    pub const NONE: Self = Self::U16 { table: &[], fraction_bits: 16 };

    /// The number of vertices that have texture coordinates.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.as_slice().len()
    }

    /// Whether there are no texture coordinates.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The texture coordinates of vertex `index`, or `None` past the end.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<[u16; 2]> {
        self.as_slice().get(index).copied()
    }

    /// How many bits of a coordinate are behind the binary point: 0 to 16.
    #[inline(always)]
    #[must_use]
    pub const fn fraction_bits(&self) -> u8 {
        let Self::U16 { fraction_bits, .. } = *self;
        fraction_bits
    }

    #[inline(always)]
    pub(super) const fn as_slice(&self) -> &'a [[u16; 2]] {
        let Self::U16 { table, .. } = *self;
        table
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
