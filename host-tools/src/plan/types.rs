//! The types of a renderer: what decides its code.

use std::fmt;

use embedded_graphics_core::pixelcolor::Rgb565;
use rasterizer::{
    attribute::{Adaptive, Affine, NoDepth},
    geometry::ScreenVertex,
    numbers::S4,
    shade::{ColoredGouraud, Flat, Gouraud, OnScreen, Shader, TexturedFlat, TexturedGouraud},
    texture::{Colors, Nearest, Texture},
};
use serde::{Deserialize, Serialize};

use crate::model::TexelFormat;

/// What decides which surface a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Visibility {
    /// The order of the mesh: no depth buffer, no sorting.
    MeshOrder,
    /// Another order of the tables, which is right in all views: no depth buffer, no sorting.
    FixedOrder,
    /// Parts that planes keep apart, from back to front; each in an order of the tables that is
    /// right in all views: no depth buffer, no sorting.
    PartOrder,
    /// Triangles from back to front, by the distance of their middles: no depth buffer.
    Sorted,
    /// A depth buffer of 16 bits.
    U16,
    /// One of 16 bits with a floating point.
    Float16,
    /// One of 32 bits, which everything is compared with.
    U32,
}

impl Visibility {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::MeshOrder,
        Self::FixedOrder,
        Self::PartOrder,
        Self::Sorted,
        Self::U16,
        Self::Float16,
        Self::U32,
    ];

    /// The type of depths, as Rust.
    pub(super) const fn depth(self) -> &'static str {
        match self {
            Self::MeshOrder | Self::FixedOrder | Self::PartOrder | Self::Sorted => "NoDepth",
            Self::U16 => "u16",
            Self::Float16 => "FloatDepth",
            Self::U32 => "u32",
        }
    }

    /// The farthest depth of a buffer, as Rust.
    pub(super) const fn farthest(self) -> &'static str {
        match self {
            Self::Float16 => "FloatDepth::FAR",
            _ => "0",
        }
    }

    /// The bytes of a pixel's depth.
    #[must_use]
    pub const fn depth_bytes(self) -> u32 {
        match self {
            Self::MeshOrder | Self::FixedOrder | Self::PartOrder | Self::Sorted => 0,
            Self::U16 | Self::Float16 => 2,
            Self::U32 => 4,
        }
    }

    /// Its name in a text.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::MeshOrder => "no depth, mesh order",
            Self::FixedOrder => "no depth, fixed order",
            Self::PartOrder => "no depth, parts by planes",
            Self::Sorted => "no depth, sorted",
            Self::U16 => "16-bit depth",
            Self::Float16 => "16-bit floating depth",
            Self::U32 => "32-bit depth",
        }
    }
}

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

/// What a pixel's colour comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Paint {
    /// The colours of materials.
    Materials,
    /// The colours of vertices.
    Vertices,
    /// Textures.
    Textures(Correction, Texels),
}

/// Where the vertices of a frame are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Vertices {
    /// All in memory.
    Stored,
    /// Each is projected when a triangle needs it.
    OnDemand,
}

/// The types of a renderer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Types {
    /// Whether light is that of the vertices and not of the triangles.
    pub is_smooth: bool,
    /// Where colours come from.
    pub paint: Paint,
    /// What decides which surface is seen.
    pub visibility: Visibility,
    /// Whether the picture is drawn in several bands.
    pub in_bands: bool,
    /// Where vertices are.
    pub vertices: Vertices,
    /// Whether triangles are clipped.
    pub clips: bool,
}

/// What decides which tables of a model are read: whether light is smooth, where colours come from,
/// and which order the triangles have, if it is not the converter's.
pub(super) type Tables = (bool, Paint, Option<Visibility>);

impl Types {
    /// All whose costs are measured; those of [others](super::Costs::of) follow from them.
    #[must_use]
    pub fn all_measured() -> Vec<Self> {
        let all = Self::all();
        let clipped = all.iter().map(|types| Self { clips: true, ..*types });
        all.iter().copied().chain(clipped).filter(Self::is_measured).collect()
    }

    fn is_measured(&self) -> bool {
        if *self != self.same_code() {
            false
        } else if self.clips {
            *self == Self { clips: true, ..self.clipped_model() }
        } else if *self == self.shader_model() {
            let is_other_depth = matches!(self.visibility, Visibility::Float16 | Visibility::U32);
            !is_other_depth || *self == self.whole_and_stored()
        } else {
            *self == self.base() || self.interpolates_nothing()
        }
    }

