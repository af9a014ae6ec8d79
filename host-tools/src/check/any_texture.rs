//! A texture of the core whose size, borders and filter are chosen at run time.
//!
//! In firmware they are types. Here, one type calls what the chosen ones have; see
//! [`super::any_mode`]. Coordinates are stepped as those of textures of 1,024 texels are, so that
//! every size is right.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    attribute::InverseW,
    color::Alpha,
    texture::{
        Bilinear, Clamp, Colors, CoordinateFormat, Coordinates, Counts, Filter as CoreFilter,
        Footprint, Layer, Levels, LitTexels, MipLevel, Mipmapped, Mirror, Nearest, NearestMip,
        Outcome, Pair, PerTriangle, Place, Quad, Repeat, Side, Texel as CoreTexel, TexelMap,
        Texels, TextureVarying, Trilinear, Wrap as _,
    },
};

use super::Filter;
use crate::reference::{Mipmaps, Texel, Wrap, is_opaque};

/// Texels in the core's numbers, with all mip levels.
#[derive(Clone, Debug)]
pub(super) struct AnyTable {
    texels: Vec<AnyTexel>,
    levels: Levels,
    has_levels: bool,
    wrap: [Wrap; 2],
}

impl AnyTable {
    /// The texels of a texture, with or without mip levels, whose alphas are mixed or tested.
    pub(super) fn new(texture: &Mipmaps, is_translucent: bool) -> Self {
        let base = texture.base();
        let [width, height] = base.size();
        let levels = Levels::new(width, height);
        let texels: Vec<_> = (texture.levels().iter().flat_map(|level| level.texels()))
            .map(|texel| AnyTexel::new(texel, is_translucent))
            .collect();
        let has_levels = texels.len() == levels.texel_count();
        Self { texels, levels, has_levels, wrap: base.wrap() }
    }
}

/// A texel whose kind is chosen at run time: with an alpha that is mixed, as one of
/// [`Translucent`](rasterizer::texture::Translucent), or opaque or not, as one of
/// [`Masked`](rasterizer::texture::Masked).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct AnyTexel {
    layer: Layer<Rgb888>,
    is_mixed: bool,
}

impl AnyTexel {
    fn new(&texel: &Texel, is_mixed: bool) -> Self {
        let [red, green, blue, alpha] = texel.map(|c| c.round() as u8);
        let alpha = match (is_mixed, is_opaque(texel)) {
            (true, _) => Alpha::from_u8(alpha),
            (false, true) => Alpha::OPAQUE,
            (false, false) => Alpha::CLEAR,
        };
        Self { layer: Layer::new(Rgb888::new(red, green, blue), alpha), is_mixed }
    }

    /// As a texel that is opaque or not.
    fn masked(self) -> Option<Rgb888> {
        self.layer.color()
    }
}

impl Outcome<Rgb888> for AnyTexel {
    const DISCARDS: bool = true;
    const HAS_ALPHA: bool = true;

    fn color(self) -> Option<Rgb888> {
        self.layer.color()
    }

    fn layer(self) -> Option<(Rgb888, Alpha)> {
        self.layer.layer()
    }
}

impl CoreTexel<Rgb888> for AnyTexel {
    fn opaque(color: Rgb888) -> Self {
        Self { layer: Layer::opaque(color), is_mixed: true }
    }

    fn recolored(self, change: impl FnOnce(Rgb888) -> Rgb888) -> Self {
        Self { layer: self.layer.recolored(change), ..self }
    }

    fn combined<const N: usize>(
        texels: [Self; N],
        nearest: usize,
        mix: impl FnOnce([Rgb888; N]) -> Rgb888,
        mix_alpha: impl FnOnce([Alpha; N]) -> Alpha,
    ) -> Self {
        if texels.iter().any(|texel| texel.is_mixed) {
            let layers = texels.map(|texel| texel.layer);
            Self { layer: Layer::combined(layers, nearest, mix, mix_alpha), is_mixed: true }
        } else {
            let mixed = Option::combined(texels.map(Self::masked), nearest, mix, mix_alpha);
            let clear = Layer::new(Rgb888::BLACK, Alpha::CLEAR);
            Self { layer: mixed.map_or(clear, Layer::opaque), is_mixed: false }
        }
    }
}

/// Texels whose number is known at run time.
#[derive(Clone, Copy, Debug)]
pub(super) struct AnyTexels<'a>(&'a [AnyTexel]);

impl Texels for AnyTexels<'_> {
    type Color = Rgb888;
    type Texel = AnyTexel;

    fn counts(&self) -> Counts {
        Counts::exactly(self.0.len())
    }

    fn texel(&self, index: usize) -> AnyTexel {
        self.0[index]
    }
}

/// Lit like all texels of this colour.
type Lit = Colors<'static, Rgb888, 1>;

impl LitTexels for AnyTexels<'_> {
    type Light = <Lit as LitTexels>::Light;

    fn varying(level: u32) -> u16 {
        Lit::varying(level)
    }

    fn light(varying: u32) -> Self::Light {
        Lit::light(varying)
    }

    fn before_light(&self, index: usize, _: Self::Light) -> AnyTexel {
        self.texel(index)
    }

    fn after_light(color: Rgb888, light: Self::Light) -> Rgb888 {
        Lit::after_light(color, light)
    }

    fn plain(color: Rgb888, light: Self::Light) -> Rgb888 {
        Lit::plain(color, light)
    }
}

