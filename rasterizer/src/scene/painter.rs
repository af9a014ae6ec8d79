//! Several objects from back to front.

use super::{
    BackToFront, Mode, ProjectError, Projected, Vertices,
    sort::{Distances, Members, Packing},
};
use crate::{
    geometry::Projection,
    output::{Blending, Target},
    shade::{OnScreen, Shader},
};

/// The triangles of several objects from the farthest to the nearest (the painter's algorithm:
/// Newell, Newell and Sancha, *A Solution to the Hidden Surface Problem*, ACM 1972, without its
/// splitting): visibility without a depth buffer, and the order of see-through objects.
///
/// It draws into any target: straight onto a display by [`Direct`](crate::output::Direct), into a
/// frame, into bands.
///
/// ```
/// # use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{attribute::NoDepth, mesh::Mesh, output::Frame, prelude::*};
/// use rasterizer::scene::{Needs, Painter};
///
/// # static HOUSE: Mesh<'static> = rasterizer::mesh::Card::<3, 2>::STANDING;
/// # static TREE: Mesh<'static> = rasterizer::mesh::Card::<1, 4>::STANDING;
/// # fn draw(
/// #     house: Object<'_, Flat<Rgb565>>,
/// #     tree: Object<'_, Gouraud<Rgb565>>,
/// #     camera: &Camera,
/// #     frame: &mut Frame<'_, Rgb565, NoDepth>,
/// # ) -> Result<(), Box<dyn core::error::Error>> {
/// // A word for each triangle, and the vertices of all objects at the same time.
/// const SIZE: Size = Size::new(320, 240);
/// const HOUSE_NEEDS: Needs = Needs::of(&HOUSE, SIZE, 16);
/// const TREE_NEEDS: Needs = Needs::of(&TREE, SIZE, 16);
/// let mut order = [0; HOUSE_NEEDS.sort_words + TREE_NEEDS.sort_words];
/// let mut house_vertices = [ScreenVertex::<S4, NoDepth, _>::EMPTY; HOUSE_NEEDS.vertices];
///
/// let house = house.project(camera, &mut house_vertices)?;
/// let tree = tree.project_on_demand(camera, S4)?;
/// Painter::new((&house, &tree), &mut order)?.draw(frame)?;
/// # Ok(())
/// # }
/// # use embedded_graphics_core::geometry::Size;
/// # let _ = draw;
/// ```
///
/// Each triangle has one key, the distance of its middle along the camera's axis, of as many bits
/// as its number leaves of 32. Equal keys are drawn in the order of the objects and their meshes.
///
/// # What it cannot do
///
/// One key for each triangle is no order for all of them:
///
/// * Of two triangles that cross, each hides a part of the other. One is drawn over the other.
/// * Three or more may hide each other in a circle, without crossing.
/// * A large triangle may have its middle nearer than a small one that lies before it: a wall is
///   drawn over the picture that hangs on it. Draw such things one after the other, or divide the
///   large triangle.
///
/// Small triangles of one size, as curved surfaces have, keep such faults to a few pixels.
///
/// # Cost
///
/// Where neighbours in the order differ in object or material, [`Shader::surface`] is called
/// again; an object without stored vertices begins with an empty cache there.
#[derive(Clone, Copy, Debug)]
pub struct Painter<'b, O> {
    objects: O,
    order: BackToFront<'b>,
}

impl<'b, O: Objects> Painter<'b, O> {
    /// Sorts the triangles that are seen, of all objects, which one camera has projected: a tuple
    /// of one to eight references to [`Projected`]. Done once for all targets, such as the bands of
    /// a frame.
    ///
    /// It takes a word of `storage` for each triangle of the meshes: the sum of their
    /// [`Needs::sort_words`](super::Needs::sort_words).
    ///
    /// # Errors
    ///
    /// If the storage is too small.
    pub fn new(objects: O, storage: &'b mut [u32]) -> Result<Self, ProjectError> {
        let order = BackToFront::sorted(&objects, storage)?;
        Ok(Self { objects, order })
    }

    /// The triangles from back to front: the place of each one's object in the tuple, and its own
    /// in the object's mesh.
    pub fn triangles(&self) -> impl Iterator<Item = (usize, usize)> {
        self.order.triangles().map(|number| self.objects.locate(number))
    }

