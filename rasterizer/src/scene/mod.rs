//! Objects, and the two steps of drawing one: project its vertices, then draw its triangles.
//!
//! For a frame of several objects call [`Object::draw`] once for each, or put them into a
//! [`Scene`], which is drawn by one call, in bands too; all is compiled for their shaders. Where
//! the frame is drawn in bands, [`Object::project`] does the work on the vertices once,
//! [`Projected::binned`] finds out which triangles reach which band, and [`Projected::draw`] is
//! called for each band. [`Projected::in_parts`] draws a mesh of parts that planes keep apart from
//! back to front. [`Projected::back_to_front`] sorts triangles for objects that are blended,
//! [`Painter`] those of several objects. [`Object::project_on_demand`] needs no storage for
//! vertices. [`Needs`] gives the length of every buffer at compile time.
//!
//! # Stack discipline
//!
//! A frame is drawn within 2 KB of stack. Three habits keep it so, and they explain every exception
//! to plain code in this module: a step that is done before pixels are drawn is a function that is
//! not inlined, so that its temporaries leave the stack; a large value is built in place, by an
//! out-parameter, instead of returned and copied; a value that is built before it is known to be
//! valid ([`Projected`]) is checked by the function that builds it, before that returns it.

mod back_to_front;
mod bins;
mod contents;
mod error;
mod in_parts;
mod levels;
mod lines;
mod mode;
mod morphed;
mod needs;
mod order;
mod painter;
mod particles;
mod points;
mod projected;
mod seen;
mod several;
mod smooth_lines;
mod sort;
mod style;
mod vertices;

pub use back_to_front::BackToFront;
pub use bins::{Bins, bin_words};
pub use contents::{Contents, DrawContents, Each, each};
pub use error::{DrawError, ProjectError};
pub use in_parts::{InParts, TableOrder};
pub use levels::Levels;
pub use lines::ProjectedLines;
pub use mode::{Mode, Modes};
pub use needs::Needs;
pub use order::{MeshOrder, Order};
pub use painter::{DrawnInto, Objects, Painter};
pub use particles::{FarthestFirst, InSlice, ParticleOrder, Particles, SeenParticles};
pub use points::ProjectedPoints;
pub use projected::Projected;
pub use several::{RowRange, Scene};
pub use smooth_lines::SmoothLines;
pub use vertices::{OnDemand, Vertices};

use crate::{
    attribute::DepthFormat,
    camera::Camera,
    geometry::{AnyShape, Clipping, Culling, Pose, Projection, ScreenVertex, Shape},
    mesh::Mesh,
    numbers::{Matrix, Subpixel},
    output::{Blending, Target},
    raster::DepthBias,
    shade::{OnScreen, Shader},
};

/// An object whose vertices are in storage.
type Stored<'v, 'a, S, D, P, Sh, M> =
    Projected<'a, &'v [ScreenVertex<S, D, OnScreen<Sh>>], P, Sh, M>;

/// A mesh in a pose, with a shader and a [`Mode`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Object<'a, Sh, M = Modes> {
    mesh: &'a Mesh<'a>,
    pose: Pose,
    shader: Sh,
    mode: M,
}

impl<'a, Sh: Shader> Object<'a, Sh> {
    /// A mesh as it was modelled, at the origin, without its back faces.
    #[must_use]
    pub const fn new(mesh: &'a Mesh<'a>, shader: Sh) -> Self {
        Self { mesh, pose: Pose::IDENTITY, shader, mode: Modes::DEFAULT }
    }
}

