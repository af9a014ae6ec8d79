//! Many squares that face the camera, from a slice, by one call.

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};

use super::{
    DrawError, ProjectError,
    sort::{Distances, Packing, sort},
};
use crate::{
    attribute::{DepthFormat, NoDepth},
    camera::Camera,
    geometry::{AsParticle, ParticleView, Projection, ScreenParticle, ScreenVertex},
    numbers::{S4, Subpixel},
    output::{Blending, Replace, Target},
    raster::{Square, Window},
    shade::Sprite,
};

/// Particles in a slice: sparks, rain, snow, smoke. Each is a square that faces the camera, tested
/// against the depth of its middle, in a size of its own.
///
/// ```
/// # use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::prelude::*;
/// use rasterizer::{
///     color::Alpha,
///     geometry::{Particle, ScreenParticle},
///     output::{Add, KeepDepth},
///     scene::Particles,
///     shade::Squares,
/// };
///
/// # fn draw(
/// #     sparks: &[Particle<Rgb565>],
/// #     camera: &Camera,
/// #     bands: &mut Bands<&mut [Rgb565], Rgb565, &mut [u16]>,
/// #     display: &mut impl embedded_graphics_core::draw_target::DrawTarget<Color = Rgb565>,
/// # ) -> Result<(), rasterizer::scene::ProjectError> {
/// // Storage for as many as there are.
/// let mut places = [ScreenParticle::EMPTY; 500];
/// let sparks = Particles::new(sparks, Squares).blended(KeepDepth(Add(Alpha::OPAQUE)));
/// let sparks = sparks.project(camera, &mut places)?;
/// # let _ =
/// bands.show(display, |band| band.clear_color(Rgb565::default()), |band| sparks.draw(band));
/// # Ok(())
/// # }
/// ```
///
/// They are drawn in the slice's order. For modes in which the order tells
/// ([`Over`](crate::output::Over)) sort them: [`back_to_front`](SeenParticles::back_to_front). With
/// [`Add`](crate::output::Add) any order gives the same picture, but for colours that reach white.
///
/// # Where they are
///
/// A particle's middle is within 5/8 of a 16th of a pixel of where the camera sees it, and its side
/// as exact; a side is at least a pixel, so that small ones don't flicker, and at most 2,048
/// pixels. Pixels whose centres lie in the square are drawn; a centre on a side belongs to it if
/// that is the left or the upper one. All have the depth of the middle, within 2<sup>-25</sup>. A
/// particle is left out as a whole if its middle lies before the near plane, beyond the far plane,
/// or more than 1,024 pixels from the viewport's middle.
#[derive(Clone, Copy, Debug)]
pub struct Particles<'a, T, K, B = Replace> {
    particles: &'a [T],
    sprite: K,
    blending: B,
    is_in_pixels: bool,
}

impl<'a, T: AsParticle, K: Sprite<T::Color>> Particles<'a, T, K> {
    /// Of at most 65,536 [`Particle`](crate::geometry::Particle)s, or of a type of the program's
    /// own; they look like `sprite`.
    #[must_use]
    pub const fn new(particles: &'a [T], sprite: K) -> Self {
        Self { particles, sprite, blending: Replace, is_in_pixels: false }
    }
}

