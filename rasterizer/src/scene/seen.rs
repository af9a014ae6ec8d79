//! An object as the camera sees it: which of its triangles are visible, and where.

use core::{array, convert::Infallible, ops::Range};

use heapless::Vec;

use super::{MeshOrder, Mode, Object, RowRange, Vertices, order::Sequence, vertices::Lookup};
use crate::{
    attribute::{DepthFormat, Interpolate},
    camera::Camera,
    geometry::{
        Change as _, ClipVertex, Clipping, Corner, Culling, MAX_CORNERS, ObjectView, PoseError,
        Projection, ScreenVertex, Transform, UserPlanes as _, clip,
    },
    mesh::{Material, Mesh, MeshMaterial, MeshVertex, Tables},
    numbers::{Subpixel, codegen},
    raster::{Window, first_center, signed_area},
    shade::{OnScreen, Shader},
};

/// The corners of a triangle on the screen.
pub(super) type Corners<'s, S, D, Sh> = [&'s ScreenVertex<S, D, OnScreen<Sh>>; 3];
/// A coordinate in clip space of vertices from `V`.
pub(super) type CoordinateOf<V, Sh> =
    <<V as Vertices<OnScreen<Sh>>>::Subpixel as Subpixel>::Coordinate;
/// The corners of a clipped triangle.
type Polygon<S, D, Sh> = Vec<ScreenVertex<S, D, OnScreen<Sh>>, MAX_CORNERS>;

/// What all orders of an object's triangles share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen<'a, V, P: Projection, Sh: Shader, M> {
    pub(super) mesh: &'a Mesh<'a>,
    pub(super) shader: Sh,
    pub(super) transform: Transform<P>,
    pub(super) vertices: V,
    /// Whether the mesh is certain to lie outside the picture; storage then holds no vertices.
    /// Always false with `ClipNone`.
    pub(super) is_outside_view: bool,
    pub(super) viewport: Window,
    pub(super) mode: M,
}

impl<'a, V: Vertices<OnScreen<Sh>>, P: Projection, Sh: Shader, M: Mode> Seen<'a, V, P, Sh, M> {
    /// An object whose mesh has the tables that its shader reads. Valid once
    /// [`check`](Self::check) has succeeded.
    #[inline(always)]
    pub(super) fn new(object: &Object<'a, Sh, M>, camera: &Camera<P>, vertices: V) -> Self {
        let (shape, changed);
        shape = object.mode.shape();
        let mesh = if M::Shape::CHANGES {
            changed = shape.mesh(object.mesh);
            &changed
        } else {
            object.mesh
        };
        let view = ObjectView::new(mesh, &object.pose, camera);
        let mut seen = Self {
            mesh: object.mesh,
            shader: object.shader.for_object(&view),
            transform: Transform::new::<V::Subpixel>(
                camera,
                object.mode.clipping().axes(),
                shape.posed(&object.pose),
                object.mesh,
            ),
            vertices,
            is_outside_view: false,
            viewport: Window::within_range(&camera.viewport()),
            mode: object.mode.placed(&object.pose, object.mesh),
        };
        seen.is_outside_view = M::Clipping::CUTS
            && seen
                .transform
                .is_outside_view::<CoordinateOf<V, Sh>>(object.mesh.bounds(), seen.size());
        if M::Clipping::CUTS && !seen.is_outside_view {
            let bounds = object.mesh.bounds();
            let corners = (0..8).map(|index| bounds.corner(index));
            seen.is_outside_view = seen.mode.clipping().excludes(corners);
        }
        seen
    }
}

impl<'a, V, P: Projection, Sh: Shader, M> Seen<'a, V, P, Sh, M> {
    /// Checks that the object fits the camera's number range. Call this first: no other method is
    /// valid until it succeeds.
    pub(super) const fn check(&self) -> Result<(), PoseError> {
        self.transform.check(self.is_outside_view)
    }

