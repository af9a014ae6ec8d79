//! A projection in integers: the divisor w, and depth.

use crate::{
    attribute::InverseW,
    camera::{Distance, Orthographic, Perspective},
    numbers::{Coordinate, Float, Reciprocal, mul_high_unsigned},
};

/// [`Perspective`] or [`Orthographic`].
#[expect(private_bounds, reason = "it is sealed")]
pub trait Projection: Copy + core::fmt::Debug + Sealed {}

impl Projection for Perspective {}
impl Projection for Orthographic {}

/// What the transform needs of a projection.
pub(crate) trait Sealed {
    /// The projection in the units of one object's clip space.
    type Lens: Lens;

    /// Whether the viewer is in the same direction from all points.
    const IS_PARALLEL: bool;

    /// The distance of the near plane, in world units.
    fn near_distance(&self) -> Distance;

    /// The distances of the near plane and of the far plane, in world units.
    fn range(&self) -> [Float; 2];

    /// The depth of a point at a distance along the camera's axis, in world units.
    fn depth_at(&self, distance: Float) -> Float;

    /// The lengths of clip space in one of the world: pixels across at w = 1, and units of z.
    fn magnification(&self, viewport_height: u32) -> [Float; 2];

    /// The near distance in these units, at least 1, and the far distance, both at most 2^30.
    fn depth_range(&self, units: Units) -> [i32; 2];

    /// The units of clip space, as exponents of 2, for an object whose x and y (as multiples of the
    /// guard band at w = 1) and z lie below 2^`xy` and 2^`z`.
    fn units(&self, xy: i32, z: i32) -> Units;

    /// The least w that a vertex on the screen has for each length of its distance from the eye,
    /// times a distance: what a matrix that is exact near the eye is as good as.
    fn least_w(&self, reach: &Reach) -> i32;

    /// The lens for these units.
    fn lens(&self, units: Units) -> Self::Lens;
}

/// The exponents of 2 of the units in which clip space counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Units {
    /// Of x, y and w.
    pub(crate) xy: i32,
    /// Of z.
    pub(crate) z: i32,
}

/// How far an object reaches.
pub(crate) struct Reach {
    /// In world units.
    pub(super) distance: Float,
    /// Guard bands for a world unit at w = 1.
    pub(super) across: Float,
    /// The least w of a vertex on the screen, in units of w.
    pub(super) least_w: i32,
    /// The sum of the largest |x| and |y|, in units of x and y.
    pub(super) side: i64,
    pub(super) units: Units,
}

/// A projection of vertices in clip space.
pub(crate) trait Lens: Copy + core::fmt::Debug {
    /// The least w of a vertex within the near plane, for an object whose least z this is.
    fn least_w(&self, z: i32) -> i32;

    /// The divisor of x and y: over 0 and below 2^30 for a z from the near plane on.
    fn w<C: Coordinate>(&self, z: C) -> C;

    /// 1 / 2 w.
    fn reciprocal_of_twice_w<C: Coordinate>(&self, z: C) -> Reciprocal;

    /// Depth in Q0.32.
    fn depth(&self, z: i32, reciprocal: Reciprocal) -> u32;

    /// near / w, by 1 / 2 w.
    fn inverse_w(&self, reciprocal: Reciprocal) -> InverseW;
}

/// Coordinates stay below 2^30, so that sums and differences of two of them fit.
const BITS: i32 = 30;

/// The limit that no coordinate reaches.
const BEYOND: i32 = 1 << BITS;

impl Sealed for Perspective {
    type Lens = PerspectiveLens;

    const IS_PARALLEL: bool = false;

    #[inline(always)]
    fn near_distance(&self) -> Distance {
        self.near()
    }

    fn range(&self) -> [Float; 2] {
        [self.near(), self.far()].map(Float::from_unsigned)
    }

    fn depth_at(&self, distance: Float) -> Float {
        Float::from_unsigned(self.near()).times(distance.reciprocal())
    }

    /// In multiples of the near distance: depth is then 1 / z.
    fn magnification(&self, viewport_height: u32) -> [Float; 2] {
        let per_near = self.per_near();
        [self.focal_length(viewport_height).times(per_near), per_near]
    }

    fn depth_range(&self, units: Units) -> [i32; 2] {
        let PerspectiveLens { down } = self.lens(units);
        // The near distance is 2^(30 - down) units. If it is over 2^30 units, all of the object
        // lies before it.
        [BEYOND >> down.min(30), self.far_per_near().in_units_of(units.z).min(BEYOND)]
    }

    /// w is z, so that all three have the same unit.
    fn units(&self, xy: i32, z: i32) -> Units {
        let unit = xy.max(z) - BITS;
        Units { xy: unit, z: unit }
    }

