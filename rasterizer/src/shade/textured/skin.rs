//! What the shaders with textures share.

use core::marker::PhantomData;

use super::super::Face;
use crate::{
    attribute::{Corrected, Correction, Interpolate, PerspectiveCorrect, Varyings},
    mesh::{MeshMaterial, MeshVertex, RequiredTables},
    numbers::codegen,
    raster::{Fragment, Gradients},
    texture::{
        CoordinateFormat, Filter, Footprint, LitTexels, Texel, TexelMap, Texels, TextureVarying,
    },
};

/// A format in which a shader reads the texture coordinates of a mesh: `i16`, in Q2.14, or `i32`,
/// in Q8.24.
pub trait VertexCoordinates: CoordinateFormat {
    /// The table that has them.
    const TABLES: RequiredTables;

    /// The coordinates u and v of a vertex.
    fn of(vertex: &MeshVertex<'_>) -> [Self; 2];
}

impl VertexCoordinates for i16 {
    const TABLES: RequiredTables =
        RequiredTables { narrow_texture_coordinates: true, ..RequiredTables::NONE };

    #[inline(always)]
    fn of(vertex: &MeshVertex<'_>) -> [Self; 2] {
        vertex.texture_coordinates_q14()
    }
}

impl VertexCoordinates for i32 {
    const TABLES: RequiredTables =
        RequiredTables { texture_coordinates: true, ..RequiredTables::NONE };

    #[inline(always)]
    fn of(vertex: &MeshVertex<'_>) -> [Self; 2] {
        vertex.texture_coordinates()
    }
}

/// What a material has in a table of textures: a texture, or an `Option` of one.
///
/// Where all materials have textures, a table without `Option`s saves the code for those that have
/// none, some 4 KB, and a test at each pixel.
pub trait Slot: Copy {
    /// The type of the texture.
    type Texture: TexelMap;

    /// Returns what `textured` makes of the texture, or `bare` if there is none.
    fn texture_or<R>(
        &self,
        textured: impl FnOnce(&Self::Texture) -> R,
        bare: impl FnOnce() -> R,
    ) -> R;
}

impl<T: TexelMap> Slot for T {
    type Texture = T;

    #[inline(always)]
    fn texture_or<R>(&self, textured: impl FnOnce(&T) -> R, _: impl FnOnce() -> R) -> R {
        textured(self)
    }
}

impl<T: TexelMap> Slot for Option<T> {
    type Texture = T;

    #[inline(always)]
    fn texture_or<R>(&self, textured: impl FnOnce(&T) -> R, bare: impl FnOnce() -> R) -> R {
        match self {
            Some(texture) => textured(texture),
            None => bare(),
        }
    }
}

/// The textures of a mesh by its materials, filtered by `F`, with perspective corrected by `M` and
/// coordinates in the format `C`.
#[derive(Clone, Copy, Debug)]
pub(in crate::shade) struct Skin<'a, S, F, M, C> {
    first: &'a S,
    all: &'a [S],
    choices: PhantomData<(F, M, C)>,
}

/// Texture coordinates as a filter takes them.
type Coordinates<S, F, C> = <F as Filter<<S as Slot>::Texture>>::Coordinates<
    <<S as Slot>::Texture as TexelMap>::Coordinates<C>,
>;

/// Texture coordinates as a vertex has them.
pub(in crate::shade) type Varying<S, F, M, C> = PerspectiveCorrect<Coordinates<S, F, C>, M>;

/// Texture coordinates as a vertex on the screen has them.
type OnScreen<S, F, M, C> = <Varying<S, F, M, C> as Varyings>::OnScreen;

/// Texture coordinates as a pixel sees them.
type SampleOf<S, F, M, C> = <OnScreen<S, F, M, C> as Interpolate>::Sample;

/// What a filter computes of a triangle.
pub(in crate::shade) type FaceOf<S, F> = <F as Filter<<S as Slot>::Texture>>::Face;

/// The texels of a texture.
pub(in crate::shade) type TexelsOf<S> = <<S as Slot>::Texture as TexelMap>::Texels;

/// What the light of a texture is.
pub(in crate::shade) type LightOf<S> = <TexelsOf<S> as LitTexels>::Light;

/// The type of a texel.
pub(in crate::shade) type TexelOf<S> = <TexelsOf<S> as Texels>::Texel;

/// The type of a texel's colour.
pub(in crate::shade) type ColorOf<S> = <TexelsOf<S> as Texels>::Color;

