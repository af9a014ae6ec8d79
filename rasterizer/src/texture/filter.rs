//! Which texels make the colour of a pixel.

use super::{
    CodeSize, ColorOf, Footprint, Grid, MipLevel, Mipmapped, Mix, Texel as _, TexelMap, TexelOf,
    TextureVarying, WithInverseW, footprint::Slope,
};
use crate::{attribute::InverseW, color::Alpha, numbers::codegen};

/// How the colour of a pixel is made of texels: [`Nearest`], [`Bilinear`], and with mip levels
/// [`NearestMip`], [`BilinearMip`] and [`Trilinear`].
pub trait Filter<T: TexelMap>: Copy {
    /// Coordinates, with near / w beside them if the filter takes it.
    type Coordinates<V: TextureVarying>: TextureVarying<Sample = V::Sample> + From<V>;
    /// What is computed once a triangle.
    type Face: Copy + Default;

    /// How much code a sample takes.
    const CODE: CodeSize = CodeSize::Large;

    /// Computes it. `footprint` is called by filters that take mip levels.
    fn face(map: &T, footprint: impl FnOnce() -> Footprint) -> Self::Face;

    /// Returns the texel of a pixel by its place and near / w, which is not read unless it is
    /// beside the [`Coordinates`](Self::Coordinates). `fetch` gets a texel by its number.
    fn sample(
        map: &T,
        face: &Self::Face,
        place: T::Place,
        inverse_w: InverseW,
        fetch: impl Fn(usize) -> TexelOf<T>,
    ) -> TexelOf<T>;
}

/// The texel that the pixel's centre lies on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Nearest;

impl<T: TexelMap> Filter<T> for Nearest {
    type Coordinates<V: TextureVarying> = V;
    type Face = ();

    const CODE: CodeSize = CodeSize::Small;

    #[inline(always)]
    fn face(_: &T, _: impl FnOnce() -> Footprint) {}

    #[inline(always)]
    fn sample(
        map: &T,
        (): &(),
        place: T::Place,
        _: InverseW,
        fetch: impl Fn(usize) -> TexelOf<T>,
    ) -> TexelOf<T> {
        fetch(map.nearest(place))
    }
}

/// The four texels between whose centres the pixel's centre lies, each the more the nearer it is.
///
/// Weights sum to one exactly. They have 5 bits for colours of 15 and 16 bits, whose fractions are
/// rounded to 1/16 texel, and 16 bits, with fractions of 1/256 texel, for others. Of transparent
/// texels, the nearest of the four decides whether the pixel is; colours are mixed of opaque ones.
/// An alpha ([`Layer`](super::Layer)) is mixed like the colours, apart from them, by weights of
/// twice the digits of the fractions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bilinear;

impl<T: TexelMap> Filter<T> for Bilinear
where
    ColorOf<T>: Mix,
{
    type Coordinates<V: TextureVarying> = V;
    type Face = ();

    const CODE: CodeSize = CodeSize::Medium;

    #[inline(always)]
    fn face(_: &T, _: impl FnOnce() -> Footprint) {}

    #[inline(always)]
    fn sample(
        map: &T,
        (): &(),
        place: T::Place,
        _: InverseW,
        fetch: impl Fn(usize) -> TexelOf<T>,
    ) -> TexelOf<T> {
        codegen::in_order();
        mixed::<T>(map.bilinear(place, ColorOf::<T>::FRACTION_BITS), fetch)
    }
}

#[inline(always)]
fn mixed<T: TexelMap>(quad: super::Quad, fetch: impl Fn(usize) -> TexelOf<T>) -> TexelOf<T>
where
    ColorOf<T>: Mix,
{
    let [right, down] = quad.fractions;
    let half = ColorOf::<T>::FRACTION_BITS - 1;
    let nearest = (right >> half | (down >> half) << 1) as usize;
    TexelOf::<T>::combined(
        quad.texels.map(fetch),
        nearest,
        |colors| ColorOf::<T>::mixed(colors, quad.fractions),
        |alphas| Alpha::mixed(alphas, quad.fractions, half + 1),
    )
}

