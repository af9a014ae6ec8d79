//! What the shaders with textures share.

use core::marker::PhantomData;

use crate::{
    attribute::{Corrected, Correction, Interpolate, PerspectiveCorrect, Varyings},
    mesh::{MeshMaterial, MeshVertex, RequiredTables},
    raster::Gradients,
    texture::{CoordinateFormat, Filter, Footprint, TexelMap, TexelOf, TextureVarying},
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

/// The textures of a mesh by its materials, filtered by `F`, with perspective corrected by `M` and
/// coordinates in the format `C`.
#[derive(Debug)]
pub(super) struct Skin<'a, T, F, M, C> {
    textures: &'a [Option<T>],
    choices: PhantomData<(F, M, C)>,
}

impl<T, F, M, C> Clone for Skin<'_, T, F, M, C> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T, F, M, C> Copy for Skin<'_, T, F, M, C> {}

/// Texture coordinates as a filter takes them.
pub(super) type Coordinates<T, F, C> =
    <F as Filter<T>>::Coordinates<<T as TexelMap>::Coordinates<C>>;

/// Texture coordinates as a vertex has them.
pub(super) type Varying<T, F, M, C> = PerspectiveCorrect<Coordinates<T, F, C>, M>;

/// Texture coordinates as a vertex on the screen has them.
pub(super) type OnScreen<T, F, M, C> = <Varying<T, F, M, C> as Varyings>::OnScreen;

impl<'a, T, F, M, C> Skin<'a, T, F, M, C> {
    pub(super) const fn new(textures: &'a [Option<T>]) -> Self {
        Self { textures, choices: PhantomData }
    }

    /// The same textures by other choices.
    pub(super) const fn chosen<G, N, D>(self) -> Skin<'a, T, G, N, D> {
        Skin::new(self.textures)
    }
}

impl<T: TexelMap, F: Filter<T>, M: Correction, C: VertexCoordinates> Skin<'_, T, F, M, C> {
    /// The texture of a material, and its colour.
    #[inline(always)]
    pub(super) fn surface<S>(&self, material: &MeshMaterial<'_>, color: S) -> Covered<T, S> {
        Covered { texture: self.textures.get(material.index()).copied().flatten(), color }
    }

    #[inline(always)]
    pub(super) fn vertex(vertex: &MeshVertex<'_>) -> Varying<T, F, M, C> {
        PerspectiveCorrect::new(T::coordinates(C::of(vertex)).into())
    }

    /// What the filter computes of a triangle with these coordinates at its corners.
    #[inline(always)]
    pub(super) fn face<V: Interpolate>(
        texture: &T,
        gradients: &Gradients<'_, V>,
        coordinates: impl Fn(V) -> OnScreen<T, F, M, C>,
    ) -> F::Face {
        F::face(texture, || {
            let parts = |corner| M::parts::<Coordinates<T, F, C>>(&coordinates(corner));
            let corners = gradients.corners().map(parts);
            Footprint::new(
                corners.map(|(corner, _)| corner.uv()),
                corners.map(|(_, inverse_w)| inverse_w),
                gradients.doubled_area(),
                gradients.subpixel_bits(),
            )
        })
    }
}

/// A material's texture, if it has one, and its colour.
#[derive(Clone, Copy, Debug)]
pub struct Covered<T, S> {
    pub(super) texture: Option<T>,
    pub(super) color: S,
}

impl<T: TexelMap, S> Covered<T, S> {
    /// Returns the texel of a pixel, by its number from `fetch`, and by `plain` from the colour of
    /// a material without texture.
    #[inline(always)]
    pub(super) fn texel<F: Filter<T>>(
        &self,
        face: &F::Face,
        pixel: Corrected<T::Place>,
        fetch: impl Fn(&T::Texels, usize) -> TexelOf<T>,
        plain: impl FnOnce(&S) -> TexelOf<T>,
    ) -> TexelOf<T> {
        match &self.texture {
            Some(texture) => F::sample(texture, face, pixel.value, pixel.inverse_w, |index| {
                fetch(texture.texels(), index)
            }),
            None => plain(&self.color),
        }
    }
}

/// A square of two triangles that fills a picture, for the tests of shaders.
#[cfg(test)]
pub(super) mod square {
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

    /// Draws the square over a background of 1, and returns the rows of the picture.
    pub(in crate::shade) fn drawn<Sh: Shader<Color = Gray8>>(
        shader: &Sh,
        is_wide: bool,
    ) -> Result<Vec<[u8; SIDE]>, ProjectError> {
        let mesh = mesh(if is_wide { WIDE } else { NARROW });
        let picture = Rectangle::new(Point::zero(), Size::new_equal(SIDE as u32));
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
