//! A texture, without light or with it.

mod flat;
mod gouraud;
mod matcap;
mod skin;

use embedded_graphics_core::pixelcolor::Rgb888;

#[cfg(test)]
pub(super) use self::skin::square;
use self::skin::{ColorOf, FaceOf, Skin, TexelOf, Varying};
pub use self::{
    flat::TexturedFlat,
    gouraud::TexturedGouraud,
    matcap::Matcap,
    skin::{Covered, Slot, VertexCoordinates},
};
use super::{CodeSize, Face, OnScreen, Sample, Shader};
use crate::{
    attribute::{Adaptive, Correction},
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
    texture::{Filter, Nearest},
};

/// The material's texture, unlit.
///
/// `S` is the type of the textures ([`Slot`]): [`Texture`](crate::texture::Texture) or another
/// [`TexelMap`](crate::texture::TexelMap), or an `Option` of one; `F` the [`Filter`], `M` how
/// perspective is corrected ([`Correction`]), and `C` the format of the mesh's texture coordinates,
/// `i16` or `i32`. Needs [`texture_coordinates`](crate::mesh::Tables::texture_coordinates).
///
/// A material without a texture has its colour. One beyond the table has the first texture, so that
/// one is enough for all.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// use rasterizer::{
///     attribute::EveryPixel,
///     shade::Textured,
///     texture::{Bilinear, Colors, Texture},
/// };
///
/// type Checks = Texture<Colors<'static, Rgb565, 4>, 2, 2>;
/// static CHECKS: [Option<Checks>; 1] = {
///     const WHITE: Rgb565 = Rgb565::WHITE;
///     const BLUE: Rgb565 = Rgb565::BLUE;
///     [Some(Texture::new(Colors::new(&[WHITE, BLUE, BLUE, WHITE])))]
/// };
///
/// let nearest = Textured::new(&CHECKS);
/// let smooth = Textured::new(&CHECKS).filtered(Bilinear).corrected(EveryPixel);
/// # let _ = (nearest, smooth);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Textured<'a, S, F = Nearest, M = Adaptive, C = i16>(Skin<'a, S, F, M, C>);

impl<'a, S> Textured<'a, S> {
    /// With the textures of a mesh by its materials: nearest texels, corrected within half a texel,
    /// coordinates of 16 bits.
    #[must_use]
    pub const fn new<const N: usize>(textures: &'a [S; N]) -> Self {
        Self(Skin::new(textures))
    }

    /// The same with textures whose number is known at run time; `None` without any.
    #[must_use]
    pub const fn from_slice(textures: &'a [S]) -> Option<Self> {
        match Skin::from_slice(textures) {
            Some(skin) => Some(Self(skin)),
            None => None,
        }
    }
}

impl<'a, S, F, M, C> Textured<'a, S, F, M, C> {
    /// Filtered in another way, such as [`Bilinear`](crate::texture::Bilinear).
    #[must_use]
    pub const fn filtered<G: Copy>(self, _: G) -> Textured<'a, S, G, M, C> {
        Textured(self.0.chosen())
    }

    /// Corrected in another way, such as [`EveryPixel`](crate::attribute::EveryPixel).
    #[must_use]
    pub const fn corrected<N: Correction>(self, _: N) -> Textured<'a, S, F, N, C> {
        Textured(self.0.chosen())
    }

    /// For meshes whose texture coordinates have any format, with 32 bits a vertex each.
    #[must_use]
    pub const fn with_wide_coordinates(self) -> Textured<'a, S, F, M, i32> {
        Textured(self.0.chosen())
    }
}

