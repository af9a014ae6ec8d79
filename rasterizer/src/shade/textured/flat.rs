//! A texture, lit by the normal of the triangle.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::{
    super::{
        CodeSize, Face, Light, Lighting, OnScreen, Sample, Shader, flat::scaled_color,
        lighting::face_level,
    },
    skin::{
        ColorOf, Covered, FaceOf, LightOf, Skin, Slot, TexelOf, TexelsOf, Varying,
        VertexCoordinates, bare,
    },
};
use crate::{
    attribute::{Adaptive, Correction},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
    texture::{Filter, LitTexels, Nearest, TexelMap},
};

/// The material's texture, lit by the normal of the triangle: each channel of a texel times the
/// level of light, rounded to the nearest, in the levels of [`Mix::lit`](crate::texture::Mix::lit)
/// or the rows of [`Shaded`](crate::texture::Shaded).
///
/// The types are those of [`Textured`](super::Textured). Needs
/// [`texture_coordinates`](crate::mesh::Tables::texture_coordinates) and
/// [`face_normals`](crate::mesh::Tables::face_normals). A material without a texture is drawn like
/// [`Flat`](crate::shade::Flat).
#[derive(Clone, Copy, Debug)]
pub struct TexturedFlat<'a, S, F = Nearest, M = Adaptive, C = i16, L = Light> {
    skin: Skin<'a, S, F, M, C>,
    light: L,
}

impl<'a, S, L: Copy> TexturedFlat<'a, S, Nearest, Adaptive, i16, L> {
    /// With the textures of a mesh by its materials, lit by `light`: nearest texels, corrected
    /// within half a texel, coordinates of 16 bits.
    #[must_use]
    pub const fn new<const N: usize>(textures: &'a [S; N], light: L) -> Self {
        Self { skin: Skin::new(textures), light }
    }

    /// The same with textures whose number is known at run time; `None` without any.
    #[must_use]
    pub const fn from_slice(textures: &'a [S], light: L) -> Option<Self> {
        match Skin::from_slice(textures) {
            Some(skin) => Some(Self { skin, light }),
            None => None,
        }
    }
}

impl<'a, S, F, M, C, L: Copy> TexturedFlat<'a, S, F, M, C, L> {
    /// Filtered in another way, such as [`Bilinear`](crate::texture::Bilinear).
    #[must_use]
    pub const fn filtered<G: Copy>(self, _: G) -> TexturedFlat<'a, S, G, M, C, L> {
        self.chosen()
    }

    /// Corrected in another way, such as [`EveryPixel`](crate::attribute::EveryPixel).
    #[must_use]
    pub const fn corrected<N: Correction>(self, _: N) -> TexturedFlat<'a, S, F, N, C, L> {
        self.chosen()
    }

    /// For meshes whose texture coordinates have any format, with 32 bits a vertex each.
    #[must_use]
    pub const fn with_wide_coordinates(self) -> TexturedFlat<'a, S, F, M, i32, L> {
        self.chosen()
    }

    const fn chosen<G, N, D>(self) -> TexturedFlat<'a, S, G, N, D, L> {
        TexturedFlat { skin: self.skin.chosen(), light: self.light }
    }
}

