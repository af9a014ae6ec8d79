//! The memory that drawing a mesh takes, known when the firmware is compiled.

use embedded_graphics_core::geometry::Size;

use super::bin_words;
use crate::{
    geometry::ScreenVertex,
    mesh::Mesh,
    shade::{OnScreen, Shader},
};

/// The memory that the caller provides to draw a mesh in bands: lengths of arrays, at compile time.
///
/// ```
/// use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*};
/// # use rasterizer::mesh::{Material, Mesh, Positions, Tables, Triangles};
/// use rasterizer::{prelude::*, scene::Needs};
///
/// # static SQUARE: Mesh<'static> = Mesh::new_const(Tables {
/// #     positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
/// #     triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
/// #     materials: &[Material::new([255, 160, 0], 2)],
/// #     ..Tables::EMPTY
/// # });
/// // A square of two triangles on 240 x 240 pixels, sixteen rows at a time.
/// const NEEDS: Needs = Needs::of(&SQUARE, Size::new(240, 240), 16);
/// let mut vertices = [ScreenVertex::<S4, u16, [u16; 0]>::EMPTY; NEEDS.vertices];
/// let mut bins = [0u32; NEEDS.bin_words];
/// let (mut color, mut depth) = ([Rgb565::BLACK; NEEDS.pixels], [0u16; NEEDS.pixels]);
///
/// // 4 vertices of 12 bytes, 15 words of bits, 3,840 pixels of 4 bytes: checked when the
/// // firmware is compiled.
/// const { assert!(NEEDS.bytes::<S4, u16, Unlit<Rgb565>>() == 4 * 12 + 15 * 4 + 3840 * 4) }
/// assert_eq!(NEEDS.vertices, vertices.len());
/// # let _ = (&mut vertices, &mut bins, &mut color, &mut depth);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Needs {
    /// Vertices of storage, for [`Object::project`](super::Object::project).
    pub vertices: usize,
    /// Words of bins, for [`Projected::binned`](super::Projected::binned).
    pub bin_words: usize,
    /// Words for [`Projected::back_to_front`](super::Projected::back_to_front): one for each
    /// triangle. Not part of [`bytes`](Self::bytes), as few objects need it.
    pub sort_words: usize,
    /// Pixels of a band: of colour and, if it is tested, of depth.
    pub pixels: usize,
}

impl Needs {
    /// For a mesh in a viewport of this size, in bands of `band_rows` rows, at least one.
    #[must_use]
    pub const fn of(mesh: &Mesh<'_>, viewport: Size, band_rows: u32) -> Self {
        let band_rows = if band_rows == 0 { 1 } else { band_rows };
        Self {
            vertices: mesh.vertex_count(),
            bin_words: bin_words(mesh.triangle_count(), viewport.height, band_rows),
            sort_words: mesh.triangle_count(),
            pixels: viewport.width as usize * band_rows as usize,
        }
    }

    /// The bytes of vertices, bins and pixels together, with sub-pixels `S`, depth `D`, and the
    /// colour and the varyings of a shader.
    #[must_use]
    pub const fn bytes<S, D, Sh: Shader>(&self) -> usize {
        self.vertices * size_of::<ScreenVertex<S, D, OnScreen<Sh>>>()
            + self.bin_words * size_of::<u32>()
            + self.pixels * (size_of::<Sh::Color>() + size_of::<D>())
    }
}
