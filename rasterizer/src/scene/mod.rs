//! Objects, and the two steps of drawing one: project its vertices, then draw its triangles.
//!
//! A frame of several objects with different shaders is so many calls of [`Object::draw`], each
//! compiled for its shader. Where the frame is drawn in bands, [`Object::project`] does the work on
//! the vertices once, [`Projected::binned`] finds out which triangles reach which band, and
//! [`Binned::draw`] is called for each. [`Object::walk`] does without storage for the vertices.
//! [`Needs`] says beforehand how much memory all of it takes.

mod bins;
mod error;
mod needs;
mod projected;
mod vertices;

pub use bins::{Binned, bin_words};
pub use error::{DrawError, ProjectError};
pub use needs::Needs;
pub use projected::Projected;
pub use vertices::{Vertices, Walked};

use crate::{
    camera::Camera,
    geometry::{
        ClipAll, Clipping, CullBack, Culling, DepthFormat, Pose, Projection, ScreenVertex, Subpixel,
    },
    mesh::Mesh,
    raster::Interpolate,
    shade::Shader,
    target::Target,
};

/// An object whose vertices are in storage: what [`Object::project`] gives.
pub type Stored<'v, 'a, S, D, P, Sh, K = CullBack, L = ClipAll> =
    Projected<'a, &'v [ScreenVertex<S, D, <Sh as Shader>::Varyings>], P, Sh, K, L>;

/// An object whose vertices are worked out when they are needed: what [`Object::walk`] gives.
pub type Unstored<'a, S, D, P, Sh, K = CullBack, L = ClipAll> =
    Projected<'a, Walked<S, D>, P, Sh, K, L>;

/// A mesh in a pose, with a shader, and with back faces, front faces or no faces left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Object<'a, Sh, K = CullBack, L = ClipAll> {
    mesh: &'a Mesh<'a>,
    pose: Pose,
    shader: Sh,
    culling: K,
    clipping: L,
}

impl<'a, Sh: Shader> Object<'a, Sh> {
    /// A mesh as it was modelled, at the origin, without its back faces.
    #[must_use]
    pub const fn new(mesh: &'a Mesh<'a>, shader: Sh) -> Self {
        Self { mesh, pose: Pose::IDENTITY, shader, culling: CullBack, clipping: ClipAll }
    }
}

impl<'a, Sh: Shader, K: Culling, L: Clipping> Object<'a, Sh, K, L> {
    /// The same object in another pose.
    #[must_use]
    pub fn posed(self, pose: Pose) -> Self {
        Self { pose, ..self }
    }

    /// The same object with other faces left out: [`CullBack`],
    /// [`CullFront`](crate::geometry::CullFront) or [`CullNone`](crate::geometry::CullNone).
    #[must_use]
    pub fn culled<M: Culling>(self, culling: M) -> Object<'a, Sh, M, L> {
        Object {
            mesh: self.mesh,
            pose: self.pose,
            shader: self.shader,
            culling,
            clipping: self.clipping,
        }
    }

    /// The same object with triangles that reach beyond the near plane, the far plane or the guard
    /// band cut ([`ClipAll`]) or left out ([`ClipNone`](crate::geometry::ClipNone)).
    ///
    /// An object that always stays between them is drawn alike without the code that cuts
    /// triangles. Nor is it looked beforehand whether all of it lies outside the picture:
    /// [`Projected::is_hidden`] says no, and its triangles turn out to miss the picture one by
    /// one.
    ///
    /// ```
    /// # use embedded_graphics_core::pixelcolor::Rgb565;
    /// # use rasterizer::{mesh::Mesh, prelude::*};
    /// // A gear before the camera on a small display.
    /// # fn gear<'a>(mesh: &'a Mesh<'a>, sun: Light, turn: Turn) -> Object<'a, Flat<Rgb565>, CullBack, ClipNone> {
    /// Object::new(mesh, Flat::new(sun))
    ///     .posed(Pose::rotated(Rotation::about_y(turn)))
    ///     .clipped(ClipNone)
    /// # }
    /// ```
    #[must_use]
    pub fn clipped<M: Clipping>(self, clipping: M) -> Object<'a, Sh, K, M> {
        Object {
            mesh: self.mesh,
            pose: self.pose,
            shader: self.shader,
            culling: self.culling,
            clipping,
        }
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

    /// Works out where the camera sees its vertices, once for a frame.
    ///
    /// `storage` has room for all vertices of the mesh; its type says how finely they are placed
    /// ([`S4`] or [`S8`]).
    ///
    /// # Errors
    ///
    /// If the storage is too small, the mesh lacks a table that the shader reads, or the object is
    /// too large or too far away for the camera's numbers.
    ///
    /// [`S4`]: crate::geometry::S4
    /// [`S8`]: crate::geometry::S8
    // What is on its way to the caller's memory would stay in the caller's stack.
    #[inline(never)]
    pub fn project<'v, P: Projection, S: Subpixel, D: DepthFormat + Interpolate>(
        &self,
        camera: &Camera<P>,
        storage: &'v mut [ScreenVertex<S, D, Sh::Varyings>],
    ) -> Result<Stored<'v, 'a, S, D, P, Sh, K, L>, ProjectError> {
        let vertices = self.room_in(storage)?;
        let mut seen = Projected::new(self, camera, &[][..]);
        seen.check()?;
        seen.place(vertices);
        Ok(seen)
    }

    /// As much of the storage as the object needs, if it can be drawn.
    fn room_in<'v, T>(&self, storage: &'v mut [T]) -> Result<&'v mut [T], ProjectError> {
        error::check_tables(self.mesh.tables(), Sh::TABLES)?;
        let needed = self.mesh.vertex_count();
        storage.get_mut(..needed).ok_or(ProjectError::VertexStorage { needed })
    }

    /// The object as the camera sees it, without storage for its vertices: each is worked out when
    /// a triangle needs it, in the precision given ([`S4`] or [`S8`]), and the same pixels are
    /// drawn as after [`project`](Self::project).
    ///
    /// # Errors
    ///
    /// If the mesh lacks a table that the shader reads, or the object is too large or too far away
    /// for the camera's numbers.
    ///
    /// [`S4`]: crate::geometry::S4
    /// [`S8`]: crate::geometry::S8
    pub fn walk<P: Projection, S: Subpixel, D: DepthFormat + Interpolate>(
        &self,
        camera: &Camera<P>,
        precision: S,
    ) -> Result<Unstored<'a, S, D, P, Sh, K, L>, ProjectError> {
        error::check_tables(self.mesh.tables(), Sh::TABLES)?;
        let seen = Projected::new(self, camera, Walked::new(precision));
        seen.check()?;
        Ok(seen)
    }

    /// Draws it: [`project`](Self::project) and [`Projected::draw`] at once.
    ///
    /// # Errors
    ///
    /// What projecting it ends in, before the first pixel; and what the target says.
    pub fn draw<P: Projection, S: Subpixel, T: Target<Color = Sh::Color>>(
        &self,
        camera: &Camera<P>,
        storage: &mut [ScreenVertex<S, T::Depth, Sh::Varyings>],
        target: &mut T,
    ) -> Result<(), DrawError<T::Error>>
    where
        T::Depth: DepthFormat + Interpolate,
    {
        // What `project` returns would be copied, and both copies stay on the stack while triangles
        // are drawn.
        let vertices = self.room_in(storage)?;
        let mut seen = Projected::new(self, camera, &[][..]);
        seen.check().map_err(ProjectError::from)?;
        seen.place(vertices);
        seen.draw(target).map_err(DrawError::Target)
    }
}