    /// All without clipping.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for (is_smooth, paint) in Self::shaders() {
            for visibility in Visibility::ALL {
                for in_bands in [false, true] {
                    for vertices in [Vertices::Stored, Vertices::OnDemand] {
                        let clips = false;
                        all.push(Self { is_smooth, paint, visibility, in_bands, vertices, clips });
                    }
                }
            }
        }
        all
    }

    /// The simplest renderer of the same shader, with depth or without.
    pub(super) const fn base(self) -> Self {
        let visibility = match self.visibility {
            Visibility::MeshOrder
            | Visibility::FixedOrder
            | Visibility::PartOrder
            | Visibility::Sorted => Visibility::MeshOrder,
            Visibility::U16 | Visibility::Float16 | Visibility::U32 => Visibility::U16,
        };
        Self { visibility, ..self.whole_and_stored() }
    }

    /// The same code: what differs between orders of the tables is in the tables alone, and what
    /// [parts](super::costs::PartCost) take more is added to it.
    pub(super) const fn same_code(self) -> Self {
        match self.visibility {
            Visibility::FixedOrder | Visibility::PartOrder => {
                Self { visibility: Visibility::MeshOrder, ..self }
            }
            _ => self,
        }
    }

    /// The same of whole pictures with stored vertices, without clipping.
    pub(super) const fn whole_and_stored(self) -> Self {
        Self { in_bands: false, vertices: Vertices::Stored, clips: false, ..self }
    }

    /// The same with the shader that all combinations are measured of.
    pub(super) const fn shader_model(self) -> Self {
        Self { is_smooth: true, paint: Paint::Materials, ..self }
    }

    /// Whether neither depth nor light is interpolated: bands and vertices on demand take less code
    /// then than with any other shader.
    fn interpolates_nothing(&self) -> bool {
        !self.is_smooth
            && self.paint == Paint::Materials
            && self.visibility == Visibility::MeshOrder
    }

    /// The renderer that tells what clipping costs: it depends on how much is interpolated.
    pub(super) const fn clipped_model(self) -> Self {
        let paint = match self.paint {
            Paint::Materials | Paint::Vertices => Paint::Materials,
            Paint::Textures(..) => Paint::Textures(Correction::Adaptive, Texels::Direct),
        };
        Self { is_smooth: true, paint, visibility: Visibility::U16, ..self.whole_and_stored() }
    }

    /// Whether light is smooth, and where colours come from.
    fn shaders() -> Vec<(bool, Paint)> {
        let mut all =
            vec![(false, Paint::Materials), (true, Paint::Materials), (true, Paint::Vertices)];
        for is_smooth in [false, true] {
            for correction in [Correction::Affine, Correction::Adaptive] {
                for texels in Texels::ALL {
                    all.push((is_smooth, Paint::Textures(correction, texels)));
                }
            }
        }
        all
    }

    /// The planes of a triangle that are divided exactly in slivers alone: of depth (that of 32
    /// bits always is), of levels and colours, and of texture coordinates, which are linear on the
    /// screen over what is so thin.
    pub(super) const fn planes(&self) -> u32 {
        let of_depth = match self.visibility {
            Visibility::U16 | Visibility::Float16 => 1,
            _ => 0,
        };
        let of_paint = match self.paint {
            Paint::Materials => 0,
            Paint::Vertices => 3,
            Paint::Textures(..) => 2,
        };
        let of_light = match self.paint {
            // Colours of vertices are lit there.
            Paint::Vertices => 0,
            _ => self.is_smooth as u32,
        };
        of_depth + of_paint + of_light
    }

    /// Which tables they read: how coordinates are corrected makes no difference.
    pub(super) const fn tables(&self) -> Tables {
        let paint = match self.paint {
            Paint::Textures(_, texels) => Paint::Textures(Correction::Adaptive, texels),
            paint => paint,
        };
        let order = match self.visibility {
            Visibility::FixedOrder | Visibility::PartOrder => Some(self.visibility),
            _ => None,
        };
        (self.is_smooth, paint, order)
    }

    /// Bytes of a vertex in memory: x, y, depth, and the varyings of the shader.
    #[must_use]
    pub const fn vertex_bytes(&self, wide_coordinates: bool) -> u32 {
        // Any texture: what is interpolated depends on the width of its coordinates alone.
        type Any = Texture<Colors<'static, Rgb565, 64>, 8, 8>;
        type Skin<M, C> = TexturedFlat<'static, Any, Nearest, M, C>;
        type Lit<M, C> = TexturedGouraud<'static, Any, Nearest, M, C>;
        let bytes = match (self.paint, self.is_smooth, wide_coordinates) {
            (Paint::Materials, false, _) => self.bytes_with::<Flat<Rgb565>>(),
            (Paint::Materials, true, _) => self.bytes_with::<Gouraud<Rgb565>>(),
            (Paint::Vertices, ..) => self.bytes_with::<ColoredGouraud<Rgb565>>(),
            (Paint::Textures(Correction::Affine, _), false, false) => {
                self.bytes_with::<Skin<Affine, i16>>()
            }
            (Paint::Textures(Correction::Affine, _), false, true) => {
                self.bytes_with::<Skin<Affine, i32>>()
            }
            (Paint::Textures(Correction::Affine, _), true, false) => {
                self.bytes_with::<Lit<Affine, i16>>()
            }
            (Paint::Textures(Correction::Affine, _), true, true) => {
                self.bytes_with::<Lit<Affine, i32>>()
            }
            (Paint::Textures(..), false, false) => self.bytes_with::<Skin<Adaptive, i16>>(),
            (Paint::Textures(..), false, true) => self.bytes_with::<Skin<Adaptive, i32>>(),
            (Paint::Textures(..), true, false) => self.bytes_with::<Lit<Adaptive, i16>>(),
            (Paint::Textures(..), true, true) => self.bytes_with::<Lit<Adaptive, i32>>(),
        };
        bytes as u32
    }

    const fn bytes_with<Sh: Shader>(&self) -> usize {
        match self.visibility.depth_bytes() {
            0 => size_of::<ScreenVertex<S4, NoDepth, OnScreen<Sh>>>(),
            2 => size_of::<ScreenVertex<S4, u16, OnScreen<Sh>>>(),
            _ => size_of::<ScreenVertex<S4, u32, OnScreen<Sh>>>(),
        }
    }

    /// The shader's type, for the tables of a name.
    pub(super) fn shader(&self, texture: &str, wide_coordinates: bool) -> String {
        let name = match (self.paint, self.is_smooth) {
            (Paint::Materials, false) => return "Flat<Rgb565>".into(),
            (Paint::Materials, true) => return "Gouraud<Rgb565>".into(),
            (Paint::Vertices, _) => return "ColoredGouraud<Rgb565>".into(),
            (Paint::Textures(..), false) => "TexturedFlat",
            (Paint::Textures(..), true) => "TexturedGouraud",
        };
        let correction = match self.paint {
            Paint::Textures(Correction::Affine, _) => "Affine",
            _ => "Adaptive",
        };
        let wide = if wide_coordinates { ", i32" } else { "" };
        format!("{name}<'static, {texture}, Nearest, {correction}{wide}>")
    }
}

