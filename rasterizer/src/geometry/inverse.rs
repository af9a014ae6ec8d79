//! The way from the camera's axes back to those of an object that a matrix changes.
//!
//! The rows of D are the camera's axes in object space, so D takes a way in object space to one
//! along the camera's axes. Here D = N L, where L has the largest magnitude of each column of D in
//! its diagonal: the columns of N have lengths from 1 to the root of 3, however much the matrix
//! stretches, and only what it shears is in N.
//!
//! The anchor a is the point of the mesh's box that is nearest, in object space, to the eye's place
//! q. That is so along each axis, thus also for lengths that are multiplied by L. With the least
//! stretch s of N, the distance of a vertex v from the eye is at least s |L (v - q)|, so that along
//! axis j |v - a| is at most 1 / (s L<sub>j</sub>) of the distance, besides the box's extent. The
//! anchor's own distance is at most 3 |L (a - q)|, so that no vertex has less than s / 3 of it.
//!
//! Where the matrix shears less, more is known. With the anchor's way w from the eye the distance
//! of a vertex has the square |w|² + 2 w·D (v - a) + |D (v - a)|². If the box reaches no farther
//! than |w|² / 2 back along w, the first two are not below zero, and |D (v - a)| is at most the
//! distance: as at right angles, where nothing of the box is nearer than the anchor.

use super::placement::{Axis, Grid};
use crate::{mesh::Mesh, numbers::Float};

/// The inverse of the matrix whose rows are axes.
pub(super) struct Inverse {
    /// The largest magnitude of each column.
    lengths: [Float; 3],
    /// The cofactors of the matrix after division by these: the inverse's columns times the
    /// determinant.
    cofactors: [[Float; 3]; 3],
    /// One over the determinant's magnitude, or zero if the matrix may have no inverse.
    per_magnitude: Float,
    is_negative: bool,
}

/// Determinants below 2 to this power are taken for zero: some 500 times what they are off by.
const LEAST_DETERMINANT: i32 = -18;

impl Inverse {
    #[inline(never)]
    pub(super) fn of(axes: [&Axis; 3]) -> Self {
        let mut rows = axes.map(|axis| axis.direction.map(|c| Float::new(c, -60)));
        let lengths = [0, 1, 2].map(|column| {
            let of_column = rows.iter().map(|row| row[column]);
            let most = of_column.fold(Float::ZERO, |most, c| larger(most, magnitude(c)));
            if most != Float::ZERO {
                let per_length = most.reciprocal();
                rows.iter_mut().for_each(|row| row[column] = row[column].times(per_length));
            }
            most
        });
        let cofactors = [0, 1, 2].map(|i| {
            let (a, b) = (&rows[(i + 1) % 3], &rows[(i + 2) % 3]);
            [0, 1, 2].map(|j| {
                let (k, l) = ((j + 1) % 3, (j + 2) % 3);
                a[k].times(b[l]).plus(a[l].times(b[k]).negative())
            })
        });
        let parts = rows[0].iter().zip(&cofactors[0]).map(|(a, b)| a.times(*b));
        let determinant = parts.fold(Float::ZERO, Float::plus);
        let is_certain = determinant.magnitude() > LEAST_DETERMINANT;
        let per_magnitude =
            if is_certain { magnitude(determinant).reciprocal() } else { Float::ZERO };
        Self { lengths, cofactors, per_magnitude, is_negative: determinant.mantissa < 0 }
    }

    /// The part along one of the object's axes of the way from the anchor to the eye: of
    /// -D<sup>-1</sup> w, where w is the anchor's way from the eye along the camera's. Zero if
    /// there is no inverse.
    pub(super) fn way_to_eye(&self, axes: [&Axis; 3], column: usize) -> Float {
        if self.per_magnitude == Float::ZERO {
            return Float::ZERO;
        }
        let parts = axes.iter().zip(&self.cofactors).map(|(axis, cofactors)| {
            axis.way().times(cofactors.get(column).copied().unwrap_or(Float::ZERO))
        });
        let way = parts.fold(Float::ZERO, Float::plus).times(self.per_magnitude);
        let length = self.lengths.get(column).copied().unwrap_or(Float::ZERO);
        let way = way.times(length.reciprocal());
        if self.is_negative { way } else { way.negative() }
    }

    /// At most as long as the shortest vector that N makes of one of length one: one over the
    /// largest sum of the magnitudes in a row or a column of the inverse. Zero if there is none.
    fn least_stretch(&self) -> Float {
        let mut most = Float::ZERO;
        for i in 0..3 {
            let (mut row, mut column) = (Float::ZERO, Float::ZERO);
            for j in 0..3 {
                row = row.plus(magnitude(self.cofactors[i][j]));
                column = column.plus(magnitude(self.cofactors[j][i]));
            }
            most = larger(most, larger(row, column));
        }
        let most = most.times(self.per_magnitude);
        if most == Float::ZERO { most } else { most.reciprocal() }
    }

