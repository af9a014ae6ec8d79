//! Which texels a place is on.

use super::{Place, Side, Wrap};

/// Texels on both sides of a place in both directions, between whose centres it lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quad {
    /// Their numbers: two side by side, and the two below them.
    pub texels: [usize; 4],
    /// The way from the first to the right and downwards, as
    /// [`Mix::mixed`](super::Mix::mixed) takes it.
    pub fractions: [u32; 2],
}

/// The texels of a texture or of one of its mip levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// The number of its top left texel.
    pub first: u32,
    /// The texels of a row.
    pub width: Side,
    /// The number of rows.
    pub height: Side,
}

impl Grid {
    /// Of a texture of this width and height.
    #[must_use]
    pub const fn new(width: usize, height: usize) -> Self {
        Self { first: 0, width: Side::new(width), height: Side::new(height) }
    }

    #[inline(always)]
    const fn number(self, column: usize, row: usize) -> usize {
        self.first as usize + row * self.width.length() + column
    }

    /// Returns the texel that covers the coordinates u and v in Q8.24 repeats.
    #[inline(always)]
    #[must_use]
    pub fn nearest<X: Wrap, Y: Wrap>(self, [u, v]: [i32; 2]) -> usize {
        self.number(X::texel(u, self.width), Y::texel(v, self.height))
    }

    /// Returns the texels round the coordinates u and v in Q8.24 repeats, with fractions of `bits`
    /// binary digits, 1 to 8, rounded to the nearest.
    #[inline(always)]
    #[must_use]
    pub fn bilinear<X: Wrap, Y: Wrap>(self, [u, v]: [i32; 2], bits: u32) -> Quad {
        let across = X::pair(u, self.width, bits);
        let down = Y::pair(v, self.height, bits);
        self.quad(across.texels, down.texels, [across.fraction, down.fraction])
    }

    /// The same for sides that are repeated, from the fractions of v, in the upper half, and of u
    /// in Q0.16.
    ///
    /// Half a texel is taken off both in one subtraction, where what u borrows moves v by
    /// 2<sup>-16</sup> of a repeat.
    // codegen: the halves' bits are then taken by one instruction each.
    #[inline(always)]
    fn bilinear_packed(self, vu: u32, bits: u32) -> Quad {
        let [u_bits, v_bits] = [self.width.bits(), self.height.bits()];
        // Half a texel back, and half a unit of the fraction on.
        let [u_back, v_back] = [half_texel(u_bits, bits), half_texel(v_bits, bits)];
        let moved = vu.wrapping_sub(v_back << 16 | u_back);
        let texel = |number: u32, side: Side| number as usize & (side.length() - 1);
        let [column, row] = [(moved & 0xFFFF) >> (16 - u_bits), moved >> 16 >> (16 - v_bits)];
        let fraction = |texels: u32, side: u32| (texels >> (16 - side - bits)) & ((1 << bits) - 1);
        self.quad(
            [column, column + 1].map(|column| texel(column, self.width)),
            [row, row + 1].map(|row| texel(row, self.height)),
            [fraction(moved, u_bits), fraction(moved >> 16, v_bits)],
        )
    }

    #[inline(always)]
    const fn quad(
        self,
        [left, right]: [usize; 2],
        [upper, lower]: [usize; 2],
        fractions: [u32; 2],
    ) -> Quad {
        Quad {
            texels: [
                self.number(left, upper),
                self.number(right, upper),
                self.number(left, lower),
                self.number(right, lower),
            ],
            fractions,
        }
    }
}

/// Half a texel less half a unit of a fraction of `bits` binary digits, in Q0.16 repeats.
const fn half_texel(side: u32, bits: u32) -> u32 {
    let texel = 1 << (16 - side);
    texel / 2 - (texel >> (bits + 1))
}

impl<const W: usize, const H: usize, X: Wrap, Y: Wrap> Place<W, H, X, Y> {
    const GRID: Grid = Grid::new(W, H);