impl<'a, S, F, M, C> Skin<'a, S, F, M, C> {
    pub(in crate::shade) const fn new<const N: usize>(textures: &'a [S; N]) -> Self {
        const { assert!(N > 0, "a shader with textures needs at least one") };
        Self { first: &textures[0], all: textures, choices: PhantomData }
    }

    /// With textures whose number is known at run time; `None` without any.
    pub(in crate::shade) const fn from_slice(textures: &'a [S]) -> Option<Self> {
        match textures {
            [] => None,
            [first, ..] => Some(Self { first, all: textures, choices: PhantomData }),
        }
    }

    /// The same textures by other choices.
    pub(in crate::shade) const fn chosen<G, N, D>(self) -> Skin<'a, S, G, N, D> {
        Skin { first: self.first, all: self.all, choices: PhantomData }
    }
}

impl<S: Slot, F: Filter<S::Texture>, M: Correction, C: VertexCoordinates> Skin<'_, S, F, M, C> {
    /// The texture of a material, and its colour.
    #[inline(always)]
    pub(in crate::shade) fn surface<P>(
        &self,
        material: &MeshMaterial<'_>,
        color: P,
    ) -> Covered<S, P> {
        Covered { slot: *self.all.get(material.index()).unwrap_or(self.first), color }
    }

    #[inline(always)]
    pub(in crate::shade) fn vertex(vertex: &MeshVertex<'_>) -> Varying<S, F, M, C> {
        Self::at(C::of(vertex))
    }

    /// The varying of these coordinates.
    #[inline(always)]
    pub(in crate::shade) fn at(coordinates: [C; 2]) -> Varying<S, F, M, C> {
        let coordinates = <S::Texture as TexelMap>::Coordinates::<C>::from(coordinates);
        PerspectiveCorrect::new(coordinates.into())
    }

    /// What the filter computes of a triangle with these coordinates at its corners.
    #[inline(always)]
    pub(in crate::shade) fn face<V: Interpolate>(
        texture: &S::Texture,
        gradients: &Gradients<'_, V>,
        coordinates: impl Fn(V) -> OnScreen<S, F, M, C>,
    ) -> FaceOf<S, F> {
        F::face(texture, || {
            let parts = |corner| M::parts::<Coordinates<S, F, C>>(&coordinates(corner));
            let corners = gradients.corners().map(parts);
            Footprint::new(
                corners.map(|(corner, _)| corner.uv()),
                corners.map(|(_, inverse_w)| inverse_w),
                gradients.doubled_area(),
                gradients.subpixel_bits(),
            )
        })
    }

    /// The texel of a pixel, of which `fetch` gets one by its number.
    #[inline(always)]
    pub(in crate::shade) fn texel(
        texture: &S::Texture,
        face: &FaceOf<S, F>,
        pixel: Corrected<<S::Texture as TexelMap>::Place>,
        fetch: impl Fn(usize) -> TexelOf<S>,
    ) -> TexelOf<S> {
        F::sample(texture, face, pixel.value, pixel.inverse_w, fetch)
    }
}

/// The shading of textures that are shown as they are: those of [`Textured`](super::Textured) and
/// [`Matcap`](super::Matcap).
impl<S, F, M, C> Skin<'_, S, F, M, C>
where
    S: Slot,
    F: Filter<S::Texture>,
    M: Correction,
    C: VertexCoordinates,
{
    /// What the filter computes of a triangle, or the colour of a bare material.
    #[inline(always)]
    pub(in crate::shade) fn plain_face(
        surface: &Covered<S, ColorOf<S>>,
        gradients: &Gradients<'_, OnScreen<S, F, M, C>>,
    ) -> Face<ColorOf<S>, FaceOf<S, F>> {
        surface.slot.texture_or(
            |texture| Face::Shaded(Self::face(texture, gradients, |corner| corner)),
            || Face::Solid(surface.color),
        )
    }

    /// Returns the texels of the pixels of a triangle.
    #[inline(always)]
    pub(in crate::shade) fn plain_pixels(
        &Covered { slot, color }: &Covered<S, ColorOf<S>>,
        face: FaceOf<S, F>,
    ) -> impl Fn(Fragment<SampleOf<S, F, M, C>>) -> TexelOf<S> + Copy + use<S, F, M, C> {
        move |fragment| {
            slot.texture_or(
                |texture| {
                    Self::texel(texture, &face, fragment.varyings, |index| texture.texel(index))
                },
                || bare(color),
            )
        }
    }
}

