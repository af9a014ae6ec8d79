//! Depth moved towards the viewer or away.

use fixed::types::{I0F32, I8F8};

use crate::{
    attribute::{DepthFormat, Interpolate},
    geometry::ScreenVertex,
    numbers::{Divisor, Subpixel},
};

/// Whether the depth of triangles is moved: [`NoBias`] or a [`Bias`].
pub trait DepthBias: Copy + private::Sealed {
    /// Whether there is anything to do.
    #[doc(hidden)]
    const MOVES: bool;

    /// The corners of a triangle with this signed area in their new depth.
    #[doc(hidden)]
    fn moved<S: Subpixel, D: DepthFormat, V: Interpolate>(
        self,
        corners: [&ScreenVertex<S, D, V>; 3],
        area: i64,
    ) -> [ScreenVertex<S, D, V>; 3];
}

mod private {
    pub trait Sealed {}
    impl Sealed for super::NoBias {}
    impl Sealed for super::Bias {}
}

/// Depth is where the triangle is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct NoBias;

impl DepthBias for NoBias {
    const MOVES: bool = false;

    #[inline(always)]
    fn moved<S: Subpixel, D: DepthFormat, V: Interpolate>(
        self,
        corners: [&ScreenVertex<S, D, V>; 3],
        _: i64,
    ) -> [ScreenVertex<S, D, V>; 3] {
        corners.map(|&corner| corner)
    }
}

/// Depth is moved by `constant + slope m`, where m is the change of the triangle's depth from a
/// pixel to its neighbour in x or y, whichever is more (Direct3D 11, "Depth Bias"). Positive is
/// nearer.
///
/// A surface that lies in another one, such as a decal or the lines of a wireframe, has the depth
/// of that surface but for rounding: a constant of a few units of the depth format decides which of
/// them is seen. [`BEHIND_LINES`](Self::BEHIND_LINES) is for surfaces with lines in them.
///
/// Depth is near / w from 0 to 1. It stays in that range: corners that would leave it lie on its
/// end. Two divisions a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bias {
    /// In slopes of the triangle, in Q8.8.
    pub slope: I8F8,
    /// In depth, in Q0.32: 2<sup>-16</sup> is a unit of the format `u16`.
    pub constant: I0F32,
}

impl Bias {
    /// For a surface whose lines are drawn over it: a slope farther away, as pixels of a line are
    /// up to half a pixel away from it, where the surface may be nearer by half a slope; and two
    /// units of the format `u16` for rounding.
    pub const BEHIND_LINES: Self =
        Self { slope: I8F8::NEG_ONE, constant: I0F32::from_bits(-2 << 16) };
}

impl DepthBias for Bias {
    const MOVES: bool = true;

