//! Colours by themselves: put over one another, interpolated, dithered to few bits, and a format
//! of one byte.
//!
//! # Colour types
//!
//! All colours of embedded-graphics are colours of a target, and so are two of this crate.
//! Everything of a row can be used with its type:
//!
//! | type | bits | from [`Rgb888`](embedded_graphics_core::pixelcolor::Rgb888) | blended | dithered in | packed frame |
//! |---|---|---|---|---|---|
//! | `BinaryColor` | 1 | luma 128 and above is on | | linear light | 8 pixels a byte |
//! | `Gray2` | 2 | luma | yes | linear light | 4 pixels a byte |
//! | `Gray4` | 4 | luma | yes | stored values | 2 pixels a byte |
//! | `Gray8` | 8 | luma | yes | itself | |
//! | [`Rgb332`] | 8 | by channels | yes | stored values | |
//! | `Rgb555`, `Bgr555` | 15 | by channels | yes | stored values | |
//! | `Rgb565`, `Bgr565`, [`Rgb565Be`](crate::output::Rgb565Be) | 16 | by channels | yes | stored values | |
//! | `Rgb666`, `Bgr666` | 18 | by channels | yes | stored values | |
//! | `Rgb888`, `Bgr888` | 24 | itself | yes | itself | |
//!
//! * Shaders make a colour of a material's by `From<Rgb888>`. embedded-graphics has that for all of
//!   its types: a channel is rounded to the nearest value, and the luma of a gray is
//!   (77 R + 150 G + 29 B) / 256, rounded: the weights of ITU-R BT.601 to eight bits, of the stored
//!   values. `BinaryColor::On` is the bright colour; for a display on which it is dark, invert what
//!   is sent.
//! * [`Frame`](crate::output::Frame), [`Bands`](crate::output::Bands) and
//!   [`Direct`](crate::output::Direct) take all of them, at a byte a pixel or more.
//!   [`PackedFrame`](crate::output::PackedFrame) stores colours of 1, 2 and 4 bits without gaps.
//! * Blended colours are read, changed and stored in their own type: [`Composite`]. A pixel of
//!   `BinaryColor` is replaced or left out. To blend for such a display, draw in `Gray8`, and
//!   dither what is sent: [`Dithering`](crate::output::Dithering).
//! * Textures have texels of any type, and are filtered and lit in it:
//!   [`Mix`](crate::texture::Mix).
//! * embedded-graphics has no type of 12 bits. A type of your own takes
//!   [`StoredColor`](crate::output::StoredColor) and `From<Rgb888>` to be drawn, and [`Dither`] to
//!   be dithered.

mod alpha;
mod bayer;
mod channels;
mod composite;
mod dither;
mod linear;
mod mean;
mod rgb332;

pub use alpha::Alpha;
pub use bayer::Bayer;
pub use channels::Channels;
pub(crate) use channels::to_q16;
pub use composite::Composite;
pub use dither::{Dither, FullColor};
pub use mean::Mean;
pub use rgb332::Rgb332;
