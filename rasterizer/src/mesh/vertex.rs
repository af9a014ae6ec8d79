//! Vertices and triangles of a mesh, as a shader sees them.

use super::{Changes, Normals, Positions, Tables, TextureCoordinates};

/// The optional tables of a mesh that a shader reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct RequiredTables {
    /// [`Tables::vertex_normals`].
    pub vertex_normals: bool,
    /// [`Tables::face_normals`].
    pub face_normals: bool,
    /// [`Tables::texture_coordinates`].
    pub texture_coordinates: bool,
    /// [`Tables::texture_coordinates`] of 16 bits ([`TextureCoordinates::I16`]).
    pub narrow_texture_coordinates: bool,
    /// [`Tables::vertex_colors`].
    pub vertex_colors: bool,
}

impl RequiredTables {
    /// None of them.
    pub const NONE: Self = Self {
        vertex_normals: false,
        face_normals: false,
        texture_coordinates: false,
        narrow_texture_coordinates: false,
        vertex_colors: false,
    };

    /// `tables` with each per-vertex table that this shader reads cut to `count` entries; `None` if
    /// one is shorter.
    // codegen: then the compiler sees that no index below `count` is past the end.
    #[inline(always)]
    pub(crate) fn of_vertices<'a>(self, tables: &Tables<'a>, count: usize) -> Option<Tables<'a>> {
        let Positions::I16(positions) = tables.positions;
        let Normals::I8(normals) = tables.vertex_normals;
        let is_textured = self.texture_coordinates || self.narrow_texture_coordinates;
        Some(Tables {
            positions: Positions::I16(positions.get(..count)?),
            vertex_normals: Normals::I8(cut(normals, count, self.vertex_normals)?),
            texture_coordinates: match tables.texture_coordinates {
                TextureCoordinates::I16(table) => {
                    TextureCoordinates::I16(cut(table, count, is_textured)?)
                }
                TextureCoordinates::I32(table) => {
                    TextureCoordinates::I32(cut(table, count, is_textured)?)
                }
                TextureCoordinates::U16 { table, fraction_bits } => TextureCoordinates::U16 {
                    table: cut(table, count, is_textured)?,
                    fraction_bits,
                },
            },
            vertex_colors: cut(tables.vertex_colors, count, self.vertex_colors)?,
            ..*tables
        })
    }
}

#[inline(always)]
fn cut<T>(column: &[T], count: usize, is_read: bool) -> Option<&[T]> {
    if is_read { column.get(..count) } else { Some(column) }
}

/// A vertex of a mesh. Each method reads its table when it is called.
///
/// Of an object between two shapes ([`Object::morphed`](crate::scene::Object::morphed)) position
/// and normal are those between them. Of an object with a matrix of its own
/// ([`Object::shaped`](crate::scene::Object::shaped)) they are then those that the matrix makes of
/// these: object space is the space after it.
#[derive(Clone, Copy, Debug)]
pub struct MeshVertex<'a> {
    tables: &'a Tables<'a>,
    index: usize,
    changes: Changes<'a>,
}

impl<'a> MeshVertex<'a> {
    #[inline(always)]
    pub(crate) const fn new(tables: &'a Tables<'a>, index: usize, changes: Changes<'a>) -> Self {
        Self { tables, index, changes }
    }

    /// Its position in quanta of the mesh that [`ObjectView::mesh`] returns.
    ///
    /// [`ObjectView::mesh`]: crate::geometry::ObjectView::mesh
    #[inline(always)]
    #[must_use]
    pub fn position(&self) -> [i16; 3] {
        self.changes.position(self.table_position())
    }

    /// Its position in the table, or between those of two shapes.
    #[inline(always)]
    pub(crate) fn table_position(&self) -> [i16; 3] {
        let position = self.tables.positions.get(self.index).unwrap_or_default();
        let tween = self.changes.tween;
        tween.map_or(position, |tween| tween.position_from(position, self.index))
    }

    /// Its normal in object space, 127 standing for 1; zero if the mesh has none.
    #[inline(always)]
    #[must_use]
    pub fn normal(&self) -> [i8; 3] {
        let normal = self.tables.vertex_normals.get(self.index).unwrap_or_default();
        let tween = self.changes.tween;
        let blended = tween.map_or(normal, |tween| tween.vertex_normal(normal, self.index));
        self.changes.normal(blended)
    }

    /// Its texture coordinates u and v with 24 bits behind the binary point, 1 being the texture's
    /// width or height; zero if the mesh has none.
    #[inline(always)]
    #[must_use]
    pub fn texture_coordinates(&self) -> [i32; 2] {
        self.tables.texture_coordinates.get(self.index).unwrap_or_default()
    }

    /// Its texture coordinates u and v with 14 bits behind the binary point, for meshes whose table
    /// has 16 bits ([`TextureCoordinates::I16`]); zero for others.
    #[inline(always)]
    #[must_use]
    pub fn texture_coordinates_q14(&self) -> [i16; 2] {
        self.tables.texture_coordinates.get_q14(self.index).unwrap_or_default()
    }

    /// Its colour: red, green and blue, 0 to 255; black if the mesh has none.
    #[inline(always)]
    #[must_use]
    pub fn color(&self) -> [u8; 3] {
        self.tables.vertex_colors.get(self.index).copied().unwrap_or_default()
    }
}

/// A triangle of a mesh. Each method reads its table when it is called; middle and normal are in
/// the space of a [`MeshVertex`]'s.
#[derive(Clone, Copy, Debug)]
pub struct MeshFace<'a> {
    tables: &'a Tables<'a>,
    index: usize,
    changes: Changes<'a>,
}

impl<'a> MeshFace<'a> {
    #[inline(always)]
    pub(crate) const fn new(tables: &'a Tables<'a>, index: usize, changes: Changes<'a>) -> Self {
        Self { tables, index, changes }
    }

    /// A vertex of its mesh.
    #[inline(always)]
    const fn vertex(&self, index: usize) -> MeshVertex<'a> {
        MeshVertex::new(self.tables, index, self.changes)
    }

    /// Its place in the table, from 0.
    #[inline(always)]
    #[must_use]
    pub const fn index(&self) -> usize {
        self.index
    }

    /// The mean of its corners' positions, in quanta of the mesh that
    /// [`ObjectView::mesh`](crate::geometry::ObjectView::mesh) returns, within one of them, or one
    /// of the table's.
    #[inline(always)]
    #[must_use]
    pub fn center(&self) -> [i16; 3] {
        let corners = self.tables.triangles.get(self.index).unwrap_or_default();
        let corners = corners.map(|corner| self.vertex(corner).table_position());
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = corners;
        // A third is 21,845 / 2^16 within 2^-17.6. The product fits: a sum is -98,304 to 98,301.
        let third = |[a, b, c]: [i16; 3]| {
            let sum = i32::from(a) + i32::from(b) + i32::from(c);
            ((sum * 21_845 + (1 << 15)) >> 16) as i16
        };
        let center = [third([ax, bx, cx]), third([ay, by, cy]), third([az, bz, cz])];
        self.changes.position(center)
    }

    /// Its normal in object space, 127 standing for 1; zero if the mesh has none.
    #[inline(always)]
    #[must_use]
    pub fn normal(&self) -> [i8; 3] {
        let normal = self.tables.face_normals.get(self.index).unwrap_or_default();
        let tween = self.changes.tween;
        let blended = tween.map_or(normal, |tween| tween.face_normal(normal, self.index));
        self.changes.normal(blended)
    }
}