impl<S, F, M, C> Shader for Textured<'_, S, F, M, C>
where
    S: Slot,
    ColorOf<S>: From<Rgb888>,
    F: Filter<S::Texture>,
    M: Correction,
    C: VertexCoordinates,
{
    type Color = ColorOf<S>;
    type Varyings = Varying<S, F, M, C>;
    type Surface = Covered<S, ColorOf<S>>;
    type Face = FaceOf<S, F>;
    type Outcome = TexelOf<S>;

    const CODE: CodeSize = F::CODE;

    const TABLES: RequiredTables = C::TABLES;

    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        self.0.surface(material, material.rgb().into())
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        Skin::<S, F, M, C>::vertex(vertex)
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Self::Surface,
        _: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<ColorOf<S>, FaceOf<S, F>> {
        Skin::<S, F, M, C>::plain_face(surface, gradients)
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
        Skin::<S, F, M, C>::plain_pixels(surface, face)
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::Gray8;

    use super::{
        skin::square::{GRAY, SIDE, drawn},
        *,
    };
    use crate::{
        attribute::{Affine, Every, EveryPixel},
        scene::ProjectError,
        texture::{
            Bilinear, Clamp, ColorSlice, Colors, DynamicTexture, Indexed, Keyed, Mipmaps,
            NearestMip, PerPixel, PerTriangle, Repeat, Texture, Trilinear, Wrap,
        },
    };

    /// Grey 16 i is texel i.
    const GRAYS: [Gray8; 16] = {
        let mut grays = [Gray8::new(0); 16];
        let mut i = 0;
        while i < 16 {
            grays[i] = Gray8::new(16 * i as u8);
            i += 1;
        }
        grays
    };

    const PLACES: [u8; 8] = [0x10, 0x32, 0x54, 0x76, 0x98, 0xBA, 0xDC, 0xFE];

    type Picture<F, X = Repeat, Y = Repeat> = [Option<Texture<F, 4, 4, X, Y>>; 1];

    fn picture<X: Wrap, Y: Wrap>() -> Picture<Colors<'static, Gray8, 16>, X, Y> {
        [Some(Texture::new(Colors::new(&GRAYS)))]
    }

    /// Two by two pixels of each texel.
    fn enlarged(column: usize, row: usize) -> u8 {
        (16 * (row / 2 * 4 + column / 2)) as u8
    }

    fn is_enlarged(rows: &[[u8; SIDE]]) -> bool {
        (0..SIDE).all(|row| (0..SIDE).all(|column| rows[row][column] == enlarged(column, row)))
    }

    #[test]
    fn every_mode_and_format_shows_the_texels() {
        let repeated = picture::<Repeat, Repeat>();
        let clamped = picture::<Clamp, Repeat>();
        let shader = Textured::new(&repeated);
        assert!(is_enlarged(&drawn(&shader, false).unwrap()));
        assert!(is_enlarged(&drawn(&shader.corrected(Affine), false).unwrap()));
        assert!(is_enlarged(&drawn(&shader.corrected(EveryPixel), false).unwrap()));
        assert!(is_enlarged(&drawn(&shader.corrected(Every::<16>), false).unwrap()));
        let wide = Textured::new(&clamped).with_wide_coordinates();
        assert!(is_enlarged(&drawn(&wide, false).unwrap()));
        assert!(is_enlarged(&drawn(&wide, true).unwrap()));
        assert!(is_enlarged(&drawn(&wide.corrected(EveryPixel), true).unwrap()));
        type Places<'a> = Indexed<'a, Gray8, 4, 8, 16>;
        let indexed: Picture<Places<'_>> = [Some(Texture::new(Indexed::new(&PLACES, &GRAYS)))];
        assert!(is_enlarged(&drawn(&Textured::new(&indexed), false).unwrap()));
    }

    #[test]
    fn sizes_may_be_known_at_run_time() {
        let texels = ColorSlice::new(&GRAYS).unwrap();
        let texture: DynamicTexture<_> = DynamicTexture::new(texels, 4, 4).unwrap();
        assert!(is_enlarged(&drawn(&Textured::new(&[texture]), false).unwrap()));
    }

    #[test]
    fn wide_coordinates_are_refused_by_a_narrow_shader() {
        let picture = picture::<Repeat, Repeat>();
        let refused = drawn(&Textured::new(&picture), true).unwrap_err();
        assert_eq!(refused, ProjectError::WideTextureCoordinates);
        assert!(std::format!("{refused}").contains("with_wide_coordinates"));
    }

    /// A pixel's centre is a quarter texel from a texel's.
    #[test]
    fn bilinear_samples_lie_between_the_centers() {
        let picture = picture::<Clamp, Clamp>();
        for rows in [
            drawn(&Textured::new(&picture).filtered(Bilinear), false),
            drawn(&Textured::new(&picture).filtered(Bilinear).corrected(EveryPixel), false),
        ] {
            let along = [0, 4, 12, 20, 28, 36, 44, 48];
            for (row, pixels) in rows.unwrap().iter().enumerate() {
                assert_eq!(pixels.map(u32::from), along.map(|c| c + 4 * along[row]), "{row}");
            }
        }
    }

    #[test]
    fn keyed_texels_leave_the_background() {
        type Holes<'a> = Keyed<Colors<'a, Gray8, 16>>;
        let holes: Picture<Holes<'_>> =
            [Some(Texture::new(Keyed::new(Colors::new(&GRAYS), GRAYS[5])))];
        let rows = drawn(&Textured::new(&holes), false).unwrap();
        for (row, pixels) in rows.iter().enumerate() {
            for (column, &pixel) in pixels.iter().enumerate() {
                let is_hole = (2..4).contains(&column) && (2..4).contains(&row);
                assert_eq!(pixel, if is_hole { 1 } else { enlarged(column, row) });
            }
        }
    }

    #[test]
    fn a_material_without_texture_has_its_color() {
        let none: Picture<Colors<'_, Gray8, 16>> = [None];
        let rows = drawn(&Textured::new(&none).filtered(Bilinear), false).unwrap();
        assert!(rows.iter().flatten().all(|&pixel| pixel == GRAY), "{rows:?}");
    }

    #[test]
    fn a_table_without_options_has_a_texture_for_each_material() {
        let [texture] = picture::<Repeat, Repeat>().map(Option::unwrap);
        assert!(is_enlarged(&drawn(&Textured::new(&[texture]), false).unwrap()));
    }

    /// 16 x 16 texels on 8 x 8 pixels: level 1.
    #[test]
    fn the_mip_level_is_that_of_the_square() {
        const COUNT: usize = 256 + 64 + 16 + 4 + 1;
        const LEVELS: [Gray8; COUNT] = {
            let mut levels = [Gray8::new(10); COUNT];
            let mut i = 256;
            while i < COUNT {
                levels[i] = Gray8::new(if i < 256 + 64 { 20 } else { 30 });
                i += 1;
            }
            levels
        };
        type Map<'a> = Mipmaps<Colors<'a, Gray8, COUNT>, 16, 16>;
        let maps: [Option<Map<'_>>; 1] = [Some(Mipmaps::new(Colors::new(&LEVELS)))];
        let shader = Textured::new(&maps);
        let is_all =
            |rows: std::vec::Vec<[u8; SIDE]>, gray| rows.iter().flatten().all(|&p| p == gray);
        assert!(is_all(drawn(&shader, false).unwrap(), 10));
        assert!(is_all(drawn(&shader.filtered(NearestMip(PerTriangle)), false).unwrap(), 20));
        let pixel = shader.filtered(NearestMip(PerPixel));
        assert!(is_all(drawn(&pixel, false).unwrap(), 20));
        assert!(is_all(drawn(&pixel.corrected(EveryPixel), false).unwrap(), 20));
        assert!(is_all(drawn(&shader.filtered(Trilinear(PerPixel)), false).unwrap(), 20));
    }
}
