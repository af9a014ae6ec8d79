//! Shading after all triangles are drawn.

use embedded_graphics_core::primitives::Rectangle;

use super::{Visible, VisiblePixel, VisibleTriangle};
use crate::{
    color::Alpha,
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients, Window},
    shade::{Face, InnerPixel, OnScreen, Outcome, Sample, Shader, inner},
};

/// Another shader, for those pixels alone at which a visibility buffer has the triangle: each
/// visible pixel is shaded once, however many triangles lie over one another. The picture is that
/// of the shader with a depth buffer, pixel for pixel.
///
/// The object is drawn twice: by [`Visibility`](super::Visibility) with depth, with all that may
/// hide it, and then by this, which needs no depth. The coordinates in the triangles are not
/// needed. It pays where shading a pixel costs more than drawing it twice, times the layers that
/// are hidden: with [`Phong`](crate::shade::Phong) and lamps. Pixels that the shader itself
/// discards still hide what is behind them.
///
/// ```
/// # use embedded_graphics_core::{pixelcolor::Rgb565, primitives::Rectangle};
/// # use rasterizer::{attribute::NoDepth, mesh::Mesh, output::Frame, prelude::*};
/// use rasterizer::shade::{Deferred, Phong, Visibility, VisibleTriangle};
///
/// # fn draw<'a>(
/// #     mesh: &'a Mesh<'a>,
/// #     phong: Phong<Rgb565>,
/// #     camera: &Camera,
/// #     (display, buffer): (Rectangle, &mut Frame<'_, VisibleTriangle, &mut [u16]>),
/// #     frame: &mut Frame<'_, Rgb565, NoDepth>,
/// # ) -> Result<(), Box<dyn core::error::Error>> {
/// // First all objects, each with a number.
/// let seen = Object::new(mesh, Visibility::of_object(0).without_weights());
/// seen.project_on_demand(camera, S8)?.draw(buffer)?;
/// // Then the pixels of each that are seen.
/// let shaded = Object::new(mesh, Deferred::new(phong, 0, buffer.pixels(), display));
/// shaded.project_on_demand(camera, S8)?.draw(frame)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Deferred<'b, Sh, P = VisiblePixel> {
    shader: Sh,
    object: u8,
    pixels: &'b [P],
    window: Window,
}

impl<'b, Sh: Shader, P: Visible> Deferred<'b, Sh, P> {
    /// A shader for the visible pixels of the object with this number, in a visibility buffer of an
    /// area, row by row. Pixels outside of it are not drawn.
    #[must_use]
    pub const fn new(shader: Sh, object: u8, pixels: &'b [P], area: Rectangle) -> Self {
        Self { shader, object, pixels, window: Window::or_none(&area) }
    }

    /// Whether a triangle is seen at a pixel.
    #[inline(always)]
    fn is_visible(&self, seen: VisibleTriangle, column: i32, row: i32) -> bool {
        let index = self.window.index_of(column, row);
        index.and_then(|index| self.pixels.get(index)).is_some_and(|pixel| pixel.seen() == seen)
    }
}

impl<Sh: Shader, P: Visible> Shader for Deferred<'_, Sh, P> {
    type Color = Sh::Color;
    type Varyings = Sh::Varyings;
    type Surface = Sh::Surface;
    type Face = (VisibleTriangle, Face<Sh::Color, Sh::Face>);
    type Outcome = DeferredPixel<Sh::Color, Sh::Outcome>;

    const TABLES: RequiredTables = Sh::TABLES;

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self { shader: self.shader.for_object(view), ..*self }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Sh::Surface {
        self.shader.surface(material)
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Sh::Varyings {
        self.shader.vertex(vertex)
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Sh::Surface,
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Sh::Color, Self::Face> {
        let seen = VisibleTriangle::new(self.object, face.index());
        Face::Shaded((seen, self.shader.face(surface, face, gradients)))
    }

    #[inline(always)]
    fn pixel(
        &self,
        surface: &Sh::Surface,
        face: &Self::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Self::Outcome {
        self.pixels(surface, *face)(fragment)
    }

    #[inline(always)]
    fn pixels(
        &self,
        surface: &Sh::Surface,
        (seen, face): Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Self::Outcome + Copy {
        let pixel = inner::pixels(&self.shader, surface, face);
        move |fragment| {
            let is_visible = self.is_visible(seen, fragment.column, fragment.row);
            DeferredPixel(is_visible.then(|| pixel(fragment)))
        }
    }
}

/// A pixel of [`Deferred`].
#[derive(Clone, Copy, Debug)]
pub struct DeferredPixel<C, O>(Option<InnerPixel<C, O>>);

impl<C, O: Outcome<C>> Outcome<C> for DeferredPixel<C, O> {
    const DISCARDS: bool = true;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;
    const HAS_ALPHA: bool = O::HAS_ALPHA;

    #[inline(always)]
    fn color(self) -> Option<C> {
        self.0?.color()
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        self.0?.layer()
    }
}
