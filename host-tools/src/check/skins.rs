//! The textures of a model's materials, for the core and for the reference.

use super::{
    Filter,
    any_texture::{AnyTable, AnyTexture},
    places::FaceColors,
    surface::Surface,
};
use crate::{
    model::{self, AlphaFormat, Model, TextureWrap, Textures},
    reference::{Mipmaps, Texel, Texture, Wrap},
};

/// What each material looks like.
#[derive(Debug, Default)]
pub(super) struct Skins {
    /// For the reference: the texture, or one texel of the material's colour.
    pub(super) textures: Vec<Mipmaps>,
    /// Whether texels have an alpha that is mixed, and not one that is tested.
    pub(super) is_translucent: bool,
    /// For the core: the texture, if there is one.
    tables: Vec<Option<AnyTable>>,
    /// The material of each triangle of the tables.
    pub(super) materials: Vec<usize>,
    /// The material of each triangle of the file.
    pub(super) file_materials: Vec<usize>,
}

impl Skins {
    /// With the textures of the materials.
    pub(super) fn new(
        model: &Model,
        surface: &Surface,
        by_material: impl IntoIterator<Item = Option<Mipmaps>>,
    ) -> Self {
        let is_translucent = (model.textures.as_ref())
            .and_then(|textures| textures.alpha)
            .is_some_and(AlphaFormat::is_translucent);
        let (mut textures, mut tables) = (Vec::new(), Vec::new());
        for (material, texture) in model.materials.iter().zip(by_material) {
            tables.push(texture.as_ref().map(|texture| AnyTable::new(texture, is_translucent)));
            textures.push(texture.unwrap_or_else(|| plain(material.color)));
        }
        let run = |(number, material): (usize, &rasterizer::mesh::Material)| {
            std::iter::repeat_n(number, material.triangle_count as usize)
        };
        let faces = &model.exact.faces.faces;
        Self {
            textures,
            is_translucent,
            tables,
            materials: model.materials.iter().enumerate().flat_map(run).collect(),
            file_materials: surface.faces.iter().map(|&face| faces[face].material).collect(),
        }
    }

    /// The core's textures with a filter.
    pub(super) fn filtered(&self, filter: Filter) -> Vec<Option<AnyTexture<'_>>> {
        let filtered = |table| AnyTexture::new(table, filter);
        self.tables.iter().map(|table| table.as_ref().map(filtered)).collect()
    }

    /// The colours that a face with a material may have; `None` if its texture has holes.
    pub(super) fn colors(&self, material: usize, levels: [f64; 2]) -> Option<FaceColors> {
        let texture = &self.textures[material];
        let texels = || texture.levels().iter().flat_map(Texture::texels);
        let bound = |channel: usize, start: f64, least: fn(f64, f64) -> f64| {
            texels().map(|texel| texel[channel]).fold(start, least)
        };
        texture.is_opaque().then(|| FaceColors {
            range: [
                [0, 1, 2].map(|channel| bound(channel, 255.0, f64::min)),
                [0, 1, 2].map(|channel| bound(channel, 0.0, f64::max)),
            ],
            levels,
        })
    }
}

/// The textures of a model by its materials, in whole steps of 8 bits, as the core draws them.
pub(super) fn of_materials(model: &Model) -> Vec<Option<Mipmaps>> {
    let Some(textures) = &model.textures else {
        return vec![None; model.materials.len()];
    };
    let all: Vec<_> =
        textures.textures.iter().map(|texture| of_texture(textures, texture)).collect();
    textures.by_material.iter().map(|place| Some(all[(*place)?].clone())).collect()
}

/// A texture with its levels.
fn of_texture(textures: &Textures, texture: &model::Texture) -> Mipmaps {
    let wrap = textures.wrap.map(|wrap| match wrap {
        TextureWrap::Repeat => Wrap::Repeat,
        TextureWrap::Clamp => Wrap::Clamp,
    });
    let mut first = 0;
    let level = |size: [usize; 2]| {
        let texels = first..first + size[0] * size[1];
        first = texels.end;
        let stored = |texel| texture.rgba(texel).map(f64::round);
        Texture::new(size, wrap, texels.map(stored).collect())
    };
    Mipmaps::new(textures.levels().into_iter().map(level).collect())
}

/// One texel of a colour.
fn plain([red, green, blue]: [u8; 3]) -> Mipmaps {
    let texel: Texel = [red, green, blue, u8::MAX].map(f64::from);
    Mipmaps::new(vec![Texture::new([1, 1], [Wrap::Clamp; 2], vec![texel])])
}