impl<S, F, M, C> Skin<'_, S, F, M, C>
where
    S: Slot<Texture: TexelMap<Texels: LitTexels>>,
    F: Filter<S::Texture>,
    M: Correction,
    C: VertexCoordinates,
{
    /// The texel of a pixel in this light.
    #[inline(always)]
    pub(in crate::shade) fn lit_texel(
        texture: &S::Texture,
        face: &FaceOf<S, F>,
        pixel: Corrected<<S::Texture as TexelMap>::Place>,
        light: LightOf<S>,
    ) -> TexelOf<S> {
        Self::texel(texture, face, pixel, |index| texture.before_light(index, light))
            .recolored(|color| TexelsOf::<S>::after_light(color, light))
    }
}

/// What a material is covered with: its texture, if it has one, and its colour.
#[derive(Clone, Copy, Debug)]
pub struct Covered<S, P> {
    pub(in crate::shade) slot: S,
    pub(in crate::shade) color: P,
}

/// A texel of a material without texture, in a shader that draws these in one colour, so that no
/// pixel comes here.
// codegen: a call that cannot be computed beforehand keeps both cases apart, so that a pixel of a
// texture takes one branch, which is not taken, and no more registers.
#[cold]
#[inline(never)]
pub(in crate::shade) fn bare<P, C: From<P>, T: Texel<C>>(color: P) -> T {
    T::opaque(C::from(codegen::unknown(color)))
}

/// A square of two triangles that fills a picture, for the tests of shaders.
#[cfg(test)]
pub(in crate::shade) mod square {
    use std::vec::Vec;

    use embedded_graphics_core::{
        pixelcolor::{Gray8, GrayColor as _},
        prelude::{Point, Size},
        primitives::Rectangle,
    };

    use crate::{
        attribute::NoDepth,
        camera::{Camera, Distance, Orthographic},
        mesh::{Material, Mesh, Normals, Positions, Tables, TextureCoordinates, Triangles},
        numbers::{Rotation, S4, Vec3},
        output::Frame,
        prelude::Object,
        scene::ProjectError,
        shade::{OnScreen, Shader},
    };

    /// A side of the picture in pixels.
    pub(in crate::shade) const SIDE: usize = 8;

    pub(in crate::shade) const GRAY: u8 = 90;

    const MATERIALS: &[Material] = &[Material::new([GRAY; 3], 2)];

    /// u and v run from 0 to 1.
    fn mesh(coordinates: TextureCoordinates<'static>) -> Mesh<'static> {
        Mesh::new_const(Tables {
            positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
            vertex_normals: Normals::I8(&[[0, 0, 127], [0, 0, 127], [0, 0, 127], [0, 0, 127]]),
            face_normals: Normals::I8(&[[0, 0, 127]; 2]),
            texture_coordinates: coordinates,
            triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
            materials: MATERIALS,
            ..Tables::EMPTY
        })
    }

    const NARROW: TextureCoordinates<'_> =
        TextureCoordinates::I16(&[[0, 1 << 14], [1 << 14, 1 << 14], [1 << 14, 0], [0, 0]]);
    const WIDE: TextureCoordinates<'_> =
        TextureCoordinates::I32(&[[0, 1 << 24], [1 << 24, 1 << 24], [1 << 24, 0], [0, 0]]);

    /// The rectangle of the picture.
    pub(in crate::shade) const fn screen() -> Rectangle {
        Rectangle::new(Point::zero(), Size::new_equal(SIDE as u32))
    }

    /// Draws the square over a background of 1, and returns the rows of the picture.
    pub(in crate::shade) fn drawn<Sh: Shader<Color = Gray8>>(
        shader: &Sh,
        is_wide: bool,
    ) -> Result<Vec<[u8; SIDE]>, ProjectError> {
        let mesh = mesh(if is_wide { WIDE } else { NARROW });
        let picture = screen();
        let lens =
            Orthographic::new(Distance::lit("2"), Distance::lit("1"), Distance::lit("9")).unwrap();
        let camera = Camera::at(Vec3::lit("0", "0", "3"), Rotation::IDENTITY, lens, picture);
        let mut pixels = [Gray8::new(1); SIDE * SIDE];
        let mut frame = Frame::without_depth(&mut pixels, picture).unwrap();
        let mut vertices = [crate::geometry::ScreenVertex::<S4, NoDepth, OnScreen<Sh>>::EMPTY; 4];
        Object::new(&mesh, shader.clone())
            .project(&camera.unwrap(), &mut vertices)?
            .draw(&mut frame)
            .unwrap();
        let (rows, _) = pixels.as_chunks();
        Ok(rows.iter().map(|row| row.map(|pixel| pixel.luma())).collect())
    }
}
