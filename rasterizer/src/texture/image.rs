//! Textures whose sizes are types.

use core::marker::PhantomData;

use super::{
    CoordinateFormat, Coordinates, LitTexels, MAX_SIDE, Place, Quad, Repeat, Table, Texels,
    TextureVarying, Wrap,
};

/// A texture, with or without mip levels: its texels, and which of them a place is on.
pub trait TexelMap: Copy {
    /// How texels are stored.
    type Texels: Texels;
    /// The place of a pixel.
    type Place: Copy;
    /// The coordinates of a vertex, in a mesh's format.
    type Coordinates<C: CoordinateFormat>: TextureVarying<Sample = Self::Place> + From<[C; 2]>;

    /// Returns the texels.
    fn texels(&self) -> &Self::Texels;

    /// Returns a texel by its number.
    #[doc(hidden)]
    #[inline(always)]
    fn texel(&self, index: usize) -> TexelOf<Self> {
        self.texels().texel(index)
    }

    /// Returns a texel as it is filtered, by its number.
    #[doc(hidden)]
    #[inline(always)]
    fn before_light(&self, index: usize, light: <Self::Texels as LitTexels>::Light) -> TexelOf<Self>
    where
        Self::Texels: LitTexels,
    {
        self.texels().before_light(index, light)
    }

    /// Returns the number of the texel that covers the place.
    fn nearest(&self, place: Self::Place) -> usize;

    /// Returns the four texels between whose centres the place lies, with fractions of `bits`
    /// binary digits, 1 to 8.
    fn bilinear(&self, place: Self::Place, bits: u32) -> Quad;
}

/// The texel type of a texture.
pub type TexelOf<T> = <<T as TexelMap>::Texels as Texels>::Texel;

/// The colour type of a texture.
pub type ColorOf<T> = <<T as TexelMap>::Texels as Texels>::Color;

/// A texture of `W` x `H` texels, 1 to 1,024 each, that goes on beyond its left and right borders
/// like `X` and beyond its upper and lower ones like `Y`: [`Repeat`], [`Mirror`](super::Mirror) or
/// [`Clamp`](super::Clamp).
///
/// u runs to the right and v downwards from the top left corner; 1 is the texture's width or
/// height. Texel (i, j) covers i / `W` <= u < (i + 1) / `W` and j / `H` <= v < (j + 1) / `H`, and
/// its centre is in the middle of that.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// use rasterizer::texture::{Clamp, Colors, Repeat, Texture};
///
/// static TEXELS: [Rgb565; 8] = {
///     let (a, b) = (Rgb565::WHITE, Rgb565::BLUE);
///     [a, b, a, b, b, a, b, a]
/// };
/// static CHECKS: Texture<Colors<'_, Rgb565, 8>, 4, 2> = Texture::new(Colors::new(&TEXELS));
/// ```
///
/// Wrong numbers of texels, and sides that do not go with the wrapping, do not compile:
///
/// ```compile_fail,E0080
/// # use rasterizer::texture::{Colors, Texture};
/// let texture: Texture<Colors<'_, u16, 8>, 4, 4> = Texture::new(Colors::new(&[0; 8]));
/// ```
///
/// ```compile_fail,E0080
/// # use rasterizer::texture::{Colors, Texture};
/// let texture: Texture<Colors<'_, u16, 6>, 3, 2> = Texture::new(Colors::new(&[0; 6]));
/// ```
///
/// ```compile_fail,E0080
/// # use rasterizer::texture::{Clamp, Colors, Texture};
/// type Long<'a> = Texture<Colors<'a, u16, 1025>, 1025, 1, Clamp>;
/// let texture: Long<'_> = Texture::new(Colors::new(&[0; 1025]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texture<F, const W: usize, const H: usize, X = Repeat, Y = Repeat> {
    texels: F,
    wrap: PhantomData<(X, Y)>,
}

impl<F: Table, const W: usize, const H: usize, X: Wrap, Y: Wrap> Texture<F, W, H, X, Y> {
    /// A texture of these texels.
    #[must_use]
    pub const fn new(texels: F) -> Self {
        const {
            check_sides::<X, Y>(W, H);
            assert!(F::COUNTS.contain(W * H), "a texture has width x height texels");
        }
        Self { texels, wrap: PhantomData }
    }
}

/// Panics, in a constant, if a side has a length that does not go with its wrapping.
pub(super) const fn check_sides<X: Wrap, Y: Wrap>(width: usize, height: usize) {
    assert!(width >= 1 && width <= MAX_SIDE, "a texture is 1 to 1,024 texels wide");
    assert!(height >= 1 && height <= MAX_SIDE, "a texture is 1 to 1,024 texels high");
    assert!(
        (X::ANY_LENGTH || width.is_power_of_two()) && (Y::ANY_LENGTH || height.is_power_of_two()),
        "a side that is repeated or mirrored is a power of two"
    );
}

impl<F: Table, const W: usize, const H: usize, X: Wrap, Y: Wrap> TexelMap
    for Texture<F, W, H, X, Y>
{
    type Texels = F;
    type Place = Place<W, H, X, Y>;
    type Coordinates<C: CoordinateFormat> = Coordinates<C, W, H, X, Y>;

    #[inline(always)]
    fn texels(&self) -> &F {
        &self.texels
    }

    #[inline(always)]
    fn texel(&self, index: usize) -> F::Texel {
        self.texels.texel_in_rows::<W>(index)
    }

    #[inline(always)]
    fn before_light(&self, index: usize, light: F::Light) -> F::Texel
    where
        F: LitTexels,
    {
        self.texels.before_light_in_rows::<W>(index, light)
    }

    #[inline(always)]
    fn nearest(&self, place: Self::Place) -> usize {
        place.nearest()
    }

    #[inline(always)]
    fn bilinear(&self, place: Self::Place, bits: u32) -> Quad {
        place.bilinear(bits)
    }
}