    /// The most that the magnitudes of a vector's components along the object's axes add up to, for
    /// one of length 1: the length of s D<sup>-1</sup> for the signs s that make it largest. At
    /// right angles it is the root of 3.
    fn most_sum(&self) -> Float {
        let mut most = Float::ZERO;
        for signs in 0..4 {
            let square = self.cofactors.iter().fold(Float::ZERO, |square, cofactors| {
                let parts = cofactors.iter().zip(self.lengths).enumerate();
                let sum = parts.fold(Float::ZERO, |sum, (column, (cofactor, length))| {
                    let part = cofactor.times(length.reciprocal());
                    sum.plus(if signs >> column & 1 == 0 { part } else { part.negative() })
                });
                square.plus(sum.times(sum))
            });
            most = larger(most, square);
        }
        let square = most.times(self.per_magnitude).times(self.per_magnitude);
        // The root is below its tangents: x / 3.5 + 3.5 / 4, which touches it near 3.
        square.times(const { Float::new(7, -1).reciprocal() }).plus(const { Float::new(7, -3) })
    }

    /// The distance at which vertices are off by what the entries of a matrix without a shape are
    /// off by at `distance`, or more.
    ///
    /// The entries' rounding moves a vertex by half a step times the sum of |v - a| along the axes,
    /// in quanta. Without a shape that sum is taken for 2<sup>17</sup> times the root of 3 at
    /// `distance`, and less in proportion to the distance before. Here it is at most the distance
    /// times the sum of 1 / (s L<sub>j</sub>), and no more than the box's extents.
    pub(super) fn least_distance(
        &self,
        distance: Float,
        grid: &Grid,
        axes: [&Axis; 3],
        mesh: &Mesh<'_>,
    ) -> Float {
        const SUM: Float = Float::new(3, 16);
        let least_stretch = self.least_stretch();
        if least_stretch == Float::ZERO || grid.quantum == Float::ZERO {
            return Float::ZERO;
        }
        let way = axes.iter().fold(Float::ZERO, |most, axis| larger(most, magnitude(axis.way())));
        // In quanta; a quarter for a third.
        let mut nearest = way.times(least_stretch).over(grid.quantum);
        nearest.exponent -= 2;
        let mut sum = Float::ZERO;
        let ends = mesh.bounds().min.iter().zip(mesh.bounds().max);
        for (length, (&min, max)) in self.lengths.iter().zip(ends) {
            let extent = (i64::from(max) - i64::from(min)) << mesh.spare_bits();
            let of_distance = length.times(least_stretch).reciprocal();
            let part = if nearest == Float::ZERO {
                of_distance
            } else {
                smaller(of_distance, Float::new(extent, 0).over(nearest))
            };
            sum = sum.plus(if extent == 0 { Float::ZERO } else { part });
        }
        if sum == Float::ZERO {
            return distance;
        }
        if is_little_behind(grid, axes, mesh) {
            sum = smaller(sum, self.most_sum());
        }
        smaller(distance, SUM.times(grid.quantum).times(sum.reciprocal()))
    }
}

/// Whether the box reaches no farther than |w|² / 2 back along the anchor's way w from the eye, in
/// quanta.
#[inline(never)]
fn is_little_behind(grid: &Grid, axes: [&Axis; 3], mesh: &Mesh<'_>) -> bool {
    let way = axes.map(|axis| axis.way().over(grid.quantum));
    // Minus a sixteenth, for rounding.
    let mut rest = way.iter().fold(Float::ZERO, |sum, part| sum.plus(part.times(*part)));
    rest = rest.times(const { Float::new(15, -5) });
    for column in 0..3 {
        let along = axes.iter().zip(way).fold(Float::ZERO, |sum, (axis, part)| {
            let direction = axis.direction.get(column).copied().unwrap_or_default();
            sum.plus(part.times(Float::new(direction, -60)))
        });
        let [min, max] = [mesh.bounds().min, mesh.bounds().max]
            .map(|ends| i64::from(ends[column]) << mesh.spare_bits());
        let end = if along.mantissa < 0 { max } else { min };
        let to_end = Float::new(end - i64::from(grid.anchor[column]), 0);
        rest = rest.plus(along.times(to_end));
    }
    rest.mantissa > 0
}

const fn magnitude(x: Float) -> Float {
    Float { mantissa: x.mantissa.abs(), ..x }
}

fn larger(a: Float, b: Float) -> Float {
    if b.is_below(a) { a } else { b }
}

fn smaller(a: Float, b: Float) -> Float {
    if b.is_below(a) { b } else { a }
}
