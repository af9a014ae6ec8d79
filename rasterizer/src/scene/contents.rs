//! What a scene is made of.

use core::{fmt, slice};

use super::{
    DrawnInto, Mode, Object, OnDemand, Order, Painter, ParticleOrder, ProjectError, Projected,
    RowRange, SeenParticles, Vertices, error,
};
use crate::{
    attribute::DepthFormat,
    camera::Camera,
    geometry::{AsParticle, Projection},
    numbers::Subpixel,
    output::{Blending, Target},
    shade::{OnScreen, Shader, Sprite},
};

/// What a [`Scene`](super::Scene) holds: an [`Object`]; several of one kind, by [`each`]; an
/// `Option` of something that may be absent; a reference to a [`Projected`] object, to a
/// [`Painter`] or to [`SeenParticles`]; a tuple of one to eight of all these.
pub trait Contents<P: Projection, S: Subpixel, D: DepthFormat>: private::Find<P, S, D> {}

/// [`Contents`] that can be drawn into a target: of its colour and depth, blended in ways that its
/// pixels allow.
pub trait DrawContents<P: Projection, S: Subpixel, T: Target>:
    Contents<P, S, T::Depth> + private::Draw<P, S, T>
{
}

impl<P: Projection, S: Subpixel, D: DepthFormat, C: private::Find<P, S, D>> Contents<P, S, D>
    for C
{
}

impl<P: Projection, S: Subpixel, T: Target, C: private::Draw<P, S, T>> DrawContents<P, S, T> for C {}

pub(super) mod private {
    use super::{
        Camera, DepthFormat, ProjectError, Projection, RowRange, RowsFound, Subpixel, Target, slice,
    };

    pub trait Find<P: Projection, S: Subpixel, D: DepthFormat> {
        /// Finds out which rows each object may reach, and whether it can be drawn.
        fn find(&self, found: &mut RowsFound<'_, P>) -> Result<(), ProjectError>;
    }

    pub trait Draw<P: Projection, S: Subpixel, T: Target>: Find<P, S, T::Depth> {
        /// Draws those that may reach the target; `rows` has what `find` found, in its order.
        fn draw<const N: usize>(
            &self,
            camera: &Camera<P>,
            rows: &mut slice::Iter<'_, RowRange>,
            target: &mut T,
        ) -> Result<(), T::Error>;
    }

    /// What has been projected.
    pub trait Ready {}

    /// The same, if a target can have it.
    pub trait DrawReady<T: Target>: Ready {
        fn draw_ready(&self, target: &mut T) -> Result<(), T::Error>;
    }
}

/// The rows of the objects that have been looked at.
#[derive(Debug)]
pub struct RowsFound<'s, P: Projection> {
    camera: &'s Camera<P>,
    storage: &'s mut [RowRange],
    count: usize,
}

impl<'s, P: Projection> RowsFound<'s, P> {
    pub(super) const fn new(camera: &'s Camera<P>, storage: &'s mut [RowRange]) -> Self {
        Self { camera, storage, count: 0 }
    }

    /// Adds an object's. One for which there is no room is counted.
    fn push(&mut self, rows: RowRange) {
        if let Some(place) = self.storage.get_mut(self.count) {
            *place = rows;
        }
        self.count += 1;
    }

    /// Those of all objects.
    pub(super) fn finish(self) -> Result<&'s [RowRange], ProjectError> {
        let needed = self.count;
        self.storage.get(..needed).ok_or(ProjectError::RowStorage { needed })
    }
}

/// An object without stored vertices, as a camera sees it.
type Unstored<'a, S, D, P, Sh, M, const N: usize> = Projected<'a, OnDemand<S, D, N>, P, Sh, M>;

/// Prepares an object in place.
// codegen: not inlined, so that its temporaries leave the stack before triangles are drawn.
#[inline(never)]
fn project<'a, P: Projection, S: Subpixel, D: DepthFormat, Sh: Shader, M: Mode, const N: usize>(
    object: &Object<'a, Sh, M>,
    camera: &Camera<P>,
    projected: &mut Option<Unstored<'a, S, D, P, Sh, M, N>>,
) -> Result<(), ProjectError> {
    error::check_tables(object.mesh().tables(), Sh::TABLES)?;
    let projected = projected.insert(Projected::new(object, camera, OnDemand::new(S::default())));
    Ok(projected.seen.check()?)
}