    /// Returns the number of the texel that covers it.
    #[inline(always)]
    #[must_use]
    pub fn nearest(self) -> usize {
        Self::GRID.nearest::<X, Y>(self.uv())
    }

    /// Returns the four texels between whose centres it lies, with fractions of `bits` binary
    /// digits, 1 to 8.
    #[inline(always)]
    #[must_use]
    pub fn bilinear(self, bits: u32) -> Quad {
        if Self::IS_PACKED {
            Self::GRID.bilinear_packed(self.packed(), bits)
        } else {
            Self::GRID.bilinear::<X, Y>(self.uv(), bits)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        random::Random,
        texture::{Clamp, Mirror, Repeat},
    };

    #[test]
    fn texels_are_numbered_along_rows_from_the_top() {
        let at = |u: f64, v: f64| {
            let [u, v] = [u, v].map(|c| (c * f64::from(1 << 24)).floor() as i32);
            Place::<4, 3, Repeat, Clamp>::new([u, v])
        };
        assert_eq!(at(0.0, 0.0).nearest(), 0);
        assert_eq!(at(0.999, 0.0).nearest(), 3);
        assert_eq!(at(1.0, 0.34).nearest(), 4);
        assert_eq!(at(-0.01, 1.5).nearest(), 11);
        // Round the corner that the last column, the first, and two rows share.
        let quad = at(0.0, 2.0 / 3.0).bilinear(4);
        assert_eq!(quad, Quad { texels: [7, 4, 11, 8], fractions: [8, 8] });
    }

    /// A packed place gives the texel of a wide one: up to 256 texels, 16 bits tell all borders.
    #[test]
    fn packed_places_are_like_wide_ones() {
        fn check<const W: usize, const H: usize>(u: i32, v: i32) {
            let packed = Place::<W, H, Repeat, Repeat>::new([u, v]);
            let wide = Grid::new(W, H);
            assert_eq!(packed.nearest(), wide.nearest::<Repeat, Repeat>([u, v]));
            // What packing cuts off, and what u borrows from v, are a unit of 16 bits each.
            let [u, v] = [u, v].map(|c| c & !0xFF);
            let pairs =
                [v, v.wrapping_sub(1 << 8)].map(|v| wide.bilinear::<Repeat, Repeat>([u, v], 4));
            assert!(pairs.contains(&packed.bilinear(4)), "{u} {v}");
            assert!(packed.uv().iter().all(|c| (0..1 << 24).contains(c)));
        }
        let mut random = Random::new(5);
        for _ in 0..100_000 {
            let bits = random.bits();
            let [u, v] = [bits as i32 >> 1, (bits >> 32) as i32 >> 1];
            check::<256, 256>(u, v);
            check::<1, 256>(u, v);
            check::<128, 8>(u, v);
        }
    }

    #[test]
    fn other_places_are_wide() {
        let place = Place::<512, 8, Repeat, Repeat>::new([5 << 22, -1 << 23]);
        assert_eq!(place.uv(), [5 << 22, -1 << 23]);
        assert_eq!(place.nearest(), 4 * 512 + 128);
        assert_eq!(Place::<8, 8, Mirror, Repeat>::new([-1, 1 << 24]).uv(), [-1, 1 << 24]);
    }

    #[test]
    fn a_single_texel_is_everywhere() {
        fn check<X: Wrap, Y: Wrap>() {
            for c in [i32::MIN, -(1 << 30), -1, 0, 1, (1 << 23) - 1, 1 << 23, 1 << 30, i32::MAX] {
                let place = Place::<1, 1, X, Y>::new([c, -(c >> 1)]);
                assert_eq!(place.nearest(), 0);
                assert_eq!(place.bilinear(8).texels, [0; 4]);
            }
        }
        check::<Repeat, Repeat>();
        check::<Mirror, Clamp>();
        check::<Clamp, Mirror>();
    }
}
