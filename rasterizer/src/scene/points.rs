//! Vertices of an object as points.

use fixed::types::U0F32;

use super::{Mode, Projected, Vertices, seen::Seen, style::Style, vertices::Lookup as _};
use crate::{
    geometry::{Projection, ScreenVertex},
    mesh::Points,
    output::{Blending, Target},
    raster::{Fragment, Point},
    shade::{OnScreen, Sample, Shader},
};

/// A vertex on the screen.
type Vertex<V, Sh> = ScreenVertex<
    <V as Vertices<OnScreen<Sh>>>::Subpixel,
    <V as Vertices<OnScreen<Sh>>>::Depth,
    OnScreen<Sh>,
>;

/// Vertices of an object that is projected, as points: what [`Projected::points`] makes.
///
/// A point owns the pixels that [`Point`] tells, and is tested against depth. It is drawn if its
/// vertex lies between near and far plane and in the guard band, also where only a part of it
/// reaches into the picture; but no point of an object is drawn whose bounding box is outside the
/// picture. Its size is in pixels, near and far.
#[derive(Clone, Copy, Debug)]
pub struct ProjectedPoints<'p, 'a, V, P: Projection, Sh: Shader, M> {
    seen: &'p Seen<'a, V, P, Sh, M>,
    points: &'p Points<'p>,
    style: Style,
}

impl<'a, V, P: Projection, Sh: Shader, M, O> Projected<'a, V, P, Sh, M, O> {
    /// Points of its mesh: of any table that was checked with it.
    ///
    /// They are drawn after its triangles or without them, one pixel large.
    #[must_use]
    pub const fn points<'p>(
        &'p self,
        points: &'p Points<'p>,
    ) -> ProjectedPoints<'p, 'a, V, P, Sh, M> {
        ProjectedPoints { seen: &self.seen, points, style: Style::PLAIN }
    }
}

impl<V, P: Projection, Sh: Shader, M> ProjectedPoints<'_, '_, V, P, Sh, M> {
    /// The same points in another size: the pixels along a side of the square.
    #[must_use]
    pub const fn sized(self, size: u8) -> Self {
        Self { style: Style { pixels: size, ..self.style }, ..self }
    }

    /// The same points moved towards the viewer by so much depth (near / w; 2<sup>-16</sup> is a
    /// unit of the format `u16`), for points that lie in a surface.
    #[must_use]
    pub const fn nearer(self, depth: U0F32) -> Self {
        Self { style: Style { nearer: depth, ..self.style }, ..self }
    }

    /// The same points in another material of the mesh, by its place in the table; at first it is
    /// the first one. It tells [`draw`](Self::draw) a colour.
    #[must_use]
    pub const fn of_material(self, index: usize) -> Self {
        Self { style: Style { material: index, ..self.style }, ..self }
    }
}

impl<V, P, Sh, M> ProjectedPoints<'_, '_, V, P, Sh, M>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    /// Draws all points in one colour.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no point after it.
    pub fn fill<T>(&self, color: Sh::Color, target: &mut T) -> Result<(), T::Error>
    where
        T: Target<Color = Sh::Color, Depth = V::Depth>,
        M::Blending: Blending<T>,
    {
        let window = target.window().intersection(&self.seen.viewport);
        let material = self.style.mesh_material(self.seen.tables());
        let blending = self.seen.mode.blending().of_material(&material);
        self.for_each_on_screen(|vertex| {
            let vertex = vertex.bare();
            let point = Point::at(&vertex, self.style.pixels);
            blending.fill(target, &point, &window, color)
        })
    }

    /// Draws all points in the colours of the object's shader: of a shader that computes nothing
    /// for a triangle as a whole, such as [`Gouraud`](crate::shade::Gouraud) or
    /// [`Colored`](crate::shade::Colored).
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no point after it.
    pub fn draw<T>(&self, target: &mut T) -> Result<(), T::Error>
    where
        T: Target<Color = Sh::Color, Depth = V::Depth>,
        M::Blending: Blending<T>,
        Sh: Shader<Face = ()>,
    {
        let window = target.window().intersection(&self.seen.viewport);
        let material = self.style.mesh_material(self.seen.tables());
        let blending = self.seen.mode.blending().of_material(&material);
        let mut surface = None;
        self.seen.prepare(self.style.material(self.seen.tables()), &mut surface);
        let Some(surface) = &surface else { return Ok(()) };
        self.for_each_on_screen(|vertex| {
            let pixel =
                |fragment: Fragment<Sample<Sh>>| self.seen.shader.pixel(surface, &(), fragment);
            blending.shade(target, &Point::at(&vertex, self.style.pixels), &window, pixel)
        })
    }

    /// Visits the points that [`draw`](Self::draw) draws, each by its place on the screen.
    ///
    /// # Errors
    ///
    /// Returns the first error of `visit`, and visits no point after it.
    pub fn for_each_point<E>(
        &self,
        mut visit: impl FnMut(&Vertex<V, Sh>) -> Result<(), E>,
    ) -> Result<(), E> {
        self.for_each_on_screen(|vertex| visit(&vertex))
    }

    /// Visits the points that are on the screen.
    #[inline(never)]
    fn for_each_on_screen<E>(
        &self,
        mut visit: impl FnMut(Vertex<V, Sh>) -> Result<(), E>,
    ) -> Result<(), E> {
        if self.seen.is_outside_view {
            return Ok(());
        }
        let mut lookup = self.seen.vertices.lookup();
        let indices = self.points.indices();
        for index in (0..indices.len()).map_while(|index| indices.get(index)) {
            let place = |index| self.seen.vertex_on_screen(index);
            // Of a mesh with fewer vertices than that which the points were checked with.
            let Some([vertex, ..]) = lookup.corners([index; 3], place) else { break };
            if vertex.is_on_screen() {
                visit(self.style.moved(*vertex))?;
            }
        }
        Ok(())
    }
}
