//! An object as the camera sees it, ready to be drawn.

use core::marker::PhantomData;

use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;

use crate::{
    geometry::{CullBack, Culling, DepthFormat, MAX_CORNERS, Projection, ScreenVertex, Subpixel, Transform, clip},
    mesh::Tables,
    raster::{Interpolate, Span, SpanSink, Window, draw_triangle, signed_area},
    shade::{MeshFace, MeshVertex, Shader},
    target::Target,
};

/// The corners of a clipped triangle on the screen.
type Corners<S, D, Sh> = Vec<ScreenVertex<S, D, <Sh as Shader>::Varyings>, MAX_CORNERS>;

/// An object whose vertices have been projected; it can be drawn into any number of targets, such as the bands of a
/// frame.
#[derive(Clone, Copy, Debug)]
pub struct Projected<'v, 'a, P: Projection, S, D, Sh: Shader, K = CullBack> {
    tables: &'a Tables<'a>,
    shader: Sh,
    transform: Transform<P>,
    /// One for each vertex of the mesh, or none if the mesh is out of the picture.
    vertices: &'v [ScreenVertex<S, D, Sh::Varyings>],
    viewport: Window,
    culling: PhantomData<K>,
}

impl<'v, 'a, P, S, D, Sh, K> Projected<'v, 'a, P, S, D, Sh, K>
where
    P: Projection,
    S: Subpixel,
    D: DepthFormat,
    Sh: Shader,
    K: Culling,
{
    pub(super) const fn new(
        tables: &'a Tables<'a>,
        shader: Sh,
        transform: Transform<P>,
        vertices: &'v [ScreenVertex<S, D, Sh::Varyings>],
        viewport: Rectangle,
    ) -> Self {
        Self {
            tables,
            shader,
            transform,
            vertices,
            viewport: Window::new(&viewport),
            culling: PhantomData,
        }
    }

    /// The vertices on the screen, in the mesh's order; none if the mesh is out of the picture.
    #[must_use]
    pub const fn vertices(&self) -> &'v [ScreenVertex<S, D, Sh::Varyings>] {
        self.vertices
    }
}

impl<P, S, D, Sh, K> Projected<'_, '_, P, S, D, Sh, K>
where
    P: Projection,
    S: Subpixel,
    D: DepthFormat + Interpolate,
    Sh: Shader,
    K: Culling,
{
    /// Draws its triangles in the mesh's order.
    ///
    /// # Errors
    ///
    /// What the target says, at once.
    pub fn draw<T: Target<Color = Sh::Color, Depth = D>>(&self, target: &mut T) -> Result<(), T::Error> {
        let window = target.window().intersection(&self.viewport);
        if self.vertices.is_empty() {
            return Ok(());
        }
        let mut first = 0;
        for material in self.tables.materials {
            let end = first + material.triangle_count as usize;
            let surface = self.shader.surface(material);
            for index in first..end {
                let Some([i, j, k]) = self.tables.triangles.get(index) else {
                    break;
                };
                let (Some(a), Some(b), Some(c)) = (self.vertices.get(i), self.vertices.get(j), self.vertices.get(k))
                else {
                    break;
                };
                if a.is_on_screen() && b.is_on_screen() && c.is_on_screen() {
                    self.triangle([a, b, c], index, &surface, &window, target)?;
                } else {
                    let corners = self.clipped([i, j, k]);
                    if let Some((hub, rim)) = corners.split_first() {
                        for pair in rim.windows(2) {
                            self.triangle([hub, &pair[0], &pair[1]], index, &surface, &window, target)?;
                        }
                    }
                }
            }
            first = end;
        }
        Ok(())
    }

    /// Draws a triangle that is wholly on the screen, unless it is culled.
    #[inline(always)]
    fn triangle<T: Target<Color = Sh::Color, Depth = D>>(
        &self,
        corners: [&ScreenVertex<S, D, Sh::Varyings>; 3],
        index: usize,
        surface: &Sh::Surface,
        window: &Window,
        target: &mut T,
    ) -> Result<(), T::Error> {
        let area = signed_area(corners);
        // Counter-clockwise is negative, as y runs downwards.
        if (area < 0 && K::FRONT) || (area > 0 && K::BACK) {
            self.visible(corners, area, index, surface, window, target)
        } else {
            Ok(())
        }
    }

    #[inline(never)]
    fn visible<T: Target<Color = Sh::Color, Depth = D>>(
        &self,
        corners: [&ScreenVertex<S, D, Sh::Varyings>; 3],
        area: i64,
        index: usize,
        surface: &Sh::Surface,
        window: &Window,
        target: &mut T,
    ) -> Result<(), T::Error> {
        let mut pixels = Pixels {
            shader: &self.shader,
            surface,
            face: self.shader.face(surface, &MeshFace::new(self.tables, index)),
            target,
        };
        draw_triangle(corners, area, window, &mut pixels)
    }

    /// What near plane, far plane and guard band leave of a triangle.
    #[cold]
    #[inline(never)]
    fn clipped(&self, indices: [usize; 3]) -> Corners<S, D, Sh> {
        let triangle = indices.map(|index| {
            let vertex = MeshVertex::new(self.tables, index);
            self.transform
                .object_to_clip(vertex.position(), self.shader.vertex(&vertex))
        });
        clip(triangle, &self.transform)
            .iter()
            .map(|&vertex| self.transform.clip_to_screen(vertex))
            .collect()
    }
}

/// Brings spans and shader together in the target.
struct Pixels<'s, Sh: Shader, T> {
    shader: &'s Sh,
    surface: &'s Sh::Surface,
    face: Option<Sh::Color>,
    target: &'s mut T,
}

impl<Sh: Shader, T: Target<Color = Sh::Color>> SpanSink<T::Depth, Sh::Varyings> for Pixels<'_, Sh, T> {
    type Error = T::Error;

    #[inline(always)]
    fn span(&mut self, span: &Span<T::Depth, Sh::Varyings>) -> Result<(), T::Error> {
        match self.face {
            Some(color) => self.target.fill(span, color),
            None => self
                .target
                .shade(span, |varyings| self.shader.pixel(self.surface, varyings)),
        }
    }
}
