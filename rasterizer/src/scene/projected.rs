//! An object as the camera sees it, ready to be drawn.

use core::{marker::PhantomData, ops::Range};

use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;

use crate::{
    geometry::{CullBack, Culling, DepthFormat, MAX_CORNERS, Projection, ScreenVertex, Subpixel, Transform, clip},
    mesh::{Tables, Triangles},
    raster::{Interpolate, Triangle, Window, signed_area},
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
        if window.is_empty() {
            return Ok(());
        }
        let rows = Rows::of::<S>(&window);
        let mut first = 0;
        for material in self.tables.materials {
            let end = first + material.triangle_count as usize;
            let surface = self.shader.surface(material);
            self.for_each_visible(first..end, rows, |index, corners, area| {
                let triangle = Triangle::new(corners, area);
                match self.shader.face(&surface, &MeshFace::new(self.tables, index)) {
                    Some(color) => target.fill(triangle, &window, color),
                    None => target.shade(triangle, &window, |varyings| self.shader.pixel(&surface, varyings)),
                }
            })?;
            first = end;
        }
        Ok(())
    }

    /// Visits the triangles that [`draw`](Self::draw) draws, in its order: those that are left of the mesh's after
    /// culling and clipping, with their place in the mesh's table and their corners on the screen. A triangle that is
    /// clipped may leave several.
    ///
    /// # Errors
    ///
    /// What `visit` ends in, at once.
    pub fn for_each_triangle<E>(
        &self,
        mut visit: impl FnMut(usize, [&ScreenVertex<S, D, Sh::Varyings>; 3]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.for_each_visible(0..self.tables.triangles.len(), Rows::ALL, |index, corners, _| {
            visit(index, corners)
        })
    }

    /// The same for a range of the mesh's triangles, as far as they may reach `rows`, with their signed areas.
    fn for_each_visible<E>(
        &self,
        range: Range<usize>,
        rows: Rows,
        visit: impl FnMut(usize, [&ScreenVertex<S, D, Sh::Varyings>; 3], i64) -> Result<(), E>,
    ) -> Result<(), E> {
        match self.tables.triangles {
            Triangles::U8(triangles) => self.for_each_indexed(triangles, range, rows, visit),
            Triangles::U16(triangles) => self.for_each_indexed(triangles, range, rows, visit),
        }
    }

    /// The same for indices of one type. A function of its own: the loop over all triangles needs its registers.
    #[inline(never)]
    fn for_each_indexed<I: Copy + Into<usize>, E>(
        &self,
        triangles: &[[I; 3]],
        range: Range<usize>,
        rows: Rows,
        mut visit: impl FnMut(usize, [&ScreenVertex<S, D, Sh::Varyings>; 3], i64) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut unless_culled = |index, corners: [&ScreenVertex<S, D, Sh::Varyings>; 3]| {
            if rows.are_missed_by(corners.map(|corner| corner.y)) {
                return Ok(());
            }
            let area = signed_area(corners);
            // Counter-clockwise is negative, as y runs downwards.
            if (area < 0 && K::FRONT) || (area > 0 && K::BACK) {
                visit(index, corners, area)
            } else {
                Ok(())
            }
        };
        let first = range.start;
        for (offset, indices) in triangles.get(range).unwrap_or_default().iter().enumerate() {
            let [i, j, k] = indices.map(Into::into);
            // There are none if the mesh is out of the picture.
            let (Some(a), Some(b), Some(c)) = (self.vertices.get(i), self.vertices.get(j), self.vertices.get(k)) else {
                break;
            };
            if a.is_on_screen() && b.is_on_screen() && c.is_on_screen() {
                unless_culled(first + offset, [a, b, c])?;
            } else {
                let corners = self.clipped([i, j, k]);
                if let Some((hub, rim)) = corners.split_first() {
                    for pair in rim.windows(2) {
                        unless_culled(first + offset, [hub, &pair[0], &pair[1]])?;
                    }
                }
            }
        }
        Ok(())
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

/// Rows of pixels, by their first and last centre in sub-pixels.
#[derive(Clone, Copy, Debug)]
struct Rows {
    first: i32,
    last: i32,
}

impl Rows {
    const ALL: Self = Self {
        first: i32::MIN,
        last: i32::MAX,
    };

    /// Those of a window that is not empty.
    const fn of<S: Subpixel>(window: &Window) -> Self {
        let half = 1 << (S::BITS - 1);
        Self {
            first: (window.top << S::BITS) + half,
            last: ((window.bottom - 1) << S::BITS) + half,
        }
    }

    /// Whether a triangle with corners at these heights ends above all centres or begins below: most of a mesh's
    /// triangles do so in most of a frame's bands.
    #[inline(always)]
    const fn are_missed_by(self, [a, b, c]: [i32; 3]) -> bool {
        (a < self.first && b < self.first && c < self.first) || (a > self.last && b > self.last && c > self.last)
    }
}