/// A name by its parts, which differs between different types.
impl fmt::Display for Types {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shading = if self.is_smooth { "gouraud" } else { "flat" };
        match self.paint {
            Paint::Materials => write!(f, "{shading}")?,
            Paint::Vertices => write!(f, "colored-{shading}")?,
            Paint::Textures(correction, texels) => {
                let correction = match correction {
                    Correction::Affine => "affine",
                    Correction::Adaptive => "adaptive",
                };
                let texels = match texels {
                    Texels::Direct => "direct",
                    Texels::Indexed8 => "indexed8",
                    Texels::Indexed4 => "indexed4",
                };
                write!(f, "textured-{shading}-{correction}-{texels}")?;
            }
        }
        let visibility = match self.visibility {
            Visibility::MeshOrder => "unordered",
            Visibility::FixedOrder => "fixed-order",
            Visibility::PartOrder => "part-order",
            Visibility::Sorted => "sorted",
            Visibility::U16 => "u16",
            Visibility::Float16 => "float16",
            Visibility::U32 => "u32",
        };
        let target = if self.in_bands { "bands" } else { "whole" };
        let vertices = match self.vertices {
            Vertices::Stored => "stored",
            Vertices::OnDemand => "on-demand",
        };
        let clips = if self.clips { "-clipped" } else { "" };
        write!(f, "-{visibility}-{target}-{vertices}{clips}")
    }
}
