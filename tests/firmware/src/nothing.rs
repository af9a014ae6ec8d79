//! A target that drops what is drawn: what drawing into it costs is all but the pixels.

use core::{convert::Infallible, hint::black_box, marker::PhantomData};

use embedded_graphics_core::{pixelcolor::Rgb565, primitives::Rectangle};
use rasterizer::{
    geometry::DepthFormat,
    raster::{Interpolate, Span, Window},
    target::Target,
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
        Self {
            window: Window::new(area),
            depth: PhantomData,
        }
    }
}

impl<D: DepthFormat + Interpolate> Target for Nothing<D> {
    type Color = Rgb565;
    type Depth = D;
    type Error = Infallible;

    fn window(&self) -> Window {
        self.window
    }

    #[inline(always)]
    fn shade<V: Interpolate>(
        &mut self,
        span: &Span<D, V>,
        _: impl FnMut(V::Sample) -> Rgb565,
    ) -> Result<(), Infallible> {
        // Nobody looks at the span; the compiler must not know.
        black_box(span);
        Ok(())
    }

    #[inline(always)]
    fn fill<V: Interpolate>(&mut self, span: &Span<D, V>, color: Rgb565) -> Result<(), Infallible> {
        black_box((span, color));
        Ok(())
    }
}
