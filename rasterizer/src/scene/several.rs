//! Several objects of different types by one call.

use core::{marker::PhantomData, ops::Range};

use super::{Contents, DrawContents, ProjectError, contents::RowsFound};
use crate::{
    attribute::DepthFormat, camera::Camera, geometry::Projection, numbers::Subpixel,
    output::Target, raster::Window,
};

/// What a camera sees of several objects, drawn by one call into a frame or into each band of one.
///
/// Its contents are a tuple, resolved at compile time: objects with different shaders and modes,
/// many of one kind ([`each`](super::each)), objects that may be absent (`Option`), and what has
/// been projected already (`&Projected`), which has its vertices in storage and may be in bins or
/// sorted. They are drawn in their order.
///
/// ```
/// # use embedded_graphics_core::{draw_target::DrawTarget, pixelcolor::{Rgb565, RgbColor}};
/// # use rasterizer::{mesh::Mesh, output::Bands, prelude::*, shade::Unlit};
/// use rasterizer::scene::{RowRange, Scene, each};
///
/// # static GROUND: Mesh<'static> = rasterizer::mesh::Card::<1, 1>::CENTERED;
/// # static TREE: Mesh<'static> = rasterizer::mesh::Card::<1, 4>::STANDING;
/// # fn frame<T: DrawTarget<Color = Rgb565>>(
/// #     ground: Pose,
/// #     places: &[Pose; 20],
/// #     sun: Light,
/// #     camera: &Camera,
/// #     bands: &mut Bands<&mut [Rgb565], Rgb565, &mut [u16]>,
/// #     display: &mut T,
/// # ) -> Result<(), Box<dyn core::error::Error>>
/// # where
/// #     T::Error: core::error::Error + 'static,
/// # {
/// let trees = each(places, |place| Object::new(&TREE, Flat::new(sun)).posed(*place));
/// let ground = Object::new(&GROUND, Unlit::new()).posed(ground);
///
/// // One object, and twenty trees.
/// let mut rows = [RowRange::EMPTY; 1 + 20];
/// let scene = Scene::new((ground, trees), camera, S4, &mut rows)?;
/// bands.show(display, |band| band.clear_color(Rgb565::BLUE), |band| scene.draw(band))?;
/// # Ok(())
/// # }
/// # let _ = frame::<rasterizer::output::Frame<'_, Rgb565, &mut [u16]>>;
/// ```
///
/// # Memory and cost
///
/// Of an object only the rows of the display are kept that it may reach, 4 bytes each. A band that
/// it does not reach skips it; the others project it anew, with `N` vertices on the stack that all
/// objects share one after the other (16 bytes each with 16-bit depth and one varying; see
/// [`OnDemand`](super::OnDemand)). An object outside the picture costs its projected box once a
/// frame.
///
/// That is for many small objects, which reach few bands. A large one takes less time if its
/// vertices are kept, and its bins: put a reference to its [`Projected`](super::Projected) into the
/// tuple. Such objects share one array of vertices, if their shaders have varyings of one type, and
/// one of words; each takes its part of them:
///
/// ```
/// # use embedded_graphics_core::{geometry::Size, pixelcolor::Rgb565};
/// # use rasterizer::{mesh::Mesh, output::Frame, prelude::*};
/// use rasterizer::scene::{Needs, Scene};
///
/// # static SHIP: Mesh<'static> = rasterizer::mesh::Card::<1, 1>::CENTERED;
/// # static HARBOUR: Mesh<'static> = rasterizer::mesh::Card::<1, 4>::STANDING;
/// # fn draw(
/// #     ship: Object<'_, Flat<Rgb565>>,
/// #     harbour: Object<'_, Flat<Rgb565>>,
/// #     camera: &Camera,
/// #     bands: &mut [Frame<'_, Rgb565, &mut [u16]>],
/// # ) -> Result<(), Box<dyn core::error::Error>> {
/// const OF_SHIP: Needs = Needs::of(&SHIP, Size::new(240, 240), 16);
/// const OF_HARBOUR: Needs = Needs::of(&HARBOUR, Size::new(240, 240), 16);
/// let mut vertices = [ScreenVertex::<S4, u16, _>::EMPTY; OF_SHIP.vertices + OF_HARBOUR.vertices];
/// let mut words = [0; OF_SHIP.bin_words + OF_HARBOUR.bin_words];
///
/// let (mut vertices, mut words) = (&mut vertices[..], &mut words[..]);
/// let mut part = |needs: Needs| {
///     let vertices = vertices.split_off_mut(..needs.vertices)?;
///     Some((vertices, words.split_off_mut(..needs.bin_words)?))
/// };
/// let (of_ship, bins_of_ship) = part(OF_SHIP).unwrap_or_default();
/// let (of_harbour, bins_of_harbour) = part(OF_HARBOUR).unwrap_or_default();
/// let ship = ship.project(camera, of_ship)?.binned(16, bins_of_ship)?;
/// let harbour = harbour.project(camera, of_harbour)?.binned(16, bins_of_harbour)?;
/// let scene = Scene::new((&ship, &harbour), camera, S4, &mut [])?;
/// for band in bands {
///     scene.draw(band)?;
/// }
/// # Ok(())
/// # }
/// # let _ = draw;
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Scene<'s, C, P: Projection, S, D, const N: usize = 32> {
    contents: C,
    camera: &'s Camera<P>,
    rows: &'s [RowRange],
    /// How finely vertices are placed, and how their depth is kept.
    vertices: PhantomData<(S, D)>,
}