impl<'a, T: AsParticle, K: Sprite<T::Color>, B: Copy> Particles<'a, T, K, B> {
    /// The same particles, put onto the target in another way:
    /// [`Object::blended`](super::Object::blended) has which there are. An opacity of materials is
    /// 1.
    #[must_use]
    pub const fn blended<N: Copy>(self, blending: N) -> Particles<'a, T, K, N> {
        let Self { particles, sprite, is_in_pixels, .. } = self;
        Particles { particles, sprite, blending, is_in_pixels }
    }

    /// The same particles with sizes in pixels, near and far.
    #[must_use]
    pub const fn in_pixels(self) -> Self {
        Self { is_in_pixels: true, ..self }
    }

    /// Finds out where they are on the screen, once for all targets, such as the bands of a frame.
    ///
    /// # Errors
    ///
    /// Returns an error if the storage has room for fewer particles than there are, or if these are
    /// over 65,536.
    #[inline(never)]
    pub fn project<'v, P: Projection>(
        &self,
        camera: &Camera<P>,
        storage: &'v mut [ScreenParticle],
    ) -> Result<SeenParticles<'a, 'v, T, K, B>, ProjectError> {
        let needed = self.particles.len();
        if needed > 1 << 16 {
            return Err(ProjectError::TooManyParticles);
        }
        let places = storage.get_mut(..needed).ok_or(ProjectError::ParticleStorage { needed })?;
        let view = ParticleView::new(camera, self.is_in_pixels);
        let mut count = 0;
        for (number, particle) in (0..=u16::MAX).zip(self.particles) {
            let Some(place) = view.place(&particle.particle()) else { continue };
            if let Some(seen) = places.get_mut(count) {
                *seen = place.of(number);
                count += 1;
            }
        }
        let viewport = camera.viewport();
        let (corner, size) = (viewport.top_left, viewport.size);
        let center = [(corner.x, size.width), (corner.y, size.height)]
            .map(|(corner, side)| (2 * corner + side.cast_signed()) << (S4::BITS - 1));
        Ok(SeenParticles {
            particles: self.particles,
            sprite: self.sprite,
            blending: self.blending,
            places: places.get(..count).unwrap_or_default(),
            viewport: Window::new(&viewport),
            center,
            order: InSlice,
        })
    }

    /// Draws them: [`project`](Self::project) and [`SeenParticles::draw`] in one step.
    ///
    /// # Errors
    ///
    /// Returns a [`ProjectError`] before any pixel is drawn, or the target's first error.
    pub fn draw<P: Projection, Z: Target<Color = T::Color>>(
        &self,
        camera: &Camera<P>,
        storage: &mut [ScreenParticle],
        target: &mut Z,
    ) -> Result<(), DrawError<Z::Error>>
    where
        B: Blending<Z>,
    {
        self.project(camera, storage)?.draw(target).map_err(DrawError::Target)
    }
}

/// [`Particles`] as the camera sees them; they can be drawn into any number of targets.
#[derive(Clone, Copy, Debug)]
pub struct SeenParticles<'a, 'v, T, K, B = Replace, O = InSlice> {
    particles: &'a [T],
    sprite: K,
    blending: B,
    places: &'v [ScreenParticle],
    viewport: Window,
    /// The viewport's middle in 16ths of a pixel.
    center: [i32; 2],
    order: O,
}

impl<'a, 'v, T, K, B> SeenParticles<'a, 'v, T, K, B> {
    /// The same, the farthest first; of those in one distance, the first of the slice.
    ///
    /// It takes a word of `storage` for each particle of the slice. The key is depth, with as many
    /// bits as a particle's number leaves of 32, over the depths that there are.
    ///
    /// # Errors
    ///
    /// If the storage is too small.
    #[inline(never)]
    pub fn back_to_front<'b>(
        self,
        storage: &'b mut [u32],
    ) -> Result<SeenParticles<'a, 'v, T, K, B, FarthestFirst<'b>>, ProjectError> {
        let needed = self.particles.len();
        let words = storage.get_mut(..needed).ok_or(ProjectError::SortStorage { needed })?;
        let words = words.get_mut(..self.places.len()).unwrap_or_default();
        let distance = |place: &ScreenParticle| -((place.depth() >> 1).cast_signed());
        let (mut least, mut greatest) = (0, i32::MIN);
        for place in self.places {
            least = least.min(distance(place));
            greatest = greatest.max(distance(place));
        }
        let distances = Distances::between([least, greatest], 0);
        let packing = Packing::new(distances, words.len());
        let keys = packing.of_object(distances, 0);
        for (number, (word, place)) in words.iter_mut().zip(self.places).enumerate() {
            *word = keys.word(distance(place), number);
        }
        sort(words);
        let Self { particles, sprite, blending, places, viewport, center, .. } = self;
        let order = FarthestFirst { words, packing };
        Ok(SeenParticles { particles, sprite, blending, places, viewport, center, order })
    }
}

impl<T, K, B, O> SeenParticles<'_, '_, T, K, B, O> {
    /// Those that are seen, in the slice's order.
    #[must_use]
    pub const fn places(&self) -> &[ScreenParticle] {
        self.places
    }