/// Where a mip level is chosen: [`PerTriangle`] or [`PerPixel`].
pub trait LevelChoice: Copy + sealed::Sealed {
    /// Coordinates, with near / w beside them for a level at each pixel.
    type Coordinates<V: TextureVarying>: TextureVarying<Sample = V::Sample> + From<V>;
    /// What the level of a pixel is computed from.
    type Face: Copy + Default;

    /// Computes it for a triangle.
    fn face(footprint: Footprint, texture: Grid) -> Self::Face;

    /// Returns the level of a pixel.
    fn level(face: &Self::Face, inverse_w: InverseW) -> MipLevel;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::PerTriangle {}
    impl Sealed for super::PerPixel {}
}

/// One mip level for a triangle: [`Footprint::level`]. It is right in the middle, and off by up to
/// log2 r elsewhere, for distances from the camera in the ratio r: for objects of small triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerTriangle;

impl LevelChoice for PerTriangle {
    type Coordinates<V: TextureVarying> = V;
    type Face = MipLevel;

    #[inline(always)]
    fn face(footprint: Footprint, texture: Grid) -> MipLevel {
        footprint.level(texture)
    }

    #[inline(always)]
    fn level(face: &MipLevel, _: InverseW) -> MipLevel {
        *face
    }
}

/// The mip level of each pixel: [`Slope::level`], within 1/30 level. For floors and walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerPixel;

impl LevelChoice for PerPixel {
    type Coordinates<V: TextureVarying> = WithInverseW<V>;
    type Face = Slope;

    #[inline(always)]
    fn face(footprint: Footprint, texture: Grid) -> Slope {
        footprint.slope(texture)
    }

    #[inline(always)]
    fn level(face: &Slope, inverse_w: InverseW) -> MipLevel {
        face.level(inverse_w)
    }
}

/// The texel that the pixel's centre lies on, of the nearest mip level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct NearestMip<L = PerTriangle>(pub L);

/// Four texels of the nearest mip level, mixed like [`Bilinear`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BilinearMip<L = PerTriangle>(pub L);

/// Four texels each of the two mip levels round the pixel's own, mixed like [`Bilinear`], and both
/// mixed by how near they are, with as many digits as the fractions. Of transparent texels, the
/// nearer level decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Trilinear<L = PerTriangle>(pub L);

impl<T: Mipmapped, L: LevelChoice> Filter<T> for NearestMip<L> {
    type Coordinates<V: TextureVarying> = L::Coordinates<V>;
    type Face = L::Face;

    const CODE: CodeSize = CodeSize::Medium;

    #[inline(always)]
    fn face(map: &T, footprint: impl FnOnce() -> Footprint) -> L::Face {
        L::face(footprint(), map.levels().grid(0))
    }

    #[inline(always)]
    fn sample(
        map: &T,
        face: &L::Face,
        place: T::Place,
        inverse_w: InverseW,
        fetch: impl Fn(usize) -> TexelOf<T>,
    ) -> TexelOf<T> {
        let level = L::level(face, inverse_w).nearest(map.levels());
        fetch(map.nearest_in(place, level))
    }
}

impl<T: Mipmapped, L: LevelChoice> Filter<T> for BilinearMip<L>
where
    ColorOf<T>: Mix,
{
    type Coordinates<V: TextureVarying> = L::Coordinates<V>;
    type Face = L::Face;

    #[inline(always)]
    fn face(map: &T, footprint: impl FnOnce() -> Footprint) -> L::Face {
        L::face(footprint(), map.levels().grid(0))
    }

    #[inline(always)]
    fn sample(
        map: &T,
        face: &L::Face,
        place: T::Place,
        inverse_w: InverseW,
        fetch: impl Fn(usize) -> TexelOf<T>,
    ) -> TexelOf<T> {
        let level = L::level(face, inverse_w).nearest(map.levels());
        mixed::<T>(map.bilinear_in(place, ColorOf::<T>::FRACTION_BITS, level), fetch)
    }
}

