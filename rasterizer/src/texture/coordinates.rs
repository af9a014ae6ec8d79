//! Texture coordinates on the way from a vertex to a pixel.

use core::{fmt::Debug, marker::PhantomData};

use super::{Side, Wrap};
use crate::{
    attribute::{
        Components, Field, Interpolate, InverseW, Piece, Plane, QuickGradients, Step,
        TriangleSetup, Varyings, lerp,
    },
    numbers::Subpixel,
};

/// The coordinates u and v of a vertex in a texture of `W` by `H` texels, with `X` and `Y` saying
/// how it goes on beyond its borders. `T` is `i16` for a mesh's table of 16 bits, in Q2.14, or
/// `i32` for one of 32, in Q8.24.
///
/// As a varying it is linear on the screen;
/// [`PerspectiveCorrect`](crate::attribute::PerspectiveCorrect) makes it linear in space.
///
/// From pixel to pixel, a texture that is repeated along both axes and has sides of up to 256
/// texels is stepped in two 16-bit fractions of a repeat in one word: 1/256 of a texel or less.
/// Others are stepped in two words in Q8.24.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Coordinates<T, const W: usize, const H: usize, X, Y> {
    uv: [T; 2],
    wrap: PhantomData<(X, Y)>,
}

impl<T, const W: usize, const H: usize, X, Y> Coordinates<T, W, H, X, Y> {
    /// From u and v in the format of the mesh's table.
    #[inline(always)]
    #[must_use]
    pub const fn new(uv: [T; 2]) -> Self {
        Self { uv, wrap: PhantomData }
    }

    #[inline(always)]
    pub(super) fn vertex_uv(self) -> [T; 2] {
        self.uv
    }
}

/// From u and v in the format of the mesh's table.
impl<T, const W: usize, const H: usize, X, Y> From<[T; 2]> for Coordinates<T, W, H, X, Y> {
    #[inline(always)]
    fn from(uv: [T; 2]) -> Self {
        Self { uv, wrap: PhantomData }
    }
}

/// The format of a mesh's texture coordinates: `i16`, Q2.14, or `i32`, Q8.24.
pub trait CoordinateFormat: Copy + Debug {
    /// How it is stepped from row to row.
    #[doc(hidden)]
    type Value: Step;

    /// In Q8.24.
    fn to_q24(self) -> i32;

    /// Its plane.
    #[doc(hidden)]
    fn linear<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<Self::Value>;

    /// A value in Q8.24.
    #[doc(hidden)]
    fn value_to_q24(value: Self::Value) -> i32;

    /// A change of it in Q8.24.
    #[doc(hidden)]
    fn change_to_q24(change: Self::Value) -> i32;

    /// Zero.
    #[doc(hidden)]
    const ZERO: Self;

    /// Between this and another, `t` / 2<sup>30</sup> of the way on.
    #[doc(hidden)]
    fn between(self, other: Self, t: u32) -> Self;
}

impl CoordinateFormat for i16 {
    type Value = u32;

    const ZERO: Self = 0;

    fn between(self, other: Self, t: u32) -> Self {
        lerp(i64::from(self), i64::from(other), t) as Self
    }

    #[inline(always)]
    fn to_q24(self) -> i32 {
        i32::from(self) << 10
    }

    #[inline(always)]
    fn linear<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<u32> {
        Self::plane(setup, quick, corners)
    }

    /// From Q2.30, without the half unit of 16 bits that rounds, with one of the result.
    #[inline(always)]
    fn value_to_q24(value: u32) -> i32 {
        (value ^ 0x8000_0000).wrapping_sub((1 << 15) - (1 << 5)).cast_signed() >> 6
    }

    #[inline(always)]
    fn change_to_q24(change: u32) -> i32 {
        change.wrapping_add(1 << 5).cast_signed() >> 6
    }
}

impl CoordinateFormat for i32 {
    type Value = u64;

    const ZERO: Self = 0;

    fn between(self, other: Self, t: u32) -> Self {
        lerp(i64::from(self), i64::from(other), t) as Self
    }

    #[inline(always)]
    fn to_q24(self) -> i32 {
        self
    }

    fn linear<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<u64> {
        u32::plane(setup, quick, corners.map(|c| c as u32 ^ 0x8000_0000))
    }

    #[inline(always)]
    fn value_to_q24(value: u64) -> Self {
        (u32::sample(value) ^ 0x8000_0000).cast_signed()
    }

