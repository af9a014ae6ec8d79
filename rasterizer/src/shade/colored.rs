//! The colours of vertices, interpolated between them.

use core::marker::PhantomData;

use super::{
    CodeSize, Light, Lighting, Sample, Shader,
    lighting::{Lit, vertex_level},
};
use crate::{
    attribute::{Affine, Correction, PerspectiveCorrect},
    color::{Channels, to_q16},
    geometry::ObjectView,
    mesh::{MeshMaterial, MeshVertex, RequiredTables},
    raster::Fragment,
};

/// The colours of the vertices, unlit. Needs
/// [`vertex_colors`](crate::mesh::Tables::vertex_colors); materials do not count.
///
/// Channels are interpolated in the values that are stored, linearly on the screen like
/// [`Gouraud`](super::Gouraud)'s light, or in perspective by the [`Correction`] `M`, and rounded to
/// the nearest step of the target's format: see [`Channels`].
///
/// ```
/// use embedded_graphics_core::pixelcolor::Rgb565;
/// use rasterizer::{attribute::EveryPixel, shade::Colored};
///
/// let shader = Colored::<Rgb565>::new();
/// // For large triangles that reach far into the picture:
/// let in_perspective = shader.corrected(EveryPixel);
/// # let _ = in_perspective;
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colored<C, M = Affine>(PhantomData<(C, M)>);

impl<C> Colored<C> {
    /// The colours of the vertices, linear on the screen.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<C> Default for Colored<C> {
    fn default() -> Self {
        Self::new()
    }
}

impl<C, M> Colored<C, M> {
    /// Corrected in another way, such as [`EveryPixel`](crate::attribute::EveryPixel).
    #[must_use]
    pub const fn corrected<N: Correction>(self, _: N) -> Colored<C, N> {
        Colored(PhantomData)
    }
}

impl<C: Channels, M: Correction> Shader for Colored<C, M> {
    type Color = C;
    type Varyings = PerspectiveCorrect<C::Varyings, M>;
    type Surface = ();
    type Face = ();
    type Outcome = C;

    const CODE: CodeSize = CodeSize::Medium;

    const TABLES: RequiredTables = COLORS;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        PerspectiveCorrect::new(C::varyings(vertex.color().map(to_q16)))
    }

    #[inline(always)]
    fn pixel(&self, (): &(), (): &(), fragment: Fragment<Sample<Self>>) -> C {
        C::of(fragment.varyings.value)
    }
}

const COLORS: RequiredTables = RequiredTables { vertex_colors: true, ..RequiredTables::NONE };

/// The colours of the vertices, lit there: each channel times the level of light is interpolated.
/// Needs [`vertex_colors`](crate::mesh::Tables::vertex_colors) and
/// [`vertex_normals`](crate::mesh::Tables::vertex_normals); materials do not count.
///
/// Interpolated and rounded like [`Colored`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ColoredGouraud<C, M = Affine, L = Light> {
    lit: Lit<C, L>,
    mode: PhantomData<M>,
}

impl<C, L> ColoredGouraud<C, Affine, L> {
    /// Lit by `light`, linear on the screen.
    #[must_use]
    pub const fn new(light: L) -> Self {
        Self { lit: Lit::by(light), mode: PhantomData }
    }
}

impl<C: Copy, M, L: Copy> ColoredGouraud<C, M, L> {
    /// Corrected in another way, such as [`EveryPixel`](crate::attribute::EveryPixel).
    #[must_use]
    pub const fn corrected<N: Correction>(self, _: N) -> ColoredGouraud<C, N, L> {
        ColoredGouraud { lit: self.lit, mode: PhantomData }
    }
}

impl<C: Channels, M: Correction, L: Lighting> Shader for ColoredGouraud<C, M, L> {
    type Color = C;
    type Varyings = PerspectiveCorrect<C::Varyings, M>;
    type Surface = ();
    type Face = ();
    type Outcome = C;

    const CODE: CodeSize = CodeSize::Medium;

    const TABLES: RequiredTables = RequiredTables { vertex_normals: true, ..COLORS };

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self { lit: self.lit.for_object(view), ..*self }
    }

    fn surface(&self, _: &MeshMaterial<'_>) {}

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        let level = vertex_level(&self.lit.light, vertex);
        PerspectiveCorrect::new(C::varyings(vertex.color().map(|channel| lit(channel, level))))
    }

    #[inline(always)]
    fn pixel(&self, (): &(), (): &(), fragment: Fragment<Sample<Self>>) -> C {
        C::of(fragment.varyings.value)
    }
}

