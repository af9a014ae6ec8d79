//! How many texels a pixel covers, which tells the mip level.
//!
//! With q = near / w, the products u q and v q, and q are linear on the screen. So the Jacobian
//! determinant of (u, v) by (x, y), the area of texture that a pixel covers, is exactly
//!
//! ```text
//! J = q_a q_b q_c A_uv / (A q^3)
//! ```
//!
//! where A is a triangle's area on the screen, `A_uv` its area on the texture, and `q_a`, `q_b` and
//! `q_c` belong to its corners. The level is log2 of the side of a square of that area, in texels:
//! log2(J W H) / 2. It is the mean of the levels along both axes of the pixel's footprint, which is
//! an ellipse. (A level by the longer axis, as graphics libraries choose it, is higher by half of
//! log2 of the ratio of both axes: less aliasing, but more blur, on slanted surfaces.)
//!
//! Where log2 q is the mean of that at the corners, their q cancel: there the level is that of an
//! affine mapping, log2(`A_uv` W H / A) / 2. This is the level of a whole triangle. At other pixels
//! it is off by 3/2 of log2 q less that mean, so by at most log2 r, where r is the ratio of the
//! corners' largest q to the least; by 1/4 level for r = 1.19.

use super::{Grid, Levels};
use crate::{attribute::InverseW, numbers::normalised};

/// The digits of logarithms behind the point.
const BITS: u32 = 16;

/// log2 of a number in Q16, within 1/130. 0 counts as 1.
///
/// Of the mantissa 1 + f it takes f + c f (1 - f), which is exact at both ends; c = 0.3465 has the
/// least error.
#[inline(always)]
const fn log2(value: u32) -> i32 {
    let (mantissa, zeros) = normalised(if value == 0 { 1 } else { value });
    let fraction = (mantissa << 1) >> 16;
    let bend = (fraction * ((1 << 16) - fraction)) >> 16;
    (((31 - zeros) << BITS) + fraction + ((bend * 22_710) >> 16)) as i32
}

/// log2 of a wide number in Q16, within 1/130. 0 counts as 1.
#[inline(always)]
const fn log2_wide(value: u64) -> i32 {
    // The upper 16 bits of a mantissa are enough.
    let (upper, middle) = ((value >> 32) as u32, (value >> 16) as u32);
    if upper >> 16 != 0 {
        log2(upper) + (32 << BITS)
    } else if upper != 0 {
        log2(middle) + (16 << BITS)
    } else {
        log2(value as u32)
    }
}

/// A mip level in Q16: 0 is the texture itself, 1 its half. Below 0 it is magnified.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct MipLevel(i32);

impl MipLevel {
    /// From Q16.
    #[must_use]
    pub const fn from_bits(bits: i32) -> Self {
        Self(bits)
    }

    /// In Q16.
    #[must_use]
    pub const fn to_bits(self) -> i32 {
        self.0
    }

    /// The nearest level that there is.
    #[inline(always)]
    pub(super) fn nearest(self, levels: &Levels) -> u32 {
        ((self.0.max(0) as u32 + (1 << (BITS - 1))) >> BITS).min(levels.last())
    }

    /// The level at or below it, and how far it is to the next one in units of 2<sup>-bits</sup>,
    /// rounded to the nearest.
    #[inline(always)]
    pub(super) fn split(self, levels: &Levels, bits: u32) -> (u32, u32) {
        let most = levels.last() << BITS;
        let rounded = (self.0.max(0) as u32).min(most) + (1 << (BITS - 1 - bits));
        (rounded >> BITS, (rounded >> (BITS - bits)) & ((1 << bits) - 1))
    }
}

/// The size of a triangle on its texture beside that on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Footprint {
    /// log2 of square repeats a square pixel, in Q16.
    area_ratio: i32,
    /// The sum of log2 of the corners' near / w in 2<sup>-32</sup>, in Q16.
    corners: i32,
}

impl Footprint {
    /// Of a triangle by u and v of its corners in Q8.24 repeats and their near / w, and by the
    /// doubled area on the screen in square sub-pixels, with the binary digits of a sub-pixel: as
    /// [`Gradients::doubled_area`](crate::raster::Gradients::doubled_area) and
    /// [`subpixel_bits`](crate::raster::Gradients::subpixel_bits) are.
    ///
    /// A triangle without area on the texture is magnified.
    #[must_use]
    pub const fn new(
        [a, b, c]: [[i32; 2]; 3],
        [qa, qb, qc]: [InverseW; 3],
        doubled_area: i64,
        subpixel_bits: u32,
    ) -> Self {
        // Differences of up to 128 repeats in Q23: the products of 31 bits, and their difference,
        // fit 64.
        let [u1, v1, u2, v2] = [
            difference(a[0], b[0]),
            difference(a[1], b[1]),
            difference(a[0], c[0]),
            difference(a[1], c[1]),
        ];
        let texture = (u1 as i64 * v2 as i64 - u2 as i64 * v1 as i64).unsigned_abs();
        let texture = log2_wide(texture) - ((2 * 23) << BITS);
        let screen = log2_wide(doubled_area.unsigned_abs()) - ((2 * subpixel_bits) << BITS) as i32;
        let corners = log2(qa.to_bits()) + log2(qb.to_bits()) + log2(qc.to_bits());
        Self { area_ratio: texture - screen, corners }
    }

