//! Textures: texels in flash, and what a pixel takes of them.
//!
//! ```text
//!   Place     u and v of a pixel, in repeats
//!     |  Filter: which texels, with which weights
//!     |    Wrap, for each axis: what lies beyond the borders
//!     |    MipLevel: of which level, by Footprint
//!   numbers of texels
//!     |  Texels: how they are stored
//!   Texel     a colour, None where it is transparent, or a Layer with its alpha
//!     |  Mix: weighted means, light
//!   colour
//! ```
//!
//! A texture is a constant table that can stay in flash. Its format, its size and its borders are
//! types, so that the loop over pixels is compiled for them: [`Texture`], and with mip levels
//! [`Mipmaps`]. Wrong tables do not compile. [`DynamicTexture`] has a size that is known at run
//! time, and slices for tables.
//!
//! | texels | bits each | |
//! |---|---|---|
//! | [`Colors`] | those of the colour type | the target's own: `Rgb565`, [`Rgb565Be`](crate::output::Rgb565Be), `Gray8`, ... |
//! | [`Indexed`] | 8, 4, 2, 1 | places in a palette; with one of greys, an image of greys |
//! | [`Shaded`] | 8, 4, 2, 1 | places in 32 palettes from dark to bright: the least work for lit texels |
//! | [`Keyed`] | no more | one stored value is transparent |
//! | [`Masked`] | 1, 4 or 8 more | an alpha plane; texels below half are transparent |
//! | [`Translucent`] | 4 or 8 more | an alpha plane for [blending](crate::output::Over) |
//! | [`TranslucentPalette`] | no more | an alpha for each colour of a palette |
//!
//! # Coordinates
//!
//! u runs to the right and v downwards from the top left corner; 1 is the texture's width or
//! height. Texel (i, j) of W x H covers i / W <= u < (i + 1) / W and j / H <= v < (j + 1) / H. Its
//! centre, where a bilinear sample is its colour alone, is at ((i + 1/2) / W, (j + 1/2) / H). So
//! half-way between two centres, on the border of both texels, [`Nearest`] takes the right or lower
//! one and [`Bilinear`] the mean.
//!
//! [`Offset`] moves a texture by an offset that is known at run time.
//!
//! # Colours
//!
//! Texels are mixed and lit in the values that are stored, without a gamma curve. Mip levels should
//! be made in linear light, as `host-tools` makes them.

mod colors;
mod coordinates;
mod drawable;
mod dynamic;
mod filter;
mod footprint;
mod grid;
mod image;
mod indexed;
mod layer;
mod masked;
mod mipmaps;
mod mix;
mod offset;
mod shaded;
mod slices;
mod texel;
mod texels;
mod translucent;
mod varying;
mod wrap;

pub use colors::Colors;
pub use coordinates::{CoordinateFormat, Coordinates, Place};
pub use dynamic::{DynamicTexture, TextureError};
pub use filter::{
    Bilinear, BilinearMip, Filter, LevelChoice, Nearest, NearestMip, PerPixel, PerTriangle,
    Trilinear,
};
pub use footprint::{Footprint, MipLevel, Slope};
pub use grid::{Grid, Quad};
pub use image::{ColorOf, TexelMap, TexelOf, Texture};
pub use indexed::Indexed;
pub use layer::Layer;
pub use masked::{Keyed, Masked};
pub use mipmaps::{Levels, Mipmapped, Mipmaps};
pub use mix::Mix;
pub(crate) use mix::Spread;
pub use offset::Offset;
pub use shaded::{SHADES, Shaded};
pub use slices::{ColorSlice, IndexedSlice, MaskedSlice, ShadedSlice};
pub use texel::{CodeSize, Outcome, Texel};
pub use texels::{Counts, LitTexels, StoredTexels, Table, Texels};
pub use translucent::{Translucent, TranslucentPalette};
pub use varying::{TextureVarying, WithInverseW};
pub use wrap::{Clamp, MAX_SIDE, Mirror, Pair, Repeat, Side, Wrap};