/// Eight bits of a channel at a brightness in Q16, 0 to 65,536: Q16, within a unit.
#[inline(always)]
const fn lit(channel: u8, level: u32) -> u32 {
    // 1 / 255 = 2^-8 + 2^-16 + 2^-24 and less than 2^-31 more, of a number below 2^24.
    let product = channel as u32 * level;
    (product + (product >> 8) + (product >> 16) + 128) >> 8
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use embedded_graphics_core::{
        pixelcolor::{Rgb888, RgbColor as _},
        prelude::{Point, Size},
        primitives::Rectangle,
    };

    use super::*;
    use crate::{
        attribute::{EveryPixel, NoDepth},
        camera::{Camera, Distance, Orthographic},
        mesh::{Material, Mesh, Normals, Positions, Tables, Triangles},
        numbers::{Rotation, S4, Vec3},
        output::Frame,
        prelude::Object,
        scene::ProjectError,
        shade::{Level, OnScreen},
    };

    const SIDE: usize = 8;

    /// A square of two triangles, whose right side is green and whose left side is red.
    const TABLES: Tables<'static> = Tables {
        positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
        vertex_normals: Normals::I8(&[[0, 0, 127]; 4]),
        vertex_colors: &[[255, 0, 7], [0, 128, 7], [0, 128, 7], [255, 0, 7]],
        triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
        materials: &[Material::new([1, 2, 3], 2)],
        ..Tables::EMPTY
    };

    fn drawn<Sh: Shader<Color = Rgb888>>(
        tables: Tables<'_>,
        shader: Sh,
    ) -> Result<Vec<[u8; 3]>, ProjectError> {
        let mesh = Mesh::new(tables).unwrap();
        let picture = Rectangle::new(Point::zero(), Size::new_equal(SIDE as u32));
        let lens =
            Orthographic::new(Distance::lit("2"), Distance::lit("1"), Distance::lit("9")).unwrap();
        let camera = Camera::at(Vec3::lit("0", "0", "3"), Rotation::IDENTITY, lens, picture);
        let mut pixels = [Rgb888::new(9, 9, 9); SIDE * SIDE];
        let mut frame = Frame::without_depth(&mut pixels, picture).unwrap();
        let mut vertices = [crate::geometry::ScreenVertex::<S4, NoDepth, OnScreen<Sh>>::EMPTY; 4];
        Object::new(&mesh, shader)
            .project(&camera.unwrap(), &mut vertices)?
            .draw(&mut frame)
            .unwrap();
        Ok(pixels.iter().map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect())
    }

    /// Asserts that column c has the colours at (c + 1/2) / 8 of the way, times `level`.
    fn assert_ramp(pixels: &[[u8; 3]], level: f64) {
        for (index, &pixel) in pixels.iter().enumerate() {
            let way = ((index % SIDE) as f64 + 0.5) / SIDE as f64;
            let exact = [255.0 * (1.0 - way), 128.0 * way, 7.0].map(|channel| channel * level);
            for (got, exact) in pixel.into_iter().zip(exact) {
                let error = (f64::from(got) - exact).abs();
                assert!(error <= 0.5 + 1.0 / 128.0, "{index}: {pixel:?}, not {exact:?}");
            }
        }
    }

    #[test]
    fn channels_run_from_vertex_to_vertex() {
        let shader = Colored::<Rgb888>::new();
        assert_ramp(&drawn(TABLES, shader).unwrap(), 1.0);
        assert_ramp(&drawn(TABLES, shader.corrected(EveryPixel)).unwrap(), 1.0);
    }

    #[test]
    fn light_darkens_them_at_the_vertices() {
        let light = Light::new(Vec3::Z, Level::lit("0.25"), Level::lit("0.5"));
        let shader = ColoredGouraud::<Rgb888>::new(light);
        // The level is within 2^-13, of up to 255 steps.
        assert_ramp(&drawn(TABLES, shader).unwrap(), 0.75 - 2f64.powi(-14));
        assert_ramp(&drawn(TABLES, shader.corrected(EveryPixel)).unwrap(), 0.75 - 2f64.powi(-14));
    }

    #[test]
    fn a_mesh_without_them_is_refused() {
        let none = Tables { vertex_colors: &[], ..TABLES };
        let refused = drawn(none, Colored::new()).unwrap_err();
        assert_eq!(refused, ProjectError::NoVertexColors);
        assert!(std::format!("{refused}").contains("colours of vertices"));
        let light = Light::new(Vec3::Z, Level::ZERO, Level::ONE);
        assert_eq!(drawn(none, ColoredGouraud::new(light)), Err(ProjectError::NoVertexColors));
        let unlit = Tables { vertex_normals: Normals::NONE, ..TABLES };
        assert_eq!(drawn(unlit, ColoredGouraud::new(light)), Err(ProjectError::NoVertexNormals));
    }

    #[test]
    fn lit_channels_are_within_a_unit() {
        for channel in 0..=255u8 {
            for level in (0..=65_536u32).step_by(97).chain([1, 65_535, 65_536]) {
                let exact = f64::from(channel) / 255.0 * f64::from(level);
                let got = f64::from(lit(channel, level));
                assert!((got - exact).abs() < 1.0, "{channel} at {level}: {got}, not {exact}");
            }
            assert_eq!(lit(channel, 65_536), to_q16(channel));
        }
    }
}
