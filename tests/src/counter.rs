//! A display that counts how often each of its pixels is drawn.

use std::{convert::Infallible, marker::PhantomData};

use embedded_graphics::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point},
    pixelcolor::PixelColor,
    primitives::Rectangle,
};

use crate::recorder::bounded;

/// Counts the draws of each pixel. The display may lie anywhere. It panics if a pixel outside its
/// area is drawn: a rasterizer has to stay inside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counter<C> {
    area: Rectangle,
    counts: Vec<u32>,
    color: PhantomData<C>,
}

impl<C> Counter<C> {
    /// A display on which no pixel has been drawn.
    #[must_use]
    pub fn new(area: Rectangle) -> Self {
        Self {
            area,
            counts: vec![0; area.size.width as usize * area.size.height as usize],
            color: PhantomData,
        }
    }

    /// How often each pixel was drawn, row by row.
    #[must_use]
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// How often a pixel was drawn, by its place on the display.
    ///
    /// # Panics
    ///
    /// Panics if the place is outside the area.
    #[must_use]
    pub fn at(&self, x: i32, y: i32) -> u32 {
        self.counts[self.index(Point::new(x, y))]
    }

    fn index(&self, point: Point) -> usize {
        assert!(self.area.contains(point), "{point} lies outside {:?}", self.area);
        let from_corner = point - self.area.top_left;
        from_corner.y as usize * self.area.size.width as usize + from_corner.x as usize
    }

    fn count(&mut self, area: &Rectangle) {
        let Some(last) = area.bottom_right() else { return };
        for y in area.top_left.y..=last.y {
            let [first, last] = [area.top_left.x, last.x].map(|x| self.index(Point::new(x, y)));
            self.counts[first..=last].iter_mut().for_each(|count| *count += 1);
        }
    }
}

impl<C> Dimensions for Counter<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Counter<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(point, _) in pixels {
            let index = self.index(point);
            self.counts[index] += 1;
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let pixels = bounded(colors).count();
        assert_eq!(pixels, area.size.width as usize * area.size.height as usize, "{area:?}");
        self.count(area);
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: C) -> Result<(), Infallible> {
        self.count(area);
        Ok(())
    }
}
