//! A texture, lit at the vertices.

use core::marker::PhantomData;

use embedded_graphics_core::pixelcolor::Rgb888;

use super::{
    super::{CodeSize, Face, Light, Lighting, OnScreen, Sample, Shader, lighting::vertex_level},
    skin::{ColorOf, Covered, FaceOf, Skin, Slot, TexelOf, TexelsOf, Varying, VertexCoordinates},
};
use crate::{
    attribute::{Adaptive, Affine, Correction, PerspectiveCorrect},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
    texture::{Filter, LitTexels, Nearest, Texel as _, TexelMap},
};

/// The material's texture, lit at the vertices: each channel of a texel times the interpolated
/// level of light, rounded to the nearest, in the levels of
/// [`Mix::lit`](crate::texture::Mix::lit) or the rows of [`Shaded`](crate::texture::Shaded).
///
/// The first types are those of [`Textured`](super::Textured); `L` is how the level of light is
/// corrected, and `G` the kind of light. Needs
/// [`texture_coordinates`](crate::mesh::Tables::texture_coordinates) and
/// [`vertex_normals`](crate::mesh::Tables::vertex_normals). A material without a texture has its
/// colour in this light.
#[derive(Clone, Copy, Debug)]
pub struct TexturedGouraud<'a, S, F = Nearest, M = Adaptive, C = i16, L = Affine, G = Light> {
    skin: Skin<'a, S, F, M, C>,
    light: G,
    level: PhantomData<L>,
}

impl<'a, S, G: Copy> TexturedGouraud<'a, S, Nearest, Adaptive, i16, Affine, G> {
    /// With the textures of a mesh by its materials, lit by `light`: nearest texels, corrected
    /// within half a texel, coordinates of 16 bits.
    #[must_use]
    pub const fn new<const N: usize>(textures: &'a [S; N], light: G) -> Self {
        Self { skin: Skin::new(textures), light, level: PhantomData }
    }

    /// The same with textures whose number is known at run time; `None` without any.
    #[must_use]
    pub const fn from_slice(textures: &'a [S], light: G) -> Option<Self> {
        match Skin::from_slice(textures) {
            Some(skin) => Some(Self { skin, light, level: PhantomData }),
            None => None,
        }
    }
}

impl<'a, S, F, M, C, L, G: Copy> TexturedGouraud<'a, S, F, M, C, L, G> {
    /// Filtered in another way, such as [`Bilinear`](crate::texture::Bilinear).
    #[must_use]
    pub const fn filtered<N: Copy>(self, _: N) -> TexturedGouraud<'a, S, N, M, C, L, G> {
        self.chosen()
    }

    /// Corrected in another way, such as [`EveryPixel`](crate::attribute::EveryPixel).
    #[must_use]
    pub const fn corrected<N: Correction>(self, _: N) -> TexturedGouraud<'a, S, F, N, C, L, G> {
        self.chosen()
    }

    /// For meshes whose texture coordinates have any format, with 32 bits a vertex each.
    #[must_use]
    pub const fn with_wide_coordinates(self) -> TexturedGouraud<'a, S, F, M, i32, L, G> {
        self.chosen()
    }

    /// With the level of light corrected in another way than by straight lines on the screen.
    #[must_use]
    pub const fn with_level<K: Correction>(self, _: K) -> TexturedGouraud<'a, S, F, M, C, K, G> {
        self.chosen()
    }

    const fn chosen<E, N, D, K>(self) -> TexturedGouraud<'a, S, E, N, D, K, G> {
        TexturedGouraud { skin: self.skin.chosen(), light: self.light, level: PhantomData }
    }
}

