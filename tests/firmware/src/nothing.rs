//! A target that drops what is drawn: what drawing into it costs is all but the pixels.

use core::{convert::Infallible, hint::black_box, marker::PhantomData};

use embedded_graphics_core::primitives::Rectangle;
use rasterizer::{
    geometry::{DepthFormat, Subpixel, Varyings},
    raster::{Interpolate, Layout, Triangle, Window},
    target::{Rgb565Be, Target},
};

/// Takes the spans of an area, complete with their attributes, and draws none of them.
#[derive(Clone, Copy, Debug)]
pub struct Nothing<D> {
    window: Window,
    depth: PhantomData<D>,
}

impl<D> Nothing<D> {
    /// For the pixels of an area.
    #[must_use]
    pub const fn new(area: &Rectangle) -> Self {
        Self { window: Window::new(area), depth: PhantomData }
    }
}

impl<D: DepthFormat + Interpolate> Target for Nothing<D> {
    type Color = Rgb565Be;
    type Depth = D;
    type Error = Infallible;

    fn window(&self) -> Window {
        self.window
    }

    #[inline(never)]
    fn shade<S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        triangle: Triangle<'_, S, D, V>,
        window: &Window,
        _: impl FnMut(V::Sample) -> Rgb565Be,
    ) -> Result<(), Infallible> {
        triangle.for_each_span(window, LAYOUT, |span| {
            // Nobody looks at the span; the compiler must not know.
            black_box(span);
            Ok(())
        })
    }
}

/// As in a frame of the scenes' display.
const LAYOUT: Layout = Layout { pitch: 320, origin: 0 };
