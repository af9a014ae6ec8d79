//! Bounding volumes, in quanta of the position table.

/// What holds all vertices of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Bounds {
    /// The smallest box along the axes.
    pub cuboid: BoundingBox,
    /// A sphere round the middle of that box.
    pub sphere: BoundingSphere,
}

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BoundingBox {
    /// Its smallest x, y and z.
    pub min: [i16; 3],
    /// Its largest x, y and z.
    pub max: [i16; 3],
}

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BoundingSphere {
    /// Its centre.
    pub center: [i16; 3],
    /// Its radius, rounded up: at most 65,535 * sqrt(3) / 2 + 1, which fits.
    pub radius: u16,
}

impl Bounds {
    /// Measures a table of positions; an empty one has bounds of zero size at the origin.
    #[must_use]
    pub const fn of(positions: &[[i16; 3]]) -> Self {
        let cuboid = BoundingBox::of(positions);
        Self { cuboid, sphere: BoundingSphere::round(&cuboid, positions) }
    }
}

impl BoundingBox {
    const fn of(positions: &[[i16; 3]]) -> Self {
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

    /// The eight corners.
    #[must_use]
    pub fn corners(&self) -> [[i16; 3]; 8] {
        core::array::from_fn(|corner| {
            core::array::from_fn(|axis| {
                if corner >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
            })
        })
    }
}

impl BoundingSphere {
    const fn round(cuboid: &BoundingBox, positions: &[[i16; 3]]) -> Self {
        let center = [
            middle(cuboid.min[0], cuboid.max[0]),
            middle(cuboid.min[1], cuboid.max[1]),
            middle(cuboid.min[2], cuboid.max[2]),
        ];
        let mut farthest: u64 = 0;
        let mut vertex = 0;
        while vertex < positions.len() {
            let p = positions[vertex];
            let distance =
                square(p[0], center[0]) + square(p[1], center[1]) + square(p[2], center[2]);
            if distance > farthest {
                farthest = distance;
            }
            vertex += 1;
        }
        let root = farthest.isqrt();
        let radius = if root * root == farthest { root } else { root + 1 };
        Self { center, radius: radius as u16 }
    }
}

const fn middle(a: i16, b: i16) -> i16 {
    ((a as i32 + b as i32) / 2) as i16
}

const fn square(a: i16, b: i16) -> u64 {
    let d = a as i64 - b as i64;
    (d * d) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn largest_extent_fits() {
        let corners = [[i16::MIN; 3], [i16::MAX; 3]];
        let bounds = Bounds::of(&corners);
        assert_eq!(bounds.cuboid.min, [i16::MIN; 3]);
        assert_eq!(bounds.cuboid.max, [i16::MAX; 3]);
        // sqrt(3) * 32,768 = 56,755.8
        assert_eq!(bounds.sphere.radius, 56_756);
    }

    #[test]
    fn sphere_holds_every_vertex() {
        let positions = [[0, 0, 0], [10, 0, 0], [0, 7, 0], [3, 3, -9]];
        let sphere = Bounds::of(&positions).sphere;
        for p in positions {
            let d: u64 = (0..3).map(|i| square(p[i], sphere.center[i])).sum();
            assert!(d <= u64::from(sphere.radius).pow(2), "vertex {p:?} is outside");
        }
    }

    #[test]
    fn corners_are_all_different() {
        let corners = Bounds::of(&[[-1, -2, -3], [1, 2, 3]]).cuboid.corners();
        for (i, a) in corners.iter().enumerate() {
            assert!(corners[..i].iter().all(|b| a != b), "corner {i} repeats");
        }
    }
}
