//! The rows of the matrix from object space to clip space: computed once a frame, applied to each
//! vertex.

use super::placement::{Axis, Grid};
use crate::{
    mesh::Mesh,
    numbers::{Coordinate, Float, IS_NARROW, codegen::keep_rolled, mul_wide_q30, shifted},
};

/// One coordinate of clip space as a function of an object's position in normalised quanta: a row
/// of the 3 x 4 matrix.
///
/// Entries and translation have 15 bits behind the point of a clip-space unit, and entries are
/// below 2^30. Where there is no long multiply they are kept as `high * 2^15 + low`, where the
/// lower part has a sign: then the products of three of them with positions of 16 bits stay below
/// 3 x 2^29, and their sum fits 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Row<const PARTS: usize = { if IS_NARROW { 2 } else { 1 } }> {
    /// The entries with 16 bits behind the point, or their upper and their lower parts.
    entries: [[i32; 3]; PARTS],
    /// The translation's whole units, and 32 bits or 15 bits behind the point.
    translation: (i32, u32),
}

/// Bits behind the point.
const FRACTION_BITS: u32 = 15;

impl<const PARTS: usize> Row<PARTS> {
    /// 0 everywhere.
    pub(super) const ZERO: Self = Self { entries: [[0; 3]; PARTS], translation: (0, 0) };

    /// The row of one of the camera's axes in units of 2^`unit`.
    // codegen: not inlined, like all that builds the matrix: it runs for each of three rows once a
    // frame.
    #[inline(never)]
    pub(super) fn new<C: Coordinate>(axis: &Axis, grid: &Grid, unit: i32) -> Self {
        let step = unit - FRACTION_BITS.cast_signed();
        let (origin, quantum) = (axis.origin(), grid.quantum.times(axis.magnification));
        // The translation makes the anchor exact. Half a unit, so that whole ones are rounded.
        let (mut translation, half) = if C::HAS_FRACTION {
            (shifted(origin.mantissa.into(), origin.exponent - step), 0)
        } else {
            (i64::from(origin.in_units_of(unit)) << FRACTION_BITS, 1 << (FRACTION_BITS - 1))
        };
        let mut entries = [[0; 3]; PARTS];
        for (column, (&direction, &anchor)) in axis.direction.iter().zip(&grid.anchor).enumerate() {
            keep_rolled();
            // Q60 times a mantissa, over 2^30.
            let entry = mul_wide_q30(direction, quantum.mantissa);
            let exponent = quantum.exponent - 30;
            let entry = if C::HAS_FRACTION {
                shifted(entry, exponent - step) as i32
            } else {
                Float::new(entry, exponent).in_units_of(step)
            };
            if C::HAS_FRACTION {
                translation -= i64::from(entry) * i64::from(anchor);
            }
            match entries.as_mut_slice() {
                [whole] => whole[column] = entry << (16 - FRACTION_BITS),
                [high, low] => {
                    high[column] = (entry + (1 << (FRACTION_BITS - 1))) >> FRACTION_BITS;
                    low[column] = entry - (high[column] << FRACTION_BITS);
                }
                _ => {}
            }
        }
        // A translation beyond 32 bits of units wraps round, and what is added to it wraps back.
        let units = (translation >> FRACTION_BITS) as i32;
        let fraction = (translation as u32 & ((1 << FRACTION_BITS) - 1)) | half;
        let shift = if PARTS == 1 { 32 - FRACTION_BITS } else { 0 };
        Self { entries, translation: (units, fraction << shift) }
    }

    /// The least coordinate of all positions in the mesh's bounds, or the greatest.
    #[inline(never)]
    pub(super) fn end(&self, mesh: &Mesh<'_>, is_greatest: bool) -> i32 {
        let mut sum = self.translation.0;
        for column in 0..3 {
            keep_rolled();
            let entry = self.entry(column);
            let bounds = mesh.bounds();
            let end = if (entry < 0) == is_greatest { bounds.min } else { bounds.max };
            let end = i32::from(end[column]) << mesh.spare_bits();
            let product = i64::from(entry) * i64::from(end);
            sum = sum.wrapping_add((product >> FRACTION_BITS) as i32);
        }
        sum
    }

    /// By how much a coordinate changes at most with a quantum in each axis, in units.
    #[inline(never)]
    pub(super) fn quanta(&self) -> i32 {
        (0..3).map(|column| (self.entry(column).abs() >> FRACTION_BITS) + 1).sum()
    }

    /// An entry with its bits behind the point.
    fn entry(&self, column: usize) -> i32 {
        match self.entries.as_slice() {
            [whole] => whole[column] >> (16 - FRACTION_BITS),
            [high, low] => (high[column] << FRACTION_BITS) + low[column],
            _ => 0,
        }
    }

    /// By how many bits [`apply`](Self::apply) wants positions shifted up.
    pub(super) const POSITION_SHIFT: u32 = if PARTS == 1 { 16 } else { 0 };

    /// entries . p + translation, exactly.
    #[inline(always)]
    pub(super) fn apply<C: Coordinate>(&self, p: [i32; 3]) -> C {
        let (units, fraction) = self.translation;
        match self.entries.as_slice() {
            [whole] => {
                // With 16 bits each behind the point.
                let product = |i: usize| i64::from(whole[i]) * i64::from(p[i]);
                let sum = i64::new(units, fraction)
                    .wrapping_add(product(0))
                    .wrapping_add(product(1))
                    .wrapping_add(product(2));
                C::new(sum.units(), sum.fraction())
            }
            [high, low] => {
                let product = |entries: &[i32; 3]| {
                    let product = |i: usize| entries[i].wrapping_mul(p[i]);
                    product(0).wrapping_add(product(1)).wrapping_add(product(2))
                };
                let fraction = product(low) + fraction.cast_signed();
                let carry = fraction >> FRACTION_BITS;
                let units = product(high).wrapping_add(units).wrapping_add(carry);
                C::new(units, fraction.cast_unsigned() << (32 - FRACTION_BITS))
            }
            _ => C::new(0, 0),
        }
    }
}
