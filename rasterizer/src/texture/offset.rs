//! A texture that is moved over its surface.

use fixed::types::I8F24;

use super::{CoordinateFormat, Levels, LitTexels, Mipmapped, Place, Quad, TexelMap, TexelOf, Wrap};

/// A texture whose coordinates have an offset that is known at run time: a scrolling one, or
/// another part of an atlas. Tables stay as they are, and a scene without one has no code for it;
/// it takes a pixel one addition, or two if its coordinates do not fit one word
/// ([`Coordinates`](super::Coordinates)).
///
/// An offset of u and v is in repeats: the texel that is seen at (u, v) is that of (u + offset of
/// u, v + offset of v). So a positive offset moves the picture to the left and upwards.
///
/// Repeated and mirrored axes take any offset, exactly modulo 256 repeats, so that one that runs on
/// and on may wrap. Along an axis that is clamped the offset must be between -63 and 63:
/// coordinates are at most 64 from 0, and both together stay below 128.
///
/// ```
/// use embedded_graphics_core::pixelcolor::Gray8;
/// use fixed::types::I8F24;
/// use rasterizer::{shade::Textured, texture::{Colors, Offset, Texture}};
///
/// static TEXELS: [Gray8; 4] = [Gray8::new(0), Gray8::new(80), Gray8::new(160), Gray8::new(240)];
/// static WATER: Texture<Colors<'_, Gray8, 4>, 2, 2> = Texture::new(Colors::new(&TEXELS));
///
/// # fn frame(time: I8F24) {
/// let moved = [Offset::new(WATER, [time, I8F24::ZERO])];
/// let shader = Textured::new(&moved);
/// # let _ = shader;
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Offset<T> {
    texture: T,
    by: [i32; 2],
}

impl<T> Offset<T> {
    /// A texture with an offset of u and v, in repeats.
    #[must_use]
    pub const fn new(texture: T, by: [I8F24; 2]) -> Self {
        let [u, v] = by;
        Self { texture, by: [u.to_bits(), v.to_bits()] }
    }
}

impl<T, const W: usize, const H: usize, X: Wrap, Y: Wrap> Offset<T>
where
    T: TexelMap<Place = Place<W, H, X, Y>>,
{
    #[inline(always)]
    const fn moved(&self, place: Place<W, H, X, Y>) -> Place<W, H, X, Y> {
        place.moved(self.by)
    }
}

impl<T, const W: usize, const H: usize, X: Wrap, Y: Wrap> TexelMap for Offset<T>
where
    T: TexelMap<Place = Place<W, H, X, Y>>,
{
    type Texels = T::Texels;
    type Place = T::Place;
    type Coordinates<C: CoordinateFormat> = T::Coordinates<C>;

    #[inline(always)]
    fn texels(&self) -> &T::Texels {
        self.texture.texels()
    }

    #[inline(always)]
    fn texel(&self, index: usize) -> TexelOf<T> {
        self.texture.texel(index)
    }

    #[inline(always)]
    fn before_light(&self, index: usize, light: <T::Texels as LitTexels>::Light) -> TexelOf<T>
    where
        T::Texels: LitTexels,
    {
        self.texture.before_light(index, light)
    }

    #[inline(always)]
    fn nearest(&self, place: T::Place) -> usize {
        self.texture.nearest(self.moved(place))
    }

    #[inline(always)]
    fn bilinear(&self, place: T::Place, bits: u32) -> Quad {
        self.texture.bilinear(self.moved(place), bits)
    }
}

impl<T, const W: usize, const H: usize, X: Wrap, Y: Wrap> Mipmapped for Offset<T>
where
    T: Mipmapped + TexelMap<Place = Place<W, H, X, Y>>,
{
    #[inline(always)]
    fn levels(&self) -> &Levels {
        self.texture.levels()
    }

    #[inline(always)]
    fn nearest_in(&self, place: T::Place, level: u32) -> usize {
        self.texture.nearest_in(self.moved(place), level)
    }

    #[inline(always)]
    fn bilinear_in(&self, place: T::Place, bits: u32, level: u32) -> Quad {
        self.texture.bilinear_in(self.moved(place), bits, level)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        random::Random,
        texture::{Clamp, Colors, Mipmaps, Mirror, Repeat, Texture},
    };

    const SIDE: usize = 16;
    const COUNT: usize = 256 + 64 + 16 + 4 + 1;
    const TEXELS: [u16; COUNT] = [0; COUNT];

    /// Random places and offsets, by the texture at the sum.
    fn check<X: Wrap, Y: Wrap>(limit: i32) {
        type Map<'a, X, Y> = Mipmaps<Colors<'a, u16, COUNT>, SIDE, SIDE, X, Y>;
        let map: Map<'_, X, Y> = Mipmaps::new(Colors::new(&TEXELS));
        let mut random = Random::new(71);
        let mut moves = 0;
        for _ in 0..20_000 {
            // To a 16th bit of a fraction, which packed coordinates have.
            let mut within = |limit: i32| random.within(-limit << 16, limit << 16) << 8;
            let [u, v, du, dv] = [within(64), within(64), within(limit), within(limit)];
            let place = Place::new([u, v]);
            let sum = Place::new([u.wrapping_add(du), v.wrapping_add(dv)]);
            let moved = Offset::new(map, [I8F24::from_bits(du), I8F24::from_bits(dv)]);
            assert_eq!(moved.nearest(place), map.nearest(sum), "{u} {v} {du} {dv}");
            assert_eq!(moved.bilinear(place, 4), map.bilinear(sum, 4));
            assert_eq!(moved.nearest_in(place, 2), map.nearest_in(sum, 2));
            assert_eq!(moved.bilinear_in(place, 4, 1), map.bilinear_in(sum, 4, 1));
            moves += usize::from(moved.nearest(place) != map.nearest(place));
        }
        assert!(moves > 5_000, "{moves}");
    }

    #[test]
    fn the_texel_is_that_of_the_sum() {
        check::<Repeat, Repeat>(127);
        check::<Mirror, Mirror>(127);
        check::<Clamp, Clamp>(63);
        check::<Clamp, Repeat>(63);
    }

    /// A whole repeat changes nothing, nor do two mirrored ones, where an offset wraps too.
    #[test]
    fn repeats_wrap_exactly() {
        let map: Texture<Colors<'_, u16, 256>, SIDE, SIDE> =
            Texture::new(Colors::new(TEXELS.first_chunk().unwrap()));
        let mirror: Texture<Colors<'_, u16, 256>, SIDE, SIDE, Mirror, Mirror> =
            Texture::new(Colors::new(TEXELS.first_chunk().unwrap()));
        for step in 0..4_096 {
            let place = (step * 1_537) << 8;
            for repeats in [-128, -64, -2, 2, 64, 126] {
                let by = [I8F24::from_bits(repeats << 24); 2];
                let (at, wide) = (Place::new([place, -place]), Place::new([place, -place]));
                assert_eq!(Offset::new(map, by).nearest(at), map.nearest(at));
                assert_eq!(Offset::new(mirror, by).nearest(wide), mirror.nearest(wide));
            }
            // From the largest offset to the least.
            let (last, first) = (I8F24::MAX, I8F24::MIN);
            let at = Place::new([place, place]);
            let before = Offset::new(map, [last; 2]).nearest(at);
            let after = Offset::new(map, [first.wrapping_sub(I8F24::DELTA); 2]).nearest(at);
            assert_eq!(before, after);
        }
    }
}
