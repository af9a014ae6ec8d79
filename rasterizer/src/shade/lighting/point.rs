//! A point of the world as a mesh's vertices see it.

use crate::{
    geometry::ObjectView,
    numbers::{Direction, Float, Vec3},
};

/// A point in object space, in steps that are fine enough for points between the vertices, and
/// coarse enough for any distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::shade) struct Point {
    /// Each below 2^28 in magnitude.
    at: [i32; 3],
    /// From a position of 16 bits to steps: shifted up, then down. One of them is 0.
    up: u32,
    down: u32,
    /// By how many bits a mesh's positions are shifted up to have 16.
    spare_bits: u32,
}

/// The finest step, as a power of two of the unit of a position of 16 bits.
const FINEST: i32 = -12;

/// The bits of a point's coordinates.
const BITS: i32 = 28;

impl Point {
    /// At the mesh's origin.
    pub(in crate::shade) const ORIGIN: Self = Self { at: [0; 3], up: 0, down: 0, spare_bits: 0 };

    /// A point of the world, and the exponent of its step in units of a position of 16 bits. It is
    /// within 2^-12 of that unit, or 2^-27 of its distance.
    // codegen: not inlined: its temporaries leave the stack.
    #[inline(never)]
    pub(in crate::shade) fn of(world: Vec3, view: &ObjectView<'_>) -> (Self, i32) {
        let (pose, mesh) = (view.pose(), view.mesh());
        let offset = mesh.tables().offset.to_bits();
        let per_unit = units_per_length(view);
        let per_scale = reciprocal(Float::from_unsigned(pose.scale));
        let [w, t] = [world, pose.translation].map(|v| v.to_bits().map(i64::from));
        let rows = pose.rotation.to_bits();
        let mut way = [Float::ZERO; 3];
        for (column, way) in way.iter_mut().enumerate() {
            let mut along = 0;
            for (row, (w, t)) in rows.iter().zip(w.iter().zip(&t)) {
                // The product of a column of length one and a vector below 2^33.
                let entry = row.get(column).copied().unwrap_or_default();
                along += i64::from(entry) * (w - t);
            }
            // From the pose's origin, in model units; then from the mesh's.
            let offset = Float::new(-i64::from(offset[column]), -16);
            *way = Float::new(along, -46).times(per_scale).plus(offset).times(per_unit);
        }
        let exponent = way.iter().fold(FINEST, |most, c| most.max(c.magnitude() - BITS));
        let point = Self {
            at: way.map(|c| c.in_units_of(exponent)),
            up: (-exponent).max(0).unsigned_abs(),
            down: exponent.clamp(0, 31).unsigned_abs(),
            spare_bits: mesh.spare_bits(),
        };
        (point, exponent)
    }

    /// A point so far away that it is in the same direction from everywhere: that of a vector of
    /// length one in object space, in Q30.
    pub(in crate::shade) fn toward(direction: [i32; 3], view: &ObjectView<'_>) -> Self {
        Self {
            at: direction.map(|c| c >> (30 - BITS)),
            up: 0,
            down: 31,
            spare_bits: view.mesh().spare_bits(),
        }
    }

    /// The direction to it from a position of 16 bits.
    #[inline(always)]
    pub(in crate::shade) fn from(&self, position: [i32; 3]) -> Direction {
        let way = |axis: usize| self.at[axis] - ((position[axis] << self.up) >> self.down);
        Direction::of([way(0), way(1), way(2)])
    }

    /// The position of a vertex, in 16 bits.
    #[inline(always)]
    pub(in crate::shade) fn normalised(&self, position: [i16; 3]) -> [i32; 3] {
        position.map(|c| i32::from(c) << self.spare_bits)
    }
}

/// Units of a position of 16 bits in a model unit.
fn units_per_length(view: &ObjectView<'_>) -> Float {
    let mesh = view.mesh();
    let scale = mesh.tables().scale;
    let quantum = Float::new(i64::from(scale.mantissa()), scale.exponent());
    let mut per_unit = quantum.reciprocal();
    per_unit.exponent += mesh.spare_bits().cast_signed();
    per_unit
}

/// A length of the world in units of a position of 16 bits.
pub(in crate::shade) fn length(world: Float, view: &ObjectView<'_>) -> Float {
    let per_scale = reciprocal(Float::from_unsigned(view.pose().scale));
    world.times(per_scale).times(units_per_length(view))
}

/// The reciprocal; 0 for 0, so that an object without size has all at its origin.
fn reciprocal(value: Float) -> Float {
    if value == Float::ZERO { value } else { value.reciprocal() }
}
