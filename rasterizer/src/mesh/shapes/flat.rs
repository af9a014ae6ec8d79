//! Shapes with plane faces.

use super::{Builder, ONE, Solid};

/// A cube from -1 to 1 along each axis, with the whole of a texture on each side.
///
/// Its triangles are those of the sides right, left, top, bottom, front and back, two each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Cube;

/// The directions to the right and upwards on each side, seen from outside. Their cross product
/// points outwards.
const SIDES: [[[i32; 3]; 2]; 6] = [
    [[0, 0, -1], [0, 1, 0]],
    [[0, 0, 1], [0, 1, 0]],
    [[1, 0, 0], [0, 0, -1]],
    [[1, 0, 0], [0, 0, 1]],
    [[1, 0, 0], [0, 1, 0]],
    [[-1, 0, 0], [0, 1, 0]],
];

impl Cube {
    /// How many vertices it has: 24.
    #[must_use]
    pub const fn vertices(self) -> usize {
        24
    }

    /// How many triangles it has: 12.
    #[must_use]
    pub const fn triangles(self) -> usize {
        12
    }

    /// Its tables.
    ///
    /// # Panics
    ///
    /// Panics if `V` and `T` are other numbers than [`vertices`](Self::vertices) and
    /// [`triangles`](Self::triangles). In a constant that is a compile error.
    #[must_use]
    pub const fn solid<const V: usize, const T: usize>(self) -> Solid<V, T> {
        let mut builder = Builder::new(self.vertices(), self.triangles());
        let mut side = 0;
        while side < 6 {
            let [r, u] = SIDES[side];
            let out =
                [r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]];
            let mut corner = 0;
            // Row by row from the upper left one.
            while corner < 4 {
                let (column, row) = (corner % 2, corner / 2);
                let (right, up) = (2 * column as i32 - 1, 1 - 2 * row as i32);
                let (mut position, mut normal, mut axis) = ([0; 3], [0; 3], 0);
                while axis < 3 {
                    position[axis] = (out[axis] + right * r[axis] + up * u[axis]) * ONE;
                    normal[axis] = out[axis] * ONE;
                    axis += 1;
                }
                builder.vertex(position, normal, [[column, 1], [row, 1]]);
                corner += 1;
            }
            builder.field(4 * side, 1, 1);
            side += 1;
        }
        builder.finish()
    }
}

/// A square from -1 to 1 along x and z, at y = 0, whose front is above, cut into cells: for lights
/// at vertices, and so that fewer triangles are as wide as the picture. The texture's upper side is
/// at z = -1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plane {
    columns: usize,
    rows: usize,
}

impl Plane {
    /// Of columns along x and rows along z.
    ///
    /// # Panics
    ///
    /// Panics if there is none of either. In a constant that is a compile error.
    #[must_use]
    pub const fn new(columns: usize, rows: usize) -> Self {
        assert!(columns > 0 && rows > 0, "a plane has a column and a row");
        Self { columns, rows }
    }

    /// How many vertices it has.
    #[must_use]
    pub const fn vertices(self) -> usize {
        (self.columns + 1) * (self.rows + 1)
    }

    /// How many triangles it has.
    #[must_use]
    pub const fn triangles(self) -> usize {
        2 * self.columns * self.rows
    }

    /// Its tables.
    ///
    /// # Panics
    ///
    /// Panics if `V` and `T` are other numbers than [`vertices`](Self::vertices) and
    /// [`triangles`](Self::triangles). In a constant that is a compile error.
    #[must_use]
    pub const fn solid<const V: usize, const T: usize>(self) -> Solid<V, T> {
        let mut builder = Builder::new(self.vertices(), self.triangles());
        let mut vertex = 0;
        while vertex < V {
            let (column, row) = (vertex % (self.columns + 1), vertex / (self.columns + 1));
            let (x, z) = (along(column, self.columns), along(row, self.rows));
            builder.vertex([x, 0, z], [0, ONE, 0], [[column, self.columns], [row, self.rows]]);
            vertex += 1;
        }
        builder.field(0, self.columns, self.rows);
        builder.finish()
    }
}

/// From -1 to 1 in Q30.
const fn along(step: usize, of: usize) -> i32 {
    ((step as i64 * 2 * ONE as i64) / of as i64 - ONE as i64) as i32
}
