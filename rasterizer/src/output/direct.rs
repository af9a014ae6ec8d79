//! Straight onto a display, without a buffer.

use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Point, Size},
    primitives::Rectangle,
};

use super::{
    Target,
    pixels::{Place, Run},
};
use crate::{
    attribute::{Interpolate, NoDepth},
    raster::{Fragment, FragmentOf, Layout, Primitive, Span, Window},
    shade::Outcome,
};

/// Draws on any [`DrawTarget`], each span by one call of `fill_solid` or `fill_contiguous`, or of
/// `draw_iter` if the shader discards pixels.
///
/// Depth is not tested: this is for convex bodies whose back faces are culled, and for objects
/// drawn from back to front. A rounded body whose quads were split along the wrong diagonal is not
/// quite convex: pixels near its outline may be drawn twice. Blending is a compile error, because a
/// display's pixels cannot be read.
#[derive(Debug)]
pub struct Direct<'a, T> {
    display: &'a mut T,
    window: Window,
}

impl<'a, T: DrawTarget> Direct<'a, T> {
    /// Draws on all of the display.
    pub fn new(display: &'a mut T) -> Self {
        let window = Window::new(&display.bounding_box());
        Self { display, window }
    }
}

/// All rows have the same addresses: the columns of the window, counted from its left side.
const fn columns(window: &Window) -> Layout {
    Layout { pitch: 0, origin: window.left }
}

const fn rectangle<V: Interpolate>(window: &Window, span: &Span<'_, NoDepth, V>) -> Rectangle {
    let width = (span.end - span.start) as u32;
    Rectangle::new(Point::new(window.left + span.start as i32, span.row), Size::new(width, 1))
}

/// The fragments of a span, from left to right.
struct Fragments<V: Interpolate> {
    run: Run<NoDepth, V>,
    rest: V::Rest,
    place: Place,
    /// The pixels of the run that are left.
    pixels: usize,
}

impl<V: Interpolate> Fragments<V> {
    fn new(span: &Span<'_, NoDepth, V>, layout: Layout) -> Self {
        let (run, pixels, rest) = Run::first_of(span);
        Self { run, rest, place: Place::of(span, layout), pixels }
    }
}

impl<V: Interpolate> Iterator for Fragments<V> {
    type Item = Fragment<V::Sample>;

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.pixels == 0 {
            self.pixels = self.run.enter(self.rest.next()?);
        }
        let fragment = self.run.fragment(self.place);
        self.run.step();
        self.place = self.place.right(1);
        self.pixels -= 1;
        Some(fragment)
    }
}

impl<T: DrawTarget> Target for Direct<'_, T> {
    type Color = T::Color;
    type Depth = NoDepth;
    type Error = T::Error;

    fn window(&self) -> Window {
        self.window
    }

    #[inline(never)]
    fn shade<Q: Primitive<Depth = NoDepth>, O: Outcome<T::Color>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        let layout = columns(window);
        primitive.for_each_span(window, layout, |span| {
            let fragments = Fragments::<Q::Varyings>::new(span, layout);
            if O::DISCARDS {
                self.display.draw_iter(fragments.filter_map(|fragment| {
                    let point = Point::new(fragment.column, fragment.row);
                    pixel(fragment).color().map(|color| Pixel(point, color))
                }))
            } else {
                let colors = fragments.map_while(|fragment| pixel(fragment).color());
                self.display.fill_contiguous(&rectangle(window, span), colors)
            }
        })
    }

    #[inline(never)]
    fn fill<Q: Primitive<Depth = NoDepth>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        color: T::Color,
    ) -> Result<(), T::Error> {
        primitive.for_each_span(window, columns(window), |span| {
            self.display.fill_solid(&rectangle(window, span), color)
        })
    }
}