    /// The same with vertices from elsewhere.
    pub(super) fn over<W>(self, vertices: W) -> Seen<'a, W, P, Sh, M> {
        Seen {
            mesh: self.mesh,
            shader: self.shader,
            transform: self.transform,
            vertices,
            is_outside_view: self.is_outside_view,
            viewport: self.viewport,
            mode: self.mode,
        }
    }

    #[inline(always)]
    pub(super) const fn tables(&self) -> &'a Tables<'a> {
        self.mesh.tables()
    }

    pub(super) const fn triangle_count(&self) -> usize {
        self.tables().triangles.len()
    }

    /// Width and height of the viewport in pixels.
    const fn size(&self) -> [i32; 2] {
        let Window { left, top, right, bottom } = self.viewport;
        [right - left, bottom - top]
    }

    /// Builds a material's surface in place.
    // codegen: not inlined, so that its temporaries leave the stack before triangles are drawn. It
    // gets the material in two registers: a `MeshMaterial` would be passed in memory.
    #[inline(never)]
    pub(super) fn prepare(&self, material: (usize, &Material), surface: &mut Option<Sh::Surface>) {
        *surface = Some(self.shader.surface(&MeshMaterial::new(self.tables(), material)));
    }
}

impl<'v, S: Subpixel, D: DepthFormat, P: Projection, Sh: Shader, M: Mode>
    Seen<'_, &'v [ScreenVertex<S, D, OnScreen<Sh>>], P, Sh, M>
{
    /// Projects all vertices into `storage`, which must hold exactly as many as the mesh has.
    pub(super) fn place(&mut self, storage: &'v mut [ScreenVertex<S, D, OnScreen<Sh>>]) {
        if !self.is_outside_view {
            place(self.tables(), &self.shader, &self.transform, &self.mode, storage);
            self.vertices = storage;
        }
    }
}

