//! Any shader for a display of few colours.

use core::marker::PhantomData;

use super::{CodeSize, Face, InnerPixel, OnScreen, Outcome, Sample, Shader, inner};
use crate::{
    color::{Alpha, Dither, FullColor},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
};

/// The colours of another shader, dithered to those of the target by a matrix of `SIZE` rows, 8 or
/// 4: see [`Dither`].
///
/// The shader's colour is `Rgb888` or, for a display of grays, `Gray8`, which takes less work:
///
/// ```
/// use embedded_graphics_core::pixelcolor::{BinaryColor, Gray8};
/// # use embedded_graphics_core::{prelude::*, primitives::Rectangle};
/// # use rasterizer::{
/// #     mesh::{Material, Mesh, Normals, Positions, Tables, Triangles},
/// #     output::PackedFrame,
/// #     prelude::*,
/// #     shade::Dithered,
/// # };
/// # static TRIANGLE: Mesh<'static> = Mesh::new_const(Tables {
/// #     positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0]]),
/// #     triangles: Triangles::U8(&[[0, 1, 2]]),
/// #     face_normals: Normals::I8(&[[0, 0, 127]]),
/// #     materials: &[Material::new([188; 3], 1)],
/// #     ..Tables::EMPTY
/// # });
/// # let screen = Rectangle::new(Point::zero(), Size::new(16, 16));
/// # let lens = Perspective::new(Turn::degrees(40), Distance::lit("0.1"), Distance::lit("10"))?;
/// # let eye = Vec3::lit("0", "0", "3");
/// # let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, screen)?;
/// # let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; 3];
/// # let light = Light::new(Vec3::lit("0", "0", "1"), Level::lit("0"), Level::lit("1"));
/// let mut pixels = [0; PackedFrame::<BinaryColor>::bytes(Size::new(16, 16))];
/// let mut frame = PackedFrame::<BinaryColor>::without_depth(&mut pixels, screen)?;
/// let shader = Dithered::new(Flat::<Gray8>::new(light));
/// Object::new(&TRIANGLE, shader).draw(&camera, &mut vertices, &mut frame)?;
/// // 188 is half of the light of 255: half of the pixels are on.
/// assert_eq!(frame.as_bytes()[14 * 2..][..2], [0b0101_0101, 0b0101_0100]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// A triangle of one colour is dithered pixel by pixel too. Light and fog are in the shader's
/// colours; what is blended with stored pixels is blended after dithering. To dither what has been
/// blended, draw in `Gray8` or `Rgb888`, and send that through
/// [`Dithering`](crate::output::Dithering).
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct Dithered<Sh, C, const SIZE: usize = 8> {
    shader: Sh,
    to: PhantomData<C>,
}

impl<Sh, C> Dithered<Sh, C> {
    /// Dithers the shader's colours by a matrix of 8 x 8 numbers.
    #[must_use]
    pub const fn new(shader: Sh) -> Self {
        Self::with_size(shader)
    }
}

impl<Sh, C, const SIZE: usize> Dithered<Sh, C, SIZE> {
    /// Dithers the shader's colours by a matrix of `SIZE` rows, 4 or 8.
    #[must_use]
    pub const fn with_size(shader: Sh) -> Self {
        Self { shader, to: PhantomData }
    }

    /// The shader whose colours are dithered.
    #[must_use]
    pub const fn shader(&self) -> &Sh {
        &self.shader
    }
}

impl<Sh: Clone, C, const SIZE: usize> Clone for Dithered<Sh, C, SIZE> {
    #[inline(always)]
    fn clone(&self) -> Self {
        Self::with_size(self.shader.clone())
    }
}

impl<Sh: Copy, C, const SIZE: usize> Copy for Dithered<Sh, C, SIZE> {}

/// A pixel's colour before it is dithered, and its place.
#[derive(Clone, Copy, Debug)]
pub struct DitheredPixel<O, S, const SIZE: usize> {
    pixel: InnerPixel<S, O>,
    column: i32,
    row: i32,
}

impl<O: Outcome<S>, S: FullColor, C: Dither, const SIZE: usize> Outcome<C>
    for DitheredPixel<O, S, SIZE>
{
    const DISCARDS: bool = O::DISCARDS;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;
    const HAS_ALPHA: bool = O::HAS_ALPHA;

    #[inline(always)]
    fn color(self) -> Option<C> {
        let Self { pixel, column, row } = self;
        pixel.color().map(|color: S| C::dithered::<SIZE>(color, column, row))
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        let Self { pixel, column, row } = self;
        pixel.layer().map(|(color, alpha): (S, _)| (C::dithered::<SIZE>(color, column, row), alpha))
    }
}

impl<Sh: Shader<Color: FullColor>, C: Dither, const SIZE: usize> Shader for Dithered<Sh, C, SIZE> {
    type Color = C;
    type Varyings = Sh::Varyings;
    type Surface = Sh::Surface;
    type Face = Face<Sh::Color, Sh::Face>;
    type Outcome = DitheredPixel<Sh::Outcome, Sh::Color, SIZE>;

    const CODE: CodeSize = Sh::CODE.max(CodeSize::Medium);

    const TABLES: RequiredTables = Sh::TABLES;

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self::with_size(self.shader.for_object(view))
    }

    #[inline(always)]
    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        self.shader.surface(material)
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        self.shader.vertex(vertex)
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Self::Surface,
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<C, Self::Face> {
        Face::Shaded(self.shader.face(surface, face, gradients))
    }

    #[inline(always)]
    fn pixel(
        &self,
        surface: &Self::Surface,
        face: &Self::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Self::Outcome {
        self.pixels(surface, *face)(fragment)
    }

    #[inline(always)]
    fn pixels(
        &self,
        surface: &Self::Surface,
        face: Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Self::Outcome + Copy {
        let pixel = inner::pixels(&self.shader, surface, face);
        move |fragment| {
            let Fragment { column, row, .. } = fragment;
            DitheredPixel { pixel: pixel(fragment), column, row }
        }
    }
}