impl<'a, Sh: Shader, K: Culling, L: Clipping, B: Copy, Z: DepthBias, G: Shape>
    Object<'a, Sh, Modes<K, L, B, Z, G>>
{
    /// The same object with other faces left out: [`CullBack`](crate::geometry::CullBack),
    /// [`CullFront`](crate::geometry::CullFront) or [`CullNone`](crate::geometry::CullNone).
    #[must_use]
    pub fn culled<N: Culling>(self, culling: N) -> Object<'a, Sh, Modes<N, L, B, Z, G>> {
        let Modes { clipping, blending, bias, shape, .. } = self.mode;
        self.with_mode(Modes { culling, clipping, blending, bias, shape })
    }

    /// The same object with triangles that reach beyond the near plane, the far plane or the guard
    /// band cut ([`ClipAll`](crate::geometry::ClipAll)) or left out
    /// ([`ClipNone`](crate::geometry::ClipNone)).
    ///
    /// For an object that never crosses these planes, `ClipNone` draws the same picture without
    /// linking the clipper. The up-front test of the object's box is skipped too:
    /// [`Projected::is_outside_view`] is always false, and triangles outside the picture are
    /// rejected one by one.
    ///
    /// ```
    /// # use embedded_graphics_core::pixelcolor::Rgb565;
    /// # use rasterizer::{mesh::Mesh, prelude::*, scene::Modes};
    /// // A gear before the camera on a small display.
    /// # type Gear<'a> = Object<'a, Flat<Rgb565>, Modes<CullBack, ClipNone>>;
    /// # fn gear<'a>(mesh: &'a Mesh<'a>, sun: Light, pose: Pose) -> Gear<'a> {
    /// Object::new(mesh, Flat::new(sun)).posed(pose).clipped(ClipNone)
    /// # }
    /// ```
    #[must_use]
    pub fn clipped<N: Clipping>(self, clipping: N) -> Object<'a, Sh, Modes<K, N, B, Z, G>> {
        let Modes { culling, blending, bias, shape, .. } = self.mode;
        self.with_mode(Modes { culling, clipping, blending, bias, shape })
    }

    /// The same object with its pixels put onto the target in another way:
    /// [`Replace`](crate::output::Replace), a mode such as [`Over`](crate::output::Over) or
    /// [`Add`](crate::output::Add), [`Blend`](crate::output::Blend) with a function of the stored
    /// colour and the new one; or one of them in [`KeepDepth`](crate::output::KeepDepth).
    #[must_use]
    pub fn blended<N: Copy>(self, blending: N) -> Object<'a, Sh, Modes<K, L, N, Z, G>> {
        let Modes { culling, clipping, bias, shape, .. } = self.mode;
        self.with_mode(Modes { culling, clipping, blending, bias, shape })
    }

    /// The same object with its depth moved towards the viewer or away from it by a
    /// [`Bias`](crate::raster::Bias): for a decal on another object, or for an object whose
    /// [lines](Projected::lines) are drawn over it.
    #[must_use]
    pub fn biased<N: DepthBias>(self, bias: N) -> Object<'a, Sh, Modes<K, L, B, N, G>> {
        let Modes { culling, clipping, blending, shape, .. } = self.mode;
        self.with_mode(Modes { culling, clipping, blending, bias, shape })
    }

    /// The same object with its model changed by a matrix before it is posed: stretched by another
    /// factor along each axis, mirrored, sheared, flattened. A point p of the model lies at
    /// `translation + rotation * (scale * (matrix * p))`.
    ///
    /// Light is as on a model that was made in that shape: normals stay at right angles to the
    /// surface ([`Shaped`](crate::geometry::Shaped)), and in a mirror front faces stay in front. An
    /// object without a matrix has no code for it.
    ///
    /// ```
    /// # use embedded_graphics_core::pixelcolor::Rgb565;
    /// use rasterizer::numbers::Matrix;
    /// # use rasterizer::{geometry::{AsModelled, Shaped}, mesh::Mesh, output::Replace, prelude::*};
    /// # use rasterizer::{raster::NoBias, scene::Modes};
    /// /// Flat as a discus, and its other hand.
    /// const FLAT: Matrix = Matrix::scaling(Scalar::ONE, Scalar::lit("0.25"), Scalar::NEG_ONE);
    ///
    /// # type Flattened<'a> =
    /// #     Object<'a, Flat<Rgb565>, Modes<CullBack, ClipAll, Replace, NoBias, Shaped>>;
    /// # fn flattened<'a>(mesh: &'a Mesh<'a>, sun: Light, pose: Pose) -> Flattened<'a> {
    /// Object::new(mesh, Flat::new(sun)).shaped(&FLAT).posed(pose)
    /// # }
    /// ```
    #[must_use]
    pub fn shaped(self, matrix: &Matrix) -> Object<'a, Sh, Modes<K, L, B, Z, G::WithMatrix>> {
        let Modes { culling, clipping, blending, bias, shape } = self.mode;
        let shape = shape.with_matrix(matrix);
        self.with_mode(Modes { culling, clipping, blending, bias, shape })
    }

    /// The same object with its shape chosen at run time, as the type of all shapes: objects with a
    /// matrix and without one, and between shapes of their meshes, in one array.
    ///
    /// ```
    /// # use embedded_graphics_core::pixelcolor::Rgb565;
    /// # use rasterizer::{geometry::AnyShape, mesh::Mesh, numbers::Matrix, output::Replace};
    /// # use rasterizer::{prelude::*, raster::NoBias, scene::Modes};
    /// type Body<'a> =
    ///     Object<'a, Flat<Rgb565>, Modes<CullBack, ClipAll, Replace, NoBias, AnyShape<'a>>>;
    ///
    /// # fn bodies<'a>(mesh: &'a Mesh<'a>, sun: Light, matrix: &Matrix) -> [Body<'a>; 2] {
    /// let round = Object::new(mesh, Flat::new(sun));
    /// let flat = round.shaped(matrix);
    /// [round.in_any_shape(), flat.in_any_shape()]
    /// # }
    /// ```
    #[must_use]
    pub fn in_any_shape(self) -> Object<'a, Sh, Modes<K, L, B, Z, AnyShape<'a>>>
    where
        G: Into<AnyShape<'a>>,
    {
        let Modes { culling, clipping, blending, bias, shape } = self.mode;
        let shape = shape.into();
        self.with_mode(Modes { culling, clipping, blending, bias, shape })
    }
}