impl<S, F, M, C, L> Shader for TexturedFlat<'_, S, F, M, C, L>
where
    S: Slot<Texture: TexelMap<Texels: LitTexels>>,
    ColorOf<S>: From<Rgb888>,
    F: Filter<S::Texture>,
    M: Correction,
    C: VertexCoordinates,
    L: Lighting,
{
    type Color = ColorOf<S>;
    type Varyings = Varying<S, F, M, C>;
    type Surface = Covered<S, Rgb888>;
    type Face = (FaceOf<S, F>, LightOf<S>);
    type Outcome = TexelOf<S>;

    const CODE: CodeSize = F::CODE.max(CodeSize::Medium);

    const TABLES: RequiredTables = RequiredTables { face_normals: true, ..C::TABLES };

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self { light: self.light.for_view(view), ..*self }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        self.skin.surface(material, material.rgb())
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        Skin::<S, F, M, C>::vertex(vertex)
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Self::Surface,
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<ColorOf<S>, Self::Face> {
        let level = face_level(&self.light, face);
        surface.slot.texture_or(
            |texture| {
                let filtered = Skin::<S, F, M, C>::face(texture, gradients, |corner| corner);
                let varying = u32::from(TexelsOf::<S>::varying(level)) << 16;
                Face::Shaded((filtered, TexelsOf::<S>::light(varying)))
            },
            || Face::Solid(scaled_color(surface.color, level)),
        )
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
        (face, light): Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> TexelOf<S> + Copy {
        let Covered { slot, color } = *surface;
        move |fragment| {
            slot.texture_or(
                |texture| Skin::<S, F, M, C>::lit_texel(texture, &face, fragment.varyings, light),
                || bare(color),
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
            skin::square::{GRAY, SIDE, drawn},
        },
        *,
    };
    use crate::{
        numbers::Vec3,
        texture::{Bilinear, Colors, Keyed, SHADES, Shaded, Texture},
    };

    /// Half of all light from the viewer's side.
    const HALF: Light = Light::new(Vec3::Z, Level::lit("0.25"), Level::lit("0.25"));

    const TEXELS: [Gray8; 4] = [Gray8::new(0), Gray8::new(100), Gray8::new(201), Gray8::new(255)];

    /// The pixels in the middle of each quarter of the picture.
    fn quarters(rows: &[[u8; SIDE]]) -> [u8; 4] {
        [rows[1][1], rows[1][6], rows[6][1], rows[6][6]]
    }

    #[test]
    fn channels_are_multiplied_by_the_level() {
        let map: Texture<Colors<'_, Gray8, 4>, 2, 2> = Texture::new(Colors::new(&TEXELS));
        let textures = [Some(map)];
        let shader = TexturedFlat::new(&textures, HALF);
        let rows = drawn(&shader, false).unwrap();
        assert_eq!(quarters(&rows), [0, 50, 101, 128]);
        // The mean of all four on the corner that they share, 139, halved.
        let rows = drawn(&shader.filtered(Bilinear), false).unwrap();
        let middle = [rows[3][3], rows[3][4], rows[4][3], rows[4][4]].map(u32::from);
        assert!(middle.iter().sum::<u32>().abs_diff(4 * 139 / 2) <= 2, "{middle:?}");
        let dark = Light::new(Vec3::Z, Level::ZERO, Level::ZERO);
        let rows = drawn(&TexturedFlat::new(&textures, dark), false).unwrap();
        assert!(rows.iter().flatten().all(|&pixel| pixel == 0));
    }

    #[test]
    fn a_table_lights_by_its_rows() {
        const ROWS: [[Gray8; 4]; SHADES] = {
            let mut rows = [[Gray8::new(0); 4]; SHADES];
            let mut i = 0;
            while i < 4 * SHADES {
                rows[i / 4][i % 4] = Gray8::new(i as u8);
                i += 1;
            }
            rows
        };
        let map: Texture<Shaded<'_, Gray8, 2, 1, 4>, 2, 2> =
            Texture::new(Shaded::new(&[0b00_01_10_11], &ROWS));
        // Half of 31, rounded, is row 16, or 15 for a level just below.
        let rows = drawn(&TexturedFlat::new(&[Some(map)], HALF), false).unwrap();
        let [first, ..] = quarters(&rows);
        let row = first & !3;
        assert!(row == 4 * 15 || row == 4 * 16, "{row}");
        assert_eq!(quarters(&rows), [3, 2, 1, 0].map(|place| row + place));
    }

    #[test]
    fn holes_stay_and_bare_materials_are_lit() {
        let keyed = Keyed::new(Colors::new(&TEXELS), Gray8::new(201));
        let map: Texture<Keyed<Colors<'_, Gray8, 4>>, 2, 2> = Texture::new(keyed);
        let rows = drawn(&TexturedFlat::new(&[Some(map)], HALF), false).unwrap();
        assert_eq!(quarters(&rows), [0, 50, 1, 128]);
        let bare = [None; 1].map(|none: Option<()>| none.map(|()| map));
        let rows = drawn(&TexturedFlat::new(&bare, HALF), false).unwrap();
        assert!(rows.iter().flatten().all(|&pixel| pixel == GRAY / 2), "{rows:?}");
    }
}
