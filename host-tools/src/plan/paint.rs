//! Where the colour of a pixel comes from.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::model::TexelFormat;

/// How texture coordinates are interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Correction {
    /// Linearly on the screen.
    Affine,
    /// Divided as often as half a texel needs it.
    Adaptive,
}

/// How texels are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Texels {
    /// As colours of 16 bits.
    Direct,
    /// By a palette of 256 colours.
    Indexed8,
    /// By a palette of 16 colours.
    Indexed4,
}

impl Texels {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Direct, Self::Indexed8, Self::Indexed4];

    /// The converter's name of the format.
    pub(super) const fn format(self) -> TexelFormat {
        match self {
            Self::Direct => TexelFormat::Direct,
            Self::Indexed8 => TexelFormat::Indexed8,
            Self::Indexed4 => TexelFormat::Indexed4,
        }
    }

    /// Its name in a text.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Direct => "colours of 16 bits",
            Self::Indexed8 => "a palette of 256 colours",
            Self::Indexed4 => "a palette of 16 colours",
        }
    }
}

/// Where a mip level is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LevelChoice {
    /// Once for each triangle.
    PerTriangle,
    /// At each pixel.
    PerPixel,
}

/// Which texels make the colour of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Filter {
    /// Whether four texels are mixed; if not, the nearest one is taken.
    pub is_bilinear: bool,
    /// Where mip levels are chosen, if there are any.
    pub mip_levels: Option<LevelChoice>,
}

impl Filter {
    /// The nearest texel of textures without mip levels.
    pub const NEAREST: Self = Self { is_bilinear: false, mip_levels: None };

    /// All that go with a way to interpolate coordinates: where distances differ so much within a
    /// triangle that its pixels have levels of their own, linear coordinates are not right.
    pub(super) fn all(correction: Correction) -> impl Iterator<Item = Self> {
        let per_pixel = (correction == Correction::Adaptive).then_some(LevelChoice::PerPixel);
        [None, Some(LevelChoice::PerTriangle)].into_iter().chain(per_pixel.map(Some)).flat_map(
            |mip_levels| [false, true].map(|is_bilinear| Self { is_bilinear, mip_levels }),
        )
    }

    /// The types of the core that it uses, as Rust.
    pub(super) const fn types(self) -> &'static [&'static str] {
        match (self.is_bilinear, self.mip_levels) {
            (false, None) => &["Nearest"],
            (true, None) => &["Bilinear"],
            (false, Some(LevelChoice::PerTriangle)) => &["NearestMip", "PerTriangle"],
            (true, Some(LevelChoice::PerTriangle)) => &["BilinearMip", "PerTriangle"],
            (false, Some(LevelChoice::PerPixel)) => &["NearestMip", "PerPixel"],
            (true, Some(LevelChoice::PerPixel)) => &["BilinearMip", "PerPixel"],
        }
    }

    /// Its name in a text.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match (self.is_bilinear, self.mip_levels) {
            (false, None) => "nearest texel",
            (true, None) => "bilinear",
            (false, Some(LevelChoice::PerTriangle)) => "nearest texel of a triangle's mip level",
            (true, Some(LevelChoice::PerTriangle)) => "bilinear in a triangle's mip level",
            (false, Some(LevelChoice::PerPixel)) => "nearest texel of a pixel's mip level",
            (true, Some(LevelChoice::PerPixel)) => "bilinear in a pixel's mip level",
        }
    }
}

/// What a pixel's colour comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Paint {
    /// The colours of materials.
    Materials,
    /// The colours of vertices.
    Vertices,
    /// Textures.
    Textures(Correction, Texels, Filter),
}

impl Paint {
    /// The same by another filter, if it has textures.
    pub(super) const fn filtered(self, filter: Filter) -> Self {
        match self {
            Self::Textures(correction, texels, _) => Self::Textures(correction, texels, filter),
            other => other,
        }
    }
}

/// A part of the [name of types](super::Types).
impl fmt::Display for Paint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Textures(correction, texels, filter) = self else { return Ok(()) };
        let correction = match correction {
            Correction::Affine => "affine",
            Correction::Adaptive => "adaptive",
        };
        let texels = match texels {
            Texels::Direct => "direct",
            Texels::Indexed8 => "indexed8",
            Texels::Indexed4 => "indexed4",
        };
        let bilinear = if filter.is_bilinear { "-bilinear" } else { "" };
        let levels = match filter.mip_levels {
            None => "",
            Some(LevelChoice::PerTriangle) => "-mip",
            Some(LevelChoice::PerPixel) => "-mip-pixel",
        };
        write!(f, "-{correction}-{texels}{bilinear}{levels}")
    }
}
