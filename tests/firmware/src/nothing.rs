//! A target that draws no pixel: drawing into it costs what a frame costs without its pixels.

use core::{convert::Infallible, hint::black_box, marker::PhantomData};

use embedded_graphics_core::primitives::Rectangle;
use rasterizer::{
    attribute::DepthFormat,
    output::{Readable, Rgb565Be, Target},
    raster::{FragmentOf, Layout, Primitive, Window},
    shade::Outcome,
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

impl<D: DepthFormat> Target for Nothing<D> {
    type Color = Rgb565Be;
    type Depth = D;
    type Error = Infallible;

    fn window(&self) -> Window {
        self.window
    }

    #[inline(never)]
    fn shade<Q: Primitive<Depth = D>, O: Outcome<Rgb565Be>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        _: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        primitive.for_each_span(window, LAYOUT, |span| {
            // codegen: an unused span would not be computed.
            black_box(span);
            Ok(())
        })
    }
}

/// Nothing is read either.
impl<D: DepthFormat> Readable for Nothing<D> {
    fn blend<Q: Primitive<Depth = D>, O: Outcome<Rgb565Be>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(Rgb565Be, FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        self.shade(primitive, window, move |fragment| pixel(Rgb565Be::BLACK, fragment))
    }
}

/// As in a frame of the scenes' display.
const LAYOUT: Layout = Layout { pitch: 320, origin: 0 };
