//! Lines between the vertices of an object.

use fixed::types::U0F32;

use super::{Mode, Projected, Vertices, seen::Seen, style::Style, vertices::Lookup as _};
use crate::{
    geometry::{Clipping, Projection, ScreenVertex, UserPlanes as _, clip_line},
    mesh::Lines,
    output::{Blending, Target},
    raster::{Fragment, Line},
    shade::{OnScreen, Sample, Shader},
};

/// The ends of a line on the screen.
type Ends<V, Sh> = [ScreenVertex<SubpixelOf<V, Sh>, DepthOf<V, Sh>, OnScreen<Sh>>; 2];
type SubpixelOf<V, Sh> = <V as Vertices<OnScreen<Sh>>>::Subpixel;
type DepthOf<V, Sh> = <V as Vertices<OnScreen<Sh>>>::Depth;

/// Lines between the vertices of an object that is projected: what [`Projected::lines`] makes.
///
/// A line owns the pixels that [`Line`] tells, is cut where its triangles are cut, and is tested
/// against depth like them. It has no front and no back.
#[derive(Clone, Copy, Debug)]
pub struct ProjectedLines<'p, 'a, V, P: Projection, Sh: Shader, M> {
    pub(super) seen: &'p Seen<'a, V, P, Sh, M>,
    lines: &'p Lines<'p>,
    pub(super) style: Style,
}

impl<'a, V, P: Projection, Sh: Shader, M, O> Projected<'a, V, P, Sh, M, O> {
    /// Lines of its mesh: of any table that was checked with it.
    ///
    /// They are drawn after its triangles or without them, by the same vertices, one pixel wide.
    #[must_use]
    pub const fn lines<'p>(&'p self, lines: &'p Lines<'p>) -> ProjectedLines<'p, 'a, V, P, Sh, M> {
        ProjectedLines { seen: &self.seen, lines, style: Style::PLAIN }
    }
}

impl<V, P: Projection, Sh: Shader, M> ProjectedLines<'_, '_, V, P, Sh, M> {
    /// The same lines in another width in pixels.
    #[must_use]
    pub const fn wide(self, width: u8) -> Self {
        Self { style: Style { pixels: width, ..self.style }, ..self }
    }

    /// The same lines moved towards the viewer by so much depth (near / w; 2<sup>-16</sup> is a
    /// unit of the format `u16`), for lines that lie in a surface.
    ///
    /// Pixels of a line are up to half a pixel away from it. A surface beside them may be nearer
    /// there: give that object a [`Bias`](crate::raster::Bias) instead, which depends on its slope.
    #[must_use]
    pub const fn nearer(self, depth: U0F32) -> Self {
        Self { style: Style { nearer: depth, ..self.style }, ..self }
    }

    /// The same lines in another material of the mesh, by its place in the table; at first it is
    /// the first one. It tells [`draw`](Self::draw) a colour.
    #[must_use]
    pub const fn of_material(self, index: usize) -> Self {
        Self { style: Style { material: index, ..self.style }, ..self }
    }
}

impl<V, P, Sh, M> ProjectedLines<'_, '_, V, P, Sh, M>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    /// Draws all lines in one colour.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no line after it.
    pub fn fill<T>(&self, color: Sh::Color, target: &mut T) -> Result<(), T::Error>
    where
        T: Target<Color = Sh::Color, Depth = V::Depth>,
        M::Blending: Blending<T>,
    {
        let window = target.window().intersection(&self.seen.viewport);
        let material = self.style.mesh_material(self.seen.tables());
        let blending = self.seen.mode.blending().of_material(&material);
        self.for_each_on_screen(|ends| {
            let ends = ends.map(|end| end.bare());
            let line = Line::between(ends.each_ref(), self.style.pixels);
            blending.fill(target, &line, &window, color)
        })
    }

    /// Draws all lines in the colours of the object's shader, interpolated along them: of a shader
    /// that computes nothing for a triangle as a whole, such as
    /// [`Gouraud`](crate::shade::Gouraud) or [`Colored`](crate::shade::Colored).
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no line after it.
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
        self.for_each_on_screen(|ends| {
            let line = Line::between(ends.each_ref(), self.style.pixels);
            let pixel =
                |fragment: Fragment<Sample<Sh>>| self.seen.shader.pixel(surface, &(), fragment);
            blending.shade(target, &line, &window, pixel)
        })
    }

    /// Visits the lines that [`draw`](Self::draw) draws, or the parts of them that are left after
    /// clipping, each by its start and its end on the screen.
    ///
    /// # Errors
    ///
    /// Returns the first error of `visit`, and visits no line after it.
    pub fn for_each_line<E>(
        &self,
        mut visit: impl FnMut([&ScreenVertex<V::Subpixel, V::Depth, OnScreen<Sh>>; 2]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.for_each_on_screen(|ends| visit(ends.each_ref()))
    }

    /// Visits the ends of the lines, or of the parts of them that are left after clipping.
    #[inline(never)]
    pub(super) fn for_each_on_screen<E>(
        &self,
        mut visit: impl FnMut(Ends<V, Sh>) -> Result<(), E>,
    ) -> Result<(), E> {
        if self.seen.is_outside_view {
            return Ok(());
        }
        let mut lookup = self.seen.vertices.lookup();
        let segments = self.lines.segments();
        for [from, to] in (0..segments.len()).map_while(|index| segments.get(index)) {
            let place = |index| self.seen.vertex_on_screen(index);
            // Of a mesh with fewer vertices than that which the lines were checked with.
            let Some([a, b, _]) = lookup.corners([from, to, to], place) else { break };
            let ends = [*a, *b];
            let ends = if ends.iter().all(|end| end.is_on_screen()) {
                Some(ends)
            } else if M::Clipping::CUTS {
                self.clipped([from, to])
            } else {
                None
            };
            if let Some(ends) = ends {
                visit(ends.map(|end| self.style.moved(end)))?;
            }
        }
        Ok(())
    }

    /// The part of a line between near plane, far plane, guard band and the user's planes.
    #[cold]
    #[inline(never)]
    fn clipped(&self, ends: [usize; 2]) -> Option<Ends<V, Sh>> {
        let transform = &self.seen.transform;
        let ends = if M::Clipping::EXIST {
            self.seen.mode.clipping().cut_line(&ends.map(|index| self.seen.corner(index)))?
        } else {
            ends.map(|index| self.seen.vertex_in_clip_space(index))
        };
        clip_line(ends, transform).map(|ends| ends.map(|end| transform.place_on_screen(end)))
    }
}
