//! A target of which only a rectangle can be drawn.

use embedded_graphics_core::primitives::Rectangle;

use super::{Readable, Target};
use crate::{
    raster::{FragmentOf, Primitive, Window},
    shade::Outcome,
};

/// Another target within a rectangle of the display: no pixel outside it changes, in colour or in
/// depth, and those inside are the ones that the whole target gets. For a part of the picture
/// behind a menu, a view in a view, or what changed since the last frame.
///
/// It wraps any target: a frame, each band, a display. An object asks for the window once, before
/// its triangles, and leaves out those that end above the rectangle or begin below it.
///
/// ```
/// use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
/// # use rasterizer::{mesh::Mesh, prelude::*, scene::DrawError};
/// use rasterizer::output::Scissored;
///
/// /// The middle of a display of 240 x 240 pixels.
/// const PANE: Rectangle = Rectangle::new(Point::new(60, 60), Size::new(120, 120));
///
/// # fn draw(
/// #     mesh: &Mesh<'_>, flat: Flat<Rgb565>, camera: &Camera,
/// #     vertices: &mut [ScreenVertex<S4, u16, [u16; 0]>],
/// #     frame: &mut Frame<'_, Rgb565, &mut [u16]>,
/// # ) -> Result<(), DrawError<core::convert::Infallible>> {
/// Object::new(mesh, flat).draw(camera, vertices, &mut Scissored::new(frame, &PANE))
/// # }
/// ```
///
/// `embedded-graphics` has the same for what it draws: `frame.clipped(&PANE)`.
#[derive(Debug)]
pub struct Scissored<'t, T> {
    target: &'t mut T,
    rectangle: Window,
}

impl<'t, T: Target> Scissored<'t, T> {
    /// Of a rectangle of the display. It may reach beyond the target, or be empty.
    pub const fn new(target: &'t mut T, rectangle: &Rectangle) -> Self {
        Self { target, rectangle: Window::new(rectangle) }
    }
}

impl<T: Target> Target for Scissored<'_, T> {
    type Color = T::Color;
    type Depth = T::Depth;
    type Error = T::Error;

    fn window(&self) -> Window {
        self.target.window().intersection(&self.rectangle)
    }

    #[inline(always)]
    fn shade<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        self.target.shade(primitive, window, pixel)
    }

    #[inline(always)]
    fn fill<Q: Primitive<Depth = T::Depth>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        color: T::Color,
    ) -> Result<(), T::Error> {
        self.target.fill(primitive, window, color)
    }
}

impl<T: Readable> Readable for Scissored<'_, T> {
    #[inline(always)]
    fn blend<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(T::Color, FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        self.target.blend(primitive, window, pixel)
    }
}
