//! Textures whose sizes are known at run time.

use core::{error::Error, fmt, marker::PhantomData};

use super::{
    CoordinateFormat, Coordinates, Grid, MAX_SIDE, Place, Quad, Repeat, TexelMap, Texels, Wrap,
};

/// Why texels make no texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureError {
    /// A side is not 1 to 1,024 texels long.
    Side,
    /// A side that is repeated or mirrored is not a power of two.
    PowerOfTwo,
    /// There are not width x height texels.
    Count,
}

impl fmt::Display for TextureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Side => "a side of a texture must be 1 to 1,024 texels long",
            Self::PowerOfTwo => {
                "a side of a texture that is repeated or mirrored must be a power of two"
            }
            Self::Count => "a texture must have width x height texels",
        })
    }
}

impl Error for TextureError {}

/// A texture like [`Texture`](super::Texture) whose size is known at run time: one that is read
/// from a card, or several of different sizes in one table. A pixel takes 10 to 20 instructions
/// more.
///
/// Its texels are [`ColorSlice`](super::ColorSlice), [`IndexedSlice`](super::IndexedSlice),
/// [`ShadedSlice`](super::ShadedSlice), [`MaskedSlice`](super::MaskedSlice) or
/// [`Keyed`](super::Keyed) ones, or a table.
///
/// Perspective is corrected as for a texture of the largest size: with
/// [`Adaptive`](crate::attribute::Adaptive), the tolerance is in texels of one of 1,024.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// use rasterizer::texture::{Clamp, ColorSlice, DynamicTexture, TextureError};
///
/// let picture = [Rgb565::RED; 12];
/// let texels = ColorSlice::new(&picture)?;
/// let texture: DynamicTexture<_, Clamp, Clamp> = DynamicTexture::new(texels, 4, 3)?;
/// # let wrong: Result<DynamicTexture<_, Clamp, Clamp>, _> = DynamicTexture::new(texels, 4, 4);
/// # assert_eq!(wrong, Err(TextureError::Count));
/// # Ok::<(), TextureError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DynamicTexture<F, X = Repeat, Y = Repeat> {
    texels: F,
    grid: Grid,
    wrap: PhantomData<(X, Y)>,
}

impl<F: Texels, X: Wrap, Y: Wrap> DynamicTexture<F, X, Y> {
    /// A texture of these texels.
    ///
    /// # Errors
    ///
    /// Returns what is wrong with the sides or the number of texels.
    pub fn new(texels: F, width: usize, height: usize) -> Result<Self, TextureError> {
        let sides = 1..=MAX_SIDE;
        if !(sides.contains(&width) && sides.contains(&height)) {
            return Err(TextureError::Side);
        }
        let is_wrapped = |any_length: bool, side: usize| any_length || side.is_power_of_two();
        if !(is_wrapped(X::ANY_LENGTH, width) && is_wrapped(Y::ANY_LENGTH, height)) {
            return Err(TextureError::PowerOfTwo);
        }
        if !texels.counts().contain(width * height) {
            return Err(TextureError::Count);
        }
        Ok(Self { texels, grid: Grid::new(width, height), wrap: PhantomData })
    }
}

impl<F, X, Y> DynamicTexture<F, X, Y> {
    /// Its sides.
    pub(super) const fn grid(&self) -> &Grid {
        &self.grid
    }
}

impl<F: Texels, X: Wrap, Y: Wrap> TexelMap for DynamicTexture<F, X, Y> {
    type Texels = F;
    type Place = Place<MAX_SIDE, MAX_SIDE, X, Y>;
    type Coordinates<C: CoordinateFormat> = Coordinates<C, MAX_SIDE, MAX_SIDE, X, Y>;

    #[inline(always)]
    fn texels(&self) -> &F {
        &self.texels
    }

    #[inline(always)]
    fn nearest(&self, place: Self::Place) -> usize {
        self.grid.nearest::<X, Y>(place.uv())
    }