    /// On the screen at a distance w along the axis: at most w (1 + 1.5 / f) from the eye, where f
    /// is the focal length in guard bands and (w / f, w / f, w) a corner of the guard band; and at
    /// most w and what the object reaches to the side.
    fn least_w(&self, reach: &Reach) -> i32 {
        const ROOT: Float = Float::new(3, -1);
        let &Reach { distance, across, least_w, side, units } = reach;
        // A translation is exact to 2^-16 units: a 2^25th of 2^9 units of near distance.
        if units.z > -9 {
            return 0;
        }
        let deep = self.per_near();
        let in_guard_band = across.over(across.plus(deep.times(ROOT)));
        let least = Float::new(least_w.into(), 0).times(across);
        let to_side = least.over(least.plus(Float::new(side, 0).times(deep)));
        let [a, b] = [in_guard_band, to_side]
            .map(|part| distance.times(deep).times(part).in_units_of(units.z));
        a.max(b)
    }

    fn lens(&self, units: Units) -> PerspectiveLens {
        PerspectiveLens { down: (30 + units.z).max(0).unsigned_abs() }
    }
}

/// w = z; depth = near / z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PerspectiveLens {
    /// The leading zeros of twice the near distance, or what they would be if it is less than a
    /// unit.
    down: u32,
}

impl Lens for PerspectiveLens {
    fn least_w(&self, z: i32) -> i32 {
        z.max(BEYOND >> self.down.min(30))
    }

    #[inline(always)]
    fn w<C: Coordinate>(&self, z: C) -> C {
        z
    }

    #[inline(always)]
    fn reciprocal_of_twice_w<C: Coordinate>(&self, z: C) -> Reciprocal {
        Reciprocal::of_words(z.shifted_units(1).cast_unsigned(), z.fraction() << 1)
    }

    #[inline(always)]
    fn depth(&self, _: i32, reciprocal: Reciprocal) -> u32 {
        // near / z = 2^(30 - down) r 2^(leading_zeros - 61), times 2^32. No z has more leading
        // zeros than the near plane.
        let down = self.down - reciprocal.leading_zeros;
        ((reciprocal.mantissa as u32) << 1) >> down.min(31)
    }

    /// w is z.
    #[inline(always)]
    fn inverse_w(&self, reciprocal: Reciprocal) -> InverseW {
        InverseW::from_bits(self.depth(0, reciprocal))
    }
}

impl Sealed for Orthographic {
    type Lens = OrthographicLens;

    const IS_PARALLEL: bool = true;

    #[inline(always)]
    fn near_distance(&self) -> Distance {
        self.near()
    }

    fn range(&self) -> [Float; 2] {
        [self.near(), self.far()].map(Float::from_unsigned)
    }

    fn depth_at(&self, distance: Float) -> Float {
        let [near, far] = self.range();
        let minus = |a: Float, b: Float| a.plus(Float { mantissa: -b.mantissa, ..b });
        minus(far, distance).times(minus(far, near).reciprocal())
    }

    fn magnification(&self, viewport_height: u32) -> [Float; 2] {
        [self.pixels_per_unit(viewport_height), Float::new(1, 0)]
    }

    fn depth_range(&self, units: Units) -> [i32; 2] {
        [self.near(), self.far()]
            .map(|d| Float::from_unsigned(d).in_units_of(units.z).clamp(1, BEYOND))
    }

    /// w = 1 is a whole number of units unless the object is too large, and the far plane fits the
    /// range of z.
    fn units(&self, xy: i32, z: i32) -> Units {
        let far = Float::from_unsigned(self.far());
        Units {
            // Below 2^30, so that the sum of w and a coordinate as large fits too.
            xy: (xy - BITS).max(1 - BITS),
            z: z.max(far.magnitude()) - BITS,
        }
    }

    /// w is the same everywhere, and the lens has it.
    fn least_w(&self, _: &Reach) -> i32 {
        0
    }

    fn lens(&self, units: Units) -> OrthographicLens {
        let [near, far] = self.depth_range(units);
        let w = 1i32.checked_shl(units.xy.wrapping_neg() as u32).unwrap_or(0);
        OrthographicLens {
            w,
            reciprocal: Reciprocal::of((w << 1).max(1) as u32),
            far,
            range: Reciprocal::of(far.wrapping_sub(near).max(1) as u32),
        }
    }
}

/// w = 1; depth = (far - z) / (far - near).
#[derive(Clone, Copy, Debug)]
pub(crate) struct OrthographicLens {
    w: i32,
    reciprocal: Reciprocal,
    far: i32,
    range: Reciprocal,
}

impl Lens for OrthographicLens {
    fn least_w(&self, _: i32) -> i32 {
        self.w
    }

    #[inline(always)]
    fn w<C: Coordinate>(&self, _: C) -> C {
        C::new(self.w, 0)
    }

    #[inline(always)]
    fn reciprocal_of_twice_w<C: Coordinate>(&self, _: C) -> Reciprocal {
        self.reciprocal
    }

    #[inline(always)]
    fn depth(&self, z: i32, _: Reciprocal) -> u32 {
        // The way to the far plane, shifted like the range it is part of: their quotient in Q31.
        let way = (self.far.wrapping_sub(z).max(0) as u32) << self.range.leading_zeros;
        let quotient = mul_high_unsigned(way, (self.range.mantissa as u32) << 1);
        if quotient >> 31 == 0 { quotient << 1 } else { u32::MAX }
    }

    #[inline(always)]
    fn inverse_w(&self, _: Reciprocal) -> InverseW {
        InverseW::ONE
    }
}