    #[inline(never)]
    fn moved<S: Subpixel, D: DepthFormat, V: Interpolate>(
        self,
        corners: [&ScreenVertex<S, D, V>; 3],
        area: i64,
    ) -> [ScreenVertex<S, D, V>; 3] {
        let [a, b, c] = corners;
        let depth =
            |corner: &ScreenVertex<S, D, V>| i64::from(corner.depth.to_fraction().to_bits());
        let from_a = |corner: &ScreenVertex<S, D, V>| {
            [(corner.x - a.x).into(), (corner.y - a.y).into(), depth(corner) - depth(a)]
        };
        let ([x1, y1, d1], [x2, y2, d2]): ([i64; 3], [i64; 3]) = (from_a(b), from_a(c));
        let divisor = Divisor::new(area.unsigned_abs().max(1));
        // Products are below 2^(32 + 11 + S), so that a numerator is below 2^60.
        let slope = |numerator: i64| divisor.divide(numerator.abs() << S::BITS).0;
        let steepest = slope(d1 * y2 - d2 * y1).max(slope(d2 * x1 - d1 * x2));
        // Beyond the range of depth it makes no difference how steep the triangle is.
        let by_slope = (steepest.min(1 << 32) * i64::from(self.slope.to_bits())) >> 8;
        let change = by_slope + i64::from(self.constant.to_bits());
        corners.map(|corner| {
            let moved = (depth(corner) + change).clamp(0, u32::MAX.into());
            ScreenVertex::new(corner.x, corner.y, D::from_fraction(moved as u32), corner.varyings)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        attribute::NoDepth,
        numbers::{S4, S8},
        random::Random,
        raster::signed_area,
    };

    fn random_triangles<S: Subpixel>(seed: u64) {
        let mut random = Random::new(seed);
        for _ in 0..2000 {
            let limit = random.pick(&[40, 4000, (1024 << S::BITS) - 1]).min((1024 << S::BITS) - 1);
            let place = [0; 3].map(|_| [0; 2].map(|_| random.within(-limit, limit)));
            let depths = [0; 3].map(|_| (random.bits() >> 32) as u32);
            let vertex = |i: usize| {
                ScreenVertex::<S, u32, [u16; 1]>::checked(place[i][0], place[i][1], depths[i], [7])
                    .unwrap()
            };
            let corners = [vertex(0), vertex(1), vertex(2)];
            let corners = corners.each_ref();
            let area = signed_area(corners);
            if area == 0 {
                continue;
            }
            let bias = Bias {
                slope: I8F8::from_bits(random.within(-600, 600) as i16),
                constant: I0F32::from_bits(random.within(-1 << 20, 1 << 20)),
            };
            // The plane's gradient by its definition.
            let d = |i: usize, axis: usize| f64::from(place[i][axis] - place[0][axis]);
            let z = |i: usize| f64::from(depths[i]) - f64::from(depths[0]);
            let unit = f64::from(1 << S::BITS);
            let along_x = (z(1) * d(2, 1) - z(2) * d(1, 1)) / area as f64 * unit;
            let along_y = (z(2) * d(1, 0) - z(1) * d(2, 0)) / area as f64 * unit;
            let steepest = along_x.abs().max(along_y.abs()).min(2f64.powi(32));
            let change = steepest * f64::from(bias.slope) + f64::from(bias.constant.to_bits());
            for (got, depth) in bias.moved(corners, area).iter().zip(depths) {
                let exact = (f64::from(depth) + change).clamp(1.0, f64::from(u32::MAX));
                // The slope is rounded down before it is multiplied by up to 600 / 256, and the
                // product is.
                let error = (f64::from(got.depth()) - exact).abs();
                assert!(error <= 3.5, "{place:?} {depths:?} {bias:?}: {error}");
                assert_eq!(got.varyings(), [7]);
            }
        }
    }

    #[test]
    fn depth_moves_by_constant_and_slope() {
        random_triangles::<S4>(1);
        random_triangles::<S8>(2);
    }

    #[test]
    fn depth_stays_in_its_range() {
        let vertex = |x, y, depth| ScreenVertex::<S4, u16, [u16; 0]>::checked(x, y, depth, []);
        let corners =
            [(0, 0, 1), (0, 160, 65_535), (160, 0, 300)].map(|(x, y, d)| vertex(x, y, d).unwrap());
        let corners = corners.each_ref();
        let depths = |slope: i16, constant: i32| {
            let bias = Bias { slope: I8F8::from_num(slope), constant: I0F32::from_bits(constant) };
            bias.moved(corners, signed_area(corners)).map(|corner| corner.depth())
        };
        assert_eq!(depths(-127, 0), [1; 3]);
        assert_eq!(depths(127, 0), [65_535; 3]);
        assert_eq!(depths(0, 2 << 16), [3, 65_535, 302]);
        assert_eq!(depths(0, -2 << 16), [1, 65_533, 298]);
        let flat = [[0, 0], [0, 160], [160, 0]].map(|[x, y]| {
            ScreenVertex::<S4, NoDepth, [u16; 0]>::checked(x, y, NoDepth, []).unwrap()
        });
        let bias = Bias { slope: I8F8::ONE, constant: I0F32::DELTA };
        assert_eq!(bias.moved(flat.each_ref(), 160 * 160), flat);
    }
}