    #[inline(always)]
    fn bilinear(&self, place: Self::Place, bits: u32) -> Quad {
        self.grid.bilinear::<X, Y>(place.uv(), bits)
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::Gray8;

    use super::*;
    use crate::{
        random::Random,
        texture::{
            Clamp, ColorSlice, Colors, Indexed, IndexedSlice, Keyed, LitTexels, Masked,
            MaskedSlice, Mirror, SHADES, Shaded, ShadedSlice, Table, Texture,
        },
    };

    const GRAYS: [Gray8; 16] = {
        let mut grays = [Gray8::new(0); 16];
        let mut i = 0;
        while i < 16 {
            grays[i] = Gray8::new(16 * i as u8 + 1);
            i += 1;
        }
        grays
    };

    const BYTES: [u8; 8] = [0x10, 0x32, 0x54, 0x76, 0x98, 0xBA, 0xDC, 0xFE];

    /// Both give the same texels, lit and unlit, wherever a place is.
    fn check<F, G, X: Wrap, Y: Wrap>(fixed: F, dynamic: G)
    where
        F: Table + LitTexels,
        G: LitTexels<Texel = F::Texel, Light = F::Light>,
        F::Texel: PartialEq + fmt::Debug,
    {
        let fixed: Texture<F, 8, 2, X, Y> = Texture::new(fixed);
        let dynamic = DynamicTexture::<G, X, Y>::new(dynamic, 8, 2).unwrap();
        let light = F::light(u32::from(F::varying(30_000)) << 16);
        assert_eq!(F::varying(30_000), G::varying(30_000));
        let mut random = Random::new(9);
        for _ in 0..2_000 {
            let bits = random.bits();
            let uv = [bits as i32 >> 3, (bits >> 32) as i32 >> 3];
            let index = fixed.nearest(Place::new(uv));
            assert_eq!(index, dynamic.nearest(Place::new(uv)));
            assert_eq!(fixed.texels().texel(index), dynamic.texels.texel(index));
            let lit = fixed.texels().before_light(index, light);
            assert_eq!(lit, dynamic.texels.before_light(index, light));
        }
    }

    #[test]
    fn slices_are_like_tables() {
        let colors = ColorSlice::new(&GRAYS).unwrap();
        check::<_, _, Repeat, Mirror>(Colors::new(&GRAYS), colors);
        check::<_, _, Clamp, Repeat>(
            Keyed::new(Colors::new(&GRAYS), GRAYS[5]),
            Keyed::new(colors, GRAYS[5]),
        );
        type Four<'a> = IndexedSlice<'a, Gray8, 4, 16>;
        let places: Indexed<'_, Gray8, 4, 8, 16> = Indexed::new(&BYTES, &GRAYS);
        let slice = Four::new(&BYTES, &GRAYS);
        check::<_, _, Mirror, Clamp>(places, slice);
        check::<_, _, Repeat, Repeat>(Keyed::new(places, 5), Keyed::new(slice, 5));
        check::<_, _, Repeat, Repeat>(
            Masked::<_, 4, 8>::new(places, &BYTES),
            MaskedSlice::<_, 4>::new(slice, &BYTES),
        );
        let mut palettes = [GRAYS; SHADES];
        for (row, palette) in palettes.iter_mut().enumerate() {
            palette[3] = Gray8::new(row as u8);
        }
        let shaded: Shaded<'_, Gray8, 4, 8, 16> = Shaded::new(&BYTES, &palettes);
        let slice: ShadedSlice<'_, Gray8, 4, 16> = ShadedSlice::new(&BYTES, &palettes);
        check::<_, _, Repeat, Clamp>(shaded, slice);
        check::<_, _, Repeat, Clamp>(
            Masked::<_, 4, 8>::new(shaded, &BYTES),
            MaskedSlice::<_, 4>::new(slice, &BYTES),
        );
    }

    #[test]
    fn what_makes_no_texture_is_refused() {
        let colors = ColorSlice::new(&GRAYS).unwrap();
        let new = DynamicTexture::<_, Clamp, Repeat>::new;
        assert_eq!(new(colors, 0, 16), Err(TextureError::Side));
        assert_eq!(new(colors, 1, 1025), Err(TextureError::Side));
        assert_eq!(new(colors, 2, 7), Err(TextureError::PowerOfTwo));
        assert_eq!(new(colors, 7, 2), Err(TextureError::Count));
        assert!(new(colors, 8, 2).is_ok());
        assert_eq!(ColorSlice::<Gray8>::new(&[]), Err(TextureError::Count));
        let places: IndexedSlice<'_, Gray8, 4, 16> = IndexedSlice::new(&BYTES[..5], &GRAYS);
        let odd = DynamicTexture::<_, Clamp, Clamp>::new(places, 3, 3);
        assert!(odd.is_ok());
        assert!(std::format!("{}", TextureError::Side).contains("1,024"));
    }

    /// Past the end of a slice there is something, too.
    #[test]
    fn no_index_panics() {
        assert_eq!(ColorSlice::new(&GRAYS).unwrap().texel(99), GRAYS[0]);
        let places: IndexedSlice<'_, Gray8, 4, 16> = IndexedSlice::new(&[], &GRAYS);
        assert_eq!(places.texel(99), GRAYS[0]);
    }
}