impl<P: Projection, S: Subpixel, D: DepthFormat, Sh: Shader, M: Mode> private::Find<P, S, D>
    for Object<'_, Sh, M>
{
    #[inline(never)]
    fn find(&self, found: &mut RowsFound<'_, P>) -> Result<(), ProjectError> {
        let mut projected = None::<Unstored<'_, S, D, P, Sh, M, 32>>;
        project(self, found.camera, &mut projected)?;
        found.push(projected.map_or(RowRange::EMPTY, |projected| projected.seen.rows()));
        Ok(())
    }
}

impl<P, S, Sh, M, T> private::Draw<P, S, T> for Object<'_, Sh, M>
where
    P: Projection,
    S: Subpixel,
    Sh: Shader,
    M: Mode,
    T: Target<Color = Sh::Color>,
    M::Blending: Blending<T>,
{
    #[inline(never)]
    fn draw<const N: usize>(
        &self,
        camera: &Camera<P>,
        rows: &mut slice::Iter<'_, RowRange>,
        target: &mut T,
    ) -> Result<(), T::Error> {
        let top = camera.viewport().top_left.y;
        if rows.next().is_none_or(|rows| rows.misses(&target.window(), top)) {
            return Ok(());
        }
        let mut projected = None::<Unstored<'_, S, T::Depth, P, Sh, M, N>>;
        // `find` has seen it succeed.
        let Ok(()) = project(self, camera, &mut projected) else { return Ok(()) };
        projected.map_or(Ok(()), |projected| projected.draw(target))
    }
}

impl<P: Projection, S: Subpixel, D: DepthFormat, C: private::Find<P, S, D>> private::Find<P, S, D>
    for Option<C>
{
    fn find(&self, found: &mut RowsFound<'_, P>) -> Result<(), ProjectError> {
        self.as_ref().map_or(Ok(()), |content| content.find(found))
    }
}

impl<P, S, T, C> private::Draw<P, S, T> for Option<C>
where
    P: Projection,
    S: Subpixel,
    T: Target,
    C: private::Draw<P, S, T>,
{
    fn draw<const N: usize>(
        &self,
        camera: &Camera<P>,
        rows: &mut slice::Iter<'_, RowRange>,
        target: &mut T,
    ) -> Result<(), T::Error> {
        self.as_ref().map_or(Ok(()), |content| content.draw::<N>(camera, rows, target))
    }
}

/// Several contents of one kind: what a function makes of each item of a slice, such as an object
/// in the pose that the item has. What [`each`] makes.
#[derive(Clone, Copy)]
pub struct Each<'i, I, F> {
    items: &'i [I],
    content: F,
}

impl<I: fmt::Debug, F> fmt::Debug for Each<'_, I, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Each").field("items", &self.items).finish_non_exhaustive()
    }
}

/// Returns the contents that a function makes of each item: instances of one mesh in the poses of
/// a slice, for example, each in a mesh of its own [level of detail](super::Levels).
///
/// ```
/// # use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{prelude::*, shade::Unlit};
/// use rasterizer::{
///     mesh::Mesh,
///     scene::{Levels, each},
/// };
///
/// # static NEAR: Mesh<'static> = rasterizer::mesh::Card::<1, 4>::STANDING;
/// # static FAR: Mesh<'static> = rasterizer::mesh::Card::<1, 4>::STANDING;
/// # fn forest(places: &[Pose], camera: &Camera) {
/// const TREE: Levels<'_, 2> =
///     Levels::new([(Distance::lit("8"), &NEAR), (Distance::lit("40"), &FAR)]);
///
/// let trees = each(places, |place| {
///     TREE.mesh(place, camera).map(|mesh| Object::new(mesh, Unlit::<Rgb565>::new()).posed(*place))
/// });
/// # let _ = trees;
/// # }
/// ```
///
/// The function is called once when the [`Scene`](super::Scene) is made and once for each target
/// that it is drawn into, and must return the same for the same item.
pub const fn each<I, C, F: Fn(&I) -> C>(items: &[I], content: F) -> Each<'_, I, F> {
    Each { items, content }
}

