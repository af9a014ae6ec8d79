//! A display that records its calls, and fails after a chosen number of them.

use embedded_graphics::{
    Pixel, draw_target::DrawTarget, geometry::Dimensions, pixelcolor::PixelColor,
    primitives::Rectangle,
};

/// A call that a display received.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Call<C: PixelColor> {
    /// Pixels one by one.
    Iter(Vec<Pixel<C>>),
    /// A rectangle, pixel by pixel.
    Contiguous(Rectangle, Vec<C>),
    /// A rectangle in one colour.
    Solid(Rectangle, C),
    /// Everything in one colour.
    Clear(C),
}

/// The error of a display that fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BusError;

/// Records all calls, including the ones that fail.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recorder<C: PixelColor> {
    area: Rectangle,
    calls: Vec<Call<C>>,
    works_for: usize,
}

impl<C: PixelColor> Recorder<C> {
    /// A display that never fails.
    #[must_use]
    pub const fn new(area: Rectangle) -> Self {
        Self::failing_after(area, usize::MAX)
    }

    /// A display that fails after `calls` successful calls.
    #[must_use]
    pub const fn failing_after(area: Rectangle, calls: usize) -> Self {
        Self { area, calls: Vec::new(), works_for: calls }
    }

    /// The recorded calls.
    #[must_use]
    pub fn calls(&self) -> &[Call<C>] {
        &self.calls
    }

    fn record(&mut self, call: Call<C>) -> Result<(), BusError> {
        self.calls.push(call);
        if self.calls.len() > self.works_for { Err(BusError) } else { Ok(()) }
    }
}

/// The pixels of a call, which fails if they do not come to an end: a fault in what sends them must
/// not fill the memory.
pub(crate) fn bounded<I: IntoIterator>(pixels: I) -> impl Iterator<Item = I::Item> {
    /// More than any display of the tests has.
    const MOST: usize = 1 << 20;
    pixels.into_iter().enumerate().map(|(count, pixel)| {
        assert!(count < MOST, "over {MOST} pixels are sent in a call");
        pixel
    })
}

impl<C: PixelColor> Dimensions for Recorder<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Recorder<C> {
    type Color = C;
    type Error = BusError;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), BusError> {
        self.record(Call::Iter(bounded(pixels).collect()))
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), BusError> {
        self.record(Call::Contiguous(*area, bounded(colors).collect()))
    }

    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), BusError> {
        self.record(Call::Solid(*area, color))
    }

    fn clear(&mut self, color: C) -> Result<(), BusError> {
        self.record(Call::Clear(color))
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics::{geometry::Point, pixelcolor::BinaryColor, prelude::Size};

    use super::*;

    #[test]
    #[should_panic(expected = "over 1048576 pixels are sent in a call")]
    fn pixels_without_end_are_refused() {
        let area = Rectangle::new(Point::zero(), Size::new(8, 8));
        let colors = std::iter::from_fn(|| Some(BinaryColor::On));
        let _ = Recorder::new(area).fill_contiguous(&area, colors);
    }
}
