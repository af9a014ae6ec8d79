//! A sphere of nearly equal triangles.

use super::{Builder, Solid};
use crate::numbers::unit;

/// A sphere of radius 1 from an icosahedron, each of whose edges is divided: its triangles are
/// nearly equal, and none is thin. It has no texture coordinates (all are zero).
///
/// Its triangles are those of the icosahedron's faces, n² of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Icosphere {
    parts: usize,
}

/// The shorter and the longer side of a golden rectangle with corners at a distance of 1, in Q30:
/// 1 / √(1 + φ²) and φ / √(1 + φ²).
const SHORT: i64 = 564_499_483;
const LONG: i64 = 913_379_350;

/// The corners of three golden rectangles.
const CORNERS: [[i64; 3]; 12] = [
    [-SHORT, LONG, 0],
    [SHORT, LONG, 0],
    [-SHORT, -LONG, 0],
    [SHORT, -LONG, 0],
    [0, -SHORT, LONG],
    [0, SHORT, LONG],
    [0, -SHORT, -LONG],
    [0, SHORT, -LONG],
    [LONG, 0, -SHORT],
    [LONG, 0, SHORT],
    [-LONG, 0, -SHORT],
    [-LONG, 0, SHORT],
];

const FACES: [[usize; 3]; 20] = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
];

/// The edges, each from the lower corner to the higher one.
const EDGES: [[usize; 2]; 30] = {
    let (mut edges, mut count, mut side) = ([[0; 2]; 30], 0, 0);
    while side < 60 {
        let face = FACES[side / 3];
        let (a, b) = (face[side % 3], face[(side % 3 + 1) % 3]);
        // Each is a side of two faces, in both directions.
        if a < b {
            edges[count] = [a, b];
            count += 1;
        }
        side += 1;
    }
    assert!(count == 30);
    edges
};

impl Icosphere {
    /// Of an icosahedron with this number of parts in each edge: 1 for the icosahedron itself.
    ///
    /// # Panics
    ///
    /// Panics if there is none. In a constant that is a compile error.
    #[must_use]
    pub const fn new(parts: usize) -> Self {
        assert!(parts > 0, "an edge has a part");
        Self { parts }
    }

    /// How many vertices it has.
    #[must_use]
    pub const fn vertices(self) -> usize {
        10 * self.parts * self.parts + 2
    }

    /// How many triangles it has.
    #[must_use]
    pub const fn triangles(self) -> usize {
        20 * self.parts * self.parts
    }

    /// Its tables.
    ///
    /// # Panics
    ///
    /// Panics if `V` and `T` are other numbers than [`vertices`](Self::vertices) and
    /// [`triangles`](Self::triangles). In a constant that is a compile error.
    #[must_use]
    pub const fn solid<const V: usize, const T: usize>(self) -> Solid<V, T> {
        let n = self.parts;
        let mut builder = Builder::new(self.vertices(), self.triangles());
        let mut corner = 0;
        while corner < 12 {
            add(&mut builder, [corner, corner, corner], [1, 0, 0]);
            corner += 1;
        }
        let mut edge = 0;
        while edge < 30 {
            let [a, b] = EDGES[edge];
            let mut step = 1;
            while step < n {
                add(&mut builder, [a, b, a], [n - step, step, 0]);
                step += 1;
            }
            edge += 1;
        }
        let mut face = 0;
        while face < 20 {
            let mut row = 1;
            while row < n {
                let mut column = 1;
                while column < row {
                    add(&mut builder, FACES[face], [n - row, row - column, column]);
                    column += 1;
                }
                row += 1;
            }
            face += 1;
        }
        let mut face = 0;
        while face < 20 {
            let mut row = 0;
            while row < n {
                let mut column = 0;
                while column <= row {
                    let below =
                        [self.at(face, row + 1, column), self.at(face, row + 1, column + 1)];
                    builder.triangle([self.at(face, row, column), below[0], below[1]]);
                    if column < row {
                        let right = self.at(face, row, column + 1);
                        builder.triangle([self.at(face, row, column), below[1], right]);
                    }
                    column += 1;
                }
                row += 1;
            }
            face += 1;
        }
        builder.finish()
    }

    /// The vertex of a face in a row, from its first corner on, and a column, from its second.
    const fn at(self, face: usize, row: usize, column: usize) -> usize {
        let (n, [a, b, c]) = (self.parts, FACES[face]);
        match (row == 0, column == 0, column == row, row == n) {
            (true, ..) => a,
            (_, true, _, true) => b,
            (_, _, true, true) => c,
            (_, true, ..) => self.on_edge(a, b, row),
            (_, _, true, _) => self.on_edge(a, c, row),
            (.., true) => self.on_edge(b, c, column),
            _ => {
                let before = (row - 1) * (row - 2) / 2 + column - 1;
                12 + 30 * (n - 1) + face * ((n - 1) * (n - 2) / 2) + before
            }
        }
    }

    /// The vertex `step` parts from a corner on the way to another one.
    const fn on_edge(self, from: usize, to: usize, step: usize) -> usize {
        let (low, high, step) =
            if from < to { (from, to, step) } else { (to, from, self.parts - step) };
        let mut edge = 0;
        while EDGES[edge][0] != low || EDGES[edge][1] != high {
            edge += 1;
        }
        12 + edge * (self.parts - 1) + step - 1
    }
}

/// Adds the vertex in the direction of a weighted sum of corners.
const fn add<const V: usize, const T: usize>(
    builder: &mut Builder<V, T>,
    corners: [usize; 3],
    weights: [usize; 3],
) {
    let (mut sum, mut entry) = ([0; 3], 0);
    while entry < 9 {
        sum[entry % 3] += CORNERS[corners[entry / 3]][entry % 3] * weights[entry / 3] as i64;
        entry += 1;
    }
    if let Some(place) = unit(sum) {
        builder.vertex(place, place, [[0, 1], [0, 1]]);
    }
}