impl<'s, C: Contents<P, S, D>, P: Projection, S: Subpixel, D: DepthFormat> Scene<'s, C, P, S, D> {
    /// Finds out where the contents are on the screen, in the given precision
    /// ([`S4`](crate::numbers::S4) or [`S8`](crate::numbers::S8)).
    ///
    /// It takes a [`RowRange`] of `storage` for each object; none for what is absent or has been
    /// projected already.
    ///
    /// # Errors
    ///
    /// Returns the first error of an object, or that the storage is too small.
    pub fn new(
        contents: C,
        camera: &'s Camera<P>,
        _precision: S,
        storage: &'s mut [RowRange],
    ) -> Result<Self, ProjectError> {
        let mut found = RowsFound::new(camera, storage);
        contents.find(&mut found)?;
        let rows = found.finish()?;
        Ok(Self { contents, camera, rows, vertices: PhantomData })
    }
}

impl<'s, C, P: Projection, S: Subpixel, D: DepthFormat, const N: usize> Scene<'s, C, P, S, D, N> {
    /// The same with another number of vertices on the stack.
    #[must_use]
    pub fn with_cache<const K: usize>(self) -> Scene<'s, C, P, S, D, K> {
        let Self { contents, camera, rows, vertices } = self;
        Scene { contents, camera, rows, vertices }
    }

    /// The rows that its objects may reach, in their order.
    #[must_use]
    pub const fn rows(&self) -> &'s [RowRange] {
        self.rows
    }

    /// Draws the contents in their order.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws nothing after it.
    pub fn draw<T: Target<Depth = D>>(&self, target: &mut T) -> Result<(), T::Error>
    where
        C: DrawContents<P, S, T>,
    {
        self.contents.draw::<N>(self.camera, &mut self.rows.iter(), target)
    }
}

/// The rows of the viewport that an object may reach.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct RowRange {
    /// From the viewport's upper edge. A viewport has up to 2,048 rows.
    top: u16,
    bottom: u16,
}

impl RowRange {
    /// No rows: the initial content of storage.
    pub const EMPTY: Self = Self { top: 0, bottom: 0 };

    /// Of rows in a viewport that begins at a row of the display.
    pub(super) const fn new([top, bottom]: [i32; 2], viewport_top: i32) -> Self {
        if top >= bottom {
            return Self::EMPTY;
        }
        Self { top: (top - viewport_top) as u16, bottom: (bottom - viewport_top) as u16 }
    }

    /// Whether none of them is among the rows of a window of the display.
    pub(super) const fn misses(self, window: &Window, viewport_top: i32) -> bool {
        let (top, bottom) = (viewport_top + self.top as i32, viewport_top + self.bottom as i32);
        self.top >= self.bottom || top >= window.bottom || bottom <= window.top
    }

    /// The rows, counted from the viewport's upper edge; none if the object is certain to be out of
    /// the picture.
    #[must_use]
    pub const fn rows(self) -> Range<u16> {
        self.top..self.bottom
    }
}
