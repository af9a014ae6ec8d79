//! A mesh as a linear map changes it: positions and normals of what a matrix stretches, mirrors or
//! shears.
//!
//! The map is a power of two times a matrix that makes no vector longer. So the positions of the
//! changed mesh have 16 bits too, in another quantum. A normal n becomes the unit vector along
//! ±C n, where C is the matrix of cofactors, the inverse transpose times the determinant: the
//! vectors of the surface stay at right angles to it. The sign is that of the determinant, so that
//! what points outwards still does. C exists where the matrix has no inverse: a body that is
//! flattened onto a plane has the normals of that plane.

use super::{BoundingBox, Mesh, Tables};
use crate::numbers::{Direction, Matrix, mul_wide_q30, shifted};

/// A linear map, prepared for a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Shaping {
    matrix: Matrix,
    /// The map's matrix over 2^`exponent`, in Q30. Magnitudes of a row or of a column add up to 1
    /// at most, so that no vector gets longer.
    rows: [[i32; 3]; 3],
    exponent: i32,
    /// The cofactors times any positive number, with the determinant's sign: below 2^22.
    cofactors: [[i32; 3]; 3],
    is_mirrored: bool,
    /// Those of the mesh.
    spare_bits: u32,
}

/// The least exponent: lengths of the world keep their bits behind the point.
const LEAST_EXPONENT: i32 = -12;

impl Shaping {
    pub(crate) fn new(matrix: &Matrix) -> Self {
        let bits = matrix.to_bits();
        let sum = |at: &dyn Fn(usize, usize) -> i32| {
            let line = |i| (0..3).map(|j| u64::from(at(i, j).unsigned_abs())).sum::<u64>();
            line(0).max(line(1)).max(line(2))
        };
        let most = sum(&|i, j| bits[i][j]).max(sum(&|i, j| bits[j][i]));
        // The least n for which the sums are 2^n at most.
        let up = u64::BITS - most.saturating_sub(1).leading_zeros();
        let exponent = (up.cast_signed() - 16).max(LEAST_EXPONENT);
        let rows = bits.map(|row| row.map(|c| shifted(c.into(), 14 - exponent) as i32));
        let (cofactors, is_mirrored) = cofactors(&rows);
        Self { matrix: *matrix, rows, exponent, cofactors, is_mirrored, spare_bits: 0 }
    }

    /// The same for the vertices of a mesh.
    pub(crate) const fn of_mesh(self, mesh: &Mesh<'_>) -> Self {
        Self { spare_bits: mesh.spare_bits, ..self }
    }

    /// The binary exponent of the length in the changed mesh of one of the mesh.
    pub(crate) const fn exponent(&self) -> i32 {
        self.exponent
    }

    /// Whether a triangle that runs counter-clockwise, seen from outside, then runs clockwise.
    pub(crate) const fn is_mirrored(&self) -> bool {
        self.is_mirrored
    }

    /// A direction of the changed mesh as a linear function of the mesh's positions, in Q60: the
    /// product of a row vector with the matrix.
    pub(crate) fn turn_back_exactly(&self, v: [i64; 3]) -> [i64; 3] {
        core::array::from_fn(|column| {
            self.rows.iter().zip(v).map(|(row, v)| mul_wide_q30(v, row[column])).sum()
        })
    }

    /// The changed mesh: the quantum of its vertices, the place of their zero, their bounds. Its
    /// tables of vertices are those of the mesh.
    pub(crate) fn mesh<'a>(&self, mesh: &Mesh<'a>) -> Mesh<'a> {
        let map = self.of_mesh(mesh);
        let tables = mesh.tables();
        let power = self.exponent - mesh.spare_bits().cast_signed();
        let scale = tables.scale.times_power_of_2(power);
        let offset = self.matrix.apply(tables.offset);
        let corners: [_; 8] =
            core::array::from_fn(|index| map.position(mesh.bounds().corner(index)));
        Mesh {
            tables: Tables { scale, offset, ..*tables },
            bounds: BoundingBox::of(&corners),
            spare_bits: 0,
        }
    }

    /// A position of the changed mesh in its quanta, rounded.
    pub(super) fn position(&self, position: [i16; 3]) -> [i16; 3] {
        let [x, y, z] = position.map(|c| i32::from(c) << self.spare_bits);
        let product = |c: i32, factor: i32| i64::from(c) * i64::from(factor);
        self.rows.map(|[a, b, c]| {
            let sum = product(x, a) + product(y, b) + product(z, c);
            // 2^15 at most, which is one too many.
            ((sum + (1 << 29)) >> 30).min(i64::from(i16::MAX)) as i16
        })
    }

    /// A normal of the changed mesh, 127 standing for 1: in the direction of the exact one within
    /// half a degree, as a normal of the tables is; zero if there is none.
    #[inline(always)]
    pub(super) fn normal(&self, [x, y, z]: [i8; 3]) -> [i8; 3] {
        let [x, y, z] = [x, y, z].map(i32::from);
        // Three products below 2^29.
        let along = self.cofactors.map(|[a, b, c]| a * x + b * y + c * z);
        Direction::of(along).in_127ths()
    }
}

/// The cofactors of a matrix in Q30 with the determinant's sign, times any positive number, and
/// whether that sign is negative.
fn cofactors(rows: &[[i32; 3]; 3]) -> ([[i32; 3]; 3], bool) {
    let wide = rows.map(|row| row.map(i64::from));
    // In Q60, exact: the cross products of the other rows.
    let exact: [[i64; 3]; 3] = core::array::from_fn(|i| {
        let (a, b) = (wide[(i + 1) % 3], wide[(i + 2) % 3]);
        core::array::from_fn(|j| {
            let (k, l) = ((j + 1) % 3, (j + 2) % 3);
            a[k] * b[l] - a[l] * b[k]
        })
    });
    // The determinant in Q60 rounded down, of which the sign is exact.
    let mask = (1 << 30) - 1;
    let (mut upper, mut lower) = (0, 0);
    for (entry, cofactor) in wide[0].into_iter().zip(exact[0]) {
        upper += entry * (cofactor >> 30);
        lower += entry * (cofactor & mask);
    }
    let is_mirrored = upper + (lower >> 30) < 0;
    let all = exact.as_flattened().iter().fold(0, |all, c| all | c.unsigned_abs());
    let down = 42 - all.leading_zeros().cast_signed();
    let cofactors = exact.map(|row| {
        row.map(|c| {
            let c = shifted(c, -down) as i32;
            if is_mirrored { -c } else { c }
        })
    });
    (cofactors, is_mirrored)
}
