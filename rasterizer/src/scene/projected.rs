//! An object as the camera sees it, ready to be drawn.

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};

use super::{
    MeshOrder, Mode, Modes, Object, OnDemand, Order, Vertices,
    seen::{Corners, Rows, Seen},
};
use crate::{
    attribute::DepthFormat,
    camera::Camera,
    geometry::{Change as _, Projection, ScreenVertex},
    mesh::{MeshFace, MeshMaterial},
    numbers::Subpixel,
    output::{Blending, Readable, Target},
    raster::{DepthBias as _, Gradients, Triangle},
    shade::{Face, OnScreen, Shaded, Shader},
};

/// An object as the camera sees it; it can be drawn into any number of targets, such as the bands
/// of a frame.
///
/// `V` is where its vertices come from: the storage that they were projected into, or [`OnDemand`].
/// `O` is the order of its triangles.
#[derive(Clone, Copy, Debug)]
pub struct Projected<'a, V, P: Projection, Sh: Shader, M = Modes, O = MeshOrder> {
    pub(super) seen: Seen<'a, V, P, Sh, M>,
    pub(super) order: O,
}

impl<'a, V: Vertices<OnScreen<Sh>>, P: Projection, Sh: Shader, M: Mode> Projected<'a, V, P, Sh, M> {
    /// In the mesh's order. Valid once `seen.check` has succeeded.
    #[inline(always)]
    pub(super) fn new(object: &Object<'a, Sh, M>, camera: &Camera<P>, vertices: V) -> Self {
        Self { seen: Seen::new(object, camera, vertices), order: MeshOrder }
    }
}

impl<V, P: Projection, Sh: Shader, M, O> Projected<'_, V, P, Sh, M, O> {
    /// Whether the mesh is certain to lie outside the picture: then nothing of it is drawn.
    #[must_use]
    pub const fn is_outside_view(&self) -> bool {
        self.seen.is_outside_view
    }
}

impl<'v, S: Subpixel, D: DepthFormat, P: Projection, Sh: Shader, M, O>
    Projected<'_, &'v [ScreenVertex<S, D, OnScreen<Sh>>], P, Sh, M, O>
{
    /// The vertices on the screen, in the mesh's order; none if the mesh is out of the picture.
    #[must_use]
    pub const fn vertices(&self) -> &'v [ScreenVertex<S, D, OnScreen<Sh>>] {
        self.seen.vertices
    }
}

impl<'a, S: Subpixel, D: DepthFormat, P: Projection, Sh: Shader, M, O, const N: usize>
    Projected<'a, OnDemand<S, D, N>, P, Sh, M, O>
{
    /// The same with another number of vertices on the stack.
    #[must_use]
    pub fn with_cache<const K: usize>(self) -> Projected<'a, OnDemand<S, D, K>, P, Sh, M, O> {
        let vertices = self.seen.vertices.with_cache();
        Projected { seen: self.seen.over(vertices), order: self.order }
    }
}