impl<T: Mipmapped, L: LevelChoice> Filter<T> for Trilinear<L>
where
    ColorOf<T>: Mix,
{
    type Coordinates<V: TextureVarying> = L::Coordinates<V>;
    type Face = L::Face;

    #[inline(always)]
    fn face(map: &T, footprint: impl FnOnce() -> Footprint) -> L::Face {
        L::face(footprint(), map.levels().grid(0))
    }

    #[inline(always)]
    fn sample(
        map: &T,
        face: &L::Face,
        place: T::Place,
        inverse_w: InverseW,
        fetch: impl Fn(usize) -> TexelOf<T>,
    ) -> TexelOf<T> {
        let bits = ColorOf::<T>::FRACTION_BITS;
        let (level, way) = L::level(face, inverse_w).split(map.levels(), bits);
        let larger = mixed::<T>(map.bilinear_in(place, bits, level), &fetch);
        // Most often on magnified surfaces.
        if way == 0 {
            return larger;
        }
        let smaller = mixed::<T>(map.bilinear_in(place, bits, level + 1), &fetch);
        let nearer = (way >> (bits - 1)) as usize;
        TexelOf::<T>::combined(
            [larger, smaller],
            nearer,
            |[larger, smaller]| ColorOf::<T>::mixed([larger, smaller, larger, smaller], [way, 0]),
            |[larger, smaller]| Alpha::mixed([larger, smaller, larger, smaller], [way, 0], bits),
        )
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::{Gray8, GrayColor as _, Rgb565, RgbColor as _};

    use super::*;
    use crate::texture::{
        Clamp, Colors, Keyed, Mipmaps, Mirror, Place, Repeat, Texels as _, Texture, Wrap,
    };

    const ONE: i32 = 1 << 24;

    fn sample<F: Filter<T>, T: TexelMap>(map: &T, face: &F::Face, place: T::Place) -> TexelOf<T> {
        F::sample(map, face, place, InverseW::ONE, |index| map.texels().texel(index))
    }

    /// A row of four greys, filtered across the seam between the last and the first.
    fn row<X: Wrap>() -> [u8; 5] {
        const GRAYS: [Gray8; 4] = [Gray8::new(0), Gray8::new(64), Gray8::new(128), Gray8::new(240)];
        let map: Texture<Colors<'_, Gray8, 4>, 4, 1, X> = Texture::new(Colors::new(&GRAYS));
        // From half a texel before the seam to half a texel behind it.
        [-4, -2, 0, 2, 4].map(|eighth| {
            sample::<Bilinear, _>(&map, &(), Place::new([ONE + eighth * (ONE / 32), 0])).luma()
        })
    }

    #[test]
    fn a_seam_is_mixed_by_distance() {
        assert_eq!(row::<Repeat>(), [240, 180, 120, 60, 0]);
        assert_eq!(row::<Mirror>(), [240, 240, 240, 240, 240]);
        assert_eq!(row::<Clamp>(), [240, 240, 240, 240, 240]);
    }

    /// Every bilinear sample of a random picture, by the definition in f64.
    #[test]
    fn bilinear_is_the_weighted_mean() {
        const GRAYS: [Gray8; 15] = {
            let mut grays = [Gray8::new(0); 15];
            let mut i = 0;
            while i < 15 {
                grays[i] = Gray8::new((i * 97 % 256) as u8);
                i += 1;
            }
            grays
        };
        let map: Texture<Colors<'_, Gray8, 15>, 5, 3, Clamp, Clamp> =
            Texture::new(Colors::new(&GRAYS));
        for v in (-ONE / 4..5 * (ONE / 4)).step_by(ONE as usize / 41) {
            for u in (-ONE / 4..5 * (ONE / 4)).step_by(ONE as usize / 43) {
                let [x, y] = [(u, 5.0), (v, 3.0)]
                    .map(|(c, side)| f64::from(c.clamp(0, ONE)) / f64::from(ONE) * side - 0.5);
                let gray = |column: f64, row: f64| {
                    let column = column.clamp(0.0, 4.0) as usize;
                    f64::from(GRAYS[row.clamp(0.0, 2.0) as usize * 5 + column].luma())
                };
                let ([left, upper], [right, down]) =
                    ([x.floor(), y.floor()], [x - x.floor(), y - y.floor()]);
                let line = |row| gray(left, row) * (1.0 - right) + gray(left + 1.0, row) * right;
                let exact = line(upper) * (1.0 - down) + line(upper + 1.0) * down;
                let got = sample::<Bilinear, _>(&map, &(), Place::new([u, v])).luma();
                // Half a step, and 1/512 texel in both directions on a slope of at most 255.
                assert!((f64::from(got) - exact).abs() <= 0.5 + 2.0 * 255.0 / 512.0, "{u} {v}");
            }
        }
    }

    #[test]
    fn the_nearest_texel_decides_on_transparency() {
        const KEY: Gray8 = Gray8::new(255);
        const GRAYS: [Gray8; 2] = [Gray8::new(100), KEY];
        let map: Texture<Keyed<Colors<'_, Gray8, 2>>, 2, 1, Clamp, Clamp> =
            Texture::new(Keyed::new(Colors::new(&GRAYS), KEY));
        // The border between both is at 1/2.
        for (u, is_opaque) in
            [(0, true), (ONE / 2 - ONE / 64, true), (ONE / 2, false), (ONE, false)]
        {
            let wanted = is_opaque.then_some(Gray8::new(100));
            assert_eq!(sample::<Bilinear, _>(&map, &(), Place::new([u, 0])), wanted, "{u}");
            assert_eq!(sample::<Nearest, _>(&map, &(), Place::new([u, 0])), wanted, "{u}");
        }
    }

    const RED: Rgb565 = Rgb565::new(31, 0, 0);

    /// Level 0 black, level 1 half red, level 2 red.
    const LEVELS: [Rgb565; 21] = {
        let mut levels = [Rgb565::new(0, 0, 0); 21];
        let mut i = 16;
        while i < 20 {
            levels[i] = Rgb565::new(16, 0, 0);
            i += 1;
        }
        levels[20] = RED;
        levels
    };
    const MAP: Mipmaps<Colors<'_, Rgb565, 21>, 4, 4> = Mipmaps::new(Colors::new(&LEVELS));

    #[test]
    fn mip_levels_are_chosen_and_mixed() {
        let red = |color: Rgb565| color.r();
        for place in [Place::new([0, 0]), Place::new([-ONE / 3, 5 * ONE + 77])] {
            let at = |eighths: i32| {
                let level = MipLevel::from_bits(eighths << 13);
                [
                    red(sample::<NearestMip, _>(&MAP, &level, place)),
                    red(sample::<BilinearMip, _>(&MAP, &level, place)),
                    red(sample::<Trilinear, _>(&MAP, &level, place)),
                ]
            };
            assert_eq!(at(-8), [0, 0, 0]);
            assert_eq!(at(3), [0, 0, 6]);
            assert_eq!(at(4), [16, 16, 8]);
            assert_eq!(at(8), [16, 16, 16]);
            assert_eq!(at(12), [31, 31, 24]);
            assert_eq!(at(99), [31, 31, 31]);
            assert_eq!(red(sample::<Bilinear, _>(&MAP, &(), place)), 0);
        }
    }

    /// A square of 4 texels on 2 pixels at the corners' distance: level 1, and others elsewhere.
    #[test]
    fn the_level_of_a_pixel_follows_its_distance() {
        let corners = [[0, 0], [ONE, 0], [0, ONE]];
        let near = InverseW::from_bits(1 << 31);
        let footprint = || Footprint::new(corners, [near; 3], 4 << 8, 4);
        let face = <NearestMip<PerPixel> as Filter<_>>::face(&MAP, footprint);
        let at = |q32| {
            let inverse_w = InverseW::from_bits(q32);
            NearestMip::<PerPixel>::sample(&MAP, &face, Place::new([0, 0]), inverse_w, |index| {
                MAP.texels().texel(index)
            })
        };
        // 3/2 levels for each doubling of the distance.
        assert_eq!([1 << 31, 1 << 30, u32::MAX].map(|q| at(q).r()), [16, 31, 0]);
        let face = <NearestMip as Filter<_>>::face(&MAP, footprint);
        assert_eq!(face, MipLevel::from_bits(1 << 16));
    }
}
