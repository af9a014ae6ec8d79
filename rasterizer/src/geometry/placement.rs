//! Where an object lies as seen from the camera, before projection: how far along the camera's axes
//! (`Axis`), and on which grid of positions (`Grid`).

use super::shape::Posed;
use crate::{
    camera::Camera,
    mesh::Mesh,
    numbers::{Float, Vec3, codegen::keep_rolled, mul_q60, mul_wide_q30, shifted},
};

/// One of the camera's axes, and how far along it the object is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    /// In object space, in Q60.
    pub(super) direction: [i64; 3],
    /// The way from the eye to the object's anchor along the axis, in world units, in Q44.
    way: i64,
    /// The clip-space length of a world unit along the axis.
    pub(super) magnification: Float,
}

/// Bits behind the point of lengths in world units. The least near plane, 2^-16 units away, is 2^28
/// steps away. No length reaches 2^18 units, as eye and pose lie within 2^15 of the origin.
pub(super) const FRACTION_BITS: i32 = 44;

impl Axis {
    /// The axis of the camera, and the way to the mesh's origin. It is valid if the mesh's
    /// [offset is in range](is_offset_in_range).
    // codegen: not inlined, like all that builds the matrix: its temporaries leave the stack.
    #[inline(never)]
    pub(super) fn new<P>(
        camera: &Camera<P>,
        axis: usize,
        magnification: Float,
        posed: impl Posed,
        offset: Vec3,
    ) -> Self {
        let vector = &camera.axes()[axis];
        // Each below 2^62, as an axis has length one.
        let way = posed.pose().translation.along(vector) - camera.eye().along(vector);
        Self::along(vector, way, magnification, posed, offset)
    }

    /// The axis that is `vector` in world space, in Q30 and no longer than one, and the way to the
    /// mesh's origin. `way` is that to the pose's origin, in Q46.
    #[inline(always)]
    pub(super) fn along(
        vector: &[i32; 3],
        way: i64,
        magnification: Float,
        posed: impl Posed,
        offset: Vec3,
    ) -> Self {
        let direction = posed.turn_back_exactly(vector);
        let mut axis = Self { direction, way: way >> (46 - FRACTION_BITS), magnification };
        let scale =
            i64::from(posed.pose().scale.to_bits()) << (FRACTION_BITS - 32 + posed.exponent());
        for (column, &offset) in offset.to_bits().iter().enumerate() {
            keep_rolled();
            // Q16.16 times Q16.28.
            axis.advance(column, scale.wrapping_mul(offset.into()));
        }
        axis
    }

    /// The coordinate of the anchor in clip space.
    #[inline(never)]
    pub(super) const fn origin(&self) -> Float {
        Float::new(self.way, -FRACTION_BITS).times(self.magnification)
    }

    /// How far a position can be from the anchor along the axis, in clip space.
    #[inline(never)]
    pub(super) const fn reach(&self, grid: &Grid) -> Float {
        // The coordinates of a direction add up to no more than the root of 3.
        const SUM: Float = Float::new(7, -2);
        let mut reach = grid.quantum.times(SUM).times(self.magnification);
        reach.exponent += grid.reach_bits;
        reach
    }

    /// The least n for which the coordinate of all positions, and the translation, stay below 2^n.
    #[inline(never)]
    pub(super) fn magnitude(&self, grid: &Grid) -> i32 {
        let mut origin = self.origin();
        origin.mantissa = origin.mantissa.abs();
        let sum = self.reach(grid).plus(origin);
        // What is rounded up to the next power of two needs another bit.
        sum.magnitude() + i32::from(sum.mantissa >= i32::MAX - 3)
    }

    /// The part of the way from the anchor to the eye along one of the object's axes that these
    /// three have, if they are at right angles.
    #[inline(always)]
    pub(super) fn way_to_eye(axes: [&Self; 3], column: usize) -> Float {
        let mut to_eye = 0i64;
        for axis in axes {
            keep_rolled();
            let part = mul_wide_q30(axis.way, (axis.direction[column] >> 30) as i32);
            to_eye = to_eye.wrapping_sub(part);
        }
        Float::new(to_eye, -FRACTION_BITS)
    }

    /// The way from the eye to the anchor, in world units.
    pub(super) const fn way(&self) -> Float {
        Float::new(self.way, -FRACTION_BITS)
    }

    /// Moves the anchor by a length along an axis of the object.
    #[inline(never)]
    fn advance(&mut self, column: usize, length: i64) {
        let direction = self.direction.get(column).copied().unwrap_or_default();
        self.way = self.way.wrapping_add(mul_q60(length, direction));
    }
}

