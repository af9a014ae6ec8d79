//! The rows of the matrix from object space to clip space: computed once a frame, applied to each
//! vertex.

use super::Pose;
use crate::{
    mesh::Tables,
    numbers::{Float, IS_NARROW, Vec3, codegen::keep_rolled, normalised},
};

/// One coordinate of clip space as a function of an object's position: a row of the 3 x 4 matrix.
///
/// Its entries have 14 bits behind the point of a clip-space unit, and are below 2^29. Where there
/// is no long multiply they are kept as `high * 2^14 + low`: then all products with positions of 16
/// bits, and their sums, fit 32 bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<const PARTS: usize = { if IS_NARROW { 2 } else { 1 } }> {
    /// The entries with 16 bits behind the point, or their upper and their lower parts.
    entries: [[i32; 3]; PARTS],
    translation: i32,
}

const FRACTION_BITS: u32 = 14;

impl<const PARTS: usize> Row<PARTS> {
    /// The row's terms in units of 2^`unit`.
    #[inline(never)]
    pub(super) fn new(terms: &Terms, unit: i32) -> Self {
        let mut row =
            Self { entries: [[0; 3]; PARTS], translation: terms.translation.in_units_of(unit) };
        for (column, term) in terms.reaches.iter().enumerate() {
            // For a quantum, a 2^15th of the reach.
            let entry = term.in_units_of(unit + 15 - FRACTION_BITS as i32);
            match row.entries.as_mut_slice() {
                [whole] => whole[column] = entry << (16 - FRACTION_BITS),
                [high, low] => {
                    high[column] = entry >> FRACTION_BITS;
                    low[column] = entry & ((1 << FRACTION_BITS) - 1);
                }
                _ => {}
            }
        }
        row
    }

    /// ⌊entries . p⌋ + translation, exactly.
    #[inline(always)]
    pub(super) fn apply(&self, p: [i32; 3]) -> i32 {
        let product =
            |entries: &[i32; 3]| entries[0] * p[0] + entries[1] * p[1] + entries[2] * p[2];
        let sum = match self.entries.as_slice() {
            [whole] => {
                // With 16 bits each behind the point, the integer is the upper word.
                let [x, y, z] =
                    core::array::from_fn(|i| i64::from(whole[i]) * i64::from(p[i] << 16));
                ((x + y + z) >> 32) as i32
            }
            [high, low] => product(high) + (product(low) >> FRACTION_BITS),
            _ => 0,
        };
        sum + self.translation
    }
}

/// A row before its unit is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Terms {
    /// The most that each coordinate of a position adds: at 2^15 quanta.
    pub(super) reaches: [Float; 3],
    pub(super) translation: Float,
}

impl Terms {
    /// `axis` is a camera axis; `magnification` is the clip-space length of one world unit along
    /// it.
    // codegen: not inlined, like all that builds the matrix: it runs for each of three rows once a
    // frame.
    #[inline(never)]
    pub(super) fn new(
        axis: &[i32; 3],
        magnification: Float,
        eye: &Vec3,
        pose: &Pose,
        tables: &Tables<'_>,
    ) -> Self {
        let direction = pose.rotation.turn_back(axis);
        let scale = Float::from_unsigned(pose.scale);
        let offset = Float::new(tables.offset.along(&direction), -46).times(scale);
        // Each below 2^62, as an axis has length one.
        let way = pose.translation.along(axis) - eye.along(axis);
        let mut reach = scale.times(Float::from_scale(tables.scale)).times(magnification);
        // From a quantum to the farthest.
        reach.exponent += 15;
        Self {
            reaches: direction.map(|c| Float::new(i64::from(c), -30).times(reach)),
            translation: Float::new(way, -46).plus(offset).times(magnification),
        }
    }

    /// The least n for which a coordinate stays below 2^n.
    #[inline(never)]
    pub(super) fn magnitude(&self) -> i32 {
        // Added in a unit in which none of the four reaches 2^28, plus what rounding takes off
        // them.
        let mut most = self.translation.exponent;
        for reach in &self.reaches {
            keep_rolled();
            most = most.max(reach.exponent);
        }
        let unit = most + 31 - 28;
        let mut sum = self.translation.in_units_of(unit).unsigned_abs() + 4;
        for reach in &self.reaches {
            keep_rolled();
            sum += reach.in_units_of(unit).unsigned_abs();
        }
        let (_, leading_zeros) = normalised(sum);
        unit + 32 - leading_zeros as i32
    }
}