impl<V, P, Sh, M> Seen<'_, V, P, Sh, M>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    /// The rows of the viewport that the object may reach.
    pub(super) fn rows(&self) -> RowRange {
        if self.is_outside_view {
            return RowRange::EMPTY;
        }
        let rows = self.transform.rows_of::<V::Subpixel>(self.mesh.bounds(), &self.viewport);
        RowRange::new(rows, self.viewport.top)
    }

    /// Visits the triangles that may touch pixels of the viewport, with the smallest window round
    /// the centres inside them. A triangle that is clipped may be visited several times.
    pub(super) fn for_each_touching(&self, mut visit: impl FnMut(usize, &Window)) {
        let all = (&MeshOrder, &(), 0..self.triangle_count());
        let rows = Rows::of::<V::Subpixel>(&self.viewport);
        let mut lookup = self.vertices.lookup();
        let Ok(()) = self.for_each_visible(all, rows, &mut lookup, |index, corners, _| {
            let touched = window_of(corners).intersection(&self.viewport);
            if !touched.is_empty() {
                visit(index, &touched);
            }
            Ok::<(), Infallible>(())
        });
    }

    /// [`Transform::distance`] of a triangle: more is farther away.
    pub(super) fn distance(&self, index: usize) -> i32 {
        let corners = self.tables().triangles.get(index).unwrap_or_default();
        let mut sum = [0; 3];
        for corner in corners {
            let position = self.vertex(corner).table_position();
            for (sum, c) in sum.iter_mut().zip(position) {
                *sum += i32::from(c);
            }
        }
        self.transform.distance::<CoordinateOf<V, Sh>>(sum)
    }

    /// Visits those of the triangles that are seen and may reach `rows`, with their signed areas.
    // codegen: not inlined, because the loop needs its registers.
    #[inline(never)]
    pub(super) fn for_each_visible<E, R: Sequence>(
        &self,
        (order, reach, run): (&R, &R::Reach, Range<usize>),
        rows: Rows,
        lookup: &mut V::Lookup,
        mut visit: impl FnMut(usize, Corners<'_, V::Subpixel, V::Depth, Sh>, i64) -> Result<(), E>,
    ) -> Result<(), E> {
        if self.is_outside_view {
            return Ok(());
        }
        let table = self.tables().triangles;
        // Cut to the table here, where compilers see that no index of the run lies beyond it.
        for index in order.indices(run.start..run.end.min(table.len()), reach) {
            let Some(indices) = table.get(index) else {
                break;
            };
            let place = |index| self.vertex_on_screen(index);
            let Some(corners) = lookup.corners(indices, place) else {
                break;
            };
            if corners.iter().all(|corner| corner.is_on_screen()) {
                if let Some(area) = self.visible_area(corners, rows) {
                    if OnScreen::<Sh>::DIFFERS_BY_TRIANGLE {
                        let own: [_; 3] = array::from_fn(|corner| corners[corner].at(corner));
                        visit(index, own.each_ref(), area)?;
                    } else {
                        visit(index, corners, area)?;
                    }
                }
            } else if M::Clipping::CUTS {
                // Most triangles that reach out of the guard band have nothing in the picture.
                if self.is_triangle_outside_view(index) {
                    continue;
                }
                // With planes of the user's own what they leave of a triangle is cut at the other
                // planes, triangle by triangle. It is computed again for each of them: it would lie
                // on the stack while pixels are drawn.
                let parts = if M::Clipping::EXIST { self.kept_parts(index) } else { 1 };
                for part in 0..parts {
                    let mut polygon = Polygon::<V::Subpixel, V::Depth, Sh>::new();
                    self.clip(index, part, &mut polygon);
                    let Some((hub, rim)) = polygon.split_first() else {
                        continue;
                    };
                    for pair in rim.windows(2) {
                        let corners = [hub, &pair[0], &pair[1]];
                        if let Some(area) = self.visible_area(corners, rows) {
                            visit(index, corners, area)?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// A vertex of the mesh.
    #[inline(always)]
    fn vertex(&self, index: usize) -> MeshVertex<'_> {
        MeshVertex::new(self.tables(), index, self.mode.shape().changes())
    }

    /// Projects a vertex.
    #[inline(always)]
    pub(super) fn vertex_on_screen(
        &self,
        index: usize,
    ) -> ScreenVertex<V::Subpixel, V::Depth, OnScreen<Sh>> {
        let vertex = self.vertex(index);
        on_screen(&self.shader, &self.transform, self.mode.clipping(), &vertex)
    }

    /// The vertices of a triangle that is to be clipped.
    // codegen: not inlined, because each copy takes a hundred bytes (`lines-hidden`).
    #[cold]
    #[inline(never)]
    fn indices(&self, index: usize) -> [usize; 3] {
        self.tables().triangles.get(index).unwrap_or_default()
    }

    /// A vertex that is to be clipped.
    // codegen: not inlined, because it is repeated for each corner and each end of a line then.
    #[cold]
    #[inline(never)]
    pub(super) fn vertex_in_clip_space(
        &self,
        index: usize,
    ) -> ClipVertex<CoordinateOf<V, Sh>, Sh::Varyings> {
        let vertex = self.vertex(index);
        let [x, y, z] = self.transform.object_to_clip_outlined(vertex.table_position());
        ClipVertex { x, y, z, varyings: self.shader.vertex(&vertex) }
    }

    /// The signed area of a triangle that is seen and may reach `rows`.
    #[inline(always)]
    fn visible_area(
        &self,
        corners: Corners<'_, V::Subpixel, V::Depth, Sh>,
        rows: Rows,
    ) -> Option<i64> {
        let area = signed_area(corners);
        // Counter-clockwise is negative, as y runs downwards.
        let side = if self.mode.shape().is_mirrored() { -area } else { area };
        let is_seen = (side < 0 && M::Culling::FRONT) || (side > 0 && M::Culling::BACK);
        (is_seen && !rows.are_missed_by(corners.map(|corner| corner.y))).then_some(area)
    }

    /// Whether a triangle is certain to lie outside the picture: all its corners beyond one and the
    /// same plane.
    // codegen: separate from the box test; sharing one function cost 230 bytes of stack in a
    // parallel projection.
    #[cold]
    #[inline(never)]
    fn is_triangle_outside_view(&self, index: usize) -> bool {
        let indices = self.indices(index);
        let beyond_all = indices.iter().fold(u8::MAX, |bits, &index| {
            let position = self.vertex(index).table_position();
            bits & self.transform.beyond::<CoordinateOf<V, Sh>>(position, self.size())
        });
        beyond_all != 0
    }

    /// Clips a triangle against the near plane, far plane and guard band, into `corners`, which
    /// must be empty: of the triangles that the user's planes leave of it, the one of this number.
    /// (An out-parameter, because a returned polygon would be copied.)
    #[cold]
    #[inline(never)]
    fn clip(&self, index: usize, part: usize, corners: &mut Polygon<V::Subpixel, V::Depth, Sh>) {
        let visit = |vertex| {
            // There are as many places as `clip` has.
            let _ = corners.push(self.transform.place_on_screen(vertex));
        };
        if M::Clipping::EXIST {
            let kept = self.kept(index);
            let Some((hub, rim)) = kept.split_first() else { return };
            let Some(pair) = rim.windows(2).nth(part) else { return };
            clip([*hub, pair[0], pair[1]], &self.transform, visit);
        } else {
            let indices = self.indices(index);
            let triangle = indices
                .into_iter()
                .enumerate()
                .map(|(corner, index)| self.vertex_in_clip_space(index).at(corner));
            clip(triangle, &self.transform, visit);
        }
    }

    /// How many triangles the user's planes leave of one.
    #[cold]
    #[inline(never)]
    fn kept_parts(&self, index: usize) -> usize {
        self.kept(index).len().saturating_sub(2)
    }

    /// What the user's planes leave of a triangle: the corners of a convex polygon.
    #[inline(always)]
    fn kept(
        &self,
        index: usize,
    ) -> Vec<ClipVertex<CoordinateOf<V, Sh>, Sh::Varyings>, MAX_CORNERS> {
        let triangle = self.indices(index);
        let mut kept = Vec::new();
        let mut corner = 0..;
        // codegen: not by `from_fn`, whose index is checked where the loop stays one.
        let triangle = triangle.map(|index| {
            let (position, vertex) = self.corner(index);
            (position, vertex.at(corner.next().unwrap_or_default()))
        });
        self.mode.clipping().cut(&triangle, &mut kept);
        kept
    }

    /// A vertex that is to be clipped, with its position.
    #[inline(always)]
    pub(super) fn corner(&self, index: usize) -> Corner<CoordinateOf<V, Sh>, Sh::Varyings> {
        (self.vertex(index).table_position(), self.vertex_in_clip_space(index))
    }
}

/// Projects vertices from the first on, as many as `vertices` has.
// codegen: not inlined, because the loop needs its registers.
#[inline(never)]
fn place<S: Subpixel, D: DepthFormat, P: Projection, Sh: Shader>(
    tables: &Tables<'_>,
    shader: &Sh,
    transform: &Transform<P>,
    mode: &impl Mode,
    vertices: &mut [ScreenVertex<S, D, OnScreen<Sh>>],
) {
    let count = vertices.len();
    let Some(tables) = Sh::TABLES.of_vertices(tables, count) else {
        return;
    };
    // codegen: an opaque copy, read from the stack for every vertex. Otherwise LLVM hoists its
    // fields out of the loop, spills them, and copies a factor before each multiplication.
    // Surfaces of over 16 words are copied by `memcpy`: where it is linked, it copies this too.
    let mut transform =
        if size_of::<Sh::Surface>() > 64 { *transform } else { transform.clone_by_fields() };
    codegen::in_memory(&mut transform);
    for (index, vertex) in (0..count).zip(vertices) {
        codegen::keep_rolled();
        let of_mesh = MeshVertex::new(&tables, index, mode.shape().changes());
        *vertex = on_screen(shader, &transform, mode.clipping(), &of_mesh);
    }
}

/// A vertex on the screen.
#[inline(always)]
fn on_screen<S: Subpixel, D: DepthFormat, P: Projection, Sh: Shader>(
    shader: &Sh,
    transform: &Transform<P>,
    clipping: &impl Clipping,
    vertex: &MeshVertex<'_>,
) -> ScreenVertex<S, D, OnScreen<Sh>> {
    if !clipping.keeps(vertex.table_position()) {
        return ScreenVertex::off_screen(Interpolate::ZERO);
    }
    let varyings = shader.vertex(vertex);
    transform.clip_to_screen(transform.object_to_clip(vertex.table_position(), varyings))
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
pub(super) struct Rows {
    first: i32,
    last: i32,
}

impl Rows {
    pub(super) const ALL: Self = Self { first: i32::MIN, last: i32::MAX };

    /// Those of a window that is not empty.
    pub(super) const fn of<S: Subpixel>(window: &Window) -> Self {
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