    /// Rounded.
    #[inline(always)]
    fn change_to_q24(change: u64) -> Self {
        u32::sample(change.wrapping_add(1 << 17)).cast_signed()
    }
}

/// From Q8.24 to a component.
const COMPONENT: u32 = 1;

impl<T: CoordinateFormat, const W: usize, const H: usize, X: Wrap, Y: Wrap> Varyings
    for Coordinates<T, W, H, X, Y>
{
    type OnScreen = Self;

    fn lerp(self, other: Self, t: u32) -> Self {
        let ([u0, v0], [u1, v1]) = (self.uv, other.uv);
        Self::new([u0.between(u1, t), v0.between(v1, t)])
    }

    #[inline(always)]
    fn on_screen(self, _: InverseW) -> Self {
        self
    }
}

impl<T: CoordinateFormat, const W: usize, const H: usize, X: Wrap, Y: Wrap> Interpolate
    for Coordinates<T, W, H, X, Y>
{
    const ZERO: Self = Self::new([T::ZERO; 2]);

    type Field = LinearCoordinates<T, W, H, X, Y>;
    type Walk = Place<W, H, X, Y>;
    type Rest = Anchored<T, W, H, X, Y>;
    type Sample = Place<W, H, X, Y>;

    #[inline(always)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        [a, b, c]: [Self; 3],
    ) -> Self::Field {
        let u = T::linear(setup, quick, [a.uv[0], b.uv[0], c.uv[0]]);
        let v = T::linear(setup, quick, [a.uv[1], b.uv[1], c.uv[1]]);
        let step = Place::step([T::change_to_q24(u.per_column), T::change_to_q24(v.per_column)]);
        LinearCoordinates { u, v, step }
    }

    #[inline(always)]
    fn whole(field: &Self::Field, at: [i32; 2], pixels: usize) -> Option<Piece<Self::Walk>> {
        (pixels <= Self::Walk::LONGEST).then(|| Self::walk(field, at, pixels).0)
    }

    #[inline(always)]
    fn walk(
        field: &Self::Field,
        [address, row]: [i32; 2],
        pixels: usize,
    ) -> (Piece<Self::Walk>, Self::Rest) {
        let mut rest = Anchored {
            first: [field.u.at(address, row), field.v.at(address, row)],
            change: [field.u.per_column, field.v.per_column],
            step: field.step,
            pixels,
        };
        (rest.piece(), rest)
    }

    #[inline(always)]
    fn sample(value: Self::Walk) -> Self::Sample {
        value
    }
}

impl<T: CoordinateFormat, const W: usize, const H: usize, X: Wrap, Y: Wrap> Components
    for Coordinates<T, W, H, X, Y>
{
    type Each<E: Copy + Debug> = [E; 2];

    const UNIT_BITS: [u32; 2] =
        [24 - COMPONENT - Side::new(W).bits(), 24 - COMPONENT - Side::new(H).bits()];
    const STEP_DIGITS: u32 = Place::<W, H, X, Y>::STEP_DIGITS;
    const ZEROS: [i32; 2] = [0; 2];
    const WIDE_ZEROS: [u64; 2] = [0; 2];

    #[inline(always)]
    fn each<E: Copy + Debug>(value: E) -> [E; 2] {
        [value; 2]
    }

    #[inline(always)]
    fn components(self) -> [i32; 2] {
        let [u, v] = self.uv;
        [u.to_q24() >> COMPONENT, v.to_q24() >> COMPONENT]
    }

    #[inline(always)]
    fn walk_from([u, v]: [i32; 2]) -> Self::Walk {
        Place::new([u << COMPONENT, v << COMPONENT])
    }

    #[inline(always)]
    fn step_from([u, v]: [i32; 2]) -> Self::Walk {
        Place::step([u << COMPONENT, v << COMPONENT])
    }

    /// Steps are rounded down the rows as along them. It pays where one word holds both.
    #[inline(always)]
    fn short_plane(field: &Self::Field, reach: u32) -> Option<Plane<Self::Walk>> {
        let LinearCoordinates { u, v, step } = field;
        (Self::Walk::IS_PACKED && reach as usize <= Self::Walk::LONGEST).then(|| Plane {
            anchor: Place::new([T::value_to_q24(u.anchor), T::value_to_q24(v.anchor)]),
            per_column: *step,
            per_row: Place::step([T::change_to_q24(u.per_row), T::change_to_q24(v.per_row)]),
        })
    }
}