impl<'a, Sh: Shader, M: Mode> Object<'a, Sh, M> {
    /// The same object in another pose.
    #[must_use]
    pub fn posed(self, pose: Pose) -> Self {
        Self { pose, ..self }
    }

    fn with_mode<N>(self, mode: N) -> Object<'a, Sh, N> {
        Object { mesh: self.mesh, pose: self.pose, shader: self.shader, mode }
    }

    /// Its mesh.
    #[must_use]
    pub const fn mesh(&self) -> &'a Mesh<'a> {
        self.mesh
    }

    /// Its pose.
    #[must_use]
    pub const fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Projects all vertices once per frame.
    ///
    /// `storage` has room for all vertices of the mesh; its type chooses their precision ([`S4`] or
    /// [`S8`]).
    ///
    /// # Errors
    ///
    /// Returns an error if the storage is too small, the mesh lacks a table that the shader reads,
    /// or the object is too large for how near it comes
    /// ([`PoseError`](crate::geometry::PoseError)).
    ///
    /// [`S4`]: crate::numbers::S4
    /// [`S8`]: crate::numbers::S8
    // codegen: not inlined, or its temporaries would occupy the caller's frame while triangles are
    // drawn.
    #[inline(never)]
    pub fn project<'v, P: Projection, S: Subpixel, D: DepthFormat>(
        &self,
        camera: &Camera<P>,
        storage: &'v mut [ScreenVertex<S, D, OnScreen<Sh>>],
    ) -> Result<Stored<'v, 'a, S, D, P, Sh, M>, ProjectError> {
        let vertices = self.room_in(storage)?;
        let mut projected = Projected::new(self, camera, &[][..]);
        projected.seen.check()?;
        projected.seen.place(vertices);
        Ok(projected)
    }

    /// Returns the part of the storage that the object needs. Checks that its mesh has the tables
    /// that its shader reads.
    fn room_in<'v, T>(&self, storage: &'v mut [T]) -> Result<&'v mut [T], ProjectError> {
        error::check_tables(self.mesh.tables(), Sh::TABLES)?;
        let needed = self.mesh.vertex_count();
        storage.get_mut(..needed).ok_or(ProjectError::VertexStorage { needed })
    }

    /// Prepares the object without storage for its vertices: each is projected when a triangle
    /// needs it, in the given precision ([`S4`] or [`S8`]). The same pixels are drawn as after
    /// [`project`](Self::project).
    ///
    /// # Errors
    ///
    /// Returns an error if the mesh lacks a table that the shader reads, or the object is too large
    /// or too far away for the camera's numbers.
    ///
    /// [`S4`]: crate::numbers::S4
    /// [`S8`]: crate::numbers::S8
    pub fn project_on_demand<P: Projection, S: Subpixel, D: DepthFormat>(
        &self,
        camera: &Camera<P>,
        precision: S,
    ) -> Result<Projected<'a, OnDemand<S, D>, P, Sh, M>, ProjectError> {
        error::check_tables(self.mesh.tables(), Sh::TABLES)?;
        let projected = Projected::new(self, camera, OnDemand::new(precision));
        projected.seen.check()?;
        Ok(projected)
    }

    /// Draws it: [`project`](Self::project) and [`Projected::draw`] in one step.
    ///
    /// # Errors
    ///
    /// Returns a [`ProjectError`] before any pixel is drawn, or the target's first error.
    pub fn draw<P: Projection, S: Subpixel, T: Target<Color = Sh::Color>>(
        &self,
        camera: &Camera<P>,
        storage: &mut [ScreenVertex<S, T::Depth, OnScreen<Sh>>],
        target: &mut T,
    ) -> Result<(), DrawError<T::Error>>
    where
        M::Blending: Blending<T>,
    {
        // codegen: built here, because what `project` returns would be copied, and both copies stay
        // on the stack while triangles are drawn.
        let vertices = self.room_in(storage)?;
        let mut projected = Projected::new(self, camera, &[][..]);
        projected.seen.check().map_err(ProjectError::from)?;
        projected.seen.place(vertices);
        projected.draw(target).map_err(DrawError::Target)
    }
}