impl<S, F, M, C, L, G> Shader for TexturedGouraud<'_, S, F, M, C, L, G>
where
    S: Slot<Texture: TexelMap<Texels: LitTexels>>,
    ColorOf<S>: From<Rgb888>,
    F: Filter<S::Texture>,
    M: Correction,
    C: VertexCoordinates,
    L: Correction,
    G: Lighting,
{
    type Color = ColorOf<S>;
    /// The coordinates, and the level of light.
    type Varyings = (Varying<S, F, M, C>, PerspectiveCorrect<u16, L>);
    type Surface = Covered<S, ColorOf<S>>;
    type Face = FaceOf<S, F>;
    type Outcome = TexelOf<S>;

    const CODE: CodeSize = F::CODE.max(CodeSize::Medium);

    const TABLES: RequiredTables = RequiredTables { vertex_normals: true, ..C::TABLES };

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self { light: self.light.for_view(view), ..*self }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        self.skin.surface(material, material.rgb().into())
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        let level = vertex_level(&self.light, vertex);
        let level = PerspectiveCorrect::new(TexelsOf::<S>::varying(level));
        (Skin::<S, F, M, C>::vertex(vertex), level)
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Self::Surface,
        _: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<ColorOf<S>, FaceOf<S, F>> {
        Face::Shaded(surface.slot.texture_or(
            |texture| Skin::<S, F, M, C>::face(texture, gradients, |(coordinates, _)| coordinates),
            FaceOf::<S, F>::default,
        ))
    }

    #[inline(always)]
    fn pixel(
        &self,
        surface: &Self::Surface,
        face: &Self::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> TexelOf<S> {
        self.pixels(surface, *face)(fragment)
    }

    #[inline(always)]
    fn pixels(
        &self,
        surface: &Self::Surface,
        face: Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> TexelOf<S> + Copy {
        let Covered { slot, color } = *surface;
        move |fragment| {
            let (place, level) = fragment.varyings;
            let light = TexelsOf::<S>::light(level.value.to_bits());
            slot.texture_or(
                |texture| Skin::<S, F, M, C>::lit_texel(texture, &face, place, light),
                || TexelOf::<S>::opaque(TexelsOf::<S>::plain(color, light)),
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::Gray8;

    use super::{
        super::{
            super::Level,
            skin::square::{GRAY, drawn},
        },
        *,
    };
    use crate::{
        attribute::EveryPixel,
        numbers::Vec3,
        texture::{Bilinear, Colors, Texture},
    };

    const HALF: Light = Light::new(Vec3::Z, Level::lit("0.25"), Level::lit("0.25"));

    const TEXELS: [Gray8; 4] = [Gray8::new(0), Gray8::new(100), Gray8::new(201), Gray8::new(255)];

    #[test]
    fn channels_are_multiplied_by_the_level() {
        let map: Texture<Colors<'_, Gray8, 4>, 2, 2> = Texture::new(Colors::new(&TEXELS));
        let textures = [Some(map)];
        let shader = TexturedGouraud::new(&textures, HALF);
        for rows in [
            drawn(&shader, false),
            drawn(&shader.corrected(EveryPixel).with_level(EveryPixel), false),
            drawn(&shader.with_wide_coordinates(), true),
        ] {
            let rows = rows.unwrap();
            let quarters = [rows[1][1], rows[1][6], rows[6][1], rows[6][6]];
            assert_eq!(quarters, [0, 50, 101, 128]);
        }
        let full = Light::new(Vec3::Z, Level::ONE, Level::ZERO);
        let rows = drawn(&TexturedGouraud::new(&textures, full), false).unwrap();
        assert_eq!([rows[0][0], rows[0][7], rows[7][0], rows[7][7]], [0, 100, 201, 255]);
    }

    #[test]
    fn bare_materials_are_lit() {
        let bare: [Option<Texture<Colors<'_, Gray8, 4>, 2, 2>>; 1] = [None];
        let shader = TexturedGouraud::new(&bare, HALF).filtered(Bilinear);
        let rows = drawn(&shader, false).unwrap();
        assert!(rows.iter().flatten().all(|&pixel| pixel == GRAY / 2), "{rows:?}");
    }
}