    /// Draws them.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no triangle after it.
    pub fn draw<T: Target>(&self, target: &mut T) -> Result<(), T::Error>
    where
        O: DrawnInto<T>,
    {
        let mut rest = self.order;
        while !rest.words.is_empty() {
            rest = self.objects.draw_first(rest, target)?;
        }
        Ok(())
    }
}

/// Objects that are sorted together: a tuple of one to eight references to [`Projected`] in the
/// mesh's order. More of them are tuples in a tuple.
pub trait Objects: Members {}

/// [`Objects`] that can be drawn into a target: of its colour and depth, blended in ways that its
/// pixels allow.
pub trait DrawnInto<T: Target>: Objects + private::DrawnInto<T> {}

mod private {
    use super::{BackToFront, Target};

    pub trait DrawnInto<T: Target> {
        /// Draws the first triangles of an order, those of one object that come before any of
        /// another. Returns the others.
        fn draw_first<'b>(
            &self,
            order: BackToFront<'b>,
            target: &mut T,
        ) -> Result<BackToFront<'b>, T::Error>;
    }
}

impl<V, P, Sh, M, T> private::DrawnInto<T> for &Projected<'_, V, P, Sh, M>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
    T: Target<Color = Sh::Color, Depth = V::Depth>,
    M::Blending: Blending<T>,
{
    fn draw_first<'b>(
        &self,
        order: BackToFront<'b>,
        target: &mut T,
    ) -> Result<BackToFront<'b>, T::Error> {
        let (own, rest) = order.split_at_object(self.seen.triangle_count());
        self.seen.draw(&own, target)?;
        Ok(rest)
    }
}

macro_rules! tuples {
    ($($($object:ident)+;)*) => {
        $(
            impl<$($object: Members),+> Objects for ($($object,)+) {}

            #[expect(non_snake_case, reason = "a variable has the name of its type")]
            impl<$($object: Members),+> Members for ($($object,)+) {
                const COUNT: usize = 0 $(+ $object::COUNT)+;

                fn triangle_count(&self) -> usize {
                    let ($($object,)+) = self;
                    0 $(+ $object.triangle_count())+
                }

                fn distances(&self) -> Distances {
                    let ($($object,)+) = self;
                    Distances::NONE$(.and($object.distances()))+
                }

                fn write_words(&self, words: &mut [u32], packing: Packing, first: usize) -> usize {
                    let ($($object,)+) = self;
                    let (mut count, mut first) = (0, first);
                    $(
                        let rest = words.get_mut(count..).unwrap_or_default();
                        count += $object.write_words(rest, packing, first);
                        first += $object.triangle_count();
                    )+
                    let _ = first;
                    count
                }

                fn locate(&self, number: usize) -> (usize, usize) {
                    let ($($object,)+) = self;
                    let (mut object, mut number) = (0, number);
                    $(
                        let count = $object.triangle_count();
                        if number < count {
                            let (inner, number) = $object.locate(number);
                            return (object + inner, number);
                        }
                        object += $object::COUNT;
                        number -= count;
                    )+
                    (object, number)
                }
            }

            impl<T: Target, $($object: Members + private::DrawnInto<T>),+> DrawnInto<T>
                for ($($object,)+) {}

            #[expect(non_snake_case, reason = "a variable has the name of its type")]
            impl<T: Target, $($object: Members + private::DrawnInto<T>),+>
                private::DrawnInto<T> for ($($object,)+)
            {
                fn draw_first<'b>(
                    &self,
                    order: BackToFront<'b>,
                    target: &mut T,
                ) -> Result<BackToFront<'b>, T::Error> {
                    let ($($object,)+) = self;
                    let first = order.first;
                    let mut order = order;
                    $(
                        let count = $object.triangle_count();
                        if order.starts_within(count) {
                            return Ok($object.draw_first(order, target)?.of_mesh_from(first));
                        }
                        order = order.of_mesh_from(order.first + count);
                    )+
                    Ok(BackToFront { words: &[], ..order })
                }
            }
        )*
    };
}

tuples! {
    A;
    A B;
    A B C;
    A B C D;
    A B C D E;
    A B C D E F;
    A B C D E F G;
    A B C D E F G H;
}
