//! Shapes that are round about the y axis: sectors from the front (z = 1) to the right.

use super::{Builder, ONE, Solid};
use crate::numbers::{Scalar, Turn, mul_q30, unit};

/// The sine and the cosine of a part of a turn, in Q30.
const fn sine_cosine(part: usize, of: usize) -> [i32; 2] {
    let angle = Turn::fraction(part as u32, of as u32);
    [angle.sin().to_bits(), angle.cos().to_bits()]
}

/// What `solid` of each shape has in common.
macro_rules! tables {
    ($self:ident) => {
        Builder::new($self.vertices(), $self.triangles())
    };
}

/// A sphere of radius 1 in sectors of longitude and rings of latitude, as on a globe: for textures.
///
/// Its triangles are those of the rings from the north pole to the south pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct UvSphere {
    sectors: usize,
    rings: usize,
}

impl UvSphere {
    /// Of sectors and rings: twice as many sectors as rings make cells that are square at the
    /// equator.
    ///
    /// # Panics
    ///
    /// Panics if there are less than three sectors or two rings. In a constant that is a compile
    /// error.
    #[must_use]
    pub const fn new(sectors: usize, rings: usize) -> Self {
        assert!(sectors >= 3 && rings >= 2, "a sphere has three sectors and two rings at least");
        Self { sectors, rings }
    }

    /// How many vertices it has.
    #[must_use]
    pub const fn vertices(self) -> usize {
        (self.sectors + 1) * (self.rings - 1) + 2 * self.sectors
    }

    /// How many triangles it has.
    #[must_use]
    pub const fn triangles(self) -> usize {
        2 * self.sectors * (self.rings - 1)
    }

    /// Its tables.
    ///
    /// # Panics
    ///
    /// Panics if `V` and `T` are other numbers than [`vertices`](Self::vertices) and
    /// [`triangles`](Self::triangles). In a constant that is a compile error.
    #[must_use]
    pub const fn solid<const V: usize, const T: usize>(self) -> Solid<V, T> {
        let Self { sectors, rings } = self;
        let mut builder = tables!(self);
        // A pole for each sector, with the texture's column in the middle of it.
        let mut sector = 0;
        while sector < sectors {
            builder.vertex([0, ONE, 0], [0, ONE, 0], [[2 * sector + 1, 2 * sectors], [0, 1]]);
            sector += 1;
        }
        let mut vertex = 0;
        while vertex < (sectors + 1) * (rings - 1) {
            let (sector, ring) = (vertex % (sectors + 1), vertex / (sectors + 1) + 1);
            let [across, up] = sine_cosine(ring, 2 * rings);
            let [right, front] = sine_cosine(sector, sectors);
            let place = [mul_q30(across, right), up, mul_q30(across, front)];
            builder.vertex(place, place, [[sector, sectors], [ring, rings]]);
            vertex += 1;
        }
        let mut sector = 0;
        while sector < sectors {
            builder.vertex([0, -ONE, 0], [0, -ONE, 0], [[2 * sector + 1, 2 * sectors], [1, 1]]);
            builder.triangle([sector, sectors + sector, sectors + sector + 1]);
            sector += 1;
        }
        builder.field(sectors, sectors, rings - 2);
        let (last, pole) = (V - sectors - sectors - 1, V - sectors);
        let mut sector = 0;
        while sector < sectors {
            builder.triangle([last + sector, pole + sector, last + sector + 1]);
            sector += 1;
        }
        builder.finish()
    }
}

/// A ring about the y axis: a circular tube whose outermost circle has the radius 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Torus {
    sectors: usize,
    rings: usize,
    tube: Scalar,
}

impl Torus {
    /// Of sectors about the axis, and rings about a tube of this radius.
    ///
    /// # Panics
    ///
    /// Panics if there are less than three of either, or unless the radius is over 0 and at most a
    /// half. In a constant that is a compile error.
    #[must_use]
    pub const fn new(sectors: usize, rings: usize, tube: Scalar) -> Self {
        assert!(sectors >= 3 && rings >= 3, "a torus has three sectors and three rings at least");
        assert!(
            0 < tube.to_bits() && tube.to_bits() <= 1 << 15,
            "the radius of a tube is over 0 and at most 0.5"
        );
        Self { sectors, rings, tube }
    }

    /// How many vertices it has.
    #[must_use]
    pub const fn vertices(self) -> usize {
        (self.sectors + 1) * (self.rings + 1)
    }

    /// How many triangles it has.
    #[must_use]
    pub const fn triangles(self) -> usize {
        2 * self.sectors * self.rings
    }

    /// Its tables.
    ///
    /// # Panics
    ///
    /// Panics if `V` and `T` are other numbers than [`vertices`](Self::vertices) and
    /// [`triangles`](Self::triangles). In a constant that is a compile error.
    #[must_use]
    pub const fn solid<const V: usize, const T: usize>(self) -> Solid<V, T> {
        let Self { sectors, rings, .. } = self;
        let tube = self.tube.to_bits() << 14;
        let mut builder = tables!(self);
        let mut vertex = 0;
        while vertex < V {
            let (sector, ring) = (vertex % (sectors + 1), vertex / (sectors + 1));
            // From the top outwards.
            let [out, up] = sine_cosine(ring, rings);
            let [right, front] = sine_cosine(sector, sectors);
            let radius = ONE - tube + mul_q30(tube, out);
            builder.vertex(
                [mul_q30(radius, right), mul_q30(tube, up), mul_q30(radius, front)],
                [mul_q30(out, right), up, mul_q30(out, front)],
                [[sector, sectors], [ring, rings]],
            );
            vertex += 1;
        }
        builder.field(0, sectors, rings);
        builder.finish()
    }
}