/// A texture, and how it is filtered.
#[derive(Clone, Copy, Debug)]
pub(super) struct AnyTexture<'a> {
    table: &'a AnyTable,
    texels: AnyTexels<'a>,
    filter: Filter,
}

impl<'a> AnyTexture<'a> {
    /// Of a texture without mip levels, a filter that reads them takes the texture itself.
    pub(super) fn new(table: &'a AnyTable, filter: Filter) -> Self {
        let filter = match filter {
            Filter::Mipmap if !table.has_levels => Filter::Nearest,
            Filter::Trilinear if !table.has_levels => Filter::Bilinear,
            filter => filter,
        };
        Self { table, texels: AnyTexels(&table.texels), filter }
    }
}

/// The longest side: its steps are the finest.
const SIDE: usize = 1_024;

impl<'a> TexelMap for AnyTexture<'a> {
    type Texels = AnyTexels<'a>;
    type Place = Place<SIDE, SIDE, Clamp, Clamp>;
    type Coordinates<C: CoordinateFormat> = Coordinates<C, SIDE, SIDE, Clamp, Clamp>;

    fn texels(&self) -> &Self::Texels {
        &self.texels
    }

    fn nearest(&self, place: Self::Place) -> usize {
        self.nearest_in(place, 0)
    }

    fn bilinear(&self, place: Self::Place, bits: u32) -> Quad {
        self.bilinear_in(place, bits, 0)
    }
}

impl Mipmapped for AnyTexture<'_> {
    fn levels(&self) -> &Levels {
        &self.table.levels
    }

    fn nearest_in(&self, place: Self::Place, level: u32) -> usize {
        let grid = self.table.levels.grid(level);
        let ([u, v], [x, y]) = (place.uv(), self.table.wrap);
        let (column, row) = (texel(x, u, grid.width), texel(y, v, grid.height));
        grid.first as usize + row * grid.width.length() + column
    }

    fn bilinear_in(&self, place: Self::Place, bits: u32, level: u32) -> Quad {
        let grid = self.table.levels.grid(level);
        let ([u, v], [x, y]) = (place.uv(), self.table.wrap);
        let (across, down) = (pair(x, u, grid.width, bits), pair(y, v, grid.height, bits));
        let number = |i: usize| {
            let (column, row) = (across.texels[i % 2], down.texels[i / 2]);
            grid.first as usize + row * grid.width.length() + column
        };
        Quad { texels: [0, 1, 2, 3].map(number), fractions: [across.fraction, down.fraction] }
    }
}

fn texel(wrap: Wrap, coordinate: i32, side: Side) -> usize {
    match wrap {
        Wrap::Repeat => Repeat::texel(coordinate, side),
        Wrap::Mirror => Mirror::texel(coordinate, side),
        Wrap::Clamp => Clamp::texel(coordinate, side),
    }
}

fn pair(wrap: Wrap, coordinate: i32, side: Side, bits: u32) -> Pair {
    match wrap {
        Wrap::Repeat => Repeat::pair(coordinate, side, bits),
        Wrap::Mirror => Mirror::pair(coordinate, side, bits),
        Wrap::Clamp => Clamp::pair(coordinate, side, bits),
    }
}

/// The filter that a texture names; mip levels are chosen for a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct AnyFilter;

impl CoreFilter<AnyTexture<'_>> for AnyFilter {
    type Coordinates<V: TextureVarying> = V;
    /// Of filters that read no levels, none.
    type Face = MipLevel;

    fn face(map: &AnyTexture<'_>, footprint: impl FnOnce() -> Footprint) -> MipLevel {
        match map.filter {
            Filter::Nearest | Filter::Bilinear => MipLevel::default(),
            Filter::Mipmap => NearestMip::<PerTriangle>::face(map, footprint),
            Filter::Trilinear => Trilinear::<PerTriangle>::face(map, footprint),
        }
    }

    fn sample(
        map: &AnyTexture<'_>,
        level: &MipLevel,
        place: Place<SIDE, SIDE, Clamp, Clamp>,
        inverse_w: InverseW,
        fetch: impl Fn(usize) -> AnyTexel,
    ) -> AnyTexel {
        sample(map, level, place, inverse_w, &fetch)
    }
}

/// The texel by the filter that a texture names: one function for all scenes.
fn sample(
    map: &AnyTexture<'_>,
    level: &MipLevel,
    place: Place<SIDE, SIDE, Clamp, Clamp>,
    inverse_w: InverseW,
    fetch: &dyn Fn(usize) -> AnyTexel,
) -> AnyTexel {
    match map.filter {
        Filter::Nearest => Nearest::sample(map, &(), place, inverse_w, fetch),
        Filter::Bilinear => Bilinear::sample(map, &(), place, inverse_w, fetch),
        Filter::Mipmap => NearestMip::<PerTriangle>::sample(map, level, place, inverse_w, fetch),
        Filter::Trilinear => Trilinear::<PerTriangle>::sample(map, level, place, inverse_w, fetch),
    }
}