impl<V, P, Sh, M, O> Projected<'_, V, P, Sh, M, O>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
    O: Order,
{
    /// Draws its triangles in their order.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no triangle after it.
    pub fn draw<T>(&self, target: &mut T) -> Result<(), T::Error>
    where
        T: Target<Color = Sh::Color, Depth = V::Depth>,
        M::Blending: Blending<T>,
    {
        self.seen.draw(&self.order, target)
    }

    /// Draws the depth of its triangles alone: the target keeps its colours. What is drawn
    /// afterwards is hidden by the object, as by one of the background's colour: for lines of which
    /// the hidden parts are left out ([`lines`](Self::lines)), and for pixels that take long to
    /// shade. The shader is not asked: pixels that it would discard have depth too.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no triangle after it.
    pub fn draw_depth<T>(&self, target: &mut T) -> Result<(), T::Error>
    where
        T: Readable<Color = Sh::Color, Depth = V::Depth>,
    {
        let seen = &self.seen;
        let window = target.window().intersection(&seen.viewport);
        if window.is_empty() {
            return Ok(());
        }
        let rows = Rows::of::<V::Subpixel>(&window);
        let mut lookup = seen.vertices.lookup();
        let reach = self.order.reach(&window, &seen.viewport);
        self.order.for_each_run(seen.tables(), |_, run| {
            let triangles = (&self.order, &reach, run);
            seen.for_each_visible(triangles, rows, &mut lookup, |_, corners, area| {
                let moved = seen.mode.bias().moved(corners, area);
                let bare = moved.map(|corner| corner.bare());
                let triangle = Triangle::with_area(bare.each_ref(), area);
                target.blend(&triangle, &window, |stored, _| stored)
            })
        })
    }

    /// Visits the triangles that [`draw`](Self::draw) draws, in the mesh's order: those left of
    /// the mesh's after culling and clipping, with their place in the mesh's table and their
    /// corners on the screen. A triangle that is clipped may leave several.
    ///
    /// # Errors
    ///
    /// Returns the first error of `visit`, and visits no triangle after it.
    pub fn for_each_triangle<E>(
        &self,
        mut visit: impl FnMut(usize, Corners<'_, V::Subpixel, V::Depth, Sh>) -> Result<(), E>,
    ) -> Result<(), E> {
        let seen = &self.seen;
        let all = (&MeshOrder, &(), 0..seen.triangle_count());
        seen.for_each_visible(all, Rows::ALL, &mut seen.vertices.lookup(), |index, corners, _| {
            visit(index, corners)
        })
    }

    /// The smallest rectangle that contains every pixel this object may touch, clipped to the
    /// viewport. Only the union of this and the previous frame's bounds needs redrawing and
    /// sending.
    #[must_use]
    pub fn bounds(&self) -> Option<Rectangle> {
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        self.seen.for_each_touching(|_, touched| {
            low = [low[0].min(touched.left), low[1].min(touched.top)];
            high = [high[0].max(touched.right), high[1].max(touched.bottom)];
        });
        let size = |axis: usize| (high[axis] - low[axis]) as u32;
        (low[0] < high[0])
            .then(|| Rectangle::new(Point::new(low[0], low[1]), Size::new(size(0), size(1))))
    }
}

impl<V, P, Sh, M> Seen<'_, V, P, Sh, M>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    /// Draws triangles in an order.
    #[inline(always)]
    pub(super) fn draw<O: Order, T>(&self, order: &O, target: &mut T) -> Result<(), T::Error>
    where
        T: Target<Color = Sh::Color, Depth = V::Depth>,
        M::Blending: Blending<T>,
    {
        let window = target.window().intersection(&self.viewport);
        if window.is_empty() {
            return Ok(());
        }
        let rows = Rows::of::<V::Subpixel>(&window);
        let mut lookup = self.vertices.lookup();
        let reach = order.reach(&window, &self.viewport);
        order.for_each_run(self.tables(), |material, run| {
            // Made when the first triangle needs it: in a band most materials are not self.
            let mut surface = None;
            let triangles = (order, &reach, run);
            self.for_each_visible(triangles, rows, &mut lookup, |index, corners, area| {
                if surface.is_none() {
                    self.prepare(material, &mut surface);
                }
                // `prepare` has put it there.
                let Some(surface) = &surface else { return Ok(()) };
                let mut moved = None;
                let corners = if M::Bias::MOVES {
                    moved.insert(self.mode.bias().moved(corners, area)).each_ref()
                } else {
                    corners
                };
                let triangle = Triangle::with_area(corners, area);
                let face = MeshFace::new(self.tables(), index, self.mode.shape().changes());
                let of_mesh = MeshMaterial::new(self.tables(), material);
                let blending = self.mode.blending().of_material(&of_mesh);
                match self.shader.face(surface, &face, &Gradients::of(&triangle)) {
                    Face::Solid(color) => blending.fill(target, &triangle, &window, color),
                    Face::Shaded(face) => {
                        let pixels = self.shader.pixels(surface, face);
                        let pixel = move |fragment| Shaded::<_, Sh>(pixels(fragment));
                        blending.shade(target, &triangle, &window, pixel)
                    }
                }
            })
        })
    }
}
