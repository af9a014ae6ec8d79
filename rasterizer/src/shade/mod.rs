//! What a covered pixel becomes.
//!
//! A [`Shader`] is resolved at compile time: the loop over a span's pixels is built for it alone.
//! It works in three steps, each as rarely as possible: a material becomes a *surface* once for its
//! run of triangles, a vertex gets its *varyings* once a frame, and a pixel its colour from the
//! surface and the interpolated varyings; or the whole *face* has one.
//!
//! Colours are worked out in the values that pictures store, without a gamma curve, as small
//! displays expect.

mod flat;
mod gouraud;
mod light;
mod lit;
mod ramp;

use embedded_graphics_core::pixelcolor::PixelColor;
pub use flat::{Flat, Unlit};
pub use gouraud::Gouraud;
pub use light::{Level, Light};
pub use ramp::Ramp;

use crate::{
    geometry::{Pose, Varyings},
    mesh::{Material, Tables},
    raster::Interpolate,
};

/// A way to colour a mesh.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// use fixed::types::U16F16;
/// use rasterizer::{
///     mesh::Material,
///     shade::{MeshVertex, Shader},
/// };
///
/// /// White stripes across the material's colour.
/// #[derive(Clone)]
/// struct Stripes;
///
/// impl Shader for Stripes {
///     type Color = Rgb565;
///     type Varyings = [u16; 1];
///     type Surface = Rgb565;
///     fn surface(&self, material: &Material) -> Rgb565 {
///         material.rgb().into()
///     }
///     fn vertex(&self, vertex: &MeshVertex) -> [u16; 1] {
///         [vertex.position()[1] as u16 ^ 0x8000]
///     }
///     fn pixel(&self, surface: &Rgb565, [height]: [U16F16; 1]) -> Rgb565 {
///         if height.to_bits() >> 29 & 1 == 0 { *surface } else { Rgb565::WHITE }
///     }
/// }
/// ```
pub trait Shader: Clone {
    /// The colour type of the target.
    type Color: PixelColor;
    /// What is interpolated from the vertices: an array of `u16`, empty if nothing is.
    type Varyings: Varyings + Interpolate;
    /// What a material becomes, worked out once for its run of triangles.
    type Surface;

    /// The tables of the mesh that it reads; drawing a mesh without them is an error.
    const TABLES: RequiredTables = RequiredTables::NONE;

    /// The shader for an object in this pose, with its directions in object space.
    #[must_use]
    fn in_object_space(&self, _pose: &Pose) -> Self {
        self.clone()
    }

    /// What a material becomes.
    fn surface(&self, material: &Material) -> Self::Surface;

    /// The varyings of a vertex.
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings;

    /// The colour of a whole triangle, if it has a single one; [`pixel`](Self::pixel) is then not
    /// asked.
    #[inline(always)]
    fn face(&self, _surface: &Self::Surface, _face: &MeshFace<'_>) -> Option<Self::Color> {
        None
    }

    /// The colour of a pixel. A varying of 16 bits arrives in Q16.16, half a unit above its
    /// interpolated value.
    fn pixel(
        &self,
        surface: &Self::Surface,
        varyings: <Self::Varyings as Interpolate>::Sample,
    ) -> Self::Color;
}

/// The optional tables of a mesh that a shader reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct RequiredTables {
    /// [`Tables::vertex_normals`].
    pub vertex_normals: bool,
    /// [`Tables::face_normals`].
    pub face_normals: bool,
    /// [`Tables::texture_coordinates`].
    pub texture_coordinates: bool,
}

impl RequiredTables {
    /// None of them.
    pub const NONE: Self =
        Self { vertex_normals: false, face_normals: false, texture_coordinates: false };

    /// A mesh's tables, those of vertices that are read cut to `count`; nothing if one is shorter.
    #[inline(always)]
    pub(crate) fn of_vertices<'a>(self, tables: &Tables<'a>, count: usize) -> Option<Tables<'a>> {
        Some(Tables {
            positions: tables.positions.get(..count)?,
            vertex_normals: cut(tables.vertex_normals, count, self.vertex_normals)?,
            texture_coordinates: cut(tables.texture_coordinates, count, self.texture_coordinates)?,
            ..*tables
        })
    }
}

#[inline(always)]
fn cut<T>(table: &[T], count: usize, is_read: bool) -> Option<&[T]> {
    if is_read { table.get(..count) } else { Some(table) }
}

/// A vertex of a mesh, read from its tables as far as the shader asks.
#[derive(Clone, Copy, Debug)]
pub struct MeshVertex<'a> {
    tables: &'a Tables<'a>,
    index: usize,
}

impl<'a> MeshVertex<'a> {
    #[inline(always)]
    pub(crate) const fn new(tables: &'a Tables<'a>, index: usize) -> Self {
        Self { tables, index }
    }

    /// Its position in quanta of the mesh.
    #[inline(always)]
    #[must_use]
    pub fn position(&self) -> [i16; 3] {
        self.tables.positions.get(self.index).copied().unwrap_or_default()
    }

    /// Its normal in object space, 127 standing for 1.
    #[inline(always)]
    #[must_use]
    pub fn normal(&self) -> [i8; 3] {
        self.tables.vertex_normals.get(self.index).copied().unwrap_or_default()
    }

    /// Its texture coordinates, in the mesh's
    /// [`texture_fraction_bits`](Tables::texture_fraction_bits).
    #[inline(always)]
    #[must_use]
    pub fn texture_coordinates(&self) -> [u16; 2] {
        self.tables.texture_coordinates.get(self.index).copied().unwrap_or_default()
    }
}

/// A triangle of a mesh, read from its tables as far as the shader asks.
#[derive(Clone, Copy, Debug)]
pub struct MeshFace<'a> {
    tables: &'a Tables<'a>,
    index: usize,
}

impl<'a> MeshFace<'a> {
    #[inline(always)]
    pub(crate) const fn new(tables: &'a Tables<'a>, index: usize) -> Self {
        Self { tables, index }
    }

    /// Its place in the table, from 0.
    #[inline(always)]
    #[must_use]
    pub const fn index(&self) -> usize {
        self.index
    }

    /// Its normal in object space, 127 standing for 1.
    #[inline(always)]
    #[must_use]
    pub fn normal(&self) -> [i8; 3] {
        self.tables.face_normals.get(self.index).copied().unwrap_or_default()
    }
}
