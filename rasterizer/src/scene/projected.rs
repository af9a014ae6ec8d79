//! An object as the camera sees it, ready to be drawn.

use core::{convert::Infallible, hint::black_box, marker::PhantomData, ops::Range};

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use heapless::Vec;

use super::{Object, Vertices, Walked, vertices::Lookup};
use crate::{
    camera::Camera,
    geometry::{
        ClipAll, ClipVertex, Clipping, CullBack, Culling, DepthFormat, MAX_CORNERS, PoseError,
        Projection, ScreenVertex, Subpixel, Transform, clip,
    },
    mesh::{FaceColumns, Material, MeshFace, MeshVertex, Tables, VertexColumns},
    raster::{Triangle, Window, first_center, signed_area},
    shade::Shader,
    target::Target,
};

/// The corners of a triangle on the screen.
type Corners<'s, S, D, Sh> = [&'s ScreenVertex<S, D, <Sh as Shader>::Varyings>; 3];
/// The corners of a clipped triangle.
type Polygon<S, D, Sh> = Vec<ScreenVertex<S, D, <Sh as Shader>::Varyings>, MAX_CORNERS>;

/// An object as the camera sees it; it can be drawn into any number of targets, such as the bands
/// of a frame.
///
/// `V` is where its vertices come from: the storage that they were projected into, or [`Walked`].
#[derive(Clone, Copy, Debug)]
pub struct Projected<'a, V, P: Projection, Sh: Shader, K = CullBack, L = ClipAll> {
    tables: &'a Tables<'a>,
    shader: Sh,
    transform: Transform<P>,
    vertices: V,
    /// Whether the mesh is certain to lie outside the picture; storage then holds no vertices.
    /// Without clipping nobody asks.
    is_hidden: bool,
    viewport: Window,
    choices: PhantomData<(K, L)>,
}

impl<'a, V, P: Projection, Sh: Shader, K: Culling, L: Clipping> Projected<'a, V, P, Sh, K, L> {
    /// An object whose mesh has the tables that its shader reads.
    #[inline(always)]
    pub(super) fn new(object: &Object<'a, Sh, K, L>, camera: &Camera<P>, vertices: V) -> Self {
        let tables = object.mesh.tables();
        let mut seen = Self {
            tables,
            shader: object.shader.in_object_space(&object.pose),
            transform: Transform::new(camera, &object.pose, tables),
            vertices,
            is_hidden: false,
            viewport: camera_window(&camera.viewport()),
            choices: PhantomData,
        };
        seen.is_hidden = L::CUTS && seen.transform.hides(object.mesh.bounds(), seen.size());
        seen
    }

    /// Whether the object is within the camera's numbers; if it isn't, nothing else can be asked.
    pub(super) fn check(&self) -> Result<(), PoseError> {
        self.transform.check()
    }

    /// The same with vertices from elsewhere.
    pub(super) fn over<W>(self, vertices: W) -> Projected<'a, W, P, Sh, K, L> {
        Projected {
            tables: self.tables,
            shader: self.shader,
            transform: self.transform,
            vertices,
            is_hidden: self.is_hidden,
            viewport: self.viewport,
            choices: PhantomData,
        }
    }

    /// Whether the mesh is certain to lie outside the picture: then nothing of it is drawn.
    #[must_use]
    pub const fn is_hidden(&self) -> bool {
        self.is_hidden
    }

    pub(super) const fn triangle_count(&self) -> usize {
        self.tables.triangles.len()
    }

    pub(super) const fn viewport(&self) -> &Window {
        &self.viewport
    }

    /// Width and height of the viewport in pixels.
    const fn size(&self) -> [i32; 2] {
        let Window { left, top, right, bottom } = self.viewport;
        [right - left, bottom - top]
    }
}

impl<'v, S: Subpixel, D: DepthFormat, P: Projection, Sh: Shader, K: Culling, L: Clipping>
    Projected<'_, &'v [ScreenVertex<S, D, Sh::Varyings>], P, Sh, K, L>
{
    /// Works all vertices out and keeps them in storage of their number.
    pub(super) fn place(&mut self, storage: &'v mut [ScreenVertex<S, D, Sh::Varyings>]) {
        if !self.is_hidden {
            place(self.tables, &self.shader, &self.transform, storage);
            self.vertices = storage;
        }
    }

    /// The vertices on the screen, in the mesh's order; none if the mesh is out of the picture.
    #[must_use]
    pub const fn vertices(&self) -> &'v [ScreenVertex<S, D, Sh::Varyings>] {
        self.vertices
    }
}