/// Whether the mesh's origin lies within 2^16 world units of the pose's.
pub(super) fn is_offset_in_range(posed: impl Posed, offset: Vec3) -> bool {
    // codegen: not by `map`, which has an array of its own.
    let [x, y, z] = offset.to_bits();
    let bits = x.unsigned_abs() | y.unsigned_abs() | z.unsigned_abs();
    u64::from(bits) * u64::from(posed.pose().scale.to_bits()) < 1 << (32 + 16 - posed.exponent())
}

/// The positions of a mesh as its matrix sees them: in normalised quanta. The mesh's own are
/// shifted up until the largest has 16 bits.
///
/// Then meshes that differ only in how they divide lengths between positions and scale have the
/// same matrix.
///
/// The entries of a matrix are rounded, and what that moves a point by grows with the distance from
/// where the matrix is exact: from the *anchor*, which is the mesh's own origin. For an object that
/// is large compared with how near it comes it moves to the point of the mesh's grid that is
/// nearest to the eye. No vertex is nearer, so that a vertex is off by no more than a fixed part of
/// its distance from the eye, however large the object is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// The length of a normalised quantum in world units: a number below 2^63, and the exponent of
    /// 2 of its unit.
    length: i64,
    exponent: i32,
    /// The same.
    pub(super) quantum: Float,
    /// In normalised quanta.
    pub(super) anchor: [i32; 3],
    /// The distance of a position from the anchor is below 2 to this power, along an axis.
    reach_bits: i32,
}

/// Further bits of the length of a quantum, so that 2^15 of them are as exact as other lengths.
const QUANTUM_BITS: i32 = 15;

impl Grid {
    /// With its anchor at the mesh's origin.
    pub(super) fn new(posed: impl Posed, mesh: &Mesh<'_>) -> Self {
        let scale = mesh.tables().scale;
        // Exact, so that only the product of both scales matters. Halved, so that it fits.
        let product = u64::from(posed.pose().scale.to_bits()) * u64::from(scale.mantissa());
        let length = (product >> 1) as i64;
        let exponent = scale.exponent() - 15 - mesh.spare_bits().cast_signed() + posed.exponent();
        let quantum = Float::new(length, exponent);
        Self { length, exponent, quantum, anchor: [0; 3], reach_bits: 15 }
    }

    /// The least distance from the eye of a vertex, or 4 times the half width of the mesh's box:
    /// the larger of both, in world units. Call it once the anchor is near the eye.
    pub(super) fn distance(&self, axes: [&Axis; 3], posed: impl Posed, mesh: &Mesh<'_>) -> Float {
        let mut reach = self.quantum;
        reach.exponent += 15 + 2;
        let way = axes.map(|axis| axis.way.wrapping_abs());
        let way = Float::new(way[0].max(way[1]).max(way[2]), -FRACTION_BITS);
        let distance = if way.exponent > reach.exponent { way } else { reach };
        posed.least_distance(distance, self, axes, mesh)
    }

    /// Moves the anchor to the point nearest to the eye within the mesh's bounds. Returns whether
    /// the mesh measures less than 2^17 world units: only then the result is valid.
    #[inline(never)]
    pub(super) fn move_anchor(
        &mut self,
        axes: [&mut Axis; 3],
        posed: impl Posed,
        mesh: &Mesh<'_>,
    ) -> bool {
        if self.quantum.magnitude() > 1 {
            return false;
        }
        if self.length == 0 {
            // All of it is at one point.
            return true;
        }
        let quantum = shifted(self.length, self.exponent + FRACTION_BITS + QUANTUM_BITS);
        let (upper, lower) = (quantum >> QUANTUM_BITS, quantum & ((1 << QUANTUM_BITS) - 1));
        let mut anchor = [0; 3];
        for (column, anchor) in anchor.iter_mut().enumerate() {
            keep_rolled();
            // The way to the eye along an axis of the object.
            let to_eye = posed.way_to_eye([&*axes[0], &*axes[1], &*axes[2]], column);
            let quanta = to_eye.over(self.quantum).in_units_of(0);
            let [min, max] = [mesh.bounds().min, mesh.bounds().max]
                .map(|c| i32::from(c[column]) << mesh.spare_bits());
            // Not by `clamp`, which panics if the ends are exchanged.
            *anchor = quanta.max(min).min(max);
        }
        for axis in axes {
            for (column, &quanta) in anchor.iter().enumerate() {
                keep_rolled();
                let quanta = i64::from(quanta);
                axis.advance(column, upper * quanta + ((lower * quanta) >> QUANTUM_BITS));
            }
        }
        self.anchor = anchor;
        self.reach_bits = 16;
        true
    }
}
