//! The bounding box of a mesh, in quanta of its positions.

/// The smallest box along the axes that holds all vertices of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BoundingBox {
    /// Its smallest x, y and z.
    pub min: [i16; 3],
    /// Its largest x, y and z.
    pub max: [i16; 3],
}

impl BoundingBox {
    /// Measures a table of positions. The box of an empty one has no size and is at the origin.
    #[must_use]
    pub const fn of(positions: &[[i16; 3]]) -> Self {
        if positions.is_empty() {
            return Self { min: [0; 3], max: [0; 3] };
        }
        let mut min = positions[0];
        let mut max = positions[0];
        let mut vertex = 1;
        while vertex < positions.len() {
            let mut axis = 0;
            while axis < 3 {
                let p = positions[vertex][axis];
                if p < min[axis] {
                    min[axis] = p;
                }
                if p > max[axis] {
                    max[axis] = p;
                }
                axis += 1;
            }
            vertex += 1;
        }
        Self { min, max }
    }

    /// The smallest box that holds this one and another.
    pub(super) const fn union(&self, other: &Self) -> Self {
        let corners = [self.min, self.max, other.min, other.max];
        Self::of(&corners)
    }

    /// By how many bits all coordinates in the box can be shifted up and still fit 16.
    pub(super) const fn spare_bits(&self) -> u32 {
        let (mut bits, mut axis) = (0, 0);
        while axis < 3 {
            // A negative number -n fits where n - 1 does.
            bits |= self.min[axis] ^ (self.min[axis] >> 15);
            bits |= self.max[axis] ^ (self.max[axis] >> 15);
            axis += 1;
        }
        bits.leading_zeros() - 1
    }

    /// Corner `index` of the eight: bits 0, 1 and 2 are its sides in x, y and z.
    #[must_use]
    pub fn corner(&self, index: usize) -> [i16; 3] {
        core::array::from_fn(
            |axis| {
                if index >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn box_is_the_smallest() {
        let positions = [[0, 0, 0], [10, 0, 0], [0, 7, 0], [3, 3, -9]];
        assert_eq!(BoundingBox::of(&positions), BoundingBox { min: [0, 0, -9], max: [10, 7, 0] });
        let extremes = [[i16::MIN; 3], [i16::MAX; 3]];
        let [min, max] = extremes;
        assert_eq!(BoundingBox::of(&extremes), BoundingBox { min, max });
    }

    #[test]
    fn corners_are_all_different() {
        let cuboid = BoundingBox::of(&[[-1, -2, -3], [1, 2, 3]]);
        let corners: [_; 8] = core::array::from_fn(|index| cuboid.corner(index));
        for (i, a) in corners.iter().enumerate() {
            assert!(corners[..i].iter().all(|b| a != b), "corner {i} repeats");
        }
    }
}