/// A place in a texture of `W` by `H` texels, or a way from one to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place<const W: usize, const H: usize, X, Y> {
    /// Packed, u in the lower half of the first word and v in the upper one, as fractions of a
    /// repeat; or u and v in Q8.24.
    words: [u32; 2],
    wrap: PhantomData<(X, Y)>,
}

impl<const W: usize, const H: usize, X: Wrap, Y: Wrap> Place<W, H, X, Y> {
    /// Whether one word has room for both coordinates.
    pub(super) const IS_PACKED: bool = X::IS_PERIODIC && Y::IS_PERIODIC && W <= 256 && H <= 256;

    /// The binary digits that a texel has in the words.
    const STEP_DIGITS: u32 = {
        let longer = if W > H { W } else { H };
        (if Self::IS_PACKED { 16 } else { 24 }) - Side::new(longer).bits()
    };

    /// Up to this number of pixels, rounding adds up to less than 1/16 of a texel: a step
    /// is off by half a digit.
    const LONGEST: usize = 1 << (Self::STEP_DIGITS - 3);

    const fn of(words: [u32; 2]) -> Self {
        Self { words, wrap: PhantomData }
    }

    /// From u and v in Q8.24.
    #[inline(always)]
    #[must_use]
    pub const fn new([u, v]: [i32; 2]) -> Self {
        let [u, v] = [u as u32, v as u32];
        Self::of(if Self::IS_PACKED {
            [(v << 8 & 0xFFFF_0000) | (u >> 8 & 0xFFFF), 0]
        } else {
            [u, v]
        })
    }

    /// A change from pixel to pixel, in Q8.24. What u carries moves v by 2^-16 of a repeat.
    #[inline(always)]
    const fn step([u, v]: [i32; 2]) -> Self {
        if Self::IS_PACKED {
            let [u, v] = [u.wrapping_add(1 << 7) >> 8, v.wrapping_add(1 << 7) >> 8];
            Self::of([((v << 16) as u32).wrapping_add(u as u32), 0])
        } else {
            Self::of([u as u32, v as u32])
        }
    }

    /// This place and an offset in Q8.24, modulo a repeat where packed and 256 repeats elsewhere.
    #[inline(always)]
    pub(super) const fn moved(self, [u, v]: [i32; 2]) -> Self {
        let [a, b] = self.words;
        if Self::IS_PACKED {
            let by = Self::new([u, v]).words[0];
            // u must not carry into v.
            let sum = a.wrapping_add(by & 0xFFFF_0000);
            Self::of([sum & 0xFFFF_0000 | sum.wrapping_add(by) & 0xFFFF, 0])
        } else {
            Self::of([a.wrapping_add(u as u32), b.wrapping_add(v as u32)])
        }
    }

    /// The fractions of v, in the upper half, and of u in Q0.16, if they are packed.
    #[inline(always)]
    pub(super) const fn packed(self) -> u32 {
        self.words[0]
    }

    /// u and v in Q8.24: 1 is a side of the texture. Packed, only their fractions are right.
    #[inline(always)]
    #[must_use]
    pub const fn uv(self) -> [i32; 2] {
        let [first, second] = self.words;
        if Self::IS_PACKED {
            [((first & 0xFFFF) << 8) as i32, (first >> 16 << 8) as i32]
        } else {
            [first as i32, second as i32]
        }
    }
}

impl<const W: usize, const H: usize, X: Wrap, Y: Wrap> Step for Place<W, H, X, Y> {
    const ZERO: Self = Self::of([0; 2]);

    #[inline(always)]
    fn wrapping_add(self, change: Self) -> Self {
        let ([a, b], [c, d]) = (self.words, change.words);
        Self::of([a.wrapping_add(c), if Self::IS_PACKED { 0 } else { b.wrapping_add(d) }])
    }

    #[inline(always)]
    fn wrapping_mul(self, count: i32) -> Self {
        let [a, b] = self.words;
        let b = if Self::IS_PACKED { 0 } else { b.wrapping_mul(count as u32) };
        Self::of([a.wrapping_mul(count as u32), b])
    }
}

/// Coordinates that are linear on the screen.
#[derive(Clone, Copy, Debug)]
pub struct LinearCoordinates<T: CoordinateFormat, const W: usize, const H: usize, X, Y> {
    u: Plane<T::Value>,
    v: Plane<T::Value>,
    /// The change of the place from pixel to pixel.
    step: Place<W, H, X, Y>,
}

