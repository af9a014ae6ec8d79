//! The types of a renderer: what decides its code.

use std::fmt;

use embedded_graphics_core::pixelcolor::Rgb565;
use rasterizer::{
    attribute::{Adaptive, Affine, NoDepth},
    geometry::ScreenVertex,
    numbers::S4,
    shade::{ColoredGouraud, Flat, Gouraud, OnScreen, Shader, TexturedFlat, TexturedGouraud},
    texture::{Colors, Mipmaps, Nearest, NearestMip, PerPixel},
};
use serde::{Deserialize, Serialize};

use super::{Correction, Filter, LevelChoice, Paint, Texels};

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
        } else if let Some([.., with]) = self.filter_steps() {
            *self == with
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
            Paint::Textures(..) => {
                Paint::Textures(Correction::Adaptive, Texels::Direct, Filter::NEAREST)
            }
        };
        Self { is_smooth: true, paint, visibility: Visibility::U16, ..self.whole_and_stored() }
    }

    /// For another filter than the nearest texel: the same types with a simpler one, and two
    /// renderers that differ as they do. Four texels are found in four places, each through its
    /// palette; a mip level takes the same time for all texels.
    pub(super) fn filter_steps(self) -> Option<[Self; 3]> {
        let Paint::Textures(correction, texels, filter) = self.paint else { return None };
        let with = |texels, filter| Self {
            is_smooth: true,
            paint: Paint::Textures(correction, texels, filter),
            ..self.base()
        };
        let (simpler, texels, added) = if filter.mip_levels.is_some() {
            let simpler = Filter { mip_levels: None, ..filter };
            (simpler, Texels::Direct, Filter { is_bilinear: false, ..filter })
        } else if filter.is_bilinear {
            (Filter::NEAREST, texels, filter)
        } else {
            return None;
        };
        let simpler = Self { paint: self.paint.filtered(simpler), ..self };
        Some([simpler, with(texels, Filter::NEAREST), with(texels, added)])
    }

    /// Whether light is smooth, and where colours come from.
    fn shaders() -> Vec<(bool, Paint)> {
        let mut all =
            vec![(false, Paint::Materials), (true, Paint::Materials), (true, Paint::Vertices)];
        for is_smooth in [false, true] {
            for correction in [Correction::Affine, Correction::Adaptive] {
                for texels in Texels::ALL {
                    for filter in Filter::all(correction) {
                        all.push((is_smooth, Paint::Textures(correction, texels, filter)));
                    }
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

    /// Which tables they read: of corrections and filters, only whether there are mip levels makes
    /// a difference.
    pub(super) const fn tables(&self) -> Tables {
        let paint = match self.paint {
            Paint::Textures(_, texels, Filter { mip_levels, .. }) => {
                let mip_levels =
                    if mip_levels.is_some() { Some(LevelChoice::PerTriangle) } else { None };
                let filter = Filter { is_bilinear: false, mip_levels };
                Paint::Textures(Correction::Adaptive, texels, filter)
            }
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
        // Any texture: what is interpolated depends on the width of its coordinates and on where a
        // mip level is chosen.
        type Any = Mipmaps<Colors<'static, Rgb565, 1>, 1, 1>;
        type Skin<F, M, C> = TexturedFlat<'static, Any, F, M, C>;
        type Lit<F, M, C> = TexturedGouraud<'static, Any, F, M, C>;
        macro_rules! textured {
            ($filter:ty, $mode:ty) => {
                match (self.is_smooth, wide_coordinates) {
                    (false, false) => self.bytes_with::<Skin<$filter, $mode, i16>>(),
                    (false, true) => self.bytes_with::<Skin<$filter, $mode, i32>>(),
                    (true, false) => self.bytes_with::<Lit<$filter, $mode, i16>>(),
                    (true, true) => self.bytes_with::<Lit<$filter, $mode, i32>>(),
                }
            };
        }
        const PER_PIXEL: Option<LevelChoice> = Some(LevelChoice::PerPixel);
        let bytes = match (self.paint, self.is_smooth) {
            (Paint::Materials, false) => self.bytes_with::<Flat<Rgb565>>(),
            (Paint::Materials, true) => self.bytes_with::<Gouraud<Rgb565>>(),
            (Paint::Vertices, _) => self.bytes_with::<ColoredGouraud<Rgb565>>(),
            (Paint::Textures(_, _, Filter { mip_levels: PER_PIXEL, .. }), _) => {
                textured!(NearestMip<PerPixel>, Adaptive)
            }
            (Paint::Textures(Correction::Affine, ..), _) => textured!(Nearest, Affine),
            (Paint::Textures(Correction::Adaptive, ..), _) => textured!(Nearest, Adaptive),
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
        let Paint::Textures(correction, _, filter) = self.paint else {
            return match (self.paint, self.is_smooth) {
                (Paint::Vertices, _) => "ColoredGouraud<Rgb565>",
                (_, false) => "Flat<Rgb565>",
                (_, true) => "Gouraud<Rgb565>",
            }
            .into();
        };
        let name = if self.is_smooth { "TexturedGouraud" } else { "TexturedFlat" };
        let correction = match correction {
            Correction::Affine => "Affine",
            Correction::Adaptive => "Adaptive",
        };
        let filter = match filter.types() {
            [filter, level] => format!("{filter}<{level}>"),
            other => other.concat(),
        };
        let wide = if wide_coordinates { ", i32" } else { "" };
        format!("{name}<'static, {texture}, {filter}, {correction}{wide}>")
    }
}

/// A name by its parts, which differs between different types.
impl fmt::Display for Types {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shading = if self.is_smooth { "gouraud" } else { "flat" };
        match self.paint {
            Paint::Materials => write!(f, "{shading}")?,
            Paint::Vertices => write!(f, "colored-{shading}")?,
            paint @ Paint::Textures(..) => write!(f, "textured-{shading}{paint}")?,
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