/// A cylinder of radius 1 from y = -1 to 1, with both ends.
///
/// Its triangles are those of the side, two for each sector, of the upper end and of the lower end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cylinder {
    sectors: usize,
}

impl Cylinder {
    /// Of sectors about the axis.
    ///
    /// # Panics
    ///
    /// Panics if there are less than three. In a constant that is a compile error.
    #[must_use]
    pub const fn new(sectors: usize) -> Self {
        assert!(sectors >= 3, "a cylinder has three sectors at least");
        Self { sectors }
    }

    /// How many vertices it has.
    #[must_use]
    pub const fn vertices(self) -> usize {
        4 * self.sectors + 4
    }

    /// How many triangles it has.
    #[must_use]
    pub const fn triangles(self) -> usize {
        4 * self.sectors
    }

    /// Its tables.
    ///
    /// # Panics
    ///
    /// Panics if `V` and `T` are other numbers than [`vertices`](Self::vertices) and
    /// [`triangles`](Self::triangles). In a constant that is a compile error.
    #[must_use]
    pub const fn solid<const V: usize, const T: usize>(self) -> Solid<V, T> {
        let sectors = self.sectors;
        let mut builder = tables!(self);
        let mut vertex = 0;
        while vertex < 2 * (sectors + 1) {
            let (sector, row) = (vertex % (sectors + 1), vertex / (sectors + 1));
            let [x, z] = sine_cosine(sector, sectors);
            let y = if row == 0 { ONE } else { -ONE };
            builder.vertex([x, y, z], [x, 0, z], [[sector, sectors], [row, 1]]);
            vertex += 1;
        }
        builder.field(0, sectors, 1);
        disc(&mut builder, sectors, 1);
        disc(&mut builder, sectors, -1);
        builder.finish()
    }
}

/// A cone about the y axis, with the radius 1 at y = -1, its point at y = 1, and its base.
///
/// Its triangles are those of the side and of the base, one each for each sector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cone {
    sectors: usize,
}

impl Cone {
    /// Of sectors about the axis.
    ///
    /// # Panics
    ///
    /// Panics if there are less than three. In a constant that is a compile error.
    #[must_use]
    pub const fn new(sectors: usize) -> Self {
        assert!(sectors >= 3, "a cone has three sectors at least");
        Self { sectors }
    }

    /// How many vertices it has.
    #[must_use]
    pub const fn vertices(self) -> usize {
        3 * self.sectors + 2
    }

    /// How many triangles it has.
    #[must_use]
    pub const fn triangles(self) -> usize {
        2 * self.sectors
    }

    /// Its tables.
    ///
    /// # Panics
    ///
    /// Panics if `V` and `T` are other numbers than [`vertices`](Self::vertices) and
    /// [`triangles`](Self::triangles). In a constant that is a compile error.
    #[must_use]
    pub const fn solid<const V: usize, const T: usize>(self) -> Solid<V, T> {
        let sectors = self.sectors;
        let mut builder = tables!(self);
        let mut sector = 0;
        // A point for each sector, with the normal of its middle.
        while sector < sectors {
            let normal = slope(sine_cosine(2 * sector + 1, 2 * sectors));
            builder.vertex([0, ONE, 0], normal, [[2 * sector + 1, 2 * sectors], [0, 1]]);
            sector += 1;
        }
        let mut sector = 0;
        while sector <= sectors {
            let [x, z] = sine_cosine(sector, sectors);
            builder.vertex([x, -ONE, z], slope([x, z]), [[sector, sectors], [1, 1]]);
            sector += 1;
        }
        let mut sector = 0;
        while sector < sectors {
            builder.triangle([sector, sectors + sector, sectors + sector + 1]);
            sector += 1;
        }
        disc(&mut builder, sectors, -1);
        builder.finish()
    }
}

/// The normal of a cone as high as it is wide, in a direction.
const fn slope([x, z]: [i32; 2]) -> [i32; 3] {
    match unit([2 * x as i64, ONE as i64, 2 * z as i64]) {
        Some(normal) => normal,
        None => [0, ONE, 0],
    }
}

/// Adds an end: above for a `side` of 1, below for -1. The texture's circle is on it.
const fn disc<const V: usize, const T: usize>(
    builder: &mut Builder<V, T>,
    sectors: usize,
    side: i32,
) {
    let (middle, normal) = (builder.vertices, [0, side * ONE, 0]);
    builder.vertex(normal, normal, [[1, 2], [1, 2]]);
    let mut sector = 0;
    while sector < sectors {
        let [x, z] = sine_cosine(sector, sectors);
        let part = [
            [(x as i64 + ONE as i64) as usize, 2 << 30],
            [((side * z) as i64 + ONE as i64) as usize, 2 << 30],
        ];
        builder.vertex([x, side * ONE, z], normal, part);
        sector += 1;
    }
    let mut sector = 0;
    while sector < sectors {
        let (from, to) = (middle + 1 + sector, middle + 1 + (sector + 1) % sectors);
        builder.triangle(if side > 0 { [middle, from, to] } else { [middle, to, from] });
        sector += 1;
    }
}
