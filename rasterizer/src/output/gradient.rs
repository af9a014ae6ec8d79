//! A background that runs from one colour to another.

use core::{array, marker::PhantomData};

use embedded_graphics_core::{
    Drawable,
    draw_target::DrawTarget,
    geometry::{Point, Size},
    pixelcolor::{PixelColor, Rgb888},
    primitives::Rectangle,
};

/// Rows of a rectangle from one colour at its top to another at its bottom: a sky, behind the
/// objects of a frame or of its bands.
///
/// The first row and the last one have these colours; each channel of the others is the nearest
/// step of 256 to the straight line between them, within 1/64 of a step, and is then converted to
/// the target's colour, in which few steps show as stripes. To hide these, draw it through
/// [`Dithering`](super::Dithering), in the pattern of the shaders' dithering:
///
/// ```
/// # use core::convert::Infallible;
/// use embedded_graphics_core::{
///     Drawable as _,
///     pixelcolor::{Rgb565, Rgb888},
///     prelude::*,
///     primitives::Rectangle,
/// };
/// use rasterizer::output::{Bands, Dithering, VerticalGradient};
///
/// # fn frame(
/// #     bands: &mut Bands<&mut [Rgb565], Rgb565, &mut [u16]>,
/// #     display: &mut impl DrawTarget<Color = Rgb565, Error = Infallible>,
/// # ) {
/// const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(320, 240));
/// const SKY: VerticalGradient<Rgb888> =
///     VerticalGradient::new(SCREEN, [70, 130, 180], [255, 228, 196]);
///
/// # let Ok(()) =
/// bands.show(
///     display,
///     |band| {
///         let Ok(()) = SKY.draw(&mut Dithering::new(band));
///     },
///     |band| {
///         // Draw the objects.
/// #       let _ = band;
///         Ok(())
///     },
/// );
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VerticalGradient<C> {
    area: Rectangle,
    /// Red, green and blue of the first row, in Q8.16.
    first: [i32; 3],
    /// By how much they differ from a row to the next, in Q8.16.
    step: [i32; 3],
    color: PhantomData<C>,
}

impl<C> VerticalGradient<C> {
    /// From red, green and blue in the first row of a rectangle of up to 2,048 rows, as pictures
    /// store them, to those in its last row.
    #[must_use]
    pub const fn new(area: Rectangle, top: [u8; 3], bottom: [u8; 3]) -> Self {
        let steps = match area.size.height {
            0 | 1 => 1,
            height => height as i64 - 1,
        };
        let (mut first, mut step) = ([0; 3], [0; 3]);
        let mut channel = 0;
        while channel < 3 {
            let (from, to) = (top[channel] as i64, bottom[channel] as i64);
            first[channel] = (from << 16) as i32;
            // Rounded to the nearest: over 2,047 steps within 2^-6.
            step[channel] = ((((to - from) << 17) + steps).div_euclid(2 * steps)) as i32;
            channel += 1;
        }
        Self { area, first, step, color: PhantomData }
    }
}

impl<C: PixelColor + From<Rgb888>> Drawable for VerticalGradient<C> {
    type Color = C;
    type Output = ();

    fn draw<T: DrawTarget<Color = C>>(&self, target: &mut T) -> Result<(), T::Error> {
        let part = self.area.intersection(&target.bounding_box());
        for row in part.rows() {
            let steps = row.wrapping_sub(self.area.top_left.y);
            let [red, green, blue] = array::from_fn(|channel| {
                let value = self.first[channel] + self.step[channel] * steps;
                ((value + (1 << 15)) >> 16) as u8
            });
            let line =
                Rectangle::new(Point::new(part.top_left.x, row), Size::new(part.size.width, 1));
            target.fill_solid(&line, Rgb888::new(red, green, blue).into())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use core::fmt::Debug;
    use std::vec;

    use embedded_graphics_core::{
        geometry::Dimensions as _,
        pixelcolor::{Rgb565, RgbColor as _},
    };

    use super::*;
    use crate::output::{BandAreas, Frame, StoredColor};

    /// The colour of each row, drawn in bands, which must be the same across.
    fn rows<C: StoredColor + PixelColor + From<Rgb888> + Debug>(
        gradient: &VerticalGradient<C>,
        band_rows: u32,
    ) -> vec::Vec<C> {
        let mut drawn = vec::Vec::new();
        let empty = C::from(Rgb888::new(9, 9, 9));
        for area in BandAreas::new(gradient.area, band_rows) {
            let area =
                Rectangle::new(area.top_left - Point::new(1, 0), Size::new(5, area.size.height));
            let mut pixels = vec![empty; 5 * area.size.height as usize];
            let mut frame = Frame::without_depth(&mut pixels, area).unwrap();
            assert_eq!(frame.bounding_box(), area);
            let Ok(()) = gradient.draw(&mut frame);
            for row in pixels.chunks(5) {
                assert_eq!(row, [empty, row[1], row[1], row[1], empty]);
                drawn.push(row[1]);
            }
        }
        drawn
    }

    #[test]
    fn rows_have_the_nearest_color() {
        for (height, top, bottom) in [
            (1, [1, 2, 3], [200, 100, 0]),
            (2, [0, 255, 7], [255, 0, 7]),
            (240, [70, 130, 180], [255, 228, 196]),
            (2048, [255, 3, 0], [0, 250, 255]),
        ] {
            let area = Rectangle::new(Point::new(-4, -7), Size::new(3, height));
            let gradient = VerticalGradient::<Rgb888>::new(area, top, bottom);
            let drawn = rows(&gradient, 16);
            assert_eq!(drawn.len(), height as usize);
            for (row, color) in drawn.iter().enumerate() {
                let way = row as f64 / f64::from(height - 1).max(1.0);
                for (got, [from, to]) in [color.r(), color.g(), color.b()]
                    .into_iter()
                    .zip([0, 1, 2].map(|c| [top[c], bottom[c]].map(f64::from)))
                {
                    let exact = from + (to - from) * way;
                    let off = (f64::from(got) - exact).abs();
                    assert!(off <= 0.5 + 1.0 / 64.0, "row {row} of {height}: {got}, not {exact}");
                }
            }
            let ends = [top, bottom].map(|[r, g, b]| Rgb888::new(r, g, b));
            assert_eq!(drawn[0], ends[0]);
            assert_eq!(*drawn.last().unwrap(), ends[usize::from(height > 1)]);
            let short = VerticalGradient::<Rgb565>::new(area, top, bottom);
            let converted: vec::Vec<_> = drawn.into_iter().map(Rgb565::from).collect();
            assert_eq!(rows(&short, 7), converted);
        }
    }
}
