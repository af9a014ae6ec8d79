//! Objects, and the two steps of drawing one: project its vertices, then draw its triangles.
//!
//! A frame of several objects with different shaders is so many calls of [`Object::draw`], each compiled for its shader.
//! Where the frame is drawn in bands, [`Object::project`] does the work on the vertices once, [`Projected::binned`] finds
//! out which triangles reach which band, and [`Binned::draw`] is called for each. [`Object::walk`] does without storage
//! for the vertices. [`Needs`] says beforehand how much memory all of it takes.

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
    geometry::{CullBack, Culling, DepthFormat, Pose, Projection, ScreenVertex, Subpixel, Transform},
    mesh::{Mesh, Tables},
    raster::Interpolate,
    shade::Shader,
    target::Target,
};

/// An object whose vertices are in storage: what [`Object::project`] gives.
pub type Stored<'v, 'a, S, D, P, Sh, K = CullBack> =
    Projected<'a, &'v [ScreenVertex<S, D, <Sh as Shader>::Varyings>], P, Sh, K>;

/// A mesh in a pose, with a shader, and with back faces, front faces or no faces left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Object<'a, Sh, K = CullBack> {
    mesh: &'a Mesh<'a>,
    pose: Pose,
    shader: Sh,
    culling: K,
}

impl<'a, Sh: Shader> Object<'a, Sh> {
    /// A mesh as it was modelled, at the origin, without its back faces.
    #[must_use]
    pub const fn new(mesh: &'a Mesh<'a>, shader: Sh) -> Self {
        Self {
            mesh,
            pose: Pose::IDENTITY,
            shader,
            culling: CullBack,
        }
    }
}

impl<'a, Sh: Shader, K: Culling> Object<'a, Sh, K> {
    /// The same object in another pose.
    #[must_use]
    pub fn posed(self, pose: Pose) -> Self {
        Self { pose, ..self }
    }

    /// The same object with other faces left out: [`CullBack`], [`CullFront`](crate::geometry::CullFront) or
    /// [`CullNone`](crate::geometry::CullNone).
    #[must_use]
    pub fn culled<L: Culling>(self, culling: L) -> Object<'a, Sh, L> {
        Object {
            mesh: self.mesh,
            pose: self.pose,
            shader: self.shader,
            culling,
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
    /// `storage` has room for all vertices of the mesh; its type says how finely they are placed ([`S4`] or [`S8`]).
    ///
    /// # Errors
    ///
    /// If the storage is too small, the mesh lacks a table that the shader reads, or the object is too large or too far
    /// away for the camera's numbers.
    ///
    /// [`S4`]: crate::geometry::S4
    /// [`S8`]: crate::geometry::S8
    pub fn project<'v, P: Projection, S: Subpixel, D: DepthFormat + Interpolate>(
        &self,
        camera: &Camera<P>,
        storage: &'v mut [ScreenVertex<S, D, Sh::Varyings>],
    ) -> Result<Stored<'v, 'a, S, D, P, Sh, K>, ProjectError> {
        let needed = self.mesh.vertex_count();
        let vertices = storage
            .get_mut(..needed)
            .ok_or(ProjectError::VertexStorage { needed })?;
        self.seen_by(camera, |tables, shader, transform, is_hidden| {
            if is_hidden {
                return &[][..];
            }
            projected::place(tables, shader, transform, vertices);
            vertices
        })
    }

    /// The object as the camera sees it, without storage for its vertices: each is worked out when a triangle needs it,
    /// in the precision given ([`S4`] or [`S8`]), and the same pixels are drawn as after [`project`](Self::project).
    ///
    /// # Errors
    ///
    /// If the mesh lacks a table that the shader reads, or the object is too large or too far away for the camera's
    /// numbers.
    ///
    /// [`S4`]: crate::geometry::S4
    /// [`S8`]: crate::geometry::S8
    pub fn walk<P: Projection, S: Subpixel, D: DepthFormat + Interpolate>(
        &self,
        camera: &Camera<P>,
        precision: S,
    ) -> Result<Projected<'a, Walked<S, D>, P, Sh, K>, ProjectError> {
        self.seen_by(camera, |_, _, _, _| Walked::new(precision))
    }

    fn seen_by<P: Projection, V>(
        &self,
        camera: &Camera<P>,
        vertices: impl FnOnce(&Tables<'_>, &Sh, &Transform<P>, bool) -> V,
    ) -> Result<Projected<'a, V, P, Sh, K>, ProjectError> {
        let tables = self.mesh.tables();
        error::check_tables(tables, Sh::TABLES)?;
        let transform = Transform::new(camera, &self.pose, tables)?;
        let is_hidden = transform.hides(&self.mesh.bounds().cuboid);
        let shader = self.shader.in_object_space(&self.pose);
        let vertices = vertices(tables, &shader, &transform, is_hidden);
        let viewport = camera.viewport();
        Ok(Projected::new(
            tables, shader, transform, is_hidden, &viewport, vertices,
        ))
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
        self.project(camera, storage)?.draw(target).map_err(DrawError::Target)
    }
}
