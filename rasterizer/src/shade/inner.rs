//! The pixels of a shader inside another one.

use super::{Face, Outcome, Sample, Shader};
use crate::{color::Alpha, raster::Fragment};

/// The outcome of a shader inside another one: the one colour of its triangle, or that of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InnerPixel<C, O> {
    /// All pixels of the triangle have this colour.
    Solid(C),
    /// What the shader makes of the pixel.
    Shaded(O),
}

impl<C, O: Outcome<C>> Outcome<C> for InnerPixel<C, O> {
    const DISCARDS: bool = O::DISCARDS;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;
    const HAS_ALPHA: bool = O::HAS_ALPHA;

    #[inline(always)]
    fn color(self) -> Option<C> {
        match self {
            Self::Solid(color) => Some(color),
            Self::Shaded(outcome) => outcome.color(),
        }
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        match self {
            Self::Solid(color) => Some((color, Alpha::OPAQUE)),
            Self::Shaded(outcome) => outcome.layer(),
        }
    }
}

/// Returns the pixels of a triangle of which the shader makes `face`.
#[inline(always)]
pub(super) fn pixels<Sh: Shader>(
    shader: &Sh,
    surface: &Sh::Surface,
    face: Face<Sh::Color, Sh::Face>,
) -> impl Fn(Fragment<Sample<Sh>>) -> InnerPixel<Sh::Color, Sh::Outcome> + Copy {
    let (solid, face) = match face {
        Face::Solid(color) => (Some(color), Sh::Face::default()),
        Face::Shaded(face) => (None, face),
    };
    let pixel = shader.pixels(surface, face);
    move |fragment| match solid {
        Some(color) => InnerPixel::Solid(color),
        None => InnerPixel::Shaded(pixel(fragment)),
    }
}