impl<P, S, D, I, C, F> private::Find<P, S, D> for Each<'_, I, F>
where
    P: Projection,
    S: Subpixel,
    D: DepthFormat,
    C: private::Find<P, S, D>,
    F: Fn(&I) -> C,
{
    fn find(&self, found: &mut RowsFound<'_, P>) -> Result<(), ProjectError> {
        self.items.iter().try_for_each(|item| (self.content)(item).find(found))
    }
}

impl<P, S, T, I, C, F> private::Draw<P, S, T> for Each<'_, I, F>
where
    P: Projection,
    S: Subpixel,
    T: Target,
    C: private::Draw<P, S, T>,
    F: Fn(&I) -> C,
{
    fn draw<const N: usize>(
        &self,
        camera: &Camera<P>,
        rows: &mut slice::Iter<'_, RowRange>,
        target: &mut T,
    ) -> Result<(), T::Error> {
        self.items.iter().try_for_each(|item| (self.content)(item).draw::<N>(camera, rows, target))
    }
}

/// What has been projected before the scene is made. It is drawn into every target.
impl<P: Projection, S: Subpixel, D: DepthFormat, R: private::Ready> private::Find<P, S, D> for &R {
    fn find(&self, _: &mut RowsFound<'_, P>) -> Result<(), ProjectError> {
        Ok(())
    }
}

impl<P: Projection, S: Subpixel, T: Target, R: private::DrawReady<T>> private::Draw<P, S, T>
    for &R
{
    fn draw<const N: usize>(
        &self,
        _: &Camera<P>,
        _: &mut slice::Iter<'_, RowRange>,
        target: &mut T,
    ) -> Result<(), T::Error> {
        (*self).draw_ready(target)
    }
}

impl<V, P: Projection, Sh: Shader, M, O> private::Ready for Projected<'_, V, P, Sh, M, O> {}
impl<O> private::Ready for Painter<'_, O> {}
impl<I, K, B, O> private::Ready for SeenParticles<'_, '_, I, K, B, O> {}

impl<T, V, P, Sh, M, O> private::DrawReady<T> for Projected<'_, V, P, Sh, M, O>
where
    T: Target<Color = Sh::Color, Depth = V::Depth>,
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode<Blending: Blending<T>>,
    O: Order,
{
    fn draw_ready(&self, target: &mut T) -> Result<(), T::Error> {
        self.draw(target)
    }
}

impl<T: Target, O: DrawnInto<T>> private::DrawReady<T> for Painter<'_, O> {
    fn draw_ready(&self, target: &mut T) -> Result<(), T::Error> {
        self.draw(target)
    }
}

impl<T, I, K, B, O> private::DrawReady<T> for SeenParticles<'_, '_, I, K, B, O>
where
    T: Target<Color = I::Color>,
    I: AsParticle,
    K: Sprite<I::Color>,
    B: Blending<T>,
    O: ParticleOrder,
{
    fn draw_ready(&self, target: &mut T) -> Result<(), T::Error> {
        self.draw(target)
    }
}

macro_rules! tuples {
    ($($($content:ident)+;)*) => { $(
        #[expect(non_snake_case, reason = "a variable has the name of its type")]
        impl<P: Projection, S: Subpixel, D: DepthFormat, $($content: private::Find<P, S, D>),+>
            private::Find<P, S, D> for ($($content,)+)
        {
            fn find(&self, found: &mut RowsFound<'_, P>) -> Result<(), ProjectError> {
                let ($($content,)+) = self;
                $($content.find(found)?;)+
                Ok(())
            }
        }

        #[expect(non_snake_case, reason = "a variable has the name of its type")]
        impl<P: Projection, S: Subpixel, T: Target, $($content: private::Draw<P, S, T>),+>
            private::Draw<P, S, T> for ($($content,)+)
        {
            fn draw<const N: usize>(
                &self,
                camera: &Camera<P>,
                rows: &mut slice::Iter<'_, RowRange>,
                target: &mut T,
            ) -> Result<(), T::Error> {
                let ($($content,)+) = self;
                $($content.draw::<N>(camera, rows, target)?;)+
                Ok(())
            }
        }
    )* };
}

tuples! {
    A;
    A B;
    A B C;
    A B C E;
    A B C E F;
    A B C E F G;
    A B C E F G H;
    A B C E F G H I;
}