impl<T: CoordinateFormat, const W: usize, const H: usize, X: Wrap, Y: Wrap> Field
    for LinearCoordinates<T, W, H, X, Y>
{
    #[inline(always)]
    fn over_addresses(self, to_first: [i32; 2], pitch: i32) -> Self {
        Self {
            u: self.u.over_addresses(to_first, pitch),
            v: self.v.over_addresses(to_first, pitch),
            ..self
        }
    }
}

/// The pieces of a span along which a place is linear: up to [`Place::LONGEST`] pixels.
#[derive(Clone, Copy, Debug)]
pub struct Anchored<T: CoordinateFormat, const W: usize, const H: usize, X, Y> {
    first: [T::Value; 2],
    change: [T::Value; 2],
    step: Place<W, H, X, Y>,
    pixels: usize,
}

impl<T: CoordinateFormat, const W: usize, const H: usize, X: Wrap, Y: Wrap>
    Anchored<T, W, H, X, Y>
{
    #[inline(always)]
    fn piece(&mut self) -> Piece<Place<W, H, X, Y>> {
        let pixels = self.pixels.min(Place::<W, H, X, Y>::LONGEST);
        let [u, v] = self.first;
        self.pixels -= pixels;
        self.first = self.first.wrapping_add(self.change.wrapping_mul(pixels as i32));
        Piece {
            first: Place::new([T::value_to_q24(u), T::value_to_q24(v)]),
            step: self.step,
            pixels,
        }
    }
}

impl<T: CoordinateFormat, const W: usize, const H: usize, X: Wrap, Y: Wrap> Iterator
    for Anchored<T, W, H, X, Y>
{
    type Item = Piece<Place<W, H, X, Y>>;

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.pixels == 0 {
            return None;
        }
        Some(self.piece())
    }
}

#[cfg(test)]
mod tests {
    use super::{super::Repeat, *};
    use crate::{numbers::S8, random::Random};

    type Uv = Coordinates<i16, 128, 64, Repeat, Repeat>;

    /// A plane of the packed word stays within 1/16 of a texel of those of u and v, beyond their
    /// own 1/256, everywhere in reach.
    #[test]
    fn short_planes_are_within_a_sixteenth_of_a_texel() {
        let mut random = Random::new(3);
        let mut within = |low: i32, high: i32| low + (random.bits() % (high - low) as u64) as i32;
        let mut short = 0;
        for _ in 0..2000 {
            let top = within(0, 256);
            let corners = [
                [within(0, 8000), top],
                [within(0, 8000), top + within(0, 4000)],
                [within(0, 8000), top + within(4000, 8000)],
            ];
            let [[ax, ay], [bx, by], [cx, cy]] = corners.map(|corner| corner.map(i64::from));
            let area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
            // No sliver: beyond its pixels, u would carry from repeat to repeat into v.
            if area.abs() < 1 << 23 {
                continue;
            }
            let setup = TriangleSetup::<S8>::new(corners, area > 0, area);
            let uv = [0; 3].map(|_| Uv::new([within(-8000, 8000) as i16, within(0, 9000) as i16]));
            let field = Uv::plane(&setup, None, uv);
            let Some(plane) = Uv::short_plane(&field, setup.reach()) else { continue };
            short += 1;
            // Covered or not: the plane goes on.
            for row in 0..20 {
                for column in -20..20 {
                    let [got_u, got_v] = plane.at(column, row).uv();
                    let u = i16::value_to_q24(field.u.at(column, row));
                    let v = i16::value_to_q24(field.v.at(column, row));
                    for (got, exact, side) in [(got_u, u, 128), (got_v, v, 64)] {
                        // Modulo a repeat, in Q24.
                        let off = got.wrapping_sub(exact) << 8 >> 8;
                        let texels = f64::from(off) * f64::from(side) / 2f64.powi(24);
                        assert!(texels.abs() < 1.0 / 16.0 + 1.0 / 256.0, "{texels}");
                    }
                }
            }
        }
        assert!(short > 500, "{short}");
        let setup = TriangleSetup::<S8>::new([[0, 0], [9000, 9000], [0, 9000]], true, 81_000_000);
        let field = Uv::plane(&setup, None, [Uv::new([0, 0]); 3]);
        assert!(Uv::short_plane(&field, setup.reach()).is_none(), "70 columns and rows");
    }
}
