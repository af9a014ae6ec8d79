//! Straight onto a display, without a buffer.

use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{Point, Size},
    primitives::Rectangle,
};

use super::Target;
use crate::{
    geometry::{NoDepth, Subpixel, Varyings},
    raster::{Interpolate, Layout, Span, Step, Triangle, Window},
};

/// Draws spans as runs on any [`DrawTarget`], each one `fill_solid` or `fill_contiguous`.
///
/// Nothing tests depth: it is for convex bodies whose back faces are culled, and for objects drawn
/// from back to front. A rounded body whose quads were split along the wrong diagonal is not quite
/// convex: pixels near its outline may be drawn twice.
#[derive(Debug)]
pub struct Direct<'a, T> {
    display: &'a mut T,
    window: Window,
}

impl<'a, T: DrawTarget> Direct<'a, T> {
    /// On all of the display.
    pub fn new(display: &'a mut T) -> Self {
        let window = Window::new(&display.bounding_box());
        Self { display, window }
    }
}

/// Every row alike: an address is a column of the window.
const fn columns(window: &Window) -> Layout {
    Layout { pitch: 0, origin: window.left }
}

const fn rectangle<V: Interpolate>(window: &Window, span: &Span<NoDepth, V>) -> Rectangle {
    let width = (span.end - span.start) as u32;
    Rectangle::new(Point::new(window.left + span.start as i32, span.row), Size::new(width, 1))
}

impl<T: DrawTarget> Target for Direct<'_, T> {
    type Color = T::Color;
    type Depth = NoDepth;
    type Error = T::Error;

    fn window(&self) -> Window {
        self.window
    }

    #[inline(never)]
    fn shade<S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        triangle: Triangle<'_, S, NoDepth, V>,
        window: &Window,
        mut pixel: impl FnMut(V::Sample) -> T::Color,
    ) -> Result<(), T::Error> {
        triangle.for_each_span(window, columns(window), |span| {
            let mut varyings = span.varyings;
            let colors = (span.start..span.end).map(|_| {
                let color = pixel(V::sample(varyings));
                varyings = varyings.plus(span.varyings_step);
                color
            });
            self.display.fill_contiguous(&rectangle(window, span), colors)
        })
    }

    #[inline(never)]
    fn fill<S: Subpixel, V: Varyings + Interpolate>(
        &mut self,
        triangle: Triangle<'_, S, NoDepth, V>,
        window: &Window,
        color: T::Color,
    ) -> Result<(), T::Error> {
        triangle.for_each_span(window, columns(window), |span| {
            self.display.fill_solid(&rectangle(window, span), color)
        })
    }
}