    /// A particle as a vertex on the screen.
    #[inline(always)]
    fn vertex<D: DepthFormat>(&self, place: &ScreenParticle) -> ScreenVertex<S4, D, [u16; 0]> {
        let [x, y] = place.middle();
        let [center_x, center_y] = self.center;
        ScreenVertex::new(center_x + x, center_y + y, D::from_fraction(place.depth()), [])
    }

    /// The smallest rectangle that has all pixels that these particles may touch, clipped to the
    /// viewport: only the union of this and the previous frame's needs redrawing and sending.
    #[must_use]
    pub fn bounds(&self) -> Option<Rectangle> {
        let mut all: Option<Window> = None;
        for place in self.places {
            let vertex = self.vertex::<NoDepth>(place);
            let square = Square::about(&vertex, place.side().into());
            let touched = square.pixels().intersection(&self.viewport);
            if touched.is_empty() {
                continue;
            }
            all = Some(all.map_or(touched, |all| Window {
                left: all.left.min(touched.left),
                top: all.top.min(touched.top),
                right: all.right.max(touched.right),
                bottom: all.bottom.max(touched.bottom),
            }));
        }
        let Window { left, top, right, bottom } = all?;
        let size = Size::new((right - left).cast_unsigned(), (bottom - top).cast_unsigned());
        Some(Rectangle::new(Point::new(left, top), size))
    }
}

impl<T, K, B, O> SeenParticles<'_, '_, T, K, B, O>
where
    T: AsParticle,
    K: Sprite<T::Color>,
    O: ParticleOrder,
{
    /// Draws them.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no particle after it.
    pub fn draw<Z: Target<Color = T::Color>>(&self, target: &mut Z) -> Result<(), Z::Error>
    where
        B: Blending<Z>,
    {
        let window = target.window().intersection(&self.viewport);
        if window.is_empty() {
            return Ok(());
        }
        self.order.for_each(self.places, |place| {
            let vertex = self.vertex::<Z::Depth>(place);
            let side = i32::from(place.side());
            let square = Square::about(&vertex, side);
            if square.pixels().intersection(&window).is_empty() {
                return Ok(());
            }
            let Some(particle) = self.particles.get(usize::from(place.number())) else {
                return Ok(());
            };
            let pixels = self.sprite.pixels(particle.particle(), side.cast_unsigned());
            // From the corner of the square to the centre of the first pixel.
            let half = (1 << (S4::BITS - 1)) + (side >> 1);
            let (x, y) = (half - vertex.x, half - vertex.y);
            self.blending.shade(target, &square, &window, move |fragment| {
                let right = (fragment.column << S4::BITS) + x;
                let down = (fragment.row << S4::BITS) + y;
                pixels([right.cast_unsigned(), down.cast_unsigned()])
            })
        })
    }
}

/// In which order particles are drawn: [`InSlice`] or [`FarthestFirst`].
#[expect(private_bounds, reason = "it is sealed")]
pub trait ParticleOrder: Visit {}

impl ParticleOrder for InSlice {}
impl ParticleOrder for FarthestFirst<'_> {}

/// Visits particles in an order.
pub(crate) trait Visit {
    fn for_each<E>(
        &self,
        places: &[ScreenParticle],
        visit: impl FnMut(&ScreenParticle) -> Result<(), E>,
    ) -> Result<(), E>;
}

/// The order of the slice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct InSlice;

impl Visit for InSlice {
    #[inline(always)]
    fn for_each<E>(
        &self,
        places: &[ScreenParticle],
        visit: impl FnMut(&ScreenParticle) -> Result<(), E>,
    ) -> Result<(), E> {
        places.iter().try_for_each(visit)
    }
}

/// From the farthest to the nearest: what [`SeenParticles::back_to_front`] makes.
#[derive(Clone, Copy, Debug)]
pub struct FarthestFirst<'b> {
    words: &'b [u32],
    packing: Packing,
}

impl Visit for FarthestFirst<'_> {
    #[inline(always)]
    fn for_each<E>(
        &self,
        places: &[ScreenParticle],
        visit: impl FnMut(&ScreenParticle) -> Result<(), E>,
    ) -> Result<(), E> {
        let sorted = self.words.iter().map(|&word| places.get(self.packing.number(word)));
        sorted.flatten().try_for_each(visit)
    }
}