    /// Returns the level of the triangle: that in its middle, by the mean of log2 of its corners'
    /// near / w. It is within 1/64 level of the definition, plus log2 r for pixels elsewhere; see
    /// the module.
    #[must_use]
    pub const fn level(self, texture: Grid) -> MipLevel {
        MipLevel((self.area_ratio + texels(texture)) >> 1)
    }

    /// Returns what [`Slope::level`] computes the level of a pixel from.
    #[must_use]
    pub const fn slope(self, texture: Grid) -> Slope {
        Slope(self.area_ratio + texels(texture) + self.corners)
    }
}

/// The levels of a triangle's pixels, as they depend on near / w.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slope(i32);

impl Slope {
    /// Returns the level of a pixel by its near / w. It is within 1/30 level of the definition.
    #[inline(always)]
    #[must_use]
    pub const fn level(self, inverse_w: InverseW) -> MipLevel {
        MipLevel((self.0 - 3 * log2(inverse_w.to_bits())) >> 1)
    }
}

/// b - a in Q23.
const fn difference(a: i32, b: i32) -> i32 {
    (b >> 1) - (a >> 1)
}

/// log2 of the number of texels in Q16.
const fn texels(grid: Grid) -> i32 {
    log2((grid.width.length() * grid.height.length()) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn logarithms_are_within_their_bound() {
        let mut random = Random::new(11);
        let exact = |value: u64| (value as f64).log2() * 65_536.0;
        let powers = (0..64).flat_map(|bit| [1u64 << bit, (1 << bit) | (1 << bit >> 1)]);
        for value in powers.chain((0..200_000).map(|i| random.bits() >> (i % 64))) {
            let value = value.max(1);
            let bound = 65_536.0 / 130.0 + 4.0;
            assert!((f64::from(log2_wide(value)) - exact(value)).abs() <= bound, "{value}");
            let value = value as u32;
            let off = f64::from(log2(value)) - exact(value.max(1).into());
            assert!(off.abs() <= bound, "{value}");
        }
        assert_eq!((log2(1), log2(1 << 31), log2_wide(1 << 63)), (0, 31 << 16, 63 << 16));
    }

    /// A triangle in space on a plane, seen through a lens: everything in floating point.
    struct Case {
        /// On the screen, in pixels, and near / w.
        corners: [[f64; 3]; 3],
        /// In repeats.
        coordinates: [[f64; 2]; 3],
    }

    impl Case {
        fn area(&self) -> f64 {
            let [[ax, ay, _], [bx, by, _], [cx, cy, _]] = self.corners;
            (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        }

        /// near / w, u and v at a place on the screen, by the definition of interpolation.
        fn at(&self, x: f64, y: f64) -> [f64; 3] {
            let [a, b, c] = self.corners;
            let wb = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / self.area();
            let wc = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / self.area();
            let weights = [1.0 - wb - wc, wb, wc];
            let sum = |value: &dyn Fn(usize) -> f64| -> f64 {
                (0..3).map(|i| weights[i] * value(i)).sum()
            };
            let q = sum(&|i| self.corners[i][2]);
            let coordinate =
                |axis: usize| sum(&|i| self.corners[i][2] * self.coordinates[i][axis]) / q;
            [q, coordinate(0), coordinate(1)]
        }

        /// The changes by x and y of what has these values at the corners and is linear on the
        /// screen.
        fn gradient(&self, [fa, fb, fc]: [f64; 3]) -> [f64; 2] {
            let [[ax, ay, _], [bx, by, _], [cx, cy, _]] = self.corners;
            [
                ((fb - fa) * (cy - ay) - (fc - fa) * (by - ay)) / self.area(),
                ((fc - fa) * (bx - ax) - (fb - fa) * (cx - ax)) / self.area(),
            ]
        }

        /// The level by the derivatives of u = (u q) / q and v: the quotient rule.
        fn level(&self, x: f64, y: f64, texels: f64) -> f64 {
            let [q, u, v] = self.at(x, y);
            let [qx, qy] = self.gradient([0, 1, 2].map(|i| self.corners[i][2]));
            let derivative = |axis: usize, value: f64| {
                let products = [0, 1, 2].map(|i| self.corners[i][2] * self.coordinates[i][axis]);
                let [x, y] = self.gradient(products);
                [(x - value * qx) / q, (y - value * qy) / q]
            };
            let ([ux, uy], [vx, vy]) = (derivative(0, u), derivative(1, v));
            ((ux * vy - uy * vx).abs() * texels).log2() / 2.0
        }
    }

    /// Triangles of all sizes, with distances up to 1:1,000, against the definition in f64.
    #[test]
    fn levels_are_within_their_bounds() {
        let mut random = Random::new(12);
        let mut unit = || (random.bits() >> 11) as f64 / 2f64.powi(53);
        let (mut cases, mut far) = (0, 0);
        while cases < 20_000 {
            let size = 2f64.powf(10.0 * unit());
            let repeats = 2f64.powf(10.0 * unit() - 4.0);
            let ratio = 1000f64.powf(unit());
            let nearest = 2f64.powf(-6.0 * unit());
            let case = Case {
                corners: core::array::from_fn(|_| {
                    // Snapped to sub-pixels and to near / w in Q0.32, as the arguments are.
                    let [x, y] = [unit(), unit()].map(|c| (c * size * 16.0).round() / 16.0);
                    let q = nearest * ratio.powf(-unit());
                    [x, y, (q * 2f64.powi(32)).floor() / 2f64.powi(32)]
                }),
                coordinates: core::array::from_fn(|_| {
                    [unit(), unit()]
                        .map(|c| ((c - 0.5) * repeats * 2f64.powi(24)).round() / 2f64.powi(24))
                }),
            };
            let [a, b, c] = case.coordinates;
            let on_texture = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs();
            // Of slivers on the texture, what coordinates are cut to would be the most.
            if case.area().abs() < 1.0 || on_texture < repeats * repeats * 1e-3 {
                continue;
            }
            cases += 1;
            let (width, height) = (256, 64);
            let grid = Grid::new(width, height);
            let q = |corner: [f64; 3]| InverseW::from_bits((corner[2] * 2f64.powi(32)) as u32);
            let footprint = Footprint::new(
                case.coordinates.map(|place| place.map(|c| (c * 2f64.powi(24)) as i32)),
                case.corners.map(q),
                (case.area() * 256.0).round() as i64,
                4,
            );
            let qs = case.corners.map(|corner| corner[2]);
            let spread = qs.into_iter().fold(0.0, f64::max) / qs.into_iter().fold(1.0, f64::min);
            far += usize::from(spread > 100.0);
            for weights in [[0.98, 0.01, 0.01], [0.01, 0.98, 0.01], [0.3, 0.3, 0.4]] {
                let [x, y] = [0, 1].map(|axis| -> f64 {
                    (0..3).map(|i| weights[i] * case.corners[i][axis]).sum()
                });
                let exact = case.level(x, y, (width * height) as f64);
                let [here, ..] = case.at(x, y);
                let inverse_w = InverseW::from_bits((here * 2f64.powi(32)) as u32);
                let pixel = f64::from(footprint.slope(grid).level(inverse_w).to_bits()) / 65_536.0;
                assert!((pixel - exact).abs() < 1.0 / 30.0, "{pixel} {exact}");
                let triangle = f64::from(footprint.level(grid).to_bits()) / 65_536.0;
                let bound = 1.0 / 64.0 + spread.log2();
                assert!((triangle - exact).abs() < bound, "{triangle} {exact} {spread}");
            }
        }
        assert!(far > 100, "{far} cases of far triangles");
    }

    /// One texel a pixel is level 0, two are level 1; without area it is magnified.
    #[test]
    fn levels_of_plain_squares() {
        let one = InverseW::ONE;
        let grid = Grid::new(64, 64);
        let level = |pixels: i64, corners| {
            Footprint::new(corners, [one; 3], (pixels * pixels) << 8, 4).level(grid).to_bits()
        };
        let corners = [[0, 0], [1 << 24, 0], [0, 1 << 24]];
        assert_eq!([64, 32, 16, 128].map(|p| level(p, corners)), [0, 1, 2, -1].map(|l| l << 16));
        assert!(level(64, [[0, 0], [1 << 24, 0], [2 << 24, 0]]) < 0);
        // The widest range that coordinates have.
        let ends = [[-64 << 24, -64 << 24], [64 << 24, -64 << 24], [-64 << 24, 64 << 24]];
        assert_eq!(level(64, ends), 7 << 16);
        assert_eq!(level(64, [ends[1], ends[0], ends[2]]), 7 << 16);
    }

    #[test]
    fn levels_end_where_the_texture_does() {
        let levels = Levels::new(16, 4);
        let nearest = |bits| MipLevel::from_bits(bits).nearest(&levels);
        assert_eq!([-9 << 16, 0x7FFF, 0x8000, 99 << 16].map(nearest), [0, 0, 1, 4]);
        let split = |bits| MipLevel::from_bits(bits).split(&levels, 4);
        assert_eq!(split(-1), (0, 0));
        assert_eq!(split(0x1_8000), (1, 8));
        assert_eq!(split(0x1_FFFF), (2, 0));
        assert_eq!(split(i32::MAX), (4, 0));
    }
}