impl<
    'a,
    S: Subpixel,
    D: DepthFormat,
    P: Projection,
    Sh: Shader,
    K: Culling,
    L: Clipping,
    const N: usize,
> Projected<'a, Walked<S, D, N>, P, Sh, K, L>
{
    /// The same with another number of vertices on the stack.
    #[must_use]
    pub fn remembering<const M: usize>(self) -> Projected<'a, Walked<S, D, M>, P, Sh, K, L> {
        let vertices = self.vertices.remembering();
        self.over(vertices)
    }
}

impl<V: Vertices<Sh::Varyings>, P: Projection, Sh: Shader, K: Culling, L: Clipping>
    Projected<'_, V, P, Sh, K, L>
{
    /// Draws its triangles in the mesh's order.
    ///
    /// # Errors
    ///
    /// What the target says, at once.
    pub fn draw<T: Target<Color = Sh::Color, Depth = V::Depth>>(
        &self,
        target: &mut T,
    ) -> Result<(), T::Error> {
        self.draw_those(target, |run| run)
    }

    /// Draws some of its triangles: those that `chosen` picks, in their order, from each material's
    /// run.
    pub(super) fn draw_those<T, I>(
        &self,
        target: &mut T,
        mut chosen: impl FnMut(Range<usize>) -> I,
    ) -> Result<(), T::Error>
    where
        T: Target<Color = Sh::Color, Depth = V::Depth>,
        I: Iterator<Item = usize>,
    {
        let window = target.window().intersection(&self.viewport);
        if window.is_empty() {
            return Ok(());
        }
        let rows = Rows::of::<V::Subpixel>(&window);
        let mut lookup = self.vertices.lookup();
        let faces = FaceColumns::new(self.tables);
        let mut first = 0;
        for material in self.tables.materials {
            let end = first + material.triangle_count as usize;
            // Worked out when the first triangle needs it: in a band most materials are not seen.
            let mut surface = None;
            self.for_each_visible(
                first..end,
                &mut chosen,
                rows,
                &mut lookup,
                |index, corners, area| {
                    if surface.is_none() {
                        self.prepare(material, &mut surface);
                    }
                    // `prepare` has put it there.
                    let Some(surface) = &surface else { return Ok(()) };
                    let triangle = Triangle::new(corners, area);
                    match self.shader.face(surface, &MeshFace::new(&faces, index)) {
                        Some(color) => target.fill(triangle, &window, color),
                        None => target.shade(triangle, &window, |varyings| {
                            self.shader.pixel(surface, varyings)
                        }),
                    }
                },
            )?;
            first = end;
        }
        Ok(())
    }

    /// Puts a material's surface in place. A function of its own: compilers copy it once or twice
    /// on the way, and the stack that takes is free again when triangles are drawn.
    #[inline(never)]
    fn prepare(&self, material: &Material, surface: &mut Option<Sh::Surface>) {
        *surface = Some(self.shader.surface(material));
    }

    /// Visits the triangles that [`draw`](Self::draw) draws, in its order: those that are left of
    /// the mesh's after culling and clipping, with their place in the mesh's table and their
    /// corners on the screen. A triangle that is clipped may leave several.
    ///
    /// # Errors
    ///
    /// What `visit` ends in, at once.
    pub fn for_each_triangle<E>(
        &self,
        mut visit: impl FnMut(usize, Corners<'_, V::Subpixel, V::Depth, Sh>) -> Result<(), E>,
    ) -> Result<(), E> {
        let all = 0..self.triangle_count();
        self.for_each_visible(
            all,
            |all| all,
            Rows::ALL,
            &mut self.vertices.lookup(),
            |index, corners, _| visit(index, corners),
        )
    }

    /// The rectangle of the pixels that its triangles may touch, as far as they lie in the
    /// viewport: a frame or bands of it and of the one before are all that has to be drawn and
    /// sent anew.
    #[must_use]
    pub fn bounds(&self) -> Option<Rectangle> {
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        self.for_each_touching(|_, touched| {
            low = [low[0].min(touched.left), low[1].min(touched.top)];
            high = [high[0].max(touched.right), high[1].max(touched.bottom)];
        });
        let size = |axis: usize| (high[axis] - low[axis]) as u32;
        (low[0] < high[0])
            .then(|| Rectangle::new(Point::new(low[0], low[1]), Size::new(size(0), size(1))))
    }

    /// Visits the triangles that may touch pixels of the viewport, with the smallest window round
    /// the centres inside them. A triangle that is clipped may be visited several times.
    pub(super) fn for_each_touching(&self, mut visit: impl FnMut(usize, &Window)) {
        let (all, rows) = (0..self.triangle_count(), Rows::of::<V::Subpixel>(&self.viewport));
        let Ok(()) = self.for_each_visible(
            all,
            |all| all,
            rows,
            &mut self.vertices.lookup(),
            |index, corners, _| {
                let touched = window_of(corners).intersection(&self.viewport);
                if !touched.is_empty() {
                    visit(index, &touched);
                }
                Ok::<(), Infallible>(())
            },
        );
    }

    /// Visits those triangles that `chosen` picks from a run and that are seen and may reach
    /// `rows`, with their signed areas. A function of its own: the loop needs its registers.
    #[inline(never)]
    fn for_each_visible<E, I: Iterator<Item = usize>>(
        &self,
        run: Range<usize>,
        chosen: impl FnOnce(Range<usize>) -> I,
        rows: Rows,
        lookup: &mut V::Lookup,
        mut visit: impl FnMut(usize, Corners<'_, V::Subpixel, V::Depth, Sh>, i64) -> Result<(), E>,
    ) -> Result<(), E> {
        if self.is_hidden {
            return Ok(());
        }
        let table = self.tables.triangles;
        let columns = VertexColumns::new(self.tables);
        // Cut to the table here, where compilers see that no index of the run lies beyond it.
        for index in chosen(run.start..run.end.min(table.len())) {
            let Some(indices) = table.get(index) else {
                break;
            };
            let place =
                |index| on_screen(&self.shader, &self.transform, &MeshVertex::new(&columns, index));
            let Some(corners) = lookup.corners(indices, place) else {
                break;
            };
            if corners.iter().all(|corner| corner.is_on_screen()) {
                if let Some(area) = Self::visible_area(corners, rows) {
                    visit(index, corners, area)?;
                }
            } else if L::CUTS {
                // Most triangles that reach out of the guard band have nothing in the picture.
                if self.hides(index) {
                    continue;
                }
                let mut polygon = Polygon::<V::Subpixel, V::Depth, Sh>::new();
                self.clip(index, &mut polygon);
                let Some((hub, rim)) = polygon.split_first() else {
                    continue;
                };
                for pair in rim.windows(2) {
                    let corners = [hub, &pair[0], &pair[1]];
                    if let Some(area) = Self::visible_area(corners, rows) {
                        visit(index, corners, area)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// The signed area of a triangle that is seen and may reach `rows`.
    #[inline(always)]
    fn visible_area(corners: Corners<'_, V::Subpixel, V::Depth, Sh>, rows: Rows) -> Option<i64> {
        let area = signed_area(corners);
        // Counter-clockwise is negative, as y runs downwards.
        let is_seen = (area < 0 && K::FRONT) || (area > 0 && K::BACK);
        (is_seen && !rows.are_missed_by(corners.map(|corner| corner.y))).then_some(area)
    }

    /// Whether a triangle is certain to lie outside the picture: all its corners beyond one and the
    /// same plane.
    // The fold of the box's test: in one function with it, it took 230 bytes more of a parallel
    // projection's stack.
    #[cold]
    #[inline(never)]
    fn hides(&self, index: usize) -> bool {
        let indices = self.tables.triangles.get(index).unwrap_or_default();
        let beyond_all = indices.iter().fold(u8::MAX, |bits, &index| {
            let position = self.tables.positions.get(index).unwrap_or_default();
            bits & self.transform.beyond(position, self.size())
        });
        beyond_all != 0
    }

    /// What near plane, far plane and guard band leave of a triangle, into a polygon that is still
    /// empty: one that is returned is copied.
    #[cold]
    #[inline(never)]
    fn clip(&self, index: usize, corners: &mut Polygon<V::Subpixel, V::Depth, Sh>) {
        let indices = self.tables.triangles.get(index).unwrap_or_default();
        let columns = VertexColumns::new(self.tables);
        let triangle = indices.into_iter().map(|index| {
            let vertex = MeshVertex::new(&columns, index);
            let [x, y, z] = self.transform.few_to_clip(vertex.position());
            let varyings = self.shader.vertex(&vertex);
            ClipVertex { x, y, z, varyings }
        });
        clip(triangle, &self.transform, |vertex| {
            // There are as many places as `clip` has.
            let _ = corners.push(self.transform.clip_to_screen(vertex));
        });
    }
}

/// The pixels of a camera's viewport, which is nowhere near the ends of `i32`: 40 bytes of flash
/// less than `Window::new`.
const fn camera_window(viewport: &Rectangle) -> Window {
    let (corner, size) = (viewport.top_left, viewport.size);
    Window {
        left: corner.x,
        top: corner.y,
        right: corner.x + size.width as i32,
        bottom: corner.y + size.height as i32,
    }
}

/// Works out the vertices on the screen, as many as there is room for. A function of its own: the
/// loop needs its registers.
#[inline(never)]
fn place<S: Subpixel, D: DepthFormat, P: Projection, Sh: Shader>(
    tables: &Tables<'_>,
    shader: &Sh,
    transform: &Transform<P>,
    vertices: &mut [ScreenVertex<S, D, Sh::Varyings>],
) {
    let count = vertices.len();
    let Some(columns) = VertexColumns::new(tables).first(count, Sh::TABLES) else {
        return;
    };
    // A copy on the stack that anyone might write to: compilers read it from there for each vertex.
    // Else they take its numbers for constants of the loop, spill them, and need a copy of a
    // factor for each multiplication.
    let mut transform = transform.by_parts();
    black_box(&mut transform);
    for (index, vertex) in (0..count).zip(vertices) {
        black_box(());
        *vertex = on_screen(shader, &transform, &MeshVertex::new(&columns, index));
    }
}

/// A vertex on the screen.
#[inline(always)]
fn on_screen<S: Subpixel, D: DepthFormat, P: Projection, Sh: Shader>(
    shader: &Sh,
    transform: &Transform<P>,
    vertex: &MeshVertex<'_>,
) -> ScreenVertex<S, D, Sh::Varyings> {
    let varyings = shader.vertex(vertex);
    transform.clip_to_screen(transform.object_to_clip(vertex.position(), varyings))
}

/// The columns and rows whose centres lie between the corners of a triangle.
fn window_of<S: Subpixel, D, V>(corners: [&ScreenVertex<S, D, V>; 3]) -> Window {
    let [a, b, c] = corners;
    Window {
        left: first_center::<S>(a.x.min(b.x).min(c.x)),
        top: first_center::<S>(a.y.min(b.y).min(c.y)),
        right: first_center::<S>(a.x.max(b.x).max(c.x)),
        bottom: first_center::<S>(a.y.max(b.y).max(c.y)),
    }
}

/// Rows of pixels, by their first and last centre in sub-pixels.
#[derive(Clone, Copy, Debug)]
struct Rows {
    first: i32,
    last: i32,
}

impl Rows {
    const ALL: Self = Self { first: i32::MIN, last: i32::MAX };

    /// Those of a window that is not empty.
    const fn of<S: Subpixel>(window: &Window) -> Self {
        let half = 1 << (S::BITS - 1);
        Self {
            first: (window.top << S::BITS) + half,
            last: ((window.bottom - 1) << S::BITS) + half,
        }
    }

    /// Whether a triangle with corners at these heights ends above all centres or begins below:
    /// most of a mesh's triangles do so in most of a frame's bands.
    #[inline(always)]
    const fn are_missed_by(self, [a, b, c]: [i32; 3]) -> bool {
        (a < self.first && b < self.first && c < self.first)
            || (a > self.last && b > self.last && c > self.last)
    }
}
